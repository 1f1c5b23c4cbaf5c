//! `octrace bench`: how fast this machine traces.
//!
//! Scenes come in (`scenes`, or the user's files); each is measured in rounds (`rounds`, by the clocks of `clock`): reading,
//! compiling, building, a plain picture (`picture`), the whole frame; out comes plain data (`results`) and a table of it
//! (`table`).

mod clock;
mod picture;
mod results;
mod rounds;
mod scenes;
mod table;

pub use results::Row;
pub use rounds::{Plan, measure};
pub use scenes::{BenchScene, SceneNames, built_in, default_names, select};
pub use table::table;
