//! Fuzzes meshopt streams: see `fuzz::streams::meshopt`.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| fuzz::case::run(|| fuzz::streams::meshopt(bytes)));
