//! Fuzzes explorer queries: see `fuzz::explorer::query`.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| fuzz::case::run(|| fuzz::explorer::query(bytes)));
