//! Resolution: from a parsed scene file to the scene that is rendered, or to errors that point into
//! the file. Models are loaded, angles are radians, and every default is decided.
//!
//! One pass: each part is resolved by itself, and its mistakes are kept ([`Diagnostics`]), so that
//! one in the camera does not hide one in the lights.

use super::backdrop::{is_blank_paper, resolve_background_color};
use super::caption::resolve_caption;
use super::diagnostics::Diagnostics;
use super::exposure::resolve_exposure;
use super::file_access::FileAccess;
use super::ground::{resolve_ground, shadow_points};
use super::insets::resolve_insets;
use super::lights::{resolve_described_lights, resolve_lights, resolve_scene_shadow, scale_lights};
use super::model_files::load_models;
use super::overlays::resolve_overlays;
use super::resolve_options::ResolveOptions;
use super::section::resolve_sections;
use super::style::resolve_style;
use super::surrounding_light::{effective_environment, has_default_light, has_lights};
use super::uncut::resolve_uncut;
use super::view_projection::{check_camera, resolve_view_of_points, resolve_view_projection};
use super::{CameraPath, ImageSpec, Origin, Outputs, ResolveError, Scene, Style};
use camera::ViewProjection;
use drawing::Overlay;
use homog::{Bounds, Plane, Point, World};
use model::ModelInstance;
use model::world_points;
use raster::Samples;
use scene_file::PathStep::Field;
use scene_file::file::{BackgroundFile, GroundFile, Positive, ViewFile};
use scene_file::{SceneError, SceneFile};
use shade::{Backdrop, Environment, Light, ToneMapper, ToneMapping};
use std::path::PathBuf;
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
    let mut faults = Diagnostics::default();
    let _ = resolve_file(origin, file, options, Extent::Everything, &mut faults);
    faults.into_errors(origin)
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
    let models = load_models(origin, file, options, extent == Extent::Picture, faults);
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
    pub(crate) fn resolve_posed(
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

/// The parts of a scene without its insets, each of which may be wrong.
struct SceneParts {
    image: Option<ImageSpec>,
    caption: Option<Option<String>>,
    style: Option<Style>,
    sections: Option<Vec<Plane<World>>>,
    uncut: Option<Vec<u32>>,
    view_projection: Option<ViewProjection>,
    lights: Option<Vec<Light>>,
    exposure_ev: f64,
    environment: Option<Option<Arc<Environment>>>,
    overlays: Option<Vec<Overlay>>,
    backdrop: Option<Option<Arc<Backdrop>>>,
}

/// The scene without its viewports and stereo pair; `None` if something is wrong with it, or if
/// there are no models. Without models no other files are read.
pub(super) fn resolve_without_insets(
    origin: &Origin,
    file: &SceneFile,
    models: Option<&[ModelInstance]>,
    access: FileAccess<'_>,
    faults: &mut Diagnostics,
) -> Option<Scene> {
    let image = resolve_image(origin, file, faults);
    let caption = faults.take(resolve_caption(origin, file.caption.as_ref()));
    let style = faults.take(resolve_style(origin, file));
    let sections = resolve_sections(origin, &file.sections, faults);
    let shadow = faults.take(resolve_scene_shadow(origin, file));
    let described = resolve_described_lights(origin, file, shadow.flatten(), faults);
    let camera_errors = check_camera(origin, &file.camera);
    let is_placed = camera_errors.is_empty();
    camera_errors.into_iter().for_each(|error| faults.report(error));

    let models = models?;
    let uncut = faults.take(resolve_uncut(origin, &file.sections, models));
    let points = || {
        let (planes, uncut) = (sections.as_deref(), uncut.as_deref());
        let style = style.unwrap_or(Style::Shaded);
        framed_points(models, style, planes.unwrap_or_default(), uncut.unwrap_or_default())
    };
    let view_projection = image.filter(|_| is_placed).and_then(|image| {
        let (camera, points) = (&file.camera, points());
        faults.take(resolve_view_of_points(origin, camera, models, points, image, Vec::new()))
    });
    let lights = described.zip(view_projection).and_then(|(described, view)| {
        let lights = resolve_lights(origin, file, &described, models, &view, shadow.flatten());
        faults.take(lights)
    });
    let lit = lights.as_deref();
    let exposure_ev = lit.map_or(0.0, |lights| resolve_exposure(origin, file, models, lights));
    let environment = faults.take(access.environment(origin, file, models, exposure_ev));
    let overlays = image
        .and_then(|image| faults.take(resolve_overlays(origin, &file.overlays, models, image)));
    let backdrop = image.and_then(|_| faults.take(access.backdrop(origin, file)));
    let parts = SceneParts {
        image,
        caption,
        style,
        sections,
        uncut,
        view_projection,
        lights,
        exposure_ev,
        environment,
        overlays,
        backdrop,
    };
    parts.assemble(origin, file, models, faults)
}

impl SceneParts {
    /// The scene, if all parts are there: the ground below it, and the view once more if that shows
    /// shadows on the ground.
    fn assemble(
        self,
        origin: &Origin,
        file: &SceneFile,
        models: &[ModelInstance],
        faults: &mut Diagnostics,
    ) -> Option<Scene> {
        let (image, style) = (self.image?, self.style?);
        let (mut view_projection, mut lights) = (self.view_projection?, self.lights?);
        let has_environment = effective_environment(origin, file, models).is_some();
        let ground = resolve_ground(file, models, &lights, has_environment);
        let frames_shadows = matches!(file.ground, Some(GroundFile::Shadow { framed: true, .. }));
        let is_framed = frames_shadows && matches!(file.camera.view, ViewFile::Frame { .. });
        if let Some(ground) = ground.filter(|_| is_framed && style.draws_surfaces()) {
            // The key light stands by the direction of view, which framing keeps.
            let shadows = shadow_points(ground, models, &lights);
            let points = world_points(models);
            let view = resolve_view_of_points(origin, &file.camera, models, points, image, shadows);
            view_projection = faults.take(view)?;
        }
        let occlusion_radius = file.ambient_occlusion.map(|file| {
            let usual = || {
                Bounds::from_points(world_points(models)).map_or(1.0, |all| all.diagonal() / 12.0)
            };
            file.radius.map_or_else(usual, Positive::value)
        });
        // The studio is calibrated to stay below 1. Lights of a model are of any brightness.
        let has_model_lights = has_default_light(origin, file) && has_lights(models);
        let curve = if has_model_lights { ToneMapping::Neutral } else { ToneMapping::None };
        let curve = file.image.tone_mapping.unwrap_or(curve);
        // After the exposure, which would compensate for it.
        scale_lights(&mut lights, file.light_intensity);
        Some(Scene {
            models: models.to_vec(),
            view_projection,
            lights,
            ground,
            environment: self.environment?,
            occlusion_radius,
            tone_mapper: ToneMapper::new(self.exposure_ev, curve),
            style,
            image,
            insets: Vec::new(),
            backdrop: self.backdrop?,
            overlays: self.overlays?,
            caption: self.caption?,
            sections: self.sections?,
            uncut: self.uncut?,
            unlimited_lines: false,
        })
    }
}

/// The points that a view frames: in line drawings those of what section planes leave.
fn framed_points(
    models: &[ModelInstance],
    style: Style,
    sections: &[Plane<World>],
    uncut: &[u32],
) -> Vec<Point<World>> {
    if sections.is_empty() || style.draws_surfaces() {
        return world_points(models);
    }
    drawing::retained_points(models, sections, uncut)
}

/// The image that a scene renders.
fn resolve_image(origin: &Origin, file: &SceneFile, faults: &mut Diagnostics) -> Option<ImageSpec> {
    let size = faults.take(resolve_image_size(origin, file));
    let samples = faults.take(resolve_samples(origin, file));
    let max_anisotropy = faults.take(resolve_max_anisotropy(origin, file));
    let background = size.and_then(|_| faults.take(resolve_background_color(origin, file)));
    let environment_blur = match &file.image.background {
        Some(BackgroundFile::Environment { blur }) => {
            Some(blur.map_or(0.0, |blur| blur.value().min(1.0) as f32))
        }
        _ => None,
    };
    let (width, height) = size?;
    Some(ImageSpec {
        width,
        height,
        caption_height: file.caption_height(),
        background: background?,
        is_blank_paper: is_blank_paper(file),
        environment_blur,
        samples: samples?,
        max_anisotropy: max_anisotropy?,
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
fn resolve_samples(origin: &Origin, file: &SceneFile) -> Result<Samples, SceneError> {
    Samples::from_count(file.image.samples).ok_or_else(|| {
        let message = format!("a pixel cannot have {} samples", file.image.samples);
        let help = Some("possible are 1, 4, 8 and 16".to_owned());
        origin.error_at(&[Field("image"), Field("samples")], message, help)
    })
}

/// The most samples of anisotropic texture filtering.
fn resolve_max_anisotropy(origin: &Origin, file: &SceneFile) -> Result<u32, SceneError> {
    let max_anisotropy = file.image.max_anisotropy;
    if (1..=8).contains(&max_anisotropy) {
        return Ok(max_anisotropy);
    }
    let message = format!("anisotropic filtering cannot take {max_anisotropy} samples");
    let help = Some("from 1 to 8 are possible".to_owned());
    Err(origin.error_at(&[Field("image"), Field("max_anisotropy")], message, help))
}
