//! Shadow map fitting: finds the camera with the smallest possible view volume for a light, so that
//! texels are small.
//!
//! ```text
//!   sun ─►│ ┌──────────────┐ │     the near and far planes enclose the whole scene, because
//!         │ │    ┌───────┐ │ │     casters between the light and the view matter;
//!   light │ │    │ view  │ │ │     the window encloses only the part in the camera's view.
//!   rays  │ │    └───────┘ │ │
//!        near     scene     far
//! ```
//! The volume of a spot light is its cone, or the part of the cone that contains the scene if that
//! is smaller.

use camera::{Basis, Camera, ViewProjection};
use glam::{DVec3, Vec3};
use homog::{Point, Vector, View, World};
use model::ModelInstance;
use projection::{Convention, Frustum, Orthographic, Window};
use scene::Scene;
use shade::{Light, Shadow};

/// A light's camera, fitted to the scene.
#[derive(Debug)]
pub(super) struct LightCamera {
    /// The camera and projection of the light.
    pub(super) view_projection: ViewProjection,
    /// Width and height of the shadow map in texels.
    pub(super) size: [u32; 2],
    /// The center of the scene in the world, used as the origin of f32 coordinates.
    pub(super) center: DVec3,
    /// The penumbra width in texels per unit of depth between caster and receiver; see
    /// [`ShadowMap::set_penumbra`](shade::ShadowMap::set_penumbra).
    pub(super) penumbra: f64,
    /// For a perspective map, the limit of its depth at infinite distance; `None` if depth is
    /// linear.
    pub(super) depth_at_infinity: Option<f64>,
}

/// The tangent of the maximum half angle of a spot light's map; everything outside it is lit.
const MAX_SPOT_SLOPE: f64 = 8.0;
/// The number of empty texels around the casters, for filtering across the border.
pub(super) const BORDER_TEXELS: f64 = 3.0;

impl LightCamera {
    /// Fits a camera to a light that casts shadows. Returns `None` for lights without a direction
    /// and if the light reaches no triangle.
    pub(super) fn fit_to_light(scene: &Scene, light: &Light, shadow: Shadow) -> Option<Self> {
        match *light {
            Light::Sun { to_light: towards, .. } => {
                fit_directional(scene, towards.map(|c| -f64::from(c)), shadow)
            }
            Light::Spot { position, axis, cosines, .. } => {
                fit_spot(scene, position.map(f64::from), axis.map(f64::from), cosines[1], shadow)
            }
            Light::Legacy { position, axis, cutoff, .. } => {
                fit_spot(scene, position.map(f64::from), axis.map(f64::from), cutoff, shadow)
            }
            // A point light has six cameras; see `cube_fitting`.
            Light::Point { .. } | Light::Ambient { .. } => None,
        }
    }
}

/// An axis-aligned bounding box in a light's view space.
#[derive(Clone, Copy, Debug)]
pub(super) struct ViewBounds {
    /// The minimum coordinates.
    pub(super) min: DVec3,
    /// The maximum coordinates.
    pub(super) max: DVec3,
}

impl ViewBounds {
    /// The empty box, which any point extends.
    pub(super) const EMPTY: Self =
        Self { min: DVec3::splat(f64::INFINITY), max: DVec3::splat(f64::NEG_INFINITY) };

    /// Extends the box to a point; points at infinity are ignored.
    pub(super) fn include(&mut self, point: DVec3) {
        if point.is_finite() {
            self.min = self.min.min(point);
            self.max = self.max.max(point);
        }
    }

    /// Returns the center of the box.
    fn center(self) -> DVec3 {
        0.5 * (self.min + self.max)
    }
}

/// A window of square texels: the raster of a shadow map.
struct FittedWindow {
    /// The window on the light's picture plane.
    window: Window,
    /// Width and height in texels, at least 16.
    size: [u32; 2],
    /// The side length of a texel in window units.
    texel: f64,
}

impl FittedWindow {
    /// Returns the window around the x and y bounds, with a border. Its longer side has
    /// `resolution` texels and is at least `min_side` long.
    fn around(bounds: ViewBounds, min_side: f64, resolution: u32) -> Option<Self> {
        let (width, height) = (bounds.max.x - bounds.min.x, bounds.max.y - bounds.min.y);
        let longest = width.max(height).max(min_side);
        let texel = longest / (f64::from(resolution) - 2.0 * BORDER_TEXELS);
        let texels =
            |side: f64| ((side / texel + 2.0 * BORDER_TEXELS).ceil() as u32).clamp(16, resolution);
        let size = [texels(width), texels(height)];
        let center = bounds.center();
        let [half_x, half_y] = size.map(|side| 0.5 * f64::from(side) * texel);
        let (left, right) = (center.x - half_x, center.x + half_x);
        let (bottom, top) = (center.y - half_y, center.y + half_y);
        let window = Window::new(left, right, bottom, top).ok()?;
        Some(Self { window, size, texel })
    }
}

/// Calls `each` with every vertex of the models in a light's view space.
fn for_each_vertex(models: &[ModelInstance], camera: Camera, mut each: impl FnMut(DVec3)) {
    let world_to_view = camera.world_to_view();
    for ModelInstance { model, model_to_world } in models {
        for (instance, primitive) in model.scene_primitives() {
            let skinned = model.skin_primitive(instance, primitive);
            let to_view = skinned.to_model.then(*model_to_world).then(world_to_view).raw();
            for position in skinned.positions.iter() {
                each(to_view.transform_point3(Vec3::from_array(*position).as_dvec3()));
            }
        }
    }
}

/// Fits an orthographic camera to a directional light that travels along `travel`.
///
/// Texels are square, so the size in texels follows the shape of the window. The longer side has
/// the requested resolution.
fn fit_directional(scene: &Scene, travel: [f64; 3], shadow: Shadow) -> Option<LightCamera> {
    let gaze = Vector::<World>::from(travel);
    let basis = Basis::from_gaze_or_fallback(gaze, Vector::Y).ok()?;
    let camera = Camera::new(Point::ORIGIN, basis).ok()?;
    let mut scene_bounds = ViewBounds::EMPTY;
    for_each_vertex(&scene.models, camera, |point| scene_bounds.include(point));
    if scene_bounds.min.x > scene_bounds.max.x {
        return None;
    }
    // Must be positive even for a flat scene; otherwise the near and far planes would coincide.
    let depth = (scene_bounds.max.z - scene_bounds.min.z)
        .max(1e-9 * scene_bounds.min.abs().max_element())
        .max(1e-30);
    let mut visible_bounds = scene_bounds;
    if let Some(view) = view_volume_bounds(scene, camera) {
        // The margin is for soft shadows, whose casters may be just outside the view.
        let blur_margin = depth * (0.5 * f64::from(shadow.softness)).min(0.5);
        visible_bounds.min = scene_bounds.min.max(view.min - blur_margin).min(scene_bounds.max);
        visible_bounds.max = scene_bounds.max.min(view.max + blur_margin).max(scene_bounds.min);
    }
    let fitted = FittedWindow::around(visible_bounds, 1e-6 * depth, shadow.resolution)?;
    let center = visible_bounds.center();
    // A margin of 1% keeps the outermost casters inside despite rounding.
    let (near, far) = (-scene_bounds.max.z - 0.01 * depth, -scene_bounds.min.z + 0.01 * depth);
    let light_volume = Orthographic::from_window(fitted.window, near, far).ok()?;
    let slope = libm::tan(0.5 * f64::from(shadow.softness));
    Some(LightCamera {
        view_projection: ViewProjection {
            camera,
            view_to_clip: light_volume.view_to_clip(Convention::CHAPTER),
        },
        size: fitted.size,
        center: view_to_world_point(camera, center),
        penumbra: slope * (far - near) / fitted.texel,
        depth_at_infinity: None,
    })
}

/// Returns the bounding box of the scene camera's view volume in a light's view space, or `None` if
/// the volume is infinite.
fn view_volume_bounds(scene: &Scene, camera: Camera) -> Option<ViewBounds> {
    let world_to_view = camera.world_to_view();
    let mut bounds = ViewBounds::EMPTY;
    for corner in view_volume_corners(scene)? {
        bounds.include(world_to_view.transform_point(Point::from_raw(corner)).raw());
    }
    Some(bounds)
}

/// Returns the corners of the scene camera's view volume in the world, or `None` if the volume is
/// infinite.
pub(super) fn view_volume_corners(scene: &Scene) -> Option<[DVec3; 8]> {
    let clip_to_world = scene.view_projection.world_to_clip().raw().inverse();
    let corners = std::array::from_fn(|corner| {
        let ndc = |axis: u32| if corner >> axis & 1 == 0 { -1.0 } else { 1.0 };
        let position = clip_to_world * glam::DVec4::new(ndc(0), ndc(1), ndc(2), 1.0);
        position.truncate() / position.w
    });
    corners.iter().all(|corner| corner.is_finite()).then_some(corners)
}

/// Converts a point from a light's view space to the world.
fn view_to_world_point(camera: Camera, point: DVec3) -> DVec3 {
    let offset = camera.basis().to_world(Vector::<View>::from_raw(point));
    camera.eye().raw() + offset.raw()
}

/// Fits a perspective camera to a spot light with this cosine of its outer half angle.
fn fit_spot(
    scene: &Scene,
    position: [f64; 3],
    axis: [f64; 3],
    cosine: f32,
    shadow: Shadow,
) -> Option<LightCamera> {
    let gaze = Vector::<World>::from(axis);
    let basis = Basis::from_gaze_or_fallback(gaze, Vector::Y).ok()?;
    let camera = Camera::new(position.into(), basis).ok()?;
    let cosine = f64::from(cosine).clamp(0.0, 1.0);
    // A half angle of 90° has no finite slope.
    let max_slope = ((1.0 - cosine * cosine).sqrt() / cosine.max(1e-9)).clamp(1e-4, MAX_SPOT_SLOPE);
    let (mut slopes, mut nearest, mut farthest) = (ViewBounds::EMPTY, f64::INFINITY, 0.0_f64);
    for_each_vertex(&scene.models, camera, |point| {
        nearest = nearest.min(-point.z);
        farthest = farthest.max(-point.z);
        if point.z < 0.0 {
            slopes.include(DVec3::new(point.x / -point.z, point.y / -point.z, 0.0));
        }
    });
    if !(farthest > 0.0 && farthest.is_finite()) {
        return None;
    }
    // A triangle that begins behind the light may be anywhere in its cone.
    let (mut min, mut max) = (DVec3::splat(-max_slope), DVec3::splat(max_slope));
    if nearest > 0.0 {
        min = slopes.min.max(min).min(max);
        max = slopes.max.min(max).max(min);
    }
    let fitted = FittedWindow::around(ViewBounds { min, max }, 1e-6, shadow.resolution)?;
    let far = farthest * 1.01;
    let near = (nearest * 0.99).max(far * 1e-3);
    let frustum = Frustum::from_slopes(fitted.window, near, far).ok()?;
    let slope = libm::tan(0.5 * f64::from(shadow.softness));
    Some(LightCamera {
        view_projection: ViewProjection {
            camera,
            view_to_clip: frustum.view_to_clip(Convention::CHAPTER),
        },
        size: fitted.size,
        center: camera.eye().raw() + gaze.raw() * (0.5 * (near + far)),
        penumbra: slope / fitted.texel,
        // depth(w) = (near far / w − near) / (far − near), at w = ∞.
        depth_at_infinity: Some(-near / (far - near)),
    })
}
