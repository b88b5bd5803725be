//! From what a person wrote to what drawing needs, or to an error that points.

use super::file::{BackgroundFile, Choice, Finite, LightFile, ModelFile, OverlayFile};
use super::locate::Step::{Field, Index};
use super::look::resolve_style;
use super::number::Positive;
use super::parse::suggestion;
use super::viewpoint::resolve_shot;
use super::{ImageSpec, Origin, Placed, ResolveError, Scene, SceneError, SceneFile};
use crate::color::parse_hex;
use crate::drawing::Overlay;
use crate::import::{FaultKind, ImportError, ImportOptions, load};
use crate::model::Model;
use crate::render::Shot;
use crate::shade::Light;
use homog::{Affine, Model as ModelSpace, Vector, World};
use raster::Samples;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// How a scene is resolved.
#[derive(Clone, Debug, Default)]
pub struct ResolveOptions {
    /// How models are loaded. The paths of a scene file may lead out of its folder into those that `allow_outside` names.
    pub import: ImportOptions,
}

impl Scene {
    /// Loads the models of a scene and decides everything that the file leaves open.
    ///
    /// # Errors
    /// If a model cannot be loaded or something makes no sense; the error points at its place in the file.
    pub fn resolve(
        origin: &Origin,
        file: &SceneFile,
        options: &ResolveOptions,
    ) -> Result<Self, ResolveError> {
        resolve_image(origin, file)?;
        let models = load_models(origin, file, options)?;
        let frame = || Self::of_models(origin, file, models);
        options.import.timings.measure("frame", frame)
    }

    /// Decides everything that the file leaves open around models that are loaded, posed and placed; those of the file are not
    /// looked at.
    ///
    /// # Errors
    /// If something makes no sense; the error points at its place in the file.
    pub fn of_models(
        origin: &Origin,
        file: &SceneFile,
        models: Vec<Placed>,
    ) -> Result<Self, ResolveError> {
        let image = resolve_image(origin, file)?;
        let shot = resolve_shot(origin, &file.camera, &models, image)?;
        let lights = resolve_lights(origin, file, &shot)?;
        let style = resolve_style(origin, &file.style)?;
        let overlays = resolve_overlays(origin, &file.overlays, &models, image)?;
        Ok(Self { models, shot, lights, style, image, overlays })
    }
}

pub(super) fn resolve_image(origin: &Origin, file: &SceneFile) -> Result<ImageSpec, SceneError> {
    let (width, height) = file.image.size;
    let fits = |side: u32| (1..=raster::MAX_SIDE).contains(&side);
    if !fits(width) || !fits(height) {
        let message = format!("a picture cannot have {width} x {height} pixels");
        let help = format!("each side must be between 1 and {}", raster::MAX_SIDE);
        return Err(origin.fault(&[Field("image"), Field("size")], message, Some(help)));
    }
    let samples = Samples::from_count(file.image.samples).ok_or_else(|| {
        let message = format!("a pixel cannot have {} samples", file.image.samples);
        let help = Some("possible are 1, 4, 8 and 16".to_owned());
        origin.fault(&[Field("image"), Field("samples")], message, help)
    })?;
    let background = match &file.image.background {
        BackgroundFile::Transparent => [0.0; 4],
        BackgroundFile::Color(text) => {
            let [r, g, b] = parse_hex(text).ok_or_else(|| {
                let message = format!("`{text}` is no colour");
                let help = Some("write #rgb or #rrggbb, such as #f4f1ea".to_owned());
                origin.fault(&[Field("image"), Field("background")], message, help)
            })?;
            [r, g, b, 1.0]
        }
    };
    Ok(ImageSpec { width, height, background, samples })
}

pub(super) fn no_model(origin: &Origin) -> SceneError {
    let help = Some("add one: models: [(path: \"…\")]".to_owned());
    origin.fault(&[Field("models")], "a scene needs a model", help)
}

fn load_models(
    origin: &Origin,
    file: &SceneFile,
    options: &ResolveOptions,
) -> Result<Vec<Placed>, ResolveError> {
    if file.models.is_empty() {
        return Err(no_model(origin).into());
    }
    // Models in one pose are shared; a model in two poses is two models.
    type Pose = (PathBuf, [Option<Choice>; 3], Option<u64>);
    let mut loaded: BTreeMap<Pose, Arc<Model>> = BTreeMap::new();
    let mut models = Vec::new();
    for (number, entry) in file.models.iter().enumerate() {
        let path = origin.folder.join(&entry.path);
        let time = entry.time.map(|time| time.value().to_bits());
        let choices = [&entry.scene, &entry.variant, &entry.animation].map(Clone::clone);
        let pose = (path, choices, time);
        let model = if let Some(model) = loaded.get(&pose) {
            Arc::clone(model)
        } else {
            let model = load_model(origin, number, entry, options);
            let model = model.map_err(|fault| fault.in_scene(origin, number, entry))?;
            let model = Arc::new(model);
            loaded.insert(pose, Arc::clone(&model));
            model
        };
        models.push(Placed { model, model_to_world: placement(entry) });
    }
    Ok(models)
}

/// Why there is no model: the scene asks for something that makes no sense, or the model's file is at fault.
pub(super) enum ModelFault {
    Scene(SceneError),
    File(ImportError),
}

impl From<SceneError> for ModelFault {
    fn from(error: SceneError) -> Self {
        Self::Scene(error)
    }
}

impl ModelFault {
    /// The fault, told where the scene file asks for the model, if there is such a file.
    fn in_scene(self, origin: &Origin, number: usize, entry: &ModelFile) -> ResolveError {
        match self {
            Self::File(error) if origin.text.is_empty() => error.into(),
            Self::File(error) => {
                let at = [Field("models"), Index(number), Field("path")];
                origin.fault(&at, format!("{}: {}", entry.path, error.fault), None).into()
            }
            Self::Scene(error) => error.into(),
        }
    }
}

/// Loads a model and poses it.
pub(super) fn load_model(
    origin: &Origin,
    number: usize,
    entry: &ModelFile,
    options: &ResolveOptions,
) -> Result<Model, ModelFault> {
    let at = |field| [Field("models"), Index(number), Field(field)];
    if !origin.may_read(Path::new(&entry.path), &options.import.allow_outside) {
        let help =
            "keep models below the scene's folder, or allow another with --allow-outside DIR";
        let message = format!("the path \"{}\" leads out of the scene's folder", entry.path);
        return Err(origin.fault(&at("path"), message, Some(help.to_owned())).into());
    }
    let import = ImportOptions {
        scene: entry.scene.clone().map(Into::into).or(options.import.scene.clone()),
        variant: entry.variant.clone().map(Into::into).or(options.import.variant.clone()),
        ..options.import.clone()
    };
    let loaded = load(&origin.folder.join(&entry.path), &import);
    let mut model = loaded.map_err(|error| choice_fault(origin, number, entry, error))?;
    if entry.animation.is_some() || entry.time.is_some() {
        let field = if entry.animation.is_some() { "animation" } else { "time" };
        let fault = |(message, help)| origin.fault(&at(field), message, help);
        let animation = chosen_animation(&model, entry.animation.as_ref()).map_err(fault)?;
        model.pose(animation, entry.time.map_or(0.0, Finite::value));
    }
    Ok(model)
}

/// A scene or a variant that the model does not have is a mistake of the scene file, if there is one.
fn choice_fault(
    origin: &Origin,
    number: usize,
    entry: &ModelFile,
    error: ImportError,
) -> ModelFault {
    if origin.text.is_empty() || error.fault.kind != FaultKind::Choice {
        return ModelFault::File(error);
    }
    let scene = entry.scene.is_some() && error.fault.pointer == "/scenes";
    let field = if scene { "scene" } else { "variant" };
    let message = format!("{}: {}", entry.path, error.fault.problem);
    let at = [Field("models"), Index(number), Field(field)];
    origin.fault(&at, message, Some(error.fault.remedy)).into()
}

/// The number of the animation that is wanted, or the first.
///
/// # Errors
/// If there is none: what is wrong, and what to do about it.
pub fn chosen_animation(
    model: &Model,
    choice: Option<&Choice>,
) -> Result<usize, (String, Option<String>)> {
    let count = model.animations.len();
    if count == 0 {
        return Err((format!("the model {} has no animation", model.name), None));
    }
    let named = |wanted: &str| {
        model.animations.iter().position(|animation| animation.name.as_deref() == Some(wanted))
    };
    let (found, wanted) = match choice {
        None => return Ok(0),
        Some(Choice::Index(index)) => ((*index < count).then_some(*index), index.to_string()),
        Some(Choice::Name(name)) => (named(name), name.clone()),
    };
    found.ok_or_else(|| {
        let names = model.animations.iter().filter_map(|animation| animation.name.clone());
        let names: Vec<String> = names.chain((0..count).map(|at| at.to_string())).collect();
        let message = format!("the model {} has no animation `{wanted}`", model.name);
        (message, suggestion(&wanted, &names))
    })
}

/// Scale, then turns about x, y and z, then translation.
pub(super) fn placement(entry: &ModelFile) -> Affine<ModelSpace, World> {
    let [sx, sy, sz] = entry.scale.0;
    let [rx, ry, rz] = entry.rotate_degrees.0.map(f64::to_radians);
    Affine::<ModelSpace, ModelSpace>::scale(sx, sy, sz)
        .then(Affine::<ModelSpace, ModelSpace>::rotation_x(rx))
        .then(Affine::<ModelSpace, ModelSpace>::rotation_y(ry))
        .then(Affine::<ModelSpace, ModelSpace>::rotation_z(rz))
        .then(Affine::translation(Vector::from(entry.translate.0)))
}

pub(super) fn resolve_overlays(
    origin: &Origin,
    overlays: &[OverlayFile],
    models: &[Placed],
    image: ImageSpec,
) -> Result<Vec<Overlay>, SceneError> {
    let resolve = |overlay: &OverlayFile| {
        Ok(match overlay {
            OverlayFile::Axes { length } => Overlay::Axes(length.map(Positive::value)),
            OverlayFile::Grid { step } => Overlay::Grid(step.map(Positive::value)),
            OverlayFile::Horizon => Overlay::Horizon,
            OverlayFile::VanishingPoints => Overlay::VanishingPoints,
            OverlayFile::Volume(camera) => {
                Overlay::Volume(resolve_shot(origin, camera, models, image)?.into())
            }
        })
    };
    overlays.iter().map(resolve).collect()
}

fn resolve_lights(
    origin: &Origin,
    file: &SceneFile,
    shot: &Shot,
) -> Result<Vec<Light>, SceneError> {
    let Some(lights) = &file.lights else { return Ok(default_lights(shot)) };
    let resolve = |(number, light): (usize, &LightFile)| resolve_light(origin, number, light);
    lights.iter().enumerate().map(resolve).collect()
}

/// A key light from above the viewer's left shoulder, so that shape reads from every side, and a quarter as much ambient.
fn default_lights(shot: &Shot) -> Vec<Light> {
    let camera = shot.camera;
    let towards = camera.u() * -0.45 + camera.v() * 0.65 + camera.w();
    let towards = towards.normalized().unwrap_or(camera.w());
    vec![
        Light::Sun { towards: towards.raw().as_vec3().to_array(), lux: [2.5; 3] },
        Light::Ambient { lux: [0.7; 3] },
    ]
}

pub(super) fn resolve_light(
    origin: &Origin,
    number: usize,
    light: &LightFile,
) -> Result<Light, SceneError> {
    let times = |strength: f64, color: [f64; 3]| color.map(|channel| (channel * strength) as f32);
    Ok(match *light {
        LightFile::Sun { direction, lux, color } => {
            let towards = -Vector::<World>::from(direction.0);
            let unit = towards.normalized().ok_or_else(|| {
                let at = [Field("lights"), Index(number), Field("direction")];
                let help =
                    Some("such as (-1, -2, -1): from the right, above and before".to_owned());
                origin.fault(&at, "the sun's direction is (0, 0, 0), which is none", help)
            })?;
            let towards = unit.raw().as_vec3().to_array();
            Light::Sun { towards, lux: times(lux.value(), color.0) }
        }
        LightFile::Point { position, candela, color } => Light::Point {
            position: position.0.map(|c| c as f32),
            candela: times(candela.value(), color.0),
            range: f32::INFINITY,
        },
        LightFile::Ambient { lux, color } => Light::Ambient { lux: times(lux.value(), color.0) },
    })
}
