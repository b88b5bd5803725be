//! Welded surface: the mesh that is drawn and that hides lines, with the search for its feature
//! edges.
//!
//! ```text
//!   gather ─► weld equal ─► weld near borders ─► split T-junctions ─┐
//!                 ┌── for each section: cut, cap, weld equal ◄──────┘
//! ```
//!
//! Welding depends on the models and the section planes, not on the viewer, so one surface serves
//! every view of a drawing sheet. Edges with several half-edges are classified directly. Boundary
//! edges are classified after they are split, in runs of coincident parts.

use super::classify::EdgeClassifier;
use super::half_edges::{HalfEdge, HalfEdges};
use super::interpolated_contour::interpolated_contours;
use super::intersections::{Intersections, SearchBounds, intersect_faces};
use super::seams::{BorderEdge, WeldRadii, border_edges, split_at_t_junctions, weld_near_borders};
use super::section_cut::cut_mesh;
use super::weld::weld_equal_vertices;
use super::world_mesh::{Dot, Face, WorldMesh};
use crate::projector::Projector;
use crate::visibility::{Aabb, Bvh, DepthCover, Tolerance, TriangleMesh, mesh_bvh};
use crate::{DrawOptions, EdgeClass, EdgeClasses, SilhouetteMethod, Warning};
use clip::SectionPlane;
use glam::DVec3;
use homog::{Plane, Point, World};
use model::ModelInstance;
use raster::Workers;
use std::collections::BTreeMap;
use std::sync::OnceLock;

/// An edge to draw wherever it is visible.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct CandidateEdge {
    /// The ends in world space.
    pub(crate) ends: [DVec3; 2],
    /// The reason why it is drawn.
    pub(crate) class: EdgeClass,
    /// The object that the edge belongs to.
    pub(crate) object: u32,
}

/// The faces that close an object where a plane cuts it.
#[derive(Clone, Debug)]
pub(crate) struct SectionCap {
    pub(crate) object: u32,
    /// The section plane, whose normal points to the retained side.
    pub(crate) plane: Plane<World>,
    pub(crate) triangles: Vec<[DVec3; 3]>,
}

impl SectionCap {
    /// Whether the viewer is on the removed side. The cap is then fully visible, because nothing
    /// remains in front of it.
    pub(crate) fn faces_viewer(&self, projector: &Projector) -> bool {
        let normal = self.plane.normal().raw();
        let point = self.triangles.first().map_or(DVec3::ZERO, |[point, ..]| *point);
        normal.dot(projector.towards_viewer(point)) < 0.0
    }
}

/// The mesh of a scene after welding and section cuts, with its half-edges.
#[derive(Clone, Debug)]
pub struct WeldedSurface {
    mesh: WorldMesh,
    /// The half-edges of all faces of `mesh`.
    half_edges: HalfEdges,
    /// Boundary edges, cut at T-junctions; parts with the same ends are neighbors and count as one
    /// edge.
    border_edges: Vec<BorderEdge>,
    /// The sliver triangles at T-junctions, which hide lines but are not drawn.
    fillings: Vec<Face>,
    /// The weld radius of each point of `mesh`.
    weld_radii: WeldRadii,
    /// The diagonal of the models' bounding box before sections, so that tolerances do not depend
    /// on sections.
    diagonal: f64,
    /// The planes that cut the surface.
    sections: Vec<Plane<World>>,
    /// Warnings about sections that could not be capped.
    warnings: Vec<Warning>,
    /// The intersections of faces, found on demand, because wireframes do not need them.
    intersections: OnceLock<Intersections>,
    /// The hierarchy of the faces and fillings, built on demand.
    face_bvh: OnceLock<Bvh>,
    /// The original boxes of the objects, which determine neighbors if the objects have been moved.
    assembled_boxes: Option<BTreeMap<u32, Aabb>>,
}

impl WeldedSurface {
    /// Gathers and welds the models, and cuts them open along the section planes. The objects
    /// listed in `uncut`, in ascending order, are not cut.
    ///
    /// While bodies are being cut, coincident faces of different objects are all retained, because
    /// each body must be closed by its own faces. The final welding removes the duplicates.
    pub fn new(models: &[ModelInstance], sections: &[Plane<World>], uncut: &[u32]) -> Self {
        Self::from_mesh(WorldMesh::from_models(models), sections, uncut)
    }

    /// Like [`new`](Self::new), but for a mesh that has not been welded yet.
    pub(crate) fn from_mesh(mut mesh: WorldMesh, sections: &[Plane<World>], uncut: &[u32]) -> Self {
        mesh.uncut = uncut.to_vec();
        mesh.keeps_duplicates = !sections.is_empty();
        weld_equal_vertices(&mut mesh);
        let mut half_edges = HalfEdges::new(&mesh.faces, mesh.points.len());
        let mut borders = border_edges(&half_edges);
        let weld_radii = WeldRadii::from_mesh(&mesh);
        if weld_near_borders(&mut mesh, &borders, &weld_radii) {
            half_edges = HalfEdges::new(&mesh.faces, mesh.points.len());
            borders = border_edges(&half_edges);
        }
        let (border_edges, fillings) = split_at_t_junctions(&mesh, &borders, &weld_radii);
        let mut surface = Self {
            diagonal: mesh.bounds_diagonal(),
            mesh,
            half_edges,
            border_edges,
            fillings,
            weld_radii,
            sections: sections.to_vec(),
            warnings: Vec::new(),
            intersections: OnceLock::new(),
            face_bvh: OnceLock::new(),
            assembled_boxes: None,
        };
        for (index, &plane) in sections.iter().enumerate() {
            surface.cut_by_plane(plane, index as u16);
        }
        // Caps of several objects may coincide, so duplicates are removed only when all bodies are
        // closed.
        if surface.mesh.keeps_duplicates {
            surface.mesh.keeps_duplicates = false;
            surface.reweld();
        }
        surface
    }

    /// Records the original boxes of moved parts, one for each of the first objects. The parts are
    /// then hatched as in the assembly.
    pub fn exploded_from(self, boxes: impl Iterator<Item = Aabb>) -> Self {
        Self { assembled_boxes: Some((0..).zip(boxes).collect()), ..self }
    }

    /// Returns the box around the faces of each object, in its original position.
    pub(crate) fn part_boxes(&self) -> BTreeMap<u32, Aabb> {
        if let Some(boxes) = &self.assembled_boxes {
            return boxes.clone();
        }
        let mut boxes: BTreeMap<u32, Aabb> = BTreeMap::new();
        for (vertices, object, _) in self.colored_faces() {
            let bounds = Aabb::around_triangle(vertices);
            boxes.entry(object).and_modify(|all| *all = all.union(bounds)).or_insert(bounds);
        }
        boxes
    }

    /// Cuts the mesh with a section plane, caps it, and welds it again.
    fn cut_by_plane(&mut self, plane: Plane<World>, index: u16) {
        let Self { mesh, fillings, warnings, diagonal, .. } = self;
        let plane = SectionPlane::for_size(plane, *diagonal);
        cut_mesh(mesh, fillings, plane, index, warnings);
        self.reweld();
    }

    /// Welds equal vertices, and finds half-edges and boundaries again. Near welding is not
    /// repeated.
    fn reweld(&mut self) {
        weld_equal_vertices(&mut self.mesh);
        self.half_edges = HalfEdges::new(&self.mesh.faces, self.mesh.points.len());
        self.weld_radii = WeldRadii::from_mesh(&self.mesh);
        (self.border_edges, self.fillings) =
            split_at_t_junctions(&self.mesh, &border_edges(&self.half_edges), &self.weld_radii);
    }

    /// Returns the warnings about sections that could not be capped.
    pub(crate) fn warnings(&self) -> &[Warning] {
        &self.warnings
    }

    /// Returns the section caps, by object and section plane.
    pub(crate) fn section_caps(&self) -> Vec<SectionCap> {
        let caps = self.mesh.section_caps().into_iter();
        caps.map(|(object, section, triangles)| SectionCap {
            object,
            plane: self.sections[usize::from(section)],
            triangles,
        })
        .collect()
    }

    /// Whether section planes cut the surface.
    pub(crate) const fn is_cut(&self) -> bool {
        !self.sections.is_empty()
    }

    /// Returns the tolerances of hidden-line removal for a scene of this size.
    pub fn touch_tolerance(&self) -> Tolerance {
        Tolerance::for_scene(self.diagonal)
    }

    /// Returns the mesh.
    pub(crate) const fn mesh(&self) -> &WorldMesh {
        &self.mesh
    }

    /// Returns the diagonal of the models' bounding box before sections.
    pub(crate) const fn diagonal(&self) -> f64 {
        self.diagonal
    }

    /// Calls `visit` with every edge and its half-edges; boundaries are split at T-junctions.
    pub(super) fn for_each_edge(&self, mut visit: impl FnMut([u32; 2], &[HalfEdge])) {
        for (ends, sides) in self.half_edges.edges().filter(|(_, sides)| sides.len() > 1) {
            visit(ends, sides);
        }
        for parts in self.border_edges.chunk_by(|(a, _), (b, _)| a == b) {
            let sides: Vec<HalfEdge> = parts.iter().map(|(_, side)| *side).collect();
            visit(parts[0].0, &sides);
        }
    }

    /// Returns the object names.
    pub fn object_names(&self) -> &[String] {
        &self.mesh.objects
    }

    /// Returns all triangles that hide lines, including slivers, in world space.
    pub fn occluder_triangles(&self) -> impl Iterator<Item = [Point<World>; 3]> {
        let position = |vertex: u32| Point::from_raw(self.mesh.points[vertex as usize]);
        let faces = self.mesh.faces.iter().chain(&self.fillings);
        faces.map(move |face| face.vertices.map(position))
    }

    /// Returns each face with its object and the linear color of its material; caps are white, like
    /// paper.
    pub(crate) fn colored_faces(&self) -> impl Iterator<Item = ([DVec3; 3], u32, [f32; 3])> {
        let mesh = &self.mesh;
        mesh.faces.iter().map(|face| {
            let color = mesh.colors.get(face.material as usize).copied();
            let vertices = face.vertices.map(|vertex| mesh.points[vertex as usize]);
            (vertices, face.object, color.unwrap_or([1.0; 3]))
        })
    }

    /// Returns each face with the linear color of its material, or `None` for section caps.
    pub fn faces_with_colors(&self) -> impl Iterator<Item = ([DVec3; 3], Option<[f32; 3]>)> {
        let faces = self.colored_faces().zip(&self.mesh.faces);
        faces.map(|((vertices, _, color), face)| {
            (vertices, face.cap_section.is_none().then_some(color))
        })
    }

    /// Returns the faces other than section caps, which have their own hatching.
    pub(crate) fn colored_faces_without_caps(
        &self,
    ) -> impl Iterator<Item = ([DVec3; 3], u32, [f32; 3])> {
        let faces = self.colored_faces().zip(&self.mesh.faces);
        faces.filter(|(_, face)| face.cap_section.is_none()).map(|(colored, _)| colored)
    }

    /// Frees the half-edges, which are needed only to find edges.
    pub(crate) fn forget_half_edges(&mut self) {
        self.half_edges = HalfEdges::default();
    }

    /// Returns the candidate edges of the requested classes for one viewer, except intersections
    /// and hatching.
    ///
    /// The viewer affects only silhouettes, but their test runs over all faces: O(faces + edges).
    pub(crate) fn mesh_edges(
        &self,
        projector: &Projector,
        options: &DrawOptions,
    ) -> Vec<CandidateEdge> {
        let mesh = &self.mesh;
        let mut candidates = Vec::new();
        let mut add_candidate = |ends: [u32; 2], class, object| {
            if options.classes.contains(class) {
                let ends = ends.map(|end| mesh.points[end as usize]);
                candidates.push(CandidateEdge { ends, class, object });
            }
        };
        let classifier = EdgeClassifier::new(mesh, projector, options);
        let mut classify = |ends: [u32; 2], sides: &[HalfEdge]| {
            let class = classifier.classify_edge(ends, sides);
            add_candidate(ends, class, classifier.lowest_object(sides));
        };
        let interpolates = options.silhouettes == SilhouetteMethod::Interpolated;
        self.for_each_edge(|ends, sides| {
            if !(interpolates && classifier.is_smooth_silhouette(sides)) {
                classify(ends, sides);
            }
        });
        // Without faces, only lines and points can be drawn, so their classes are always drawn.
        let is_bare = mesh.faces.is_empty();
        let classes = if is_bare { EdgeClasses::ALL } else { options.classes };
        for line in &mesh.line_edges {
            let class = if line.is_marked { EdgeClass::Marked } else { EdgeClass::Line };
            if classes.contains(class) {
                let ends = line.ends.map(|end| mesh.points[end as usize]);
                candidates.push(CandidateEdge { ends, class, object: line.object });
            }
        }
        if classes.contains(EdgeClass::Line) {
            candidates.extend(dot_edges(mesh, projector));
        }
        let class = EdgeClass::Silhouette;
        if interpolates && options.classes.contains(class) {
            let contours = interpolated_contours(mesh, &self.half_edges, &classifier, projector);
            let candidate = |(ends, object)| CandidateEdge { ends, class, object };
            candidates.extend(contours.into_iter().map(candidate));
        }
        candidates
    }

    /// Adds the edges where faces intersect, if requested, and returns `true` if some are missing
    /// because there are too many.
    ///
    /// If the cover of a view is passed, intersections that it hides are skipped. They make no
    /// difference in a single view with hidden lines removed.
    pub(crate) fn add_intersections(
        &self,
        candidates: &mut Vec<CandidateEdge>,
        options: &DrawOptions,
        cover: Option<&DepthCover>,
        workers: Workers<'_>,
    ) -> bool {
        if !options.classes.contains(EdgeClass::Intersection) {
            return false;
        }
        let of_view;
        let is_unlimited = options.is_unlimited;
        let Intersections { segments, is_cut_off } = match cover {
            Some(_) => {
                of_view = self.find_intersections(cover, is_unlimited, workers);
                &of_view
            }
            None => {
                let find = || self.find_intersections(None, is_unlimited, workers);
                self.intersections.get_or_init(find)
            }
        };
        let class = EdgeClass::Intersection;
        let edge = |&(ends, object): &_| CandidateEdge { ends, class, object };
        candidates.extend(segments.iter().map(edge));
        *is_cut_off
    }

    /// Finds the intersections of faces. The number of threads does not affect the result.
    fn find_intersections(
        &self,
        cover: Option<&DepthCover>,
        is_unlimited: bool,
        workers: Workers<'_>,
    ) -> Intersections {
        let touching = self.touch_tolerance().world;
        let bounds = SearchBounds { touching, cover, is_unlimited };
        let (borders, weld_radii) = (self.border_edges.as_slice(), &self.weld_radii);
        intersect_faces(&self.mesh, self.face_bvh(), borders, weld_radii, bounds, workers)
    }

    /// Computes the depths behind which nothing of the surface is visible.
    pub(crate) fn depth_cover(&self, projector: Projector, size: [u32; 2]) -> DepthCover {
        let faces = self.occluder_triangles().map(|corners| corners.map(Point::raw));
        DepthCover::new(faces, projector, size, &self.touch_tolerance())
    }

    /// Computes the depths behind which nothing of a crowd of faces is visible, up to gaps of a few
    /// pixels, or returns `None` if the faces are not a crowd.
    pub(crate) fn crowd_cover(&self, projector: Projector, size: [u32; 2]) -> Option<DepthCover> {
        DepthCover::of_crowd(
            || self.occluder_triangles().map(|corners| corners.map(Point::raw)),
            projector,
            size,
        )
    }

    /// Returns the parts of the occluding triangles that a cover does not hide, each with the index
    /// of its triangle.
    pub(crate) fn visible_parts(&self, cover: &DepthCover) -> (Vec<[DVec3; 3]>, Vec<u32>) {
        let (mut parts, mut triangles) = (Vec::new(), Vec::new());
        for (triangle, corners) in (0..).zip(self.occluder_triangles()) {
            cover.add_visible_parts(corners.map(Point::raw), &mut parts);
            triangles.resize(parts.len(), triangle);
        }
        (parts, triangles)
    }

    /// Returns an occluding triangle by its index: the faces come first, then the fillings.
    fn face_or_filling(&self, triangle: u32) -> &Face {
        let (triangle, count) = (triangle as usize, self.mesh.faces.len());
        self.mesh.faces.get(triangle).unwrap_or_else(|| &self.fillings[triangle - count])
    }

    /// Returns the hierarchy of the occluding triangles, that is, of the faces and the fillings.
    pub(crate) fn face_bvh(&self) -> &Bvh {
        self.face_bvh.get_or_init(|| mesh_bvh(self))
    }
}

/// Returns the strokes that represent points: horizontal in the picture and two pixels long.
fn dot_edges(mesh: &WorldMesh, projector: &Projector) -> Vec<CandidateEdge> {
    let screen_to_world = projector.world_to_screen().inverse();
    let stroke = |dot: &Dot| {
        let center = projector.world_to_clip_point(mesh.points[dot.point as usize]);
        let screen = projector.project_to_screen(center)?;
        let ends = [screen - DVec3::X, screen + DVec3::X];
        let ends = ends.map(|end| screen_to_world.project_point3(end));
        let edge = CandidateEdge { ends, class: EdgeClass::Line, object: dot.object };
        ends.iter().all(|end| end.is_finite()).then_some(edge)
    };
    mesh.dots.iter().filter_map(stroke).collect()
}

/// All occluding triangles: the faces, then the slivers at T-junctions.
impl TriangleMesh for WeldedSurface {
    fn triangle_count(&self) -> u32 {
        (self.mesh.faces.len() + self.fillings.len()) as u32
    }

    fn vertex_count(&self) -> u32 {
        self.mesh.points.len() as u32
    }

    fn vertex_indices(&self, triangle: u32) -> [u32; 3] {
        self.face_or_filling(triangle).vertices
    }

    fn position(&self, vertex: u32) -> DVec3 {
        self.mesh.points[vertex as usize]
    }

    fn object(&self, triangle: u32) -> u32 {
        self.face_or_filling(triangle).object
    }
}
