//! Why an edge is drawn: what the faces on its two sides do there.

use super::gather::{Face, Shape};
use super::sides::{Side, Sides};
use super::weld::weld_equal;
use crate::drawing::sight::Sight;
use crate::drawing::{EdgeClass, Options};
use crate::model::EdgeVisibility;
use glam::DVec3;

/// An edge to be drawn.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct Candidate {
    pub(crate) ends: [DVec3; 2],
    pub(crate) class: EdgeClass,
    pub(crate) object: u32,
}

/// Welds the shape and finds the edges that the options ask for, by object and in the order of their points.
pub(crate) fn candidates(shape: &mut Shape, sight: &Sight, options: &Options) -> Vec<Candidate> {
    weld_equal(shape);
    let normals = Normals::of(shape, sight);
    let sides = Sides::of(&shape.faces, shape.points.len());
    let mut found = Vec::new();
    let mut add = |ends: [u32; 2], class, object| {
        if options.classes.contains(class) {
            let ends = ends.map(|end| shape.points[end as usize]);
            found.push(Candidate { ends, class, object });
        }
    };
    let classifier =
        Classifier { faces: &shape.faces, normals: &normals, bend: libm::cos(options.crease) };
    for (ends, sides) in sides.edges() {
        let object = sides.iter().map(|side| shape.faces[side.face as usize].object).min();
        add(ends, classifier.class(sides), object.unwrap_or(0));
    }
    for stroke in &shape.strokes {
        let class = if stroke.marked { EdgeClass::Marked } else { EdgeClass::Line };
        add(stroke.ends, class, stroke.object);
    }
    found.sort_by_key(|candidate| candidate.object);
    found
}

/// Of each face the unit normal, and whether it looks to the viewer.
#[derive(Clone, Debug)]
struct Normals(Vec<(DVec3, bool)>);

impl Normals {
    fn of(shape: &Shape, sight: &Sight) -> Self {
        let normal = |face: &Face| {
            let [a, b, c] = face.corners.map(|corner| shape.points[corner as usize]);
            let normal = (b - a).cross(c - a).normalize_or_zero();
            (normal, normal.dot(sight.towards_viewer(a)) > 0.0)
        };
        Self(shape.faces.iter().map(normal).collect())
    }

    /// The normal and the look of a side's face, as if it ran along the rising edge.
    fn beside(&self, side: Side) -> (DVec3, bool) {
        let (normal, looks) = self.0[side.face as usize];
        if side.rises { (normal, looks) } else { (-normal, !looks) }
    }
}

struct Classifier<'a> {
    faces: &'a [Face],
    normals: &'a Normals,
    /// The cosine of the crease angle.
    bend: f64,
}

impl Classifier<'_> {
    fn class(&self, sides: &[Side]) -> EdgeClass {
        let shape = self.shape(sides);
        let marks = sides.iter().filter_map(|side| {
            Some(self.faces[side.face as usize].marks?[usize::from(side.number)])
        });
        match (marks.max(), shape) {
            (None, shape) => shape,
            (Some(EdgeVisibility::Hard | EdgeVisibility::RepeatedHard), _) => EdgeClass::Marked,
            (Some(EdgeVisibility::Silhouette), EdgeClass::Silhouette) => EdgeClass::Silhouette,
            _ => EdgeClass::Facet,
        }
    }

    /// The class by the shape alone.
    fn shape(&self, sides: &[Side]) -> EdgeClass {
        let &[one, other] = sides else {
            return if sides.len() == 1 { EdgeClass::Boundary } else { EdgeClass::Crease };
        };
        let ((n, looks), (m, other_looks)) = (self.normals.beside(one), self.normals.beside(other));
        // Seen along the same direction of the edge, the faces of a surface run against each other: m is the other's
        // outer normal turned inwards.
        if looks == other_looks {
            EdgeClass::Silhouette
        } else if n.dot(-m) < self.bend {
            EdgeClass::Crease
        } else {
            EdgeClass::Facet
        }
    }
}
