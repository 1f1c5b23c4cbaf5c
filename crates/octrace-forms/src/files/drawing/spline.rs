//! DXF's splines: B-splines of any degree, rational ones too, as cubic Bézier curves.
//!
//! Between knots a spline is smooth. There a cubic with the same ends and the same derivatives at the ends is the curve
//! itself for degrees up to three; others are divided, and the cubics are off by the fourth power of the parts' length.

use octrace::Vec2;

/// Parts of what is between two knots, where a cubic is not the curve itself.
const PARTS: u32 = 16;

/// More control points, or a higher degree, than any program writes.
const MOST: usize = 1 << 16;
const HIGHEST_DEGREE: usize = 25;

/// A B-spline as the file has it.
#[derive(Debug)]
pub(super) struct Spline<'a> {
    pub degree: usize,
    pub knots: &'a [f64],
    pub points: &'a [Vec2],
    /// One for each point; none for all alike.
    pub weights: &'a [f64],
}

/// A point times its weight, and the weight.
type Weighted = [f64; 3];

impl Spline<'_> {
    /// The curves, end to end; `None` where the numbers do not make up a spline.
    pub fn beziers(&self) -> Option<Vec<[Vec2; 4]>> {
        let (degree, count) = (self.degree, self.points.len());
        let sound = (1..=HIGHEST_DEGREE).contains(&degree)
            && (degree + 1..=MOST).contains(&count)
            && self.knots.len() == count + degree + 1
            && self.knots.windows(2).all(|pair| pair[0] <= pair[1])
            && (self.weights.is_empty() || self.weights.len() == count)
            && self.weights.iter().all(|&weight| weight > 0.0);
        if !sound {
            return None;
        }
        let is_cubic = degree <= 3 && self.weights.windows(2).all(|pair| pair[0] == pair[1]);
        let parts = if is_cubic { 1 } else { PARTS };
        let mut curves = Vec::new();
        for span in (degree..count).filter(|&span| self.knots[span] < self.knots[span + 1]) {
            let (from, to) = (self.knots[span], self.knots[span + 1]);
            let step = (to - from) / f64::from(parts);
            for part in 0..parts {
                let (a, slope_a) = self.at(span, from + step * f64::from(part));
                let (b, slope_b) = self.at(span, from + step * f64::from(part + 1));
                // Curves follow each other without a gap.
                let a = curves.last().map_or(a, |before: &[Vec2; 4]| before[3]);
                curves.push([a, a + slope_a * (step / 3.0), b - slope_b * (step / 3.0), b]);
            }
        }
        Some(curves)
    }

    /// Point and derivative at a parameter between knot `span` and the next, by de Boor's algorithm.
    fn at(&self, span: usize, u: f64) -> (Vec2, Vec2) {
        let degree = self.degree;
        let weighted = |i: usize| -> Weighted {
            let weight = self.weights.get(i).copied().unwrap_or(1.0);
            [self.points[i].x * weight, self.points[i].y * weight, weight]
        };
        let mut row: Vec<Weighted> = (span - degree..=span).map(weighted).collect();
        let mut slope = [0.0; 3];
        for level in 1..=degree {
            for j in (level..=degree).rev() {
                let low = self.knots[span - degree + j];
                let length = self.knots[span + 1 + j - level] - low;
                let share = (u - low) / length;
                if level == degree {
                    slope = [0, 1, 2].map(|k| (row[j][k] - row[j - 1][k]) * degree as f64 / length);
                }
                row[j] = [0, 1, 2].map(|k| row[j - 1][k] + (row[j][k] - row[j - 1][k]) * share);
            }
        }
        let [x, y, weight] = row[degree];
        let p = Vec2::new(x / weight, y / weight);
        (p, (Vec2::new(slope[0], slope[1]) - p * slope[2]) * (1.0 / weight))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn points(list: &[[f64; 2]]) -> Vec<Vec2> {
        list.iter().map(|&[x, y]| Vec2::new(x, y)).collect()
    }

    #[test]
    fn a_cubic_between_two_knots_is_itself() {
        let points = points(&[[0.0, 0.0], [1.0, 2.0], [3.0, 2.0], [4.0, 0.0]]);
        let knots = [0.0, 0.0, 0.0, 0.0, 5.0, 5.0, 5.0, 5.0];
        let curves = Spline { degree: 3, knots: &knots, points: &points, weights: &[] }.beziers().unwrap();
        assert_eq!(curves.len(), 1);
        for (found, expected) in curves[0].iter().zip(&points) {
            assert!((*found - *expected).length() < 1e-12, "{found:?} {expected:?}");
        }
    }

    /// Three points with the weights 1, cos 45 and 1 are a quarter of a circle.
    #[test]
    fn a_rational_quarter_of_a_circle_is_round() {
        let points = points(&[[1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]);
        let (knots, weights) = ([0.0, 0.0, 0.0, 1.0, 1.0, 1.0], [1.0, 0.5_f64.sqrt(), 1.0]);
        let curves = Spline { degree: 2, knots: &knots, points: &points, weights: &weights }.beziers().unwrap();
        assert_eq!(curves.len(), PARTS as usize);
        for [a, b, c, d] in curves {
            let middle = (a + (b + c) * 3.0 + d) * 0.125;
            assert!((a.length() - 1.0).abs() < 1e-12 && (middle.length() - 1.0).abs() < 1e-6, "{middle:?}");
        }
    }

    #[test]
    fn what_is_no_spline_is_none() {
        let points = points(&[[1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]);
        let check = |degree, knots: &[f64], weights: &[f64]| {
            assert!(Spline { degree, knots, points: &points, weights }.beziers().is_none());
        };
        check(0, &[0.0; 4], &[]);
        check(2, &[0.0, 0.0, 0.0, 1.0, 1.0], &[]);
        check(2, &[0.0, 0.0, 1.0, 0.0, 1.0, 1.0], &[]);
        check(2, &[0.0, 0.0, 0.0, 1.0, 1.0, 1.0], &[1.0, -1.0, 1.0]);
    }
}
