//! Fuzzes PLY files: see `fuzz::model::mesh`.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| fuzz::case::run(|| fuzz::model::mesh(
    "model.ply",
    bytes
)));
