//! Linear programs in three variables or fewer, after Seidel: constraints come one by one; where one is violated, the
//! optimum is on its plane, which is a program with a variable less.

/// All `x` with `normal . x <= most`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HalfSpace {
    /// Its normal, of any length.
    pub normal: [f64; 3],
    /// The greatest value.
    pub most: f64,
}

/// The point of a box (`low`, `high`) in all the half-spaces that is farthest along `goal`; `None` where there is no point.
///
/// What is violated by a few roundings of its terms counts as held.
pub fn farthest(goal: [f64; 3], (low, high): ([f64; 3], [f64; 3]), halves: &[HalfSpace]) -> Option<[f64; 3]> {
    solve(3, &Program { goal, low, high }, halves)
}

/// The objective, and between which values variables are.
struct Program {
    goal: [f64; 3],
    low: [f64; 3],
    high: [f64; 3],
}

/// The first `count` variables matter.
fn solve(count: usize, program: &Program, halves: &[HalfSpace]) -> Option<[f64; 3]> {
    let Program { goal, low, high } = program;
    let mut best = [0.0; 3];
    for i in 0..count {
        if low[i] > high[i] {
            return None;
        }
        best[i] = if goal[i] < 0.0 { low[i] } else { high[i] };
    }
    for (number, half) in halves.iter().enumerate() {
        if is_held(count, half, best) {
            continue;
        }
        best = on_plane(count, program, half, &halves[..number])?;
    }
    Some(best)
}

fn is_held(count: usize, half: &HalfSpace, x: [f64; 3]) -> bool {
    let (mut value, mut size) = (0.0, half.most.abs());
    for (normal, x) in half.normal.iter().zip(x).take(count) {
        value += normal * x;
        size += (normal * x).abs();
    }
    value <= half.most + 4.0 * f64::EPSILON * size
}

/// The optimum where `half` is held just so.
fn on_plane(count: usize, program: &Program, half: &HalfSpace, others: &[HalfSpace]) -> Option<[f64; 3]> {
    let Program { goal, low, high } = program;
    let out = (0..count).max_by(|&i, &j| half.normal[i].abs().total_cmp(&half.normal[j].abs()))?;
    let pivot = half.normal[out];
    if pivot == 0.0 {
        return None;
    }
    // The variable that goes is `constant - slopes . x`.
    let constant = half.most / pivot;
    let slopes = half.normal.map(|n| n / pivot);
    let without = |v: [f64; 3]| {
        let mut rest = [0.0; 3];
        (0..count).filter(|&i| i != out).zip(&mut rest).for_each(|(i, rest)| *rest = v[i]);
        rest
    };
    let reduced = |normal: [f64; 3], most: f64| {
        let mut left = normal;
        (0..count).for_each(|i| left[i] -= normal[out] * slopes[i]);
        HalfSpace { normal: without(left), most: most - normal[out] * constant }
    };
    let along = |sign: f64| {
        let mut normal = [0.0; 3];
        normal[out] = sign;
        normal
    };
    let mut left = vec![reduced(along(1.0), high[out]), reduced(along(-1.0), -low[out])];
    left.extend(others.iter().map(|other| reduced(other.normal, other.most)));
    let inner = Program { goal: reduced(*goal, 0.0).normal, low: without(*low), high: without(*high) };
    let found = match count {
        1 => left.iter().all(|half| is_held(0, half, [0.0; 3])).then_some([0.0; 3])?,
        _ => solve(count - 1, &inner, &left)?,
    };
    let mut x = [0.0; 3];
    (0..count).filter(|&i| i != out).zip(found).for_each(|(i, value)| x[i] = value);
    x[out] = constant - (0..count).filter(|&i| i != out).map(|i| slopes[i] * x[i]).sum::<f64>();
    Some(x)
}

#[cfg(test)]
mod tests {
    use super::*;

    const UNIT: ([f64; 3], [f64; 3]) = ([-1.0; 3], [1.0; 3]);

    fn half(normal: [f64; 3], most: f64) -> HalfSpace {
        HalfSpace { normal, most }
    }

    #[test]
    fn without_constraints_the_box_tells() {
        assert_eq!(farthest([1.0, -2.0, 3.0], UNIT, &[]), Some([1.0, -1.0, 1.0]));
    }

    #[test]
    fn a_roof_is_as_high_as_its_ridge() {
        // Two slopes above a diagonal ridge at 0.25: neither alone keeps corners below 1.
        let roof = [half([1.0, 1.0, 2.0], 0.5), half([-1.0, -1.0, 2.0], 0.5)];
        let [x, y, z] = farthest([0.0, 0.0, 1.0], UNIT, &roof).expect("there is room");
        assert!((z - 0.25).abs() < 1e-15 && (x + y).abs() < 1e-15, "{x} {y} {z}");
    }

    #[test]
    fn a_pyramid_ends_in_its_apex_and_nothing_is_above_it() {
        let mut sides = vec![];
        for (x, y) in [(1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0)] {
            sides.push(half([x, y, 1.0], 0.5));
        }
        assert_eq!(farthest([0.0, 0.0, 1.0], UNIT, &sides), Some([0.0, 0.0, 0.5]));
        sides.push(half([0.0, 0.0, -1.0], -0.51));
        assert_eq!(farthest([0.0, 0.0, 1.0], UNIT, &sides), None);
    }

    #[test]
    fn what_contradicts_itself_has_no_point() {
        assert_eq!(farthest([1.0, 0.0, 0.0], UNIT, &[half([0.0; 3], -1.0)]), None);
        assert_eq!(farthest([1.0, 0.0, 0.0], UNIT, &[half([1.0, 0.0, 0.0], -2.0)]), None);
        assert_eq!(farthest([1.0, 0.0, 0.0], UNIT, &[half([0.0; 3], 0.0)]), Some([1.0; 3]));
    }
}
