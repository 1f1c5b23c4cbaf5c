//! AMF, the additive manufacturing file format: XML, plain or in a ZIP archive.
//!
//! As OpenSCAD reads it: all objects as they are, in the numbers that they are written in. Units, constellations,
//! materials and curved triangles are passed over.

use super::archive::{Archive, Xml, children, is_archive};
use super::{MeshError, RawMesh};
use octrace::Vec3;

pub(super) fn read(bytes: &[u8]) -> Result<RawMesh, MeshError> {
    if !is_archive(bytes) {
        let text = std::str::from_utf8(bytes).map_err(|e| {
            let line = 1 + bytes[..e.valid_up_to()].iter().filter(|&&b| b == b'\n').count();
            MeshError::Line { line, problem: "the text is not UTF-8".to_string() }
        })?;
        return document("the file", text);
    }
    let mut archive = Archive::open(bytes)?;
    let names = archive.names();
    let is_amf = |name: &&String| name.to_ascii_lowercase().ends_with(".amf");
    let Some(name) = names.iter().find(is_amf).or(names.first()) else { return Err(MeshError::Empty) };
    match archive.text(name)? {
        Some(text) => document(name, &text),
        None => Err(MeshError::Empty),
    }
}

fn document(part: &str, text: &str) -> Result<RawMesh, MeshError> {
    let xml = Xml::parse(part, text)?;
    let mut mesh = RawMesh::default();
    for object in children(xml.document.root_element(), "object") {
        let first = mesh.points.len();
        let meshes = || children(object, "mesh");
        let vertices = meshes().flat_map(|m| children(m, "vertices")).flat_map(|v| children(v, "vertex"));
        for coordinates in vertices.flat_map(|v| children(v, "coordinates")) {
            let axis = |name| {
                let text = children(coordinates, name).next().and_then(|node| node.text());
                xml.number(coordinates, name, text)
            };
            mesh.points.push(Vec3::new(axis("x")?, axis("y")?, axis("z")?));
        }
        let known = mesh.points.len() - first;
        for triangle in meshes().flat_map(|m| children(m, "volume")).flat_map(|v| children(v, "triangle")) {
            let corner = |name| {
                let text = children(triangle, name).next().and_then(|node| node.text());
                xml.index(triangle, name, text, known).map(|index| index + first as u32)
            };
            mesh.faces.push(vec![corner("v1")?, corner("v2")?, corner("v3")?]);
        }
    }
    Ok(mesh)
}

#[cfg(test)]
mod tests {
    use crate::files::mesh::{MeshFormat, read};
    use std::io::Write;

    fn corner_at(x: f64) -> String {
        let vertex = |[x, y, z]: [f64; 3]| {
            format!("<vertex><coordinates><x>{x}</x><y>{y}</y><z> {z} </z></coordinates></vertex>")
        };
        let triangle = |[a, b, c]: [u32; 3]| format!("<triangle><v1>{a}</v1><v2>{b}</v2><v3>{c}</v3></triangle>\n");
        let points = [[x, 0.0, 0.0], [x + 1.0, 0.0, 0.0], [x, 1.0, 0.0], [x, 0.0, 1.0]].map(vertex).concat();
        let faces = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]].map(triangle).concat();
        format!("<object id=\"{x}\"><mesh><vertices>{points}</vertices><volume>{faces}</volume></mesh></object>")
    }

    fn file(content: &str) -> String {
        format!("<?xml version=\"1.0\"?>\n<amf unit=\"inch\">\n{content}</amf>")
    }

    #[test]
    fn objects_are_read_one_after_the_other_plain_or_zipped() {
        let text = file(&(corner_at(0.0) + &corner_at(5.0)));
        let mut zip = zip::ZipWriter::new(std::io::Cursor::new(Vec::new()));
        zip.start_file("x.amf", zip::write::SimpleFileOptions::default()).unwrap();
        zip.write_all(text.as_bytes()).unwrap();
        let zipped = zip.finish().unwrap().into_inner();
        for bytes in [text.as_bytes(), &zipped] {
            let polyhedron = read(MeshFormat::Amf, bytes).unwrap().into_polyhedron().unwrap();
            assert!((polyhedron.volume() - 1.0 / 3.0).abs() < 1e-12);
            assert_eq!(polyhedron.points()[5].x, 6.0);
        }
    }

    #[test]
    fn what_is_wrong_is_named() {
        let check = |text: &str, expected: &str| {
            assert_eq!(read(MeshFormat::Amf, text.as_bytes()).unwrap_err().to_string(), expected);
        };
        check(&file(""), "the file has no faces");
        check(&file(&corner_at(0.0).replace("<y>1</y>", "")), "the file, line 3: y is no finite number");
        let wrong = corner_at(0.0).replace("<v2>3</v2>", "<v2>4</v2>");
        check(&file(&wrong), "the file, line 6: v2 names none of the 4 vertices");
        check(&"<a>".repeat(200_000), "the file is not well-formed XML");
        check("<amf>", "the file is not well-formed XML");
        check("PK\x03\x04...", "the ZIP archive cannot be read: invalid Zip archive: Could not find EOCD");
    }
}
