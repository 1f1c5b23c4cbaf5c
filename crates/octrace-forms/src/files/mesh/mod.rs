//! Meshes from files: STL, OFF, OBJ, AMF and 3MF.
//!
//! In come bytes, out come points and faces as the file has them, counter-clockwise seen from outside where the file keeps
//! to its format. [`RawMesh::into_polyhedron`] makes a solid of a closed one; [`RawMesh::repaired`] tries to close others.

mod amf;
mod archive;
mod closed;
mod obj;
mod off;
mod repair;
mod stl;
mod three_mf;
mod weld;
mod words;

pub use closed::SolidError;
pub use repair::Repairs;
pub(super) use weld::welded;

use octrace::Vec3;

/// Points and faces, not checked.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RawMesh {
    /// The corners.
    pub points: Vec<Vec3>,
    /// For each face the indices of its corners.
    pub faces: Vec<Vec<u32>>,
}

/// A file format for meshes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MeshFormat {
    /// Triangles by their corners, as text or binary.
    Stl,
    /// Geomview's object file format, as text.
    Off,
    /// Wavefront's object format: vertices and faces of it.
    Obj,
    /// Additive manufacturing file format, plain or zipped. Numbers are taken as they are, whatever unit the file names,
    /// as OpenSCAD does.
    Amf,
    /// 3D manufacturing format: what the build has, in millimetres.
    ThreeMf,
}

impl MeshFormat {
    /// The format that a file name says by its ending, in capitals or not.
    pub fn of_name(name: &str) -> Option<Self> {
        let (_, ending) = name.rsplit_once('.')?;
        Some(match ending.to_ascii_lowercase().as_str() {
            "stl" => Self::Stl,
            "off" => Self::Off,
            "obj" => Self::Obj,
            "amf" => Self::Amf,
            "3mf" => Self::ThreeMf,
            _ => return None,
        })
    }
}

/// Why bytes are not a mesh.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum MeshError {
    /// A line of text is not what the format has there.
    #[error("line {line}: {problem}")]
    Line {
        /// Line of the file, from 1.
        line: usize,
        /// What is wrong.
        problem: String,
    },
    /// Binary content ends early.
    #[error("the file says {expected} triangles but ends after {complete}, at byte {at}")]
    Truncated {
        /// How many triangles are promised.
        expected: u64,
        /// How many are there.
        complete: u64,
        /// Length of the file.
        at: usize,
    },
    /// A coordinate is infinite or NaN.
    #[error("corner {corner} of triangle {triangle} has a coordinate that is not finite")]
    NotFinite {
        /// Index of the triangle, from 1.
        triangle: usize,
        /// Which of its corners, from 1.
        corner: usize,
    },
    /// An element of an XML file is not what the format has there.
    #[error("{part}, line {line}: {problem}")]
    Element {
        /// Which file, of those in the archive.
        part: String,
        /// Its line, from 1.
        line: u32,
        /// What is wrong.
        problem: String,
    },
    /// XML that is not well formed.
    #[error("{part} is not well-formed XML")]
    Xml {
        /// Which file, of those in the archive.
        part: String,
        /// Where and why.
        #[source]
        cause: roxmltree::Error,
    },
    /// The archive cannot be read.
    #[error("the ZIP archive cannot be read: {0}")]
    Archive(String),
    /// More than can be worked with.
    #[error("the file has more than {0} triangles")]
    TooLarge(usize),
    /// Nothing that has a shape.
    #[error("the file has no faces")]
    Empty,
}

/// Files that make more faces than these, by repeating parts of themselves, are refused.
const MOST_FACES: usize = 1 << 26;

/// Reads a mesh.
///
/// # Errors
/// If the bytes are not of that format: see [`MeshError`].
pub fn read(format: MeshFormat, bytes: &[u8]) -> Result<RawMesh, MeshError> {
    let mesh = match format {
        MeshFormat::Stl => stl::read(bytes),
        MeshFormat::Off => off::read(bytes),
        MeshFormat::Obj => obj::read(bytes),
        MeshFormat::Amf => amf::read(bytes),
        MeshFormat::ThreeMf => three_mf::read(bytes),
    }?;
    if mesh.faces.is_empty() { Err(MeshError::Empty) } else { Ok(mesh) }
}
