//! The laws of the fuzz targets, over every scene and every input of the reader's suite, whole and damaged.

#[path = "../../../fuzz/laws.rs"]
mod laws;

use std::fs;
use std::path::{Path, PathBuf};

/// All files of a folder and those in it, in order.
fn files(folder: &Path) -> Vec<PathBuf> {
    let mut files = Vec::new();
    let mut pending = vec![folder.to_owned()];
    while let Some(folder) = pending.pop() {
        for entry in fs::read_dir(&folder).unwrap_or_else(|e| panic!("{}: {e}", folder.display())) {
            let path = entry.expect("the folder can be listed").path();
            if path.is_dir() { pending.push(path) } else { files.push(path) }
        }
    }
    files.sort();
    files
}

fn inputs() -> Vec<Vec<u8>> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let folders = ["scenes", "crates/octrace-read/tests/suite"];
    let inputs: Vec<_> = folders.iter().flat_map(|folder| files(&root.join(folder))).collect();
    assert!(inputs.len() > 30, "{} inputs", inputs.len());
    inputs.iter().map(|path| fs::read(path).expect("an input can be read")).collect()
}

#[test]
fn any_input_is_parsed() {
    for input in inputs() {
        laws::parse(&input);
        for cut in [input.len() / 3, input.len() * 2 / 3] {
            laws::parse(&input[..cut]);
            laws::parse(&input[cut..]);
        }
    }
}

#[test]
fn any_input_is_traced() {
    for input in inputs() {
        laws::trace(&input);
    }
}

#[test]
fn any_bytes_are_a_file_or_an_error() {
    let seeds = files(&Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fuzz/seeds"));
    assert!(seeds.len() >= 9, "{} seeds", seeds.len());
    for seed in seeds.iter().map(|path| fs::read(path).expect("a seed can be read")) {
        laws::files(&seed);
        for part in 1..16 {
            let at = seed.len() * part / 16;
            laws::files(&seed[..at]);
            laws::files(&seed[at..]);
            for wrong in [b'0', b'-', b'9', b'\n', 0, 255] {
                let mut damaged = seed.clone();
                damaged[at] = wrong;
                laws::files(&damaged);
            }
        }
    }
}

/// What fuzzing finds goes here, with a name.
#[test]
fn extreme_numbers_are_traced() {
    for input in ["", "cube(1e300);", "sphere(r=1e-300);", "translate([1e300,0,0]) cube(1); cube(1);", "torus(1,1e-9);"]
    {
        laws::trace(input.as_bytes());
    }
}

/// The drawing's numbers one by one as large and as small as numbers get: products of them leave the range.
#[test]
fn extreme_numbers_in_drawings_are_a_drawing_or_an_error() {
    for name in ["plate.dxf", "plate.svg", "hills.dat", "corner.stl"] {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fuzz/seeds").join(name);
        let text = fs::read_to_string(&path).expect("a seed can be read");
        let is_number = |word: &str| word.parse::<f64>().is_ok();
        let words: Vec<&str> = text.split_inclusive([' ', '\n', '"', ',']).collect();
        for extreme in ["1e308", "-1e300", "1e-310", "4e9"] {
            let changed = |i: usize, word: &str| {
                let number = word.trim_end_matches([' ', '\n', '"', ',']);
                let end = &word[number.len()..];
                if is_number(number) && i % 2 == 1 { format!("{extreme}{end}") } else { word.to_owned() }
            };
            let all: String = words.iter().enumerate().map(|(i, word)| changed(i, word)).collect();
            laws::files(all.as_bytes());
            for (i, word) in words.iter().enumerate().filter(|(_, word)| is_number(word.trim_end())) {
                let one = format!("{extreme}{}", &word[word.trim_end().len()..]);
                let text = [&words[..i].concat(), one.as_str(), &words[i + 1..].concat()].concat();
                laws::files(text.as_bytes());
            }
        }
    }
}
