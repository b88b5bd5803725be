//! `cargo xtask fuzz`: bytes and numbers that libFuzzer generates, guided by the branches they
//! reach.
//!
//! ```text
//! fuzz [TARGET…] [--minutes N] [--jobs N] [--corpus DIR]
//!   TARGET        some of the targets below; default: all, one after the other
//!   --minutes N   minutes of processor time for each target, all its jobs together; 20 if not said
//!   --jobs N      processes that work on a target at a time; 1 if not said
//!   --corpus DIR  the folder of the corpora, default target/fuzz
//! ```
//!
//! The targets are in `tests/fuzz`, a separate package that needs a C++ compiler; the stable Rust
//! compiler is enough. They begin with `tests/fuzz/corpus`, which holds a few small cases for each
//! target, the shared assets (`$ASSETS`, or `shared/assets` next to the project), the scenes and
//! the cases of `tests/hostile`. A panic, a broken promise, more than a second or more than 200 MB
//! of memory is a crash: the input is saved in `DIR/TARGET/artifacts`, the run ends with 1, and
//! later runs begin with that input. Fix the crash, and add a small case like it to `tests/hostile`
//! or to the tests of the crate.

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
    /// The words in its inputs, if they are text.
    words: Option<&'static str>,
}

const TARGETS: &[FuzzTarget] = &[
    FuzzTarget {
        name: "model",
        about: "a whole .glb or .gltf: loaded, posed, drawn, encoded",
        words: Some("gltf.dict"),
    },
    FuzzTarget { name: "stl", about: "a whole .stl, text or binary", words: Some("stl.dict") },
    FuzzTarget { name: "obj", about: "a whole .obj", words: Some("obj.dict") },
    FuzzTarget { name: "mtl", about: "a material library, in use", words: Some("mtl.dict") },
    FuzzTarget { name: "ply", about: "a whole .ply, text or binary", words: Some("ply.dict") },
    FuzzTarget { name: "threemf", about: "a whole .3mf", words: Some("threemf.dict") },
    FuzzTarget { name: "meshopt", about: "a buffer view compressed by meshopt", words: None },
    FuzzTarget { name: "draco", about: "a primitive compressed by Draco", words: None },
    FuzzTarget {
        name: "image",
        about: "an image of a texture: PNG, JPEG, WebP, KTX2",
        words: None,
    },
    FuzzTarget {
        name: "scene",
        about: "the text of a scene: parsed, resolved, drawn by one thread and by two",
        words: Some("scene.dict"),
    },
    FuzzTarget {
        name: "include",
        about: "a scene and files that it includes",
        words: Some("scene.dict"),
    },
    FuzzTarget {
        name: "background",
        about: "an image behind a scene: PNG, JPEG, WebP",
        words: None,
    },
    FuzzTarget {
        name: "environment",
        about: "a Radiance image around a scene",
        words: Some("environment.dict"),
    },
    FuzzTarget { name: "camera", about: "cameras by K, R and t", words: None },
    FuzzTarget {
        name: "explorer",
        about: "requests and links of the explorer",
        words: Some("explorer.dict"),
    },
    FuzzTarget {
        name: "job_list",
        about: "a list of jobs for `batch`, as JSON lines or CSV",
        words: Some("job_list.dict"),
    },
    FuzzTarget {
        name: "maths",
        about: "any numbers for the functions of `tests/soak`",
        words: None,
    },
    FuzzTarget {
        name: "raster",
        about: "triangles, lines, points: whole, in parts, by all instructions",
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
                let unknown = || format!("there is no target `{name}`\n\n{}", fuzz_help());
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
    text.parse().map_err(|_| format!("`{text}` is not a number that fits here"))
}

fn fuzz_help() -> String {
    let mut text = String::from(
        "Usage: cargo xtask fuzz [TARGET…] [--minutes N] [--jobs N] [--corpus DIR]\n\n\
         Minutes are of processor time, for each target: 20. Jobs: 1. Corpus: target/fuzz.\n\
         Crashes are kept in DIR/TARGET/artifacts and tried first by later runs.\n",
    );
    for target in TARGETS {
        text += &format!("\n  {:11} {}", target.name, target.about);
    }
    text
}

/// Counters at every branch, and the operands of comparisons: `cargo fuzz` asks the compiler for
/// the same.
const COMPILER_FLAGS: [&str; 6] = [
    "-Cpasses=sancov-module",
    "-Cllvm-args=-sanitizer-coverage-level=4",
    "-Cllvm-args=-sanitizer-coverage-inline-8bit-counters",
    "-Cllvm-args=-sanitizer-coverage-pc-table",
    "-Cllvm-args=-sanitizer-coverage-trace-compares",
    "--cfg=fuzzing",
];

/// Builds all targets; returns the folder of their programs.
fn build_targets() -> Result<PathBuf, String> {
    println!("building the targets, which takes minutes for the first time");
    // A named platform keeps the flags away from build scripts and macros.
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

/// The platform that the compiler runs on, by the compiler's name for it.
fn host_triple() -> Result<String, String> {
    let mut version =
        std::process::Command::new(std::env::var_os("RUSTC").unwrap_or("rustc".into()));
    let text = crate::program::capture_output(version.arg("-vV").current_dir(project_root()))?;
    let host = text.lines().find_map(|line| line.strip_prefix("host: "));
    host.map(str::to_owned).ok_or_else(|| "the compiler does not say its platform".into())
}

/// The folder of the shared assets, if it exists.
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
    fn each_target_is_a_program_of_its_package() {
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
    fn dictionaries_are_lines_of_quoted_words() {
        for file in TARGETS.iter().filter_map(|target| target.words) {
            let text = read_text(&project_root().join("tests/fuzz").join(file)).unwrap();
            for line in text.lines().filter(|line| !line.starts_with('#')) {
                let quoted = line.len() > 2 && line.starts_with('"') && line.ends_with('"');
                assert!(quoted, "{file}: {line}");
            }
        }
    }

    #[test]
    fn orders_are_read_and_slips_are_named() {
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
