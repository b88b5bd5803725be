//! Fuzzes 3MF files: see `fuzz::model::mesh`.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| fuzz::case::run(|| fuzz::model::mesh(
    "model.3mf",
    bytes
)));
