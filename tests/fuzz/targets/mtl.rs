//! Fuzzes MTL files: see `fuzz::model::material_library`.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| fuzz::case::run(|| fuzz::model::material_library(
    bytes
)));
