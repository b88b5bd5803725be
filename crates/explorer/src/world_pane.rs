//! The `world` pane: the world from outside, with the view volume, the eye and a line of sight.
//!
//! ```text
//!           ╱│near      │far
//!    eye ──●─┼────P─────┼      triangles inside, clipped and outside in three colors
//!           ╲│          │
//! ```

use crate::ExplorerError;
use crate::line_of_sight::LineOfSight;
use crate::model_store::LoadedScene;
use crate::pane_scene::{Observer, PaneGeometry, label_at, named_point};
use crate::triangle_survey::{Containment, WorldTriangle, classify, project};
use camera::ViewProjection;
use clip::cut_triangle;
use drawing::Overlay;
use homog::{HPoint, Plane, Point, View, World};
use pipeline::Scene;
use projection::{Convention, ViewVolume};

/// The maximum number of view volumes drawn, which is enough for all viewports of a sheet.
const MAX_VOLUMES: usize = 4;
/// The maximum depth of the framed part of a view volume, as a multiple of the distance to the
/// farthest model point.
const MAX_FRAMED_DEPTH: f64 = 1.6;

/// The highlighted point in the world and the line of sight through it.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Pointer {
    pub(crate) point: Option<Point<World>>,
    pub(crate) sight: Option<LineOfSight>,
}

/// Returns the scene of the world from outside. It is framed around the scene with the lesson's
/// defaults, so that it stays in place while a value is dragged.
///
/// # Errors
/// Returns an error if the scene cannot be framed.
pub(crate) fn world_scene(
    loaded: &LoadedScene,
    defaults: &LoadedScene,
    observer: Observer,
    pointer: Pointer,
) -> Result<Scene, ExplorerError> {
    let shown = loaded.views();
    let first = shown[0].view_projection;
    let mut geometry = PaneGeometry::default();
    let (planes, world_to_clip) = (world_planes(&first), first.world_to_clip());
    for triangle in loaded.models.triangles.drawn() {
        let mut add = |containment, triangle: WorldTriangle| {
            geometry.add_triangle(containment, triangle.map(<[f64; 3]>::from));
        };
        match classify(project(&world_to_clip, triangle)).0 {
            Containment::Clipped => cut_at_planes(*triangle, &planes, &mut add),
            containment => add(containment, *triangle),
        }
    }
    if let Some(sight) = pointer.sight {
        geometry.add_sight([eye(&first).unwrap_or(sight.ends[0]), sight.ends[1]].map(Into::into));
    }
    let framed = framed_points(&defaults.views(), defaults.models.triangles.drawn());
    let mut scene = geometry.into_scene(observer, framed)?;
    for view in shown.iter().take(MAX_VOLUMES) {
        scene.overlays.push(Overlay::Volume(Box::new(view.view_projection)));
    }
    scene.overlays.extend(plane_labels(&first));
    scene.overlays.extend(pointer.point.map(|point| named_point(point, "P")));
    Ok(scene)
}

/// Returns the planes of a view volume in the world. Their positive sides are inside.
fn world_planes(view: &ViewProjection) -> [Plane<World>; 6] {
    let volume = ViewVolume::new(view.view_to_clip, Convention::CHAPTER);
    // A plane is a row: (plane · M_cam) p = plane · (M_cam p).
    let to_view = view.camera.world_to_view().raw().transpose();
    volume.planes().map(|plane| Plane::from_raw(to_view * plane.raw()))
}

/// Splits a clipped triangle into the parts inside and outside the volume.
fn cut_at_planes(
    triangle: WorldTriangle,
    planes: &[Plane<World>; 6],
    add: &mut dyn FnMut(Containment, WorldTriangle),
) {
    let mut inside = vec![triangle];
    for plane in planes {
        let outwards = Plane::from_raw(-plane.raw());
        for piece in std::mem::take(&mut inside) {
            // A piece on the plane counts as inside; otherwise both sides of the cut would contain
            // it.
            if piece.iter().any(|corner| plane.evaluate(*corner) < 0.0) {
                let cut_off = cut_triangle(piece, outwards);
                for fan in cut_off.triangles() {
                    add(Containment::Outside, fan.map(|vertex| vertex.point));
                }
            }
            let left = cut_triangle(piece, *plane);
            inside.extend(left.triangles().map(|fan| fan.map(|vertex| vertex.point)));
        }
    }
    inside.into_iter().for_each(|piece| add(Containment::Clipped, piece));
}

/// Returns the center of projection, or `None` in a parallel projection.
fn eye(view: &ViewProjection) -> Option<Point<World>> {
    let volume = ViewVolume::new(view.view_to_clip, Convention::CHAPTER);
    Some(view.camera.view_to_world().transform_point(volume.eye()?.divide()?))
}

/// Returns the points that the world is framed around: the models, the eyes, and the corners of the
/// volumes that are not far behind the models.
fn framed_points(shown: &[&Scene], triangles: &[WorldTriangle]) -> Vec<Point<World>> {
    let mut points: Vec<Point<World>> = triangles.iter().flatten().copied().collect();
    for scene in shown.iter().take(MAX_VOLUMES) {
        let view = scene.view_projection;
        let volume = ViewVolume::new(view.view_to_clip, Convention::CHAPTER);
        let (to_view, to_world) = (view.camera.world_to_view(), view.camera.view_to_world());
        let Some(corners) = volume.corners().map(|all| all.map(HPoint::divide)) else {
            continue;
        };
        let depths = triangles.iter().flatten().map(|point| -to_view.transform_point(*point).z());
        let limit = MAX_FRAMED_DEPTH * depths.fold(0.0, f64::max);
        let sides = (0..4).filter_map(|at| Some([corners[at]?, corners[at + 4]?]));
        let shortened = sides.flat_map(|[near, far]| {
            let [n, f] = [-near.z(), -far.z()];
            let t = if f > limit && limit > n { (limit - n) / (f - n) } else { 1.0 };
            [near, near.lerp(far, t)]
        });
        let eye = volume.eye().and_then(HPoint::divide);
        let all = shortened.chain(eye);
        points.extend(all.map(|point: Point<View>| to_world.transform_point(point)));
    }
    points
}

/// Returns labels for the near and far planes, at a corner of each plane.
fn plane_labels(view: &ViewProjection) -> Vec<Overlay> {
    let volume = ViewVolume::new(view.view_to_clip, Convention::CHAPTER);
    let Some(corners) = volume.corners() else { return Vec::new() };
    let to_world = view.camera.view_to_world();
    let label = |(at, text, offset): (usize, &str, [f64; 2])| {
        Some(label_at(to_world.transform_point(corners[at].divide()?), text, offset))
    };
    [(3, "near", [-3.0, -4.0]), (6, "far", [4.0, -4.0])].into_iter().filter_map(label).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use camera::{Camera, ViewProjection};
    use homog::Vector;
    use projection::Frustum;

    fn area(triangles: &[WorldTriangle]) -> f64 {
        let area = |[a, b, c]: &WorldTriangle| 0.5 * (*b - *a).cross(*c - *a).length();
        triangles.iter().map(area).sum()
    }

    /// The parts of a triangle that extends behind the eye add up to the whole, and the inner parts
    /// are in the volume.
    #[test]
    fn parts_of_a_split_triangle_add_up_to_the_whole() {
        let camera = Camera::look_to(Point::ORIGIN, -Vector::Z, Vector::Y).expect("a camera");
        let frustum = Frustum::new(-1.0, 1.0, -0.5, 0.5, 1.0, 9.0).expect("a frustum");
        let view =
            ViewProjection { camera, view_to_clip: frustum.view_to_clip(Convention::CHAPTER) };
        let triangle = [[-8.0, -1.0, 5.0], [7.0, 0.3, 2.0], [0.5, 0.2, -14.0]].map(Point::from);
        let mut parts: [Vec<WorldTriangle>; 3] = Default::default();
        cut_at_planes(triangle, &world_planes(&view), &mut |containment, part| {
            parts[containment as usize].push(part);
        });
        let [inside, clipped, outside] = parts;
        assert!(inside.is_empty() && !clipped.is_empty());
        assert!((area(&clipped) + area(&outside) - area(&[triangle])).abs() < 1e-9);
        for corner in clipped.iter().flatten() {
            let values = world_planes(&view).map(|plane| plane.evaluate(*corner));
            assert!(values.iter().all(|value| *value > -1e-9), "{values:?}");
        }
    }
}
