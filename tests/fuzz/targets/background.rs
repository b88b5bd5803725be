//! Fuzzes background images: see `fuzz::scene_files::background`.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| fuzz::case::run(|| fuzz::scene_files::background(
    bytes
)));
