//! Files that wish the importer ill, built here, each loaded in this process.
//!
//! Whatever a file says, loading and checking it return, do not panic, take little time and little memory; and if there is a
//! model, read strictly or leniently, it keeps every promise of its documentation. What must come of a file is stated where it is certain, word by word where the
//! message matters. Arguments that are not flags choose cases by a part of their name, as in `cargo test`; `--write DIR` writes
//! all of them and loads none.

#![allow(clippy::print_stdout, reason = "a test program speaks on its standard output")]
#![allow(missing_docs, unreachable_pub, reason = "the modules of a program have no other outside")]

mod accessors;
mod animations;
mod bytes;
mod case;
mod document;
mod draco;
#[path = "../../scenes/generator/src/glb.rs"]
mod glb;
mod images;
mod members;
mod meshopt;
mod nodes;
mod promises;
mod text;
mod types;
mod uris;

use case::Case;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::process::ExitCode;
use std::time::{Duration, Instant};

/// So much memory the whole run may take at any time.
const MAX_MEMORY_MIB: u64 = 200;

/// A case that takes longer hangs, however busy the machine is.
const TIME_LIMIT: Duration = Duration::from_secs(10);

#[derive(Default)]
struct Tally {
    passed: usize,
    failed: usize,
    slowest: (Duration, String),
    largest: (u64, String),
}

fn main() -> ExitCode {
    let mut arguments = std::env::args();
    if arguments.any(|argument| argument == "--write") {
        let folder = arguments.next().unwrap_or_default();
        return match write_files(folder.as_ref()) {
            Ok(count) => {
                println!("{count} files");
                ExitCode::SUCCESS
            }
            Err(error) => {
                println!("{folder}: {error}");
                ExitCode::FAILURE
            }
        };
    }
    let folder = std::env::temp_dir().join(format!("alberti-hostile-{}", std::process::id()));
    let tally = run_groups(&folder);
    let _ = std::fs::remove_dir_all(&folder);
    match tally {
        Ok(tally) => {
            println!("slowest: {:?} {}", tally.slowest.0, tally.slowest.1);
            println!("memory: {} MiB since {}", tally.largest.0, tally.largest.1);
            println!("{} passed, {} failed, 0 skipped", tally.passed, tally.failed);
            if tally.failed == 0 { ExitCode::SUCCESS } else { ExitCode::FAILURE }
        }
        Err(error) => {
            println!("FAILED hostile: {error}");
            println!("0 passed, 1 failed, 0 skipped");
            ExitCode::FAILURE
        }
    }
}

/// Writes the files of all cases into a folder, for the fuzzer to begin with.
fn write_files(folder: &Path) -> std::io::Result<usize> {
    let mut count = 0;
    for (group, cases) in case_groups() {
        for case in cases().iter().filter(|case| case.file.len() <= 64 << 10) {
            std::fs::write(folder.join(format!("{group}-{count:05}")), &case.file)?;
            count += 1;
        }
    }
    Ok(count)
}

fn run_groups(folder: &Path) -> Result<Tally, String> {
    std::fs::create_dir_all(folder).map_err(|error| error.to_string())?;
    let filters: Vec<String> = std::env::args().skip(1).filter(|a| !a.starts_with('-')).collect();
    let is_chosen =
        |name: &str| filters.is_empty() || filters.iter().any(|f| name.contains(f.as_str()));
    let mut tally = Tally::default();
    for (group, cases) in case_groups() {
        let before = tally.passed + tally.failed;
        for case in cases().iter().filter(|case| is_chosen(&case.name)) {
            tally.record_case(&case.name, || case.check_file(folder));
            tally.record_case(&format!("{}, checked", case.name), || case.check_bytes());
            tally.record_case(&format!("{}, leniently", case.name), || case.load_leniently());
        }
        println!("{group}: {} cases", tally.passed + tally.failed - before);
    }
    let uris = uris::run_uri_cases(&folder.join("uris"))?;
    println!("uris: {} cases", uris.len());
    for (name, result) in uris.into_iter().filter(|(name, _)| is_chosen(name)) {
        tally.record_case(&name, || result);
    }
    if tally.largest.0 > MAX_MEMORY_MIB {
        tally.failed += 1;
        println!("FAILED memory: {} MiB since {}", tally.largest.0, tally.largest.1);
    }
    Ok(tally)
}

type Cases = fn() -> Vec<Case>;

fn case_groups() -> [(&'static str, Cases); 10] {
    [
        ("types", types::type_cases),
        ("accessors", accessors::accessor_cases),
        ("animations", animations::animation_cases),
        ("bytes", bytes::byte_cases),
        ("members", members::member_cases),
        ("meshopt", meshopt::meshopt_cases),
        ("draco", draco::draco_cases),
        ("nodes", nodes::node_cases),
        ("images", images::image_cases),
        ("text", text::text_cases),
    ]
}

impl Tally {
    /// Runs a case and counts it.
    fn record_case(&mut self, name: &str, case: impl FnOnce() -> Result<(), String>) {
        let start = Instant::now();
        let result =
            catch_unwind(AssertUnwindSafe(case)).unwrap_or_else(|_| Err("panic".to_owned()));
        let time = start.elapsed();
        if time > self.slowest.0 {
            self.slowest = (time, name.to_owned());
        }
        let memory = peak_memory_mib();
        if memory > self.largest.0 {
            self.largest = (memory, name.to_owned());
        }
        match result {
            Ok(()) if time < TIME_LIMIT => self.passed += 1,
            result => {
                let problem = result.err().unwrap_or_else(|| format!("it took {time:?}"));
                println!("FAILED {name}: {problem}");
                self.failed += 1;
            }
        }
    }
}

/// The most memory this process has had so far, where the system tells; else 0.
fn peak_memory_mib() -> u64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
    let kib = line.and_then(|line| line.split_whitespace().next()?.parse::<u64>().ok());
    kib.unwrap_or(0) / 1024
}
