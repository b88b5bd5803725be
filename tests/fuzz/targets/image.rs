//! Fuzzes texture images: see `fuzz::streams::image`.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| fuzz::case::run(|| fuzz::streams::image(bytes)));
