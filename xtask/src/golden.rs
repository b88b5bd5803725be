//! `cargo xtask golden`: compares or replaces the golden images, one per scene.
//!
//! The comparison is the suite `tests/goldens.rs`, which this command runs. `--bless` replaces the
//! goldens of the named scenes, or of all scenes with `--all`. Look at the pictures before you use
//! `--bless`, which does not work in CI.

use crate::Outcome;
use crate::program::{Build, Program, cargo_command};
use crate::workspace::{Scene, list_scenes, relative_path};
use std::fs;
use std::io::Cursor;
use std::path::Path;

/// The maximum size of a golden in bytes: goldens remain in the repository history.
const MAX_BYTES: usize = 150_000;

/// Compares the named scenes with their goldens, or replaces the goldens if `--bless` is given.
pub fn run_golden(arguments: &[String]) -> Outcome {
    match arguments.iter().position(|argument| argument == "--bless") {
        Some(flag) => {
            let names: Vec<&String> =
                arguments[..flag].iter().chain(&arguments[flag + 1..]).collect();
            bless_goldens(&names)
        }
        None => compare_goldens(arguments),
    }
}

fn compare_goldens(names: &[String]) -> Outcome {
    let mut test = cargo_command(&[
        "test",
        "--quiet",
        "--package",
        "alberti-tests",
        "--test",
        "suites",
        "--",
        "goldens",
    ]);
    let status = test.args(names).status().map_err(|error| error.to_string())?;
    if status.success() { Ok(()) } else { Err("some pictures differ from their goldens".into()) }
}

/// Replaces the goldens of the named scenes, or of every scene with `--all`, with the current
/// pictures.
fn bless_goldens(names: &[&String]) -> Outcome {
    if std::env::var_os("CI").is_some() {
        return Err("goldens cannot be blessed in CI: a person must look at them first".into());
    }
    let chosen = chosen_scenes(names)?;
    let program = Program::build(Build::Release)?;
    for scene in &chosen {
        let golden = scene.golden_path();
        program.render(&scene.path, &golden, &[])?;
        let bytes = compress_file(&golden)?;
        println!("{} ({bytes} bytes): look at it before you commit it.", relative_path(&golden));
        println!("  It should show this: {}", scene.scene_caption()?);
        if bytes > MAX_BYTES {
            return Err(format!("{} can have at most {MAX_BYTES} bytes", relative_path(&golden)));
        }
    }
    Ok(())
}

/// Rewrites a PNG with the same pixels and the best compression, and returns its new size. The
/// program itself favors speed.
fn compress_file(path: &Path) -> Result<usize, String> {
    let bytes = fs::read(path).map_err(|error| format!("{}: {error}", path.display()))?;
    let bytes = recompress_png(&bytes).map_err(|error| format!("{}: {error}", path.display()))?;
    fs::write(path, &bytes).map_err(|error| format!("{}: {error}", path.display()))?;
    Ok(bytes.len())
}

fn recompress_png(bytes: &[u8]) -> Result<Vec<u8>, String> {
    let mut reader =
        png::Decoder::new(Cursor::new(bytes)).read_info().map_err(|e| e.to_string())?;
    let mut pixels = vec![0; reader.output_buffer_size().ok_or("too large")?];
    let info = reader.next_frame(&mut pixels).map_err(|error| error.to_string())?;
    let mut smaller = Vec::new();
    let mut encoder = png::Encoder::new(&mut smaller, info.width, info.height);
    encoder.set_color(info.color_type);
    encoder.set_depth(info.bit_depth);
    encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
    encoder.set_compression(png::Compression::High);
    let mut writer = encoder.write_header().map_err(|error| error.to_string())?;
    writer.write_image_data(&pixels).map_err(|error| error.to_string())?;
    writer.finish().map_err(|error| error.to_string())?;
    Ok(smaller)
}

fn chosen_scenes(names: &[&String]) -> Result<Vec<Scene>, String> {
    let scenes = list_scenes()?;
    if names.is_empty() {
        return Err("use --bless NAME… or --bless --all".into());
    }
    if names.iter().any(|name| *name == "--all") {
        return Ok(scenes);
    }
    if let Some(unknown) =
        names.iter().find(|name| !scenes.iter().any(|scene| scene.name == ***name))
    {
        return Err(format!("scenes/{unknown}.ron does not exist"));
    }
    Ok(scenes.into_iter().filter(|scene| names.contains(&&scene.name)).collect())
}
