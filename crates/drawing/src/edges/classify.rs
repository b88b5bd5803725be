//! Why an edge is drawn: what the faces on its two sides do there.

use super::half_edges::HalfEdge;
use super::world_mesh::{Face, WorldMesh};
use crate::projector::Projector;
use crate::{DrawOptions, EdgeClass};
use glam::DVec3;
use model::EdgeVisibility;

/// Of each face the unit normal, and whether it looks to the viewer.
#[derive(Clone, Debug)]
struct FaceNormals(Vec<(DVec3, bool)>);

impl FaceNormals {
    fn new(shape: &WorldMesh, sight: &Projector) -> Self {
        let normal = |face: &Face| {
            let [a, b, c] = face.vertices.map(|corner| shape.points[corner as usize]);
            let normal = (b - a).cross(c - a).normalize_or_zero();
            (normal, normal.dot(sight.towards_viewer(a)) > 0.0)
        };
        Self(shape.faces.iter().map(normal).collect())
    }

    /// The normal and the look of a side's face, as if it ran along the rising edge.
    fn normal_along(&self, side: HalfEdge) -> (DVec3, bool) {
        let (normal, looks) = self.0[side.face as usize];
        if side.is_forward { (normal, looks) } else { (-normal, !looks) }
    }
}

pub(super) struct EdgeClassifier<'a> {
    faces: &'a [Face],
    /// The edges that sections made, sorted.
    section_edges: &'a [[u32; 2]],
    normals: FaceNormals,
    /// The cosine of the crease angle.
    crease_cosine: f64,
}

impl<'a> EdgeClassifier<'a> {
    pub(super) fn new(shape: &'a WorldMesh, sight: &Projector, options: &DrawOptions) -> Self {
        let normals = FaceNormals::new(shape, sight);
        Self {
            faces: &shape.faces,
            section_edges: &shape.section_edges,
            normals,
            crease_cosine: libm::cos(options.crease_angle),
        }
    }

    fn face_of_half_edge(&self, side: HalfEdge) -> &Face {
        &self.faces[side.face as usize]
    }

    /// The first of the objects that meet at an edge.
    pub(super) fn lowest_object(&self, sides: &[HalfEdge]) -> u32 {
        sides.iter().map(|&side| self.face_of_half_edge(side).object).min().unwrap_or(0)
    }

    pub(super) fn classify_edge(&self, ends: [u32; 2], sides: &[HalfEdge]) -> EdgeClass {
        if self.section_edges.binary_search(&ends).is_ok() {
            return EdgeClass::Section;
        }
        let shape = self.class_by_geometry(sides);
        let mark = |&side: &HalfEdge| {
            Some(self.face_of_half_edge(side).edge_visibility?[usize::from(side.side)])
        };
        match (sides.iter().filter_map(mark).max(), shape) {
            (None, shape) => shape,
            (Some(EdgeVisibility::Hard | EdgeVisibility::RepeatedHard), _) => EdgeClass::Marked,
            (Some(EdgeVisibility::Silhouette), EdgeClass::Silhouette) => EdgeClass::Silhouette,
            _ => EdgeClass::Facet,
        }
    }

    /// The class by the shape alone: the strongest that any object has there. Borders of two objects make a pair.
    fn class_by_geometry(&self, sides: &[HalfEdge]) -> EdgeClass {
        if let &[one, other] = sides {
            return self.class_between(one, other);
        }
        // A third face of an object makes more than a surface of it.
        let of_object = |object| {
            sides.iter().filter(move |&&side| self.face_of_half_edge(side).object == object)
        };
        let (mut class, mut unpaired) = (EdgeClass::Facet, Vec::new());
        for &side in sides {
            let mut same = of_object(self.face_of_half_edge(side).object);
            class = class.min(match (same.next(), same.next(), same.next()) {
                (Some(&one), Some(&other), None) => self.class_between(one, other),
                (Some(_), Some(_), Some(_)) => EdgeClass::Crease,
                _ => {
                    unpaired.push(side);
                    EdgeClass::Facet
                }
            });
        }
        match *unpaired {
            [] => class,
            [one, other] => class.min(self.class_between(one, other)),
            [_] => class.min(EdgeClass::Boundary),
            _ => class.min(EdgeClass::Crease),
        }
    }

    /// The class of an edge between two faces.
    fn class_between(&self, one: HalfEdge, other: HalfEdge) -> EdgeClass {
        let ((n, looks), (m, other_looks)) =
            (self.normals.normal_along(one), self.normals.normal_along(other));
        // As if both ran along the rising edge: then one of the normals of a smooth surface points inwards.
        if looks == other_looks {
            EdgeClass::Silhouette
        } else if n.dot(-m) < self.crease_cosine {
            EdgeClass::Crease
        } else if self.face_of_half_edge(one).material != self.face_of_half_edge(other).material {
            EdgeClass::Tangent
        } else {
            EdgeClass::Facet
        }
    }
}
