//! `cargo xtask fuzz`: runs the fuzz targets on input that libFuzzer generates, guided by the
//! branches that the input reaches.
//!
//! ```text
//! fuzz [TARGET…] [--minutes N] [--jobs N] [--corpus DIR]
//!   TARGET        targets to run; default: all, one after the other
//!   --minutes N   minutes of CPU time per target, over all its jobs; default 20
//!   --jobs N      number of concurrent processes per target; default 1
//!   --corpus DIR  the folder of the corpora; default target/fuzz
//! ```
//!
//! The targets are in `tests/fuzz`, a separate package. It needs a C++ compiler and the stable Rust
//! compiler. The first inputs are a few small cases for each target in `tests/fuzz/corpus`, the
//! shared assets (`$ASSETS`, or `shared/assets` next to the project), the scenes, and the cases in
//! `tests/hostile`. A panic, a failed assertion, or the use of more than one second or 200 MB of
//! memory counts as a crash. The input is saved in `DIR/TARGET/artifacts`, the command fails, and
//! later runs begin with that input. When you fix a crash, add a minimal case to `tests/hostile` or
//! to the tests of the crate.

mod pack;
mod seeds;
mod session;

use crate::Outcome;
use crate::program::{cargo_command, run_command};
use crate::workspace::{create_folder, project_root, target_folder};
use session::{Session, SessionReport};
use std::path::{Path, PathBuf};

/// An entry point for untrusted bytes or arbitrary numbers.
struct FuzzTarget {
    name: &'static str,
    about: &'static str,
    /// The dictionary of words in the target's inputs, if these are text.
    words: Option<&'static str>,
}

const TARGETS: &[FuzzTarget] = &[
    FuzzTarget {
        name: "model",
        about: "a .glb or .gltf file: loaded, posed, rendered, encoded",
        words: Some("gltf.dict"),
    },
    FuzzTarget { name: "stl", about: "an .stl file, text or binary", words: Some("stl.dict") },
    FuzzTarget { name: "obj", about: "an .obj file", words: Some("obj.dict") },
    FuzzTarget {
        name: "mtl",
        about: "a material library, used by a model",
        words: Some("mtl.dict"),
    },
    FuzzTarget { name: "ply", about: "a .ply file, text or binary", words: Some("ply.dict") },
    FuzzTarget { name: "threemf", about: "a .3mf file", words: Some("threemf.dict") },
    FuzzTarget { name: "meshopt", about: "a buffer view compressed by meshopt", words: None },
    FuzzTarget { name: "draco", about: "a primitive compressed by Draco", words: None },
    FuzzTarget { name: "image", about: "a texture image: PNG, JPEG, WebP, KTX2", words: None },
    FuzzTarget {
        name: "scene",
        about: "a scene file: parsed, resolved, rendered with one thread and with two",
        words: Some("scene.dict"),
    },
    FuzzTarget {
        name: "include",
        about: "a scene file and the files that it includes",
        words: Some("scene.dict"),
    },
    FuzzTarget { name: "background", about: "a background image: PNG, JPEG, WebP", words: None },
    FuzzTarget {
        name: "environment",
        about: "an environment map in Radiance format",
        words: Some("environment.dict"),
    },
    FuzzTarget { name: "camera", about: "cameras from K, R and t", words: None },
    FuzzTarget {
        name: "explorer",
        about: "explorer requests and links",
        words: Some("explorer.dict"),
    },
    FuzzTarget {
        name: "job_list",
        about: "a job list for `batch`, as JSON Lines or CSV",
        words: Some("job_list.dict"),
    },
    FuzzTarget {
        name: "maths",
        about: "arbitrary numbers for the functions of `tests/soak`",
        words: None,
    },
    FuzzTarget {
        name: "raster",
        about: "triangles, lines, points: whole, in parts, with all instruction sets",
        words: None,
    },
];

/// The parsed command line.
struct FuzzOrder {
    targets: Vec<&'static FuzzTarget>,
    minutes: f64,
    jobs: usize,
    corpus: PathBuf,
}

/// Builds the targets, writes their seeds and runs them.
pub fn run_fuzz(arguments: &[String]) -> Outcome {
    if arguments.iter().any(|argument| argument == "--help" || argument == "-h") {
        println!("{}", fuzz_help());
        return Ok(());
    }
    let order = parse_order(arguments)?;
    let programs = build_targets()?;
    let mut reports = Vec::new();
    for target in order.targets {
        let folder = order.corpus.join(target.name);
        for part in ["seeds", "corpus", "artifacts"] {
            create_folder(&folder.join(part))?;
        }
        let seeds = seeds::write_seeds(target.name, &folder.join("seeds"))?;
        println!("{}: {}; {seeds} seeds", target.name, target.about);
        let session = Session {
            program: programs.join(target.name),
            is_talkative: target.name == "job_list",
            words: target.words.map(|file| project_root().join("tests/fuzz").join(file)),
            folder,
            minutes: order.minutes,
            jobs: order.jobs,
        };
        let report = session.run_jobs(target.name)?;
        println!("{}\n{report}", SessionReport::HEADING);
        reports.push(report);
    }
    println!("\n{}", SessionReport::HEADING);
    reports.iter().for_each(|report| println!("{report}"));
    let crashed = reports.iter().filter(|report| !report.crashes.is_empty());
    let crashed: Vec<&str> = crashed.map(|report| report.name.as_str()).collect();
    if crashed.is_empty() { Ok(()) } else { Err(format!("crashes in {}", crashed.join(", "))) }
}

fn parse_order(arguments: &[String]) -> Result<FuzzOrder, String> {
    let corpus = target_folder().join("fuzz");
    let mut order = FuzzOrder { targets: Vec::new(), minutes: 20.0, jobs: 1, corpus };
    let mut words = arguments.iter();
    while let Some(word) = words.next() {
        let mut value = || words.next().ok_or_else(|| format!("{word} needs a value"));
        match word.as_str() {
            "--minutes" => order.minutes = parse_number(value()?)?,
            "--jobs" => order.jobs = parse_number(value()?)?,
            "--corpus" => order.corpus = project_root().join(value()?),
            flag if flag.starts_with('-') => return Err(format!("unknown flag `{flag}`")),
            name => {
                let found = TARGETS.iter().find(|target| target.name == name);
                let unknown = || format!("unknown target `{name}`\n\n{}", fuzz_help());
                order.targets.push(found.ok_or_else(unknown)?);
            }
        }
    }
    if order.targets.is_empty() {
        order.targets.extend(TARGETS);
    }
    if order.minutes > 0.0 && order.jobs > 0 {
        return Ok(order);
    }
    Err("--minutes and --jobs must be more than 0".into())
}

fn parse_number<T: std::str::FromStr>(text: &str) -> Result<T, String> {
    text.parse().map_err(|_| format!("`{text}` is not a valid number"))
}

fn fuzz_help() -> String {
    let mut text = String::from(
        "Usage: cargo xtask fuzz [TARGET…] [--minutes N] [--jobs N] [--corpus DIR]\n\n\
         N is CPU minutes per target for --minutes (default 20) and processes per target for\n\
         --jobs (default 1). DIR is target/fuzz by default.\n\
         Inputs that crash are saved in DIR/TARGET/artifacts, and later runs try them first.\n",
    );
    for target in TARGETS {
        text += &format!("\n  {:11} {}", target.name, target.about);
    }
    text
}

/// Flags for counters at every branch and for tracing comparison operands, the same as in `cargo
/// fuzz`.
const COMPILER_FLAGS: [&str; 6] = [
    "-Cpasses=sancov-module",
    "-Cllvm-args=-sanitizer-coverage-level=4",
    "-Cllvm-args=-sanitizer-coverage-inline-8bit-counters",
    "-Cllvm-args=-sanitizer-coverage-pc-table",
    "-Cllvm-args=-sanitizer-coverage-trace-compares",
    "--cfg=fuzzing",
];

/// Builds all targets and returns the folder of their programs.
fn build_targets() -> Result<PathBuf, String> {
    println!("building the targets, which takes minutes the first time");
    // With an explicit platform, the flags do not apply to build scripts and macros.
    let platform = host_triple()?;
    let folder = target_folder().join("fuzz/build");
    let manifest = ["--manifest-path", "tests/fuzz/Cargo.toml"];
    let mut build =
        cargo_command(&["build", "--quiet", "--release", "--bins", "--target", &platform]);
    build.args(manifest).env("CARGO_TARGET_DIR", &folder);
    run_command(
        build.env_remove("RUSTFLAGS").env("CARGO_ENCODED_RUSTFLAGS", COMPILER_FLAGS.join("\u{1f}")),
    )?;
    Ok(folder.join(platform).join("release"))
}

/// Returns the target triple of the platform that the compiler runs on.
fn host_triple() -> Result<String, String> {
    let mut version =
        std::process::Command::new(std::env::var_os("RUSTC").unwrap_or("rustc".into()));
    let text = crate::program::capture_output(version.arg("-vV").current_dir(project_root()))?;
    let host = text.lines().find_map(|line| line.strip_prefix("host: "));
    host.map(str::to_owned).ok_or_else(|| "the compiler does not report its platform".into())
}

/// Returns the folder of the shared assets, if it exists.
fn assets_folder() -> Option<PathBuf> {
    let beside = project_root().join("../shared/assets");
    let folder = std::env::var_os("ASSETS").map_or(beside, |named| Path::new(&named).to_owned());
    folder.is_dir().then_some(folder)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::workspace::{list_files, read_text};

    #[test]
    fn each_target_is_a_program_of_the_fuzz_package() {
        let package = project_root().join("tests/fuzz");
        let manifest = read_text(&package.join("Cargo.toml")).unwrap();
        let mut files: Vec<String> = list_files(&package.join("targets"), "rs")
            .unwrap()
            .iter()
            .map(|path| path.file_stem().unwrap().to_string_lossy().into_owned())
            .collect();
        let mut names: Vec<&str> = TARGETS.iter().map(|target| target.name).collect();
        names.sort_unstable();
        files.sort();
        assert_eq!(files, names);
        for name in names {
            let bin = format!("[[bin]]\nname = \"{name}\"\npath = \"targets/{name}.rs\"");
            assert!(manifest.contains(&bin), "{name}");
        }
    }

    #[test]
    fn dictionary_lines_are_quoted_words() {
        for file in TARGETS.iter().filter_map(|target| target.words) {
            let text = read_text(&project_root().join("tests/fuzz").join(file)).unwrap();
            for line in text.lines().filter(|line| !line.starts_with('#')) {
                let quoted = line.len() > 2 && line.starts_with('"') && line.ends_with('"');
                assert!(quoted, "{file}: {line}");
            }
        }
    }

    #[test]
    fn command_lines_are_parsed_and_mistakes_are_reported() {
        let words = |line: &str| line.split(' ').map(str::to_owned).collect::<Vec<_>>();
        let good = parse_order(&words("scene model --minutes 0.5 --jobs 2")).ok().unwrap();
        let names: Vec<&str> = good.targets.iter().map(|target| target.name).collect();
        assert_eq!((names, good.minutes, good.jobs), (vec!["scene", "model"], 0.5, 2));
        assert_eq!(parse_order(&[]).ok().unwrap().targets.len(), TARGETS.len());
        for slip in ["modell", "--minutes", "--minutes x", "--jobs 0", "--fast"] {
            assert!(parse_order(&words(slip)).is_err(), "{slip}");
        }
    }
}
