//! Writes a tree the way OpenSCAD does. Reading it again gives the same tree.

use super::{Ast, Modifiers, NodeId, Rows, Value, View};
use std::fmt::Write;

/// The deepest level that gets an indentation of its own; without a limit the text of a deep tree would grow with the
/// square of its depth.
const DEEPEST_INDENT: usize = 40;

/// The text of a tree: a node a line, numbers in full precision.
pub fn print(ast: &Ast) -> String {
    let mut out = String::new();
    let mut open = vec![ast.roots()];
    while let Some(siblings) = open.last_mut() {
        let Some(node) = siblings.next() else {
            open.pop();
            if !open.is_empty() {
                indent(&mut out, open.len() - 1);
                out.push_str("}\n");
            }
            continue;
        };
        indent(&mut out, open.len() - 1);
        print_head(ast, node, &mut out);
        if ast.subtree_len(node) > 1 {
            out.push_str(" {\n");
            open.push(ast.children(node));
        } else {
            out.push_str(";\n");
        }
    }
    out
}

fn indent(out: &mut String, depth: usize) {
    out.extend(std::iter::repeat_n('\t', depth.min(DEEPEST_INDENT)));
}

fn print_head(ast: &Ast, node: NodeId, out: &mut String) {
    let modifiers = ast.modifiers(node);
    out.extend(Modifiers::ALL.iter().filter(|(m, _)| modifiers.contains(*m)).map(|(_, byte)| char::from(*byte)));
    out.push_str(ast.name(node));
    out.push('(');
    for (i, arg) in ast.args(node).iter().enumerate() {
        if i > 0 {
            out.push_str(", ");
        }
        if let Some(name) = ast.arg_name(arg) {
            out.push_str(name);
            out.push_str(" = ");
        }
        print_value(ast, arg.value, out);
    }
    out.push(')');
}

fn print_value(ast: &Ast, value: Value, out: &mut String) {
    let mut open = vec![std::slice::from_ref(&value).iter()];
    while let Some(items) = open.last_mut() {
        let Some(&item) = items.next() else {
            open.pop();
            if !open.is_empty() {
                out.push(']');
                separate(&open, out);
            }
            continue;
        };
        match ast.view(item) {
            View::Undef => out.push_str("undef"),
            View::Bool(b) => out.push_str(if b { "true" } else { "false" }),
            View::Number(v) => print_number(v, out),
            View::Text(text) => print_text(text, out),
            View::Numbers(numbers) => print_numbers(numbers, out),
            View::Rows(rows) => print_rows(rows, out),
            View::List(list) => {
                out.push('[');
                open.push(list.iter());
                continue;
            }
        }
        separate(&open, out);
    }
}

/// A comma, where the innermost open vector goes on.
fn separate(open: &[std::slice::Iter<'_, Value>], out: &mut String) {
    if open.last().is_some_and(|rest| rest.len() > 0) {
        out.push_str(", ");
    }
}

fn print_rows(rows: Rows<'_>, out: &mut String) {
    out.push('[');
    for (i, row) in rows.iter().enumerate() {
        if i > 0 {
            out.push_str(", ");
        }
        print_numbers(row, out);
    }
    out.push(']');
}

fn print_numbers(numbers: &[f64], out: &mut String) {
    out.push('[');
    for (i, &v) in numbers.iter().enumerate() {
        if i > 0 {
            out.push_str(", ");
        }
        print_number(v, out);
    }
    out.push(']');
}

fn print_number(v: f64, out: &mut String) {
    if v.is_nan() {
        out.push_str("nan");
        return;
    }
    // `Debug` is the shortest form that reads back as the same number, and writes 1e300 as such.
    let start = out.len();
    write!(out, "{v:?}").expect("writing to a string cannot fail");
    if out[start..].ends_with(".0") {
        out.truncate(out.len() - 2);
    }
}

fn print_text(text: &str, out: &mut String) {
    out.push('"');
    for c in text.chars() {
        match c {
            '"' => out.push_str("\\\""),
            '\\' => out.push_str("\\\\"),
            '\n' => out.push_str("\\n"),
            '\t' => out.push_str("\\t"),
            '\r' => out.push_str("\\r"),
            c => out.push(c),
        }
    }
    out.push('"');
}
