//! `octrace study`, the real program. What it says of time differs from run to run; what must hold whatever the time,
//! is tested.

mod common;

use common::{Folder, PLATE};
use serde_json::Value;
use std::collections::BTreeSet;
use std::fs;

/// As little as can be measured.
const LITTLE: [&str; 5] = ["study", "--quick", "--repeat=2", "--size=24x18", "--json=study.json"];

/// Figures are written with six digits.
const ROUNDED: f64 = 1e-4;

struct Studied {
    folder: Folder,
    json: Value,
    page: String,
}

fn study(files: &[(&str, &str)], words: &[&str]) -> Studied {
    let folder = Folder::with(files);
    folder.run(&[&LITTLE[..], words].concat()).expect(0);
    let json = serde_json::from_slice(&fs::read(folder.path("study.json")).unwrap()).unwrap();
    let page = fs::read_to_string(folder.path("study.html")).unwrap();
    Studied { folder, json, page }
}

fn keys(value: &Value) -> BTreeSet<&str> {
    value.as_object().unwrap().keys().map(String::as_str).collect()
}

fn list(value: &Value) -> &[Value] {
    value.as_array().unwrap()
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is no number"))
}

/// Median, least and greatest.
fn spread(value: &Value) -> [f64; 3] {
    let spread = ["median", "min", "max"].map(|key| number(&value[key]));
    assert!(spread[1] <= spread[0] && spread[0] <= spread[2], "{value}");
    spread
}

#[track_caller]
fn assert_keys(value: &Value, expected: &str) {
    assert_eq!(keys(value), expected.split_whitespace().collect());
}

#[test]
fn the_figures_are_complete() {
    let Studied { json, folder, .. } = study(&[], &["--scenes=classic,chain-4", "--traversals=parametric,fujimoto"]);
    assert_eq!(folder.names(), ["study.html", "study.json"]);
    assert_keys(&json, "octrace command date seconds machine settings checked scenes memory");
    assert_keys(&json["machine"], "cpu hardware_threads os architecture");
    assert_keys(&json["settings"], "width height repeat threads");
    assert_keys(&json["checked"], "configurations hits canonical_hits differing leaks");
    assert!(json["command"].as_str().unwrap().starts_with("octrace study --quick"), "{}", json["command"]);
    let names: Vec<&Value> = list(&json["scenes"]).iter().map(|scene| &scene["name"]).collect();
    assert_eq!(names, ["classic", "chain-4"]);
    let scene = &json["scenes"][0];
    assert_keys(scene, "name description family primitives surfaces tree_depth rays checked canonical runs advice");
    assert_keys(
        &scene["canonical"],
        "rays_traced build_seconds ns_per_ray picture_seconds mrays_per_second surface_tests_per_ray ratio_to_default",
    );
    let run = &scene["runs"][0];
    assert_keys(run, "traversal leaf_primitives octree_depth is_default status note same_as figures");
    assert_eq!((&run["is_default"], &run["status"]), (&true.into(), &"measured".into()));
    let figures = &run["figures"];
    assert_keys(
        figures,
        "octree bytes build_seconds ns_per_ray picture_seconds mrays_per_second cells_per_ray surface_tests_per_ray \
         walk ratio_to_default speedup_over_canonical",
    );
    assert_keys(&figures["octree"], "depth branches leaves outside inside program_words");
    assert_keys(&figures["bytes"], "tree tables programs");
    assert_keys(&figures["walk"], "cells_per_ray ns_per_cell grid_steps_per_ray ns_per_grid_step");
    assert_keys(
        &scene["advice"],
        "traversal leaf_primitives octree_depth is_default is_worth_it speedup pays_from_rays memory_ratio options",
    );
    assert_keys(
        &json["memory"][0],
        "scene leaf_primitives depth nodes bresenham glassner fujimoto grid_was_made grid_over_tree",
    );
}

#[test]
fn ratios_agree_with_the_medians() {
    let Studied { json, .. } = study(&[], &["--scenes=classic"]);
    let scene = &json["scenes"][0];
    let rays = number(&scene["rays"]);
    assert_eq!(rays, 24.0 * 18.0);
    let canonical = spread(&scene["canonical"]["ns_per_ray"])[0];
    let figures: Vec<&Value> =
        list(&scene["runs"]).iter().map(|run| &run["figures"]).filter(|f| !f.is_null()).collect();
    assert!(figures.len() > 6, "each traversal, and more settings");
    let usual = spread(&figures[0]["ns_per_ray"])[0];
    // A ratio of medians lies between the least and the greatest of the ratios.
    let within = |ratio: &Value, over: f64, under: f64| {
        let [_, min, max] = spread(ratio);
        let slack = ROUNDED;
        assert!(min * (1.0 - slack) <= over / under && over / under <= max * (1.0 + slack), "{ratio} {over} {under}");
    };
    within(&scene["canonical"]["ratio_to_default"], canonical, usual);
    for f in figures {
        let ns = spread(&f["ns_per_ray"])[0];
        within(&f["ratio_to_default"], ns, usual);
        within(&f["speedup_over_canonical"], canonical, ns);
        assert!((number(&f["mrays_per_second"]) * ns / 1e3 - 1.0).abs() < ROUNDED);
        assert!((spread(&f["picture_seconds"])[0] / (ns * rays / 1e9) - 1.0).abs() < ROUNDED);
        let walk = &f["walk"];
        if !walk["grid_steps_per_ray"].is_null() {
            let walks = number(&walk["cells_per_ray"]) * spread(&walk["ns_per_cell"])[0];
            let steps = number(&walk["grid_steps_per_ray"]) * spread(&walk["ns_per_grid_step"])[0];
            assert!((walks / steps - 1.0).abs() < ROUNDED, "{walk}");
        }
    }
    for row in list(&json["memory"]) {
        let bytes = |traversal: &str, part: &str| number(&row[traversal][part]);
        let tree = bytes("bresenham", "tree") + bytes("bresenham", "tables");
        assert!((number(&row["grid_over_tree"]) * tree / bytes("fujimoto", "tables") - 1.0).abs() < ROUNDED, "{row}");
        assert_eq!(bytes("fujimoto", "tables"), 5.0 * 8_f64.powi(number(&row["depth"]) as i32), "{row}");
        assert_eq!((bytes("fujimoto", "tree"), bytes("glassner", "tree")), (0.0, 0.0));
    }
}

#[test]
fn all_see_the_same() {
    let Studied { json, page, .. } = study(&[], &["--scenes=balls-10"]);
    let checked = &json["checked"];
    let rays = 24.0 * 18.0;
    assert_eq!((number(&checked["differing"]), number(&checked["leaks"])), (0.0, 0.0));
    assert_eq!(number(&checked["hits"]), rays * number(&checked["configurations"]));
    assert_eq!(
        checked["canonical_hits"], checked["hits"],
        "few rays and few surfaces: the canonical tracer has them all"
    );
    assert!(page.contains("None differs."));
}

#[test]
fn a_model_gets_advice() {
    let Studied { json, page, .. } = study(&[("a&b.csg", PLATE)], &["a&b.csg", "--traversals=samet"]);
    let scene = &json["scenes"][0];
    assert_eq!((&scene["name"], &scene["primitives"], &scene["tree_depth"]), (&"a&b.csg".into(), &2.into(), &1.into()));
    let advice = &scene["advice"];
    assert!(spread(&advice["speedup"])[0] > 0.0 && advice["options"].as_str().unwrap().starts_with("--traversal "));
    assert!(page.contains("Which settings suit which scene") && page.contains("a&amp;b.csg"));
    assert!(page.contains("Stay with the default settings") || page.contains("times as fast as the default settings"));
}

#[test]
fn the_page_needs_nothing_but_itself() {
    let Studied { page, .. } = study(&[], &["--scenes=chain", "--traversals=bresenham"]);
    assert!(page.starts_with("<!DOCTYPE html>") && page.ends_with("</html>"));
    assert!(page.matches("<svg").count() >= 2, "growth and memory are plotted");
    for fetched in ["<script", "<link", "<img", "<iframe", "@import", "url(", " src=", " href="] {
        assert!(!page.contains(fetched), "{fetched}");
    }
    // Names of XML's vocabularies are not fetched.
    let addresses = page.matches("://").count();
    assert_eq!(addresses, page.matches("xmlns=\"http://www.w3.org/2000/svg\"").count());
}

#[test]
fn what_is_too_deep_for_a_grid_is_not_possible() {
    let words = ["--scenes=chain-16", "--traversals=fujimoto", "--leaf-primitives=1", "--octree-depth=3,9"];
    let Studied { json, page, .. } = study(&[], &words);
    let status: Vec<(&Value, &Value)> =
        list(&json["scenes"][0]["runs"]).iter().map(|run| (&run["octree_depth"], &run["status"])).collect();
    let expected = [(Value::Null, "measured"), (3.into(), "measured"), (9.into(), "not-possible")];
    assert_eq!(status.len(), expected.len());
    for (found, expected) in std::iter::zip(status, expected) {
        assert_eq!(found, (&expected.0, &expected.1.into()));
    }
    assert!(page.contains("not possible at this depth: fujimoto has 8 levels at most"));
}

#[test]
fn mistakes_leave_no_files() {
    let files = [("bad.csg", "cube(size = [1, 2"), ("good.csg", PLATE)];
    let folder = Folder::with(&files);
    let bad = folder.run(&["study", "good.csg", "bad.csg", "--quick"]).expect(1);
    assert!(bad.stderr.contains("bad.csg:1:"), "{}", bad.stderr);
    assert!(folder.run(&["study", "missing.csg"]).expect(3).stderr.contains("cannot read missing.csg"));
    assert!(folder.run(&["study", "--scenes=teapot"]).expect(2).stderr.contains("there is no scene \"teapot\""));
    assert!(folder.run(&["study", "--octree-depth=21"]).expect(2).stderr.contains("write auto or a whole number"));
    assert!(folder.run(&["study", "--size=4000x4000"]).expect(2).stderr.contains("2048x2048"));
    assert!(folder.run(&["study", "good.csg", "--out=good.csg"]).expect(2).stderr.contains("would replace"));
    assert!(
        folder.run(&["study", "good.csg", "--out=a.html", "--json=a.html"]).expect(2).stderr.contains("two places")
    );
    folder.run(&["study", "good.csg", "--out=no/folder.html"]).expect(3);
    assert_eq!(folder.names(), ["bad.csg", "good.csg"]);
    assert_eq!(fs::read_to_string(folder.path("good.csg")).unwrap(), PLATE);
}

#[test]
fn standard_output_takes_either() {
    let folder = Folder::with(&[]);
    let little = ["study", "--quick", "--repeat=1", "--size=8x6", "--scenes=chain-4", "--traversals=samet", "--quiet"];
    let page = folder.run(&[&little[..], &["--out=-"]].concat()).expect(0);
    assert!(page.text().starts_with("<!DOCTYPE html>") && page.stderr.is_empty(), "{}", page.stderr);
    let json = folder.run(&[&little[..], &["--json=-"]].concat()).expect(0).json();
    assert_eq!(json["settings"]["width"], 8);
    assert_eq!(folder.names(), ["study.html"]);
}
