//! The harness of the table-driven test programs: arguments, folders, a tally and the exit code.
//!
//! The cases of a table-driven suite are files found at run time. All suites behave alike.
//! Arguments that are not flags select cases whose names contain them, as in `cargo test`. A failed
//! case prints a line that begins with `FAILED`. Parts that cannot be tested are reported as
//! skipped (see `skip.rs`). The last line shows the counts.

use crate::skip::report_skip;
use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::SystemTime;

/// The command line of a test program: filters and flags.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Arguments {
    filters: Vec<String>,
    flags: Vec<String>,
}

impl Arguments {
    /// Returns the arguments of this process after the suite name.
    #[must_use]
    pub fn from_env() -> Self {
        Self::from_words(std::env::args().skip(2))
    }

    /// Words that begin with a dash are flags; all others are filters.
    pub fn from_words(words: impl Iterator<Item = String>) -> Self {
        let (flags, filters) = words.partition(|word| word.starts_with('-'));
        Self { filters, flags }
    }

    /// Returns whether a case is selected, because there are no filters or one of them is part of
    /// its name.
    #[must_use]
    pub fn select(&self, name: &str) -> bool {
        self.filters.is_empty() || self.filters.iter().any(|filter| name.contains(filter.as_str()))
    }

    /// Returns whether a flag such as `--all` is set.
    #[must_use]
    pub fn has_flag(&self, flag: &str) -> bool {
        self.flags.iter().any(|given| given == flag)
    }

    /// Returns the filters as written.
    #[must_use]
    pub fn filters(&self) -> &[String] {
        &self.filters
    }
}

/// The counts of a run.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Tally {
    passed: usize,
    failed: usize,
    skipped: usize,
}

impl Tally {
    /// Counts cases that passed.
    pub fn pass(&mut self, count: usize) {
        self.passed += count;
    }

    /// Counts a failed case and prints the reason.
    pub fn fail(&mut self, name: &str, reason: &str) {
        self.failed += 1;
        println!("FAILED {name}: {reason}");
    }

    /// Counts a part of the test that cannot run here, and reports the reason.
    pub fn skip(&mut self, name: &str, reason: &str) {
        self.skipped += 1;
        report_skip(name, reason);
    }

    /// Counts a case by its outcome.
    pub fn record(&mut self, name: &str, outcome: Result<(), String>) {
        match outcome {
            Ok(()) => self.pass(1),
            Err(reason) => self.fail(name, &reason),
        }
    }
}

impl std::ops::AddAssign for Tally {
    fn add_assign(&mut self, other: Self) {
        self.passed += other.passed;
        self.failed += other.failed;
        self.skipped += other.skipped;
    }
}

/// Runs a test program, prints its counts, and turns them into the exit code.
///
/// Filters that select nothing are not a failure: `cargo test NAME` passes its filter to every test
/// program.
pub fn run_program(name: &str, run: impl FnOnce(&Arguments) -> Result<Tally, String>) -> ExitCode {
    let tally = run(&Arguments::from_env()).unwrap_or_else(|reason| {
        let mut tally = Tally::default();
        tally.fail(name, &reason);
        tally
    });
    let Tally { passed, failed, skipped } = tally;
    println!("{passed} passed, {failed} failed, {skipped} skipped");
    if failed == 0 { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

/// Returns the cases of this run: all with the environment variable `THOROUGH`, otherwise about a
/// tenth.
///
/// `TEST_SEED` selects them. The default is the date, so that a bug is found within days of its
/// introduction. The seed is printed, so that a failure can be reproduced.
#[must_use]
pub fn sample_cases<T>(name: &str, cases: Vec<T>) -> Vec<T> {
    if is_thorough() {
        return cases;
    }
    let given = std::env::var("TEST_SEED").ok().and_then(|seed| seed.parse().ok());
    let today = || {
        SystemTime::now()
            .duration_since(SystemTime::UNIX_EPOCH)
            .map_or(0, |time| time.as_secs() / 86_400)
    };
    let seed = given.unwrap_or_else(today);
    let count = cases.len();
    let chosen = choose_tenth(seed, cases);
    println!(
        "{name}: {} of {count} cases; TEST_SEED={seed} repeats these, THOROUGH=1 runs all",
        chosen.len()
    );
    chosen
}

/// Returns whether `THOROUGH` selects every case.
pub fn is_thorough() -> bool {
    std::env::var_os("THOROUGH").is_some()
}

/// Returns a random tenth of the items. Each item is equally likely.
fn choose_tenth<T>(seed: u64, items: Vec<T>) -> Vec<T> {
    let is_chosen = |index: u64| {
        // splitmix64
        let mut bits = (seed << 32 ^ index).wrapping_mul(0x9E37_79B9_7F4A_7C15);
        bits = (bits ^ bits >> 30).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        bits = (bits ^ bits >> 27).wrapping_mul(0x94D0_49BB_1331_11EB);
        (bits ^ bits >> 31).is_multiple_of(10)
    };
    (0..).zip(items).filter(|(index, _)| is_chosen(*index)).map(|(_, item)| item).collect()
}

/// Returns a folder of test data: the folder that the environment variable names, otherwise
/// `../shared/NAME` from this repository, or `None` if neither exists.
///
/// # Errors
/// Returns an error if the variable names a folder that does not exist.
pub fn data_folder(variable: &str, name: &str) -> Result<Option<PathBuf>, String> {
    let beside = crate::project_root().join("../shared").join(name);
    choose_folder(variable, std::env::var_os(variable), &beside)
}

fn choose_folder(
    variable: &str,
    named: Option<OsString>,
    beside: &Path,
) -> Result<Option<PathBuf>, String> {
    let Some(folder) = named.map(PathBuf::from) else {
        return Ok(beside.is_dir().then(|| beside.to_owned()));
    };
    let missing = || format!("{variable} names {}, which is not a folder", folder.display());
    if folder.is_dir() { Ok(Some(folder)) } else { Err(missing()) }
}

/// A folder for this process in the system's temporary folder, removed on drop.
#[derive(Debug)]
pub struct TemporaryFolder {
    path: PathBuf,
}

impl TemporaryFolder {
    /// Creates the folder.
    ///
    /// # Errors
    /// Returns an error that names the folder if it cannot be created.
    pub fn create(name: &str) -> Result<Self, String> {
        let path = std::env::temp_dir().join(format!("alberti-{name}-{}", std::process::id()));
        std::fs::create_dir_all(&path).map_err(|error| format!("{}: {error}", path.display()))?;
        Ok(Self { path })
    }

    /// Returns the path of the folder.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.path
    }
}

impl Drop for TemporaryFolder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.path);
    }
}

/// Applies `work` to the index and value of every item on two threads. Results keep the order of
/// the items.
///
/// A panic in `work` ends the program, so work that may panic must catch it.
pub fn map_parallel<T: Sync, R: Send>(items: &[T], work: impl Fn(usize, &T) -> R + Sync) -> Vec<R> {
    let results: Vec<Mutex<Option<R>>> = items.iter().map(|_| Mutex::new(None)).collect();
    let next = AtomicUsize::new(0);
    let take_items = || {
        loop {
            // The counter hands every index to exactly one thread.
            let index = next.fetch_add(1, Ordering::Relaxed);
            let Some(item) = items.get(index) else { break };
            let result = work(index, item);
            if let Ok(mut slot) = results[index].lock() {
                *slot = Some(result);
            }
        }
    };
    std::thread::scope(|scope| {
        scope.spawn(take_items);
        take_items();
    });
    results.into_iter().filter_map(|slot| slot.into_inner().ok().flatten()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arguments_without_dashes_select_by_part_of_the_name() {
        let words = ["clip", "--all"].map(str::to_owned);
        let arguments = Arguments::from_words(words.into_iter());
        assert!(arguments.select("clip_polygon") && !arguments.select("viewport"));
        assert!(arguments.has_flag("--all") && !arguments.has_flag("--none"));
        assert!(Arguments::default().select("anything"));
    }

    #[test]
    fn a_folder_named_by_a_variable_must_exist_but_the_default_need_not() {
        let here = Path::new(env!("CARGO_MANIFEST_DIR"));
        let nowhere = here.join("nowhere");
        assert_eq!(choose_folder("X", None, &nowhere), Ok(None));
        assert_eq!(choose_folder("X", None, here), Ok(Some(here.to_owned())));
        assert!(choose_folder("X", Some(nowhere.into()), here).is_err());
    }

    #[test]
    fn ten_seeds_choose_different_cases() {
        let of_seed = |seed| choose_tenth(seed, (0..1000).collect::<Vec<u32>>());
        let mut seen = std::collections::BTreeSet::new();
        for seed in 20_000..20_010 {
            assert_eq!(of_seed(seed), of_seed(seed));
            assert!((60..140).contains(&of_seed(seed).len()));
            seen.extend(of_seed(seed));
        }
        assert!(seen.len() > 550, "{}", seen.len());
    }

    #[test]
    fn results_of_two_threads_keep_the_order_of_the_items() {
        let items: Vec<usize> = (0..100).collect();
        assert_eq!(map_parallel(&items, |index, item| index + item), {
            items.iter().map(|item| 2 * item).collect::<Vec<_>>()
        });
    }
}
