//! Seams: borders of surfaces that only look like borders, because the file does not say that they belong together.
//!
//! ```text
//!   ●───────●───────●   Three faces above, two below: no side of the upper ones is a side of the lower ones. Cut at each
//!   ●────●─────●────●   other's vertices they are (T-junctions).
//! ```
//! Only borders are looked at, so that closed surfaces stay as they are, however fine.

use super::gather::{Face, Shape};
use super::sides::{Side, Sides};
use super::weld::renumber;
use crate::visibility::{Aabb, Bvh};
use glam::DVec3;

/// Points of borders nearer than this are one, in diagonals of the smaller of their objects: what quantisation to 12 bits
/// may part.
pub(super) const NEAR: f64 = 1.0 / 4096.0;

/// An edge that one face alone has, or a part of it.
pub(super) type Border = ([u32; 2], Side);

/// Of each point the greatest distance at which it may be one with another.
#[derive(Clone, Debug)]
pub(super) struct Reach(Vec<f64>);

impl Reach {
    pub(super) fn of(shape: &Shape) -> Self {
        let mut boxes = vec![Aabb::NONE; shape.objects.len()];
        let corners = || shape.faces.iter().flat_map(|f| f.corners.map(|c| (c as usize, f.object)));
        for (corner, object) in corners() {
            let bounds = &mut boxes[object as usize];
            *bounds = bounds.union(Aabb::around([shape.points[corner]]));
        }
        let mut reach = vec![f64::INFINITY; shape.points.len()];
        for (corner, object) in corners() {
            let bounds = boxes[object as usize];
            reach[corner] = reach[corner].min((bounds.max - bounds.min).length() * NEAR);
        }
        Self(reach)
    }

    /// The lesser of those of two ends.
    pub(super) fn of_edge(&self, [a, b]: [u32; 2]) -> f64 {
        self.0[a as usize].min(self.0[b as usize])
    }
}

/// The edges that one face alone has.
pub(super) fn borders(sides: &Sides) -> Vec<Border> {
    let alone = sides.edges().filter(|(_, sides)| sides.len() == 1);
    alone.map(|(ends, sides)| (ends, sides[0])).collect()
}

/// Makes points of borders that nearly coincide one. True if there were any.
pub(super) fn weld_near(shape: &mut Shape, borders: &[Border], reach: &Reach) -> bool {
    let points = points_of(borders);
    let places: Vec<Aabb> =
        points.iter().map(|&at| Aabb::around([shape.points[at as usize]])).collect();
    let tree = Bvh::new(&places, surface);
    let mut same: Vec<u32> = (0..shape.points.len() as u32).collect();
    let mut is_taken = vec![false; points.len()];
    let mut open = Vec::new();
    let mut any = false;
    for (number, &at) in points.iter().enumerate() {
        if is_taken[number] {
            continue;
        }
        let (here, far) = (places[number].min, reach.0[at as usize]);
        let area = places[number].grown(DVec3::splat(far));
        tree.for_each_near(&area, usize::MAX, &mut open, |item| {
            let other = points[item as usize];
            let near = far.min(reach.0[other as usize]);
            let is_near = (places[item as usize].min - here).length() <= near;
            if item as usize > number && !is_taken[item as usize] && is_near {
                is_taken[item as usize] = true;
                same[other as usize] = at;
                any = true;
            }
        });
    }
    if any {
        renumber(shape, &same);
    }
    any
}

/// Cuts borders at points of other borders that lie on them; and the triangles between each border and its parts, which have
/// a width where the points lie on it but for rounding.
pub(super) fn cut(shape: &Shape, borders: &[Border], reach: &Reach) -> (Vec<Border>, Vec<Face>) {
    let points = points_of(borders);
    let place = |at: u32| shape.points[at as usize];
    let places: Vec<Aabb> = points.iter().map(|&at| Aabb::around([place(at)])).collect();
    let tree = Bvh::new(&places, surface);
    let (mut open, mut cuts) = (Vec::new(), Vec::new());
    let most = Bvh::fair_share(borders.len());
    let (mut parts, mut fillings) = (Vec::with_capacity(borders.len()), Vec::new());
    for &([a, b], side) in borders {
        let (from, along) = (place(a), place(b) - place(a));
        let near = reach.of_edge([a, b]);
        cuts.clear();
        let area = Aabb::around([place(a), place(b)]).grown(DVec3::splat(near));
        tree.for_each_near(&area, most, &mut open, |item| {
            let (at, offset) = (points[item as usize], places[item as usize].min - from);
            let t = offset.dot(along) / along.length_squared();
            let is_on = t > 0.0 && t < 1.0 && (offset - along * t).length() <= near;
            if at != a && at != b && is_on {
                cuts.push((t, at));
            }
        });
        cuts.sort_unstable_by(|x, y| x.0.total_cmp(&y.0).then(x.1.cmp(&y.1)));
        let turns =
            cuts.iter().map(|&(_, at)| at).zip(cuts.iter().skip(1).map(|&(_, at)| at).chain([b]));
        let face = shape.faces[side.face as usize];
        let filling = |(from, to)| Face { corners: [a, from, to], ..face };
        fillings.extend(turns.map(filling));
        let stops = cuts.iter().map(|&(_, at)| at).chain([b]);
        parts.extend(stops.scan(a, |from, to| Some(part([std::mem::replace(from, to), to], side))));
    }
    parts.sort_unstable();
    (parts, fillings)
}

/// A part of a rising edge as an edge of its own.
fn part([from, to]: [u32; 2], side: Side) -> Border {
    let rises = side.rises == (from < to);
    ([from.min(to), from.max(to)], Side { high: from.max(to), rises, ..side })
}

fn points_of(borders: &[Border]) -> Vec<u32> {
    let mut points: Vec<u32> = borders.iter().flat_map(|(ends, _)| *ends).collect();
    points.sort_unstable();
    points.dedup();
    points
}

/// Half the surface of a box.
pub(super) fn surface(size: DVec3) -> f64 {
    size.x * size.y + size.y * size.z + size.z * size.x
}
