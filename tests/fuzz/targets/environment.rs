//! Fuzzes environment images: see `fuzz::scene_files::environment`.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| fuzz::case::run(|| fuzz::scene_files::environment(
    bytes
)));
