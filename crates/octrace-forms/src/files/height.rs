//! Height fields, as OpenSCAD's `surface` reads them: a table of numbers or a picture becomes a closed body.
//!
//! Neighbouring samples are one unit apart. Over each cell of four samples four triangles meet in the middle, at the mean
//! height. The body goes down to one unit below the lowest sample, or to zero where that is lower. Short rows end in samples
//! that are zero, and do not count as lowest.

use super::mesh::RawMesh;
use octrace::Vec3;
use std::io::Cursor;

/// No more samples than these are read.
const MOST_SAMPLES: usize = 1 << 24;

/// A table of heights, a row of samples for each `y`, from below.
#[derive(Clone, Debug, PartialEq)]
pub struct HeightField {
    columns: usize,
    samples: Vec<f64>,
    /// The lowest sample that the file has.
    lowest: f64,
}

/// Where the body of a height field stands.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Placement {
    /// The first sample is at the origin.
    #[default]
    Corner,
    /// The origin is in the middle.
    Centered,
}

/// How bright pixels become heights.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Shades {
    /// White is 100 high, black is 0.
    #[default]
    BrightIsHigh,
    /// Black is 100/255 high, white 100 lower: what OpenSCAD makes of `invert = true`.
    DarkIsHigh,
}

/// Why bytes are not a height field.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum HeightError {
    /// Something that is not a finite number.
    #[error("line {line}: `{found}` is not a number")]
    NotANumber {
        /// Line of the file, from 1.
        line: usize,
        /// What is there.
        found: String,
    },
    /// There are fewer than two rows, or no row has two numbers.
    #[error("a surface takes at least 2 rows of 2 heights; found {rows} by {columns}")]
    TooSmall {
        /// Rows found.
        rows: usize,
        /// Heights in the longest row.
        columns: usize,
    },
    /// Too many samples to make a body of.
    #[error("the surface has more than {} heights", MOST_SAMPLES)]
    TooLarge,
    /// The picture cannot be decoded.
    #[error("the PNG picture cannot be read")]
    Png(#[from] png::DecodingError),
}

impl HeightField {
    /// Reads a PNG picture or else a table of numbers: whichever it is by its first bytes. `shades` matters to pictures
    /// only.
    ///
    /// # Errors
    /// If it is neither, or too small or large: see [`HeightError`].
    pub fn read(bytes: &[u8], shades: Shades) -> Result<Self, HeightError> {
        let field = match bytes.starts_with(b"\x89PNG\r\n\x1a\n") {
            true => picture(bytes, shades)?,
            false => table(bytes)?,
        };
        let (rows, columns) = (field.rows(), field.columns);
        if rows < 2 || columns < 2 { Err(HeightError::TooSmall { rows, columns }) } else { Ok(field) }
    }

    /// How many rows there are.
    pub fn rows(&self) -> usize {
        self.samples.len().checked_div(self.columns).unwrap_or(0)
    }

    /// The body between the heights and its flat bottom.
    pub fn body(&self, placement: Placement) -> RawMesh {
        let (columns, rows) = (self.columns, self.rows());
        let corner = match placement {
            Placement::Corner => (0.0, 0.0),
            Placement::Centered => (-((columns - 1) as f64) / 2.0, -((rows - 1) as f64) / 2.0),
        };
        let at = |x: f64, y: f64, z: f64| Vec3::new(corner.0 + x, corner.1 + y, z);
        let bottom = (self.lowest - 1.0).min(0.0);
        let mut mesh = RawMesh::default();
        for (index, &z) in self.samples.iter().enumerate() {
            mesh.points.push(at((index % columns) as f64, (index / columns) as f64, z));
        }
        let sample = |x: usize, y: usize| (y * columns + x) as u32;
        for (x, y) in (0..rows - 1).flat_map(|y| (0..columns - 1).map(move |x| (x, y))) {
            let around = [sample(x, y), sample(x + 1, y), sample(x + 1, y + 1), sample(x, y + 1)];
            let mean = around.iter().map(|&i| self.samples[i as usize] / 4.0).sum();
            let middle = mesh.points.len() as u32;
            mesh.points.push(at(x as f64 + 0.5, y as f64 + 0.5, mean));
            mesh.faces.extend((0..4).map(|i| vec![around[i], around[(i + 1) % 4], middle]));
        }
        // Once around, counter-clockwise from above; below each sample on the way a corner of the bottom.
        let below_row = (0..columns - 1).map(|x| sample(x, 0));
        let right = (0..rows - 1).map(|y| sample(columns - 1, y));
        let above_row = (1..columns).rev().map(|x| sample(x, rows - 1));
        let left = (1..rows).rev().map(|y| sample(0, y));
        let rim: Vec<u32> = below_row.chain(right).chain(above_row).chain(left).collect();
        let first = mesh.points.len() as u32;
        mesh.points.extend(
            rim.iter()
                .map(|&i| (i as usize % columns, i as usize / columns))
                .map(|(x, y)| at(x as f64, y as f64, bottom)),
        );
        for (i, &top) in rim.iter().enumerate() {
            let next = (i + 1) % rim.len();
            mesh.faces.push(vec![first + i as u32, first + next as u32, rim[next], top]);
        }
        mesh.faces.push((first..first + rim.len() as u32).rev().collect());
        mesh
    }
}

/// Rows of numbers between blanks; lines that are empty or begin with `#` do not count; short rows end in zeros.
fn table(bytes: &[u8]) -> Result<HeightField, HeightError> {
    let text = String::from_utf8_lossy(bytes);
    let mut rows: Vec<Vec<f64>> = Vec::new();
    for (line, content) in (1..).zip(text.lines()) {
        let content = content.trim();
        if content.is_empty() || content.starts_with('#') {
            continue;
        }
        let number = |word: &str| match word.parse::<f64>() {
            Ok(number) if number.is_finite() => Ok(number),
            _ => Err(HeightError::NotANumber { line, found: word.chars().take(40).collect() }),
        };
        rows.push(content.split_whitespace().map(number).collect::<Result<_, _>>()?);
    }
    let columns = rows.iter().map(Vec::len).max().unwrap_or(0);
    // One long row among many short ones would make a table much larger than the file.
    if columns.saturating_mul(rows.len()) > MOST_SAMPLES {
        return Err(HeightError::TooLarge);
    }
    let mut samples = Vec::with_capacity(columns * rows.len());
    let lowest = rows.iter().flatten().copied().fold(f64::INFINITY, f64::min);
    for mut row in rows {
        row.resize(columns, 0.0);
        samples.append(&mut row);
    }
    Ok(HeightField { columns, samples, lowest })
}

/// A pixel's luminance is its height; the picture's last row comes first.
fn picture(bytes: &[u8], shades: Shades) -> Result<HeightField, HeightError> {
    let mut decoder = png::Decoder::new(Cursor::new(bytes));
    decoder.set_transformations(png::Transformations::normalize_to_color8());
    let mut reader = decoder.read_info()?;
    let (width, height) = reader.info().size();
    if u64::from(width) * u64::from(height) > MOST_SAMPLES as u64 {
        return Err(HeightError::TooLarge);
    }
    let mut pixels = vec![0; reader.output_buffer_size().ok_or(HeightError::TooLarge)?];
    let frame = reader.next_frame(&mut pixels)?;
    let channels = frame.color_type.samples();
    let shade = |pixel: &[u8]| {
        let [r, g, b] = if channels < 3 { [pixel[0]; 3] } else { [pixel[0], pixel[1], pixel[2]] }.map(f64::from);
        0.2126 * r + 0.7152 * g + 0.0722 * b
    };
    let height_of = |shade: f64| match shades {
        Shades::BrightIsHigh => 100.0 / 255.0 * shade,
        Shades::DarkIsHigh => 100.0 / 255.0 * (1.0 - shade),
    };
    let columns = frame.width as usize;
    let rows = pixels.chunks_exact(frame.line_size).take(frame.height as usize);
    let pixels = rows.rev().flat_map(|row| row.chunks_exact(channels).take(columns));
    let samples: Vec<f64> = pixels.map(|pixel| height_of(shade(pixel))).collect();
    let lowest = samples.iter().copied().fold(f64::INFINITY, f64::min);
    Ok(HeightField { columns, samples, lowest })
}

#[cfg(test)]
mod tests {
    use super::*;

    const TABLE: &[u8] = b"# a comment\n1 2 3\n4 5 6 7\n\n  # another\n5 -3 2\n";

    fn check(bytes: &[u8], placement: Placement, volume: f64, low: [f64; 3], high: [f64; 3]) {
        let body = HeightField::read(bytes, Shades::default()).unwrap().body(placement).into_polyhedron().unwrap();
        let bounds = octrace::Bounds::around(body.points().iter().copied());
        assert!((body.volume() - volume).abs() < 1e-9 * volume, "{}", body.volume());
        assert_eq!((bounds.min, bounds.max), (low.into(), high.into()));
    }

    #[test]
    fn tables_are_read_row_by_row_from_below() {
        // Over a cell the mean height is that of its corners; the bottom is at -4. The six cells' means are 3, 4, 4,
        // 2.75, 2.5 and 3.75.
        check(TABLE, Placement::Corner, 20.0 + 24.0, [0.0, 0.0, -4.0], [3.0, 2.0, 7.0]);
        check(TABLE, Placement::Centered, 44.0, [-1.5, -1.0, -4.0], [1.5, 1.0, 7.0]);
    }

    #[test]
    fn the_bottom_is_at_zero_at_most() {
        check(b"5 5\n5 5", Placement::Corner, 5.0, [0.0, 0.0, 0.0], [1.0, 1.0, 5.0]);
        check(b"4 4\n4", Placement::Corner, 3.0, [0.0, 0.0, 0.0], [1.0, 1.0, 4.0]);
    }

    /// A picture of 3 by 2 pixels: red, green, blue above white, black, and (10, 20, 30).
    fn encoded() -> Vec<u8> {
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, 3, 2);
        encoder.set_color(png::ColorType::Rgb);
        let pixels = [255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255, 0, 0, 0, 10, 20, 30];
        encoder.write_header().unwrap().write_image_data(&pixels).unwrap();
        bytes
    }

    #[test]
    fn pictures_are_as_high_as_they_are_bright() {
        let heights = |shades| HeightField::read(&encoded(), shades).unwrap().samples;
        // What OpenSCAD 2021.01 makes of the same picture.
        let bright = [100.0, 0.0, 7.29255, 21.26, 71.52, 7.22];
        let dark = [-99.6078, 0.392157, -6.90039, -20.8678, -71.1278, -6.82784];
        for (shades, expected) in [(Shades::BrightIsHigh, bright), (Shades::DarkIsHigh, dark)] {
            for (height, expected) in heights(shades).into_iter().zip(expected) {
                assert!((height - expected).abs() < 1e-4, "{height} {expected}");
            }
        }
    }

    #[test]
    fn what_is_wrong_is_named() {
        let check = |bytes: &[u8], expected: &str| {
            assert_eq!(HeightField::read(bytes, Shades::default()).unwrap_err().to_string(), expected);
        };
        check(b"1 2\n3 four", "line 2: `four` is not a number");
        check(b"1 2\n3 nan", "line 2: `nan` is not a number");
        check(b"1 2 3", "a surface takes at least 2 rows of 2 heights; found 1 by 3");
        check(b"", "a surface takes at least 2 rows of 2 heights; found 0 by 0");
        check(b"\x89PNG\r\n\x1a\n....", "the PNG picture cannot be read");
        let ragged = ["1 ".repeat(1 << 13), "1\n".repeat(1 << 13)].join("\n");
        check(ragged.as_bytes(), "the surface has more than 16777216 heights");
    }
}
