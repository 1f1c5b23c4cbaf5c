//! Real models: every one is read, and what it still lacks is listed in full.

mod corpora;

use corpora::openscad_dumps;
use octrace_read::{Facets, ReadOptions, Severity, Source, read_scene, syntax};
use std::path::PathBuf;

fn source(path: &PathBuf) -> Source {
    Source::new(path.to_string_lossy(), std::fs::read(path).expect("a dump can be read"))
}

#[test]
fn every_real_model_is_read_or_says_what_it_lacks() {
    let Some(dumps) = openscad_dumps() else { return };
    assert_eq!(dumps.len(), 172);
    let mut whole = 0;
    for path in &dumps {
        let source = source(path);
        let shown = path.display();
        let parsed = syntax::parse(&source);
        assert_eq!(parsed.diagnostics, [], "{shown}");
        let ast = parsed.value.expect("a tree is there");
        assert!(
            ast.same_tree(&syntax::parse(&Source::new("again", syntax::print(&ast))).value.expect("a tree")),
            "{shown}"
        );

        for facets in Facets::ALL {
            let options = ReadOptions { facets, ..ReadOptions::default() };
            let checked = read_scene(&source, &options);
            let errors = checked.diagnostics.iter().filter(|d| d.severity == Severity::Error);
            let codes: Vec<&str> = errors.map(|d| d.code).collect();
            whole += usize::from(codes.is_empty());
            assert_eq!(codes.is_empty(), checked.value.is_some(), "{shown}");
            // Two models hold sheets that are no solids.
            let known = |code: &&str| matches!(*code, "unsupported-node" | "polyhedron-open");
            assert!(codes.iter().all(known), "{shown}: {codes:?}");
            assert!(codes.is_empty() || codes.contains(&"unsupported-node"), "{shown}: {codes:?}");
        }
    }
    assert_eq!(whole, 3 * 52, "models that need nothing but what can be rendered");
}

/// Every place counts: as many as a search for words in the text finds, where nothing is nested.
#[test]
fn the_list_of_what_is_missing_is_complete() {
    let Some(dumps) = openscad_dumps() else { return };
    let logo = dumps.iter().find(|p| p.ends_with("Basics__LetterBlock.csg")).expect("an example of OpenSCAD");
    let source = source(logo);
    let listed = read_scene(&source, &ReadOptions::default()).diagnostics;
    assert_eq!(
        listed.iter().filter(|d| d.code == "unsupported-node").count(),
        source.text().matches("_extrude(").count()
    );
}

#[test]
fn what_is_left_out_is_named_and_the_rest_is_there() {
    let Some(dumps) = openscad_dumps() else { return };
    let options = ReadOptions { skip_unsupported: true, ..ReadOptions::default() };
    let (mut drawn, mut nothing) = (0, 0);
    for path in &dumps {
        let checked = read_scene(&source(path), &options);
        let shown = path.display();
        match &checked.value {
            Some(loaded) => {
                let warned = checked.diagnostics.iter().filter(|d| d.code == "unsupported-node").count();
                assert_eq!(warned, loaded.skipped.len(), "{shown}");
                drawn += 1;
            }
            None => {
                let errors = checked.diagnostics.iter().filter(|d| d.severity == Severity::Error);
                let codes: Vec<&str> = errors.map(|d| d.code).collect();
                assert!(
                    codes.iter().all(|c| c.starts_with("polyhedron-")) || codes == ["empty-scene"],
                    "{shown}: {codes:?}"
                );
                nothing += 1;
            }
        }
    }
    assert_eq!(drawn + nothing, 172);
    eprintln!("{drawn} drawn, {nothing} without anything to draw");
    assert!(drawn >= 52 + 50);
}
