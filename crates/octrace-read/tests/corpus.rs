//! Real models: every one is read.

mod corpora;

use corpora::{openscad_dumps, source};
use octrace_read::{Facets, ReadOptions, Severity, read_scene, syntax};

#[test]
fn every_real_model_is_read() {
    let Some(dumps) = openscad_dumps() else { return };
    assert_eq!(dumps.len(), 172);
    for path in &dumps {
        let source = source(path);
        let shown = path.display();
        let parsed = syntax::parse(&source);
        assert_eq!(parsed.diagnostics, [], "{shown}");
        let ast = parsed.value.expect("a tree is there");
        let again = octrace_read::Source::new("again", syntax::print(&ast));
        assert!(ast.same_tree(&syntax::parse(&again).value.expect("a tree")), "{shown}");

        for facets in Facets::ALL {
            let checked = read_scene(&source, &ReadOptions { facets, ..ReadOptions::default() });
            let errors = checked.diagnostics.iter().filter(|d| d.severity == Severity::Error);
            let codes: Vec<&str> = errors.map(|d| d.code).collect();
            // The first operand of that one's difference is a move without children: OpenSCAD finds it empty too.
            let expected: &[&str] = if path.ends_with("soldertrayholder.csg") { &["empty-scene"] } else { &[] };
            assert_eq!(codes, expected, "{shown}");
            assert_eq!(codes.is_empty(), checked.value.is_some(), "{shown}");
        }
    }
}
