//! The welded surfaces of a scene: what is drawn of it, and what hides.

use super::classify::Classifier;
use super::crossings::crossings;
use super::gather::{Face, Shape};
use super::seams::{Border, Reach, borders, cut, weld_near};
use super::section::cut_open;
use super::sides::{Side, Sides};
use super::weld::weld_equal;
use crate::sight::Sight;
use crate::visibility::Tolerance;
use crate::{EdgeClass, Options, Subject, Warning};
use glam::DVec3;
use homog::{Plane, Point, World};

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
    fillings: Vec<Face>,
    reach: Reach,
    diagonal: f64,
    warnings: Vec<Warning>,
}

impl Surface {
    pub(crate) fn of(subject: &Subject<'_>) -> Self {
        let mut shape = Shape::of(subject);
        shape.keeps_copies = !subject.sections.is_empty();
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
        let warnings = Vec::new();
        let mut surface = Self { shape, sides, seams, fillings, reach, diagonal, warnings };
        for (number, &plane) in subject.sections.iter().enumerate() {
            surface.cut_open(plane, number as u16);
        }
        if surface.shape.keeps_copies {
            surface.shape.keeps_copies = false;
            surface.weld();
        }
        surface
    }

    /// Cuts what is there by a plane, and closes it again.
    fn cut_open(&mut self, plane: Plane<World>, number: u16) {
        let Self { shape, fillings, warnings, .. } = self;
        cut_open(shape, fillings, plane, number, warnings);
        self.weld();
    }

    /// Finds points, edges and borders anew.
    fn weld(&mut self) {
        weld_equal(&mut self.shape);
        self.sides = Sides::of(&self.shape.faces, self.shape.points.len());
        self.reach = Reach::of(&self.shape);
        (self.seams, self.fillings) = cut(&self.shape, &borders(&self.sides), &self.reach);
    }

    /// What could not be done as it should.
    pub(crate) fn warnings(&self) -> &[Warning] {
        &self.warnings
    }

    /// The triangles of the caps that close cuts, by object and section.
    pub(crate) fn caps(&self) -> Vec<(u32, Vec<[DVec3; 3]>)> {
        self.shape.caps()
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
        let corner = |corner: u32| Point::from_raw(self.shape.points[corner as usize]);
        let faces = self.shape.faces.iter().chain(&self.fillings);
        faces.map(move |face| face.corners.map(corner))
    }

    /// What hides, each face with its object and the linear colour of its surface; caps are as light as paper.
    pub(crate) fn painted(&self) -> impl Iterator<Item = ([DVec3; 3], u32, [f32; 3])> {
        let shape = &self.shape;
        shape.faces.iter().map(|face| {
            let color = shape.colors.get(face.material as usize).copied();
            let corners = face.corners.map(|corner| shape.points[corner as usize]);
            (corners, face.object, color.unwrap_or([1.0; 3]))
        })
    }

    /// The same without the caps, which have a hatching of their own.
    pub(crate) fn toned(&self) -> impl Iterator<Item = ([DVec3; 3], u32, [f32; 3])> {
        let faces = self.painted().zip(&self.shape.faces);
        faces.filter(|(_, face)| face.cap.is_none()).map(|(painted, _)| painted)
    }

    /// The edges that the options ask for, by object and in the order of their points.
    pub(crate) fn edges(
        &mut self,
        sight: &Sight,
        options: &Options,
        threads: usize,
    ) -> Vec<Candidate> {
        let (mut found, mut is_cut_off) = (Vec::new(), false);
        let mut add = |ends: [DVec3; 2], class, object| {
            if options.classes.contains(class) {
                found.push(Candidate { ends, class, object });
            }
        };
        let shape = &self.shape;
        let places = |ends: [u32; 2]| ends.map(|end| shape.points[end as usize]);
        let classifier = Classifier::of(shape, sight, options);
        for (ends, sides) in self.sides.edges().filter(|(_, sides)| sides.len() > 1) {
            add(places(ends), classifier.class(ends, sides), classifier.object(sides));
        }
        for parts in self.seams.chunk_by(|(a, _), (b, _)| a == b) {
            let sides: Vec<Side> = parts.iter().map(|(_, side)| *side).collect();
            add(
                places(parts[0].0),
                classifier.class(parts[0].0, &sides),
                classifier.object(&sides),
            );
        }
        for stroke in &shape.strokes {
            let class = if stroke.marked { EdgeClass::Marked } else { EdgeClass::Line };
            add(places(stroke.ends), class, stroke.object);
        }
        if options.classes.contains(EdgeClass::Intersection) {
            let seams = (self.seams.as_slice(), &self.reach);
            let found = crossings(shape, seams, self.tolerance().world, threads);
            is_cut_off = found.is_cut_off;
            for (ends, object) in found.crossings {
                add(ends, EdgeClass::Intersection, object);
            }
        }
        self.warnings.extend(is_cut_off.then_some(Warning::CrossingsLeftOut));
        found.sort_by_key(|candidate| candidate.object);
        found
    }
}
