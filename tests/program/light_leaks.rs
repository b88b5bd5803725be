//! Light leaks on closed real-world models, with the sun behind them. Points that rays find dark
//! must be dark in the picture. Points that rays find lit must look as if there were no shadows,
//! except for one pixel in a hundred. The test is reported as skipped if `shared/assets` is
//! missing.
//!
//! Each pixel's position and normal come from the passes. From there, one ray is cast toward the
//! sun, and eight more around it, four texels of the shadow map apart. If all nine are blocked by
//! something other than the surface itself, filtering the map cannot let light in. If none is
//! blocked, filtering cannot keep light out.

use crate::asset_models::asset_path;
use glam::DVec3;
use homog::Affine;
use import::{ImportOptions, load};
use model::ModelInstance;
use model::{Material, Model};
use pipeline::render::render_passes;
use pipeline::{Origin, Picture, Scene, Timings, render};
use scene_file::{Pass, parse_scene};
use std::sync::Arc;

const SIZE: (u32, u32) = (240, 180);
/// The side length of the shadow map in texels.
const TEXELS: f64 = 1024.0;

/// The triangles of a posed model, and the diagonal of their bounding box.
struct Occluder {
    triangles: Vec<[DVec3; 3]>,
    diagonal: f64,
}

impl Occluder {
    fn from_model(model: &Model) -> Self {
        let mut triangles = Vec::new();
        for (instance, primitive) in model.scene_primitives() {
            let posed = model.skin_primitive(instance, primitive);
            let position = |at: u32| {
                let position = posed.positions[at as usize].map(f64::from);
                posed.to_model.raw().transform_point3(DVec3::from_array(position))
            };
            let corners = primitive.indices.as_chunks::<3>().0;
            triangles.extend(corners.iter().map(|corners| corners.map(position)));
        }
        let all = || triangles.iter().flatten();
        let least = all().fold(DVec3::INFINITY, |a, &b| a.min(b));
        let greatest = all().fold(DVec3::NEG_INFINITY, |a, &b| a.max(b));
        Self { diagonal: (greatest - least).length(), triangles }
    }

    /// Returns whether a ray hits something beyond this distance from its start (Möller and
    /// Trumbore, 1997).
    fn blocks_ray(&self, from: DVec3, along: DVec3, least: f64) -> bool {
        self.triangles.iter().any(|[a, b, c]| {
            let (u, v) = (*b - *a, *c - *a);
            let across = along.cross(v);
            let determinant = u.dot(across);
            let start = from - *a;
            let s = start.dot(across) / determinant;
            let turned = start.cross(u);
            let t = along.dot(turned) / determinant;
            s >= 0.0 && t >= 0.0 && s + t <= 1.0 && v.dot(turned) / determinant > least
        })
    }
}

/// Returns the scene of a white chalk model under one sun.
fn scene_with_sun(model: &Arc<Model>, travel: DVec3, shadows: &str) -> Scene {
    let DVec3 { x, y, z } = travel;
    let text = format!(
        r#"Scene(
            models: [(path: "made")],
            camera: (view: Frame(from: Direction((0.6, 0.5, 1)))),
            lights: [Directional(direction: ({x}, {y}, {z}), intensity: 3, shadows: {shadows})],
            image: (size: {SIZE:?}, samples: 1),
        )"#
    );
    let file = parse_scene("made.ron", &text).expect("a scene");
    let placed = ModelInstance { model: Arc::clone(model), model_to_world: Affine::IDENTITY };
    let origin = Origin::from_text("made.ron", text, ".".into());
    Scene::from_models(&origin, &file, &[placed]).expect("a valid scene")
}

/// Counts of dark and lit pixels, according to the rays.
#[derive(Default)]
struct RayCounts {
    away: usize,
    dark: usize,
    light: usize,
    /// Lit pixels that are darker than they would be without shadows.
    spots: usize,
}

fn check_sun_direction(
    name: &str,
    model: &Arc<Model>,
    body: &Occluder,
    travel: DVec3,
    counts: &mut RayCounts,
) {
    let towards = -travel.normalize();
    let (u, v) = towards.any_orthonormal_pair();
    let around = 4.0 * body.diagonal / TEXELS;
    let sides = [-1.0, 0.0, 1.0].map(|a| [-1.0, 0.0, 1.0].map(|b| (a * u + b * v) * around));
    let shaded = scene_with_sun(model, travel, &format!("On(size: {TEXELS}, softness_degrees: 0)"));
    let with = render(&shaded, 2).expect("a picture");
    let without = render(&scene_with_sun(model, travel, "Off"), 2).expect("a picture");
    let whole = shaded.image.pixel_rect();
    let wanted = [Pass::Position, Pass::Normal];
    let pass_buffers =
        render_passes(&shaded, whole, &wanted, 2, &Timings::default()).expect("passes");
    let vector = |pass: usize, x: u32, y: u32| {
        let values = pass_buffers[pass].float_values(x, y).expect("a pixel");
        DVec3::new(values[0].into(), values[1].into(), values[2].into())
    };
    let code = |picture: &Picture, x: u32, y: u32| picture.pixel(x, y).expect("a pixel")[0];
    for (x, y) in (0..SIZE.1).step_by(3).flat_map(|y| (0..SIZE.0).step_by(3).map(move |x| (x, y))) {
        let (position, normal) = (vector(0, x, y), vector(1, x, y));
        if normal == DVec3::ZERO {
            continue;
        }
        let cosine = normal.dot(towards);
        let lit = code(&with, x, y);
        let stops = |least: f64| {
            move |side: &DVec3| body.blocks_ray(position + *side, towards, least * body.diagonal)
        };
        let mut rays = sides.iter().flatten();
        if cosine <= 0.0 {
            counts.away += 1;
            assert_eq!(lit, 0, "{name} {travel}: ({x}, {y}) faces away and is lit");
        } else if rays.clone().all(stops(0.02)) {
            counts.dark += usize::from(code(&without, x, y) > 40);
            assert_eq!(lit, 0, "{name} {travel}: light leaks to ({x}, {y})");
        } else if cosine > 0.3 && !rays.any(|side| stops(0.0)(&(*side + normal * 2.0 * around))) {
            counts.light += 1;
            counts.spots += usize::from(lit.abs_diff(code(&without, x, y)) > 2);
        }
    }
}

#[test]
fn no_light_leaks_through_closed_models() {
    for name in ["torus/torus.gltf", "boolean/boolean.glb", "alien/alien.glb"] {
        let Some(path) = asset_path(name) else { continue };
        let mut model = load(&path, &ImportOptions::default()).expect("a model");
        for material in &mut model.materials {
            *material = Material { metallic: 0.0, ..Material::default() };
        }
        let (body, model) = (Occluder::from_model(&model), Arc::new(model));
        let mut found = RayCounts::default();
        for travel in [(0.5, -1.0, 0.9), (-1.0, -0.5, 0.4), (0.1, -0.25, 1.0)] {
            check_sun_direction(name, &model, &body, DVec3::from(travel), &mut found);
        }
        let RayCounts { away, dark, light, spots } = found;
        assert!(away > 100 && dark > 60 && light > 60, "{name}: {away} {dark} {light}");
        // On saddle surfaces, individual pixels are below the planes of adjacent triangles.
        assert!(spots * 100 <= light, "{name}: {spots} of {light} lit pixels are too dark");
    }
}
