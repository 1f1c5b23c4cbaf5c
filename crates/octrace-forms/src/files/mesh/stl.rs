//! STL: triangles by their corners, as text or binary.
//!
//! Which of the two it is, the length tells: a binary file says how many triangles it has, and each takes 50 bytes. Many
//! binary files start with `solid` as text does.

use super::words::lines;
use super::{MeshError, RawMesh, weld};
use octrace::Vec3;

const HEADER: usize = 84;
const TRIANGLE: usize = 50;

pub(super) fn read(bytes: &[u8]) -> Result<RawMesh, MeshError> {
    let mesh = if is_text(bytes) { text(bytes)? } else { binary(bytes)? };
    // Numbers are single precision, or text of about as many digits: corners that differ by less are meant to be one.
    let farthest = mesh.points.iter().map(|p| p.max_abs()).fold(0.0, f64::max);
    Ok(weld::welded(mesh, f64::from(f32::EPSILON) * farthest))
}

fn is_text(bytes: &[u8]) -> bool {
    let promised = promised(bytes);
    if promised.is_some_and(|count| HEADER as u64 + count * TRIANGLE as u64 == bytes.len() as u64) {
        return false;
    }
    let start = bytes.trim_ascii_start();
    let named = start.get(..5).is_some_and(|word| word.eq_ignore_ascii_case(b"solid"));
    // Text has no zero bytes; the numbers of binary files nearly always have.
    named && !bytes[..bytes.len().min(1000)].contains(&0)
}

/// How many triangles a binary file says that it has.
fn promised(bytes: &[u8]) -> Option<u64> {
    let count = bytes.get(HEADER - 4..HEADER)?;
    Some(u64::from(u32::from_le_bytes(count.try_into().ok()?)))
}

fn binary(bytes: &[u8]) -> Result<RawMesh, MeshError> {
    let expected = promised(bytes).unwrap_or(0);
    let body = bytes.get(HEADER..).unwrap_or_default();
    let complete = (body.len() / TRIANGLE) as u64;
    if complete < expected {
        return Err(MeshError::Truncated { expected, complete, at: bytes.len() });
    }
    let mut mesh = RawMesh::default();
    for (number, triangle) in body.chunks_exact(TRIANGLE).take(expected as usize).enumerate() {
        let number_at = |i: usize| {
            let bytes = [0, 1, 2, 3].map(|byte| triangle[12 + 4 * i + byte]);
            f64::from(f32::from_le_bytes(bytes))
        };
        let first = mesh.points.len() as u32;
        for corner in 0..3 {
            let [x, y, z] = [0, 1, 2].map(|axis| number_at(3 * corner + axis));
            let point = Vec3::new(x, y, z);
            if !point.is_finite() {
                return Err(MeshError::NotFinite { triangle: number + 1, corner: corner + 1 });
            }
            mesh.points.push(point);
        }
        mesh.faces.push(vec![first, first + 1, first + 2]);
    }
    Ok(mesh)
}

/// Only the corners and where a loop of them begins and ends matter; normals follow from the corners.
fn text(bytes: &[u8]) -> Result<RawMesh, MeshError> {
    let mut mesh = RawMesh::default();
    let mut face: Vec<u32> = Vec::new();
    for mut line in lines(bytes, None) {
        match line.next().map(str::to_ascii_lowercase).as_deref() {
            Some("vertex") => {
                face.push(mesh.points.len() as u32);
                mesh.points.push(line.point()?);
            }
            Some("outer") => face.clear(),
            Some("endloop" | "endfacet") if !face.is_empty() => {
                if face.len() < 3 {
                    return Err(line.error(format!("a facet takes 3 vertices; this one has {}", face.len())));
                }
                mesh.faces.push(std::mem::take(&mut face));
            }
            _ => {}
        }
    }
    Ok(mesh)
}

#[cfg(test)]
mod tests {
    use crate::files::mesh::{MeshFormat, read};

    const CORNERS: [[f32; 3]; 4] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    const FACES: [[usize; 3]; 4] = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]];

    fn binary_with(header: &[u8]) -> Vec<u8> {
        let mut bytes = header.to_vec();
        bytes.resize(80, b' ');
        bytes.extend(4_u32.to_le_bytes());
        for face in FACES {
            bytes.extend([0; 12]);
            bytes.extend(face.iter().flat_map(|&i| CORNERS[i]).flat_map(f32::to_le_bytes));
            bytes.extend([0; 2]);
        }
        bytes
    }

    fn as_text() -> String {
        let mut text = String::from("solid corner\n");
        for face in FACES {
            text += "  facet normal 0 0 0\n    outer loop\n";
            for [x, y, z] in face.map(|i| CORNERS[i]) {
                text += &format!("      vertex {x:e} {y} {z}\n");
            }
            text += "    endloop\n  endfacet\n";
        }
        text + "endsolid corner\n"
    }

    fn volume(bytes: &[u8]) -> f64 {
        let mesh = read(MeshFormat::Stl, bytes).unwrap();
        assert_eq!(mesh.points.len(), 4);
        mesh.into_polyhedron().unwrap().volume()
    }

    #[test]
    fn text_and_binary_are_told_apart_by_length() {
        assert_eq!(volume(as_text().as_bytes()), 1.0 / 6.0);
        assert_eq!(volume(as_text().replace('\n', "\r\n").to_uppercase().as_bytes()), 1.0 / 6.0);
        assert_eq!(volume(&binary_with(b"made by hand")), 1.0 / 6.0);
        assert_eq!(volume(&binary_with(b"solid made by hand")), 1.0 / 6.0);
        let mut with_more = binary_with(b"solid");
        with_more.extend(b"something");
        assert_eq!(volume(&with_more), 1.0 / 6.0);
    }

    #[test]
    fn corners_within_rounding_are_one() {
        let text = as_text().replacen("vertex 1e0 0 0", "vertex 1.0000001 0 0", 1);
        assert_eq!(read(MeshFormat::Stl, text.as_bytes()).unwrap().points.len(), 4);
        let text = as_text().replacen("vertex 1e0 0 0", "vertex 1.00001 0 0", 1);
        assert_eq!(read(MeshFormat::Stl, text.as_bytes()).unwrap().points.len(), 5);
    }

    #[test]
    fn what_is_wrong_is_named() {
        let check = |bytes: &[u8], expected: &str| {
            assert_eq!(read(MeshFormat::Stl, bytes).unwrap_err().to_string(), expected);
        };
        check(b"", "the file has no faces");
        check(b"solid nothing\nendsolid nothing\n", "the file has no faces");
        check(b"solid x\n outer loop\n vertex 1 2\n", "line 3: z is missing");
        check(b"solid x\n outer loop\n vertex 1 2 inf\n", "line 3: z is `inf`, which is no finite number");
        check(b"solid x\nouter loop\nvertex 1 2 3\nendloop\n", "line 4: a facet takes 3 vertices; this one has 1");
        let cut = &binary_with(b"x")[..190];
        check(cut, "the file says 4 triangles but ends after 2, at byte 190");
        let mut bad = binary_with(b"x");
        bad[84 + 50 + 12 + 12..][..4].copy_from_slice(&f32::NAN.to_le_bytes());
        check(&bad, "corner 2 of triangle 2 has a coordinate that is not finite");
    }
}
