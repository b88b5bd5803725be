//! Why an edge is drawn: what the faces on its two sides do there.

use super::gather::{Face, Shape};
use super::sides::Side;
use crate::sight::Sight;
use crate::{EdgeClass, Options};
use glam::DVec3;
use model::EdgeVisibility;

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

pub(super) struct Classifier<'a> {
    faces: &'a [Face],
    /// The edges that sections made, sorted.
    cuts: &'a [[u32; 2]],
    normals: Normals,
    /// The cosine of the crease angle.
    bend: f64,
}

impl<'a> Classifier<'a> {
    pub(super) fn of(shape: &'a Shape, sight: &Sight, options: &Options) -> Self {
        let normals = Normals::of(shape, sight);
        Self { faces: &shape.faces, cuts: &shape.cuts, normals, bend: libm::cos(options.crease) }
    }

    fn face(&self, side: Side) -> &Face {
        &self.faces[side.face as usize]
    }

    /// The first of the objects that meet at an edge.
    pub(super) fn object(&self, sides: &[Side]) -> u32 {
        sides.iter().map(|&side| self.face(side).object).min().unwrap_or(0)
    }

    pub(super) fn class(&self, ends: [u32; 2], sides: &[Side]) -> EdgeClass {
        if self.cuts.binary_search(&ends).is_ok() {
            return EdgeClass::Section;
        }
        let shape = self.shape(sides);
        let mark = |&side: &Side| Some(self.face(side).marks?[usize::from(side.number)]);
        match (sides.iter().filter_map(mark).max(), shape) {
            (None, shape) => shape,
            (Some(EdgeVisibility::Hard | EdgeVisibility::RepeatedHard), _) => EdgeClass::Marked,
            (Some(EdgeVisibility::Silhouette), EdgeClass::Silhouette) => EdgeClass::Silhouette,
            _ => EdgeClass::Facet,
        }
    }

    /// The class by the shape alone: the strongest that any object has there. Borders of two objects make a pair.
    fn shape(&self, sides: &[Side]) -> EdgeClass {
        if let &[one, other] = sides {
            return self.between(one, other);
        }
        // A third face of an object makes more than a surface of it.
        let of_object =
            |object| sides.iter().filter(move |&&side| self.face(side).object == object);
        let (mut class, mut alone) = (EdgeClass::Facet, Vec::new());
        for &side in sides {
            let mut same = of_object(self.face(side).object);
            class = class.min(match (same.next(), same.next(), same.next()) {
                (Some(&one), Some(&other), None) => self.between(one, other),
                (Some(_), Some(_), Some(_)) => EdgeClass::Crease,
                _ => {
                    alone.push(side);
                    EdgeClass::Facet
                }
            });
        }
        match *alone {
            [] => class,
            [one, other] => class.min(self.between(one, other)),
            [_] => class.min(EdgeClass::Boundary),
            _ => class.min(EdgeClass::Crease),
        }
    }

    /// The class of an edge between two faces.
    fn between(&self, one: Side, other: Side) -> EdgeClass {
        let ((n, looks), (m, other_looks)) = (self.normals.beside(one), self.normals.beside(other));
        // As if both ran along the rising edge: then one of the normals of a smooth surface points inwards.
        if looks == other_looks {
            EdgeClass::Silhouette
        } else if n.dot(-m) < self.bend {
            EdgeClass::Crease
        } else if self.face(one).material != self.face(other).material {
            EdgeClass::Tangent
        } else {
            EdgeClass::Facet
        }
    }
}
