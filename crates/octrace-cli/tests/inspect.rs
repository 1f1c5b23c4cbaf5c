//! `octrace inspect`, the real program.

mod common;

use common::{Folder, PLATE};

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
