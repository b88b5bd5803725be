//! Section cuts: clipping of surfaces by a plane, and the caps that close them again.
//!
//! ```text
//!    ╱──╲        ╱──╲
//!   ╱    ╲  ─►  ┌────┐ caps,
//!  ╱──────╲     └────┘ hatched
//! ```
//!
//! Vertices within a tolerance of the plane are on it ([`SectionPlane`]), and the cut passes
//! through them. Without the tolerance, a plane through vertices that rounding has moved would cut
//! needles off flat walls. Their normals are noise, and they would be drawn as edges.
//!
//! Each triangle is cut separately. The cut edges are joined into loops without a tolerance,
//! because neighboring triangles are cut at identical points. Loops are capped, and a cap hides
//! everything behind it, like any other face.
//!
//! The slivers that close the gaps at T-junctions are cut like faces, so that boundaries that only
//! nearly meet also give closed loops. A curve that does not close comes from an open surface; it
//! is drawn without a cap, and a warning is added.

use super::section_caps::{SectionLoop, triangulate_caps};
use super::vertex_normal::VertexNormal;
use super::world_mesh::{Dot, Face, LineEdge, WorldMesh};
use crate::Warning;
use clip::{CutTriangle, Outline, SectionPlane, cut_triangle};
use glam::DVec3;
use homog::{Plane, Point, World};
use model::EdgeVisibility;
use std::collections::BTreeMap;

/// The edge along which the plane cuts a face, and the object of the face.
type CutEdge = ([Point<World>; 2], u32);

/// Cuts a mesh with a plane, retains the part on the positive side, and caps the openings.
///
/// 1. Each face is clipped by the plane; the edge on the plane becomes a cut edge.
/// 2. The slivers at T-junctions (`fillings`) are also clipped, so that loops close; their
///    remaining parts are dropped.
/// 3. Lines are clipped, and points on the negative side are removed.
/// 4. Cut edges are joined into loops. The loops are nested and triangulated, and the triangles
///    become faces with a `cap_section`.
///
/// New points are appended without welding; the caller welds. Open sections and overly complex
/// sections are reported in `warnings`.
pub(super) fn cut_mesh(
    mesh: &mut WorldMesh,
    fillings: &[Face],
    plane: SectionPlane<World>,
    section: u16,
    warnings: &mut Vec<Warning>,
) {
    let mut openings = Vec::new();
    let mut retained = Vec::with_capacity(mesh.faces.len());
    for face in std::mem::take(&mut mesh.faces) {
        if mesh.is_cut(face.object) {
            cut_face(mesh, &face, plane, &mut retained, &mut openings);
        } else {
            retained.push(face);
        }
    }
    let mut discarded = Vec::new();
    for face in fillings {
        if mesh.is_cut(face.object) {
            discarded.clear();
            cut_face(mesh, face, plane, &mut discarded, &mut openings);
        }
    }
    mesh.faces = retained;
    cut_line_edges(mesh, plane);
    remove_dots(mesh, plane);
    openings.sort_by_key(|(_, object)| *object);
    for &(ends, _) in &openings {
        let section_edge = ends.map(|end| add_point(mesh, end));
        mesh.section_edges.push(section_edge);
    }
    add_caps(mesh, &openings, plane.plane(), section, warnings);
}

/// Closes a cut: the loops of its edges become faces with a separate material.
///
/// Cap materials count down from `u32::MAX`, one for each section, so they differ from all other
/// materials.
fn add_caps(
    mesh: &mut WorldMesh,
    openings: &[CutEdge],
    plane: Plane<World>,
    section: u16,
    warnings: &mut Vec<Warning>,
) {
    let material = u32::MAX - u32::from(section);
    let (edge_visibility, cap_section) = (None, Some(section));
    for (object, loops) in close_loops(mesh, openings, warnings) {
        let Some(triangles) = triangulate_caps(loops, plane) else {
            let object = mesh.objects[object as usize].clone();
            warnings.push(Warning::SectionTooComplex { object });
            continue;
        };
        for triangle in triangles {
            let vertices = triangle.map(|vertex| add_point(mesh, vertex));
            mesh.faces.push(Face {
                vertices,
                object,
                material,
                normals: [VertexNormal::NONE; 3],
                edge_visibility,
                cap_section,
            });
        }
    }
}

/// Appends a point and returns its index.
fn add_point(mesh: &mut WorldMesh, point: Point<World>) -> u32 {
    mesh.points.push(point.raw());
    mesh.points.len() as u32 - 1
}

/// Cuts one face: pushes the remaining part as a fan of triangles, and the edge on the plane, if
/// any.
///
/// Retained vertices keep their indices, so that uncut neighbors still share them.
fn cut_face(
    mesh: &mut WorldMesh,
    face: &Face,
    plane: SectionPlane<World>,
    retained: &mut Vec<Face>,
    openings: &mut Vec<CutEdge>,
) {
    let vertices = face.vertices.map(|vertex| Point::from_raw(mesh.points[vertex as usize]));
    let remaining = cut_triangle(vertices, plane);
    openings.extend(remaining.edge().map(|ends| (ends, face.object)));
    let indices: Vec<u32> = remaining
        .vertices()
        .iter()
        .map(|vertex| match vertices.iter().position(|corner| *corner == vertex.point) {
            Some(corner) => face.vertices[corner],
            None => add_point(mesh, vertex.point),
        })
        .collect();
    for k in 2..indices.len() {
        let vertices = [indices[0], indices[k - 1], indices[k]];
        let edge_visibility = face.edge_visibility.map(|visibility| {
            [[0, k - 1], [k - 1, k], [k, 0]]
                .map(|side| part_edge_visibility(side, &remaining, visibility))
        });
        let normals =
            [0, k - 1, k].map(|corner| cut_normal(face, remaining.vertices()[corner].weights));
        retained.push(Face { vertices, normals, edge_visibility, ..*face });
    }
}

/// Interpolates the normal at a point of a face with barycentric weights.
fn cut_normal(face: &Face, weights: [f64; 3]) -> VertexNormal {
    if let Some(corner) = weights.iter().position(|weight| *weight == 1.0) {
        return face.normals[corner];
    }
    let Some(normals) =
        face.normals.map(VertexNormal::unpack).into_iter().collect::<Option<Vec<_>>>()
    else {
        return VertexNormal::NONE;
    };
    VertexNormal::pack(normals.iter().zip(weights).map(|(normal, weight)| *normal * weight).sum())
}

/// Returns the visibility of a side of a part, inherited from the side of the face that contains
/// it; a side created by the cut is hidden.
///
/// Barycentric weights identify the side: on a side of a triangle, the weight of the opposite
/// vertex is exactly zero.
fn part_edge_visibility(
    ends: [usize; 2],
    cut: &CutTriangle<World>,
    visibility: [EdgeVisibility; 3],
) -> EdgeVisibility {
    let weights = ends.map(|end| cut.vertices()[end].weights);
    let side = (0..3).find(|k| weights.iter().all(|weights| weights[(k + 2) % 3] == 0.0));
    side.map_or(EdgeVisibility::Hidden, |k| visibility[k])
}

/// Cuts the lines that are not sides of faces, and retains the parts on the positive side.
fn cut_line_edges(mesh: &mut WorldMesh, plane: SectionPlane<World>) {
    let lines = std::mem::take(&mut mesh.line_edges);
    for line in lines {
        let ends = line.ends.map(|end| mesh.points[end as usize]);
        let heights = ends.map(|end| plane.height(Point::from_raw(end)));
        let retained = match heights.map(|height| height >= 0.0) {
            _ if !mesh.is_cut(line.object) => line.ends,
            [true, true] => line.ends,
            [false, false] => continue,
            [first, _] => {
                let t = heights[0] / (heights[0] - heights[1]);
                let cut = add_point(mesh, Point::from_raw(ends[0] + (ends[1] - ends[0]) * t));
                if first { [line.ends[0], cut] } else { [cut, line.ends[1]] }
            }
        };
        mesh.line_edges.push(LineEdge { ends: retained, ..line });
    }
}

/// Removes the points on the negative side of a plane.
fn remove_dots(mesh: &mut WorldMesh, plane: SectionPlane<World>) {
    let dots = std::mem::take(&mut mesh.dots);
    let position = |dot: &Dot| Point::from_raw(mesh.points[dot.point as usize]);
    let is_retained = |dot: &Dot| !mesh.is_cut(dot.object) || plane.height(position(dot)) >= 0.0;
    mesh.dots = dots.into_iter().filter(is_retained).collect();
}

/// Joins cut edges into loops: first within each object, then the remaining open curves across
/// objects.
///
/// ```text
///   object 1  ┌───────        object 2  ───────┐        together  ┌──────────────┐
///             │                                │                  │              │
///             └───────                  ───────┘                  └──────────────┘
/// ```
///
/// The section of a body modeled as several objects closes only across all of them. A loop across
/// several objects is assigned to the first object that contributed to it. Each object with a curve
/// that stays open causes a warning.
fn close_loops(
    mesh: &WorldMesh,
    openings: &[CutEdge],
    warnings: &mut Vec<Warning>,
) -> Vec<(u32, Vec<SectionLoop>)> {
    let mut closed = Vec::new();
    let mut open: Vec<CutEdge> = Vec::new();
    for of_object in openings.chunk_by(|(_, a), (_, b)| a == b) {
        let object = of_object[0].1;
        let edges: Vec<_> = of_object.iter().map(|(ends, _)| *ends).collect();
        let outline = Outline::from_edges(&edges);
        open.extend(chain_segments(&outline.open).map(|ends| (ends, object)));
        closed.push((object, outline.loops));
    }
    let edges: Vec<_> = open.iter().map(|(ends, _)| *ends).collect();
    let together = Outline::from_edges(&edges);
    let key = |point: Point<World>| point.raw().to_array().map(|x| (x + 0.0).to_bits());
    let mut owners = BTreeMap::new();
    for ([start, _], object) in open {
        owners.entry(key(start)).or_insert(object);
    }
    let owner = |points: &[Point<World>]| {
        points.iter().find_map(|point| owners.get(&key(*point))).copied().unwrap_or(0)
    };
    for points in together.loops {
        closed.push((owner(&points), vec![points]));
    }
    let mut objects: Vec<u32> = together.open.iter().map(|points| owner(points)).collect();
    objects.sort_unstable();
    objects.dedup();
    warnings.extend(objects.into_iter().map(|object| {
        let object = mesh.objects[object as usize].clone();
        Warning::SectionOpen { object }
    }));
    closed
}

/// Returns the segments of open polylines.
fn chain_segments(chains: &[Vec<Point<World>>]) -> impl Iterator<Item = [Point<World>; 2]> {
    chains.iter().flat_map(|chain| chain.windows(2).map(|pair| [pair[0], pair[1]]))
}

impl WorldMesh {
    /// Returns the triangles of the section caps, by object and section plane.
    pub(crate) fn section_caps(&self) -> Vec<(u32, u16, Vec<[DVec3; 3]>)> {
        let mut capping: Vec<&Face> =
            self.faces.iter().filter(|face| face.cap_section.is_some()).collect();
        capping.sort_by_key(|face| (face.object, face.cap_section));
        let alike = capping.chunk_by(|a, b| (a.object, a.cap_section) == (b.object, b.cap_section));
        let vertices = |face: &&Face| face.vertices.map(|vertex| self.points[vertex as usize]);
        let cap = |faces: &[&Face]| {
            let section = faces[0].cap_section.unwrap_or_default();
            (faces[0].object, section, faces.iter().map(vertices).collect())
        };
        alike.map(cap).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::super::weld::weld_equal_vertices;
    use super::*;
    use homog::Normal;
    use std::f64::consts::TAU;

    /// Builds a solid of revolution from rings of points, given by radius and height, from pole to
    /// pole. The poles have radius 0.
    fn solid_of_revolution(rings: &[(f64, f64)], sides: u32) -> WorldMesh {
        let mut mesh = WorldMesh { objects: vec!["body".to_owned()], ..WorldMesh::default() };
        for (radius, height) in rings {
            mesh.points.extend((0..sides).map(|side| {
                let (sine, cosine) = libm::sincos(TAU * f64::from(side) / f64::from(sides));
                DVec3::new(radius * cosine, *height, -radius * sine)
            }));
        }
        for ring in 0..rings.len() as u32 - 1 {
            for side in 0..sides {
                let (a, b) = (ring * sides + side, ring * sides + (side + 1) % sides);
                for vertices in [[a, b, b + sides], [a, b + sides, a + sides]] {
                    let (material, marks, cap) = (0, None, None);
                    mesh.faces.push(Face {
                        vertices,
                        object: 0,
                        material,
                        normals: [VertexNormal::NONE; 3],
                        edge_visibility: marks,
                        cap_section: cap,
                    });
                }
            }
        }
        weld_equal_vertices(&mut mesh);
        mesh
    }

    /// Returns the area of the cap that a plane creates; the section must be closed.
    fn closed_cap_area(mut mesh: WorldMesh, point: [f64; 3], normal: [f64; 3]) -> f64 {
        let [x, y, z] = normal;
        let normal = Normal::new(x, y, z).normalized().expect("a direction");
        let mut warnings = Vec::new();
        let plane = Plane::through(point.into(), normal);
        cut_mesh(&mut mesh, &[], plane.into(), 0, &mut warnings);
        weld_equal_vertices(&mut mesh);
        assert!(warnings.is_empty(), "{warnings:?}");
        let caps = mesh.section_caps();
        let triangles = caps.iter().flat_map(|(.., triangles)| triangles);
        triangles.map(|[a, b, c]| (*b - *a).cross(*c - *a).length() / 2.0).sum()
    }

    const CYLINDER: [(f64, f64); 4] = [(0.0, 0.0), (2.0, 0.0), (2.0, 3.0), (0.0, 3.0)];

    /// Returns the area of a regular polygon.
    fn regular_polygon_area(radius: f64, sides: u32) -> f64 {
        0.5 * f64::from(sides) * radius * radius * libm::sin(TAU / f64::from(sides))
    }

    #[test]
    fn caps_of_a_cylinder_have_the_areas_of_its_sections() {
        let cylinder = || solid_of_revolution(&CYLINDER, 60);
        let round = closed_cap_area(cylinder(), [0.0, 1.3, 0.0], [0.0, -1.0, 0.0]);
        assert!((round - regular_polygon_area(2.0, 60)).abs() < 1e-12, "{round}");
        // The first plane contains the axis and two edges. The second plane is off the axis and
        // cuts the polygon along a chord.
        let along = closed_cap_area(cylinder(), [0.0; 3], [0.0, 0.0, 1.0]);
        assert!((along - 12.0).abs() < 1e-12, "{along}");
        let (sine, cosine) = libm::sincos(TAU / 60.0 * 5.0);
        let beside = closed_cap_area(cylinder(), [0.0, 0.0, 2.0 * sine], [0.0, 0.0, -1.0]);
        assert!((beside - 3.0 * 4.0 * cosine).abs() < 1e-9, "{beside}");
        // A section between the ends, tilted by 45°, is √2 times as large as a cross section.
        let tilted = solid_of_revolution(&[(0.0, -9.0), (2.0, -9.0), (2.0, 9.0), (0.0, 9.0)], 60);
        let tilted = closed_cap_area(tilted, [0.1, 0.2, 0.3], [1.0, 1.0, 0.0]);
        let expected = regular_polygon_area(2.0, 60) * std::f64::consts::SQRT_2;
        assert!((tilted - expected).abs() < 1e-9, "{tilted}");
    }

    #[test]
    fn caps_of_a_ball_approximate_circles() {
        let ring = |k: u32| {
            let (sine, cosine) = libm::sincos(TAU / 2.0 * (f64::from(k) / 90.0 - 0.5));
            (if k == 0 || k == 90 { 0.0 } else { cosine }, sine)
        };
        let rings: Vec<(f64, f64)> = (0..=90).map(ring).collect();
        for (height, normal) in
            [(0.0, [0.0, 1.0, 0.0]), (0.4, [0.3, 0.5, 0.7]), (-0.9, [1.0, 0.0, 0.0])]
        {
            let unit = DVec3::from(normal).normalize();
            let area =
                closed_cap_area(solid_of_revolution(&rings, 180), (unit * height).into(), normal);
            let expected = TAU / 2.0 * (1.0 - height * height);
            assert!((area / expected - 1.0).abs() < 0.01, "area {area}, expected {expected}");
        }
    }

    #[test]
    fn a_plane_that_misses_the_body_removes_nothing_or_everything() {
        let cut = |height: f64| {
            let mut mesh = solid_of_revolution(&CYLINDER, 8);
            let plane = Plane::through(Point::new(0.0, height, 0.0), Normal::new(0.0, -1.0, 0.0));
            cut_mesh(&mut mesh, &[], plane.into(), 0, &mut Vec::new());
            (mesh.faces.len(), mesh.section_edges.len())
        };
        let whole = solid_of_revolution(&CYLINDER, 8).faces.len();
        assert_eq!(cut(4.0), (whole, 0));
        assert_eq!(cut(3.0), (whole, 0));
        assert_eq!(cut(-1.0), (0, 0));
    }

    #[test]
    fn original_sides_keep_their_edge_visibility() {
        let mut mesh = solid_of_revolution(&CYLINDER, 8);
        let hard = EdgeVisibility::Hard;
        mesh.faces.iter_mut().for_each(|face| face.edge_visibility = Some([hard; 3]));
        let plane = Plane::through(Point::new(0.0, 1.0, 0.0), Normal::new(0.0, -1.0, 0.0));
        cut_mesh(&mut mesh, &[], plane.into(), 0, &mut Vec::new());
        let sides = mesh.faces.iter().filter(|face| face.cap_section.is_none());
        for face in sides {
            let marks = face.edge_visibility.expect("marks");
            for (k, mark) in marks.into_iter().enumerate() {
                let ends = [face.vertices[k], face.vertices[(k + 1) % 3]];
                let heights = ends.map(|end| mesh.points[end as usize].y);
                if heights == [1.0, 1.0] {
                    assert_eq!(mark, EdgeVisibility::Hidden);
                }
            }
            assert!(marks.contains(&hard));
        }
    }
}
