//! 3MF, the 3D manufacturing format: XML in a ZIP archive.
//!
//! What the build says is made, where it says, in millimetres. Objects are meshes or put together of other objects, which
//! may be in other files of the archive (the production extension). Where the build is empty, all meshes are taken.

use super::archive::{Archive, Xml, children};
use super::{MOST_FACES, MeshError, RawMesh};
use octrace::{Affine, Vec3};
use std::collections::BTreeMap;

/// Objects put together of objects go so deep, and there are so many of them, at most.
const DEEPEST: usize = 32;
const MOST_USES: usize = 1 << 20;

/// One model file of the archive.
#[derive(Default)]
struct Part {
    /// Millimetres per unit.
    scale: f64,
    objects: BTreeMap<String, Object>,
    build: Vec<Use>,
}

#[derive(Default)]
struct Object {
    mesh: RawMesh,
    components: Vec<Use>,
}

/// An object and where it goes.
#[derive(Clone)]
struct Use {
    /// The file that has the object.
    path: String,
    object: String,
    map: Affine,
}

pub(super) fn read(bytes: &[u8]) -> Result<RawMesh, MeshError> {
    let mut archive = Archive::open(bytes)?;
    let root = root_model(&mut archive)?;
    let mut parts: BTreeMap<String, Part> = BTreeMap::new();
    load(&mut archive, &mut parts, &root)?;
    let scale = parts[&root].scale;
    let mut build = parts[&root].build.clone();
    if build.is_empty() {
        let meshes = parts[&root].objects.iter().filter(|(_, object)| !object.mesh.faces.is_empty());
        build = meshes.map(|(id, _)| Use { path: root.clone(), object: id.clone(), map: Affine::IDENTITY }).collect();
    }
    let to_mm = Affine::scale(Vec3::splat(scale));
    let mut mesh = RawMesh::default();
    let mut pending: Vec<(Use, usize)> = build.into_iter().rev().map(|item| (item, 1)).collect();
    let mut uses = 0;
    while let Some((item, depth)) = pending.pop() {
        uses += 1;
        if depth > DEEPEST || uses > MOST_USES {
            return Err(MeshError::Archive(format!("{}: objects are nested too deeply or too often", item.path)));
        }
        load(&mut archive, &mut parts, &item.path)?;
        let Some(object) = parts[&item.path].objects.get(&item.object) else {
            return Err(MeshError::Archive(format!("{} has no object {}", item.path, item.object)));
        };
        if mesh.faces.len() + object.mesh.faces.len() > MOST_FACES {
            return Err(MeshError::TooLarge(MOST_FACES));
        }
        add(&mut mesh, &object.mesh, &(to_mm * item.map));
        let inner = |c: &Use| (Use { map: item.map * c.map, ..c.clone() }, depth + 1);
        pending.extend(object.components.iter().rev().map(inner));
    }
    Ok(mesh)
}

/// The model file that the archive's relationships name, or else the usual one.
fn root_model(archive: &mut Archive) -> Result<String, MeshError> {
    const RELATIONSHIPS: &str = "_rels/.rels";
    if let Some(text) = archive.text(RELATIONSHIPS)? {
        let xml = Xml::parse(RELATIONSHIPS, &text)?;
        let mut all = children(xml.document.root_element(), "Relationship");
        let model = all.find(|node| node.attribute("Type").is_some_and(|t| t.ends_with("/3dmodel")));
        if let Some(target) = model.and_then(|node| node.attribute("Target")) {
            return Ok(target.trim_start_matches('/').to_string());
        }
    }
    Ok("3D/3dmodel.model".to_string())
}

/// Reads a model file of the archive, unless it is read.
fn load(archive: &mut Archive, parts: &mut BTreeMap<String, Part>, path: &str) -> Result<(), MeshError> {
    if !parts.contains_key(path) {
        let text = archive.text(path)?;
        let text = text.ok_or_else(|| MeshError::Archive(format!("there is no file {path} in it")))?;
        parts.insert(path.to_string(), part(path, &text)?);
    }
    Ok(())
}

fn part(path: &str, text: &str) -> Result<Part, MeshError> {
    let xml = Xml::parse(path, text)?;
    let model = xml.document.root_element();
    let scale = match model.attribute("unit").unwrap_or("millimeter") {
        "micron" => 0.001,
        "millimeter" => 1.0,
        "centimeter" => 10.0,
        "inch" => 25.4,
        "foot" => 304.8,
        "meter" => 1000.0,
        other => return Err(xml.error(model, format!("there is no unit `{other}`"))),
    };
    let mut part = Part { scale, ..Part::default() };
    for node in children(model, "resources").flat_map(|node| children(node, "object")) {
        let mut object = Object::default();
        for mesh in children(node, "mesh") {
            read_mesh(&xml, mesh, &mut object.mesh)?;
        }
        for component in children(node, "components").flat_map(|node| children(node, "component")) {
            object.components.push(usage(&xml, component, path)?);
        }
        part.objects.insert(node.attribute("id").unwrap_or_default().to_string(), object);
    }
    for item in children(model, "build").flat_map(|node| children(node, "item")) {
        part.build.push(usage(&xml, item, path)?);
    }
    Ok(part)
}

fn read_mesh(xml: &Xml, node: roxmltree::Node, mesh: &mut RawMesh) -> Result<(), MeshError> {
    for vertex in children(node, "vertices").flat_map(|node| children(node, "vertex")) {
        let axis = |name| xml.number(vertex, name, vertex.attribute(name));
        mesh.points.push(Vec3::new(axis("x")?, axis("y")?, axis("z")?));
    }
    let known = mesh.points.len();
    for triangle in children(node, "triangles").flat_map(|node| children(node, "triangle")) {
        let corner = |name| xml.index(triangle, name, triangle.attribute(name), known);
        mesh.faces.push(vec![corner("v1")?, corner("v2")?, corner("v3")?]);
    }
    Ok(())
}

/// An item of the build, or a component.
fn usage(xml: &Xml, node: roxmltree::Node, path: &str) -> Result<Use, MeshError> {
    let object = node.attribute("objectid").unwrap_or_default().to_string();
    let elsewhere = node.attributes().find(|a| a.name() == "path" && a.namespace().is_some());
    let path = elsewhere.map_or(path, |a| a.value().trim_start_matches('/')).to_string();
    let mut map = Affine::IDENTITY;
    if let Some(text) = node.attribute("transform") {
        let words = text.split_whitespace().map(|word| xml.number(node, "a number of the transform", Some(word)));
        let m = words.collect::<Result<Vec<f64>, MeshError>>()?;
        if m.len() != 12 {
            return Err(xml.error(node, format!("a transform takes 12 numbers; this one has {}", m.len())));
        }
        // Points are rows that stand before the matrix.
        map.rows = [0, 1, 2].map(|i| Vec3::new(m[i], m[3 + i], m[6 + i]));
        map.translation = Vec3::new(m[9], m[10], m[11]);
    }
    Ok(Use { path, object, map })
}

/// Adds a moved mesh; where the map mirrors, faces are turned so that they still look outwards.
fn add(all: &mut RawMesh, mesh: &RawMesh, map: &Affine) {
    let first = all.points.len() as u32;
    all.points.extend(mesh.points.iter().map(|&p| map.point(p)));
    let mirrored = map.determinant() < 0.0;
    all.faces.extend(mesh.faces.iter().map(|face| {
        let mut face: Vec<u32> = face.iter().map(|i| i + first).collect();
        if mirrored {
            face.reverse();
        }
        face
    }));
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::files::mesh::{MeshFormat, read};
    use octrace::Bounds;
    use std::io::Write;

    const CORNER: &str = r#"<mesh><vertices><vertex x="0" y="0" z="0"/><vertex x="1" y="0" z="0"/>
        <vertex x="0" y="1" z="0"/><vertex x="0" y="0" z="1"/></vertices><triangles><triangle v1="0" v2="2" v3="1"/>
        <triangle v1="0" v2="1" v3="3"/><triangle v1="1" v2="2" v3="3"/><triangle v1="0" v2="3" v3="2"/>
        </triangles></mesh>"#;

    fn archive(files: &[(&str, String)]) -> Vec<u8> {
        let mut zip = zip::ZipWriter::new(std::io::Cursor::new(Vec::new()));
        for (name, text) in files {
            zip.start_file(*name, zip::write::SimpleFileOptions::default()).unwrap();
            zip.write_all(text.as_bytes()).unwrap();
        }
        zip.finish().unwrap().into_inner()
    }

    fn model(unit: &str, resources: &str, build: &str) -> String {
        format!(
            r#"<model unit="{unit}" xmlns="core" xmlns:p="production"><resources>{resources}</resources><build>{build}</build></model>"#
        )
    }

    #[test]
    fn the_build_says_what_goes_where_in_which_unit() {
        // A corner of 1 cm, one mirrored along x and moved to x = 20 mm, and one from another file.
        let resources = format!(
            r#"<object id="1">{CORNER}</object><object id="2"><components>
            <component objectid="1" transform="-1 0 0 0 1 0 0 0 1 2 0 0"/><component objectid="7" p:path="/3D/other.model"/>
            </components></object><object id="unused">{CORNER}</object>"#
        );
        let build = r#"<item objectid="1"/><item objectid="2" transform="1 0 0 0 1 0 0 0 1 0 0 3"/>"#;
        let other = model("centimeter", &format!(r#"<object id="7">{CORNER}</object>"#), "");
        let bytes = archive(&[("3D/3dmodel.model", model("centimeter", &resources, build)), ("3D/other.model", other)]);
        let polyhedron = read(MeshFormat::ThreeMf, &bytes).unwrap().into_polyhedron().unwrap();
        assert!((polyhedron.volume() - 3.0 * 1000.0 / 6.0).abs() < 1e-9);
        let bounds = Bounds::around(polyhedron.points().iter().copied());
        assert_eq!((bounds.min, bounds.max), (Vec3::ZERO, Vec3::new(20.0, 10.0, 40.0)));
    }

    #[test]
    fn a_build_without_items_takes_all_meshes() {
        let resources = format!(r#"<object id="1">{CORNER}</object>"#);
        let relationships =
            r#"<Relationships><Relationship Target="/a.model" Type="http://x/3dmodel"/></Relationships>"#;
        let bytes = archive(&[("_rels/.rels", relationships.to_string()), ("a.model", model("inch", &resources, ""))]);
        let volume = read(MeshFormat::ThreeMf, &bytes).unwrap().into_polyhedron().unwrap().volume();
        assert!((volume - 25.4_f64.powi(3) / 6.0).abs() < 1e-9);
    }

    #[test]
    fn what_is_wrong_is_named() {
        let check = |resources: &str, expected: &str| {
            let bytes = archive(&[("3D/3dmodel.model", model("inch", resources, r#"<item objectid="1"/>"#))]);
            assert_eq!(read(MeshFormat::ThreeMf, &bytes).unwrap_err().to_string(), expected);
        };
        check("", "the ZIP archive cannot be read: 3D/3dmodel.model has no object 1");
        check(r#"<object id="1"/>"#, "the file has no faces");
        check(
            r#"<object id="1"><mesh><vertices><vertex x="0" y="nan"/></vertices></mesh></object>"#,
            "3D/3dmodel.model, line 1: y is no finite number",
        );
        let looped =
            r#"<object id="1"><components><component objectid="1"/><component objectid="1"/></components></object>"#;
        check(looped, "the ZIP archive cannot be read: 3D/3dmodel.model: objects are nested too deeply or too often");
        let empty = archive(&[]);
        let message = read(MeshFormat::ThreeMf, &empty).unwrap_err().to_string();
        assert_eq!(message, "the ZIP archive cannot be read: there is no file 3D/3dmodel.model in it");
    }
}
