//! Circles of models: chains of feature edges that follow a circle or an arc in space.
//!
//! Each chain is mapped to its plane, on a grid with a billion steps from the chain's centroid to
//! its farthest point. Arcs are then recognized as for DXF files: an arc has at least eight equally
//! spaced points, less than 29.5° apart, all within the tolerance of the plane and the circle. A
//! polygon with twelve sides or fewer is therefore not a circle.

use crate::edges::FeatureChain;
use arcs::{ArcVertex, Circle, LineShape, recognize_arcs};
use core::f64::consts::TAU;
use glam::{DVec2, DVec3};
use homog::{Point, Vector, World};

/// A circle in world space.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct WorldCircle {
    /// The center.
    pub center: Point<World>,
    /// The unit vector along the axis.
    pub axis: Vector<World>,
    /// The radius.
    pub radius: f64,
    /// The angle that the arc spans, in radians; 2π for a full circle.
    pub sweep: f64,
}

impl WorldCircle {
    /// Returns the distance of a point from the center or the circumference, whichever is nearer.
    #[must_use]
    pub fn distance_to(&self, point: Point<World>) -> f64 {
        let arm = point.raw() - self.center.raw();
        let height = arm.dot(self.axis.raw());
        let beside = (arm - self.axis.raw() * height).length();
        arm.length().min(DVec3::new(beside - self.radius, height, 0.0).length())
    }
}

/// The maximum distance of points from their circle, as a fraction of the models' diagonal.
pub(crate) const CIRCLE_TOLERANCE: f64 = 5e-5;

/// The number of grid steps from the centroid of a chain to its farthest point.
const GRID_STEPS: f64 = 1e9;

/// The plane of a chain, with a coordinate system in it.
struct ChainPlane {
    origin: DVec3,
    axes: [DVec3; 2],
    /// Grid steps per unit.
    steps: f64,
}

impl ChainPlane {
    /// Finds the plane that contains all points within a tolerance, if there is such a plane.
    ///
    /// Its normal is the area vector of the chain, normalized (Newell's method).
    fn of_chain(chain: &FeatureChain, tolerance: f64) -> Option<Self> {
        let points = &chain.points;
        let count = points.len() as f64;
        let origin = points.iter().sum::<DVec3>() / count;
        let next = |at: usize| points[(at + 1) % points.len()] - origin;
        let doubled: DVec3 =
            points.iter().enumerate().map(|(at, point)| (*point - origin).cross(next(at))).sum();
        let normal = doubled.try_normalize()?;
        let extent = points.iter().fold(0.0, |most: f64, point| most.max(point.distance(origin)));
        let is_flat = points.iter().all(|point| (*point - origin).dot(normal).abs() <= tolerance);
        let first = normal.any_orthonormal_vector();
        (is_flat && extent > 0.0).then(|| Self {
            origin,
            axes: [first, normal.cross(first)],
            steps: GRID_STEPS / extent,
        })
    }

    /// Converts a point to grid coordinates.
    fn to_grid(&self, point: DVec3) -> [i32; 2] {
        let arm = (point - self.origin) * self.steps;
        self.axes.map(|axis| libm::round(arm.dot(axis)) as i32)
    }

    /// Converts a circle from the grid to the world.
    fn to_world(&self, circle: Circle, sweep: f64) -> WorldCircle {
        let [x, y] = self.axes;
        let center = circle.center / self.steps;
        WorldCircle {
            center: Point::from_raw(self.origin + x * center.x + y * center.y),
            axis: Vector::from_raw(x.cross(y)),
            radius: circle.radius / self.steps,
            sweep,
        }
    }
}

/// Returns the circles and arcs of a chain, within a tolerance in world units.
pub(crate) fn circles_of_chain(chain: &FeatureChain, tolerance: f64) -> Vec<WorldCircle> {
    let Some(plane) = ChainPlane::of_chain(chain, tolerance) else { return Vec::new() };
    let points: Vec<[i32; 2]> = chain.points.iter().map(|point| plane.to_grid(*point)).collect();
    match recognize_arcs(&points, chain.is_closed, tolerance * plane.steps) {
        LineShape::Circle(circle) => vec![plane.to_world(circle, TAU)],
        LineShape::Arc(circle, [start, end]) => vec![plane.to_world(circle, end - start)],
        LineShape::Path(vertices, is_closed) => {
            let next = |at: usize| vertices[(at + 1) % vertices.len()].point;
            let last = if is_closed { vertices.len() } else { vertices.len() - 1 };
            let arcs = vertices[..last].iter().enumerate();
            arcs.filter_map(|(at, from)| arc_of_bulge(from, next(at)))
                .map(|(circle, sweep)| plane.to_world(circle, sweep))
                .collect()
        }
    }
}

/// Returns the circle and the angle of an arc of a polyline, or `None` for a straight segment.
fn arc_of_bulge(from: &ArcVertex, to: DVec2) -> Option<(Circle, f64)> {
    let (bulge, chord) = (from.bulge, to - from.point);
    if bulge == 0.0 {
        return None;
    }
    // The distance of the center to the left of the chord, as a fraction of the chord's length.
    let height = (1.0 - bulge * bulge) / (4.0 * bulge);
    let center = from.point + chord * 0.5 + chord.perp() * height;
    let radius = center.distance(from.point);
    Some((Circle { center, radius }, 4.0 * libm::atan(bulge.abs())))
}
