//! OFF, the object file format of Geomview, as text: counts, points, faces.

use super::words::{Words, lines};
use super::{MeshError, RawMesh};

pub(super) fn read(bytes: &[u8]) -> Result<RawMesh, MeshError> {
    let end = bytes.split(|&b| b == b'\n').count();
    let mut lines = Reader { lines: lines(bytes, Some(b'#')), end };
    let mut header = lines.next("the word OFF")?;
    let word = header.next().unwrap_or_default();
    // Points may have colours (C), normals (N) and places in a texture (ST) after their coordinates.
    let plain = word.trim_start_matches("ST").trim_start_matches('C').trim_start_matches('N');
    if plain != "OFF" {
        return Err(header.error("the file does not begin with the word OFF; other kinds are not read"));
    }
    let mut counts = header;
    let points = match counts.count("the number of points") {
        Ok(count) => count,
        Err(_) => {
            counts = lines.next("the number of points")?;
            counts.count("the number of points")?
        }
    };
    let faces = counts.count("the number of faces")?;

    let mut mesh = RawMesh::default();
    for _ in 0..points {
        mesh.points.push(lines.next("a point")?.point()?);
    }
    for _ in 0..faces {
        let mut line = lines.next("a face")?;
        let corners = line.count("the number of corners")?;
        let mut face = Vec::new();
        for _ in 0..corners {
            let index = line.count("a corner")?;
            if index >= points {
                return Err(line.error(format!("there is no point {index}, only {points} from 0 on")));
            }
            face.push(index as u32);
        }
        mesh.faces.push(face);
    }
    Ok(mesh)
}

/// The lines of the file, one after the other.
struct Reader<L> {
    lines: L,
    /// How many lines the file has.
    end: usize,
}

impl<'a, L: Iterator<Item = Words<'a>>> Reader<L> {
    fn next(&mut self, what: &str) -> Result<Words<'a>, MeshError> {
        let problem = || format!("the file ends where {what} should be");
        self.lines.next().ok_or_else(|| MeshError::Line { line: self.end, problem: problem() })
    }
}

#[cfg(test)]
mod tests {
    use crate::files::mesh::{MeshFormat, read};

    #[test]
    fn counts_may_be_on_the_first_line_and_faces_may_have_colours() {
        let corner = "0 0 0\n1 0 0\n0 1 0 # a comment\n\n0 0 1\n3 0 2 1\n3 0 1 3 255 0 0\n3 1 2 3\n3 0 3 2\n";
        for start in ["OFF 4 4 0\n", "OFF\n# points, faces, edges\n4 4 0\n", "COFF\n4 4 6\n"] {
            let mesh = read(MeshFormat::Off, format!("{start}{corner}").as_bytes()).unwrap();
            assert_eq!(mesh.into_polyhedron().unwrap().volume(), 1.0 / 6.0, "{start}");
        }
    }

    #[test]
    fn what_is_wrong_is_named() {
        let check = |text: &str, expected: &str| {
            assert_eq!(read(MeshFormat::Off, text.as_bytes()).unwrap_err().to_string(), expected);
        };
        check("PLY\n", "line 1: the file does not begin with the word OFF; other kinds are not read");
        check("OFF\n1 x 0", "line 2: the number of faces is `x`, which is no whole number");
        check("OFF\n9999999999999 1 0\n0 0 0", "line 3: the file ends where a point should be");
        check("OFF 1 1 0\n0 0 0\n3 0 1 2", "line 3: there is no point 1, only 1 from 0 on");
        check("OFF 1 0 0\n0 0 0", "the file has no faces");
    }
}
