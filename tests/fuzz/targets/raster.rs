//! Fuzzes the rasterizer: see `fuzz::raster`.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| fuzz::case::run(|| fuzz::raster::frames(bytes)));
