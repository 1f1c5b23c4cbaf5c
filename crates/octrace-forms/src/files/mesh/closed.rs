//! From a mesh to a solid, if its surface is closed.

use super::RawMesh;
use octrace::{Polyhedron, PolyhedronError, Vec3};

/// Why a mesh is not a solid.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SolidError {
    /// The surface has a boundary.
    #[error("the surface is open: {count} of its edges border one face only, one of them from {} to {}", at(.from), at(.to))]
    Open {
        /// How many edges there are at the boundary.
        count: usize,
        /// Where one of them begins.
        from: Vec3,
        /// Where it ends.
        to: Vec3,
    },
    /// The faces cannot be turned so that all agree which side is outside.
    #[error(
        "the faces do not agree which side is outside: at {count} edges no way of turning them fits, at one from {} to {}",
        at(.from), at(.to)
    )]
    Unorientable {
        /// How many such edges there are.
        count: usize,
        /// Where one of them begins.
        from: Vec3,
        /// Where it ends.
        to: Vec3,
    },
    /// The mesh is not one at all, or it encloses nothing.
    #[error(transparent)]
    Unsound(PolyhedronError),
}

impl SolidError {
    /// What the user can do.
    pub fn help(&self) -> Option<&'static str> {
        match self {
            Self::Open { .. } | Self::Unorientable { .. } => {
                Some("close the surface where the file comes from, or try `--repair`")
            }
            Self::Unsound(_) => None,
        }
    }
}

/// A point, for people.
fn at(p: &Vec3) -> String {
    let digits = |x: f64| {
        let rounded = format!("{x:.4}");
        rounded.trim_end_matches('0').trim_end_matches('.').to_string()
    };
    format!("({}, {}, {})", digits(p.x), digits(p.y), digits(p.z))
}

impl RawMesh {
    /// The solid that the mesh bounds. Equal points are joined and faces are turned outwards, see [`Polyhedron::new`].
    ///
    /// # Errors
    /// If the surface is not closed: see [`SolidError`].
    pub fn into_polyhedron(self) -> Result<Polyhedron, SolidError> {
        let points = self.points.clone();
        let corner = |i: u32| points.get(i as usize).copied().unwrap_or_default();
        Polyhedron::new(self.points, self.faces).map_err(|e| match e {
            PolyhedronError::Open { from, to, count, .. } => {
                SolidError::Open { count, from: corner(from), to: corner(to) }
            }
            PolyhedronError::Unorientable { from, to, count, .. } => {
                SolidError::Unorientable { count, from: corner(from), to: corner(to) }
            }
            other => SolidError::Unsound(other),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn open_surfaces_say_where() {
        let points = vec![Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::new(0.0, 0.0, 2.5)];
        let faces = vec![vec![0, 2, 1], vec![0, 1, 3], vec![1, 2, 3]];
        let error = RawMesh { points, faces }.into_polyhedron().unwrap_err();
        let expected =
            "the surface is open: 3 of its edges border one face only, one of them from (0, 0, 0) to (0, 1, 0)";
        assert_eq!(error.to_string(), expected);
        assert!(error.help().is_some());
    }
}
