//! Solids in words.

use octrace::model::Node;
use octrace::{Affine, BoolOp, Primitive, Profile, Solid};
use std::fmt::Write;

/// A solid in words, on one line.
pub fn describe(solid: &Solid) -> String {
    let mut out = String::new();
    write_solid(solid, &mut out);
    out
}

fn write_solid(solid: &Solid, out: &mut String) {
    match solid.node() {
        Node::Empty => out.push_str("empty"),
        Node::Primitive(primitive) => match primitive {
            Primitive::Block => out.push_str("block"),
            Primitive::Sphere => out.push_str("sphere"),
            Primitive::Cylinder => out.push_str("cylinder"),
            Primitive::HalfSpace => out.push_str("halfspace"),
            Primitive::Cone { top } => write!(out, "cone({top})").expect("strings take all"),
            Primitive::Torus { minor } => write!(out, "torus({minor})").expect("strings take all"),
            Primitive::Prism { profile, top } => {
                write!(out, "prism({} edges, top {top})", edges(profile)).expect("strings take all");
            }
            Primitive::Revolution(profile) => {
                write!(out, "revolution({} edges)", edges(profile)).expect("strings take all");
            }
            Primitive::Polyhedron(p) => {
                write!(out, "polyhedron({} points, {} faces)", p.points().len(), p.faces().len())
                    .expect("strings take all");
            }
        },
        Node::Transform(map, child) => {
            write_map(map, out);
            write_solid(child, out);
        }
        Node::Part(id, child) => {
            write!(out, "part {}: ", id.0).expect("strings take all");
            write_solid(child, out);
        }
        Node::Combine(op, children) => {
            out.push_str(match op {
                BoolOp::Union => "union(",
                BoolOp::Intersection => "intersection(",
                BoolOp::Difference => "difference(",
            });
            for (i, child) in children.iter().enumerate() {
                out.push_str(if i > 0 { ", " } else { "" });
                write_solid(child, out);
            }
            out.push(')');
        }
    }
}

fn edges(profile: &Profile) -> usize {
    profile.contours().iter().map(Vec::len).sum()
}

fn write_map(map: &Affine, out: &mut String) {
    let [x, y, z] = map.rows.map(|r| r.to_array());
    let t = map.translation.to_array();
    if [x[1], x[2], y[0], y[2], z[0], z[1]] == [0.0; 6] {
        write!(out, "[{} {} {}]", x[0], y[1], z[2]).expect("strings take all");
    } else {
        write!(out, "[{x:?} {y:?} {z:?}]").expect("strings take all");
    }
    if t != [0.0; 3] {
        write!(out, "+[{} {} {}]", t[0], t[1], t[2]).expect("strings take all");
    }
    out.push(' ');
}
