//! Lines in a plane with logarithmic axes, as SVG.

use plotters::coord::combinators::{BindKeyPoints, IntoLogRange};
use plotters::drawing::DrawingAreaErrorKind;
use plotters::prelude::*;

/// One line of a plot.
pub struct Line {
    /// What the legend says.
    pub name: String,
    /// What is plotted; only positive numbers can be.
    pub points: Vec<(f64, f64)>,
}

/// What a plot shows.
pub struct Plot<'a> {
    /// What grows to the right.
    pub x_label: &'a str,
    /// What grows upwards.
    pub y_label: &'a str,
    /// The lines, each in a colour of its own.
    pub lines: Vec<Line>,
}

/// Width and height in pixels.
const SIZE_PX: (u32, u32) = (860, 400);

/// Room for the legend, on the right.
const LEGEND_PX: i32 = 200;

/// Colours that people with any kind of colour vision can tell apart [after Okabe and Ito]; black comes first.
const COLORS: [RGBColor; 8] = [
    RGBColor(0, 0, 0),
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(86, 180, 233),
    RGBColor(230, 159, 0),
    RGBColor(140, 140, 140),
];

impl Plot<'_> {
    /// The plot as an SVG element; `None` where there are no two points to draw a line between.
    pub fn svg(&self) -> Option<String> {
        let points = || self.lines.iter().flat_map(|line| &line.points).filter(|(x, y)| *x > 0.0 && *y > 0.0);
        let (x_from, x_to) = range(points().map(|p| p.0))?;
        let (y_from, y_to) = range(points().map(|p| p.1))?;
        if x_from == x_to {
            return None;
        }
        let mut svg = String::new();
        let mut x_ticks: Vec<f64> = points().map(|p| p.0).collect();
        x_ticks.sort_by(f64::total_cmp);
        x_ticks.dedup();
        self.draw(&mut svg, (x_from / 1.05, x_to * 1.05), (y_from / 1.2, y_to * 1.2), x_ticks).ok()?;
        Some(svg)
    }

    fn draw(
        &self,
        svg: &mut String,
        (x_from, x_to): (f64, f64),
        (y_from, y_to): (f64, f64),
        x_ticks: Vec<f64>,
    ) -> Result<(), DrawingAreaErrorKind<std::io::Error>> {
        let area = SVGBackend::with_string(svg, SIZE_PX).into_drawing_area();
        area.fill(&WHITE)?;
        let mut chart = ChartBuilder::on(&area)
            .margin(12)
            .margin_right(LEGEND_PX)
            .x_label_area_size(42)
            .y_label_area_size(68)
            .build_cartesian_2d(
                (x_from..x_to).log_scale().with_key_points(x_ticks),
                (y_from..y_to).log_scale().with_key_points(round_numbers(y_from, y_to)),
            )?;
        chart
            .configure_mesh()
            .x_desc(self.x_label)
            .y_desc(self.y_label)
            .x_label_formatter(&|value| tick(*value))
            .y_label_formatter(&|value| tick(*value))
            .label_style(("sans-serif", 13))
            .axis_desc_style(("sans-serif", 14))
            .bold_line_style(RGBColor(210, 210, 210))
            .light_line_style(RGBColor(240, 240, 240))
            .draw()?;
        let legend_x = SIZE_PX.0 as i32 - LEGEND_PX + 14;
        let styles = COLORS.iter().map(|color| color.stroke_width(2)).cycle();
        for (place, (line, style)) in (0..).zip(std::iter::zip(&self.lines, styles)) {
            let drawn: Vec<(f64, f64)> = line.points.iter().copied().filter(|(x, y)| *x > 0.0 && *y > 0.0).collect();
            chart.draw_series(LineSeries::new(drawn, style).point_size(3))?;
            let y = 24 + 20 * place;
            area.draw(&PathElement::new([(legend_x, y), (legend_x + 18, y)], style))?;
            area.draw(&Text::new(line.name.as_str(), (legend_x + 24, y - 7), ("sans-serif", 13)))?;
        }
        area.present()
    }
}

/// Powers of ten in the range, and the less it spans, the more of their multiples.
fn round_numbers(from: f64, to: f64) -> Vec<f64> {
    let factors: &[f64] = match to / from {
        wide if wide >= 1e3 => &[1.0],
        medium if medium >= 8.0 => &[1.0, 2.0, 5.0],
        _ => &[1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0],
    };
    let powers = (-9..=15).map(|exponent| 10_f64.powi(exponent));
    powers.flat_map(|power| factors.iter().map(move |f| f * power)).filter(|v| (from..=to).contains(v)).collect()
}

/// A number at an axis.
fn tick(value: f64) -> String {
    match value {
        v if v >= 1e6 => format!("{v:e}").replace('e', "·10^").replace("1·", ""),
        v if v >= 1.0 => super::format::whole(v as u64),
        v => v.to_string(),
    }
}

/// The least and the greatest; `None` of nothing.
fn range(values: impl Iterator<Item = f64>) -> Option<(f64, f64)> {
    values.fold(None, |range, v| {
        let (from, to) = range.unwrap_or((v, v));
        Some((from.min(v), to.max(v)))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plot(points: &[(f64, f64)]) -> Option<String> {
        let line = Line { name: "a <b> & c".into(), points: points.to_vec() };
        Plot { x_label: "x", y_label: "y", lines: vec![line] }.svg()
    }

    #[test]
    fn ticks_are_round() {
        assert_eq!(round_numbers(3.0, 60.0), [5.0, 10.0, 20.0, 50.0]);
        assert_eq!(round_numbers(110.0, 320.0), [120.0, 150.0, 200.0, 250.0, 300.0]);
        assert_eq!(round_numbers(3.0, 6000.0), [10.0, 100.0, 1000.0]);
        assert_eq!(
            (tick(1e6), tick(2e9), tick(1001.0), tick(0.5)),
            ("10^6".into(), "2·10^9".into(), "1,001".into(), "0.5".into())
        );
    }

    #[test]
    fn lines_need_two_points() {
        assert!(plot(&[]).is_none() && plot(&[(1.0, 2.0)]).is_none() && plot(&[(0.0, 1.0), (2.0, 1.0)]).is_none());
        let svg = plot(&[(1.0, 2.0), (10.0, 2.0)]).unwrap();
        assert!(svg.starts_with("<svg") && svg.contains("polyline") && !svg.contains("<b>"), "{svg}");
    }
}
