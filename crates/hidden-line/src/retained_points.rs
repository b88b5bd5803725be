//! Retained points: the points of the parts that section planes retain, for framing.

use crate::Warning;
use crate::edges::WorldMesh;
use clip::{SectionPlane, cut_triangle};
use homog::{Bounds, Plane, Point, World};
use model::ModelInstance;

/// Returns the points of the model parts that section planes retain: the corners of the remaining
/// triangles, the ends of the remaining lines, and the remaining point primitives. The objects
/// listed in `uncut`, in ascending order, are retained whole. If nothing remains, all points are
/// returned.
///
/// A view that frames these points shows the cut models as large as possible.
#[must_use]
pub fn retained_points(
    models: &[ModelInstance],
    sections: &[Plane<World>],
    uncut: &[u32],
) -> Vec<Point<World>> {
    let mesh = WorldMesh::from_models(models);
    let diagonal = mesh.bounds_diagonal();
    let sections: Vec<_> =
        sections.iter().map(|plane| SectionPlane::for_size(*plane, diagonal)).collect();
    let position = |vertex: u32| Point::from_raw(mesh.points[vertex as usize]);
    let mut retained = Vec::new();
    let mut pieces: Vec<[Point<World>; 3]> = Vec::new();
    for face in &mesh.faces {
        pieces.clear();
        pieces.push(face.vertices.map(position));
        let is_cut = uncut.binary_search(&face.object).is_err();
        for plane in sections.iter().filter(|_| is_cut) {
            pieces = pieces.iter().flat_map(|piece| cut_pieces(*piece, *plane)).collect();
        }
        retained.extend(pieces.as_flattened());
    }
    for line in &mesh.line_edges {
        let is_cut = uncut.binary_search(&line.object).is_err();
        let ends = sections.iter().filter(|_| is_cut).try_fold(line.ends.map(position), cut_line);
        retained.extend(ends.into_iter().flatten());
    }
    for dot in &mesh.dots {
        let (at, is_cut) = (position(dot.point), uncut.binary_search(&dot.object).is_err());
        if !is_cut || sections.iter().all(|plane| plane.height(at) >= 0.0) {
            retained.push(at);
        }
    }
    if retained.is_empty() { model::world_points(models) } else { retained }
}

/// Returns the triangles that remain after a plane cuts a triangle.
fn cut_pieces(triangle: [Point<World>; 3], plane: SectionPlane<World>) -> Vec<[Point<World>; 3]> {
    let cut = cut_triangle(triangle, plane);
    let left = cut.vertices();
    (2..left.len()).map(|k| [left[0], left[k - 1], left[k]].map(|vertex| vertex.point)).collect()
}

/// Returns the part of a line on the positive side of a plane.
fn cut_line([a, b]: [Point<World>; 2], plane: &SectionPlane<World>) -> Option<[Point<World>; 2]> {
    let [from, to] = [a, b].map(|end| plane.height(end));
    match [from >= 0.0, to >= 0.0] {
        [true, true] => Some([a, b]),
        [false, false] => None,
        [first, _] => {
            let middle = Point::from_raw(a.raw() + (b.raw() - a.raw()) * (from / (from - to)));
            Some(if first { [a, middle] } else { [middle, b] })
        }
    }
}

/// Returns a warning for each section that does not cut the models.
pub(crate) fn idle_section_warnings(
    models: &[ModelInstance],
    sections: &[Plane<World>],
) -> Vec<Warning> {
    if sections.is_empty() {
        return Vec::new();
    }
    let points = model::world_points(models);
    let numbered = sections.iter().zip(1..);
    numbered.filter_map(|(plane, number)| idle_section_warning(&points, *plane, number)).collect()
}

/// Returns a warning if a section does not cut the models, because it removes nothing or
/// everything. Sections are numbered from 1.
pub fn idle_section_warning(
    points: &[Point<World>],
    plane: Plane<World>,
    number: usize,
) -> Option<Warning> {
    let diagonal = Bounds::from_points(points.iter().copied())?.diagonal();
    let section = SectionPlane::for_size(plane, diagonal);
    let distances = points.iter().map(|point| section.height(*point));
    let (least, most) = distances
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(least, most), d| (least.min(d), most.max(d)));
    if most <= 0.0 {
        Some(Warning::SectionRemovesAll { number })
    } else {
        (least >= 0.0).then_some(Warning::SectionMisses { number })
    }
}
