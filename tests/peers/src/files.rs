//! Measures the path from a file to a PNG with the real programs: `alberti render` and, if
//! installed, f3d on a virtual display.
//!
//! Each run is a separate process. Its CPU time and peak memory come from the system's accounting
//! of child processes. A child's peak includes the moment before it executes the program, when it
//! is a copy of its parent. The parent is therefore a separate small process: this program with the
//! argument `cost`.

use crate::clock::children;
use crate::measure::{Series, Spread};
use crate::report;
use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::Instant;

/// The models, by their paths below `models`.
const MODELS: [&str; 6] = [
    "flight-helmet/FlightHelmet.gltf",
    "cave/cave.glb",
    "cesium-man/CesiumMan.gltf",
    "many-cubes/many-cubes.gltf",
    "house/house.glb",
    "vr-gallery/vr-gallery.glb",
];

/// The measurements for one model.
pub struct FileHeat {
    /// The path of the model.
    pub model: &'static str,
    /// CPU times in seconds: `alberti`, then `f3d`.
    pub cpu: Vec<Series>,
    /// Wall times in seconds.
    pub wall: Vec<Option<Spread>>,
    /// Peak memory in bytes.
    pub peak: Vec<Option<Spread>>,
}

/// A program that renders files.
struct Viewer {
    name: &'static str,
    program: PathBuf,
    display: Option<Display>,
}

/// A virtual display, stopped on drop.
struct Display {
    server: Child,
    number: String,
}

impl Display {
    /// Starts Xvfb on a free display number.
    fn open() -> Option<Self> {
        let mut command = Command::new("Xvfb");
        command.args(["-displayfd", "1", "-screen", "0", "1920x1080x24"]);
        let mut server = command.stdout(Stdio::piped()).stderr(Stdio::null()).spawn().ok()?;
        let mut number = String::new();
        BufReader::new(server.stdout.take()?).read_line(&mut number).ok()?;
        let number = number.trim().to_owned();
        let display = Self { server, number };
        (!display.number.is_empty()).then_some(display)
    }
}

impl Drop for Display {
    fn drop(&mut self) {
        let _ = self.server.kill();
        let _ = self.server.wait();
    }
}

/// Draws each model with each program `count` times in turn, after one warm-up run, and prints the
/// tables.
pub fn files(
    alberti: &Path,
    models: &Path,
    out: &Path,
    count: usize,
) -> Result<Vec<FileHeat>, String> {
    let alberti = Viewer { name: "alberti", program: alberti.to_owned(), display: None };
    let mut viewers = vec![alberti];
    match f3d() {
        Ok(viewer) => viewers.push(viewer),
        Err(reason) => println!("f3d: skipped: {reason}"),
    }
    let mut heats = Vec::new();
    for model in MODELS {
        let heat = contest(&viewers, model, models, out, count)?;
        println!("{}", report::file(&heat));
        heats.push(heat);
    }
    Ok(heats)
}

fn f3d() -> Result<Viewer, String> {
    let program = PathBuf::from("f3d");
    let installed = Command::new(&program).arg("--version").stdout(Stdio::null()).status().is_ok();
    if !installed {
        return Err("f3d is not installed".into());
    }
    let display = Display::open().ok_or("Xvfb is not installed")?;
    Ok(Viewer { name: "f3d", program, display: Some(display) })
}

/// Returns the first line that `f3d --version` prints, if f3d is installed.
pub fn f3d_version() -> Option<String> {
    let output = Command::new("f3d").arg("--version").output().ok()?;
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    text.lines().map(str::trim).find(|line| !line.is_empty()).map(str::to_owned)
}

fn contest(
    viewers: &[Viewer],
    model: &'static str,
    models: &Path,
    out: &Path,
    count: usize,
) -> Result<FileHeat, String> {
    eprintln!("file to PNG: {model}");
    let mut costs = vec![Vec::new(); viewers.len()];
    for _ in 0..=count {
        for (viewer, costs) in viewers.iter().zip(&mut costs) {
            costs.push(viewer.picture(&models.join(model), out)?);
        }
    }
    let after_first = |at: usize| costs[at][1..].iter().copied();
    let column = |k: usize| {
        (0..viewers.len()).map(|at| Spread::of(after_first(at).map(|cost| cost[k]))).collect()
    };
    let cpu = viewers.iter().enumerate().map(|(at, viewer)| Series {
        name: viewer.name.into(),
        times: after_first(at).map(|cost| Some(cost[0])).collect(),
    });
    Ok(FileHeat { model, cpu: cpu.collect(), wall: column(1), peak: column(2) })
}

impl Viewer {
    /// Renders a picture; returns CPU seconds, wall seconds and peak bytes.
    fn picture(&self, model: &Path, out: &Path) -> Result<[f64; 3], String> {
        let stem = model.file_stem().unwrap_or_default().to_string_lossy();
        let picture = out.join(format!("{stem}.{}.png", self.name));
        let _ = std::fs::remove_file(&picture);
        let this = std::env::current_exe().map_err(|error| error.to_string())?;
        let mut command = Command::new(this);
        command.arg("cost").arg(&self.program).env_remove("LP_NUM_THREADS");
        if let Some(Display { number, .. }) = &self.display {
            command.env("DISPLAY", format!(":{number}"));
            command.arg(model).arg("--resolution=1920,1080");
            command.arg(format!("--output={}", picture.display()));
        } else {
            command.arg("render").arg(model).args(["--size", "1920x1080", "-o"]).arg(&picture);
        }
        let output = command.output().map_err(|error| error.to_string())?;
        let text = String::from_utf8_lossy(&output.stdout);
        let figures: Vec<f64> =
            text.lines().last().unwrap_or("").split(' ').filter_map(|n| n.parse().ok()).collect();
        let fault = || format!("{} did not draw {}\n{text}", self.name, model.display());
        let figures = figures.try_into().map_err(|_| fault())?;
        if picture.is_file() { Ok(figures) } else { Err(fault()) }
    }
}

/// Runs a command and prints its cost: CPU seconds, wall seconds and peak bytes.
pub fn cost(arguments: &[String]) -> Result<(), String> {
    let [program, arguments @ ..] = arguments else {
        return Err("missing command after `cost`".into());
    };
    let start = Instant::now();
    let output = Command::new(program).args(arguments).output().map_err(|e| e.to_string())?;
    let wall = start.elapsed();
    if !output.status.success() {
        return Err(String::from_utf8_lossy(&output.stderr).into_owned());
    }
    let cost = children(wall).ok_or("the system does not report the cost of child processes")?;
    println!("{} {} {}", cost.cpu.as_secs_f64(), cost.wall.as_secs_f64(), cost.peak);
    Ok(())
}
