//! The parameters at which a line crosses one surface.

/// Where a line passes from one side of a surface to the other: the side that it comes from, and up to four ascending
/// parameters at which it changes sides. As a set of parameters, the inside is half-open: `[enter, exit)`.
///
/// Parameters are finite. Where a line is so nearly parallel to a surface that its parameter would not be, it is on one
/// side of the surface wherever it can be followed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossings {
    t: [f64; 4],
    count: u8,
    starts_inside: bool,
}

impl Crossings {
    /// The line stays on one side.
    pub const fn none(starts_inside: bool) -> Self {
        Self { t: [0.0; 4], count: 0, starts_inside }
    }

    /// The line changes sides once.
    pub fn one(starts_inside: bool, t: f64) -> Self {
        if !t.is_finite() {
            return Self::none(starts_inside ^ (t == f64::NEG_INFINITY));
        }
        // Adding zero turns -0 into 0: equal parameters shall have equal bits.
        Self { t: [t + 0.0, 0.0, 0.0, 0.0], count: 1, starts_inside }
    }

    /// The line changes sides and back, at the two parameters in either order.
    pub fn two(starts_inside: bool, a: f64, b: f64) -> Self {
        let (a, b) = if a <= b { (a, b) } else { (b, a) };
        if !(a.is_finite() && b.is_finite()) {
            return match a == f64::NEG_INFINITY {
                true => Self::one(!starts_inside, b),
                false => Self::one(starts_inside, a),
            };
        }
        Self { t: [a + 0.0, b + 0.0, 0.0, 0.0], count: 2, starts_inside }
    }

    /// The same crossings for parameters that count from elsewhere: `by` is where the present zero lies.
    pub fn shifted(mut self, by: f64) -> Self {
        for t in &mut self.t[..self.count as usize] {
            *t += by;
        }
        self
    }

    /// Adds a change of sides, not before those that are there.
    ///
    /// # Panics
    /// If there are four already.
    pub fn push(&mut self, t: f64) {
        self.t[self.count as usize] = t + 0.0;
        self.count += 1;
    }

    /// Whether the line comes from inside.
    pub fn starts_inside(&self) -> bool {
        self.starts_inside
    }

    /// The parameters, ascending.
    pub fn params(&self) -> &[f64] {
        &self.t[..self.count as usize]
    }
}

/// Ascending parameters at which a line changes sides, and the side that it comes from; as [`Crossings`], of any number.
#[derive(Clone, Copy, Debug)]
pub struct Sides<'a> {
    /// Whether the line comes from inside.
    pub starts_inside: bool,
    /// The parameters, ascending. Two equal ones cancel each other.
    pub params: &'a [f64],
}

impl Sides<'_> {
    /// Whether the line is inside just before `t`.
    #[inline]
    pub fn before(&self, t: f64) -> bool {
        self.starts_inside ^ (self.params.iter().filter(|&&c| c < t).count() % 2 == 1)
    }

    /// Whether the line is inside from `t` on.
    #[inline]
    pub fn after(&self, t: f64) -> bool {
        self.starts_inside ^ (self.params.iter().filter(|&&c| c <= t).count() % 2 == 1)
    }

    /// The first parameter `>= t` from which on the line is inside (`wanted`) or outside (`!wanted`); infinite where it
    /// never is.
    #[inline]
    pub fn next(&self, t: f64, wanted: bool) -> f64 {
        let mut i = self.params.iter().filter(|&&c| c <= t).count();
        if (self.starts_inside ^ (i % 2 == 1)) == wanted {
            return t;
        }
        while let Some(&next) = self.params.get(i) {
            let touching = self.params[i..].iter().take_while(|&&c| c == next).count();
            if touching % 2 == 1 {
                return next;
            }
            i += touching;
        }
        f64::INFINITY
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sides(crossings: &Crossings) -> Sides<'_> {
        Sides { starts_inside: crossings.starts_inside(), params: crossings.params() }
    }

    #[test]
    fn the_inside_is_half_open() {
        let crossings = Crossings::two(false, 2.0, 1.0);
        let span = sides(&crossings);
        assert_eq!(span.params, [1.0, 2.0]);
        assert!(!span.before(1.0) && span.after(1.0));
        assert!(span.before(2.0) && !span.after(2.0));
        assert_eq!(span.next(0.0, true), 1.0);
        assert_eq!(span.next(1.0, true), 1.0);
        assert_eq!(span.next(1.0, false), 2.0);
        assert_eq!(span.next(2.0, true), f64::INFINITY);
        assert_eq!(span.next(2.0, false), 2.0);
    }

    #[test]
    fn what_is_crossed_at_infinity_is_not_crossed() {
        const INF: f64 = f64::INFINITY;
        assert_eq!(Crossings::one(false, INF), Crossings::none(false));
        assert_eq!(Crossings::one(false, -INF), Crossings::none(true));
        assert_eq!(Crossings::two(true, INF, 1.0), Crossings::one(true, 1.0));
        assert_eq!(Crossings::two(true, 1.0, -INF), Crossings::one(false, 1.0));
        assert_eq!(Crossings::two(true, INF, -INF), Crossings::none(false));
    }

    #[test]
    fn a_touch_is_no_crossing() {
        let crossings = Crossings::two(false, 1.0, 1.0);
        assert_eq!(sides(&crossings).next(0.0, true), f64::INFINITY);
        assert_eq!(sides(&crossings).next(1.0, false), 1.0);
    }
}
