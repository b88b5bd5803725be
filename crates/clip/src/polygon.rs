//! Clipping of convex polygons with any number of corners (CL-3).

use crate::sutherland_hodgman::{RingStep, clip_ring, safe_scale, unscaled};
use crate::{Outcode, PlaneOutcomes, Volume};
use alloc::vec::Vec;
use glam::DVec4;
use homog::{Clip, HPoint};

/// The visible part of a convex polygon: a convex polygon of the same winding, or nothing.
///
/// # Guarantees
/// See [`crate::ClippedPolygon`].
#[derive(Clone, PartialEq, Debug)]
pub struct ClippedConvex {
    points: Vec<HPoint<Clip>>,
    weights: Vec<f64>,
    sources: usize,
    /// The effect of each plane.
    pub outcomes: PlaneOutcomes,
}

impl ClippedConvex {
    /// Returns the vertices before the divide, in source order, or an empty slice if nothing is
    /// left.
    #[must_use]
    pub fn points(&self) -> &[HPoint<Clip>] {
        &self.points
    }

    /// Returns the weights of the source vertices in vertex `i`, which sum to 1, or `None` if the
    /// vertex does not exist.
    #[must_use]
    pub fn weights(&self, i: usize) -> Option<&[f64]> {
        self.weights.chunks_exact(self.sources.max(1)).nth(i)
    }

    /// Returns whether nothing is left.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.points.is_empty()
    }

    /// Returns the polygon as a fan of triangles around its first vertex, as vertex indices.
    pub fn triangles(&self) -> impl Iterator<Item = [usize; 3]> + use<> {
        (2..self.points.len()).map(|i| [0, i - 1, i])
    }

    fn empty(outcomes: PlaneOutcomes) -> Self {
        Self { points: Vec::new(), weights: Vec::new(), sources: 0, outcomes }
    }
}

/// Returns the part of a convex polygon inside a volume (CL-3; Sutherland and Hodgman, 1974).
///
/// Every vertex of the result comes with its source weights, for interpolating any attribute. If a
/// polygon has fewer than three vertices, or a vertex that is not finite, the result is empty.
/// Split concave polygons into convex polygons first: otherwise, a seam along the boundary would
/// join separate parts.
///
/// ```
/// use clip::{Volume, clip_convex};
/// use homog::HPoint;
/// let tile = [(0.0, 0.0), (2.0, 0.0), (2.0, 0.5), (0.0, 0.5)];
/// let tile = tile.map(|(x, y)| HPoint::new(x, y, 0.0, 1.0));
/// let left = clip_convex(&tile, &Volume::CHAPTER);
/// assert_eq!(left.points()[1], HPoint::new(1.0, 0.0, 0.0, 1.0));
/// assert_eq!(left.weights(1), Some(&[0.5, 0.5, 0.0, 0.0][..]));
/// ```
#[must_use]
pub fn clip_convex(polygon: &[HPoint<Clip>], volume: &Volume) -> ClippedConvex {
    let codes = polygon.iter().map(|&point| volume.outcode(point));
    let rejected = codes.reduce(|a, b| a & b).unwrap_or_default();
    let usable = polygon.len() >= 3 && polygon.iter().all(|point| point.is_finite());
    if !usable || !rejected.is_inside() {
        return ClippedConvex::empty(PlaneOutcomes::from_rejected(rejected));
    }
    let raw: Vec<DVec4> = polygon.iter().map(|point| point.raw()).collect();
    let scale = safe_scale(&raw);
    let mut ring = source_vertices(&raw, scale);
    let mut fates = PlaneOutcomes::default();
    for index in volume.active_planes().planes() {
        let distance = |vertex: &PolygonVertex| volume.plane_distance(index, vertex.point);
        let distances: Vec<f64> = ring.iter().map(distance).collect();
        if distances.iter().all(|&distance| distance >= 0.0) {
            continue;
        }
        ring = clip_by_plane(&ring, &distances, |crossing| volume.snap_to_plane(index, crossing));
        if ring.len() < 3 {
            fates.rejected = Outcode::INSIDE.with_plane(index);
            return ClippedConvex::empty(fates);
        }
        fates.clipped = fates.clipped.with_plane(index);
    }
    finish_polygon(ring, volume, scale, fates)
}

struct PolygonVertex {
    point: DVec4,
    weights: Vec<f64>,
}

impl PolygonVertex {
    fn lerp(&self, end: &Self, t: f64) -> Self {
        let weights = self.weights.iter().zip(&end.weights).map(|(a, b)| a + (b - a) * t).collect();
        Self { point: self.point + (end.point - self.point) * t, weights }
    }
}

fn source_vertices(raw: &[DVec4], scale: f64) -> Vec<PolygonVertex> {
    let count = raw.len();
    let unit = |i: usize| (0..count).map(|j| if i == j { 1.0 } else { 0.0 }).collect();
    let corner =
        |(i, &point): (usize, &DVec4)| PolygonVertex { point: point * scale, weights: unit(i) };
    raw.iter().enumerate().map(corner).collect()
}

fn clip_by_plane(
    ring: &[PolygonVertex],
    distances: &[f64],
    land: impl Fn(DVec4) -> DVec4,
) -> Vec<PolygonVertex> {
    let mut rest = Vec::with_capacity(ring.len() + 1);
    clip_ring(distances, |step| {
        rest.push(match step {
            RingStep::Keep(i) => {
                PolygonVertex { point: ring[i].point, weights: ring[i].weights.clone() }
            }
            RingStep::Cross { from, to, t } => {
                let crossing = ring[from].lerp(&ring[to], t);
                PolygonVertex { point: land(crossing.point), ..crossing }
            }
        });
    });
    rest
}

fn finish_polygon(
    ring: Vec<PolygonVertex>,
    volume: &Volume,
    scale: f64,
    fates: PlaneOutcomes,
) -> ClippedConvex {
    let sources = ring.first().map_or(0, |vertex| vertex.weights.len());
    let settled = |vertex: &PolygonVertex| {
        HPoint::from_raw(volume.clamp_to_box(unscaled(vertex.point, scale)))
    };
    let points: Vec<HPoint<Clip>> = ring.iter().map(settled).collect();
    if points.iter().any(|point| point.w() <= 0.0) {
        return ClippedConvex::empty(fates);
    }
    let weights = ring.into_iter().flat_map(|vertex| vertex.weights).collect();
    ClippedConvex { points, weights, sources, outcomes: fates }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{PlaneIndex, clip_triangle};

    #[test]
    fn triangles_match_clip_triangle() {
        let corners = [[-2.0, -1.5, 0.3, 1.0], [3.0, 0.0, -4.0, 1.5], [0.5, 2.0, 0.2, -0.5]]
            .map(HPoint::from);
        let (general, special) =
            (clip_convex(&corners, &Volume::CHAPTER), clip_triangle(corners, &Volume::CHAPTER));
        assert!(!general.is_empty());
        assert_eq!(general.outcomes, special.outcomes);
        for (i, vertex) in special.vertices().iter().enumerate() {
            assert_eq!(general.points()[i], vertex.point);
            assert_eq!(general.weights(i), Some(&vertex.weights[..]));
        }
        assert_eq!(general.weights(special.vertices().len()), None);
        assert_eq!(general.triangles().count(), special.triangles().count());
    }

    #[test]
    fn a_polygon_around_the_volume_is_clipped_to_a_square() {
        let ring: Vec<HPoint<Clip>> = (0..16)
            .map(|i| libm::sincos(f64::from(i) * core::f64::consts::PI / 8.0))
            .map(|(s, c)| HPoint::new(5.0 * c, 5.0 * s, 0.25, 1.0))
            .collect();
        let square = clip_convex(&ring, &Volume::CHAPTER);
        assert_eq!(square.points().len(), 4);
        assert!(
            square.points().iter().all(|p| p.x().abs() == 1.0 && p.y().abs() == 1.0),
            "{square:?}"
        );
        assert_eq!(square.outcomes.clipped, Outcode::from_bits(0b1111));
    }

    #[test]
    fn invalid_polygons_give_empty_results() {
        let p = HPoint::new(0.0, 0.0, 0.0, 1.0);
        let nan = HPoint::new(f64::NAN, 0.0, 0.0, 1.0);
        for polygon in [&[][..], &[p], &[p, p], &[p, p, nan]] {
            let nothing = clip_convex(polygon, &Volume::CHAPTER);
            assert!(nothing.is_empty() && nothing.weights(0).is_none());
        }
        let outside = [2.0, 3.0, 4.0].map(|x| HPoint::new(x, x * x, 0.0, 1.0));
        let nothing = clip_convex(&outside, &Volume::CHAPTER);
        assert!(nothing.outcomes.rejected.contains(PlaneIndex::RIGHT));
    }
}
