//! Draws every model in a folder in every style and light, and from several sides, on one page with
//! statistics. `cargo xtask gallery --models DIR` runs it in release mode.
//!
//! Pictures that are probably wrong, because they are white, black or without contrast, have a red
//! border. The page is for people; the test `looks` enforces limits.

#![allow(clippy::print_stdout, reason = "a program writes to standard output")]

use alberti_tests::harness::map_parallel;
use alberti_tests::project_root;
use alberti_tests::statistics::PictureStatistics;
use pipeline::{Origin, Scene, render};
use scene::ResolveOptions;
use scene_file::file::{
    DEFAULT_PADDING, EnvironmentFile, FromFile, GroundFile, SceneFile, StyleFile, ViewFile,
};
use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// The size of the pictures.
const SIZE: (u32, u32) = (240, 180);
/// The fractions of white and of black pixels above which a picture is flagged.
const MARKED_SHARES: (f64, f64) = (0.02, 0.05);
/// The contrast below which a picture is flagged.
const MARKED_CONTRAST: u8 = 10;

/// Variants without shading, for which only empty pictures are flagged.
const UNSHADED_VARIANTS: [&str; 8] =
    ["x-ray", "uv", "ids", "wireframe", "depth-cued", "lines", "dashed", "technical"];

/// A way to render a model, with a name and changes to the default.
struct Variant {
    name: &'static str,
    change: fn(&mut SceneFile),
}

/// The default, followed by every style, every light and every side.
const VARIANTS: [Variant; 23] = [
    Variant { name: "default", change: |_| () },
    Variant { name: "flat", change: |file| file.style = StyleFile::Flat },
    Variant { name: "unlit", change: |file| file.style = StyleFile::Unlit },
    Variant { name: "gouraud", change: |file| file.style = StyleFile::Gouraud },
    Variant { name: "clay", change: |file| file.style = StyleFile::Clay },
    Variant { name: "matcap", change: |file| file.style = StyleFile::Matcap },
    Variant { name: "toon", change: |file| file.style = StyleFile::Toon },
    Variant { name: "x-ray", change: |file| file.style = StyleFile::XRay },
    Variant { name: "normals", change: |file| file.style = StyleFile::Normals },
    Variant { name: "depth", change: |file| file.style = StyleFile::Depth },
    Variant { name: "uv", change: |file| file.style = StyleFile::UvChecker },
    Variant { name: "ids", change: |file| file.style = StyleFile::Ids },
    Variant { name: "wireframe", change: |file| file.style = StyleFile::Wireframe },
    Variant { name: "depth-cued", change: |file| file.style = StyleFile::lines_depth_cued() },
    Variant { name: "lines", change: |file| file.style = StyleFile::lines_hidden_removed() },
    Variant { name: "dashed", change: |file| file.style = StyleFile::lines_hidden_dashed() },
    Variant { name: "technical", change: |file| file.style = StyleFile::lines_technical() },
    Variant { name: "sky", change: |file| file.environment = Some(EnvironmentFile::SKY) },
    Variant {
        name: "no environment",
        change: |file| file.environment = Some(EnvironmentFile::Dark),
    },
    Variant {
        name: "shadow on the ground",
        change: |file| file.ground = Some(GroundFile::DEFAULT),
    },
    Variant { name: "front", change: |file| file.camera.view = framed_from(FromFile::Front) },
    Variant { name: "top", change: |file| file.camera.view = framed_from(FromFile::Top) },
    Variant { name: "back", change: |file| file.camera.view = framed_from(FromFile::Back) },
];

/// Returns a view that frames everything from a direction.
fn framed_from(from: FromFile) -> ViewFile {
    ViewFile::Frame { from: Some(from), padding_percent: DEFAULT_PADDING }
}

const PAGE_HEAD: &str = "<!doctype html>
<html lang=\"en\">
<meta charset=\"utf-8\">
<title>Alberti: models</title>
<style>
  body { margin: 2rem; font: 14px/1.4 sans-serif; background: #8a8a8a; }
  section { display: flex; flex-wrap: wrap; gap: .5rem; }
  figure { margin: 0; width: 240px; border: 3px solid transparent; }
  figure.marked { border-color: #d00; }
  figcaption { font-size: 11px; }
</style>
";

fn main() -> ExitCode {
    // Cargo adds a flag to the arguments of benchmarks.
    let arguments: Vec<String> =
        std::env::args().skip(1).filter(|argument| argument != "--bench").collect();
    let [folder] = &arguments[..] else {
        println!("usage: cargo xtask gallery --models DIR");
        return ExitCode::from(2);
    };
    match write_gallery(Path::new(folder)) {
        Ok(page) => {
            println!("{}", page.display());
            ExitCode::SUCCESS
        }
        Err(reason) => {
            println!("gallery: {reason}");
            ExitCode::FAILURE
        }
    }
}

/// Renders all models in a folder and its subfolders, and returns the path of the page.
fn write_gallery(folder: &Path) -> Result<PathBuf, String> {
    let out = project_root().join("target/gallery/models");
    std::fs::create_dir_all(&out).map_err(|error| format!("{}: {error}", out.display()))?;
    let mut models = Vec::new();
    list_models(folder, &mut models)?;
    if models.is_empty() {
        return Err(format!("{} contains no .glb or .gltf files", folder.display()));
    }
    let sections = map_parallel(&models, |index, model| model_section(index, model, &out));
    let page = out.join("index.html");
    let text = PAGE_HEAD.to_owned() + &sections.concat();
    std::fs::write(&page, text).map_err(|error| format!("{}: {error}", page.display()))?;
    Ok(page)
}

/// Returns the section of a model: a figure for each variant.
fn model_section(index: usize, model: &Path, out: &Path) -> String {
    let mut section =
        format!("<h2>{}</h2>\n<section>\n", escape_html(&model.display().to_string()));
    for (number, variant) in VARIANTS.iter().enumerate() {
        let image = format!("{index}-{number}.png");
        match render_variant(model, variant, &out.join(&image)) {
            Ok(statistics) => section += &figure_html(&image, variant.name, &statistics),
            Err(reason) => {
                // A model that cannot be loaded is reported once.
                let _ = writeln!(section, "<p>{}: {}</p>", variant.name, escape_html(&reason));
                break;
            }
        }
    }
    section + "</section>\n"
}

/// Renders a variant into a file.
fn render_variant(
    model: &Path,
    variant: &Variant,
    image: &Path,
) -> Result<PictureStatistics, String> {
    let (origin, mut file) = Origin::from_model_path(model);
    file.image.size = SIZE;
    (variant.change)(&mut file);
    let scene = Scene::resolve(&origin, &file, &ResolveOptions::default());
    let scene = scene.map_err(|error| error.to_string())?;
    let picture = render(&scene, 1).map_err(|error| error.to_string())?;
    picture.write_png(image).map_err(|error| error.to_string())?;
    Ok(PictureStatistics::of_picture(&picture))
}

/// Returns a picture with its statistics, flagged if they suggest that it is wrong.
fn figure_html(image: &str, name: &str, statistics: &PictureStatistics) -> String {
    let PictureStatistics { cover, white, black, mean, contrast, .. } = *statistics;
    let (most_white, most_black) = MARKED_SHARES;
    let is_extreme = white > most_white || black > most_black || contrast < MARKED_CONTRAST;
    let is_marked = cover == 0.0 || is_extreme && !UNSHADED_VARIANTS.contains(&name);
    let class = if is_marked { " class=\"marked\"" } else { "" };
    let percent = |share: f64| 100.0 * share;
    format!(
        "<figure{class}><img src=\"{image}\" alt=\"{name}\"><figcaption><b>{name}</b> cover {:.0} %, white {:.1} %, black {:.1} %, mean {mean:.0}, contrast {contrast}</figcaption></figure>\n",
        percent(cover),
        percent(white),
        percent(black),
    )
}

/// Adds the glTF files in a folder and its subfolders, sorted by name.
fn list_models(folder: &Path, models: &mut Vec<PathBuf>) -> Result<(), String> {
    let in_folder = |error: std::io::Error| format!("{}: {error}", folder.display());
    let entries = std::fs::read_dir(folder).map_err(in_folder)?;
    let mut paths: Vec<PathBuf> = entries.flatten().map(|entry| entry.path()).collect();
    paths.sort();
    for path in paths {
        if path.is_dir() {
            list_models(&path, models)?;
        } else if path.extension().is_some_and(|ending| ending == "glb" || ending == "gltf") {
            models.push(path);
        }
    }
    Ok(())
}

fn escape_html(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('"', "&quot;")
}
