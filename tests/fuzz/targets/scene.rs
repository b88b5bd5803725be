//! Fuzzes scene files: see `fuzz::scene`.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| fuzz::case::run(|| fuzz::scene::text(bytes)));
