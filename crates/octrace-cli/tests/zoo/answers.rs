//! Rays, volumes and extents.

use crate::expected::{Extent, Probe, SeenSpan};
use crate::{Exhibit, accelerations, canonical};
use octrace::query::{MeasureError, MeasureOptions, Measures, measure};
use octrace::trace::Scratch;
use octrace::{Bounds, Hit, Ray, Span, Tracer, TracerOptions};

/// The volume is measured to so much of itself.
const VOLUME_TOLERANCE: f64 = 1e-4;

/// What is wrong with the rays: of the canonical tracer in itself, of all others in comparison with it.
pub fn wrong_rays(exhibit: &Exhibit) -> Vec<String> {
    let mut wrong = Vec::new();
    let reference = exhibit.tracer(&canonical());
    let accelerated: Vec<_> = accelerations().into_iter().map(|o| (o, exhibit.tracer(&o))).collect();
    for probe in &exhibit.expected.probes {
        let Ray { origin, direction } = probe.ray;
        let ray = format!("ray {:?} {:?}", origin.to_array(), direction.to_array());
        let answer = Answer::of(&reference, &probe.ray);
        let seen = seen(exhibit, &reference, probe, &answer);
        if !agree(&seen, probe) {
            wrong.push(format!("{ray}: sees {}, should see {}", text(&seen), text(&probe.spans)));
        }
        for (options, tracer) in &accelerated {
            if Answer::of(tracer, &probe.ray) != answer {
                wrong.push(format!("{ray}: another answer by {}", name(options)));
            }
        }
    }
    wrong
}

/// All that a tracer says of a ray.
#[derive(PartialEq)]
struct Answer {
    /// The spans in each body.
    bodies: Vec<Vec<Span>>,
    /// The spans in all of them together.
    together: Vec<Span>,
    first: Option<(usize, Hit)>,
    /// Whether the ray starts inside.
    starts_inside: bool,
    /// How often cells contradicted each other: not a bit of that.
    leaks: u64,
}

impl Answer {
    fn of(tracer: &Tracer, ray: &Ray) -> Self {
        let mut scratch = Scratch::default();
        Self {
            bodies: (0..tracer.bodies()).map(|body| tracer.body_spans(body, ray, &mut scratch)).collect(),
            together: tracer.spans_with(ray, &mut scratch),
            first: tracer.first_body_hit(ray, f64::INFINITY, &mut scratch),
            starts_inside: tracer.contains(ray.origin),
            leaks: scratch.counters.leaks,
        }
    }
}

/// The spans of all bodies, with colours, in the order in which the line enters them.
fn seen(exhibit: &Exhibit, tracer: &Tracer, probe: &Probe, answer: &Answer) -> Vec<SeenSpan> {
    let color = |hit: Option<Hit>| match hit {
        Some(hit) => exhibit.color(tracer.surface_point(&probe.ray, &hit).part),
        None => "none",
    };
    let seen = |span: &Span| SeenSpan {
        ends: [span.enter_t(), span.exit_t()],
        colors: [span.enter, span.exit].map(|hit| color(hit).to_owned()),
    };
    let mut spans: Vec<SeenSpan> = answer.bodies.iter().flatten().map(seen).collect();
    spans.sort_by(|a, b| a.ends[0].total_cmp(&b.ends[0]));
    spans
}

fn agree(seen: &[SeenSpan], probe: &Probe) -> bool {
    let near = |(a, b): (f64, f64)| a == b || (a - b).abs() <= probe.within * b.abs().max(1.0);
    let same = |(seen, expected): (&SeenSpan, &SeenSpan)| {
        seen.colors == expected.colors && std::iter::zip(seen.ends, expected.ends).all(near)
    };
    seen.len() == probe.spans.len() && std::iter::zip(seen, &probe.spans).all(same)
}

fn text(spans: &[SeenSpan]) -> String {
    let span = |SeenSpan { ends: [enter, exit], colors: [first, last] }: &SeenSpan| {
        format!("{first} {enter:?}..{exit:?} {last}")
    };
    if spans.is_empty() { "nothing".into() } else { spans.iter().map(span).collect::<Vec<_>>().join(", ") }
}

pub fn name(options: &TracerOptions) -> String {
    let octree = options.octree;
    format!("{}, p {}, depth {:?}", options.traversal, octree.leaf_surfaces, octree.depth)
}

/// What is wrong with volume and extent. They are measured with rays, so the canonical tracer must come to the same bits.
pub fn wrong_measures(exhibit: &Exhibit) -> Vec<String> {
    let measured = |options: &TracerOptions, tolerance| {
        let options_of_measure = MeasureOptions { tolerance, ..MeasureOptions::default() };
        measure(&exhibit.tracer(options), &options_of_measure, &octrace::exec::Exec::with_threads(1))
    };
    let mut wrong = Vec::new();
    let coarse = 1e-2;
    if measured(&TracerOptions::default(), coarse) != measured(&canonical(), coarse) {
        wrong.push("other measures without an octree".into());
    }
    match (measured(&TracerOptions::default(), VOLUME_TOLERANCE), exhibit.expected.extent) {
        (_, None) => wrong.push("there should be a line `box`".into()),
        (Err(MeasureError::Unbounded), Some(Extent::Unbounded)) => {}
        (Ok(measures), Some(extent)) => wrong.extend(wrong_numbers(&measures, extent, exhibit.expected.volume)),
        (Err(error), Some(_)) => wrong.push(error.to_string()),
    }
    wrong
}

fn wrong_numbers(measures: &Measures, extent: Extent, volume: Option<f64>) -> Vec<String> {
    let mut wrong = Vec::new();
    let same_box = match extent {
        Extent::Empty => measures.bbox.is_empty(),
        Extent::Unbounded => false,
        Extent::Box { bounds, within } => near(measures.bbox, bounds, within * bounds.diagonal()),
    };
    if !same_box {
        wrong.push(format!("the box is {:?}, not {extent:?}", measures.bbox));
    }
    match volume {
        Some(volume) if (measures.volume - volume).abs() <= VOLUME_TOLERANCE * volume => {}
        other => wrong.push(format!("the volume is {}, not {other:?}", measures.volume)),
    }
    wrong
}

fn near(a: Bounds, b: Bounds, tolerance: f64) -> bool {
    let near = |a: octrace::Vec3, b: octrace::Vec3| (a - b).length() <= tolerance;
    near(a.min, b.min) && near(a.max, b.max)
}
