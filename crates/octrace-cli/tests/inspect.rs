//! `octrace inspect`, the real program.

mod common;

use common::{Folder, PLATE};
use serde_json::json;

#[test]
fn every_stage_can_be_printed() {
    let folder = Folder::with(&[("plate.csg", PLATE)]);
    let summary = folder.run(&["inspect", "plate.csg"]).expect(0);
    for word in ["plate.csg", "difference 1", "block 1", "octree", "0 0 0 to 40 30 5"] {
        assert!(summary.text().contains(word), "{word} in\n{}", summary.text());
    }
    let all = folder.run(&["inspect", "plate.csg", "--tree", "--program", "--pixel=512,300"]).expect(0);
    for word in ["  difference", "plane", "pixel 512,300", "cells", "spans"] {
        assert!(all.text().contains(word), "{word} in\n{}", all.text());
    }
}

#[test]
fn a_pixel_that_hits_says_where() {
    let folder = Folder::with(&[("ball.csg", "sphere($fn = 0, $fa = 12, $fs = 2, r = 1);")]);
    let camera = "--camera=0,-10,0,0,0,0";
    let run = folder.run(&["inspect", "ball.csg", camera, "--size=1x1", "--pixel=0,0"]).expect(0);
    assert!(run.text().contains("hit at t 9"), "{}", run.text());
    assert!(run.text().contains("point 0 -1 0"), "{}", run.text());
}

#[test]
fn pixels_outside_of_the_picture_are_refused() {
    let folder = Folder::with(&[("plate.csg", PLATE)]);
    let run = folder.run(&["inspect", "plate.csg", "--size=10x10", "--pixel=10,0"]).expect(2);
    assert!(run.stderr.contains("outside of the picture"), "{}", run.stderr);
    let run = folder.run(&["inspect", "plate.csg", "--pixel", "-1,0"]).expect(2);
    assert!(run.stderr.contains("counted from 0"), "{}", run.stderr);
}

#[test]
fn everything_can_be_had_as_json() {
    let folder = Folder::with(&[("plate.csg", PLATE)]);
    let report = folder.run(&["inspect", "plate.csg", "--json"]).expect(0).json();
    assert_eq!((&report["file"], &report["nodes"]["counts"]["difference"]), (&json!("plate.csg"), &json!(1)));
    assert_eq!(report["bounds"], json!([0.0, 0.0, 0.0, 40.0, 30.0, 5.0]));
    assert_eq!((&report["solid"]["leaves"]["block"], &report["unbounded"]), (&json!(1), &json!(false)));
    assert!(report["octree"]["leaves"].as_u64() > Some(0) && report["program"]["primitives"].as_u64() > Some(1));
    assert!(["tree_text", "program_text", "pixel"].iter().all(|&key| report[key].is_null()), "{report}");

    let asked = ["inspect", "plate.csg", "--json", "--tree", "--program", "--accel=none"];
    let report = folder.run(&asked).expect(0).json();
    assert!(report["tree_text"].as_str().unwrap().contains("  difference"), "{report}");
    assert!(report["program_text"].as_str().unwrap().contains("plane") && report["octree"].is_null(), "{report}");

    let folder = Folder::with(&[("ball.csg", "sphere($fn = 0, $fa = 12, $fs = 2, r = 1);")]);
    let camera = "--camera=0,-10,0,0,0,0";
    let run = folder.run(&["inspect", "ball.csg", camera, "--size=1x1", "--pixel=0,0", "--json"]).expect(0);
    let pixel = &run.json()["pixel"];
    assert_eq!((&pixel["hit"]["t"], &pixel["hit"]["point"]), (&json!(9.0), &json!([0.0, -1.0, 0.0])));
    let end = |end: &str| pixel["spans"][0][end]["t"].as_f64().expect("an end");
    assert!((end("enter") - 9.0).abs() < 1e-9 && (end("exit") - 11.0).abs() < 1e-9, "{pixel}");
    assert!(pixel["cells"].as_array().is_some_and(|cells| !cells.is_empty()), "{pixel}");
}
