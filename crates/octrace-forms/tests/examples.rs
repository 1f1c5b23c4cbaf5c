//! The meshes of OpenSCAD's examples, against what OpenSCAD 2021.01 makes of them.

use octrace::Bounds;
use octrace_forms::files::mesh::{MeshFormat, read};
use std::path::PathBuf;

#[test]
fn meshes_have_the_volume_and_the_box_that_openscad_finds() {
    let corpora = std::env::var_os("OCTRACE_CORPORA").map(PathBuf::from);
    let beside = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../../shared/corpora");
    let folder = corpora.unwrap_or(beside).join("openscad/examples");
    if !folder.is_dir() {
        eprintln!("skipped: there is no {}", folder.display());
        return;
    }
    let cases = [
        ("example012", 11547.680, [-18.432, -14.693, 0.000], [11.568, 15.307, 15.000]),
        ("example016", 23029.012, [-15.000, -15.000, 0.000], [49.000, 15.000, 15.000]),
        ("projection", 3023.905, [-10.000, -10.000, -10.000], [10.000, 10.000, 10.000]),
    ];
    for (name, volume, low, high) in cases {
        let bytes = std::fs::read(folder.join(name).with_extension("stl")).unwrap();
        let polyhedron = read(MeshFormat::Stl, &bytes).unwrap().into_polyhedron().unwrap();
        let bounds = Bounds::around(polyhedron.points().iter().copied());
        for (actual, expected) in [(bounds.min, low), (bounds.max, high)] {
            assert!((actual - expected.into()).max_abs() < 1e-3, "{name}: {actual:?}, not {expected:?}");
        }
        assert!((polyhedron.volume() / volume - 1.0).abs() < 1e-4, "{name}: {}, not {volume}", polyhedron.volume());
    }
}
