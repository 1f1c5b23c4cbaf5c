//! `octrace measure` against reference volumes of real models, all those that it can measure.
//!
//! The references were computed from meshes by other programs; each states how far it can be trusted.

mod common;
#[path = "../../octrace-read/tests/corpora/mod.rs"]
mod corpora;

use common::Folder;
use corpora::corpora;
use serde_json::Value;

/// Models of which the references have another idea, and why.
const NOT_COMPARED: [(&str, &str); 4] = [
    (
        "dankamongmen/downwedge.csg",
        "the box holds a film as thin as the numbers' rounding, which is no part of a regular solid",
    ),
    (
        "koen-lee/roland_piano_headphone_hanger.csg",
        "offsets are faceted in other places than OpenSCAD's, or always faceted",
    ),
    ("koen-lee/stofzuigerstangsteun.csg", "a crescent's tip ends where its two circles say, not where their facets do"),
    ("koen-lee/parkside_blower_to_sup_air_hose_adapter.csg", "a twist is always in OpenSCAD's slices"),
];

/// How models are measured, and compared with references.
struct Comparison {
    facets: &'static str,
    reference: &'static str,
    /// What is measured is good to this, relative to the volume: at first, and once more where that is not near enough to
    /// the reference.
    tolerances: [&'static str; 2],
    /// No volume has to be closer to its reference than this.
    volume: f64,
    /// No box has to, relative to its size.
    bbox: f64,
    models: usize,
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or(f64::NAN)
}

/// What is wrong with a report, in the light of a reference; nothing if all is well.
fn compare(report: &Value, reference: &Value, bbox: &Value, how: &Comparison) -> Vec<String> {
    let mut wrong = Vec::new();
    let expected = number(&reference["volume"]);
    let off = (number(&report["volume"]) - expected).abs();
    if off.is_nan() || off > number(&reference["rel_tol"]).max(how.volume) * expected {
        wrong.push(format!("volume {} ± {}, not {expected}", report["volume"], report["volume_error"]));
    }
    let corner = |bbox: &Value, i: usize| number(&bbox[i]);
    let size = (0..3).map(|i| corner(bbox, i + 3) - corner(bbox, i)).fold(0.0, f64::max);
    let off = (0..6).map(|i| (corner(&report["bbox"], i) - corner(bbox, i)).abs()).fold(0.0, f64::max);
    if off.is_nan() || off > how.bbox * size {
        wrong.push(format!("box {}, not {bbox}", report["bbox"]));
    }
    wrong
}

fn walk(how: &Comparison) {
    let Some(corpora) = corpora() else { return };
    let references = std::fs::read_to_string(corpora.join("volumes.json")).expect("there are reference volumes");
    let references: Value = serde_json::from_str(&references).expect("they are JSON");
    let folder = Folder::with(&[]);
    let (mut measured, mut wrong) = (0, Vec::new());
    for reference in references["openscad"].as_array().expect("a list of models") {
        let name = reference["file"].as_str().expect("a name");
        let volumes = &reference[how.reference];
        if volumes.is_null() || NOT_COMPARED.iter().any(|(other, _)| name.ends_with(other)) {
            continue;
        }
        let path = corpora.join(name).display().to_string();
        let bbox = if volumes["bbox"].is_null() { &reference["bbox"] } else { &volumes["bbox"] };
        let off = |tolerance| {
            let options = ["--facets", how.facets, "--tolerance", tolerance, "--json"];
            let run = folder.run(&[&["measure", &path], &options[..]].concat()).expect(0);
            compare(&run.json(), volumes, bbox, how)
        };
        let [coarse, fine] = how.tolerances;
        measured += 1;
        if !off(coarse).is_empty() {
            wrong.extend(off(fine).into_iter().map(|what| format!("{name}: {what}")));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert_eq!(measured, how.models);
}

#[test]
fn volumes_and_boxes_of_real_models_with_facets_as_written() {
    walk(&Comparison {
        facets: "written",
        reference: "faceted",
        tolerances: ["2e-4", "3e-5"],
        volume: 4e-5,
        // They are given to seven digits.
        bbox: 1e-5,
        models: 117,
    });
}

/// What has no exact form counts here, and the references were extrapolated from facets.
#[test]
fn volumes_and_boxes_of_real_models_with_round_things_round() {
    walk(&Comparison {
        facets: "auto",
        reference: "round_above_12",
        tolerances: ["3e-4", "5e-5"],
        volume: 1.5e-4,
        bbox: 1e-3,
        models: 118,
    });
}
