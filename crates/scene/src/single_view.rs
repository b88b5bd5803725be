//! Resolution of one view of a scene, without its insets: image, camera, lights, and everything
//! behind the models.

use super::backdrop::{is_blank_paper, resolve_background_color};
use super::caption::resolve_caption;
use super::diagnostics::Diagnostics;
use super::exposure::resolve_exposure;
use super::file_access::FileAccess;
use super::ground::{resolve_ground, shadow_points};
use super::lights::{resolve_described_lights, resolve_lights, resolve_scene_shadow, scale_lights};
use super::overlays::resolve_overlays;
use super::section::resolve_sections;
use super::style::resolve_style;
use super::surrounding_light::{effective_environment, has_default_light, has_lights};
use super::uncut::resolve_uncut;
use super::view_projection::{check_camera, resolve_view_of_points};
use super::{ImageSpec, MAX_IMAGE_SIDE, Origin, Scene, Style};
use camera::ViewProjection;
use drawing::Overlay;
use homog::{Bounds, Plane, Point, World};
use model::{ModelInstance, world_points};
use raster::Samples;
use scene_file::PathStep::Field;
use scene_file::file::{BackgroundFile, GroundFile, Positive, ViewFile};
use scene_file::{SceneError, SceneFile};
use shade::{Backdrop, Environment, Light, ToneMapper, ToneMapping};
use std::sync::Arc;

/// The parts of a scene without its insets; a part with a mistake is `None`.
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

/// Returns the scene without its viewports and stereo pair, or `None` if it has mistakes or no
/// models. Without models, no other files are read.
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

    // Nothing above needs the models, so it is checked even if they cannot be loaded.
    let models = models?;
    let uncut = faults.take(resolve_uncut(origin, &file.sections, models));
    let points = || {
        let (planes, uncut) = (sections.as_deref(), uncut.as_deref());
        // With an invalid style the models are framed anyway, to find mistakes in the camera.
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
    // The parts are required only now, so that a mistake in one does not hide mistakes in others.
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
    /// Assembles the scene if all parts are present: adds the ground, and resolves a framed view
    /// again so that it includes shadows on the ground.
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
            // The key light follows the view direction, which framing preserves.
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
        // The studio keeps colors below 1, by calibration. A model's lights may have any
        // brightness.
        let has_model_lights = has_default_light(origin, file) && has_lights(models);
        let curve = if has_model_lights { ToneMapping::Neutral } else { ToneMapping::None };
        let curve = file.image.tone_mapping.unwrap_or(curve);
        // Applied after automatic exposure, which would otherwise cancel the intensity.
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

/// Returns the points that a view frames; in line drawings, the points that remain after section
/// cuts.
fn framed_points(
    models: &[ModelInstance],
    style: Style,
    sections: &[Plane<World>],
    uncut: &[u32],
) -> Vec<Point<World>> {
    if sections.is_empty() || style.draws_surfaces() {
        return world_points(models);
    }
    hidden_line::retained_points(models, sections, uncut)
}

/// Resolves the picture to render.
pub(super) fn resolve_image(
    origin: &Origin,
    file: &SceneFile,
    faults: &mut Diagnostics,
) -> Option<ImageSpec> {
    let size = faults.take(resolve_image_size(origin, file));
    let samples = faults.take(resolve_samples(origin, file));
    let max_anisotropy = faults.take(resolve_max_anisotropy(origin, file));
    // A gradient needs a valid picture size.
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

/// Returns the width and height of the image.
pub(super) fn resolve_image_size(
    origin: &Origin,
    file: &SceneFile,
) -> Result<(u32, u32), SceneError> {
    let (width, height) = file.image.size;
    let fits = |side: u32| (1..=MAX_IMAGE_SIDE).contains(&side);
    if fits(width) && fits(height) {
        return Ok((width, height));
    }
    let message = format!("invalid picture size: {width} x {height} pixels");
    let help = format!("each side must be from 1 to {MAX_IMAGE_SIDE} pixels");
    Err(origin.error_at(&[Field("image"), Field("size")], message, Some(help)))
}

/// Returns the number of coverage samples.
fn resolve_samples(origin: &Origin, file: &SceneFile) -> Result<Samples, SceneError> {
    Samples::from_count(file.image.samples).ok_or_else(|| {
        let message = format!("invalid number of samples per pixel: {}", file.image.samples);
        let help = Some("write 1, 4, 8 or 16".to_owned());
        origin.error_at(&[Field("image"), Field("samples")], message, help)
    })
}

/// Returns the maximum number of samples for anisotropic texture filtering.
fn resolve_max_anisotropy(origin: &Origin, file: &SceneFile) -> Result<u32, SceneError> {
    let max_anisotropy = file.image.max_anisotropy;
    if (1..=8).contains(&max_anisotropy) {
        return Ok(max_anisotropy);
    }
    let message = format!("invalid number of samples for anisotropic filtering: {max_anisotropy}");
    let help = Some("use 1 to 8".to_owned());
    Err(origin.error_at(&[Field("image"), Field("max_anisotropy")], message, help))
}
