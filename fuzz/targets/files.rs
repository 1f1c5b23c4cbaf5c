//! Any bytes as a mesh, a drawing or a height field: see [`laws::files`]. `fuzz/seeds` has one of each to start from.
#![no_main]

#[path = "../laws.rs"]
#[allow(dead_code, reason = "each target uses one law")]
mod laws;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| laws::files(bytes));
