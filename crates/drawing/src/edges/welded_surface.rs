//! Welded surface: the mesh that is drawn and that hides, and the search for its feature edges.
//!
//! Welding depends on the models and the section planes and not on the viewer, so one surface
//! serves every view of a drawing sheet.

use super::classify::EdgeClassifier;
use super::half_edges::{HalfEdge, HalfEdges};
use super::intersections::intersect_faces;
use super::seams::{BorderEdge, WeldRadii, border_edges, split_at_t_junctions, weld_near_borders};
use super::section_cut::cut_mesh;
use super::weld::weld_equal_vertices;
use super::world_mesh::{Face, WorldMesh};
use crate::hidden_line::Tolerance;
use crate::projector::Projector;
use crate::{DrawOptions, EdgeClass, Subject, Warning};
use glam::DVec3;
use homog::{Plane, Point, World};

/// An edge that will be drawn as far as it is visible.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct CandidateEdge {
    /// In world space.
    pub(crate) ends: [DVec3; 2],
    /// Why it is drawn.
    pub(crate) class: EdgeClass,
    /// The object it belongs to.
    pub(crate) object: u32,
}

/// The mesh of a scene after welding and section cuts, with its half-edges.
#[derive(Clone, Debug)]
pub(crate) struct WeldedSurface {
    mesh: WorldMesh,
    /// Of all faces of `mesh`.
    half_edges: HalfEdges,
    /// Boundary edges, cut at T-junctions; parts with equal ends are neighbors and count as one
    /// edge.
    border_edges: Vec<BorderEdge>,
    /// The sliver triangles at T-junctions: they hide, but are not drawn.
    fillings: Vec<Face>,
    /// Of each point of `mesh`.
    weld_radii: WeldRadii,
    /// The diagonal of the models' bounding box before sections, so that tolerances do not depend
    /// on them.
    diagonal: f64,
    /// Sections that could not be capped, and searches that were cut off.
    warnings: Vec<Warning>,
}

impl WeldedSurface {
    /// Gathers, welds and cuts the models of a subject; its camera plays no part.
    pub(crate) fn from_subject(subject: &Subject<'_>) -> Self {
        let mut shape = WorldMesh::from_subject(subject);
        shape.keeps_duplicates = !subject.sections.is_empty();
        weld_equal_vertices(&mut shape);
        let mut sides = HalfEdges::new(&shape.faces, shape.points.len());
        let mut seams = border_edges(&sides);
        let reach = WeldRadii::from_mesh(&shape);
        if weld_near_borders(&mut shape, &seams, &reach) {
            sides = HalfEdges::new(&shape.faces, shape.points.len());
            seams = border_edges(&sides);
        }
        let (seams, fillings) = split_at_t_junctions(&shape, &seams, &reach);
        let diagonal = shape.bounds_diagonal();
        let warnings = Vec::new();
        let mut surface = Self {
            mesh: shape,
            half_edges: sides,
            border_edges: seams,
            fillings,
            weld_radii: reach,
            diagonal,
            warnings,
        };
        for (number, &plane) in subject.sections.iter().enumerate() {
            surface.cut_by_plane(plane, number as u16);
        }
        if surface.mesh.keeps_duplicates {
            surface.mesh.keeps_duplicates = false;
            surface.reweld();
        }
        surface
    }

    /// Cuts the mesh by a section plane, caps it, and welds it again.
    fn cut_by_plane(&mut self, plane: Plane<World>, number: u16) {
        let Self { mesh: shape, fillings, warnings, .. } = self;
        cut_mesh(shape, fillings, plane, number, warnings);
        self.reweld();
    }

    /// Welds equal vertices, and finds half-edges and boundaries anew. Near welding is not
    /// repeated.
    fn reweld(&mut self) {
        weld_equal_vertices(&mut self.mesh);
        self.half_edges = HalfEdges::new(&self.mesh.faces, self.mesh.points.len());
        self.weld_radii = WeldRadii::from_mesh(&self.mesh);
        (self.border_edges, self.fillings) =
            split_at_t_junctions(&self.mesh, &border_edges(&self.half_edges), &self.weld_radii);
    }

    /// What could not be drawn as it should.
    pub(crate) fn warnings(&self) -> &[Warning] {
        &self.warnings
    }

    /// The triangles of the section caps, by object and section plane.
    pub(crate) fn section_caps(&self) -> Vec<(u32, Vec<[DVec3; 3]>)> {
        self.mesh.section_caps()
    }

    /// The tolerances of hidden-line removal for the size of this scene.
    pub(crate) fn touch_tolerance(&self) -> Tolerance {
        Tolerance::for_scene(self.diagonal)
    }

    /// The names of the objects.
    pub(crate) fn into_object_names(self) -> Vec<String> {
        self.mesh.objects
    }

    /// All triangles that hide, slivers included, in world space.
    pub(crate) fn occluder_triangles(&self) -> impl Iterator<Item = [Point<World>; 3]> {
        let corner = |corner: u32| Point::from_raw(self.mesh.points[corner as usize]);
        let faces = self.mesh.faces.iter().chain(&self.fillings);
        faces.map(move |face| face.vertices.map(corner))
    }

    /// Each face with its object and the linear color of its material; caps are white like paper.
    pub(crate) fn colored_faces(&self) -> impl Iterator<Item = ([DVec3; 3], u32, [f32; 3])> {
        let shape = &self.mesh;
        shape.faces.iter().map(|face| {
            let color = shape.colors.get(face.material as usize).copied();
            let corners = face.vertices.map(|corner| shape.points[corner as usize]);
            (corners, face.object, color.unwrap_or([1.0; 3]))
        })
    }

    /// The faces without section caps, which have a hatching of their own.
    pub(crate) fn colored_faces_without_caps(
        &self,
    ) -> impl Iterator<Item = ([DVec3; 3], u32, [f32; 3])> {
        let faces = self.colored_faces().zip(&self.mesh.faces);
        faces.filter(|(_, face)| face.cap_section.is_none()).map(|(painted, _)| painted)
    }

    /// The edges of the wanted classes for one viewer, sorted by object and within an object by
    /// their vertices.
    pub(crate) fn candidate_edges(
        &mut self,
        sight: &Projector,
        options: &DrawOptions,
        threads: usize,
    ) -> Vec<CandidateEdge> {
        let (mut found, mut is_cut_off) = (Vec::new(), false);
        let mut add_candidate = |ends: [DVec3; 2], class, object| {
            if options.classes.contains(class) {
                found.push(CandidateEdge { ends, class, object });
            }
        };
        let shape = &self.mesh;
        let positions = |ends: [u32; 2]| ends.map(|end| shape.points[end as usize]);
        let classifier = EdgeClassifier::new(shape, sight, options);
        for (ends, sides) in self.half_edges.edges().filter(|(_, sides)| sides.len() > 1) {
            add_candidate(
                positions(ends),
                classifier.classify_edge(ends, sides),
                classifier.lowest_object(sides),
            );
        }
        for parts in self.border_edges.chunk_by(|(a, _), (b, _)| a == b) {
            let sides: Vec<HalfEdge> = parts.iter().map(|(_, side)| *side).collect();
            add_candidate(
                positions(parts[0].0),
                classifier.classify_edge(parts[0].0, &sides),
                classifier.lowest_object(&sides),
            );
        }
        for stroke in &shape.line_edges {
            let class = if stroke.is_marked { EdgeClass::Marked } else { EdgeClass::Line };
            add_candidate(positions(stroke.ends), class, stroke.object);
        }
        if options.classes.contains(EdgeClass::Intersection) {
            let seams = (self.border_edges.as_slice(), &self.weld_radii);
            let found = intersect_faces(shape, seams, self.touch_tolerance().world, threads);
            is_cut_off = found.is_cut_off;
            for (ends, object) in found.segments {
                add_candidate(ends, EdgeClass::Intersection, object);
            }
        }
        self.warnings.extend(is_cut_off.then_some(Warning::IntersectionsIncomplete));
        found.sort_by_key(|candidate| candidate.object);
        found
    }
}
