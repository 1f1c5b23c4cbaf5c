//! Prisms and bodies of revolution: the formula of the profile, with every line and circle swept to a surface.
//!
//! Unlike other primitives they are no intersections of their surfaces. A line sweeps a plane, a cylinder or a nappe of a
//! cone; a circle a cylinder, a cone, a sphere or a torus. The formula holds in the plane of the profile wherever it is
//! swept to, so it holds in space.

use super::draft::{Op, Opened, Value};
use super::faces::FaceList;
use super::lower::{Lowering, PendingLiteral, Shape};
use crate::geom::{Affine, Vec2, Vec3};
use crate::primitive::{Join, Outline, Primitive, Profile, Step};
use crate::surface::{QuadricKind, TorusKind};

/// Where a profile is swept.
pub(super) struct Swept<'a> {
    pub map: &'a Affine,
    pub inverse: Affine,
    pub leaf: u32,
    /// Whether the complement is wanted.
    pub negated: bool,
}

/// What a line or a circle of the profile becomes.
trait Sweep {
    /// Writes what a line's left side or a circle's inside sweeps, or the complement of that.
    fn write(&self, step: &Step, writer: &mut Writer) -> Value;

    /// Writes lines around an outline where its formula needs them.
    fn frame(&self, outline: &Outline) -> Vec<Step>;
}

impl Lowering {
    /// A prism of height 1, whose profile is scaled to `top` on the way up.
    pub(super) fn prism(&mut self, profile: &Profile, top: f64, swept: &Swept) -> Value {
        let mut writer = Writer { lowering: self, swept, complement: swept.negated };
        let mut all = writer.open(Op::And);
        let (low, high) = profile.bounds();
        for (z, scale, normal) in [(0.0, 1.0, -Vec3::Z), (1.0, top, Vec3::Z)] {
            // At a pointed end the plane only closes what is known as well as the rest.
            let scale = if scale > 0.0 { scale } else { 1.0 };
            let corners = [(low.x, low.y), (high.x, low.y), (high.x, high.y), (low.x, high.y)]
                .map(|(x, y)| Vec3::new(x * scale, y * scale, z));
            all.add(writer.face(true, |faces| faces.plane(normal, corners)));
        }
        all.add(writer.profile(profile, &Up { top }));
        writer.lowering.whole.close(all)
    }

    /// What the profile's part to the right of its y axis sweeps around the z axis.
    pub(super) fn revolution(&mut self, profile: &Profile, swept: &Swept) -> Value {
        Writer { lowering: self, swept, complement: swept.negated }.profile(profile, &Around)
    }
}

/// Writes one primitive's program.
struct Writer<'a> {
    lowering: &'a mut Lowering,
    swept: &'a Swept<'a>,
    /// Whether the complement of what comes is to be written.
    complement: bool,
}

impl Writer<'_> {
    fn open(&mut self, op: Op) -> Opened {
        self.lowering.whole.open(op.under(self.complement))
    }

    fn close(&mut self, opened: Opened) -> Value {
        self.lowering.whole.close(opened)
    }

    fn constant(&self, inside: bool) -> Value {
        Value::Constant(inside != self.complement)
    }

    /// A literal for the face that `add` adds, if it adds one: its inside or its outside.
    fn face(&mut self, inside: bool, add: impl FnOnce(&mut FaceList)) -> Value {
        let Lowering { faces, literals, whole, .. } = &mut *self.lowering;
        let face = faces.len() as u32;
        add(&mut FaceList { map: self.swept.map, inverse: self.swept.inverse, faces });
        if faces.len() as u32 == face {
            // Too thin for numbers.
            return Value::Constant(inside == self.complement);
        }
        let index = literals.len() as u32;
        literals.push(PendingLiteral { shape: Shape::Face(face), leaf: self.swept.leaf });
        whole.literal(index, inside == self.complement)
    }

    fn profile(&mut self, profile: &Profile, sweep: &impl Sweep) -> Value {
        let mut any = self.open(Op::Or);
        for island in profile.islands() {
            let mut all = self.open(Op::And);
            all.add(self.outline(&island.outer, sweep));
            for hole in &island.holes {
                self.complement = !self.complement;
                all.add(self.outline(hole, sweep));
                self.complement = !self.complement;
            }
            any.add(self.close(all));
        }
        self.close(any)
    }

    fn outline(&mut self, outline: &Outline, sweep: &impl Sweep) -> Value {
        let mut all = self.open(Op::And);
        for step in sweep.frame(outline) {
            all.add(sweep.write(&step, self));
        }
        let mut opened = vec![all];
        for step in &outline.steps {
            let value = match step {
                Step::Open(join) => {
                    opened.push(self.open(if *join == Join::All { Op::And } else { Op::Or }));
                    continue;
                }
                Step::Close => match opened.pop() {
                    Some(inner) => self.close(inner),
                    None => continue,
                },
                step => sweep.write(step, self),
            };
            if let Some(operator) = opened.last_mut() {
                operator.add(value);
            }
        }
        match opened.pop() {
            Some(all) => self.close(all),
            None => self.constant(true),
        }
    }
}

/// Upwards, and towards the axis.
struct Up {
    top: f64,
}

impl Sweep for Up {
    fn write(&self, step: &Step, writer: &mut Writer) -> Value {
        let top = self.top;
        match *step {
            Step::Left(from, to) => {
                let out = -(to - from).left();
                // The plane's equation is that of the line, scaled by 1 - (1 - top) z.
                let normal = Vec3::new(out.x, out.y, out.dot(from) * (1.0 - top));
                let at = |p: Vec2, scale: f64, z: f64| Vec3::new(p.x * scale, p.y * scale, z);
                let corners = [at(from, 1.0, 0.0), at(to, 1.0, 0.0), at(to, top, 1.0), at(from, top, 1.0)];
                writer.face(true, |faces| faces.plane(normal, corners))
            }
            Step::Disc { center, radius, inside } => writer.face(inside, |faces| {
                let across = Vec3::new(radius, 0.0, center.x);
                let along = Vec3::new(0.0, radius, center.y);
                if top < 1.0 {
                    // The cone's own z is the scale.
                    let slope = 1.0 - top;
                    let rows = [across, along, Vec3::new(0.0, 0.0, -1.0 / slope)];
                    let placed = Affine { rows, translation: Vec3::new(0.0, 0.0, 1.0 / slope) };
                    faces.quadric(QuadricKind::Cone, &placed, (1.0, (1.0 + top) / 2.0));
                } else {
                    let placed = Affine {
                        translation: Vec3::new(center.x, center.y, 0.0),
                        ..Affine::scale(Vec3::new(radius, radius, 1.0))
                    };
                    faces.quadric(QuadricKind::Cylinder, &placed, (0.0, 1.0));
                }
            }),
            Step::Open(_) | Step::Close => writer.constant(true),
        }
    }

    fn frame(&self, outline: &Outline) -> Vec<Step> {
        if outline.is_convex { Vec::new() } else { outline.frame.map(|(from, to)| Step::Left(from, to)).to_vec() }
    }
}

/// Around the z axis: x is the distance from it, y is z.
struct Around;

impl Sweep for Around {
    fn write(&self, step: &Step, writer: &mut Writer) -> Value {
        match *step {
            Step::Left(from, to) => line_around(from, to, writer),
            Step::Disc { center, radius, inside } => circle_around(center, radius, inside, writer),
            Step::Open(_) | Step::Close => writer.constant(true),
        }
    }

    fn frame(&self, outline: &Outline) -> Vec<Step> {
        if outline.is_convex { Vec::new() } else { outline.frame.map(|(from, to)| Step::Left(from, to)).to_vec() }
    }
}

/// Of lines and circles, what is less than this part of the rest is rounding.
const NOTHING: f64 = 1e-13;

fn line_around(from: Vec2, to: Vec2, writer: &mut Writer) -> Value {
    let along = to - from;
    if along.x.abs() <= NOTHING * from.x.abs().max(to.x.abs()) {
        // Along the axis: what is nearer to it, or what is farther.
        let radius = from.x + along.x / 2.0;
        let inside = along.y > 0.0;
        if radius <= 0.0 || along.y == 0.0 {
            return writer.constant(!inside);
        }
        let placed = Affine::scale(Vec3::new(radius, radius, 1.0));
        return writer.face(inside, |faces| faces.quadric(QuadricKind::Cylinder, &placed, (from.y, to.y)));
    }
    if along.y.abs() <= NOTHING * NOTHING * along.x.abs() {
        let (z, radius) = (from.y, from.x.abs().max(to.x.abs()));
        let normal = if along.x > 0.0 { -Vec3::Z } else { Vec3::Z };
        return writer.face(true, |faces| faces.cap(normal, radius, z));
    }
    // A nappe of the cone with that generator: rho < slope (z - apex).
    let slope = along.x / along.y;
    let apex = from.y - from.x / slope;
    let inside = along.y > 0.0;
    let placed =
        Affine { translation: Vec3::new(0.0, 0.0, apex), ..Affine::scale(Vec3::new(slope.abs(), slope.abs(), 1.0)) };
    let mut nappe = writer.open(if inside { Op::And } else { Op::Or });
    nappe.add(writer.face(inside, |faces| {
        faces.quadric(QuadricKind::Cone, &placed, (from.y - apex, to.y - apex));
    }));
    // The plane only parts the nappes; it is known as well as the cone.
    let size = from.x.abs().max(to.x.abs());
    let normal = if slope > 0.0 { -Vec3::Z } else { Vec3::Z };
    nappe.add(writer.face(inside, |faces| faces.cap(normal, size, apex)));
    writer.close(nappe)
}

fn circle_around(center: Vec2, radius: f64, inside: bool, writer: &mut Writer) -> Value {
    let at = |scale: f64| Affine { translation: Vec3::new(0.0, 0.0, center.y), ..Affine::scale(Vec3::splat(scale)) };
    let off = center.x.abs();
    if off <= NOTHING * radius {
        return writer.face(inside, |faces| faces.quadric(QuadricKind::Sphere, &at(radius), (-1.0, 1.0)));
    }
    let minor = radius / off;
    let kind = if center.x > 0.0 { TorusKind::Outer } else { TorusKind::Inner };
    if minor < 1.0 / Primitive::LONGEST || (kind == TorusKind::Inner && minor <= 1.0) {
        return writer.constant(!inside);
    }
    writer.face(inside, |faces| faces.torus(kind, minor, &at(off)))
}
