//! Affine maps: the geometric transformation matrices of [Comba-Persiano, §2.1].

use super::Vec3;
use std::ops::Mul;

/// An affine map of space: a 3x3 linear part, by rows, and a translation. Applied to column vectors from the left, so
/// `a * b` first does `b`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Affine {
    /// Rows of the linear part.
    pub rows: [Vec3; 3],
    /// Where the origin goes.
    pub translation: Vec3,
}

impl Affine {
    /// The map that moves nothing.
    pub const IDENTITY: Self = Self { rows: [Vec3::X, Vec3::Y, Vec3::Z], translation: Vec3::ZERO };

    /// Moves everything by `v`.
    pub const fn translation(v: Vec3) -> Self {
        Self { translation: v, ..Self::IDENTITY }
    }

    /// Scales about the origin, by axis. A zero factor makes the map singular.
    pub const fn scale(v: Vec3) -> Self {
        Self {
            rows: [Vec3::new(v.x, 0.0, 0.0), Vec3::new(0.0, v.y, 0.0), Vec3::new(0.0, 0.0, v.z)],
            translation: Vec3::ZERO,
        }
    }

    /// Rotates by the given angles in degrees, about X, then Y, then Z [Comba-Persiano, §2.1]; the same as OpenSCAD's
    /// `rotate([a, b, c])`. Multiples of 90 degrees are exact.
    pub fn rotation_deg(angles: Vec3) -> Self {
        let (sx, cx) = sin_cos_deg(angles.x);
        let (sy, cy) = sin_cos_deg(angles.y);
        let (sz, cz) = sin_cos_deg(angles.z);
        let about_x = Self::linear([Vec3::X, Vec3::new(0.0, cx, -sx), Vec3::new(0.0, sx, cx)]);
        let about_y = Self::linear([Vec3::new(cy, 0.0, sy), Vec3::Y, Vec3::new(-sy, 0.0, cy)]);
        let about_z = Self::linear([Vec3::new(cz, -sz, 0.0), Vec3::new(sz, cz, 0.0), Vec3::Z]);
        about_z * about_y * about_x
    }

    /// Rotates by `angle_deg` degrees about `axis`, right-handed; `None` where the axis has no direction.
    pub fn rotation_about_deg(axis: Vec3, angle_deg: f64) -> Option<Self> {
        let u = axis.normalized()?;
        let (s, c) = sin_cos_deg(angle_deg);
        let k = 1.0 - c;
        Some(Self::linear([
            Vec3::new(c + u.x * u.x * k, u.x * u.y * k - u.z * s, u.x * u.z * k + u.y * s),
            Vec3::new(u.y * u.x * k + u.z * s, c + u.y * u.y * k, u.y * u.z * k - u.x * s),
            Vec3::new(u.z * u.x * k - u.y * s, u.z * u.y * k + u.x * s, c + u.z * u.z * k),
        ]))
    }

    /// Mirrors at the plane through the origin with this normal; `None` where the normal has no direction.
    pub fn mirror(normal: Vec3) -> Option<Self> {
        let n = normal.normalized()?;
        let row = |axis: Vec3, c: f64| axis - n * (2.0 * c);
        Some(Self::linear([row(Vec3::X, n.x), row(Vec3::Y, n.y), row(Vec3::Z, n.z)]))
    }

    /// The linear map with these rows.
    pub const fn linear(rows: [Vec3; 3]) -> Self {
        Self { rows, translation: Vec3::ZERO }
    }

    /// The map given by the upper three rows of a 4x4 matrix, as in OpenSCAD's `multmatrix`.
    pub fn from_rows(m: [[f64; 4]; 3]) -> Self {
        let row = |r: [f64; 4]| Vec3::new(r[0], r[1], r[2]);
        Self { rows: m.map(row), translation: Vec3::new(m[0][3], m[1][3], m[2][3]) }
    }

    /// Where the point `p` goes.
    pub fn point(&self, p: Vec3) -> Vec3 {
        self.vector(p) + self.translation
    }

    /// Where the direction `d` goes; its length counts.
    pub fn vector(&self, d: Vec3) -> Vec3 {
        Vec3::new(self.rows[0].dot(d), self.rows[1].dot(d), self.rows[2].dot(d))
    }

    /// The transposed linear part times `n`. With the *inverse* of the map that moved a surface, this moves its normals.
    pub fn transposed_vector(&self, n: Vec3) -> Vec3 {
        self.rows[0] * n.x + self.rows[1] * n.y + self.rows[2] * n.z
    }

    /// Column `axis` of the linear part: where that unit vector goes.
    pub fn column(&self, axis: usize) -> Vec3 {
        Vec3::new(self.rows[0][axis], self.rows[1][axis], self.rows[2][axis])
    }

    /// The determinant: the factor by which volumes grow, negative where the map mirrors.
    pub fn determinant(&self) -> f64 {
        self.rows[0].dot(self.rows[1].cross(self.rows[2]))
    }

    /// The map that undoes this one, or `None` where there is none to working precision (the map flattens space) or a
    /// number is not finite.
    pub fn inverse(&self) -> Option<Self> {
        let [a, b, c] = self.rows;
        let det = self.determinant();
        let volume = a.length() * b.length() * c.length();
        if !(det.is_finite() && volume.is_finite() && self.translation.is_finite()) || det.abs() <= volume * 1e-14 {
            return None;
        }
        let columns = [b.cross(c) / det, c.cross(a) / det, a.cross(b) / det];
        let row = |i: usize| Vec3::new(columns[0][i], columns[1][i], columns[2][i]);
        let linear = Self::linear([row(0), row(1), row(2)]);
        let inverse = Self { translation: -linear.vector(self.translation), ..linear };
        inverse.is_finite().then_some(inverse)
    }

    /// Whether every entry is finite.
    pub fn is_finite(&self) -> bool {
        self.rows.iter().all(|r| r.is_finite()) && self.translation.is_finite()
    }
}

impl Mul for Affine {
    type Output = Self;
    fn mul(self, o: Self) -> Self {
        let row = |r: Vec3| o.rows[0] * r.x + o.rows[1] * r.y + o.rows[2] * r.z;
        Self { rows: self.rows.map(row), translation: self.point(o.translation) }
    }
}

/// Sine and cosine of an angle in degrees; exact at multiples of 90 and, for the halves, of 30 degrees.
pub fn sin_cos_deg(angle_deg: f64) -> (f64, f64) {
    let turn = angle_deg.rem_euclid(360.0);
    let quadrant = (turn / 90.0).floor();
    let rest = turn - quadrant * 90.0;
    let (s, c) = if rest == 0.0 {
        (0.0, 1.0)
    } else if rest == 30.0 {
        (0.5, 0.75_f64.sqrt())
    } else if rest == 60.0 {
        (0.75_f64.sqrt(), 0.5)
    } else if rest == 45.0 {
        (0.5_f64.sqrt(), 0.5_f64.sqrt())
    } else {
        libm::sincos(rest.to_radians())
    };
    match quadrant as i32 & 3 {
        0 => (s, c),
        1 => (c, -s),
        2 => (-s, -c),
        _ => (-c, s),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quarter_turns_are_exact() {
        let quarter = Affine::rotation_deg(Vec3::new(0.0, 0.0, 90.0));
        assert_eq!(quarter.point(Vec3::X), Vec3::Y);
        assert_eq!(Affine::rotation_deg(Vec3::new(0.0, 0.0, -90.0)).point(Vec3::Y), Vec3::X);
        assert_eq!(Affine::rotation_deg(Vec3::new(360.0, 720.0, -360.0)), Affine::IDENTITY);
    }

    #[test]
    fn rotations_go_about_x_then_y_then_z() {
        // X turns y into z; then Y turns z into x; then Z turns x into y.
        assert_eq!(Affine::rotation_deg(Vec3::splat(90.0)).point(Vec3::Y), Vec3::Y);
        let about_axis = Affine::rotation_about_deg(Vec3::Z, 90.0).unwrap();
        assert_eq!(about_axis.point(Vec3::X), Vec3::Y);
    }

    #[test]
    fn an_inverse_undoes() {
        let m = Affine::from_rows([[2.0, 1.0, 0.0, 5.0], [0.0, 3.0, 1.0, -2.0], [1.0, 0.0, -4.0, 7.0]]);
        let p = Vec3::new(0.3, -0.7, 1.9);
        let q = m.inverse().unwrap().point(m.point(p));
        assert!((p - q).length() < 1e-15);
    }

    #[test]
    fn flat_maps_have_no_inverse() {
        assert_eq!(Affine::scale(Vec3::new(1.0, 0.0, 1.0)).inverse(), None);
        assert!(Affine::scale(Vec3::splat(1e-30)).inverse().is_some(), "small is not flat");
        assert_eq!(Affine::scale(Vec3::new(f64::NAN, 1.0, 1.0)).inverse(), None);
    }
}
