//! `alberti-peers` runs our rasterizer and others in one process and compares them by ratios of CPU
//! time.
//!
//! ```text
//!  scenes ──► raster, render (ours) ┐
//!             llvmpipe, euc         ├─► rounds, taking turns ──► medians of ratios ──► text, JSON, SVG
//!  limits ──► clear, kernel         ┘
//!  features ► render, with one feature added or removed
//!  files  ──► alberti, f3d as processes
//! ```
//!
//! `cargo xtask bench raster` runs it. No figure is asserted; people judge whether a change in a
//! ratio matters.

mod chart;
mod clock;
mod contest;
mod features;
mod files;
mod gl;
mod goals;
mod limits;
mod measure;
mod peer;
mod report;
mod scene;

use contest::Options;
use report::Figures;
use std::path::PathBuf;
use std::process::ExitCode;
use std::rc::Rc;

const USAGE: &str = "alberti-peers --out DIR [--alberti PROGRAM] [--rounds N] [PART…]
Parts of names select scenes, `limits`, `threads`, `features` and `files`; by default, all are measured.";

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let outcome = match arguments.split_first() {
        Some((first, rest)) if first == "cost" => files::cost(rest),
        Some((first, rest)) if first == "profile" => profile(rest),
        _ => run(&arguments),
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("{message}");
            ExitCode::FAILURE
        }
    }
}

/// The destination of the report, and the measurements to make.
struct Plan {
    out: PathBuf,
    alberti: Option<PathBuf>,
    options: Options,
}

fn plan(arguments: &[String]) -> Result<Plan, String> {
    let mut plan = Plan {
        out: PathBuf::new(),
        alberti: None,
        options: Options { rounds: 9, only: Vec::new() },
    };
    let mut arguments = arguments.iter();
    while let Some(argument) = arguments.next() {
        let mut value = || arguments.next().ok_or(format!("{argument} needs a value\n{USAGE}"));
        match argument.as_str() {
            "--out" => plan.out = value()?.into(),
            "--alberti" => plan.alberti = Some(value()?.into()),
            "--rounds" => {
                let rounds = value()?.parse().ok().filter(|rounds| (1..=1000).contains(rounds));
                plan.options.rounds = rounds.ok_or("--rounds must be from 1 to 1000")?;
            }
            flag if flag.starts_with('-') => return Err(format!("unknown flag `{flag}`\n{USAGE}")),
            part => plan.options.only.push(part.to_owned()),
        }
    }
    if plan.out.is_dir() { Ok(plan) } else { Err(format!("--out is not a folder\n{USAGE}")) }
}

fn run(arguments: &[String]) -> Result<(), String> {
    let Plan { out, alberti, options } = plan(arguments)?;
    let gl = llvmpipe()?;
    let llvmpipe = gl.as_ref().map(|gl| gl.renderer());
    if let Some(renderer) = &llvmpipe {
        println!("llvmpipe: {renderer}");
    }
    let scenes = contest::scenes(gl.as_ref(), &options)?;
    let bounds = options.wants("limits").then(|| contest::bounds(options.rounds)).transpose()?;
    if let Some(series) = &bounds {
        println!("{}", report::limits(series));
    }
    let threads = if options.wants("threads") { contest::threads(&options)? } else { Vec::new() };
    println!("{}", report::threads(&threads));
    let features = match scene::assets().filter(|_| options.wants("features")) {
        Some(folder) => features::features(&folder.join("models"), options.rounds)?,
        None => Vec::new(),
    };
    println!("{}", report::features(&features));
    let files = match (alberti, scene::assets()) {
        _ if !options.wants("files") => Vec::new(),
        (Some(alberti), Some(folder)) => {
            files::files(&alberti, &folder.join("models"), &out, options.rounds.min(5))?
        }
        _ => {
            println!("files: skipped: --alberti or the folder of shared models is missing");
            Vec::new()
        }
    };
    let f3d = (!files.is_empty()).then(files::f3d_version).flatten();
    let figures = Figures { llvmpipe, f3d, scenes, bounds, threads, features, files };
    println!("{}", report::held_to(&figures));
    let write = |name: &str, text: String| {
        let path = out.join(name);
        std::fs::write(&path, text).map_err(|error| format!("{}: {error}", path.display()))
    };
    write("raster.json", format!("{:#}\n", report::to_json(&figures)))?;
    write("raster.svg", chart::svg(&figures))
}

/// Returns the llvmpipe context, or prints a warning if it is unavailable.
fn llvmpipe() -> Result<Option<Rc<gl::Context>>, String> {
    // Mesa reads the variable when loaded. Its threads would make CPU times incomparable.
    if std::env::var_os("LP_NUM_THREADS").is_none_or(|threads| threads != "0") {
        println!(
            "llvmpipe: SKIPPED: run with LP_NUM_THREADS=0, as `cargo xtask bench raster` does"
        );
        return Ok(None);
    }
    let gl = gl::Context::open()?;
    if gl.is_none() {
        println!("llvmpipe: SKIPPED: libosmesa6 is not installed");
    }
    Ok(gl.map(Rc::new))
}

/// Implements `profile SCENE FRAMES [render] [SAMPLES]`, which draws one scene repeatedly for a
/// profiler.
fn profile(arguments: &[String]) -> Result<(), String> {
    let [scene, frames, rest @ ..] = arguments else {
        return Err("profile SCENE FRAMES [render] [4]".into());
    };
    let frames: usize = frames.parse().map_err(|_| "FRAMES must be a number")?;
    let whole = rest.iter().any(|word| word == "render");
    let samples = if rest.iter().any(|word| word == "4") { 4 } else { 1 };
    contest::repeat(scene, frames, whole, samples)
}
