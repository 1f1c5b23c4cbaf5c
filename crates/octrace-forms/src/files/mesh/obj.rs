//! Wavefront OBJ: vertices and faces; what says how they look is passed over.

use super::words::{cut, lines};
use super::{MeshError, RawMesh};

pub(super) fn read(bytes: &[u8]) -> Result<RawMesh, MeshError> {
    let mut mesh = RawMesh::default();
    for mut line in lines(bytes, Some(b'#')) {
        match line.next() {
            Some("v") => mesh.points.push(line.point()?),
            Some("f") => {
                let known = mesh.points.len();
                let mut face = Vec::new();
                while let Some(corner) = line.next() {
                    // What follows a slash is a place in a texture, or a normal.
                    let number = corner.split('/').next().and_then(|word| word.parse::<i64>().ok());
                    // From 1 on, or backwards from the last one so far.
                    let index = match number {
                        Some(n) if n > 0 => usize::try_from(n - 1).ok(),
                        Some(n) if n < 0 => usize::try_from(n.unsigned_abs()).ok().and_then(|n| known.checked_sub(n)),
                        _ => None,
                    };
                    match index.filter(|&index| index < known) {
                        Some(index) => face.push(index as u32),
                        None => {
                            return Err(
                                line.error(format!("`{}` names none of the {known} vertices so far", cut(corner)))
                            );
                        }
                    }
                }
                if face.len() < 3 {
                    return Err(line.error(format!("a face takes 3 vertices; this one has {}", face.len())));
                }
                mesh.faces.push(face);
            }
            _ => {}
        }
    }
    Ok(mesh)
}

#[cfg(test)]
mod tests {
    use crate::files::mesh::{MeshFormat, read};

    #[test]
    fn faces_name_vertices_from_one_or_from_the_end() {
        let text = "mtllib x.mtl\no corner\nv 0 0 0 1.0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nv 0 0 1\n\
            f 1//1 3//1 2//1\nf 1/5 2/6/1 4\nf -3 -2 -1\nf 1 4 3 # done\n";
        let mesh = read(MeshFormat::Obj, text.as_bytes()).unwrap();
        assert_eq!(mesh.into_polyhedron().unwrap().volume(), 1.0 / 6.0);
    }

    #[test]
    fn what_is_wrong_is_named() {
        let check = |text: &str, expected: &str| {
            assert_eq!(read(MeshFormat::Obj, text.as_bytes()).unwrap_err().to_string(), expected);
        };
        check("v 0 0 0\nf 1 1 2", "line 2: `2` names none of the 1 vertices so far");
        check("v 0 0 0\nf 1 1 -2", "line 2: `-2` names none of the 1 vertices so far");
        check("v 0 0 0\nf 1 0 1", "line 2: `0` names none of the 1 vertices so far");
        check("v 0 0 0\nf 1 1", "line 2: a face takes 3 vertices; this one has 2");
        check("v 0 0 x", "line 1: z is `x`, which is no finite number");
    }
}
