//! Real roots in brackets: Newton's method where it helps, bisection where it does not. Slower than closed formulas, but
//! no root is ever lost or far off, and the same operations run on every machine.

/// Newton steps and bisections together never need as many.
const MOST_STEPS: usize = 200;

/// The root between `lo` and `hi` of a function that has one sign near `lo` and the other near `hi`: `rising` from negative
/// to positive, or falling. `f` returns value and slope; it is not asked at the ends themselves, so an end may be the root.
///
/// Good to `tolerance` where rounding in `f` allows it.
pub fn bracketed_root(f: impl Fn(f64) -> (f64, f64), lo: f64, hi: f64, rising: bool, tolerance: f64) -> f64 {
    let (mut lo, mut hi) = (lo, hi);
    let mut x = lo + (hi - lo) / 2.0;
    let mut last_step = hi - lo;
    for _ in 0..MOST_STEPS {
        let (value, slope) = f(x);
        if value == 0.0 {
            break;
        }
        if (value < 0.0) == rising {
            lo = x
        } else {
            hi = x
        }
        let newton = -value / slope;
        if newton.abs() <= tolerance {
            return (x + newton).clamp(lo, hi);
        }
        // A Newton step must stay in the bracket and be at most half as long as the step before.
        let next = x + newton;
        let next = if lo < next && next < hi && newton.abs() <= last_step / 2.0 { next } else { lo + (hi - lo) / 2.0 };
        last_step = (next - x).abs();
        if last_step <= tolerance {
            return next;
        }
        x = next;
    }
    x
}

/// The ascending roots of `x³ + p x + q` between `lo` and `hi`, and how many they are. Of a double root, both or neither
/// may be found.
pub fn cubic_roots(p: f64, q: f64, lo: f64, hi: f64, tolerance: f64) -> ([f64; 3], usize) {
    let f = |x: f64| ((x * x + p) * x + q, 3.0 * (x * x) + p);
    let mut roots = [0.0; 3];
    let mut count = 0;
    let mut search = |from: f64, to: f64| {
        let (starts_negative, ends_negative) = (f(from).0 < 0.0, f(to).0 < 0.0);
        if from < to && starts_negative != ends_negative {
            roots[count] = bracketed_root(f, from, to, starts_negative, tolerance);
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

    fn cubic(p: f64, q: f64, lo: f64, hi: f64) -> Vec<f64> {
        let (roots, count) = cubic_roots(p, q, lo, hi, 1e-16);
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
        let f = |x: f64| (libm::cbrt(x - 0.1), libm::cbrt(x - 0.1) / (3.0 * (x - 0.1)));
        let root = bracketed_root(f, -1.0, 1.0, true, 1e-15);
        assert!((root - 0.1).abs() < 1e-14, "{root}");
    }

    #[test]
    fn an_end_may_be_the_root() {
        let root = bracketed_root(|x| (x, 1.0), -1.0, 0.0, true, 1e-16);
        assert!((-1e-16..=0.0).contains(&root), "{root}");
    }
}
