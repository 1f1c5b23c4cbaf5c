//! The syntax layer: text to tree and back, and whatever can be wrong with a text.

use octrace_read::syntax::{Ast, AstBuilder, Modifiers, NodeId, View, parse, print};
use octrace_read::{Checked, Severity, Source};
use proptest::prelude::*;

fn read(text: &str) -> Checked<Ast> {
    parse(&Source::new("test.csg", text))
}

fn sound(text: &str) -> Ast {
    let checked = read(text);
    assert_eq!(checked.diagnostics, [], "{text}");
    checked.value.expect("a tree is there")
}

/// The codes of what is wrong with a text, each with the text at its place.
fn complaints(text: &str) -> Vec<(&'static str, String)> {
    let source = Source::new("test.csg", text);
    let all = parse(&source).diagnostics;
    all.iter().map(|d| (d.code, source.slice(d.at).to_owned())).collect()
}

fn check(text: &str, expected: &[(&str, &str)]) {
    let found = complaints(text);
    let found: Vec<(&str, &str)> = found.iter().map(|(code, at)| (*code, at.as_str())).collect();
    assert_eq!(found, expected, "{text}");
}

#[test]
fn a_dump_prints_as_it_was() {
    let dump = "difference() {\n\tcube(size = [1, -0, 1e-6], center = false);\n%\tgroup();\n\t#color([1, 0, 0, 0.5]) {\n\
        \t\tsphere($fn = 0, $fa = 12, $fs = 2, r = inf);\n\t}\n}\npolyhedron(points = [[0, 0, undef], [1, 2, 3]], \
        faces = [[0, 1, 2], []], convexity = 1);\ntext(text = \"a\\\"b\\\\c\\n\", size = nan);\n";
    let expected = dump.replace("%\tgroup", "\t%group");
    assert_eq!(print(&sound(dump)), expected);
}

#[test]
fn every_way_to_write_a_tree_is_the_same_tree() {
    let plain = sound("union() { translate([1, 2, 3]) { #cube(size = [1, 2, 3]); } sphere(); }");
    let fancy = sound(
        "\u{FEFF}// a comment\r\nunion ( ) {;\r\n  translate([1,2.0,3e0,],) # cube(size=[+1,2,/* two */3]);;\r\n sphere(\n);}",
    );
    assert!(plain.same_tree(&fancy));
    assert!(!plain.same_tree(&sound("union() { translate([1, 2, 3]) { cube(size = [1, 2, 3]); } sphere(); }")));
    assert!(!plain.same_tree(&sound("union() { translate([1, 2, 3]) { #cube(size = [1, 2, 3]); sphere(); } }")));
    assert!(!plain.same_tree(&sound("union() { translate([1, 2, 3]) { #cube(size = [1, 2, 4]); } sphere(); }")));
}

#[test]
fn vectors_are_stored_compactly() {
    let ast = sound("a([], [1, 2], [[1], [2, 3]], [[]], [1, [2]], [[1], true], [[[1, 2]], [3]]);");
    let kinds = |text: &str| {
        let ast = sound(text);
        let node = ast.roots().next().expect("a node");
        match ast.view(ast.args(node)[0].value) {
            View::Numbers(n) => format!("numbers {n:?}"),
            View::Rows(rows) => format!("rows {:?}", rows.iter().collect::<Vec<_>>()),
            View::List(list) => format!("list of {}", list.len()),
            other => format!("{other:?}"),
        }
    };
    assert_eq!(ast.len(), 1);
    assert_eq!(kinds("a([]);"), "numbers []");
    assert_eq!(kinds("a([1, 2]);"), "numbers [1.0, 2.0]");
    assert_eq!(kinds("a([[1], [2, 3], []]);"), "rows [[1.0], [2.0, 3.0], []]");
    assert_eq!(kinds("a([1, [2]]);"), "list of 2");
    assert_eq!(kinds("a([[1], true]);"), "list of 2");
    assert_eq!(kinds("a([[[1, 2]], [3]]);"), "list of 2");
    assert_eq!(print(&ast), "a([], [1, 2], [[1], [2, 3]], [[]], [1, [2]], [[1], true], [[[1, 2]], [3]]);\n");
}

#[test]
fn openscad_2021_does_not_escape_what_text_says() {
    let ast = sound("text(text = \"3\"\", size = 10);");
    let node = ast.roots().next().expect("a node");
    assert!(matches!(ast.view(ast.args(node)[0].value), View::Text("3\"")));
    assert_eq!(ast.args(node).len(), 2);
}

#[test]
fn nodes_know_their_place() {
    let source = Source::new("t.csg", "union() {\n  %cube(size = 3);\n}\nscale(2) sphere();");
    let ast = parse(&source).value.expect("a tree is there");
    let texts: Vec<&str> = ast.nodes().map(|n| source.slice(ast.at(n))).collect();
    assert_eq!(texts, ["union() {\n  %cube(size = 3);\n}", "%cube(size = 3)", "scale(2) sphere();", "sphere()"]);
    let cube: NodeId = ast.nodes().nth(1).expect("a cube");
    let arg = ast.args(cube)[0];
    assert_eq!((source.slice(arg.name_at), source.slice(arg.at)), ("size", "3"));
    assert_eq!(source.slice(ast.name_at(cube)), "cube");
    assert_eq!(ast.modifiers(cube), Modifiers::BACKGROUND);
}

#[test]
fn all_errors_are_found_at_once() {
    check(
        "cube(1;\nsphere(r = 1e);\nfoo bar\ncylinder(h = 1 r = 2);\nunion() cube() }\n}cube",
        &[
            ("unclosed-parenthesis", ";"),
            ("bad-number", "1e"),
            ("not-a-node", "foo bar"),
            ("missing-comma", "1"),
            ("missing-semicolon", ")"),
            ("unmatched-brace", "}"),
            ("unmatched-brace", "}"),
            ("unexpected-end", ""),
        ],
    );
}

#[test]
fn what_is_missing_is_named() {
    check("cube", &[("unexpected-end", "")]);
    check("cube;", &[("missing-parentheses", "cube")]);
    check("cube()", &[("unexpected-end", "")]);
    check("cube() ?", &[("missing-semicolon", ")")]);
    check("cube(size = );", &[("not-a-value", ")")]);
    check("cube([1, 2);", &[("unclosed-bracket", ")")]);
    check("cube([1 2]);", &[("missing-comma", " ")]);
    check("text(\"abc);\ncube();", &[("unclosed-string", "\"")]);
    check("/* no end", &[("unclosed-comment", "/*")]);
    check("{ cube(); }", &[("not-a-node", "{"), ("unmatched-brace", "}")]);
    check("union() { cube(); ", &[("unclosed-block", "")]);
    check("union() { cube([1, 2", &[("unclosed-bracket", "")]);
    check("union() { cube(size = ", &[("unclosed-parenthesis", "")]);
}

#[test]
fn the_end_of_a_truncated_file_names_what_is_open() {
    let source = Source::new("t.csg", "group() {\n\tunion() {\n\t\tcube(size = [1, 1, 1], center = false);\n");
    let checked = parse(&source);
    let [d] = &checked.diagnostics[..] else { panic!("{:?}", checked.diagnostics) };
    assert_eq!((d.severity, d.code), (Severity::Error, "unclosed-block"));
    assert_eq!(d.message, "the file ends, but 2 `}` are missing");
    let notes: Vec<_> = d.notes.iter().map(|(at, _)| source.line_col(at.start)).collect();
    assert_eq!(notes, [(2, 10), (1, 9)]);
    assert_eq!(checked.value.expect("a tree").len(), 3, "what is there is kept");
}

#[test]
fn programs_get_one_explanation() {
    let program = "n = 3;\nmodule a(x = [1, 2]) { cube(x); }\nfor (i = [0:n]) { translate([i, 0, 0]) cube(1); }\n\
        cube(n);\nsphere(2 * 3);\nif (n > 2) sphere(); else { cube(); }\ncube([0:2]);\nsphere(-n);\n\
        include <MCAD/gears.scad>\nunion() { a(); }";
    let found = read(program);
    let [d] = &found.diagnostics[..] else { panic!("{:?}", found.diagnostics) };
    assert_eq!(d.code, "not-evaluated");
    assert_eq!(d.message, "`n =` would have to be evaluated; here are only nodes with constant arguments");
    assert_eq!(d.notes.len(), 5);
    assert!(d.notes[4].1.contains("more places"));
    assert!(d.help.as_ref().is_some_and(|help| help.contains(".scad")));
    let ast = found.value.expect("a tree");
    let names: Vec<&str> = ast.nodes().map(|n| ast.name(n)).collect();
    assert_eq!(names, ["cube", "sphere", "cube", "sphere", "union", "a"]);
}

#[test]
fn junk_gets_one_answer() {
    let png = [0x89, b'P', b'N', b'G', b'\r', b'\n', 0x1A, b'\n', 0, 0, 0, 13];
    let found = parse(&Source::new("a.png", png)).diagnostics;
    assert_eq!(found.len(), 1);
    assert_eq!((found[0].code, found[0].at.start), ("not-text", 0));
    check("cube();\0\0\0", &[("not-text", "\0")]);
    let prose = "The quick brown fox. It jumps over a lazy (dog).\n".repeat(1000);
    assert_eq!(read(&prose).diagnostics.len(), 51, "fifty, and a count of the others");
}

#[test]
fn any_depth_is_only_a_longer_array() {
    const DEPTH: usize = 100_000;
    let blocks = "union() {".repeat(DEPTH) + &"}".repeat(DEPTH);
    let chain = "union() ".repeat(DEPTH) + ";";
    let ast = sound(&blocks);
    assert_eq!(ast.len(), DEPTH);
    assert!(ast.same_tree(&sound(&print(&ast))));
    assert_eq!(read(&chain).value.expect("a tree").len(), DEPTH);
    let vectors = format!("a({}{});", "[".repeat(DEPTH), "]".repeat(DEPTH));
    let ast = sound(&vectors);
    assert!(ast.same_tree(&sound(&print(&ast))));
    for open in
        ["union() {", "union() ", "union(", "a([", "a([1, [", "{", "(", "/*", "\"", "!", "a(\"", "if (", "module {"]
    {
        let _ = read(&open.repeat(DEPTH));
    }
}

/// A value, as a tree that a generator can make.
#[derive(Clone, Debug)]
enum Sketch {
    Undef,
    Bool(bool),
    Number(f64),
    Text(String),
    Vector(Vec<Sketch>),
}

fn value() -> impl Strategy<Value = Sketch> {
    let number = prop_oneof![
        (-9..9_i32).prop_map(f64::from),
        any::<f64>(),
        prop::sample::select(vec![-0.0, f64::INFINITY, f64::NEG_INFINITY, 1e-6, 1e300, 123_456.0, 0.1])
    ];
    let leaf = prop_oneof![
        8 => number.prop_map(Sketch::Number),
        1 => any::<bool>().prop_map(Sketch::Bool),
        1 => Just(Sketch::Undef),
        1 => "[a-z\"\\\\,) \n\té;/*]{0,6}".prop_map(Sketch::Text),
    ];
    leaf.prop_recursive(3, 12, 4, |inner| prop::collection::vec(inner, 0..4).prop_map(Sketch::Vector))
}

fn build_value(b: &mut AstBuilder, value: &Sketch) {
    match value {
        Sketch::Undef => b.undef(),
        Sketch::Bool(v) => b.bool(*v),
        Sketch::Number(v) => b.number(*v),
        Sketch::Text(text) => b.text(text),
        Sketch::Vector(items) => {
            b.open_vector();
            items.iter().for_each(|item| build_value(b, item));
            b.close_vector();
        }
    }
}

prop_compose! {
    /// Nodes in the order of a file, and after each how many levels end.
    fn tree()(nodes in prop::collection::vec(
        ("[a-z_$][a-z0-9_]{0,3}", 0..16_u8, prop::collection::vec((prop::option::of("[a-z$]{1,2}"), value()), 0..4), 0..3_u8),
        0..12,
    )) -> Ast {
        let mut b = AstBuilder::new();
        for (name, modifiers, args, levels) in nodes {
            let chosen = Modifiers::ALL.iter().enumerate().filter(|(i, _)| modifiers & (1 << i) != 0);
            let modifiers = chosen.fold(Modifiers::NONE, |all, (_, (m, _))| all.with(*m));
            b.open_node(&format!("{name}_"), modifiers);
            for (name, value) in &args {
                build_value(&mut b, value);
                b.finish_arg(name.as_deref());
            }
            (0..levels).for_each(|_| b.close_node());
        }
        b.finish()
    }
}

proptest! {
    /// Print, parse: same tree.
    #[test]
    fn a_printed_tree_reads_back(ast in tree()) {
        let text = print(&ast);
        let again = read(&text);
        prop_assert_eq!(&again.diagnostics, &vec![], "{}", text);
        prop_assert!(ast.same_tree(again.value.as_ref().expect("a tree")), "{}", text);
    }

    /// Whatever the text, there is an answer, and every place in it lies in the text.
    #[test]
    fn any_text_gets_an_answer(text in "([a-c(){}\\[\\],;=\"%#!*/<>. \n0-9é+-]|cube\\(|for|union\\(\\) \\{|\\[1, 2)*") {
        let source = Source::new("t.oct", text);
        for d in parse(&source).diagnostics {
            prop_assert!(d.at.start <= d.at.end && d.at.end as usize <= source.text().len());
        }
    }
}

/// More than a hundred letters, so that the reader copies it where it comes again.
const HOLDER: &str = "difference() {\n\t#translate([1, 2, 3.5]) cube(size = [1, 2, 3], center = true);\n\
    \tcolor(\"red\", alpha = 0.5) { sphere(r = 2.25); polyhedron([[0, 0, 0], [1, 2, 3]], [[0, 1]]); }\n}\n";

#[test]
fn what_is_repeated_is_what_it_would_be_if_it_were_not() {
    let outer = format!("group() {{\n{HOLDER}sphere(3);\nmirror([1, 0, 0]) {HOLDER}}}\n");
    let text = [HOLDER, &outer, "cube();\n", HOLDER, &outer, &outer, "rotate([0, 0, 9]) ", &outer, HOLDER].concat();
    let source = Source::new("test.csg", text.as_str());
    let ast = sound(&text);
    // A comment of another length in each keeps the reader from seeing that they are alike.
    let mut pieces = text.split("2.25").peekable();
    let mut different = String::new();
    for count in 0.. {
        let Some(piece) = pieces.next() else { break };
        different += piece;
        if pieces.peek().is_some() {
            different += &format!("2.25/*{}*/", "-".repeat(count));
        }
    }
    let unlike = sound(&different);
    assert_eq!(ast.len(), 3 * 6 + 4 * 15 + 2, "{}", print(&ast));
    assert!(ast.same_tree(&unlike));
    assert_eq!(print(&ast), print(&unlike));
    for (node, same) in ast.nodes().zip(unlike.nodes()) {
        assert_eq!(source.slice(ast.name_at(node)), ast.name(node));
        let other = Source::new("other.csg", different.as_str());
        let without_comments = |text: &str| {
            let mut words = text.split("/*");
            let first = words.next().unwrap_or_default().to_owned();
            words.fold(first, |all, word| all + word.split_once("*/").map_or("", |(_, rest)| rest))
        };
        assert_eq!(source.slice(ast.at(node)), without_comments(other.slice(unlike.at(same))));
        for (arg, same) in ast.args(node).iter().zip(unlike.args(same)) {
            assert_eq!(source.slice(arg.name_at), other.slice(same.name_at));
            assert_eq!(source.slice(arg.at), without_comments(other.slice(same.at)));
        }
    }
}

#[test]
fn what_is_wrong_is_said_of_every_copy() {
    let wrong = HOLDER.replace("sphere(r = 2.25);", "sphere(r = 2.25;");
    let found = complaints(&wrong.repeat(3));
    assert_eq!(found.len(), 3, "{found:?}");
    let evaluated = HOLDER.replace("sphere(r = 2.25);", "sphere(r = a + 1);");
    assert_eq!(parse(&Source::new("test.csg", evaluated.repeat(3).as_str())).diagnostics[0].notes.len(), 2);
}

#[test]
fn deep_trees_that_begin_alike_are_read_in_one_go() {
    // Every level begins like the one around it, and every tree differs at its very heart.
    let level = "translate([100000000, 200000000, 300000000]) rotate([100000000, 200000000, 300000000]) {\n";
    let deep = |heart: u32| format!("{}sphere({heart});{}\n", level.repeat(3000), "}".repeat(3000));
    let text: String = (0..20).map(deep).collect();
    assert_eq!(sound(&text).len(), 20 * 6001);
}
