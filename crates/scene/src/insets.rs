//! Resolves viewports and stereo pairs to insets, which are scenes within the scene.
//!
//! ```text
//!   ┌───────────────┬───────┐   An inset is a separate scene with the models in the
//!   │               │ inset │   main view, but its own camera, style, background,
//!   │  the scene    ├───────┘   and an image of the rectangle's size.
//!   └───────────────┘
//! ```

use super::diagnostics::Diagnostics;
use super::file_access::FileAccess;
use super::shared_scale::share_scale_of_viewports;
use super::single_view::{resolve_image_size, resolve_without_insets};
use super::{Origin, ResolveError, Scene};
use camera::ViewProjection;
use glam::{DMat4, DVec4};
use homog::PixelRect;
use homog::{Bounds, Point, Projective};
use model::ModelInstance;
use model::world_points;
use page::Ink;
use scene_file::PathStep::{Field, Index};
use scene_file::SceneError;
use scene_file::file::{ImageFile, Positive, SceneFile, StereoFile, ViewportFile, ViewportsScale};

/// The maximum number of viewports in a scene.
const MAX_VIEWPORTS: usize = 256;
/// The maximum border width in pixels.
const MAX_BORDER_WIDTH: u32 = 1000;
/// The default distance of the convergence plane in eye distances: the 1/30 rule of stereography.
const CONVERGENCE_PER_EYE_DISTANCE: f64 = 30.0;

/// A rectangle of a picture that shows a separate view.
#[derive(Clone, Debug)]
pub struct Inset {
    /// The pixels it covers in the picture, with y down.
    pub rect: PixelRect,
    /// A border inside the rectangle: color, and width in pixels.
    pub border: Option<(Ink, u32)>,
    /// Whether only green and blue are written, over the red of the view below, for the right eye
    /// of an anaglyph.
    pub cyan_only: bool,
    /// The scene that the inset shows; its image has the rectangle's size.
    pub scene: Scene,
}

/// Resolves the insets of a scene file: its viewports in order, or the two views of a stereo pair.
///
/// Models are shared with the main view, not loaded again. Without models, or if a rectangle is
/// outside the picture, only viewport mistakes that do not depend on models are reported. Returns
/// `None` if there are mistakes; the errors point into the viewports.
pub(super) fn resolve_insets(
    origin: &Origin,
    file: &SceneFile,
    models: Option<&[ModelInstance]>,
    access: FileAccess<'_>,
    faults: &mut Diagnostics,
) -> Option<Vec<Inset>> {
    if let Some(stereo) = file.stereo {
        return faults.take(resolve_stereo(origin, file, stereo, models?, access));
    }
    if file.viewports.len() > MAX_VIEWPORTS {
        let message = format!(
            "too many viewports: {}; at most {MAX_VIEWPORTS} are allowed",
            file.viewports.len()
        );
        faults.report(origin.error_at(&[Field("viewports")], message, None));
        return None;
    }
    // Rectangles can be checked only against a valid picture size. An invalid size is reported with
    // the picture.
    let is_sized = resolve_image_size(origin, file).is_ok();
    let view = |(at, viewport): (usize, &ViewportFile)| {
        let area = || faults.take(resolve_viewport_rect(origin, at, viewport, file.view_size()));
        let area = is_sized.then(area).flatten();
        let border = faults.take(resolve_border(origin, at, viewport));
        let size = area.map_or(file.image.size, |area| (area.width, area.height));
        let inner = scene_in_viewport(file, viewport, size);
        // Without a rectangle, there is no aspect ratio for framing the models.
        let models = models.filter(|_| area.is_some());
        let (origin, access) = (origin.for_viewport(at), access.for_inset(at));
        let scene = resolve_without_insets(&origin, &inner, models, access, faults);
        Some(Inset { rect: area?, border: border?, cyan_only: false, scene: scene? })
    };
    // All viewports are resolved before the first failure ends the function, to report every
    // mistake.
    let insets: Vec<Option<Inset>> = file.viewports.iter().enumerate().map(view).collect();
    let mut insets = insets.into_iter().collect::<Option<Vec<Inset>>>()?;
    faults.take(share_scale_of_viewports(origin, file, &mut insets))?;
    Some(insets)
}

/// Returns the scene file as it applies within a viewport of this size: the viewport's fields
/// replace the scene's.
fn scene_in_viewport(file: &SceneFile, viewport: &ViewportFile, size: (u32, u32)) -> SceneFile {
    let background = viewport.background.as_ref().or(file.image.background.as_ref()).cloned();
    SceneFile {
        camera: viewport.camera.as_ref().unwrap_or(&file.camera).clone(),
        style: viewport.style.as_ref().unwrap_or(&file.style).clone(),
        overlays: viewport.overlays.as_ref().unwrap_or(&file.overlays).clone(),
        // The scene's caption is for the whole picture.
        caption: viewport.caption.clone(),
        image: ImageFile { size, background, ..file.image.clone() },
        models: Vec::new(),
        viewports: Vec::new(),
        viewports_scale: ViewportsScale::Individual,
        ..file.clone()
    }
}

/// Returns the pixel rectangle of a viewport, from fractions of the picture or from pixels.
///
/// Fractions are rounded edge by edge rather than as a size, so that adjacent viewports neither
/// overlap nor leave a gap.
///
/// # Errors
/// Returns an error if both forms or neither are set, or if the rectangle is empty or extends
/// beyond the picture.
fn resolve_viewport_rect(
    origin: &Origin,
    number: usize,
    viewport: &ViewportFile,
    size: (u32, u32),
) -> Result<PixelRect, SceneError> {
    let (width, height) = size;
    let place = |field: &'static str| [Field("viewports"), Index(number), Field(field)];
    let (region, field) = match (viewport.at, viewport.pixels) {
        (Some((x, y, w, h)), None) => {
            let [x, y, w, h] = [x, y, w, h].map(scene_file::file::Fraction::value);
            // Round edge by edge, so that neighbors meet.
            let run = |from: f64, length: f64, side: u32| {
                let end = libm::round((from + length) * f64::from(side));
                let start = libm::round(from * f64::from(side));
                (start as u32, (end - start) as u32)
            };
            let ((x, w), (y, h)) = (run(x, w, width), run(y, h, height));
            (PixelRect { x, y, width: w, height: h }, "at")
        }
        (None, Some((x, y, w, h))) => (PixelRect { x, y, width: w, height: h }, "pixels"),
        (at, _) => {
            let message = match at {
                None => "the viewport has no position",
                Some(_) => "`at` and `pixels` both set the position of the viewport",
            };
            let help = "write at: (0.7, 0, 0.3, 0.3): left, top, width and height";
            let at = [Field("viewports"), Index(number)];
            return Err(origin.error_at(&at, message, Some(help.to_owned())));
        }
    };
    // The numbers come from the file, so their sum may overflow.
    let fits = |from: u32, length: u32, side: u32| {
        length > 0 && from.checked_add(length).is_some_and(|end| end <= side)
    };
    if fits(region.x, region.width, width) && fits(region.y, region.height, height) {
        return Ok(region);
    }
    let PixelRect { x, y, width: across, height: down } = region;
    let message = format!(
        "the viewport of {across} x {down} pixels at ({x}, {y}) is empty or not inside the picture of {width} x {height}"
    );
    let help = if field == "at" {
        "specify left, top, width and height; left + width and top + height must be at most 1"
    } else {
        "pixels fit only one picture size; fractions work for every size, even with --size: at: (0.5, 0, 0.5, 0.5) is the upper right quarter"
    };
    Err(origin.error_at(&place(field), message, Some(help.to_owned())))
}

/// Returns the color of a viewport's border, and its width of 1 to 1000 pixels.
fn resolve_border(
    origin: &Origin,
    number: usize,
    viewport: &ViewportFile,
) -> Result<Option<(Ink, u32)>, SceneError> {
    let Some(border) = &viewport.border else { return Ok(None) };
    let place = |field| [Field("viewports"), Index(number), Field("border"), Field(field)];
    if !(1..=MAX_BORDER_WIDTH).contains(&border.width) {
        let message = format!("invalid border width: {} pixels", border.width);
        let help = Some(format!("use 1 to {MAX_BORDER_WIDTH}"));
        return Err(origin.error_at(&place("width"), message, help));
    }
    Ok(Some((border.color.0, border.width)))
}

/// Returns the two insets of a stereo pair. Their off-axis projections cause no vertical parallax,
/// unlike toed-in cameras.
///
/// ```text
///  side by side   left half, right half       the halves of an odd width share a column
///  anaglyph       left eye in red, right eye in green and blue over it
/// ```
/// Each eye is half the eye distance from the camera. Points on the convergence plane have the same
/// position in both images and appear at the depth of the screen.
///
/// # Errors
/// Returns an error if there are viewports, the picture is one pixel wide, the projection is
/// parallel, or the models are behind the camera.
fn resolve_stereo(
    origin: &Origin,
    file: &SceneFile,
    stereo: StereoFile,
    models: &[ModelInstance],
    access: FileAccess<'_>,
) -> Result<Vec<Inset>, ResolveError> {
    let fault = |message: &str, help: &str| {
        origin.error_at(&[Field("stereo")], message, Some(help.to_owned()))
    };
    if !file.viewports.is_empty() {
        let help = "remove one of them";
        return Err(fault("a scene cannot have both viewports and stereo", help).into());
    }
    let (width, height) = file.view_size();
    let (beside, apart, convergence) = match stereo {
        StereoFile::SideBySide { eye_distance, convergence } => (true, eye_distance, convergence),
        StereoFile::Anaglyph { eye_distance, convergence } => (false, eye_distance, convergence),
    };
    if beside && width < 2 {
        return Err(fault("the picture is too narrow for two views", "make it wider").into());
    }
    // With an odd number of columns, both halves share the middle column, which shows the right
    // eye's picture.
    let half = if beside { width.div_ceil(2) } else { width };
    let half = PixelRect { x: 0, y: 0, width: half, height };
    let areas = [half, PixelRect { x: if beside { width - half.width } else { 0 }, ..half }];
    let inner = scene_in_viewport(file, &ViewportFile::default(), (half.width, height));
    let inner = SceneFile { stereo: None, ..inner };
    // Both eyes derive from this scene, so its mistakes are reported once.
    let mut faults = Diagnostics::default();
    let middle = resolve_without_insets(origin, &inner, Some(models), access, &mut faults);
    let middle = faults.finish(origin, middle)?;
    // In a parallel projection the viewer is at infinity: w = 0.
    if middle.view_projection.viewer().raw().w == 0.0 {
        let help = "choose a projection such as Perspective(), or remove `stereo`";
        return Err(fault("both eyes see the same picture in a parallel projection", help).into());
    }
    let plane = convergence.map_or_else(
        || models_center_depth(middle.view_projection, models),
        |all| Some(all.value()),
    );
    let Some(plane) = plane else {
        let help = "set the distance at which the eyes converge, such as convergence: 2";
        return Err(fault("the center of the models is behind the camera", help).into());
    };
    let apart = apart.map_or(plane / CONVERGENCE_PER_EYE_DISTANCE, Positive::value);
    let view = |(area, side): (PixelRect, f64)| {
        let view_projection = shift_eye(middle.view_projection, side * apart, plane)
            .ok_or_else(|| fault("the eyes are too far apart", "choose a smaller eye_distance"))?;
        let scene = Scene { view_projection, ..middle.clone() };
        Ok(Inset { rect: area, border: None, cyan_only: !beside && side > 0.0, scene })
    };
    areas.into_iter().zip([-0.5, 0.5]).map(view).collect()
}

/// Returns the depth of the models' center along the gaze, in world units, or `None` if it is not
/// in front of the camera.
fn models_center_depth(view_projection: ViewProjection, models: &[ModelInstance]) -> Option<f64> {
    let corners = Bounds::from_points(world_points(models))?.corners();
    let middle = (corners[0].raw() + corners[7].raw()) * 0.5;
    let depth =
        -view_projection.camera.world_to_view().transform_point(Point::from_raw(middle)).z();
    (depth > 0.0).then_some(depth)
}

/// Returns the view of an eye moved to the right by `aside`, sheared so that its window matches the
/// camera's at distance `plane`.
///
/// x' = x − aside · z / plane in view space: the shear moves a point at depth D = −z to the right
/// by aside · D / plane, and moving the eye shifts the point by −aside. The two cancel at D =
/// plane, the plane of zero parallax.
fn shift_eye(view_projection: ViewProjection, aside: f64, plane: f64) -> Option<ViewProjection> {
    let camera = view_projection.camera.moved(view_projection.camera.u() * aside).ok()?;
    let slant =
        DMat4::from_cols(DVec4::X, DVec4::Y, DVec4::new(-aside / plane, 0.0, 1.0, 0.0), DVec4::W);
    let view_to_clip = Projective::from_raw(view_projection.view_to_clip.raw() * slant);
    Some(ViewProjection { camera, view_to_clip })
}

#[cfg(test)]
mod tests {
    use super::*;
    use camera::{Camera, StereoRig, ViewWindow};
    use homog::Vector;
    use projection::{Convention, Frustum};

    #[test]
    fn stereo_eyes_match_the_rig() {
        let camera =
            Camera::look_at(Point::new(4.0, 3.0, 6.0), Point::new(0.0, 1.0, 0.0), Vector::Y)
                .expect("a camera");
        let window = ViewWindow { left: -0.8, right: 1.0, bottom: -0.5, top: 0.5, distance: 1.0 };
        let of = |window: ViewWindow| {
            let ViewWindow { left, right, bottom, top, distance } = window;
            let frustum =
                Frustum::new(left, right, bottom, top, distance, 50.0).expect("a frustum");
            frustum.view_to_clip(Convention::CHAPTER)
        };
        let view_projection = ViewProjection { camera, view_to_clip: of(window) };
        let pair = StereoRig { interocular: 0.4, zero_parallax: 7.0 }.off_axis_pair(camera, window);
        let pair = pair.expect("a pair");
        for (aside, expected) in [(-0.2, pair.left), (0.2, pair.right)] {
            let eye = shift_eye(view_projection, aside, 7.0).expect("an eye");
            assert!((eye.camera.eye() - expected.camera.eye()).length() < 1e-12);
            let wanted = of(expected.window).raw();
            assert!(
                eye.view_to_clip.raw().abs_diff_eq(wanted, 1e-12),
                "{:?} {wanted:?}",
                eye.view_to_clip.raw()
            );
        }
    }
}
