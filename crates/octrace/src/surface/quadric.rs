//! Quadrics: ellipsoids, elliptic cylinders and elliptic cones.

use super::{CellBox, Crossings, Side};
use crate::geom::{Affine, Ray, Vec3};

/// Which quadric, in its own coordinates.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum QuadricKind {
    /// `x² + y² + z² < 1`
    Sphere,
    /// `x² + y² < 1`
    Cylinder,
    /// `x² + y² < z²`, both nappes
    Cone,
}

/// A quadric, given by the affine map from scene space into the coordinates in which it is simple.
///
/// Rays are taken into those coordinates by the inverse matrix [Roth 1982; Comba-Persiano, §2.2], which keeps their
/// parameters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quadric {
    /// Which quadric.
    pub kind: QuadricKind,
    /// From scene space to the quadric's own coordinates.
    pub to_local: Affine,
}

impl QuadricKind {
    /// `(s, c)` of the common equation `f = x² + y² + s z² + c < 0`.
    pub(crate) fn coefficients(self) -> (f64, f64) {
        match self {
            Self::Sphere => (1.0, -1.0),
            Self::Cylinder => (0.0, -1.0),
            Self::Cone => (-1.0, 0.0),
        }
    }

    /// What a square, or a product, of z coordinates counts in the equation.
    #[inline(always)]
    fn of_z(self, product: f64) -> f64 {
        match self {
            Self::Sphere => product,
            Self::Cylinder => 0.0,
            Self::Cone => -product,
        }
    }

    /// Where the line `o + t d` crosses the quadric, all in its own coordinates.
    fn crossings(self, o: Vec3, d: Vec3) -> Crossings {
        let (_, c0) = self.coefficients();
        // f(o + t d) = a t² + 2 b t + c.
        let a = d.x * d.x + d.y * d.y + self.of_z(d.z * d.z);
        let b = o.x * d.x + o.y * d.y + self.of_z(o.z * d.z);
        let c = o.x * o.x + o.y * o.y + self.of_z(o.z * o.z) + c0;
        if a == 0.0 {
            return if b == 0.0 { Crossings::none(c < 0.0) } else { Crossings::one(b > 0.0, -c / (2.0 * b)) };
        }
        // b² - a c, without the cancellation that far origins cause: by Lagrange's identity the quartic parts are the
        // square of the cross product.
        let m = o.cross(d);
        let discriminant = -c0 * a - (m.z * m.z + self.of_z(m.x * m.x + m.y * m.y));
        if !(discriminant > 0.0 && discriminant.is_finite()) {
            // f keeps its sign: that of the direction's own value a as well as that of the origin's value c. Rounding may
            // part the two, for lines parallel to a cone's generator above all. The clearer one tells.
            let by_direction = a.abs() * o.dot(o) >= c.abs() * d.dot(d);
            return Crossings::none(if by_direction { a < 0.0 } else { c < 0.0 });
        }
        let root = discriminant.sqrt();
        let q = if b > 0.0 { -b - root } else { root - b };
        Crossings::two(a < 0.0, q / a, c / q)
    }
}

impl Quadric {
    /// See [`Surface::crossings`](super::Surface::crossings). A line that only touches is outside (of a cone, where it
    /// comes from inside: inside).
    pub fn crossings(&self, ray: &Ray) -> Crossings {
        let o = self.to_local.point(ray.origin);
        let d = self.to_local.vector(ray.direction);
        let nearest = -o.dot(d) / d.dot(d);
        // Near its apex a cone is so flat, compared to the squares of far coordinates, that their roundings would move it.
        // So the line is followed from where it is nearest to the apex.
        match self.kind == QuadricKind::Cone && nearest.is_finite() {
            true => self.kind.crossings(o + d * nearest, d).shifted(nearest),
            false => self.kind.crossings(o, d),
        }
    }

    /// See [`Surface::classify`](super::Surface::classify).
    ///
    /// In local coordinates the cell is a parallelepiped `q + sum u_i e_i`, `|u_i| <= 1`. Two enclosures of `f` over it
    /// are intersected: interval arithmetic on the coordinates, good for large cells, and the mean value form
    /// `f(q) + grad f(q) . delta + delta S delta`, good for small ones. What rounding does to the coordinates is no shift
    /// within that parallelepiped, and comes on top.
    pub fn classify(&self, cell: &CellBox) -> Side {
        let (s, c0) = self.kind.coefficients();
        let q = self.to_local.point(cell.center);
        let rows = &self.to_local.rows;
        let (reach, rounding) = cell.reach(rows);
        // Smallest and largest square over an interval about `m`.
        let square = |m: f64, r: f64| {
            let (near, far) = ((m.abs() - r).max(0.0), m.abs() + r);
            (near * near, far * far)
        };
        let (x, y, z) = (square(q.x, reach.x), square(q.y, reach.y), square(q.z, reach.z));
        let sz = if s < 0.0 { (-z.1, -z.0) } else { (s * z.0, s * z.1) };
        let coarse = (x.0 + y.0 + sz.0 + c0, x.1 + y.1 + sz.1 + c0);

        let value = q.x * q.x + q.y * q.y + s * (q.z * q.z) + c0;
        let slope = self.to_local.transposed_vector(Vec3::new(2.0 * q.x, 2.0 * q.y, 2.0 * s * q.z));
        let linear = slope.abs().dot(cell.half) + 2.0 * q.abs().dot(rounding);
        let bulge = reach.x * reach.x + reach.y * reach.y;
        let (bulge_low, bulge_high) = match self.kind {
            QuadricKind::Sphere => (0.0, bulge + reach.z * reach.z),
            QuadricKind::Cylinder => (0.0, bulge),
            QuadricKind::Cone => (-(reach.z * reach.z), bulge),
        };
        let fine = (value - linear + bulge_low, value + linear + bulge_high);

        if coarse.0.max(fine.0) >= 0.0 {
            Side::Outside
        } else if coarse.1.min(fine.1) <= 0.0 {
            Side::Inside
        } else {
            Side::Crossing
        }
    }

    /// See [`Surface::gradient`](super::Surface::gradient).
    pub fn gradient(&self, p: Vec3) -> Vec3 {
        let (s, _) = self.kind.coefficients();
        let q = self.to_local.point(p);
        self.to_local.transposed_vector(Vec3::new(2.0 * q.x, 2.0 * q.y, 2.0 * s * q.z))
    }

    /// See [`Surface::distance`](super::Surface::distance).
    pub fn distance(&self, p: Vec3) -> f64 {
        let (s, c0) = self.kind.coefficients();
        let q = self.to_local.point(p);
        let value = q.x * q.x + q.y * q.y + s * (q.z * q.z) + c0;
        let slope = self.gradient(p).length();
        if value == 0.0 { 0.0 } else { value.abs() / slope }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn unit(kind: QuadricKind) -> Quadric {
        Quadric { kind, to_local: Affine::IDENTITY }
    }

    #[test]
    fn a_sphere_is_crossed_twice_or_not() {
        let sphere = unit(QuadricKind::Sphere);
        let through = sphere.crossings(&Ray::new([-5.0, 0.0, 0.0], [1.0, 0.0, 0.0]));
        assert_eq!((through.starts_inside(), through.params()), (false, &[4.0, 6.0][..]));
        let tangent = sphere.crossings(&Ray::new([-5.0, 1.0, 0.0], [1.0, 0.0, 0.0]));
        assert_eq!(tangent, Crossings::none(false));
    }

    #[test]
    fn a_line_along_the_axis_stays_in_the_cylinder() {
        let cylinder = unit(QuadricKind::Cylinder);
        assert_eq!(cylinder.crossings(&Ray::new([0.5, 0.0, 9.0], [0.0, 0.0, -2.0])), Crossings::none(true));
        assert_eq!(cylinder.crossings(&Ray::new([1.5, 0.0, 9.0], [0.0, 0.0, -2.0])), Crossings::none(false));
    }

    #[test]
    fn a_cone_is_crossed_as_its_slope_says() {
        let cone = unit(QuadricKind::Cone);
        let across = cone.crossings(&Ray::new([-3.0, 0.0, 1.0], [1.0, 0.0, 0.0]));
        assert_eq!((across.starts_inside(), across.params()), (false, &[2.0, 4.0][..]));
        let along = cone.crossings(&Ray::new([0.5, 0.0, -9.0], [0.0, 0.0, 1.0]));
        assert_eq!((along.starts_inside(), along.params()), (true, &[8.5, 9.5][..]));
        let generator = cone.crossings(&Ray::new([1.0, 0.0, 0.0], [1.0, 0.0, 1.0]));
        assert_eq!(generator.params().len(), 1);
    }

    #[test]
    fn a_line_beside_a_cone_and_parallel_to_its_side_stays_outside() {
        // All of these lie in tangent planes: a and b are zero, but for rounding, and c is not.
        for angle in 0..360 {
            let (sin, cos) = crate::geom::sin_cos_deg(f64::from(angle));
            let turn = Affine::rotation_deg(Vec3::new(0.0, 0.0, f64::from(angle)));
            let cone = Quadric { kind: QuadricKind::Cone, to_local: turn };
            for beside in [-1.5, 0.7] {
                let ray = Ray::new([-sin * beside, cos * beside, 0.0], [cos, sin, 1.0]);
                let crossings = cone.crossings(&ray);
                assert!(crossings.params().iter().all(|t| t.abs() > 1e6), "{crossings:?}");
                let here = crossings.params().iter().filter(|&&t| t < 0.0).count() % 2 == 1;
                assert!(!(crossings.starts_inside() ^ here), "{crossings:?}");
            }
        }
    }

    #[test]
    fn classification_is_right_for_cells_in_and_out() {
        let sphere = unit(QuadricKind::Sphere);
        let cell = |x: f64, h: f64| CellBox::new(Vec3::new(x, 0.0, 0.0), Vec3::splat(h));
        assert_eq!(sphere.classify(&cell(0.0, 0.5)), Side::Inside);
        assert_eq!(sphere.classify(&cell(0.0, 0.6)), Side::Crossing);
        assert_eq!(sphere.classify(&cell(2.0, 0.9)), Side::Outside);
        assert_eq!(sphere.classify(&cell(0.0, 9.0)), Side::Crossing);
    }
}
