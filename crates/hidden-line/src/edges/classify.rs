//! Edge classification: silhouette, boundary, crease, tangent, facet, marked or section.
//!
//! ```text
//!       silhouette          crease               boundary         tangent
//!       n·v > 0 > m·v       angle(n, m) > crease one face         materials differ
//!         ╲ n               ╲n ╱m                │n               n│m
//!       ───●                 ──●──               ─●               ─●─
//!          │ m
//! ```
//!
//! Silhouettes are found from the sign of n·v in world space, in perspective and parallel
//! projection alike. On the screen, the sign would depend on rounded coordinates.

use super::half_edges::HalfEdge;
use super::world_mesh::{Face, WorldMesh};
use crate::projector::Projector;
use crate::{DrawOptions, EdgeClass};
use glam::DVec3;
use model::EdgeVisibility;

/// The unit normal of each face, and whether the face is front-facing.
#[derive(Clone, Debug)]
struct FaceNormals {
    normals: Vec<DVec3>,
    is_front: Vec<bool>,
}

impl FaceNormals {
    /// Computes the normal and the facing of every face.
    fn new(mesh: &WorldMesh, projector: &Projector) -> Self {
        let corners = |face: &Face| face.vertices.map(|vertex| mesh.points[vertex as usize]);
        let unit_normal = |face: &Face| {
            let [a, b, c] = corners(face);
            (b - a).cross(c - a).normalize_or_zero()
        };
        let normals: Vec<DVec3> = mesh.faces.iter().map(unit_normal).collect();
        let is_front = |(face, normal): (&Face, &DVec3)| {
            normal.dot(projector.towards_viewer(corners(face)[0])) > 0.0
        };
        let is_front = mesh.faces.iter().zip(&normals).map(is_front).collect();
        Self { normals, is_front }
    }

    /// Returns the normal and the facing of the face at a half-edge, both flipped if the half-edge
    /// runs backward.
    ///
    /// Both faces are thus oriented along the edge from its lower to its higher end, so a mesh with
    /// inconsistent winding is classified like any other.
    fn normal_along(&self, side: HalfEdge) -> (DVec3, bool) {
        let face = side.face() as usize;
        let (normal, is_front) = (self.normals[face], self.is_front[face]);
        if side.is_forward() { (normal, is_front) } else { (-normal, !is_front) }
    }
}

/// Classifies edges for one viewer.
pub(super) struct EdgeClassifier<'a> {
    faces: &'a [Face],
    /// The edges created by section planes, sorted.
    section_edges: &'a [[u32; 2]],
    normals: FaceNormals,
    /// The cosine of the crease angle.
    crease_cosine: f64,
    /// The cosine of the tangent angle, if set.
    tangent_cosine: Option<f64>,
    /// Whether an edge is smooth if the vertex normals on both sides agree.
    asks_normals: bool,
}

/// The cosine of the largest angle between faces that vertex normals can make smooth: 85°. Sharper
/// edges are always drawn, because exporters sometimes wrongly share the normals of a box.
const MIN_SMOOTH_COSINE: f64 = 0.0872;

impl<'a> EdgeClassifier<'a> {
    /// Creates a classifier of a mesh's edges for a viewer and drawing options.
    pub(super) fn new(mesh: &'a WorldMesh, projector: &Projector, options: &DrawOptions) -> Self {
        let normals = FaceNormals::new(mesh, projector);
        Self {
            faces: &mesh.faces,
            section_edges: &mesh.section_edges,
            normals,
            crease_cosine: libm::cos(options.crease_angle),
            tangent_cosine: options.tangent_angle.map(libm::cos),
            asks_normals: options.asks_normals,
        }
    }

    /// Returns the face at a half-edge.
    fn face_of_half_edge(&self, side: HalfEdge) -> &Face {
        &self.faces[side.face() as usize]
    }

    /// Returns the lowest index of the objects that meet at an edge; the edge is drawn as part of
    /// that object.
    pub(super) fn lowest_object(&self, sides: &[HalfEdge]) -> u32 {
        sides.iter().map(|&side| self.face_of_half_edge(side).object).min().unwrap_or(0)
    }

    /// Returns the class of an edge: section edges first, then marks in the file, then geometry.
    pub(super) fn classify_edge(&self, ends: [u32; 2], sides: &[HalfEdge]) -> EdgeClass {
        if self.section_edges.binary_search(&ends).is_ok() {
            return EdgeClass::Section;
        }
        let mesh = self.class_by_geometry(sides);
        let mark = |&side: &HalfEdge| {
            Some(self.face_of_half_edge(side).edge_visibility?[usize::from(side.side())])
        };
        match (sides.iter().filter_map(mark).max(), mesh) {
            (None, mesh) => mesh,
            (Some(EdgeVisibility::Hard | EdgeVisibility::RepeatedHard), _) => EdgeClass::Marked,
            (Some(EdgeVisibility::Silhouette), EdgeClass::Silhouette) => EdgeClass::Silhouette,
            _ => EdgeClass::Facet,
        }
    }

    /// Returns the class determined by the faces only: the most important class of any object at
    /// the edge.
    ///
    /// If there are two half-edges, it is the class between their faces. If there are more, each
    /// object is considered separately: two of its faces form a pair, three or more form a crease,
    /// and a single face is unpaired. Two unpaired faces of different objects also form a pair, so
    /// that a body modeled as several objects has no boundaries inside.
    fn class_by_geometry(&self, sides: &[HalfEdge]) -> EdgeClass {
        if let &[one, other] = sides {
            return self.class_between(one, other);
        }
        // An edge with three faces of one object is not manifold.
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

    /// Whether the vertex normals in the file are the same on both sides of an edge of one object.
    ///
    /// `cosine` is the cosine of the angle between the faces.
    fn is_smooth_by_normals(&self, one: HalfEdge, other: HalfEdge, cosine: f64) -> bool {
        let faces = [one, other].map(|side| self.face_of_half_edge(side));
        if !self.asks_normals || cosine < MIN_SMOOTH_COSINE || faces[0].object != faces[1].object {
            return false;
        }
        // The ends of a side, lower vertex first. Sides that share only a part of an edge have
        // different ends.
        let ends = |face: &Face, side: HalfEdge| {
            let (from, to) = (usize::from(side.side()), usize::from(side.side() + 1) % 3);
            let ends = [from, to].map(|k| (face.vertices[k], face.normals[k]));
            if ends[0].0 < ends[1].0 { ends } else { [ends[1], ends[0]] }
        };
        let pairs = ends(faces[0], one).into_iter().zip(ends(faces[1], other));
        pairs.into_iter().all(|((a, n), (b, m))| a == b && n.agrees_with(m))
    }

    /// Whether faces that meet at an angle with this cosine form a crease.
    fn is_crease(&self, one: HalfEdge, other: HalfEdge, cosine: f64) -> bool {
        cosine < self.crease_cosine && !self.is_smooth_by_normals(one, other, cosine)
    }

    /// Whether two consistently oriented faces of one object meet without a crease.
    pub(super) fn is_smooth_between(&self, one: HalfEdge, other: HalfEdge) -> bool {
        let [n, m] = [one, other].map(|side| self.normals.normal_along(side).0);
        let objects = [one, other].map(|side| self.face_of_half_edge(side).object);
        one.is_forward() != other.is_forward()
            && objects[0] == objects[1]
            && !self.is_crease(one, other, n.dot(-m))
    }

    /// Whether an edge is a smooth surface's silhouette, to be replaced by an interpolated contour.
    pub(super) fn is_smooth_silhouette(&self, sides: &[HalfEdge]) -> bool {
        let &[one, other] = sides else { return false };
        self.class_between(one, other) == EdgeClass::Silhouette
            && self.is_smooth_between(one, other)
    }

    /// Returns the class of the edge between two faces: silhouette, crease, tangent (materials
    /// differ, or the angle exceeds the tangent angle) or facet.
    ///
    /// Faces are oriented along the edge, so normals are opposite on a smooth surface. The cosine
    /// of the dihedral angle is thus n·(−m), and facing flags that *agree* mark a silhouette.
    fn class_between(&self, one: HalfEdge, other: HalfEdge) -> EdgeClass {
        let ((n, is_front), (m, other_is_front)) =
            (self.normals.normal_along(one), self.normals.normal_along(other));
        let cosine = n.dot(-m);
        if is_front == other_is_front {
            EdgeClass::Silhouette
        } else if self.is_crease(one, other, cosine) {
            EdgeClass::Crease
        } else if self.face_of_half_edge(one).material != self.face_of_half_edge(other).material
            || self.tangent_cosine.is_some_and(|least| cosine < least)
        {
            EdgeClass::Tangent
        } else {
            EdgeClass::Facet
        }
    }
}
