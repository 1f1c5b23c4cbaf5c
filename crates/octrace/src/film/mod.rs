//! Where samples are collected, and the loop that collects them.

mod buffer;
mod develop;
mod render;
mod tile;

pub use buffer::Film;
pub use render::{Background, RenderStats, View, ray_tree, render};
