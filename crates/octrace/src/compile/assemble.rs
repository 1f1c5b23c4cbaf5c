//! From lowered programs to a catalogue: coincident surfaces become one, copies get their numbers.

use super::copies::{Copies, Kind, plan};
use super::intern::intern;
use super::lower::{Lowering, PendingLiteral, PendingMesh, Shape};
use super::prototype::{Numbers, Prototype};
use super::{Catalog, CompileReport, Constant, Literal, Program, Word};
use crate::exec::{CancelToken, Cancelled};
use crate::geom::{Affine, Bounds};
use crate::model::Solid;
use crate::primitive::{Mesh, MeshPlane, MovedFace, SurfaceRef};
use crate::surface::{Placed, Plane, Surface};
use std::sync::Arc;

/// Everything about some bodies that does not depend on where one looks.
#[derive(Clone, Debug)]
pub struct Compiled {
    /// What the programs refer to.
    pub catalog: Catalog,
    /// A program for each body.
    pub bodies: Vec<Program>,
    /// What joining coincident surfaces did.
    pub report: CompileReport,
}

/// Compiles bodies that share their surfaces. `snap` is the import tolerance relative to the size of everything bounded.
///
/// # Panics
/// If there are more than 2³⁰ uses of surfaces.
pub fn compile(bodies: &[Solid], snap: f64, copies: Copies) -> Compiled {
    compile_unless_cancelled(bodies, snap, copies, &CancelToken::new()).expect("nobody can cancel")
}

/// As [`compile`].
///
/// # Errors
/// If somebody cancels.
///
/// # Panics
/// As [`compile`] does.
pub fn compile_unless_cancelled(
    bodies: &[Solid],
    snap: f64,
    copies: Copies,
    cancel: &CancelToken,
) -> Result<Compiled, Cancelled> {
    let mut lowering = Lowering::new(snap, cancel);
    let plan = if copies == Copies::Shared { plan(bodies, snap, cancel) } else { None };
    let (mut programs, kinds): (Vec<Program>, Vec<Kind>) = match plan {
        None => (bodies.iter().map(|body| lowering.program_of(body, &Affine::IDENTITY)).collect(), Vec::new()),
        Some(plan) => {
            let programs = plan.bodies().map(|body| lowering.program_of_union(body, &plan.kinds)).collect();
            (programs, plan.kinds)
        }
    };
    cancel.check()?;
    let extent = programs.iter().fold(Bounds::EMPTY, |all, program| all.union(program.bounds));
    let mut catalog = Catalog { leaves: std::mem::take(&mut lowering.leaves), ..Catalog::default() };
    let mut report = CompileReport::default();
    for (number, kind) in kinds.into_iter().enumerate() {
        // As tolerant as the scene; rounding is that of the solid by itself.
        let snap = snap * extent.diagonal() / kind.program.bounds.diagonal();
        let first_leaf =
            lowering.copies.iter().find(|copy| copy.kind as usize == number).map_or(0, |copy| copy.first_leaf);
        report = report.and(add_prototype(kind, first_leaf, snap, &mut catalog)?);
    }
    let copies = place_copies(&lowering, 2.0 * snap * extent.diagonal(), &mut catalog);
    report = report.and(settle(&lowering, &mut programs, (&extent, snap), &copies, 0, &mut catalog)?);
    assert!(catalog.literals.len() <= Word::MAX_PAYLOAD as usize, "a program has room for 2^30 uses of surfaces");
    number_copies(&mut catalog);
    Ok(Compiled { catalog, bodies: programs, report })
}

/// Gives the literals of some programs their surfaces, all in the catalogue behind what is there. `copies` are the surfaces
/// of copies; leaves are counted from `first_leaf` on.
fn settle(
    lowering: &Lowering,
    programs: &mut [Program],
    (extent, snap): (&Bounds, f64),
    copies: &[u32],
    first_leaf: u32,
    catalog: &mut Catalog,
) -> Result<CompileReport, Cancelled> {
    let cancel = lowering.cancel();
    let (refs, report) = intern(&lowering.faces, extent, snap, &mut catalog.surfaces, cancel)?;
    let build =
        |pending: &PendingMesh| cancel.check().map(|()| pending.build(&refs, report.tolerance, &mut catalog.surfaces));
    let meshes = lowering.meshes.iter().map(build).collect::<Result<Vec<SurfaceRef>, Cancelled>>()?;
    let surface_of = |literal: &PendingLiteral| match literal.shape {
        Shape::Face(face) => refs[face as usize],
        Shape::Mesh(mesh) => meshes[mesh as usize],
        Shape::Copy(copy) => SurfaceRef { surface: copies[copy as usize], flipped: false },
    };
    let literals = &lowering.literals;
    let first = catalog.literals.len() as u32;
    let literal = |l: &PendingLiteral| Literal { surface: surface_of(l).surface, leaf: first_leaf + l.leaf };
    catalog.literals.extend(literals.iter().map(literal));

    for program in programs {
        // What joining surfaces does to solids goes by in the room that is left around them, but where it is coarse.
        let slack = 2.0 * report.tolerance;
        if slack > 1e-4 * program.bounds.size().max_abs() {
            program.bounds = program.bounds.grown(slack);
        }
        // Faces stored the other way round turn their literals' signs.
        for part in [&mut program.whole, &mut program.outer] {
            let Constant::Words(words) = part else { continue };
            for word in words {
                if let Word::Literal { index, negated } = Word::decode(*word) {
                    let flipped = surface_of(&literals[index as usize]).flipped;
                    *word = Word::Literal { index: first + index, negated: negated ^ flipped }.encode();
                }
            }
        }
    }
    Ok(report)
}

impl PendingMesh {
    fn build(&self, refs: &[SurfaceRef], tolerance: f64, surfaces: &mut Vec<Surface>) -> SurfaceRef {
        let mut faces = refs[self.first_face..].iter().copied();
        let mut next = |_: &MovedFace| faces.next().expect("the same faces have an area as before");
        let mesh = Mesh::new(&self.polyhedron, &self.map, tolerance, &mut next);
        let mut mesh = mesh.expect("lowered only where a face has an area");
        mesh.keep_planes(|surface| match &surfaces[surface as usize] {
            &Surface::Plane(Plane { normal, offset }) => MeshPlane { normal, offset },
            _ => unreachable!("planes have planes for surfaces"),
        });
        let surface = surfaces.len() as u32;
        surfaces.push(Surface::Mesh(Arc::new(mesh)));
        SurfaceRef { surface, flipped: false }
    }
}

/// Adds a solid that has copies.
fn add_prototype(kind: Kind, first_leaf: u32, snap: f64, catalog: &mut Catalog) -> Result<CompileReport, Cancelled> {
    let Kind { lowering, program } = kind;
    let (first_surface, first_literal) = (catalog.surfaces.len() as u32, catalog.literals.len() as u32);
    let bounds = program.bounds;
    let mut programs = [program];
    let report = settle(&lowering, &mut programs, (&bounds, snap), &[], first_leaf, catalog)?;
    let [program] = programs;
    let row = |first: u32, end: usize| Numbers { first, count: end as u32 - first, copies_from: 0 };
    catalog.prototypes.push(Prototype {
        program,
        literals: row(first_literal, catalog.literals.len()),
        surfaces: row(first_surface, catalog.surfaces.len()),
        leaves: lowering.leaves.len() as u32,
        first_leaf,
        first_placed: 0,
        copies: 0,
    });
    Ok(report)
}

/// Adds the surfaces that are copies, those of one solid in a row; returns their numbers. What is in a copy may reach beyond
/// its box by `slack`.
fn place_copies(lowering: &Lowering, slack: f64, catalog: &mut Catalog) -> Vec<u32> {
    let Catalog { surfaces, prototypes, .. } = catalog;
    for copy in &lowering.copies {
        prototypes[copy.kind as usize].copies += 1;
    }
    let mut first = surfaces.len() as u32;
    let mut next = Vec::with_capacity(prototypes.len());
    for prototype in prototypes.iter_mut() {
        prototype.first_placed = first;
        next.push(first);
        first += prototype.copies;
    }
    let numbers: Vec<u32> = lowering
        .copies
        .iter()
        .map(|copy| {
            let next = &mut next[copy.kind as usize];
            *next += 1;
            *next - 1
        })
        .collect();
    let mut placed = vec![None; numbers.len()];
    let start = surfaces.len();
    for (copy, &number) in lowering.copies.iter().zip(&numbers) {
        placed[number as usize - start] = Some(Placed {
            bounds: copy.bounds.grown(slack),
            offset: copy.offset,
            prototype: copy.kind,
            copy: number - prototypes[copy.kind as usize].first_placed,
            first_leaf: copy.first_leaf,
        });
    }
    surfaces.extend(placed.into_iter().flatten().map(Surface::Placed));
    numbers
}

/// Numbers what copies have beyond the catalogue.
fn number_copies(catalog: &mut Catalog) {
    let (mut literals, mut surfaces) = (catalog.literals.len() as u32, catalog.surfaces.len() as u32);
    for prototype in &mut catalog.prototypes {
        for (numbers, next) in [(&mut prototype.literals, &mut literals), (&mut prototype.surfaces, &mut surfaces)] {
            numbers.copies_from = *next;
            *next += numbers.count * prototype.copies;
        }
    }
}
