//! The welded surfaces of a scene: what is drawn of it, and what hides.

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

/// An edge to be drawn.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct CandidateEdge {
    pub(crate) ends: [DVec3; 2],
    pub(crate) class: EdgeClass,
    pub(crate) object: u32,
}

/// The welded surfaces of a scene.
#[derive(Clone, Debug)]
pub(crate) struct WeldedSurface {
    mesh: WorldMesh,
    half_edges: HalfEdges,
    /// Edges that one face alone has, cut where others begin, so that parts of several may be the same.
    border_edges: Vec<BorderEdge>,
    /// Triangles that close the gaps beside edges that were cut.
    fillings: Vec<Face>,
    weld_radii: WeldRadii,
    diagonal: f64,
    warnings: Vec<Warning>,
}

impl WeldedSurface {
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

    /// Cuts what is there by a plane, and closes it again.
    fn cut_by_plane(&mut self, plane: Plane<World>, number: u16) {
        let Self { mesh: shape, fillings, warnings, .. } = self;
        cut_mesh(shape, fillings, plane, number, warnings);
        self.reweld();
    }

    /// Finds points, edges and borders anew.
    fn reweld(&mut self) {
        weld_equal_vertices(&mut self.mesh);
        self.half_edges = HalfEdges::new(&self.mesh.faces, self.mesh.points.len());
        self.weld_radii = WeldRadii::from_mesh(&self.mesh);
        (self.border_edges, self.fillings) =
            split_at_t_junctions(&self.mesh, &border_edges(&self.half_edges), &self.weld_radii);
    }

    /// What could not be done as it should.
    pub(crate) fn warnings(&self) -> &[Warning] {
        &self.warnings
    }

    /// The triangles of the caps that close cuts, by object and section.
    pub(crate) fn section_caps(&self) -> Vec<(u32, Vec<[DVec3; 3]>)> {
        self.mesh.section_caps()
    }

    /// How near is touching on these surfaces.
    pub(crate) fn touch_tolerance(&self) -> Tolerance {
        Tolerance::for_scene(self.diagonal)
    }

    /// The names of the objects.
    pub(crate) fn into_object_names(self) -> Vec<String> {
        self.mesh.objects
    }

    /// What hides, as triangles of the world.
    pub(crate) fn occluder_triangles(&self) -> impl Iterator<Item = [Point<World>; 3]> {
        let corner = |corner: u32| Point::from_raw(self.mesh.points[corner as usize]);
        let faces = self.mesh.faces.iter().chain(&self.fillings);
        faces.map(move |face| face.vertices.map(corner))
    }

    /// What hides, each face with its object and the linear colour of its surface; caps are as light as paper.
    pub(crate) fn colored_faces(&self) -> impl Iterator<Item = ([DVec3; 3], u32, [f32; 3])> {
        let shape = &self.mesh;
        shape.faces.iter().map(|face| {
            let color = shape.colors.get(face.material as usize).copied();
            let corners = face.vertices.map(|corner| shape.points[corner as usize]);
            (corners, face.object, color.unwrap_or([1.0; 3]))
        })
    }

    /// The same without the caps, which have a hatching of their own.
    pub(crate) fn colored_faces_without_caps(
        &self,
    ) -> impl Iterator<Item = ([DVec3; 3], u32, [f32; 3])> {
        let faces = self.colored_faces().zip(&self.mesh.faces);
        faces.filter(|(_, face)| face.cap_section.is_none()).map(|(painted, _)| painted)
    }

    /// The edges that the options ask for, by object and in the order of their points.
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
