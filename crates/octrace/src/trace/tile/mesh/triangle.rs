//! Eight lines and one triangle of a mesh: what [`Mesh`] finds for one line, operation for operation.

use crate::geom::{Ray, Vec3};
use crate::primitive::{Mesh, MeshPlane, MeshTriangle, TINY, UNCERTAIN};
use crate::surface::Plane;
use crate::trace::tile::crossing::{Rays, plane};
use crate::trace::tile::lanes::{F64s, Isa, LANES, Mask, Number, Vector};

/// Lines whose directions have the same longest axis and the same signs, seen along that axis; as `Line` of the mesh.
pub(super) struct Lines<I: Isa, N> {
    /// The lanes that it is about.
    pub lanes: Mask<I>,
    pub rays: Rays<I, N>,
    /// Where they start.
    origin: [N; 3],
    direction: [F64s<I>; 3],
    /// Axes of the picture, and the axis along which to look.
    axes: [usize; 3],
    shear: [F64s<I>; 2],
    /// The signs of the directions, a bit for each that is negative.
    pub signs: usize,
}

/// Where lines pass through a triangle.
pub(super) struct Hits<I: Isa> {
    pub lanes: Mask<I>,
    pub entering: Mask<I>,
    pub t: F64s<I>,
}

impl<I: Isa, N: Number<I>> Lines<I, N> {
    /// Those of `lanes`, of which there are some, that go as the first of them does.
    #[inline(always)]
    pub fn of(rays: Rays<I, N>, lanes: u8) -> Self {
        let Rays { origin, direction } = rays;
        let (x, y, z) = (direction.x.abs(), direction.y.abs(), direction.z.abs());
        // As `Vec3::largest_axis`.
        let along_x = (x.ge(y) & x.ge(z)).bits();
        let along_y = y.ge(z).bits() & !along_x;
        let negative = [direction.x.signs(), direction.y.signs(), direction.z.signs()];
        let first = lanes & lanes.wrapping_neg();
        let alike = |bits: u8| if bits & first == 0 { !bits } else { bits };
        let mut same = lanes & alike(along_x) & alike(along_y);
        let mut signs = 0;
        for (axis, &negative) in negative.iter().enumerate() {
            same &= alike(negative);
            signs |= usize::from(negative & first != 0) << axis;
        }
        let along = match (along_x & first != 0, along_y & first != 0) {
            (true, _) => 0,
            (false, true) => 1,
            (false, false) => 2,
        };
        let (mut u, mut v) = ((along + 1) % 3, (along + 2) % 3);
        if signs >> along & 1 != 0 {
            (u, v) = (v, u);
        }
        let origin = [origin.x, origin.y, origin.z];
        let direction = [direction.x, direction.y, direction.z];
        let shear = [direction[u] / direction[along], direction[v] / direction[along]];
        Self { lanes: Mask::from_bits(same), rays, origin, direction, axes: [u, v, along], shear, signs }
    }

    /// Where a point appears in the picture.
    #[inline(always)]
    fn project(&self, p: Vec3) -> [F64s<I>; 2] {
        let [u, v, w] = self.axes;
        let from = |axis: usize| (N::from_one(p[axis]) - self.origin[axis]).lanes();
        let along = from(w);
        [from(u) - self.shear[0] * along, from(v) - self.shear[1] * along]
    }

    /// Which of some lines pass through a triangle, and which go in there.
    #[inline(always)]
    pub fn crosses(&self, mesh: &Mesh, triangle: &MeshTriangle) -> (Mask<I>, Mask<I>) {
        let corners = mesh.corners(triangle);
        let [a, b, c] = [self.project(corners[0]), self.project(corners[1]), self.project(corners[2])];
        // What is tiny is zero.
        let (over, under) = (F64s::<I>::splat(TINY), F64s::<I>::splat(-TINY));
        let right = a[0].ge(over) & b[0].ge(over) & c[0].ge(over);
        let left = a[0].le(under) & b[0].le(under) & c[0].le(under);
        let above = a[1].ge(over) & b[1].ge(over) & c[1].ge(over);
        let below = a[1].le(under) & b[1].le(under) & c[1].le(under);
        let near = self.lanes & !(right | left | above | below);
        if !near.any() {
            return (near, near);
        }
        let [a, b, c] = [without_tiny(a), without_tiny(b), without_tiny(c)];
        let (ab, ab_unsure) = side(a, b);
        let (bc, bc_unsure) = side(b, c);
        let (ca, ca_unsure) = side(c, a);
        let unsure = near & (ab_unsure | bc_unsure | ca_unsure);
        let mut hits = near & !(ab ^ bc) & !(ab ^ ca);
        let mut entering = !ab;
        if unsure.any() {
            let (found, goes_in) = self.decide(mesh, triangle, unsure.bits());
            let (unsure, goes_in) = (unsure.bits(), goes_in);
            hits = Mask::from_bits(hits.bits() & !unsure | found);
            entering = Mask::from_bits(entering.bits() & !unsure | goes_in);
        }
        (hits, entering)
    }

    /// What cannot be told without exact arithmetic.
    #[cold]
    #[inline(never)]
    fn decide(&self, mesh: &Mesh, triangle: &MeshTriangle, lanes: u8) -> (u8, u8) {
        let (mut found, mut entering) = (0, 0);
        for lane in (0..LANES).filter(|lane| lanes >> lane & 1 != 0) {
            if let Some(goes_in) = mesh.crosses(&self.ray(lane), triangle) {
                found |= 1 << lane;
                entering |= u8::from(goes_in) << lane;
            }
        }
        (found, entering)
    }

    fn ray(&self, lane: usize) -> Ray {
        let at = |v: [F64s<I>; 3]| Vec3::from(v.map(|v| v.stored().0[lane]));
        Ray { origin: at(self.origin.map(Number::lanes)), direction: at(self.direction) }
    }

    /// Where lines that pass through the triangle at a place of the tree do so.
    #[inline(always)]
    pub fn parameters(&self, mesh: &Mesh, place: usize) -> F64s<I> {
        let corners = mesh.corners(&mesh.triangles()[place]);
        let (low, high) = self.reach(corners, mesh.slack());
        let (low, high) = self.within(corners, mesh.slack(), (low, high));
        let middle = low + F64s::splat(0.5) * (high - low);
        let MeshPlane { normal, offset } = mesh.plane(place);
        let t = plane(&Plane { normal, offset }, &self.rays).a;
        t.is_finite().select(t.max(low).min(high), middle) + F64s::zero()
    }

    /// The parameters for which the lines are in the triangle's box.
    #[inline(always)]
    fn reach(&self, [a, b, c]: [Vec3; 3], slack: f64) -> (F64s<I>, F64s<I>) {
        let along = self.axes[2];
        let (mut low, mut high) = (F64s::<I>::zero(), F64s::<I>::zero());
        for step in 0..3 {
            let axis = (along + step) % 3;
            let (min, max) = (a[axis].min(b[axis]).min(c[axis]), a[axis].max(b[axis]).max(c[axis]));
            let direction = self.direction[axis];
            let from = (N::from_one(min - slack) - self.origin[axis]).lanes() / direction;
            let to = (N::from_one(max + slack) - self.origin[axis]).lanes() / direction;
            let (first, last) = (from.min(to), from.max(to));
            if step == 0 {
                (low, high) = (first, last);
                continue;
            }
            let usual = from.is_finite() & to.is_finite();
            low = usual.select(low.max(first).min(high), low);
            high = usual.select(high.min(last).max(low), high);
        }
        (low, high)
    }

    /// What is left of parameters between the triangle's edges.
    #[inline(always)]
    fn within(&self, corners: [Vec3; 3], slack: f64, (low, high): (F64s<I>, F64s<I>)) -> (F64s<I>, F64s<I>) {
        let (mut low, mut high) = (low, high);
        let normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
        for i in 0..3 {
            let inwards = normal.cross(corners[(i + 1) % 3] - corners[i]);
            let slope = Vector::<F64s<I>>::from_one(inwards).dot(self.rays.direction);
            let from_corner = self.rays.origin.minus::<I>(corners[i]);
            let height = Vector::<N>::from_one(inwards).dot(from_corner) + N::from_one(slack * inwards.length());
            let t = -height.lanes() / slope;
            let (usual, rising) = (t.is_finite(), slope.gt(F64s::zero()));
            low = (usual & rising).select(low.max(t).min(high), low);
            high = (usual & !rising).select(high.min(t).max(low), high);
        }
        (low, high)
    }
}

/// As the mesh has it: decisions are exact as long as no product underflows.
#[inline(always)]
fn without_tiny<I: Isa>([x, y]: [F64s<I>; 2]) -> [F64s<I>; 2] {
    let (tiny, zero) = (F64s::splat(TINY), F64s::zero());
    [x.abs().lt(tiny).select(zero, x), y.abs().lt(tiny).select(zero, y)]
}

/// Whether the origin lies to the left of the way from `a` to `b`, and where that is not certain.
#[inline(always)]
fn side<I: Isa>(a: [F64s<I>; 2], b: [F64s<I>; 2]) -> (Mask<I>, Mask<I>) {
    let (p, q) = (a[0] * b[1], a[1] * b[0]);
    let side = p - q;
    let unsure = side.abs().le(F64s::splat(UNCERTAIN) * (p.abs() + q.abs()));
    (side.gt(F64s::zero()), unsure)
}
