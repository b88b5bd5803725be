//! Loads, poses and places a scene's models.

use super::diagnostics::Diagnostics;
use super::material_overrides::override_materials;
use super::origin::ModelSource;
use super::resolve_options::ResolveOptions;
use super::{Origin, ResolveError, instances};
use import::ScalarColors;
use import::{
    FileFormat, ImportError, ImportOptions, NameOrIndex, load, load_bytes, load_from_memory,
};
use model::codes::LIMIT_EXCEEDED;
use model::{LengthUnit, Model, ModelInstance, UpAxis};
use scene_file::PathStep::{Field, Index};
use scene_file::file::{Choice, Finite, MaterialFile, ModelFile, ScalarsFile};
use scene_file::{SceneError, SceneErrors, SceneFile, closest_name, suggest_name};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// A model's file, its axis and unit, its scene, variant and animation, and the bits of its crease
/// angle and time.
type Pose = (PathBuf, (Option<UpAxis>, Option<LengthUnit>), [Option<Choice>; 3], [Option<u64>; 2]);

/// A model in one pose with its colors and materials.
struct ColoredModel<'a> {
    scalars: Option<&'a ScalarsFile>,
    materials: &'a [MaterialFile],
    model: Arc<Model>,
}

/// The loaded models. Entries with the same pose and materials share a model.
#[derive(Default)]
struct LoadedModels<'a> {
    by_pose: BTreeMap<Pose, Vec<ColoredModel<'a>>>,
    /// The size of the models' arrays and images in bytes.
    bytes: u64,
}

/// Extra memory that an importer may use for temporary arrays, even if the budget is nearly used
/// up.
const SCRATCH_BYTES: u64 = 1 << 20;

impl<'a> LoadedModels<'a> {
    /// Returns the model of an entry, and loads it if necessary.
    fn load(
        &mut self,
        origin: &Origin,
        number: usize,
        entry: &'a ModelFile,
        options: &ResolveOptions,
    ) -> Result<Arc<Model>, ModelError> {
        // Bit patterns can be map keys; floating-point numbers cannot.
        let numbers = [entry.crease_degrees, entry.time];
        let bits = numbers.map(|number| number.map(|number| number.value().to_bits()));
        let choices = [&entry.scene, &entry.variant, &entry.animation].map(Clone::clone);
        let pose = (origin.folder.join(&entry.path), (entry.up, entry.unit), choices, bits);
        let alike = self.by_pose.entry(pose).or_default();
        // These cannot be map keys, but few entries share all of the above.
        let (scalars, materials) = (entry.scalars.as_ref(), entry.materials.as_slice());
        let is_same =
            |one: &&ColoredModel<'_>| one.scalars == scalars && one.materials == materials;
        if let Some(loaded) = alike.iter().find(is_same) {
            return Ok(Arc::clone(&loaded.model));
        }
        // The limits that remain after the earlier models. Importers also count temporary arrays.
        let (mut rest, limits) = (options.clone(), &options.import.limits);
        let left = limits.scene_bytes.saturating_sub(self.bytes);
        let with_scratch = left.saturating_mul(2).saturating_add(SCRATCH_BYTES);
        rest.import.limits.array_bytes = limits.array_bytes.min(with_scratch);
        // A texel takes four bytes.
        rest.import.limits.image_texels = limits.image_texels.min(left / 4);
        let exceeded = || scene_bytes_error(origin, number, limits.scene_bytes);
        let loaded = load_model(origin, number, entry, &rest);
        // If only the memory left by earlier models was too small, the error names the scene's
        // limit.
        let model = Arc::new(loaded.map_err(|error| match error {
            ModelError::File(error)
                if error.diagnostic.code == LIMIT_EXCEEDED && rest.import.limits != *limits =>
            {
                exceeded().into()
            }
            other => other,
        })?);
        self.bytes = self.bytes.saturating_add(model.array_bytes());
        if self.bytes > limits.scene_bytes {
            return Err(exceeded().into());
        }
        alike.push(ColoredModel { scalars, materials, model: Arc::clone(&model) });
        Ok(model)
    }
}

/// Loads and places a scene's models, each file once; returns `None` if not all can be loaded.
pub(super) fn load_models(
    origin: &Origin,
    file: &SceneFile,
    options: &ResolveOptions,
    faults: &mut Diagnostics,
) -> Option<Vec<ModelInstance>> {
    if file.models.is_empty() {
        let help = Some("add one: models: [(path: \"…\")]".to_owned());
        faults.report(origin.error_at(&[Field("models")], "a scene needs a model", help));
        return None;
    }
    // Checked first, because it costs nothing compared with loading models.
    faults.take(instances::check_instance_counts(origin, file))?;
    let (mut loaded, mut models) = (LoadedModels::default(), Some(Vec::new()));
    for (number, entry) in file.models.iter().enumerate() {
        let instances = match loaded.load(origin, number, entry, options) {
            Ok(model) => faults.take(instances::instantiate_model(origin, number, entry, &model)),
            Err(error) => {
                faults.report(error.into_resolve_error(origin, number, entry));
                None
            }
        };
        match (&mut models, instances) {
            // After an error the other models are still loaded, to report every mistake.
            (Some(models), Some(instances)) => models.extend(instances),
            _ => models = None,
        }
    }
    models
}

/// Reports model paths that do not exist or lead outside the scene's folder. No file is read.
pub(super) fn check_model_paths(
    origin: &Origin,
    file: &SceneFile,
    allowed: &[PathBuf],
    faults: &mut Diagnostics,
) {
    for (index, entry) in file.models.iter().enumerate() {
        if !origin.allows_path(Path::new(&entry.path), allowed) {
            faults.report(outside_folder_error(origin, index, entry));
            continue;
        }
        let path = origin.folder.join(&entry.path);
        let is_lesson_model = entry.path.starts_with("lesson:");
        if origin.models == ModelSource::Disk && !is_lesson_model && !path.exists() {
            let error = load(&path, &ImportOptions::default()).err().map(ModelError::File);
            let error = error.map(|error| error.into_resolve_error(origin, index, entry));
            error.into_iter().for_each(|error| faults.report(error));
        }
    }
}

/// Creates the error for a model with which the models take more memory than a scene may use.
fn scene_bytes_error(origin: &Origin, number: usize, most: u64) -> SceneError {
    let message = format!("with this model, the models exceed the limit of {} MiB", most >> 20);
    let help = "remove models, simplify them or use smaller textures; or raise `--max-scene-bytes`";
    origin.error_at(&[Field("models"), Index(number)], message, Some(help.to_owned()))
}

/// Creates the error for a model whose path leads outside the scene's folder.
fn outside_folder_error(origin: &Origin, index: usize, entry: &ModelFile) -> SceneError {
    let help = "keep models below the scene's folder, or allow another folder with --allow-outside \
                DIR";
    let message = format!("the path \"{}\" points outside the scene's folder", entry.path);
    let path = [Field("models"), Index(index), Field("path")];
    origin.error_at(&path, message, Some(help.to_owned()))
}

/// The reason why a model is missing: an invalid request in the scene, or an error in the model's
/// file.
enum ModelError {
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
    /// Converts the error to a scene file error that points at the model's path, if there is a
    /// scene file.
    fn into_resolve_error(self, origin: &Origin, number: usize, entry: &ModelFile) -> ResolveError {
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

/// Suggests a path for a missing model: a file with a similar name in the same folder, or a file
/// with the same name in a folder next to the scene.
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

/// Lists the files and folders in a folder, in alphabetical order; empty if it cannot be read.
fn names_in_folder(folder: &Path) -> Vec<String> {
    let here = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    let entries = std::fs::read_dir(here).into_iter().flatten();
    let mut names: Vec<String> =
        entries.filter_map(|entry| entry.ok()?.file_name().into_string().ok()).collect();
    names.sort();
    names
}

/// Loads and poses a model.
fn load_model(
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
        scene: entry.scene.clone().map(name_or_index).or(options.import.scene.clone()),
        variant: entry.variant.clone().map(name_or_index).or(options.import.variant.clone()),
        // Flags override the scene file.
        up: options.import.up.or(entry.up),
        length_unit: options.import.length_unit.or(entry.unit),
        crease_angle: options.import.crease_angle.or(resolve_crease(origin, number, entry)?),
        scalars: entry.scalars.as_ref().map(scalar_colors).or(options.import.scalars.clone()),
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

/// Converts a choice among the items of a model to the form that importers accept.
#[must_use]
pub fn name_or_index(choice: Choice) -> NameOrIndex {
    match choice {
        Choice::Index(at) => NameOrIndex::Index(at),
        Choice::Name(name) => NameOrIndex::Name(name),
    }
}

/// Converts colors from a scalar attribute to the form that importers accept.
fn scalar_colors(file: &ScalarsFile) -> ScalarColors {
    ScalarColors {
        attribute: file.attribute.clone(),
        colormap: file.colormap,
        range: file.range.map(|(min, max)| [min.value(), max.value()]),
    }
}

/// Resolves the crease angle of a model, in degrees.
///
/// # Errors
/// Returns an error if it is not between 0 and 180.
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
    let help = "use an angle from 0 to 180 degrees".to_owned();
    Err(origin.error_at(&at, format!("invalid crease angle: {angle} degrees"), Some(help)))
}

/// Reports a scene, a variant or a scalar attribute that the model lacks as a mistake in the scene
/// file, if there is one.
fn choice_error(
    origin: &Origin,
    number: usize,
    entry: &ModelFile,
    error: ImportError,
) -> ModelError {
    if origin.text.is_empty() || error.diagnostic.code != model::codes::NO_SUCH_ITEM {
        return ModelError::File(error);
    }
    let location = error.diagnostic.location.as_str();
    let field = match location {
        "/scenes" if entry.scene.is_some() => "scene",
        _ if entry.variant.is_some() && location.starts_with("/extensions") => "variant",
        _ if entry.scalars.is_some() => "scalars",
        _ => "variant",
    };
    let message = format!("{}: {}", entry.path, error.diagnostic.message);
    let at = [Field("models"), Index(number), Field(field)];
    origin.error_at(&at, message, error.diagnostic.help).into()
}

/// Returns the index of the selected animation, or of the first one if none is selected.
///
/// # Errors
/// Returns a message and a suggested fix if there is no such animation.
pub fn select_animation(
    model: &Model,
    choice: Option<&Choice>,
) -> Result<usize, (String, Option<String>)> {
    let count = model.animations.len();
    if count == 0 {
        let help = "remove the animation and the time; to rotate the model instead, run \
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
