//! The `volume` pane: the canonical view volume and its contents after clipping and the divide, or
//! after an intermediate step.

use crate::ExplorerError;
use crate::facts::Facts;
use crate::lesson::VolumeStage;
use crate::pane_scene::{Observer, PaneGeometry, camera_at_origin, label_at, named_point};
use crate::triangle_survey::{Containment, classify, project};
use crate::world_pane::Pointer;
use camera::ViewProjection;
use clip::{Volume, clip_triangle};
use drawing::Overlay;
use explain::ApiConventions;
use glam::DMat4;
use homog::{Affine, Clip, HPoint, Point, Projective, View, World};
use pipeline::Scene;
use projection::{Convention, Frustum, ViewVolume};

/// The largest coordinate at which torn triangles are drawn, in half sides of the view volume. It
/// is far below the limit of single precision.
const TORN_LIMIT: f64 = 1e6;

/// Returns the scene of the pane at a stage of the pipeline.
///
/// # Errors
/// Returns an error if the scene cannot be framed.
pub(crate) fn volume_scene(
    facts: &Facts,
    stage: VolumeStage,
    conventions: ApiConventions,
    observer: Observer,
    pointer: Pointer,
) -> Result<Scene, ExplorerError> {
    match stage {
        VolumeStage::Factors(count) => factor_scene(facts, count, observer),
        stage => canonical_scene(facts, stage, conventions, observer, pointer),
    }
}

/// Returns the scene of the canonical view volume.
fn canonical_scene(
    facts: &Facts,
    stage: VolumeStage,
    conventions: ApiConventions,
    observer: Observer,
    pointer: Pointer,
) -> Result<Scene, ExplorerError> {
    let world_to_clip = facts.view_projection.world_to_clip();
    let mut geometry = PaneGeometry::default();
    for triangle in facts.loaded.models.triangles.drawn() {
        add_divided(&mut geometry, project(&world_to_clip, triangle), stage);
    }
    let to_ndc = |point| world_to_clip.transform_point(point).divide();
    let ends =
        pointer.sight.and_then(|sight| Some([to_ndc(sight.ends[0])?, to_ndc(sight.ends[1])?]));
    if let Some(ends) = ends {
        geometry.add_sight(ends.map(<[f64; 3]>::from));
    }
    let corners = [-1.0, 1.0].map(|x| [-1.0, 1.0].map(|y| [-1.0, 1.0].map(|z| [x, y, z])));
    let cube = corners.as_flattened().as_flattened().iter().map(|corner| Point::from(*corner));
    let mut scene = geometry.into_scene(observer, cube.collect())?;
    let camera = camera_at_origin()?;
    let canonical = ViewProjection { camera, view_to_clip: Projective::from_raw(DMat4::IDENTITY) };
    scene.overlays.push(Overlay::Volume(Box::new(canonical)));
    scene.overlays.extend(corner_labels(conventions));
    let image = pointer.point.and_then(to_ndc).map(|ndc| Point::from(<[f64; 3]>::from(ndc)));
    scene.overlays.extend(image.map(|point| named_point(point, "P")));
    Ok(scene)
}

/// Adds a clip-space triangle, divided by w either after clipping or as a whole.
fn add_divided(geometry: &mut PaneGeometry, corners: [HPoint<Clip>; 3], stage: VolumeStage) {
    let (containment, _) = classify(corners);
    if stage == VolumeStage::Torn {
        let divided = corners.map(|corner| corner.divide().map(<[f64; 3]>::from));
        let [Some(a), Some(b), Some(c)] = divided else { return };
        let is_far = [a, b, c].as_flattened().iter().any(|c| c.abs() > TORN_LIMIT);
        // A divide without clipping tears a triangle that is partly behind the eye.
        match corners.iter().any(|corner| corner.w() <= 0.0) {
            true if is_far => {}
            true => geometry.add_edges(Containment::Clipped, [a, b, c]),
            false if containment == Containment::Outside => {}
            false => geometry.add_triangle(containment, [a, b, c]),
        }
        return;
    }
    for fan in clip_triangle(corners, &Volume::CHAPTER).triangles() {
        if let [Some(a), Some(b), Some(c)] = fan.map(|corner| corner.point.divide()) {
            geometry.add_triangle(containment, [a, b, c].map(<[f64; 3]>::from));
        }
    }
}

/// Returns the scene of view space and the view volume after some of the frustum's affine factors.
fn factor_scene(facts: &Facts, count: usize, observer: Observer) -> Result<Scene, ExplorerError> {
    let view = facts.view_projection;
    let to_stage = affine_factors(facts, count).unwrap_or(Affine::IDENTITY);
    let to_stage = view.camera.world_to_view().then(to_stage);
    let world_to_clip = view.world_to_clip();
    let mut geometry = PaneGeometry::default();
    for triangle in facts.loaded.models.triangles.drawn() {
        let (containment, _) = classify(project(&world_to_clip, triangle));
        let corners = triangle.map(|corner| to_stage.transform_point(corner));
        geometry.add_triangle(containment, corners.map(<[f64; 3]>::from));
    }
    let from_stage = to_stage.inverse().unwrap_or(view.camera.view_to_world());
    let stage_to_clip = from_stage.then_project(world_to_clip);
    let volume = ViewVolume::new(stage_to_clip, Convention::CHAPTER);
    let corners = volume.corners().into_iter().flatten().chain(volume.eye());
    let finite = corners.filter_map(HPoint::divide);
    let framed: Vec<Point<World>> =
        finite.map(|point| Point::from(<[f64; 3]>::from(point))).collect();
    let labels = [(3, "near"), (6, "far")];
    let labels = labels.map(|(at, text)| Some(label_at(*framed.get(at)?, text, [4.0, -4.0])));
    let mut scene = geometry.into_scene(observer, framed)?;
    let seen = ViewProjection { camera: camera_at_origin()?, view_to_clip: stage_to_clip };
    scene.overlays.push(Overlay::Volume(Box::new(seen)));
    scene.overlays.extend(labels.into_iter().flatten());
    Ok(scene)
}

/// Returns the product of the first `count` factors (shear and scale), or `None` if the view is not
/// a frustum.
fn affine_factors(facts: &Facts, count: usize) -> Option<Affine<View, View>> {
    let ([left, right, bottom, top], [near, far]) = (facts.window?, facts.planes);
    let frustum = Frustum::new(left, right, bottom, top, near?, far?).ok()?;
    let factors = frustum.factors(Convention::CHAPTER);
    Some(match count {
        0 => Affine::IDENTITY,
        1 => factors.shear,
        _ => factors.shear.then(factors.scale),
    })
}

/// Returns labels with the coordinates of two opposite corners of the canonical view volume, in
/// these conventions.
fn corner_labels(conventions: ApiConventions) -> [Overlay; 2] {
    let [near, far] = match conventions {
        ApiConventions::OpenGl => [-1, 1],
        ApiConventions::Vulkan | ApiConventions::Direct3d | ApiConventions::WebGpu => [0, 1],
        _ => [1, -1],
    };
    let label = |at: [f64; 3], text: &str, offset| label_at(Point::from(at), text, offset);
    [
        label([-1.0, -1.0, 1.0], &format!("near (-1, -1, {near})"), [-2.0, 8.0]),
        label([1.0, 1.0, -1.0], &format!("far (1, 1, {far})"), [2.0, -6.0]),
    ]
}
