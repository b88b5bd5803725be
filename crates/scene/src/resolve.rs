//! Resolution: from a parsed scene file to the scene that is rendered, or to errors that point into
//! the file. Models are loaded, angles are radians, and every default is decided.
//!
//! One pass: each part is resolved by itself, and its mistakes are kept ([`Diagnostics`]), so that
//! one in the camera does not hide one in the lights.

use super::diagnostics::Diagnostics;
use super::file_access::FileAccess;
use super::insets::resolve_insets;
use super::model_files::load_models;
use super::resolve_options::ResolveOptions;
use super::single_view::{resolve_image, resolve_image_size, resolve_without_insets};
use super::view_projection::resolve_view_projection;
use super::{CameraPath, Origin, Outputs, ResolveError, Scene};
use camera::ViewProjection;
use model::ModelInstance;
use scene_file::{SceneError, SceneFile};
use std::path::PathBuf;

/// The scene of a file that has been parsed, unless it cannot be resolved, and every mistake in the
/// file, in its order: in sheets, passes and the path of the camera too. Models are loaded once.
///
/// A model that cannot be loaded is a mistake, and what depends on the models is then not validated;
/// the crate `gltf-check` reports whatever else is wrong with a model's file.
#[must_use]
pub fn validate_scene(
    origin: &Origin,
    file: &SceneFile,
    options: &ResolveOptions,
) -> (Option<Scene>, Vec<SceneError>) {
    let mut faults = Diagnostics::default();
    let scene = resolve_file(origin, file, options, Extent::Everything, &mut faults);
    (scene, faults.into_errors(origin))
}

/// What of a scene is resolved.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Extent {
    /// What a picture needs. Where something is wrong with that, mistakes of the rest are told too.
    Picture,
    /// Whatever the file says: sheets, passes and the path of the camera too.
    Everything,
}

/// The scene of a file with its models.
fn resolve_file(
    origin: &Origin,
    file: &SceneFile,
    options: &ResolveOptions,
    extent: Extent,
    faults: &mut Diagnostics,
) -> Option<Scene> {
    let _ = faults.take(options.check_pixels(origin, file));
    let models = load_models(origin, file, options, faults);
    let allowed = &options.import.allow_outside;
    let frame =
        || resolve_parts(origin, file, models.as_deref(), FileAccess::Read(allowed), faults);
    let scene = options.import.timings.measure("frame", frame);
    if extent == Extent::Everything || !faults.is_empty() {
        check_outputs(origin, file, models.as_deref(), allowed, faults);
    }
    scene
}

/// The mistakes that can be found without the models.
pub(super) fn check_description(
    origin: &Origin,
    file: &SceneFile,
    allowed: &[PathBuf],
    faults: &mut Diagnostics,
) {
    let _ = resolve_parts(origin, file, None, FileAccess::Read(allowed), faults);
    check_outputs(origin, file, None, allowed, faults);
}

/// The mistakes in what a picture of the scene does not need.
#[cfg_attr(not(feature = "sheets"), expect(unused_variables, reason = "for sheets"))]
fn check_outputs(
    origin: &Origin,
    file: &SceneFile,
    models: Option<&[ModelInstance]>,
    allowed: &[PathBuf],
    faults: &mut Diagnostics,
) {
    let _ = faults.take(Outputs::from_scene_file(origin, file));
    let _ = faults.take(CameraPath::from_scene_file(origin, file));
    #[cfg(feature = "sheets")]
    super::sheet_errors::check_sheet(origin, file, models, allowed, faults);
}

/// The scene with its insets; `None` if something is wrong with it, or if there are no models.
fn resolve_parts(
    origin: &Origin,
    file: &SceneFile,
    models: Option<&[ModelInstance]>,
    access: FileAccess<'_>,
    faults: &mut Diagnostics,
) -> Option<Scene> {
    let scene = resolve_without_insets(origin, file, models, access, faults);
    if models.is_none() {
        // How bright the default is depends on the models, but not whether its file can be read.
        let _ = faults.take(access.environment(origin, file, &[], 0.0));
        if resolve_image_size(origin, file).is_ok() {
            let _ = faults.take(access.backdrop(origin, file));
        }
    }
    let models = scene.as_ref().map(|scene| &*scene.models);
    let insets = resolve_insets(origin, file, models, access, faults);
    Some(Scene { insets: insets?, ..scene? })
}

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
        let mut faults = Diagnostics::default();
        let scene = resolve_file(origin, file, options, Extent::Picture, &mut faults);
        let mut scene = faults.finish(origin, scene)?;
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
    /// If something makes no sense; the errors point at their places in the file.
    pub fn from_models(
        origin: &Origin,
        file: &SceneFile,
        models: &[ModelInstance],
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
        models: &[ModelInstance],
        allowed: &[PathBuf],
    ) -> Result<Self, ResolveError> {
        Self::resolve_posed(origin, file, models, FileAccess::Read(allowed))
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
        let mut faults = Diagnostics::default();
        let image = resolve_image(origin, file, &mut faults);
        let view = image.and_then(|image| {
            faults.take(resolve_view_projection(origin, &file.camera, models, image))
        });
        faults.finish(origin, view)
    }

    /// The scene around its models in their pose; files come from where `access` says.
    ///
    /// # Errors
    /// As [`from_models`](Self::from_models).
    pub fn resolve_posed(
        origin: &Origin,
        file: &SceneFile,
        models: &[ModelInstance],
        access: FileAccess<'_>,
    ) -> Result<Self, ResolveError> {
        let mut faults = Diagnostics::default();
        let scene = resolve_parts(origin, file, Some(models), access, &mut faults);
        faults.finish(origin, scene)
    }
}
