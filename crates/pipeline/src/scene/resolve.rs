//! Resolution: from a parsed scene file to the scene that is rendered, or to errors that point into
//! the file. Models are loaded, angles are radians, and every default is decided.

use super::backdrop::{is_blank_paper, resolve_background_color};
use super::caption::resolve_caption;
use super::exposure::resolve_exposure;
use super::file::{BackgroundFile, Choice, Finite, MaterialFile, ModelFile, ViewFile};
use super::file_access::FileAccess;
use super::ground::{resolve_ground, shadow_points};
use super::insets::resolve_insets;
use super::instances;
use super::lights::{resolve_lights, scale_lights};
use super::material_overrides::override_materials;
use super::number::Positive;
use super::origin::ModelSource;
use super::overlays::resolve_overlays;
use super::resolve_options::ResolveOptions;
use super::section::resolve_sections;
use super::style::resolve_style;
use super::suggest::{closest_name, suggest_name};
use super::surrounding_light::has_lights;
use super::syntax::PathStep::{Field, Index};
use super::uncut::resolve_uncut;
use super::validate::{errors_around_models, errors_of_resolution};
use super::view_projection::{resolve_view_of_points, resolve_view_projection};
use super::{ImageSpec, Origin, ResolveError, Scene, SceneError, SceneErrors, SceneFile, Style};
use camera::ViewProjection;
use homog::{Bounds, Plane, Point, World};
use model::import::{FileFormat, ImportError, ImportOptions, load, load_bytes, load_from_memory};
use model::world_points;
use model::{LengthUnit, Model, ModelInstance, UpAxis};
use raster::Samples;
use shade::{ToneMapper, ToneMapping};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

impl Scene {
    /// Loads the models of a scene and decides everything that the file leaves open.
    ///
    /// # Errors
    /// If a model cannot be loaded; and every mistake of the scene that can be found, in the order
    /// of the file.
    pub fn resolve(
        origin: &Origin,
        file: &SceneFile,
        options: &ResolveOptions,
    ) -> Result<Self, ResolveError> {
        let image = resolve_image(origin, file).and_then(|_| options.check_pixels(origin, file));
        let loaded =
            image.map_err(ResolveError::from).and_then(|()| load_models(origin, file, options));
        let models =
            loaded.map_err(|error| error.or_all(|| errors_of_resolution(origin, file, options)))?;
        let allowed = &options.import.allow_outside;
        let frame = || Self::resolve_with_models(origin, file, models.clone(), allowed);
        let scene = options.import.timings.measure("frame", frame);
        let mut scene = scene.map_err(|error| {
            error.or_all(|| errors_around_models(origin, file, models, allowed))
        })?;
        scene.unlimited_lines = options.unlimited_lines;
        for inset in &mut scene.insets {
            inset.scene.unlimited_lines = options.unlimited_lines;
        }
        Ok(scene)
    }

    /// Decides everything that the file leaves open around models that are loaded, posed and
    /// placed; those of the file are not looked at.
    ///
    /// # Errors
    /// If something makes no sense; the error points at its place in the file.
    pub fn from_models(
        origin: &Origin,
        file: &SceneFile,
        models: Vec<ModelInstance>,
    ) -> Result<Self, ResolveError> {
        Self::from_models_allowing(origin, file, models, &[])
    }

    /// As [`from_models`](Self::from_models); images and environments may lie in the `allowed`
    /// folders too.
    ///
    /// # Errors
    /// As [`from_models`](Self::from_models).
    pub fn from_models_allowing(
        origin: &Origin,
        file: &SceneFile,
        models: Vec<ModelInstance>,
        allowed: &[PathBuf],
    ) -> Result<Self, ResolveError> {
        Self::resolve_with_models(origin, file, models, allowed)
    }

    /// Decides everything that the file leaves open about the camera alone: where it stands around
    /// models that are loaded, posed and placed, or without any.
    ///
    /// # Errors
    /// If the size or the camera makes no sense; without models, if it is to frame them.
    pub fn resolve_camera(
        origin: &Origin,
        file: &SceneFile,
        models: &[ModelInstance],
    ) -> Result<ViewProjection, ResolveError> {
        let image = resolve_image(origin, file)?;
        Ok(resolve_view_projection(origin, &file.camera, models, image)?)
    }

    /// The scene around its models; the environment's file may lie in one of the `allowed` folders
    /// too.
    pub(crate) fn resolve_with_models(
        origin: &Origin,
        file: &SceneFile,
        models: Vec<ModelInstance>,
        allowed: &[PathBuf],
    ) -> Result<Self, ResolveError> {
        Self::resolve_posed(origin, file, models, FileAccess::Read(allowed))
    }

    /// The scene around its models in another pose; files come from where `access` says.
    pub(crate) fn resolve_posed(
        origin: &Origin,
        file: &SceneFile,
        models: Vec<ModelInstance>,
        access: FileAccess<'_>,
    ) -> Result<Self, ResolveError> {
        let mut scene = Self::resolve_without_insets(origin, file, models, access)?;
        scene.insets = resolve_insets(origin, file, &scene.models, access)?;
        Ok(scene)
    }

    /// Resolves the scene without its viewports and stereo pair.
    pub(super) fn resolve_without_insets(
        origin: &Origin,
        file: &SceneFile,
        models: Vec<ModelInstance>,
        access: FileAccess<'_>,
    ) -> Result<Self, ResolveError> {
        let image = resolve_image(origin, file)?;
        let caption = resolve_caption(origin, file.caption.as_ref())?;
        let style = resolve_style(origin, &file.style)?;
        let sections = resolve_sections(origin, &file.sections)?;
        let uncut = resolve_uncut(origin, &file.sections, &models)?;
        let framed = (&*models, framed_points(&models, style, (&sections, &uncut)));
        let mut view_projection =
            resolve_view_of_points(origin, &file.camera, framed, image, Vec::new())?;
        let mut lights = resolve_lights(origin, file, &models, &view_projection)?;
        let has_environment = file.effective_environment(origin, &models).is_some();
        let ground = resolve_ground(file, &models, &lights, has_environment);
        let is_framed = matches!(file.camera.view, ViewFile::Frame { .. });
        if let Some(ground) = ground.filter(|_| is_framed && style.draws_surfaces()) {
            // The key light stands by the direction of view, which framing keeps.
            let shadows = shadow_points(ground, &models, &lights);
            let framed = (&*models, world_points(&models));
            view_projection = resolve_view_of_points(origin, &file.camera, framed, image, shadows)?;
        }
        let occlusion_radius = file.ambient_occlusion.map(|file| {
            let usual = || {
                Bounds::from_points(world_points(&models)).map_or(1.0, |all| all.diagonal() / 12.0)
            };
            file.radius.map_or_else(usual, Positive::value)
        });
        let exposure_ev = resolve_exposure(origin, file, &models, &lights);
        // The studio is calibrated to stay below 1. Lights of a model are of any brightness.
        let has_model_lights = file.has_default_light(origin) && has_lights(&models);
        let curve = if has_model_lights { ToneMapping::Neutral } else { ToneMapping::None };
        let tone_mapper = ToneMapper::new(exposure_ev, file.image.tone_mapping.unwrap_or(curve));
        // After the exposure, which would compensate for it.
        scale_lights(&mut lights, file.light_intensity);
        let environment = access.environment(origin, file, &models, exposure_ev)?;
        let overlays = resolve_overlays(origin, &file.overlays, &models, image)?;
        let backdrop = access.backdrop(origin, file)?;
        Ok(Self {
            models,
            view_projection,
            lights,
            ground,
            environment,
            occlusion_radius,
            tone_mapper,
            style,
            image,
            insets: Vec::new(),
            backdrop,
            overlays,
            caption,
            sections,
            uncut,
            unlimited_lines: false,
        })
    }
}

/// The points that a view frames: in line drawings those of what section planes leave.
fn framed_points(
    models: &[ModelInstance],
    style: Style,
    (sections, uncut): (&[Plane<World>], &[u32]),
) -> Vec<Point<World>> {
    if sections.is_empty() || style.draws_surfaces() {
        return world_points(models);
    }
    drawing::retained_points(models, sections, uncut)
}

/// The image that a scene renders.
pub(super) fn resolve_image(origin: &Origin, file: &SceneFile) -> Result<ImageSpec, SceneError> {
    let (width, height) = resolve_image_size(origin, file)?;
    let samples = resolve_samples(origin, file)?;
    let background = resolve_background_color(origin, file)?;
    let environment_blur = match &file.image.background {
        Some(BackgroundFile::Environment { blur }) => {
            Some(blur.map_or(0.0, |blur| blur.value().min(1.0) as f32))
        }
        _ => None,
    };
    let max_anisotropy = resolve_max_anisotropy(origin, file)?;
    let caption_height = file.caption_height();
    Ok(ImageSpec {
        width,
        height,
        caption_height,
        background,
        is_blank_paper: is_blank_paper(file),
        environment_blur,
        samples,
        max_anisotropy,
        point_size: file.image.point_size.value(),
    })
}

/// Width and height of the image.
pub(super) fn resolve_image_size(
    origin: &Origin,
    file: &SceneFile,
) -> Result<(u32, u32), SceneError> {
    let (width, height) = file.image.size;
    let fits = |side: u32| (1..=crate::MAX_IMAGE_SIDE).contains(&side);
    if fits(width) && fits(height) {
        return Ok((width, height));
    }
    let message = format!("a picture cannot have {width} x {height} pixels");
    let help = format!("each side must be between 1 and {}", crate::MAX_IMAGE_SIDE);
    Err(origin.error_at(&[Field("image"), Field("size")], message, Some(help)))
}

/// The count of coverage samples.
pub(super) fn resolve_samples(origin: &Origin, file: &SceneFile) -> Result<Samples, SceneError> {
    Samples::from_count(file.image.samples).ok_or_else(|| {
        let message = format!("a pixel cannot have {} samples", file.image.samples);
        let help = Some("possible are 1, 4, 8 and 16".to_owned());
        origin.error_at(&[Field("image"), Field("samples")], message, help)
    })
}

/// The most samples of anisotropic texture filtering.
pub(super) fn resolve_max_anisotropy(origin: &Origin, file: &SceneFile) -> Result<u32, SceneError> {
    let max_anisotropy = file.image.max_anisotropy;
    if (1..=8).contains(&max_anisotropy) {
        return Ok(max_anisotropy);
    }
    let message = format!("anisotropic filtering cannot take {max_anisotropy} samples");
    let help = Some("from 1 to 8 are possible".to_owned());
    Err(origin.error_at(&[Field("image"), Field("max_anisotropy")], message, help))
}

/// A model whose path leads out of the scene's folder.
pub(super) fn outside_folder_error(origin: &Origin, index: usize, entry: &ModelFile) -> SceneError {
    let help = "keep models below the scene's folder, or allow another with --allow-outside DIR";
    let message = format!("the path \"{}\" leads out of the scene's folder", entry.path);
    let path = [Field("models"), Index(index), Field("path")];
    origin.error_at(&path, message, Some(help.to_owned()))
}

/// A scene without models.
pub(super) fn missing_model_error(origin: &Origin) -> SceneError {
    let help = Some("add one: models: [(path: \"…\")]".to_owned());
    origin.error_at(&[Field("models")], "a scene needs a model", help)
}

/// Loads the models of a scene, and instantiates them.
fn load_models(
    origin: &Origin,
    file: &SceneFile,
    options: &ResolveOptions,
) -> Result<Vec<ModelInstance>, ResolveError> {
    if file.models.is_empty() {
        return Err(missing_model_error(origin).into());
    }
    instances::check_instance_counts(origin, file)?;
    // Models in one pose are shared; a model in two poses, or with other materials, is two models.
    /// The file of a model, its axis and unit, its scene, variant and animation, and the bits of
    /// crease angle and time.
    type Pose =
        (PathBuf, (Option<UpAxis>, Option<LengthUnit>), [Option<Choice>; 3], [Option<u64>; 2]);
    /// The models of one pose, one for each set of material overrides.
    type Alike<'a> = Vec<(&'a [MaterialFile], Arc<Model>)>;
    let mut loaded: BTreeMap<Pose, Alike<'_>> = BTreeMap::new();
    let mut models = Vec::new();
    for (number, entry) in file.models.iter().enumerate() {
        let path = origin.folder.join(&entry.path);
        let numbers = [entry.crease_degrees, entry.time];
        let bits = numbers.map(|number| number.map(|number| number.value().to_bits()));
        let choices = [&entry.scene, &entry.variant, &entry.animation].map(Clone::clone);
        let pose = (path, (entry.up, entry.unit), choices, bits);
        let alike = loaded.entry(pose).or_default();
        let known = alike.iter().find(|(materials, _)| **materials == *entry.materials);
        let model = if let Some((_, model)) = known {
            Arc::clone(model)
        } else {
            let model = load_model(origin, number, entry, options);
            let model = model.map_err(|fault| fault.into_resolve_error(origin, number, entry))?;
            let model = Arc::new(model);
            alike.push((&entry.materials, Arc::clone(&model)));
            model
        };
        models.extend(instances::instantiate_model(origin, number, entry, &model)?);
    }
    Ok(models)
}

/// Why there is no model: the scene asks for something that makes no sense, or the model's file is
/// at fault.
pub(super) enum ModelError {
    Scene(SceneErrors),
    File(ImportError),
}

impl From<SceneError> for ModelError {
    fn from(error: SceneError) -> Self {
        Self::Scene(error.into())
    }
}

impl From<SceneErrors> for ModelError {
    fn from(errors: SceneErrors) -> Self {
        Self::Scene(errors)
    }
}

impl ModelError {
    /// The error as one of the scene file, pointing at the path of the model, if there is a scene
    /// file.
    pub(super) fn into_resolve_error(
        self,
        origin: &Origin,
        number: usize,
        entry: &ModelFile,
    ) -> ResolveError {
        match self {
            Self::File(error) if origin.text.is_empty() => error.into(),
            Self::File(error) => {
                let at = [Field("models"), Index(number), Field("path")];
                let on_disk = origin.models == ModelSource::Disk;
                let suggest = || suggest_model_file(&origin.folder, &entry.path);
                let help = on_disk.then(suggest).flatten();
                origin
                    .error_at(&at, format!("{}: {}", entry.path, error.diagnostic.sentence()), help)
                    .into()
            }
            Self::Scene(errors) => ResolveError::Scene(errors),
        }
    }
}

/// For a model that is not there, the path of one in the same folder with a similar name, or of one
/// in a folder beside the scene with the same name.
fn suggest_model_file(folder: &Path, path: &str) -> Option<String> {
    let path = Path::new(path);
    if folder.join(path).exists() {
        return None;
    }
    let wanted = path.file_name()?.to_str()?;
    let beside = path.parent().unwrap_or(Path::new(""));
    let is_model = |name: &String| FileFormat::from_extension(Path::new(name)).is_some();
    let models: Vec<String> =
        names_in_folder(&folder.join(beside)).into_iter().filter(is_model).collect();
    let names: Vec<&str> = models.iter().map(String::as_str).collect();
    let similar = closest_name(wanted, &names).map(|name| beside.join(name));
    let elsewhere = || {
        let folders = names_in_folder(folder).into_iter().map(PathBuf::from);
        folders.map(|inner| inner.join(wanted)).find(|path| folder.join(path).is_file())
    };
    let found = similar.or_else(elsewhere)?;
    Some(format!("did you mean \"{}\"?", found.to_str()?.replace('\\', "/")))
}

/// The names of the files and folders in a folder, in the order of the alphabet; none if it cannot
/// be read.
fn names_in_folder(folder: &Path) -> Vec<String> {
    let here = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    let entries = std::fs::read_dir(here).into_iter().flatten();
    let mut names: Vec<String> =
        entries.filter_map(|entry| entry.ok()?.file_name().into_string().ok()).collect();
    names.sort();
    names
}

/// Loads a model and poses it.
pub(super) fn load_model(
    origin: &Origin,
    number: usize,
    entry: &ModelFile,
    options: &ResolveOptions,
) -> Result<Model, ModelError> {
    let at = |field| [Field("models"), Index(number), Field(field)];
    if !origin.allows_path(Path::new(&entry.path), &options.import.allow_outside) {
        return Err(outside_folder_error(origin, number, entry).into());
    }
    let import = ImportOptions {
        scene: entry.scene.clone().map(Into::into).or(options.import.scene.clone()),
        variant: entry.variant.clone().map(Into::into).or(options.import.variant.clone()),
        // Flags replace what the scene file says.
        up: options.import.up.or(entry.up),
        length_unit: options.import.length_unit.or(entry.unit),
        crease_angle: options.import.crease_angle.or(resolve_crease(origin, number, entry)?),
        ..options.import.clone()
    };
    let loaded = match &origin.models {
        ModelSource::Bytes(bytes) => load_bytes(&entry.path, bytes, &import),
        ModelSource::Memory(folder) => load_from_memory(folder, &entry.path, &import),
        ModelSource::Disk => load(&origin.folder.join(&entry.path), &import),
    };
    let mut model = loaded.map_err(|error| choice_error(origin, number, entry, error))?;
    if entry.animation.is_some() || entry.time.is_some() {
        let field = if entry.animation.is_some() { "animation" } else { "time" };
        let fault = |(message, help)| origin.error_at(&at(field), message, help);
        let animation = select_animation(&model, entry.animation.as_ref()).map_err(fault)?;
        model.apply_animation(animation, entry.time.map_or(0.0, Finite::value));
    }
    override_materials(origin, number, &entry.materials, &mut model)?;
    Ok(model)
}

/// The crease angle of a model in degrees.
///
/// # Errors
/// If it is not between 0 and 180.
fn resolve_crease(
    origin: &Origin,
    number: usize,
    entry: &ModelFile,
) -> Result<Option<f64>, SceneError> {
    let Some(angle) = entry.crease_degrees.map(Finite::value) else { return Ok(None) };
    if (0.0..=180.0).contains(&angle) {
        return Ok(Some(angle));
    }
    let at = [Field("models"), Index(number), Field("crease_degrees")];
    let help = "give an angle from 0 to 180".to_owned();
    Err(origin.error_at(&at, format!("there is no crease angle of {angle} degrees"), Some(help)))
}

/// A scene or a variant that the model does not have is a mistake of the scene file, if there is
/// one.
fn choice_error(
    origin: &Origin,
    number: usize,
    entry: &ModelFile,
    error: ImportError,
) -> ModelError {
    if origin.text.is_empty() || error.diagnostic.code != model::codes::NO_SUCH_ITEM {
        return ModelError::File(error);
    }
    let scene = entry.scene.is_some() && error.diagnostic.location == "/scenes";
    let field = if scene { "scene" } else { "variant" };
    let message = format!("{}: {}", entry.path, error.diagnostic.message);
    let at = [Field("models"), Index(number), Field(field)];
    origin.error_at(&at, message, error.diagnostic.help).into()
}

/// The number of the animation that is wanted, or the first.
///
/// # Errors
/// If there is none: what is wrong, and what to do about it.
pub fn select_animation(
    model: &Model,
    choice: Option<&Choice>,
) -> Result<usize, (String, Option<String>)> {
    let count = model.animations.len();
    if count == 0 {
        let help = "remove the animation and the time; to turn a model that has none, run \
                    `alberti animate model.glb --turntable -o turn.gif`";
        return Err((format!("`{}` has no animations", model.name), Some(help.to_owned())));
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
        let message = format!("`{}` has no animation `{wanted}`", model.name);
        (message, suggest_name(&wanted, &names))
    })
}
