//! Fuzzes calibrated cameras: see `fuzz::camera::calibrated`.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| fuzz::case::run(|| fuzz::camera::calibrated(bytes)));
