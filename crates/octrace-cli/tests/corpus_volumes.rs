//! `octrace measure` against reference volumes of real models, all those that it can measure.
//!
//! The references were computed from meshes by other programs; each states how far it can be trusted.

mod common;
#[path = "../../octrace-read/tests/corpora/mod.rs"]
mod corpora;

use common::Folder;
use corpora::corpora;
use serde_json::Value;

/// So many of the models consist of what can be rendered.
const MEASURABLE: usize = 52;

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or(f64::NAN)
}

/// What is wrong with a report, in the light of a reference; nothing if all is well.
fn compare(report: &Value, reference: &Value) -> Vec<String> {
    let mut wrong = Vec::new();
    let expected = number(&reference["volume"]);
    let off = (number(&report["volume"]) - expected).abs();
    if off.is_nan() || off > number(&reference["rel_tol"]) * expected {
        wrong.push(format!("volume {} ± {}, not {expected}", report["volume"], report["volume_error"]));
    }
    let corner = |bbox: &Value, i: usize| number(&bbox[i]);
    let bbox = &reference["bbox"];
    let size = (0..3).map(|i| corner(bbox, i + 3) - corner(bbox, i)).fold(0.0, f64::max);
    let off = (0..6).map(|i| (corner(&report["bbox"], i) - corner(bbox, i)).abs()).fold(0.0, f64::max);
    // References are given to seven digits.
    if off.is_nan() || off > 1e-5 * size {
        wrong.push(format!("box {}, not {bbox}", report["bbox"]));
    }
    wrong
}

#[test]
fn volumes_and_boxes_of_real_models_with_facets_as_written() {
    let Some(corpora) = corpora() else { return };
    let references = std::fs::read_to_string(corpora.join("volumes.json")).expect("there are reference volumes");
    let references: Value = serde_json::from_str(&references).expect("they are JSON");
    let folder = Folder::with(&[]);
    let (mut measured, mut wrong) = (0, Vec::new());
    for reference in references["openscad"].as_array().expect("a list of models") {
        let name = reference["file"].as_str().expect("a name");
        let path = corpora.join(name).display().to_string();
        if reference["faceted"].is_null() || folder.run(&["check", &path]).code != 0 {
            continue;
        }
        let run = folder.run(&["measure", &path, "--facets=written", "--tolerance=3e-5", "--json"]).expect(0);
        measured += 1;
        wrong.extend(compare(&run.json(), &reference["faceted"]).into_iter().map(|what| format!("{name}: {what}")));
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert_eq!(measured, MEASURABLE);
}
