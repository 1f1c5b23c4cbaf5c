//! The report: one HTML page that needs nothing but itself.

mod figures;
mod findings;
mod format;
mod look_up;
mod plots;
mod tables;

use super::results::{Advice, SceneReport, Study};
use figures::figure;
use format::{number, seconds, whole};
use maud::{DOCTYPE, Markup, PreEscaped, html};

/// The page.
pub fn page(study: &Study) -> String {
    html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                title { "octrace study" }
                style { (PreEscaped(include_str!("style.css"))) }
            }
            body { (body(study)) }
        }
    }
    .into_string()
}

fn body(study: &Study) -> Markup {
    html! {
        h1 { "Octree traversals, measured" }
        (origin(study))
        (findings::findings(study))
        h2 id="traversals" { "Every traversal at the default settings" }
        p {
            "Primary rays only: one ray through the middle of each pixel, up to its first hit; no shadows, no shading. \
             Times are medians over the rounds, with the least and the greatest in brackets. " code { "none" } " is \
             the canonical tracer, without octree."
        }
        (tables::defaults(study))
        (growth(study))
        h2 id="steps" { "What one step costs" }
        p {
            "The pure walk: rays go through the whole root cube, from where they enter to where they leave, and \
             nothing is done in any cell. Its time, entering included, is divided by the number of cells. "
            code { "fujimoto" } " steps through every cell of its grid: there the time is divided by these steps, and \
             the last column says how many of them it takes for one cell of the octree."
        }
        (tables::steps(study))
        (memory(study))
        (settings(study))
        h2 id="how" { "How this was measured" }
        (how(study))
    }
}

/// When, where and how the figures came about.
fn origin(study: &Study) -> Markup {
    let machine = &study.machine;
    html! {
        p.quiet {
            "octrace " (study.octrace) ", " (study.date) ", " (seconds(study.seconds)) " on " (machine.cpu) " ("
            (machine.hardware_threads) " hardware threads, " (machine.architecture) "), " (machine.os) "." br;
            code { (study.command) }
        }
    }
}

/// Cost against the number of primitives, and against the depth of the tree.
fn growth(study: &Study) -> Markup {
    let plots: Vec<Markup> =
        figures::growth(study).into_iter().filter_map(|(plot, caption)| figure(&plot, &caption)).collect();
    html! {
        @if !plots.is_empty() {
            h2 id="growth" { "What more primitives and deeper trees cost" }
            @for plot in &plots { (plot) }
        }
    }
}

fn memory(study: &Study) -> Markup {
    html! {
        @if !study.memory.is_empty() {
            h2 id="memory" { "Memory: trees and grids with the same smallest cell" }
            p {
                "What each traversal needs to find its way, beside the leaves' programs, which all need: for "
                code { "bresenham" } " (and " code { "samet" } ") the tree and the parents of its branches, for "
                code { "glassner" } " its hash table and sorted list of codes, for " code { "fujimoto" } " five bytes \
                for each cell of the grid. Where the grid has more than the eight levels that are allowed, its \
                size is computed."
            }
            @for (plot, caption) in figures::memory(study) {
                @if let Some(drawn) = figure(&plot, &caption) { (drawn) }
            }
            details { summary { "All figures" } (tables::memory(study)) }
        }
    }
}

/// Which settings suit which scene.
fn settings(study: &Study) -> Markup {
    let tried: Vec<&SceneReport> = study.scenes.iter().filter(|scene| scene.advice.is_some()).collect();
    html! {
        @if !tried.is_empty() {
            h2 id="settings" { "Which settings suit which scene" }
            @if tried.len() > 1 {
                p {
                    "Time ÷ that of the default settings, with the default traversal: where the tracer cuts cells as \
                     the expected cost of rays has it, and at that fixed depth of those tried which suits best (the \
                     luckiest of several, that is). In brackets the depth that the octree has."
                }
                (tables::leaf_primitives(&tried))
            }
            @for scene in tried {
                h3 { (scene.name) @if scene.name != scene.description { ": " (scene.description) } }
                @if let Some(advice) = &scene.advice { (advice_in_words(advice)) }
                @if let Some(drawn) = figure(&figures::settings(scene), &figures::settings_caption()) { (drawn) }
                details { summary { "All settings" } (tables::settings(scene)) }
            }
        }
    }
}

fn advice_in_words(advice: &Advice) -> Markup {
    let Advice { speedup, memory_ratio, .. } = advice;
    html! {
        div.advice {
            @if advice.is_worth_it {
                "Use " code { (advice.options) } ": " strong { (number(speedup.median)) } " times as fast as the \
                default settings (" (number(speedup.min)) "–" (number(speedup.max)) " in rounds of their own), with "
                (number(*memory_ratio)) " times the memory. "
                @match advice.pays_from_rays {
                    Some(rays) => {
                        "They take longer to build, which pays from " (whole(rays.ceil() as u64)) " rays on."
                    }
                    None => { "They take no longer to build." }
                }
            } @else if advice.is_default {
                "Stay with the default settings: none of the others was faster."
            } @else {
                "Stay with the default settings. The fastest of the others, " code { (advice.options) } ", was "
                (number(speedup.median)) " times as fast (" (number(speedup.min)) "–" (number(speedup.max)) ") when \
                measured once more: not a gain to rely on."
            }
        }
    }
}

fn how(study: &Study) -> Markup {
    let settings = &study.settings;
    let sparse = study.scenes.iter().map(|scene| scene.canonical.rays_traced).min().unwrap_or(0);
    html! {
        ul {
            li {
                "Pictures have " (settings.width) "×" (settings.height) " pixels, one ray each, all traced in every \
                 round. The canonical tracer was given as many of them, spread over the picture, as do not take too \
                 long: at least "
                (whole(sparse as u64)) ". Its time for a picture is computed from these."
            }
            li {
                "There were " (settings.repeat) " rounds. In each round every way to trace has its turn: it is built, \
                 warmed up on an eighth of the rays, timed on all of them, and its walk is timed by itself. Every \
                 other round goes backwards. Ratios are formed within a round, and their medians shown."
            }
            li { "One thread builds, traces and walks." }
            li {
                "Before any clock is started, every way to trace finds all hits, which must be those of the canonical \
                 tracer for the rays that it was given, and for the others those of every other way: ray parameter, \
                 primitive, surface and side, to the last bit."
            }
            li {
                "Surface tests are the words of programs evaluated until the hit: a block counts as up to six \
                 surfaces, a ball as one. Nodes are cells of all kinds, branches included. Bytes are those of the \
                 tree, the traversal's tables and the leaves' programs; the surfaces themselves are not counted."
            }
            li {
                "Settings that lead to the very octree of other settings are not measured twice. "
                code { "fujimoto" } " is not possible with more than eight levels; where the tracer itself would choose more, it has eight."
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::{Checked, Machine, Settings};

    fn study(checked: Checked) -> Study {
        Study {
            octrace: "0",
            command: "octrace study '<a>'".into(),
            date: "then".into(),
            seconds: 1.0,
            machine: Machine { cpu: "a & b".into(), hardware_threads: 2, os: "an OS".into(), architecture: "a64" },
            settings: Settings { width: 4, height: 3, repeat: 1, threads: 1 },
            checked,
            scenes: Vec::new(),
            memory: Vec::new(),
        }
    }

    #[test]
    fn a_defect_is_not_to_be_overlooked() {
        let differing = Checked { hits: 1_000, differing: 3, ..Checked::default() };
        let page_of = |checked| page(&study(checked));
        assert!(page_of(differing).contains("<strong>3 of 1,000 hits differ</strong>"));
        assert!(page_of(Checked { leaks: 1, ..Checked::default() }).contains("1 rays met cells that contradict"));
        assert!(!page_of(Checked::default()).contains("defect of octrace"));
    }

    #[test]
    fn what_is_empty_is_left_out_and_words_are_escaped() {
        let page = page(&study(Checked::default()));
        assert!(page.contains("a &amp; b") && page.contains("&lt;a&gt;") && !page.contains("<a>"));
        assert!(!page.contains("<svg") && !page.contains("Which settings"), "{page}");
    }
}
