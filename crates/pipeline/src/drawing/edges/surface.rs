//! The welded surfaces of a scene: what is drawn of it, and what hides.

use super::classify::Classifier;
use super::crossings::crossings;
use super::gather::Shape;
use super::seams::{Border, Reach, borders, cut, weld_near};
use super::sides::{Side, Sides};
use super::weld::weld_equal;
use crate::drawing::sight::Sight;
use crate::drawing::visibility::Tolerance;
use crate::drawing::{EdgeClass, Options};
use crate::scene::Scene;
use glam::DVec3;
use homog::{Point, World};

/// An edge to be drawn.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct Candidate {
    pub(crate) ends: [DVec3; 2],
    pub(crate) class: EdgeClass,
    pub(crate) object: u32,
}

/// The welded surfaces of a scene.
#[derive(Clone, Debug)]
pub(crate) struct Surface {
    shape: Shape,
    sides: Sides,
    /// Edges that one face alone has, cut where others begin, so that parts of several may be the same.
    seams: Vec<Border>,
    /// Triangles that close the gaps beside edges that were cut.
    fillings: Vec<[u32; 3]>,
    reach: Reach,
    diagonal: f64,
}

impl Surface {
    pub(crate) fn of(scene: &Scene) -> Self {
        let mut shape = Shape::of(scene);
        weld_equal(&mut shape);
        let mut sides = Sides::of(&shape.faces, shape.points.len());
        let mut seams = borders(&sides);
        let reach = Reach::of(&shape);
        if weld_near(&mut shape, &seams, &reach) {
            sides = Sides::of(&shape.faces, shape.points.len());
            seams = borders(&sides);
        }
        let (seams, fillings) = cut(&shape, &seams, &reach);
        let diagonal = shape.diagonal();
        Self { shape, sides, seams, fillings, reach, diagonal }
    }

    /// How near is touching on these surfaces.
    pub(crate) fn tolerance(&self) -> Tolerance {
        Tolerance::of_scene(self.diagonal)
    }

    /// The names of the objects.
    pub(crate) fn into_objects(self) -> Vec<String> {
        self.shape.objects
    }

    /// What hides, as triangles of the world.
    pub(crate) fn triangles(&self) -> impl Iterator<Item = [Point<World>; 3]> {
        let faces = self.shape.faces.iter().map(|face| face.corners);
        let corner = |corner: u32| Point::from_raw(self.shape.points[corner as usize]);
        faces.chain(self.fillings.iter().copied()).map(move |corners| corners.map(corner))
    }

    /// The edges that the options ask for, by object and in the order of their points.
    pub(crate) fn edges(&self, sight: &Sight, options: &Options, threads: usize) -> Vec<Candidate> {
        let mut found = Vec::new();
        let mut add = |ends: [DVec3; 2], class, object| {
            if options.classes.contains(class) {
                found.push(Candidate { ends, class, object });
            }
        };
        let shape = &self.shape;
        let places = |ends: [u32; 2]| ends.map(|end| shape.points[end as usize]);
        let classifier = Classifier::of(shape, sight, options);
        for (ends, sides) in self.sides.edges().filter(|(_, sides)| sides.len() > 1) {
            add(places(ends), classifier.class(sides), classifier.object(sides));
        }
        for parts in self.seams.chunk_by(|(a, _), (b, _)| a == b) {
            let sides: Vec<Side> = parts.iter().map(|(_, side)| *side).collect();
            add(places(parts[0].0), classifier.class(&sides), classifier.object(&sides));
        }
        for stroke in &shape.strokes {
            let class = if stroke.marked { EdgeClass::Marked } else { EdgeClass::Line };
            add(places(stroke.ends), class, stroke.object);
        }
        if options.classes.contains(EdgeClass::Intersection) {
            let seams = (self.seams.as_slice(), &self.reach);
            for (ends, object) in crossings(shape, seams, self.tolerance().world, threads) {
                add(ends, EdgeClass::Intersection, object);
            }
        }
        found.sort_by_key(|candidate| candidate.object);
        found
    }
}
