//! Malicious files, built here and loaded in this process.
//!
//! For any content, loading and checking must return without a panic, in bounded time and memory. A
//! returned model, from strict or lenient import, must keep every promise of its documentation. A
//! case states the expected outcome if the message matters. Arguments that are not flags select
//! cases whose names contain them; `--write DIR` only writes the files of at most 64 KiB.

mod accessors;
mod animations;
mod bytes;
mod case;
mod draco;
mod images;
mod ktx2;
mod members;
mod meshes;
mod meshopt;
mod mutants;
mod nodes;
mod promises;
mod text;
mod types;
mod uris;

use alberti_tests::harness::{Arguments, Tally, TemporaryFolder, run_program, sample_cases};
use case::Case;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::process::ExitCode;
use std::time::{Duration, Instant};

/// The memory that the process may use at any time.
const MAX_MEMORY_MIB: u64 = 200;

/// The time limit of a case, generous enough for a busy machine.
const TIME_LIMIT: Duration = Duration::from_secs(10);

/// The slowest case of a run and the largest memory use, with the case names.
#[derive(Default)]
struct Extremes {
    slowest: (Duration, String),
    /// The peak memory in MiB.
    largest: (u64, String),
}

pub fn run() -> ExitCode {
    run_program("hostile", |arguments| {
        if arguments.has_flag("--write") {
            let [folder] = arguments.filters() else {
                return Err("usage: --write DIR".to_owned());
            };
            let count = write_files(folder.as_ref()).map_err(|e| format!("{folder}: {e}"))?;
            println!("{count} files");
            return Ok(Tally::default());
        }
        run_groups(TemporaryFolder::create("hostile")?.path(), arguments)
    })
}

/// Writes the files of at most 64 KiB to a folder, as seeds for the fuzzer.
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

/// Runs all selected cases. Each is checked and loaded from memory; some are first loaded from a
/// file.
fn run_groups(folder: &Path, arguments: &Arguments) -> Result<Tally, String> {
    let (mut tally, mut extremes) = (Tally::default(), Extremes::default());
    for (group, cases) in case_groups() {
        let cases: Vec<Case> =
            cases().into_iter().filter(|case| arguments.select(&case.name)).collect();
        println!("{group}: {} files", cases.len());
        let all: Vec<usize> = (0..cases.len()).collect();
        // All cases share one code path for reading files, so in the first tier a tenth is enough.
        // Cases selected by name run in full.
        let is_named = !arguments.filters().is_empty();
        let from_files = if is_named { all } else { sample_cases(group, all) };
        for (index, case) in cases.iter().enumerate() {
            let name = &case.name;
            let mut record = |name: &str, run: &dyn Fn() -> Result<(), String>| {
                tally.record(name, extremes.measure(name, run));
            };
            if from_files.binary_search(&index).is_ok() {
                record(name, &|| case.check_file(folder));
            }
            record(&format!("{name}, from memory"), &|| case.check_bytes());
        }
    }
    let uris = uris::run_uri_cases(&folder.join("uris"))?;
    println!("uris: {} cases", uris.len());
    for (name, result) in uris.into_iter().filter(|(name, _)| arguments.select(name)) {
        tally.record(&name, result);
    }
    let Extremes { slowest, largest } = extremes;
    println!("slowest: {:?} {}", slowest.0, slowest.1);
    println!("memory: {} MiB since {}", largest.0, largest.1);
    if largest.0 > MAX_MEMORY_MIB {
        tally.fail("memory", &format!("{} MiB since {}", largest.0, largest.1));
    }
    Ok(tally)
}

/// A function that builds the cases of a group.
type Cases = fn() -> Vec<Case>;

fn case_groups() -> [(&'static str, Cases); 12] {
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
        ("ktx2", ktx2::ktx2_cases),
        ("text", text::text_cases),
        ("meshes", meshes::mesh_cases),
    ]
}

impl Extremes {
    /// Runs a case, records its time and the memory of the process, and turns a panic or a timeout
    /// into an error.
    fn measure(&mut self, name: &str, run: &dyn Fn() -> Result<(), String>) -> Result<(), String> {
        let start = Instant::now();
        let result =
            catch_unwind(AssertUnwindSafe(run)).unwrap_or_else(|_| Err("panic".to_owned()));
        let time = start.elapsed();
        if time > self.slowest.0 {
            self.slowest = (time, name.to_owned());
        }
        let memory = peak_memory_mib();
        if memory > self.largest.0 {
            self.largest = (memory, name.to_owned());
        }
        if time < TIME_LIMIT { result } else { result.and(Err(format!("it took {time:?}"))) }
    }
}

/// Returns the peak memory of this process in MiB, or 0 if the system does not report it.
fn peak_memory_mib() -> u64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
    let kib = line.and_then(|line| line.split_whitespace().next()?.parse::<u64>().ok());
    kib.unwrap_or(0) / 1024
}
