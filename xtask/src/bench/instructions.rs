//! `cargo xtask bench --instructions`: instruction counts of small fixed workloads.
//!
//! Times vary; instruction counts from callgrind do not: the same program always gives the same
//! count. Valgrind presents the same plain processor with AVX2 to every program, even if the real
//! processor has wider instructions. `tests/bench/instructions.txt` contains the counts, each with
//! the reason for its last change. A count that has risen by more than 3 % fails until it is stored
//! with a reason:
//!
//! ```text
//! cargo xtask bench --instructions --update teapot --reason "teapots have lids now"
//! ```

mod figures;

use crate::Outcome;
use crate::program::{Build, Program, capture_output, cargo_command, run_command};
use crate::skip::report_skip;
use crate::workspace::{create_folder, project_root, target_folder};
use figures::{CountTable, InstructionCount};
use std::path::PathBuf;
use std::process::Command;

/// The relative increase above which a count fails, and the decrease above which it should be
/// recorded.
const TOLERANCE: f64 = 0.03;

/// Scenes that the program draws at a small size with one thread, and further flags. They cover
/// smooth shading, clipping and textures, translucency, and passes.
const SCENES: [(&str, &str, &[&str]); 4] = [
    ("teapot", "teapot", &[]),
    ("floor", "floor", &[]),
    ("panes", "panes", &[]),
    ("passes", "teapot", &["--passes", "depth,normal,uv,id,node", "--pass-format", "npy"]),
];

/// Workloads that use only the crate `raster`, with one and with four samples per pixel: the
/// arguments of `crates/raster/examples/workload.rs`.
const SAMPLES: [(&str, &str); 2] = [("raster-1", "1"), ("raster-4", "4")];

/// Counts instructions and compares them with the table, or updates the named rows.
pub fn run_instructions(arguments: &[String]) -> Outcome {
    let request = Request::parse_request(arguments)?;
    if let Some(reason) = missing_tool() {
        report_skip("instructions", reason);
        return Ok(());
    }
    let (mut figures, compiler) = (CountTable::read_table()?, compiler_version()?);
    let other = !figures.compiler.is_empty() && figures.compiler != compiler;
    let counted_by =
        format!("the stored counts are from {}, but this is {compiler}", figures.compiler);
    match request {
        Request::Compare if other => report_skip("instructions", &counted_by),
        Request::Compare => judge_counts(&count_all()?, &figures)?,
        Request::Update { names: NameSelection::These(_), .. } if other => {
            return Err(format!("{counted_by}: update all counts"));
        }
        Request::Update { names, reason } => {
            let counts = count_all()?;
            figures.compiler = compiler;
            for Count { name, instructions } in counts.iter().filter(|c| names.includes(&c.name)) {
                figures.set_count(name, *instructions, &reason);
            }
            figures.write_table()?;
            judge_counts(&counts, &figures)?;
        }
    }
    Ok(())
}

/// The stored counts, for the benchmarks page.
#[derive(Default)]
pub struct RecordedCounts {
    /// The compiler that built the counted program.
    pub compiler: String,
    /// Each workload with its count.
    pub counts: Vec<(&'static str, u64)>,
}

/// Returns the stored counts.
pub fn recorded_counts() -> Result<RecordedCounts, String> {
    let table = CountTable::read_table()?;
    let count = |name| Some((name, table.count_for(name)?.count));
    let counts = known_names().into_iter().filter_map(count).collect();
    Ok(RecordedCounts { counts, compiler: table.compiler })
}

/// Returns the compiler's name and version, without the date. Different compilers generate
/// different instructions.
fn compiler_version() -> Result<String, String> {
    let rustc = std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
    let version = capture_output(Command::new(rustc).arg("--version").current_dir(project_root()))?;
    Ok(version.split_whitespace().take(2).collect::<Vec<_>>().join(" "))
}

/// Returns the reason why nothing can be counted on this machine, if there is one.
fn missing_tool() -> Option<&'static str> {
    let valgrind = Command::new("valgrind").arg("--version").output();
    if !valgrind.is_ok_and(|output| output.status.success()) {
        return Some("valgrind is not installed");
    }
    (!has_avx2()).then_some("the counts need a processor with AVX2, which this one lacks")
}

#[cfg(target_arch = "x86_64")]
fn has_avx2() -> bool {
    std::is_x86_feature_detected!("avx2")
}

#[cfg(not(target_arch = "x86_64"))]
fn has_avx2() -> bool {
    false
}

/// The parsed command line.
enum Request {
    Compare,
    Update { names: NameSelection, reason: String },
}

/// The counts to store.
enum NameSelection {
    All,
    These(Vec<String>),
}

impl NameSelection {
    fn includes(&self, name: &str) -> bool {
        match self {
            Self::All => true,
            Self::These(names) => names.iter().any(|known| known == name),
        }
    }
}

impl Request {
    fn parse_request(arguments: &[String]) -> Result<Self, String> {
        const USAGE: &str = "--instructions [--update NAME…|all --reason \"…\"]";
        let Some((first, rest)) = arguments.split_first() else { return Ok(Self::Compare) };
        let at = rest.iter().position(|word| word == "--reason");
        let (Some(at), "--update") = (at, first.as_str()) else { return Err(USAGE.into()) };
        let (names, reason) = (&rest[..at], rest[at + 1..].join(" "));
        if names.is_empty() || reason.trim().is_empty() || reason.contains('\n') {
            return Err(USAGE.into());
        }
        if let Some(strange) = names.iter().find(|name| *name != "all" && !is_known_name(name)) {
            return Err(format!(
                "there is no count `{strange}`; the counts are: {}",
                known_names().join(", ")
            ));
        }
        let all = names.iter().any(|name| name == "all");
        let names = if all { NameSelection::All } else { NameSelection::These(names.to_vec()) };
        Ok(Self::Update { names, reason: reason.trim().to_owned() })
    }
}

/// Returns the name of every count.
fn known_names() -> Vec<&'static str> {
    SCENES.map(|(name, _, _)| name).into_iter().chain(SAMPLES.map(|(name, _)| name)).collect()
}

fn is_known_name(name: &str) -> bool {
    known_names().contains(&name)
}

/// A workload and its cost.
struct Count {
    name: String,
    instructions: u64,
}

fn count_all() -> Result<Vec<Count>, String> {
    let program = Program::build(Build::Release)?;
    let example = ["--package", "alberti-raster", "--example", "workload"];
    run_command(cargo_command(&["build", "--quiet", "--release"]).args(example))?;
    let workload = target_folder().join("release/examples/workload");
    create_folder(&target_folder().join("bench"))?;
    let picture = target_folder().join("bench/instructions.png");
    let scene = |(name, scene, flags): (&str, &str, &[&str])| {
        let mut command = Command::new(program.path());
        command.arg("render").arg(format!("scenes/{scene}.ron")).arg("-o").arg(&picture);
        command.args(["--size", "320x240", "--threads", "1"]).args(flags);
        count_instructions(name, &command)
    };
    let alone = |(name, samples): (&str, &str)| {
        count_instructions(name, Command::new(&workload).arg(samples))
    };
    SCENES.into_iter().map(scene).chain(SAMPLES.into_iter().map(alone)).collect()
}

/// Runs a command under callgrind, without environment variables that could change the count.
fn count_instructions(name: &str, command: &Command) -> Result<Count, String> {
    let profile = profile_path(name);
    let mut valgrind = Command::new("valgrind");
    valgrind.arg("--tool=callgrind").arg(format!("--callgrind-out-file={}", profile.display()));
    valgrind.arg(command.get_program()).args(command.get_args());
    let path = std::env::var_os("PATH").unwrap_or_default();
    capture_output(valgrind.current_dir(project_root()).env_clear().env("PATH", path))?;
    let text = crate::workspace::read_text(&profile)?;
    let total = text.lines().find_map(|line| line.strip_prefix("summary: "));
    let total = total.and_then(|total| total.split_whitespace().next()?.parse().ok());
    let instructions = total.ok_or_else(|| format!("{}: no summary", profile.display()))?;
    Ok(Count { name: name.to_owned(), instructions })
}

/// Returns the path of callgrind's output, for `callgrind_annotate` and similar tools.
fn profile_path(name: &str) -> PathBuf {
    target_folder().join("bench").join(format!("{name}.callgrind"))
}

/// Compares counts with the stored ones and prints both.
fn judge_counts(counts: &[Count], figures: &CountTable) -> Outcome {
    let mut faults = Vec::new();
    for Count { name, instructions } in counts {
        let stored = figures.count_for(name);
        let change =
            stored.map(|InstructionCount { count, .. }| *instructions as f64 / *count as f64 - 1.0);
        let verdict = change_verdict(change);
        let percent = change.map_or(String::new(), |change| format!("{:+.2} %", change * 100.0));
        println!("{name:12} {instructions:>14} {percent:>10}  {verdict}");
        if change.is_none_or(|change| change > TOLERANCE) {
            faults.push(format!("{name}: {verdict}"));
        }
    }
    if faults.is_empty() {
        return Ok(());
    }
    Err(format!(
        "{}\nIf this is intended, store it: cargo xtask bench --instructions --update NAME \
         --reason \"…\"",
        faults.join("\n")
    ))
}

fn change_verdict(change: Option<f64>) -> &'static str {
    match change {
        None => "is not stored",
        Some(change) if change > TOLERANCE => "has risen by more than 3 %",
        Some(change) if change < -TOLERANCE => "has fallen by more than 3 %: store it",
        Some(_) => "as stored",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn request(line: &str) -> Result<Request, String> {
        let words: Vec<String> = line.split_whitespace().map(str::to_owned).collect();
        Request::parse_request(&words)
    }

    #[test]
    fn a_count_is_stored_only_with_a_reason() {
        let Ok(Request::Update { names, reason }) = request("--update panes --reason more glass")
        else {
            panic!("the request is valid")
        };
        assert!(names.includes("panes") && !names.includes("floor"));
        assert_eq!(reason, "more glass");
        assert!(matches!(request(""), Ok(Request::Compare)));
        for wrong in [
            "--update panes",
            "--update --reason x",
            "--update panes --reason",
            "panes",
            "--update pains --reason x",
        ] {
            assert!(request(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn the_limit_is_three_percent_in_both_directions() {
        assert_eq!(change_verdict(Some(0.029)), change_verdict(Some(-0.029)));
        assert_ne!(change_verdict(Some(0.031)), change_verdict(Some(0.029)));
        assert_ne!(change_verdict(Some(-0.031)), change_verdict(Some(0.029)));
    }
}
