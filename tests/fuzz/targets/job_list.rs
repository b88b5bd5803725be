//! Fuzzes job lists: see `fuzz::job_list::list`.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| fuzz::case::run(|| fuzz::job_list::list(bytes)));
