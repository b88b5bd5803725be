//! All mistakes of a scene file, and not only the first.

use super::backdrop;
use super::error::SceneError;
use super::file::SceneFile;
use super::insets::resolve_insets;
use super::lights::resolve_light;
use super::origin::Origin;
use super::resolve::{ModelError, load_model, resolve_image, resolve_overlays};
use super::section::resolve_sections;
use super::shadows::resolve_shadow;
use super::source_span::PathStep;
use super::style::resolve_style;
use super::surrounding_light::resolve_environment;
use super::view_projection::resolve_view_projection;
use super::{CameraPath, ResolveError, ResolveOptions, instances};
use model::ModelInstance;
use std::sync::Arc;

/// Everything that makes no sense in a scene file that has been parsed. Faults of the models' own files are not among
/// it: [`check`](model::import::check) tells those. With a model that cannot be loaded the camera is not looked at, for it may
/// depend on it.
#[must_use]
pub fn validate_scene(
    origin: &Origin,
    file: &SceneFile,
    options: &ResolveOptions,
) -> Vec<SceneError> {
    let mut mistakes = Vec::new();
    let mut models: Vec<Vec<ModelInstance>> = Vec::new();
    let counts = instances::check_instance_counts(origin, file);
    let entries = if counts.is_ok() { &file.models[..] } else { &[] };
    mistakes.extend(counts.err());
    for (number, entry) in entries.iter().enumerate() {
        match load_model(origin, number, entry, options) {
            Ok(model) => {
                match instances::instantiate_model(origin, number, entry, &Arc::new(model)) {
                    Ok(placed) => models.push(placed),
                    Err(mistake) => mistakes.push(mistake),
                }
            }
            Err(ModelError::Scene(mistake)) => mistakes.push(mistake),
            Err(ModelError::File(_)) => {}
        }
    }
    if file.models.is_empty() {
        mistakes.push(super::resolve::missing_model_error(origin));
    }
    let is_whole = models.len() == file.models.len();
    let models = models.concat();
    let image = resolve_image(origin, file);
    match &image {
        Err(mistake) => mistakes.push(mistake.clone()),
        &Ok(image) if !models.is_empty() && is_whole => {
            mistakes.extend(resolve_view_projection(origin, &file.camera, &models, image).err());
            mistakes.extend(resolve_overlays(origin, &file.overlays, &models, image).err());
        }
        Ok(_) => {}
    }
    let lights = file.lights.iter().flatten().enumerate();
    mistakes.extend(lights.filter_map(|(at, light)| resolve_light(origin, at, light, None).err()));
    let shadows = resolve_shadow(origin, file.shadows.as_ref(), &[PathStep::Field("shadows")]);
    mistakes.extend(shadows.err());
    mistakes
        .extend(resolve_environment(origin, file, &models, &options.import.allow_outside).err());
    if image.is_ok() {
        let painting = backdrop::resolve_backdrop(origin, file, &options.import.allow_outside);
        mistakes.extend(painting.err());
    }
    mistakes.extend(resolve_style(origin, &file.style).err());
    mistakes.extend(resolve_sections(origin, &file.sections).err());
    let sheet = file.sheet.iter();
    mistakes.extend(sheet.filter_map(|sheet| super::resolve_sheet(origin, sheet).err()));
    mistakes.extend(CameraPath::from_scene_file(origin, file).err());
    if mistakes.is_empty() && is_whole && !models.is_empty() {
        let views = resolve_insets(origin, file, &models, &options.import.allow_outside);
        mistakes.extend(views.err().and_then(|error| match error {
            ResolveError::Scene(mistake) => Some(mistake),
            _ => None,
        }));
    }
    mistakes.sort_by_key(|mistake| mistake.span.start);
    mistakes
}
