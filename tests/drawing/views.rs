//! Views of a model: three projections, each from six directions, framed to fill the image.

use camera::ViewProjection;
use camera::{Basis, Slopes, frame_oblique, frame_perspective};
use homog::{Affine, Point, Vector, View, World};
use model::Model;
use model::ModelInstance;
use pipeline::Scene;
use projection::{Convention, Frustum, Oblique, Orthographic};
use scene::{ImageSpec, Style};
use std::sync::Arc;

/// The number of viewing directions of each kind.
pub const DIRECTIONS: usize = 6;

/// The width and height in pixels.
const IMAGE_SIZE: (u32, u32) = (400, 300);

/// The projection of a view.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum ViewKind {
    /// Symmetric perspective.
    Perspective,
    /// Orthographic along a space diagonal.
    Isometric,
    /// Oblique at 45°, with full depth.
    Cavalier,
}

impl ViewKind {
    /// All projection kinds.
    pub const ALL: [Self; 3] = [Self::Perspective, Self::Isometric, Self::Cavalier];

    /// Returns the direction from the model to the eye.
    fn direction_from(self, direction: usize) -> Vector<World> {
        let directions = match self {
            Self::Perspective => [
                [0.0, 0.0, 1.0],
                [1.0, 0.3, 0.2],
                [-0.6, 0.8, -1.0],
                [0.1, 1.0, 0.2],
                [-1.0, -0.4, 0.7],
                [0.3, 0.2, -1.0],
            ],
            Self::Isometric => [
                [1.0, 1.0, 1.0],
                [-1.0, 1.0, 1.0],
                [1.0, 1.0, -1.0],
                [-1.0, 1.0, -1.0],
                [1.0, -1.0, 1.0],
                [-1.0, -1.0, -1.0],
            ],
            Self::Cavalier => [
                [0.0, 0.0, 1.0],
                [0.0, 0.0, -1.0],
                [1.0, 0.0, 0.0],
                [-1.0, 0.0, 0.0],
                [0.0, 1.0, 0.0],
                [0.0, -1.0, 0.0],
            ],
        };
        Vector::from(directions[direction])
    }
}

/// Returns a scene of one model that fills the image.
pub fn build_scene(model: &Arc<Model>, kind: ViewKind, direction: usize) -> Result<Scene, String> {
    let gaze = -kind.direction_from(direction);
    let up = Basis::fallback_up(gaze);
    let up = if gaze.cross(Vector::Y).length() > 1e-6 { Vector::Y } else { up };
    let basis = Basis::from_gaze(gaze, up).map_err(|error| error.to_string())?;
    let model_to_world = Affine::scale(1.0, 1.0, 1.0);
    let points: Vec<Point<World>> =
        model.scene_points().into_iter().map(|p| model_to_world.transform_point(p)).collect();
    let view_projection = match kind {
        ViewKind::Perspective => fit_perspective(&points, basis),
        ViewKind::Isometric => fit_parallel(&points, basis, None),
        ViewKind::Cavalier => fit_parallel(&points, basis, Some(std::f64::consts::FRAC_PI_4)),
    };
    let (width, height) = IMAGE_SIZE;
    let models = vec![ModelInstance { model: Arc::clone(model), model_to_world }];
    let image = ImageSpec::new(width, height);
    Ok(Scene { style: Style::Flat, ..Scene::new(models, view_projection?, image) })
}

fn fit_perspective(points: &[Point<World>], basis: Basis) -> Result<ViewProjection, String> {
    let slopes = Slopes { left: -0.4, right: 0.4, bottom: -0.3, top: 0.3 };
    let framing = frame_perspective(points.iter().copied(), basis, slopes, 0.02);
    let framing = framing.map_err(|error| error.to_string())?;
    let (near, far) = (framing.near * 0.99, framing.far * 1.01);
    let frustum = Frustum::new(-0.4 * near, 0.4 * near, -0.3 * near, 0.3 * near, near, far);
    let frustum = frustum.map_err(|error| error.to_string())?;
    let view_to_clip = frustum.view_to_clip(Convention::CHAPTER);
    Ok(ViewProjection { camera: framing.camera, view_to_clip })
}

/// Returns an orthographic projection, or an oblique projection with full depth at an angle.
fn fit_parallel(
    points: &[Point<World>],
    basis: Basis,
    depth: Option<f64>,
) -> Result<ViewProjection, String> {
    let oblique = depth.map(Oblique::cavalier).transpose().map_err(|error| error.to_string())?;
    let projectors = oblique.map_or(-Vector::<View>::Z, Oblique::direction);
    let aspect = f64::from(IMAGE_SIZE.0) / f64::from(IMAGE_SIZE.1);
    let framing = frame_oblique(points.iter().copied(), basis, projectors, aspect, 0.02);
    let f = framing.map_err(|error| error.to_string())?;
    let margin = 0.01 * (f.far - f.near) + 1e-3 * f.near;
    let window =
        Orthographic::new(f.left, f.right, f.bottom, f.top, f.near - margin, f.far + margin);
    let window = window.map_err(|error| error.to_string())?.view_to_clip(Convention::CHAPTER);
    let identity = Affine::<View, View>::scale(1.0, 1.0, 1.0);
    let shear = oblique.map_or(identity, Oblique::depth_preserving);
    Ok(ViewProjection { camera: f.camera, view_to_clip: shear.then_project(window) })
}
