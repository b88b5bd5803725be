//! Where a light looks from and how much of the scene it sees: as little as counts, so that texels are small.
//!
//! A sun's map shows that part of the box around the scene, along the light, that is in the view; all that is before it towards the
//! light stays between its planes. A spot's shows its cone, or the scene if that is less.

use crate::scene::Scene;
use ::camera::{Basis, Camera};
use camera::ViewProjection;
use glam::DVec3;
use homog::{Point, Vector, View, World};
use model::ModelInstance;
use projection::{Convention, Frustum, Orthographic, Window};
use shade::{Light, Shadow};

/// A light's camera.
#[derive(Debug)]
pub(super) struct LightCamera {
    pub(super) view_projection: ViewProjection,
    /// Texels of a row, and rows.
    pub(super) size: [u32; 2],
    /// The middle of the scene.
    pub(super) center: DVec3,
    /// The penumbra, as [`ShadowMap::soften`](shade::ShadowMap) wants it.
    pub(super) penumbra: f64,
    pub(super) depth_at_infinity: Option<f64>,
}

/// The widest half angle of a spot's map, as a slope: beyond it there is light everywhere.
const MAX_SPOT_SLOPE: f64 = 8.0;
/// Free texels around what casts shadows.
const BORDER_TEXELS: f64 = 3.0;

impl LightCamera {
    /// The camera of a light that casts shadows; `None` if there is nothing that could.
    pub(super) fn fit_to_light(scene: &Scene, light: &Light, shadow: Shadow) -> Option<Self> {
        match *light {
            Light::Sun { to_light: towards, .. } => {
                fit_directional(scene, towards.map(|c| -f64::from(c)), shadow)
            }
            Light::Spot { position, axis, cosines, .. } => {
                fit_spot(scene, position.map(f64::from), axis.map(f64::from), cosines[1], shadow)
            }
            Light::Point { .. } | Light::Ambient { .. } => None,
        }
    }
}

/// A box along the axes of a light's view.
#[derive(Clone, Copy, Debug)]
struct ViewBounds {
    min: DVec3,
    max: DVec3,
}

impl ViewBounds {
    const EMPTY: Self =
        Self { min: DVec3::splat(f64::INFINITY), max: DVec3::splat(f64::NEG_INFINITY) };

    fn include(&mut self, place: DVec3) {
        if place.is_finite() {
            self.min = self.min.min(place);
            self.max = self.max.max(place);
        }
    }
}

/// Calls `each` with every vertex of the scene's triangles, in a light's view.
fn for_each_vertex(models: &[ModelInstance], camera: Camera, mut each: impl FnMut(DVec3)) {
    let world_to_view = camera.world_to_view();
    for ModelInstance { model, model_to_world } in models {
        for (instance, primitive) in model.scene_primitives() {
            let posed = model.skin_primitive(instance, primitive);
            let to_view = posed.to_model.then(*model_to_world).then(world_to_view).raw();
            for position in posed.positions.iter() {
                each(to_view.transform_point3(DVec3::from_array(position.map(f64::from))));
            }
        }
    }
}

fn fit_directional(scene: &Scene, travel: [f64; 3], shadow: Shadow) -> Option<LightCamera> {
    let gaze = Vector::<World>::from(travel);
    let basis = Basis::from_gaze_or_fallback(gaze, Vector::Y).ok()?;
    let camera = Camera::new(Point::ORIGIN, basis).ok()?;
    let mut scene_bounds = ViewBounds::EMPTY;
    for_each_vertex(&scene.models, camera, |place| scene_bounds.include(place));
    if scene_bounds.min.x > scene_bounds.max.x {
        return None;
    }
    let depth = (scene_bounds.max.z - scene_bounds.min.z)
        .max(1e-9 * scene_bounds.min.abs().max_element())
        .max(1e-30);
    let mut visible_bounds = scene_bounds;
    if let Some(view) = view_volume_bounds(scene, camera) {
        // A little more than is seen, so that what is blurred into the view is there.
        let blur_margin = depth * (0.5 * f64::from(shadow.softness)).min(0.5);
        visible_bounds.min = scene_bounds.min.max(view.min - blur_margin).min(scene_bounds.max);
        visible_bounds.max = scene_bounds.max.min(view.max + blur_margin).max(scene_bounds.min);
    }
    let (width, height) =
        (visible_bounds.max.x - visible_bounds.min.x, visible_bounds.max.y - visible_bounds.min.y);
    let longest = width.max(height).max(1e-6 * depth);
    let texel = longest / (f64::from(shadow.resolution) - 2.0 * BORDER_TEXELS);
    let texels = |side: f64| {
        ((side / texel + 2.0 * BORDER_TEXELS).ceil() as u32).clamp(16, shadow.resolution)
    };
    let size = [texels(width), texels(height)];
    let center = 0.5 * (visible_bounds.min + visible_bounds.max);
    let [half_x, half_y] = size.map(|side| 0.5 * f64::from(side) * texel);
    let window =
        Window::new(center.x - half_x, center.x + half_x, center.y - half_y, center.y + half_y)
            .ok()?;
    let (near, far) = (-scene_bounds.max.z - 0.01 * depth, -scene_bounds.min.z + 0.01 * depth);
    let light_volume = Orthographic::from_window(window, near, far).ok()?;
    let slope = libm::tan(0.5 * f64::from(shadow.softness));
    Some(LightCamera {
        view_projection: ViewProjection {
            camera,
            view_to_clip: light_volume.view_to_clip(Convention::CHAPTER),
        },
        size,
        center: view_to_world_point(camera, center),
        penumbra: slope * (far - near) / texel,
        depth_at_infinity: None,
    })
}

/// The box around the camera's view volume in a light's view; `None` if it has no end.
fn view_volume_bounds(scene: &Scene, camera: Camera) -> Option<ViewBounds> {
    let clip_to_world = scene.view_projection.world_to_clip().raw().inverse();
    let world_to_view = camera.world_to_view();
    let mut extent = ViewBounds::EMPTY;
    for corner in 0..8 {
        let signed_unit = |axis: u32| if corner >> axis & 1 == 0 { -1.0 } else { 1.0 };
        let corner_position =
            clip_to_world * glam::DVec4::new(signed_unit(0), signed_unit(1), signed_unit(2), 1.0);
        let corner_position = corner_position.truncate() / corner_position.w;
        if !corner_position.is_finite() {
            return None;
        }
        extent.include(world_to_view.transform_point(Point::from_raw(corner_position)).raw());
    }
    Some(extent)
}

fn view_to_world_point(camera: Camera, place: DVec3) -> DVec3 {
    let offset = camera.basis().to_world(Vector::<View>::from_raw(place));
    camera.eye().raw() + offset.raw()
}

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
    let max_slope = ((1.0 - cosine * cosine).sqrt() / cosine.max(1e-9)).clamp(1e-4, MAX_SPOT_SLOPE);
    let (mut slopes, mut nearest, mut farthest) = (ViewBounds::EMPTY, f64::INFINITY, 0.0_f64);
    for_each_vertex(&scene.models, camera, |place| {
        nearest = nearest.min(-place.z);
        farthest = farthest.max(-place.z);
        if place.z < 0.0 {
            slopes.include(DVec3::new(place.x / -place.z, place.y / -place.z, 0.0));
        }
    });
    if !(farthest > 0.0 && farthest.is_finite()) {
        return None;
    }
    // What begins behind the light may be anywhere in its cone.
    let (mut least, mut greatest) = (DVec3::splat(-max_slope), DVec3::splat(max_slope));
    if nearest > 0.0 {
        least = slopes.min.max(least).min(greatest);
        greatest = slopes.max.min(greatest).max(least);
    }
    let longest = (greatest.x - least.x).max(greatest.y - least.y).max(1e-6);
    let slope_of_texel = longest / (f64::from(shadow.resolution) - 2.0 * BORDER_TEXELS);
    let texels = |side: f64| {
        ((side / slope_of_texel + 2.0 * BORDER_TEXELS).ceil() as u32).clamp(16, shadow.resolution)
    };
    let size = [texels(greatest.x - least.x), texels(greatest.y - least.y)];
    let center = 0.5 * (least + greatest);
    let [half_x, half_y] = size.map(|side| 0.5 * f64::from(side) * slope_of_texel);
    let window =
        Window::new(center.x - half_x, center.x + half_x, center.y - half_y, center.y + half_y)
            .ok()?;
    let far = farthest * 1.01;
    let near = (nearest * 0.99).max(far * 1e-3);
    let frustum = Frustum::from_slopes(window, near, far).ok()?;
    let slope = libm::tan(0.5 * f64::from(shadow.softness));
    Some(LightCamera {
        view_projection: ViewProjection {
            camera,
            view_to_clip: frustum.view_to_clip(Convention::CHAPTER),
        },
        size,
        center: camera.eye().raw() + gaze.raw() * (0.5 * (near + far)),
        penumbra: slope / slope_of_texel,
        // Depth is (near far / w − near) / (far − near).
        depth_at_infinity: Some(-near / (far - near)),
    })
}
