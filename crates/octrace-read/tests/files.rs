//! What an input file names is read as often as it has to be.

use octrace_read::{Assets, ReadOptions, Source, read_scene};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

const TETRAHEDRON: &str = "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n";

/// One mesh by any name, and how often it was asked for.
#[derive(Debug, Default)]
struct Counted(Arc<AtomicUsize>);

impl Assets for Counted {
    fn read(&self, _: &str) -> std::io::Result<Vec<u8>> {
        self.0.fetch_add(1, Ordering::Relaxed);
        Ok(TETRAHEDRON.into())
    }
}

/// How often files are read for this text, and how many leaves there are.
fn reads(text: &str) -> (usize, usize) {
    let counted = Counted::default();
    let count = Arc::clone(&counted.0);
    let source = Source::new("a.csg", text).with_assets(counted);
    let checked = read_scene(&source, &ReadOptions::default());
    let loaded = checked.value.unwrap_or_else(|| panic!("{:?}", checked.diagnostics));
    (count.load(Ordering::Relaxed), loaded.leaves)
}

#[test]
fn a_file_that_is_imported_often_is_read_once() {
    let copy = |i: usize, leaf: &str| {
        format!("multmatrix([[1,0,0,{i}],[0,1,0,0],[0,0,1,0],[0,0,0,1]]) color([0.{i},0,0,1]) {leaf}\n")
    };
    let many = |leaf: &str| (1..=5).map(|i| copy(i, leaf)).collect::<String>();
    let (a, b) = (r#"import(file = "a.off");"#, r#"import(file = "b.off");"#);
    assert_eq!(reads(a), (1, 1));
    assert_eq!(reads(&many(a)), (1, 5));
    assert_eq!(reads(&(many(a) + &many(b))), (2, 10));
    // What is marked is looked at by itself.
    assert_eq!(reads(&format!("{a}\n#{a}\n")), (2, 2));
}
