//! What was measured, for people: two tables, of the scenes that come with the program and of files.

use super::results::Row;
use crate::statistics::Spread;
use std::fmt::Write;

/// The rows as text, with a word on what the columns mean.
pub fn table(rows: &[Row]) -> String {
    let (files, scenes): (Vec<&Row>, Vec<&Row>) = rows.iter().partition(|row| row.parse_s.is_some());
    let mut text = String::new();
    if !scenes.is_empty() {
        text += &of_scenes(&scenes);
    }
    if !files.is_empty() {
        if !text.is_empty() {
            text.push('\n');
        }
        text += &of_files(&files);
    }
    text
}

/// Cells are aligned to the right, but for the first column's.
fn aligned(lines: &[Vec<String>]) -> String {
    let columns = lines.iter().map(Vec::len).max().unwrap_or(0);
    let width = |column: usize| lines.iter().filter_map(|line| line.get(column)).map(|cell| cell.chars().count()).max();
    let widths: Vec<usize> = (0..columns).map(|column| width(column).unwrap_or(0)).collect();
    let mut text = String::new();
    for cells in lines {
        let mut line = String::new();
        for (column, (cell, width)) in std::iter::zip(cells, &widths).enumerate() {
            let _ = match column {
                0 => write!(line, "{cell:<width$}"),
                _ => write!(line, "  {cell:>width$}"),
            };
        }
        text += line.trim_end();
        text.push('\n');
    }
    text
}

fn of_scenes(rows: &[&Row]) -> String {
    let threads = rows.iter().map(|row| row.threads).max().unwrap_or(1);
    let heads = ["scene", "primitives", "Mrays/s", "±", "limit", "ratio", "+shadow", "frame", "compile", "build", "MB"];
    let mut lines = vec![heads.map(str::to_owned).to_vec()];
    if threads > 1 {
        lines[0].insert(6, format!("{threads}:1"));
    }
    for row in rows {
        let mut line = vec![
            row.scene.clone(),
            row.primitives.to_string(),
            short(row.mrays_per_s),
            percent(&row.spread.mrays_per_s),
            row.limit_mrays_per_s.map_or("-".into(), short),
            row.ratio_to_limit.map_or("-".into(), short),
            short(row.shadowed_mrays_per_s),
            milliseconds(row.frame_s),
            milliseconds(row.compile_s),
            milliseconds(row.build_s),
            short(row.bytes as f64 / 1e6),
        ];
        if threads > 1 {
            line.insert(6, row.speedup.map_or("-".into(), short));
        }
        lines.push(line);
    }
    let mut text = aligned(&lines);
    text += "\nMrays/s: camera rays in millions a second, one thread; +shadow: with one shadow ray where light may fall;\n\
             limit: told what each pixel shows; ratio: limit over Mrays/s; times in ms of processor time\n";
    text
}

fn of_files(rows: &[&Row]) -> String {
    let heads = ["file", "primitives", "parse", "compile", "build", "frame", "all", "Mrays/s", "MB"];
    let mut lines = vec![heads.map(str::to_owned).to_vec()];
    for row in rows {
        lines.push(vec![
            row.scene.clone(),
            row.primitives.to_string(),
            milliseconds(row.parse_s.unwrap_or(0.0)),
            milliseconds(row.compile_s),
            milliseconds(row.build_s),
            milliseconds(row.frame_s),
            milliseconds(row.first_picture_s()),
            short(row.mrays_per_s),
            short(row.bytes as f64 / 1e6),
        ]);
    }
    if rows.len() > 2 {
        let summary = |name: &str, of: fn(&[f64]) -> f64| {
            let column = |value: fn(&Row) -> f64| {
                let mut values: Vec<f64> = rows.iter().map(|row| value(row)).collect();
                values.sort_by(f64::total_cmp);
                of(&values)
            };
            vec![
                name.to_owned(),
                (column(|row| row.primitives as f64)).round().to_string(),
                milliseconds(column(|row| row.parse_s.unwrap_or(0.0))),
                milliseconds(column(|row| row.compile_s)),
                milliseconds(column(|row| row.build_s)),
                milliseconds(column(|row| row.frame_s)),
                milliseconds(column(Row::first_picture_s)),
                short(column(|row| row.mrays_per_s)),
                short(column(|row| row.bytes as f64 / 1e6)),
            ]
        };
        lines.push(Vec::new());
        lines.push(summary("median", |sorted| quantile(sorted, 0.5)));
        lines.push(summary("nine in ten are at most", |sorted| quantile(sorted, 0.9)));
        lines.push(summary("greatest", |sorted| quantile(sorted, 1.0)));
    }
    let mut text = aligned(&lines);
    text += "\nTimes in ms of processor time, one thread; build includes compile; all: from the file's text to the first frame\n";
    text
}

/// The value that a share of the sorted values does not exceed.
fn quantile(sorted: &[f64], share: f64) -> f64 {
    let last = sorted.len().saturating_sub(1);
    sorted.get((last as f64 * share).round() as usize).copied().unwrap_or(f64::NAN)
}

/// Three digits.
fn short(value: f64) -> String {
    match value {
        v if v >= 100.0 => format!("{v:.0}"),
        v if v >= 10.0 => format!("{v:.1}"),
        v => format!("{v:.2}"),
    }
}

fn milliseconds(seconds: f64) -> String {
    short(seconds * 1e3)
}

/// How far values go apart, to either side of the median.
fn percent(spread: &Spread) -> String {
    let share = (spread.max - spread.min) / 2.0 / spread.median.max(f64::MIN_POSITIVE);
    format!("{:.0} %", share * 100.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_are_aligned() {
        let line = |cells: &[&str]| cells.iter().map(|cell| (*cell).to_owned()).collect::<Vec<_>>();
        let text = aligned(&[line(&["a", "bb", "c"]), line(&["long", "1", "22"]), Vec::new()]);
        assert_eq!(text, "a     bb   c\nlong   1  22\n\n");
    }

    #[test]
    fn quantiles_are_values() {
        let sorted = [1.0, 2.0, 3.0, 4.0, 10.0];
        assert_eq!([0.5, 0.9, 1.0].map(|share| quantile(&sorted, share)), [3.0, 10.0, 10.0]);
        assert!(quantile(&[], 0.5).is_nan());
    }
}
