//! Checks a user's first impression: every model without a scene has light and contrast in every
//! style, and its default picture is neither overexposed nor underexposed. Ambient occlusion leaves
//! no dark dots. Models are visible in every style, and every style respects alpha.
//!
//! Uses the scene models and, if it exists, the folder `$ASSETS` or `shared/assets` next to the
//! repository. Scene pictures do not reveal such defects, because scenes have their own lights.
//! Arguments that are not flags select models whose names contain them.

mod films;
mod leaves;
mod occlusion;
mod styles;

use alberti_tests::harness::{Arguments, Tally, data_folder, map_parallel, run_program};
use alberti_tests::project_root;
use alberti_tests::statistics::PictureStatistics;
use pipeline::{Origin, Picture, RenderContext, Renderer, Scene, Textures};
use scene::ResolveOptions;
use scene_file::SceneFile;
use scene_file::file::StyleFile;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// The size of the pictures.
const SIZE: (u32, u32) = (160, 120);
/// The maximum fraction of pixels with code 255 in all channels, in the default picture.
const MAX_WHITE: f64 = 0.02;
/// The maximum fraction of pixels below code 5 in all channels, in the default picture.
const MAX_BLACK: f64 = 0.05;
/// The minimum difference between dark and bright on a surface that is not flat, in 8-bit codes.
const MIN_CONTRAST: u8 = 10;

/// The styles that show the shape of surfaces by light or depth, with their names.
const SHAPED_STYLES: [(&str, StyleFile); 7] = [
    ("shaded", StyleFile::Shaded),
    ("flat", StyleFile::Flat),
    ("gouraud", StyleFile::Gouraud),
    ("clay", StyleFile::Clay),
    ("matcap", StyleFile::Matcap),
    ("toon", StyleFile::Toon),
    ("normals", StyleFile::Normals),
];

/// Models whose own emission, unlit colors or lines are white, with the reason.
const WHITE_MODELS: [(&str, &str); 13] = [
    ("anisotropy-strength-test", "labels that emit light"),
    ("blender-emission-strength", "spheres that emit light"),
    ("blender-vertex-color", "unlit lines and points"),
    ("clear-coat-test", "labels that emit light"),
    ("lines", "unlit lines"),
    ("mexican_hat_lines", "unlit lines"),
    ("points", "unlit points"),
    ("primitive-mode-00", "unlit points"),
    ("primitive-mode-02", "unlit lines"),
    ("primitive-mode-08", "unlit points"),
    ("primitive-mode-10", "unlit points"),
    ("primitive-mode-normals-test", "unlit labels and lines"),
    ("primitives", "unlit points and lines"),
];

/// Models whose materials are black, with the reason.
const BLACK_MODELS: [(&str, &str); 4] = [
    ("black-cube-zerobuffer", "base color 0"),
    ("blender-texture-wrapping", "base color 0"),
    ("specular-test", "base color 0"),
    ("sphere-with-circle-texture", "base color 0"),
];

/// Models without contrast in some styles, with the reason.
const EVEN_MODELS: [(&str, &str); 2] = [
    ("blender-gpu-instancing", "at this size outlines are wider than its cubes"),
    ("normal-tangent-mirror-test", "plates in one plane"),
];

pub fn run() -> ExitCode {
    run_program("looks", |arguments| {
        let mut models = list_models(&project_root().join("scenes/models"))?;
        if let Some(assets) = data_folder("ASSETS", "assets")? {
            for folder in list_folder(&assets.join("models"))? {
                models.extend(list_models(&folder)?);
            }
        }
        models.retain(|model| arguments.select(&model_name(model)));
        let mut tally = judge_models(&models, arguments);
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("looks");
        let leaves = leaves::judge_leaves(&folder)?;
        let grounds = leaves::judge_grounds(&folder)?;
        for (name, faults) in [("leaves", leaves), ("grounds", grounds)] {
            tally.record(name, if faults.is_empty() { Ok(()) } else { Err(faults.join("; ")) });
        }
        let lamp = films::write_moving_lamp(&folder)?;
        let faults = films::compare_frames(&lamp);
        tally
            .record("moving-lamp", if faults.is_empty() { Ok(()) } else { Err(faults.join("; ")) });
        Ok(tally)
    })
}

/// Checks all models, two at a time.
fn judge_models(models: &[PathBuf], arguments: &Arguments) -> Tally {
    let mut tally = Tally::default();
    let is_listed = arguments.has_flag("--list");
    for (model, faults) in models.iter().zip(map_parallel(models, |_, model| judge_model(model))) {
        let name = model_name(model);
        if is_listed {
            println!("{name}");
        }
        if faults.is_empty() {
            tally.pass(1);
        }
        for fault in faults {
            tally.fail(&name, &fault);
        }
    }
    tally
}

/// Returns the defects in a model's pictures. A model that cannot be drawn has none, because other
/// tests cover it.
fn judge_model(model: &Path) -> Vec<String> {
    let name = model_name(model);
    let mut faults = occlusion::find_dots(model, &name);
    faults.extend(films::compare_frames(model));
    let (origin, file) = Origin::from_model_path(model);
    let Ok(loaded) = Scene::resolve(&origin, &file, &ResolveOptions::default()) else {
        return faults;
    };
    let textures = Textures::for_models(&loaded.models);
    let bare = BareModel { origin, file, loaded: &loaded, textures: &textures };
    faults.extend(styles::judge_styles(&bare, &name));
    faults.extend(judge_light(&bare, &name));
    faults
}

/// Returns the defects in a model's light and contrast.
fn judge_light(model: &BareModel<'_>, name: &str) -> Vec<String> {
    let mut faults = Vec::new();
    // A plane has only one normal, so light cannot vary on it.
    let has_shape = || {
        let normals = model.statistics(&StyleFile::Normals);
        normals.is_ok_and(|normals| normals.contrast >= MIN_CONTRAST)
            && !is_exempt(name, &EVEN_MODELS)
    };
    // The default picture and some of the others.
    let [default, others @ ..] = SHAPED_STYLES;
    let mut cases = others.to_vec();
    styles::keep_few(&mut cases, name, 1);
    for (style_name, style) in std::iter::once(default).chain(cases) {
        let statistics = match model.statistics(&style) {
            Ok(statistics) => statistics,
            Err(error) => {
                faults.push(format!("{style_name} cannot be drawn: {error}"));
                continue;
            }
        };
        let is_black = is_exempt(name, &BLACK_MODELS) && style_name != "clay";
        let is_white = is_exempt(name, &WHITE_MODELS);
        if statistics.brightest == 0 && !is_black {
            faults.push(format!("{style_name} is black: {statistics:?}"));
        } else if statistics.contrast < MIN_CONTRAST && !(is_black || is_white) && has_shape() {
            faults.push(format!("{style_name} has no contrast: {statistics:?}"));
        }
        if style_name == "shaded" {
            if statistics.white > MAX_WHITE && !is_white {
                faults.push(format!("{:.1} % is white", 100.0 * statistics.white));
            }
            if statistics.black > MAX_BLACK && !is_black {
                faults.push(format!("{:.1} % is black", 100.0 * statistics.black));
            }
        }
    }
    faults
}

/// A model without a scene, as shown by `alberti render MODEL`. It is loaded once for all its
/// pictures.
struct BareModel<'a> {
    origin: Origin,
    file: SceneFile,
    loaded: &'a Scene,
    textures: &'a Textures<'a>,
}

impl BareModel<'_> {
    /// Returns the model's picture in a style, with its scene and warnings.
    fn render(
        &self,
        style: StyleFile,
        size: (u32, u32),
    ) -> Result<(Picture, Scene, Vec<drawing::Warning>), String> {
        let mut file = SceneFile { style, ..self.file.clone() };
        file.image.size = size;
        let scene = Scene::from_models(&self.origin, &file, &self.loaded.models);
        let scene = scene.map_err(|error| error.to_string())?;
        let mut picture = Picture::default();
        let context = RenderContext::new(&scene, self.textures, 1);
        let warnings = Renderer::default().render(&context, &mut picture);
        let warnings = warnings.map_err(|error| error.to_string())?;
        Ok((picture, scene, warnings))
    }

    /// Returns the statistics of the picture in a style.
    fn statistics(&self, style: &StyleFile) -> Result<PictureStatistics, String> {
        let (picture, ..) = self.render(style.clone(), SIZE)?;
        Ok(PictureStatistics::of_picture(&picture))
    }
}

/// Returns whether a list contains a model.
fn is_exempt(name: &str, list: &[(&str, &str)]) -> bool {
    list.iter().any(|(known, _)| name == *known)
}

/// Returns the name of a model: the file name, or the folder name if the folder has no other model.
fn model_name(model: &Path) -> String {
    let folder = model.parent().filter(|folder| !folder.ends_with("scenes/models"));
    let named = folder.map_or_else(|| model.file_stem(), Path::file_name);
    named.unwrap_or_default().to_string_lossy().into_owned()
}

/// Returns the glTF files in a folder, sorted by name.
fn list_models(folder: &Path) -> Result<Vec<PathBuf>, String> {
    let mut files = list_folder(folder)?;
    files.retain(|path| path.extension().is_some_and(|ending| ending == "glb" || ending == "gltf"));
    Ok(files)
}

/// Returns the contents of a folder, sorted by name.
fn list_folder(folder: &Path) -> Result<Vec<PathBuf>, String> {
    let in_folder = |error: std::io::Error| format!("{}: {error}", folder.display());
    let entries = std::fs::read_dir(folder).map_err(in_folder)?;
    let mut paths: Vec<PathBuf> = entries.flatten().map(|entry| entry.path()).collect();
    paths.sort();
    Ok(paths)
}
