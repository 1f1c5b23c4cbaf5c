//! `octrace study`: the traversals of the paper, measured side by side.
//!
//! Scenes (`scenes`) and settings (`plan`) go in; each scene is surveyed, checked against the canonical tracer and timed
//! (`measure`, with the rays of `rays` and the numbers of `crate::statistics`), the memory of trees and grids is weighed
//! (`memory`), settings are recommended (`advice`); out comes plain data (`results`), which `report` turns into a page.

mod advice;
mod context;
mod machine;
mod measure;
mod memory;
mod plan;
mod rays;
mod report;
mod results;
mod rounds;
mod scenes;
mod survey;
mod walk;

pub use context::Context;
pub use machine::{Machine, now};
pub use measure::study_scene;
pub use memory::weigh;
pub use plan::{Depth, Plan};
pub use report::page;
pub use results::{Checked, SceneReport, Settings, Study};
pub use scenes::{SceneNames, StudyScene, built_in, default_names, select};
