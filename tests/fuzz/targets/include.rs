//! Fuzzes included scenes: see `fuzz::scene_files::included`.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| fuzz::case::run(|| fuzz::scene_files::included(bytes)));
