//! Real roots in brackets: Newton's method where it helps, bisection where it does not. Slower than closed formulas, but
//! no root is ever lost or far off, and the same operations run on every machine.

/// Newton steps and bisections together never need as many.
pub const MOST_STEPS: usize = 200;

/// How well a root is to be known.
#[derive(Clone, Copy, Debug)]
pub struct Precision {
    /// How far off it may be.
    pub tolerance: f64,
    /// Values up to that are as good as zero: rounding may make as much of zero.
    pub noise: f64,
}

/// The root in the `bracket` of a function that has one sign near its lower end and the other near its upper end: `rising`
/// from negative to positive, or falling. `f` returns its value and Newton's step, the value over the slope turned about;
/// it is not asked at the ends themselves, so an end may be the root. The search starts at `start`, or in the middle if that
/// is not in the bracket.
///
/// Good to `precision` where rounding in `f` allows it. Its twin for eight roots at once (`trace::tile::roots`) does the same
/// operations.
pub fn bracketed_root(
    f: impl Fn(f64) -> (f64, f64),
    bracket: (f64, f64),
    start: f64,
    rising: bool,
    precision: Precision,
) -> f64 {
    let (mut lo, mut hi) = bracket;
    let mut last_step = hi - lo;
    let mut x = if lo < start && start < hi { start } else { lo + last_step / 2.0 };
    for _ in 0..MOST_STEPS {
        let (value, newton) = f(x);
        if value == 0.0 {
            break;
        }
        if (value < 0.0) == rising {
            lo = x
        } else {
            hi = x
        }
        let next = x + newton;
        let close = newton.abs() <= precision.tolerance || value.abs() <= precision.noise;
        if close && lo <= next && next <= hi {
            return next;
        }
        // A Newton step must stay in the bracket and be at most half as long as the step before.
        let next = if lo < next && next < hi && newton.abs() <= last_step / 2.0 { next } else { lo + (hi - lo) / 2.0 };
        last_step = (next - x).abs();
        x = next;
        if last_step <= precision.tolerance {
            break;
        }
    }
    x
}

/// The ascending roots of `x³ + p x + q` between `lo` and `hi`, and how many they are. Of a double root, both or neither
/// may be found.
pub fn cubic_roots(p: f64, q: f64, (lo, hi): (f64, f64), precision: Precision) -> ([f64; 3], usize) {
    let value = |x: f64| (x * x + p) * x + q;
    let f = |x: f64| {
        let value = value(x);
        (value, -value / (3.0 * (x * x) + p))
    };
    let mut roots = [0.0; 3];
    let mut count = 0;
    let mut search = |from: f64, to: f64| {
        let (starts_negative, ends_negative) = (value(from) < 0.0, value(to) < 0.0);
        if from < to && starts_negative != ends_negative {
            roots[count] = bracketed_root(f, (from, to), f64::NAN, starts_negative, precision);
            count += 1;
        }
    };
    if p < 0.0 {
        let turn = (p / -3.0).sqrt();
        search(lo, hi.min(-turn));
        search(lo.max(-turn), hi.min(turn));
        search(lo.max(turn), hi);
    } else {
        search(lo, hi);
    }
    (roots, count)
}

#[cfg(test)]
mod tests {
    use super::*;

    const EXACT: Precision = Precision { tolerance: 1e-16, noise: 0.0 };

    fn cubic(p: f64, q: f64, lo: f64, hi: f64) -> Vec<f64> {
        let (roots, count) = cubic_roots(p, q, (lo, hi), EXACT);
        roots[..count].to_vec()
    }

    #[test]
    fn cubics_have_one_root_or_three() {
        assert_eq!(cubic(-7.0, 6.0, -9.0, 9.0), [-3.0, 1.0, 2.0]);
        assert_eq!(cubic(1.0, -2.0, -9.0, 9.0), [1.0]);
        assert_eq!(cubic(-1.0, 0.0, -9.0, 9.0), [-1.0, 0.0, 1.0]);
        let triple = cubic(0.0, 0.0, -2.0, 1.0);
        assert!(triple.len() == 1 && triple[0].abs() < 1e-15, "{triple:?}");
    }

    #[test]
    fn roots_outside_the_range_are_left_out() {
        assert_eq!(cubic(-7.0, 6.0, 0.0, 1.5), [1.0]);
        assert_eq!(cubic(-7.0, 6.0, 3.0, 9.0), []);
        assert_eq!(cubic(-7.0, 6.0, -2.5, -2.0), []);
    }

    #[test]
    fn a_root_is_found_where_newton_alone_runs_away() {
        // Newton's method for the cube root diverges from everywhere.
        let f = |x: f64| (libm::cbrt(x - 0.1), -3.0 * (x - 0.1));
        let root = bracketed_root(f, (-1.0, 1.0), f64::NAN, true, Precision { tolerance: 1e-15, noise: 0.0 });
        assert!((root - 0.1).abs() < 1e-14, "{root}");
    }

    #[test]
    fn an_end_may_be_the_root() {
        let root = bracketed_root(|x| (x, -x), (-1.0, 0.0), f64::NAN, true, EXACT);
        assert!((-1e-16..=0.0).contains(&root), "{root}");
    }

    #[test]
    fn noise_is_not_searched() {
        // Near its root this function is a staircase, on which Newton's steps never become small.
        let asked = std::cell::Cell::new(0);
        let f = |x: f64| {
            asked.set(asked.get() + 1);
            let value = (x * x - 2.0 + 64.0) - 64.0;
            (value, -value / (2.0 * x))
        };
        let root = bracketed_root(f, (1.0, 2.0), 1.4, true, Precision { tolerance: 1e-18, noise: 2e-14 });
        assert!((root * root - 2.0).abs() < 2e-14 && asked.get() < 6, "{root}, asked {} times", asked.get());
    }
}
