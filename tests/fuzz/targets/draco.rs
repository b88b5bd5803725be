//! Fuzzes Draco streams: see `fuzz::streams::draco`.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| fuzz::case::run(|| fuzz::streams::draco(bytes)));
