//! `cargo xtask determinism`: tests that a scene renders to the same bytes on every machine.
//!
//! The command renders every scene with the release build, with one thread and with several, and
//! with the debug build. `--wide` adds a build that may use AVX2 and fused multiply-add, because
//! floating-point sums would diverge there first. It needs a processor with these instructions.
//! `determinism/web.rs` compares the explorer's pictures in WebAssembly.
//!
//! `--targets` compares other processors, C libraries, compilers and optimizations instead
//! (`determinism/targets.rs`): all of them, or some, as in `--targets=aarch64,musl`.

mod outputs;
mod target;
mod targets;
mod web;
mod workload;

use crate::Outcome;
use crate::program::{Build, Program};
use crate::workspace::{Scene, create_folder, list_scenes, target_folder};
use std::fs;
use std::path::{Path, PathBuf};

/// A build with flags, such as the number of threads.
struct Variant {
    name: String,
    flags: Vec<String>,
}

/// Renders all scenes in several ways and compares the bytes.
pub fn run_determinism(arguments: &[String]) -> Outcome {
    let options = Options::parse_arguments(arguments)?;
    if let Some(names) = &options.targets {
        return targets::compare_targets(names);
    }
    let mut builds = vec![Build::Release, Build::Debug];
    if options.wide {
        builds.push(Build::Wide);
    }
    let folder = target_folder().join("determinism");
    let mut drawn = Vec::new();
    for build in builds {
        let program = Program::build(build)?;
        for way in variants(build, options.threads) {
            drawn.push((render_all(&program, &way, &folder)?, way.name));
        }
    }
    compare_outputs(&drawn)
}

/// Compares the explorer's WebAssembly pictures with pictures from the release build.
pub fn compare_web_pictures() -> Outcome {
    web::compare_web(&Program::build(Build::Release)?)
}

struct Options {
    wide: bool,
    threads: u32,
    /// The targets to compare, by name, instead of builds; an empty list means all.
    targets: Option<Vec<String>>,
}

impl Options {
    fn parse_arguments(arguments: &[String]) -> Result<Self, String> {
        let mut options = Self { wide: false, threads: 3, targets: None };
        let mut rest = arguments.iter();
        while let Some(argument) = rest.next() {
            match argument.as_str() {
                "--wide" => options.wide = true,
                "--targets" => options.targets = Some(Vec::new()),
                "--threads" => {
                    let count = rest.next().and_then(|count| count.parse().ok());
                    options.threads = count.ok_or("--threads needs a number")?;
                }
                other => match other.strip_prefix("--targets=") {
                    Some(names) => {
                        options.targets = Some(names.split(',').map(str::to_owned).collect());
                    }
                    None => return Err(format!("unknown argument `{other}`")),
                },
            }
        }
        Ok(options)
    }
}

/// Returns the variants of a build: the release build with one thread and with several, and other
/// builds with their default number of threads.
fn variants(build: Build, threads: u32) -> Vec<Variant> {
    let way = |name: String, flags: Vec<String>| Variant {
        name: format!("{}-{name}", build.name()),
        flags,
    };
    if build != Build::Release {
        return vec![way("default".into(), Vec::new())];
    }
    let with_threads =
        |count: u32| way(format!("threads-{count}"), vec!["--threads".into(), count.to_string()]);
    [1, threads].map(with_threads).into()
}

/// Renders every scene with one variant and returns the picture folder.
fn render_all(program: &Program, way: &Variant, folder: &Path) -> Result<PathBuf, String> {
    let folder = folder.join(&way.name);
    create_folder(&folder)?;
    let flags: Vec<&str> = way.flags.iter().map(String::as_str).collect();
    for scene in list_scenes()? {
        for ending in EXTENSIONS {
            program.render(&scene.path, &output_path(&folder, &scene, ending), &flags)?;
        }
    }
    println!("{:18} drawn", way.name);
    Ok(folder)
}

/// The output formats of each scene: a picture and a line drawing. PDF and DXF are written from the
/// same page as SVG, and `workload.rs` covers them.
const EXTENSIONS: [&str; 2] = ["png", "svg"];

fn output_path(folder: &Path, scene: &Scene, ending: &str) -> PathBuf {
    folder.join(format!("{}.{ending}", scene.name))
}

/// Compares every variant's pictures with the first variant's.
fn compare_outputs(drawn: &[(PathBuf, String)]) -> Outcome {
    let Some(((first, first_name), others)) = drawn.split_first() else { return Ok(()) };
    let bytes =
        |path: PathBuf| fs::read(&path).map_err(|error| format!("{}: {error}", path.display()));
    let mut differences = Vec::new();
    let scenes = list_scenes()?;
    for scene in &scenes {
        for ending in EXTENSIONS {
            let expected = bytes(output_path(first, scene, ending))?;
            for (folder, name) in others {
                if bytes(output_path(folder, scene, ending))? != expected {
                    let scene = &scene.name;
                    differences.push(format!("{scene}.{ending}: {name} differs from {first_name}"));
                }
            }
        }
    }
    if differences.is_empty() {
        println!(
            "{} scenes, each rendered {} ways, have the same bytes",
            scenes.len(),
            drawn.len()
        );
        return Ok(());
    }
    Err(format!("pictures differ (see target/determinism)\n  {}", differences.join("\n  ")))
}
