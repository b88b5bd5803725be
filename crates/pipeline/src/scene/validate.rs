//! Validation: every mistake of a scene, and not only the first that resolution meets.
//!
//! Each part of the scene is resolved by itself, so that a mistake in one does not hide those in
//! another. A part that depends on one that is wrong is left out: its mistakes could follow from
//! that.
//!
//! There are three levels, by what must be known:
//! 1. the text alone, even if parts of it could not be read (`with_errors_of_description`);
//! 2. the text and the models (`validate_scene`), for `alberti scene check`;
//! 3. everything that stops a renderer (`errors_of_resolution`), for [`Scene::resolve`].

use super::backdrop::{resolve_backdrop, resolve_background_color};
use super::caption::resolve_caption;
use super::error::SceneError;
use super::file::SceneFile;
use super::file_access::FileAccess;
use super::include::FileMistake;
use super::insets::{resolve_border, resolve_insets, resolve_viewport_rect};
use super::lights::check_light;
use super::origin::{ModelSource, Origin};
use super::overlays::resolve_overlays;
use super::resolve::{
    ModelError, load_model, missing_model_error, outside_folder_error, resolve_image,
    resolve_image_size, resolve_max_anisotropy, resolve_samples,
};
use super::section::{check_section_count, resolve_section};
use super::shadows::resolve_shadow;
use super::style::resolve_style;
use super::surrounding_light::resolve_environment;
use super::syntax::PathStep::Field;
use super::view_projection::{check_camera, resolve_view_projection};
use super::{CameraPath, Outputs, ResolveError, ResolveOptions, Scene, instances};
use model::ModelInstance;
use model::import::{ImportOptions, load};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Every mistake of a scene file that has been parsed, in the order of the file. Errors in the
/// models' own files are not among them: [`check_file`](model::import::check_file) reports those.
/// If a model cannot be loaded, what depends on the models is not validated.
#[must_use]
pub fn validate_scene(
    origin: &Origin,
    file: &SceneFile,
    options: &ResolveOptions,
) -> Vec<SceneError> {
    let (models, mut errors) = load_valid_models(origin, file, options, false);
    errors.extend(options.check_pixels(origin, file).err());
    errors.extend(errors_of_scene(origin, file, models, &options.import.allow_outside));
    in_order(origin, errors)
}

/// All mistakes that keep a scene from being resolved, models that cannot be loaded among them.
pub(super) fn errors_of_resolution(
    origin: &Origin,
    file: &SceneFile,
    options: &ResolveOptions,
) -> Vec<SceneError> {
    let (models, mut errors) = load_valid_models(origin, file, options, true);
    errors.extend(options.check_pixels(origin, file).err());
    errors.extend(errors_of_scene(origin, file, models, &options.import.allow_outside));
    in_order(origin, errors)
}

/// All mistakes that keep a scene from being resolved around models that are loaded.
pub(super) fn errors_around_models(
    origin: &Origin,
    file: &SceneFile,
    models: Vec<ModelInstance>,
    allowed: &[PathBuf],
) -> Vec<SceneError> {
    in_order(origin, errors_of_scene(origin, file, Some(models), allowed))
}

/// The mistakes in the texts of a scene's files, and those that what could be read has besides.
pub(super) fn with_errors_of_description(
    origin: &Origin,
    file: &SceneFile,
    mistakes: Vec<FileMistake>,
    allowed: &[PathBuf],
) -> Vec<SceneError> {
    let mut found = errors_of_description(origin, file, allowed);
    found.extend(errors_of_model_paths(origin, file, allowed));
    // What contains a mistake, or is part of one, may be wrong because of it.
    let is_independent = |error: &SceneError| {
        mistakes.iter().all(|FileMistake { error: mistake, scope }| {
            let (outer, inner) = (&error.span, scope);
            let contains = outer.start <= inner.start && inner.end <= outer.end;
            let is_part = inner.start <= outer.start && outer.end <= inner.end;
            mistake.file != error.file || !(contains || is_part)
        })
    };
    // A background that shows the environment needs one that could be read.
    let environment = origin.error_at(&[Field("environment")], "", None);
    let is_lost = |FileMistake { error, .. }: &FileMistake| {
        error.file == environment.file
            && environment.span.start <= error.span.start
            && error.span.end <= environment.span.end
    };
    let lost_environment = file.environment.is_none() && mistakes.iter().any(is_lost);
    let background = origin.error_at(&[Field("image"), Field("background")], "", None);
    found.retain(|error| {
        is_independent(error) && !(lost_environment && error.span == background.span)
    });
    let errors = mistakes.into_iter().map(|mistake| mistake.error).chain(found);
    in_order(origin, errors.collect())
}

/// The models that can be loaded; `None`, and the mistakes, if not all can. `with_files` says
/// whether errors of the models' own files are among them.
fn load_valid_models(
    origin: &Origin,
    file: &SceneFile,
    options: &ResolveOptions,
    with_files: bool,
) -> (Option<Vec<ModelInstance>>, Vec<SceneError>) {
    if file.models.is_empty() {
        return (None, vec![missing_model_error(origin)]);
    }
    if let Err(error) = instances::check_instance_counts(origin, file) {
        return (None, vec![error]);
    }
    let (mut models, mut errors, mut is_complete) = (Vec::new(), Vec::new(), true);
    for (index, entry) in file.models.iter().enumerate() {
        let instances = match load_model(origin, index, entry, options) {
            Ok(model) => {
                let placed = instances::instantiate_model(origin, index, entry, &Arc::new(model));
                placed.map_err(Into::into)
            }
            Err(ModelError::Scene(errors)) => Err(errors),
            Err(error) => match error.into_resolve_error(origin, index, entry) {
                ResolveError::Scene(scene_errors) if with_files => Err(scene_errors),
                _ => {
                    is_complete = false;
                    continue;
                }
            },
        };
        match instances {
            Ok(instances) => models.extend(instances),
            Err(found) => errors.extend(Vec::from(found)),
        }
    }
    let is_complete = is_complete && errors.is_empty();
    (is_complete.then_some(models), errors)
}

/// The mistakes of a scene besides those of its models; `None` if these are not known.
fn errors_of_scene(
    origin: &Origin,
    file: &SceneFile,
    models: Option<Vec<ModelInstance>>,
    allowed: &[PathBuf],
) -> Vec<SceneError> {
    let mut errors = errors_of_description(origin, file, allowed);
    let Some(models) = models else { return errors };
    #[cfg(feature = "sheets")]
    errors.extend(super::sheet_errors::sheet_error(origin, file, &models, allowed));
    let Ok(image) = resolve_image(origin, file) else { return errors };
    if check_camera(origin, &file.camera).is_empty() {
        let camera = resolve_view_projection(origin, &file.camera, &models, image);
        errors.extend(camera.err());
    }
    errors.extend(resolve_overlays(origin, &file.overlays, &models, image).err());
    if errors.is_empty() {
        let access = FileAccess::Read(allowed);
        let insets = resolve_insets(origin, file, &models, access).map(drop);
        let scene = insets
            .and_then(|()| Scene::resolve_without_insets(origin, file, models, access).map(drop));
        if let Err(ResolveError::Scene(error)) = scene {
            errors.extend(Vec::from(error));
        }
    }
    errors
}

/// The mistakes that can be found without the models.
fn errors_of_description(
    origin: &Origin,
    file: &SceneFile,
    allowed: &[PathBuf],
) -> Vec<SceneError> {
    let mut errors = Vec::new();
    let is_sized = resolve_image_size(origin, file).map_err(|error| errors.push(error)).is_ok();
    errors.extend(resolve_samples(origin, file).err());
    errors.extend(resolve_max_anisotropy(origin, file).err());
    errors.extend(Outputs::from_scene_file(origin, file).err());
    if is_sized {
        errors.extend(resolve_background_color(origin, file).err());
        errors.extend(resolve_backdrop(origin, file, allowed).err());
    }
    for (index, light) in file.lights.iter().flatten().enumerate() {
        errors.extend(check_light(origin, index, light));
    }
    errors.extend(resolve_shadow(origin, file.shadows.as_ref(), &[Field("shadows")]).err());
    errors.extend(resolve_environment(origin, file, &[], allowed, 0.0).err());
    errors.extend(resolve_style(origin, &file.style).err());
    errors.extend(resolve_caption(origin, file.caption.as_ref()).err());
    for (index, section) in file.sections.iter().enumerate() {
        errors.extend(resolve_section(origin, index, section).err());
    }
    errors.extend(check_section_count(origin, &file.sections).err());
    #[cfg(feature = "sheets")]
    errors.extend(super::sheet_errors::sheet_description_error(origin, file, allowed));
    errors.extend(CameraPath::from_scene_file(origin, file).err());
    errors.extend(check_camera(origin, &file.camera));
    for (index, viewport) in file.viewports.iter().enumerate() {
        let inner = origin.for_viewport(index);
        errors.extend(resolve_border(origin, index, viewport).err());
        errors.extend(resolve_caption(&inner, viewport.caption.as_ref()).err());
        errors.extend(viewport.style.as_ref().and_then(|style| resolve_style(&inner, style).err()));
        errors.extend(viewport.camera.iter().flat_map(|camera| check_camera(&inner, camera)));
        if is_sized {
            errors.extend(resolve_viewport_rect(origin, index, viewport, file.view_size()).err());
        }
    }
    errors
}

/// The paths of models that lead nowhere, or out of the scene's folder. The files are not read.
fn errors_of_model_paths(
    origin: &Origin,
    file: &SceneFile,
    allowed: &[PathBuf],
) -> Vec<SceneError> {
    let path_error = |(index, entry): (usize, &super::file::ModelFile)| {
        let error = if origin.allows_path(Path::new(&entry.path), allowed) {
            let path = origin.folder.join(&entry.path);
            let is_missing = origin.models == ModelSource::Disk && !path.exists();
            let missing = is_missing.then(|| load(&path, &ImportOptions::default()).err());
            ModelError::File(missing.flatten()?)
        } else {
            outside_folder_error(origin, index, entry).into()
        };
        match error.into_resolve_error(origin, index, entry) {
            ResolveError::Scene(errors) => Some(errors.first().clone()),
            _ => None,
        }
    };
    file.models.iter().enumerate().filter_map(path_error).collect()
}

/// Errors in the order of the files and of their texts, each once.
fn in_order(origin: &Origin, mut errors: Vec<SceneError>) -> Vec<SceneError> {
    let files: Vec<&str> = origin.included_files().collect();
    let file_order = |error: &SceneError| files.iter().position(|file| *file == error.file);
    errors.sort_by_key(|error| (file_order(error), error.span.start, error.span.end));
    errors.dedup();
    errors
}
