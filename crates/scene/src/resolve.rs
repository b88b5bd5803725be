//! Resolution: from a parsed scene file to a scene that can be rendered, or to errors that point
//! into the file. Models are loaded, angles become radians, and every default is filled in.
//!
//! Resolution is a single pass. Each part is resolved separately and its mistakes are collected
//! ([`Diagnostics`]), so that a mistake in the camera does not hide one in the lights.

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

/// Returns the scene in a parsed file, unless it cannot be resolved, and every mistake in the file,
/// in order. Sheets, passes and the camera path are also validated. Models are loaded once.
///
/// A model that cannot be loaded is a mistake, and the parts that depend on the models are then not
/// validated. The crate `gltf-check` reports all other mistakes in a model's file.
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

/// The extent of resolution.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Extent {
    /// The parts for a picture. If they have mistakes, mistakes in the rest are reported too.
    Picture,
    /// Everything in the file, including sheets, passes and the camera path.
    Everything,
}

/// Resolves a scene file together with its models.
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

/// Collects the mistakes that can be found without the models.
pub(super) fn check_description(
    origin: &Origin,
    file: &SceneFile,
    allowed: &[PathBuf],
    faults: &mut Diagnostics,
) {
    let _ = resolve_parts(origin, file, None, FileAccess::Read(allowed), faults);
    check_outputs(origin, file, None, allowed, faults);
}

/// Collects the mistakes in the parts that a picture of the scene does not need.
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

/// Returns the scene with its insets, or `None` if it has mistakes or there are no models.
fn resolve_parts(
    origin: &Origin,
    file: &SceneFile,
    models: Option<&[ModelInstance]>,
    access: FileAccess<'_>,
    faults: &mut Diagnostics,
) -> Option<Scene> {
    let scene = resolve_without_insets(origin, file, models, access, faults);
    if models.is_none() {
        // Models affect the default environment's brightness, but not whether a file can be read.
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
    /// Loads a scene's models and fills in everything that the file leaves open.
    ///
    /// # Errors
    /// Returns an error if a model cannot be loaded, or every mistake in the scene that can be
    /// found, in file order.
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

    /// Fills in everything that the file leaves open, for models that are loaded, posed and placed;
    /// the file's own models are ignored.
    ///
    /// # Errors
    /// Returns every invalid value, as an error that points at its position in the file.
    pub fn from_models(
        origin: &Origin,
        file: &SceneFile,
        models: &[ModelInstance],
    ) -> Result<Self, ResolveError> {
        Self::from_models_allowing(origin, file, models, &[])
    }

    /// Like [`from_models`](Self::from_models), but images and environments may also be in the
    /// `allowed` folders.
    ///
    /// # Errors
    /// Returns the same errors as [`from_models`](Self::from_models).
    pub fn from_models_allowing(
        origin: &Origin,
        file: &SceneFile,
        models: &[ModelInstance],
        allowed: &[PathBuf],
    ) -> Result<Self, ResolveError> {
        Self::resolve_posed(origin, file, models, FileAccess::Read(allowed))
    }

    /// Resolves only the camera, around models that are loaded, posed and placed, or without any
    /// models.
    ///
    /// # Errors
    /// Returns an error if the size or the camera is invalid, or if the camera should frame the
    /// models but there are none.
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

    /// Returns the scene with its models in their pose; `access` provides the files.
    ///
    /// # Errors
    /// Returns the same errors as [`from_models`](Self::from_models).
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
