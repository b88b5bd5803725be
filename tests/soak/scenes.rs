//! Renders random scenes with one thread and with two, and checks that there are no panics, NaNs or
//! differences.

use crate::scene_text::{SceneFiles, random_scene_text};
use hidden_line::{DrawOptions, draw};
use homog::PixelRect;
use pipeline::render::draw_lines;
use pipeline::render::passes::{PassValues, render_passes};
use pipeline::{Origin, Scene, Timings, render};
use scene::Style;
use scene_file::Pass;

use picture::Picture;
use std::fs;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

/// The minimum percentage of scenes that must be drawn rather than rejected. One incompatible field
/// is enough to reject a scene, and rejecting is quick.
const MIN_DRAWN_PERCENT: u64 = 2;

/// The scene counts, and the texts of the scenes that failed.
#[derive(Default)]
struct Tally {
    drawn: AtomicU64,
    refused: AtomicU64,
    faults: Mutex<Vec<String>>,
}

/// Renders scenes for some minutes, starting with number `first`; returns whether all succeeded.
pub fn soak_scenes(minutes: u64, first: u64) -> Result<bool, String> {
    let (folder, files) = prepare_files()?;
    let end = Instant::now() + Duration::from_secs(minutes * 60);
    let next = AtomicU64::new(first);
    let tally = Tally::default();
    let work = || {
        while Instant::now() < end {
            let number = next.fetch_add(1, Ordering::Relaxed);
            let text = random_scene_text(number, &files);
            match catch_unwind(AssertUnwindSafe(|| check_scene(&folder, &text))) {
                Ok(Ok(true)) => tally.drawn.fetch_add(1, Ordering::Relaxed),
                Ok(Ok(false)) => tally.refused.fetch_add(1, Ordering::Relaxed),
                Ok(Err(reason)) => tally.note_fault(number, &reason, &text),
                Err(_) => tally.note_fault(number, &crate::subject::last_panic(), &text),
            };
        }
    };
    let cores = std::thread::available_parallelism().map_or(1, std::num::NonZeroUsize::get);
    std::thread::scope(|scope| (0..cores).for_each(|_| drop(scope.spawn(work))));
    Ok(tally.print_summary(first))
}

impl Tally {
    fn note_fault(&self, number: u64, reason: &str, text: &str) -> u64 {
        println!("scene {number}: {reason}\n{text}");
        if let Ok(mut faults) = self.faults.lock() {
            faults.push(format!("{number}: {reason}"));
        }
        0
    }

    fn print_summary(&self, first: u64) -> bool {
        let [drawn, refused] = [&self.drawn, &self.refused].map(|n| n.load(Ordering::Relaxed));
        let faults = self.faults.lock().map_or_else(|_| Vec::new(), |faults| faults.clone());
        println!(
            "scenes from {first}: {drawn} drawn, {refused} rejected with a message, {} failed",
            faults.len()
        );
        faults.iter().for_each(|fault| println!("  FAILED {fault}"));
        let is_worth_it = drawn * 100 >= MIN_DRAWN_PERCENT * (drawn + refused);
        if !is_worth_it {
            println!("  FAILED: too few scenes were drawn to prove anything");
        }
        faults.is_empty() && is_worth_it
    }
}

/// Returns whether a scene was drawn rather than rejected, or an error if a check fails.
fn check_scene(folder: &Path, text: &str) -> Result<bool, String> {
    let resolved = Origin::from_text("random.ron", text, folder.to_owned())
        .parse_with_includes(&[])
        .and_then(|(origin, file)| Scene::resolve(&origin, &file, &Default::default()));
    let scene = match resolved {
        Ok(scene) => scene,
        Err(error) => return is_message(&error.to_string()),
    };
    let pictures = [1, 2].map(|threads| render(&scene, threads));
    match pictures {
        [Ok(alone), Ok(together)] if alone == together => {}
        [Err(alone), Err(together)] if alone.to_string() == together.to_string() => {
            return is_message(&alone.to_string());
        }
        [Ok(_), Ok(_)] => return Err("two threads render a different picture than one".to_owned()),
        [Err(error), _] | [_, Err(error)] => return Err(format!("one of two runs: {error}")),
    }
    check_lines(&scene)?;
    check_passes(&scene)?;
    Ok(true)
}

/// Checks that a rejection has a reason.
fn is_message(message: &str) -> Result<bool, String> {
    if message.trim().len() < 10 {
        Err("a rejection without a reason".to_owned())
    } else {
        Ok(false)
    }
}

/// Checks that line drawings with one thread and with two have the same text, without NaN or
/// infinity.
fn check_lines(scene: &Scene) -> Result<(), String> {
    let drawings = [1, 2].map(|threads| match scene.style {
        Style::Lines(_) => draw_lines(scene, threads, &Timings::default())
            .map(|page| page.to_svg())
            .map_err(|error| error.to_string()),
        _ => draw(&scene.drawing_subject(), &DrawOptions::default(), threads)
            .map(|drawing| format!("{:?}", drawing.segments))
            .map_err(|error| error.to_string()),
    });
    let [alone, together] = &drawings;
    if alone != together {
        return Err("two threads draw different lines than one".to_owned());
    }
    let has_nan = |text: &String| text.contains("NaN") || text.contains("inf");
    if alone.as_ref().is_ok_and(has_nan) { Err("NaN in a drawing".to_owned()) } else { Ok(()) }
}

/// Checks that passes with one thread and with two are equal, and that no value is NaN.
fn check_passes(scene: &Scene) -> Result<(), String> {
    let region = PixelRect::from_size(scene.image.width, scene.image.height);
    let passes = [1, 2].map(|threads| {
        render_passes(scene, region, &Pass::ALL, threads, &Timings::default())
            .map_err(|error| error.to_string())
    });
    let [alone, together] = &passes;
    for pass in alone.iter().flatten() {
        if let PassValues::Floats(values) = &pass.values
            && values.iter().any(|value| value.is_nan())
        {
            return Err(format!("NaN in the pass {:?}", pass.pass));
        }
    }
    if alone == together {
        Ok(())
    } else {
        Err("two threads give different passes than one".to_owned())
    }
}

/// Copies the scene models, and creates an environment, an image and a scene to include.
fn prepare_files() -> Result<(PathBuf, SceneFiles), String> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap_or(Path::new("."));
    let folder = std::env::temp_dir().join(format!("alberti-soak-{}", std::process::id()));
    let fault = |error: std::io::Error| format!("{}: {error}", folder.display());
    fs::create_dir_all(&folder).map_err(fault)?;
    let mut models = Vec::new();
    for entry in fs::read_dir(root.join("scenes/models")).map_err(fault)? {
        let path = entry.map_err(fault)?.path();
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        if name.ends_with(".glb") {
            fs::copy(&path, folder.join(&name)).map_err(fault)?;
            models.push(name);
        }
    }
    models.sort();
    let files =
        SceneFiles { models, environment: "sky.hdr", image: "image.png", include: "part.ron" };
    let mut environment = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 4 +X 8\n".to_vec();
    environment.extend((0..32_u8).flat_map(|i| [200 - i, 40 + 5 * i, 90, 126 + i % 8]));
    fs::write(folder.join(files.environment), environment).map_err(fault)?;
    let image = Picture { width: 6, height: 4, pixels: vec![[200, 120, 40, 160_u8]; 24] };
    fs::write(folder.join(files.image), image.to_png()).map_err(fault)?;
    let part = "Scene(models: [(path: \"crate.glb\", translation: (2, 0, 0))])\n";
    fs::write(folder.join(files.include), part).map_err(fault)?;
    Ok((folder, files))
}
