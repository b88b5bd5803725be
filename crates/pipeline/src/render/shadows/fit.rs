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
pub(super) struct Fit {
    pub(super) view_projection: ViewProjection,
    /// Texels of a row, and rows.
    pub(super) size: [u32; 2],
    /// The middle of the scene.
    pub(super) middle: DVec3,
    /// The penumbra, as [`ShadowMap::soften`](shade::ShadowMap) wants it.
    pub(super) spread: f64,
    pub(super) at_infinity: Option<f64>,
}

/// The widest half angle of a spot's map, as a slope: beyond it there is light everywhere.
const WIDEST: f64 = 8.0;
/// Free texels around what casts shadows.
const BORDER: f64 = 3.0;

impl Fit {
    /// The camera of a light that casts shadows; `None` if there is nothing that could.
    pub(super) fn of(scene: &Scene, light: &Light, shadow: Shadow) -> Option<Self> {
        match *light {
            Light::Sun { towards, .. } => sun(scene, towards.map(|c| -f64::from(c)), shadow),
            Light::Spot { position, axis, cosines, .. } => {
                spot(scene, position.map(f64::from), axis.map(f64::from), cosines[1], shadow)
            }
            Light::Point { .. } | Light::Ambient { .. } => None,
        }
    }
}

/// A box along the axes of a light's view.
#[derive(Clone, Copy, Debug)]
struct Extent {
    least: DVec3,
    greatest: DVec3,
}

impl Extent {
    const NONE: Self =
        Self { least: DVec3::splat(f64::INFINITY), greatest: DVec3::splat(f64::NEG_INFINITY) };

    fn add(&mut self, place: DVec3) {
        if place.is_finite() {
            self.least = self.least.min(place);
            self.greatest = self.greatest.max(place);
        }
    }
}

/// Calls `each` with every vertex of the scene's triangles, in a light's view.
fn each_place(models: &[ModelInstance], camera: Camera, mut each: impl FnMut(DVec3)) {
    let world_to_view = camera.world_to_view();
    for ModelInstance { model, model_to_world } in models {
        for (instance, primitive) in model.shown_primitives() {
            let posed = model.posed(instance, primitive);
            let to_view = posed.to_model.then(*model_to_world).then(world_to_view).raw();
            for position in posed.positions.iter() {
                each(to_view.transform_point3(DVec3::from_array(position.map(f64::from))));
            }
        }
    }
}

fn sun(scene: &Scene, travel: [f64; 3], shadow: Shadow) -> Option<Fit> {
    let gaze = Vector::<World>::from(travel);
    let basis = Basis::from_gaze_or_fallback(gaze, Vector::Y).ok()?;
    let camera = Camera::new(Point::ORIGIN, basis).ok()?;
    let mut all = Extent::NONE;
    each_place(&scene.models, camera, |place| all.add(place));
    if all.least.x > all.greatest.x {
        return None;
    }
    let depth = (all.greatest.z - all.least.z).max(1e-9 * all.least.abs().max_element()).max(1e-30);
    let mut seen = all;
    if let Some(view) = view_extent(scene, camera) {
        // A little more than is seen, so that what is blurred into the view is there.
        let slack = depth * (0.5 * f64::from(shadow.softness)).min(0.5);
        seen.least = all.least.max(view.least - slack).min(all.greatest);
        seen.greatest = all.greatest.min(view.greatest + slack).max(all.least);
    }
    let (width, height) = (seen.greatest.x - seen.least.x, seen.greatest.y - seen.least.y);
    let longest = width.max(height).max(1e-6 * depth);
    let texel = longest / (f64::from(shadow.size) - 2.0 * BORDER);
    let texels = |side: f64| ((side / texel + 2.0 * BORDER).ceil() as u32).clamp(16, shadow.size);
    let size = [texels(width), texels(height)];
    let middle = 0.5 * (seen.least + seen.greatest);
    let [half_x, half_y] = size.map(|side| 0.5 * f64::from(side) * texel);
    let window =
        Window::new(middle.x - half_x, middle.x + half_x, middle.y - half_y, middle.y + half_y)
            .ok()?;
    let (near, far) = (-all.greatest.z - 0.01 * depth, -all.least.z + 0.01 * depth);
    let box_of_light = Orthographic::from_window(window, near, far).ok()?;
    let slope = libm::tan(0.5 * f64::from(shadow.softness));
    Some(Fit {
        view_projection: ViewProjection {
            camera,
            view_to_clip: box_of_light.view_to_clip(Convention::CHAPTER),
        },
        size,
        middle: in_world(camera, middle),
        spread: slope * (far - near) / texel,
        at_infinity: None,
    })
}

/// The box around the camera's view volume in a light's view; `None` if it has no end.
fn view_extent(scene: &Scene, camera: Camera) -> Option<Extent> {
    let clip_to_world = scene.view_projection.world_to_clip().raw().inverse();
    let world_to_view = camera.world_to_view();
    let mut extent = Extent::NONE;
    for corner in 0..8 {
        let side = |axis: u32| if corner >> axis & 1 == 0 { -1.0 } else { 1.0 };
        let place = clip_to_world * glam::DVec4::new(side(0), side(1), side(2), 1.0);
        let place = place.truncate() / place.w;
        if !place.is_finite() {
            return None;
        }
        extent.add(world_to_view.point(Point::from_raw(place)).raw());
    }
    Some(extent)
}

fn in_world(camera: Camera, place: DVec3) -> DVec3 {
    let offset = camera.basis().to_world(Vector::<View>::from_raw(place));
    camera.eye().raw() + offset.raw()
}

fn spot(
    scene: &Scene,
    position: [f64; 3],
    axis: [f64; 3],
    cosine: f32,
    shadow: Shadow,
) -> Option<Fit> {
    let gaze = Vector::<World>::from(axis);
    let basis = Basis::from_gaze_or_fallback(gaze, Vector::Y).ok()?;
    let camera = Camera::new(position.into(), basis).ok()?;
    let cosine = f64::from(cosine).clamp(0.0, 1.0);
    let wide = ((1.0 - cosine * cosine).sqrt() / cosine.max(1e-9)).clamp(1e-4, WIDEST);
    let (mut slopes, mut nearest, mut farthest) = (Extent::NONE, f64::INFINITY, 0.0_f64);
    each_place(&scene.models, camera, |place| {
        nearest = nearest.min(-place.z);
        farthest = farthest.max(-place.z);
        if place.z < 0.0 {
            slopes.add(DVec3::new(place.x / -place.z, place.y / -place.z, 0.0));
        }
    });
    if !(farthest > 0.0 && farthest.is_finite()) {
        return None;
    }
    // What begins behind the light may be anywhere in its cone.
    let (mut least, mut greatest) = (DVec3::splat(-wide), DVec3::splat(wide));
    if nearest > 0.0 {
        least = slopes.least.max(least).min(greatest);
        greatest = slopes.greatest.min(greatest).max(least);
    }
    let longest = (greatest.x - least.x).max(greatest.y - least.y).max(1e-6);
    let slope_of_texel = longest / (f64::from(shadow.size) - 2.0 * BORDER);
    let texels =
        |side: f64| ((side / slope_of_texel + 2.0 * BORDER).ceil() as u32).clamp(16, shadow.size);
    let size = [texels(greatest.x - least.x), texels(greatest.y - least.y)];
    let middle = 0.5 * (least + greatest);
    let [half_x, half_y] = size.map(|side| 0.5 * f64::from(side) * slope_of_texel);
    let window =
        Window::new(middle.x - half_x, middle.x + half_x, middle.y - half_y, middle.y + half_y)
            .ok()?;
    let far = farthest * 1.01;
    let near = (nearest * 0.99).max(far * 1e-3);
    let frustum = Frustum::from_slopes(window, near, far).ok()?;
    let slope = libm::tan(0.5 * f64::from(shadow.softness));
    Some(Fit {
        view_projection: ViewProjection {
            camera,
            view_to_clip: frustum.view_to_clip(Convention::CHAPTER),
        },
        size,
        middle: camera.eye().raw() + gaze.raw() * (0.5 * (near + far)),
        spread: slope / slope_of_texel,
        // Depth is (near far / w − near) / (far − near).
        at_infinity: Some(-near / (far - near)),
    })
}
