//! Drawing of a subject: candidate edges, hatching and hidden-line removal.
//!
//! ```text
//!   models, sections ─► WeldedSurface          (once, for every view)
//!                           │
//!       ┌───────────────────┼───────────────────┐
//!       ▼                   ▼                   ▼
//!   candidate edges     hatch lines         occluders
//!       └─────────┬─────────┘                   │
//!                 ▼                             │
//!            EdgeDivider ◄──────────────────────┘
//!                 ▼
//!   visible and hidden segments = LineDrawing
//! ```
//!
//! The surface depends only on models and sections; everything below it also depends on the viewer.
//! Edges keep the order of their objects, so drawings are reproducible and file diffs are small.

use super::edges::{CandidateEdge, SectionCap, WeldedSurface, WorldMesh};
use super::hatching::{FaceHatching, Hatching};
use super::options::{DrawOptions, HiddenEdges};
use super::parallel::map_in_order;
use super::projector::Projector;
use super::region::{Region, region_edges};
use super::retained_points::idle_section_warnings;
use super::view_cover::{Occluding, ViewCover, VisibleParts, view_cover};
use super::visibility::{
    DepthCover, MeshOccluders, OcclusionIntervals, OcclusionScratch, ProjectedEdge, TriangleMesh,
    mesh_bvh,
};
use super::{EdgeClass, EdgeSegment, LineDrawing, Warning};
use crate::{DrawError, Subject};
use camera::ViewProjection;
use glam::{DVec2, DVec3};
use homog::{ClipRange, Point};
use model::{ModelInstance, Primitive, Topology};
use raster::Workers;
use std::ops::Range;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use viewport::Viewport;

/// The faces of a drawn subject, for a fill under its lines.
#[derive(Debug)]
pub struct DrawnFaces(WeldedSurface);

impl DrawnFaces {
    /// Returns each face with the linear color of its material, or `None` for section caps.
    pub fn colored(&self) -> impl Iterator<Item = ([DVec3; 3], Option<[f32; 3]>)> {
        self.0.faces_with_colors()
    }
}

/// Draws the edges of a subject with hidden-line removal. `workers` is the number of threads,
/// optionally with a monitor. The number does not change the drawing.
///
/// # Errors
/// Fails if the image has no pixels, if there are too many triangles, or on cancellation.
pub fn draw<'a>(
    subject: &Subject<'_>,
    options: &DrawOptions,
    workers: impl Into<Workers<'a>>,
) -> Result<LineDrawing, DrawError> {
    Ok(draw_hatched(subject, options, FaceHatching::None, workers)?.0)
}

/// Like [`draw`], with hatch lines on faces; also returns the drawn faces.
///
/// # Errors
/// See [`draw`].
pub fn draw_hatched<'a>(
    subject: &Subject<'_>,
    options: &DrawOptions,
    face_hatching: FaceHatching<'_>,
    workers: impl Into<Workers<'a>>,
) -> Result<(LineDrawing, DrawnFaces), DrawError> {
    let workers = workers.into();
    let projector = Projector::new(&subject.view_projection, &subject.viewport()?);
    if !options.is_unlimited {
        refuse_many_copies(subject.models)?;
    }
    let mut mesh = WorldMesh::from_models(subject.models);
    let has_cut_outs = mesh.faces.iter().any(|face| mesh.is_cut_out(face));
    if options.leaves_out_cut_outs && has_cut_outs {
        mesh.remove_cut_outs();
    }
    let mut surface = WeldedSurface::from_mesh(mesh, subject.sections, subject.uncut);
    let mut candidates = surface.mesh_edges(&projector, options);
    // There is only one view, so the memory of millions of half-edges can be freed.
    surface.forget_half_edges();
    let cover = view_cover(&surface, projector, subject.size, options);
    let hiding = cover.as_ref().map(|view| &view.cover);
    let is_cut_off = surface.add_intersections(&mut candidates, options, hiding, workers);
    let candidates = Candidates { edges: candidates, is_cut_off, cover, face_hatching };
    let Subject { view_projection, size, .. } = subject;
    let mut drawing =
        draw_candidates(&surface, candidates, view_projection, *size, options, workers)?;
    let draws_whole = has_cut_outs && !options.leaves_out_cut_outs;
    drawing.warnings.extend(draws_whole.then_some(Warning::CutOutsDrawnWhole));
    drawing.warnings.extend(idle_section_warnings(subject.models, subject.sections));
    drawing.warnings.sort_unstable();
    Ok((drawing, DrawnFaces(surface)))
}

/// Draws a welded surface as seen by one camera, on an image of `size` pixels.
///
/// This is like [`draw_hatched`], but one surface can be drawn from several directions, as on a
/// sheet.
///
/// # Errors
/// See [`draw`].
pub fn draw_surface<'a>(
    surface: &WeldedSurface,
    view_projection: &ViewProjection,
    size: [u32; 2],
    options: &DrawOptions,
    face_hatching: FaceHatching<'_>,
    workers: impl Into<Workers<'a>>,
) -> Result<LineDrawing, DrawError> {
    let workers = workers.into();
    let projector = Projector::new(
        view_projection,
        &Viewport::image_for(size[0], size[1], ClipRange::CHAPTER)?,
    );
    let mut candidates = surface.mesh_edges(&projector, options);
    let cover = view_cover(surface, projector, size, options);
    // Each view shows different intersections, so all are found once, unless the faces are a crowd.
    let crowd = cover.as_ref().and_then(ViewCover::crowd);
    let is_cut_off = surface.add_intersections(&mut candidates, options, crowd, workers);
    let candidates = Candidates { edges: candidates, is_cut_off, cover, face_hatching };
    draw_candidates(surface, candidates, view_projection, size, options, workers)
}

/// The candidate lines of a surface.
struct Candidates<'a> {
    /// The edges.
    edges: Vec<CandidateEdge>,
    /// Whether intersections are missing.
    is_cut_off: bool,
    /// The depths behind which the surface hides everything, or `None` if hidden lines do not
    /// matter.
    cover: Option<ViewCover>,
    /// The hatch lines of faces other than section caps.
    face_hatching: FaceHatching<'a>,
}

/// The number of triangles that all mesh instances together may have, in addition to twice the
/// number of triangles in the meshes.
const TRIANGLES_OF_COPIES: u64 = 1 << 20;

/// Rejects too many mesh instances: every triangle costs memory and time, and a small file can
/// contain any number of instances.
fn refuse_many_copies(models: &[ModelInstance]) -> Result<(), DrawError> {
    let triangles = |primitive: &Primitive| match primitive.topology {
        Topology::Triangles => primitive.item_count() as u64,
        _ => 0,
    };
    let (mut count, mut distinct) = (0, 0);
    for (index, placed) in models.iter().enumerate() {
        count +=
            placed.model.scene_primitives().map(|(_, primitive)| triangles(primitive)).sum::<u64>();
        let is_copy = models[..index].iter().any(|other| Arc::ptr_eq(&other.model, &placed.model));
        if !is_copy {
            let meshes = placed.model.meshes.iter();
            distinct += meshes.flat_map(|mesh| &mesh.primitives).map(triangles).sum::<u64>();
        }
    }
    let most = TRIANGLES_OF_COPIES + 2 * distinct;
    if count > most { Err(DrawError::TooManyCopies { count, distinct, most }) } else { Ok(()) }
}

/// Draws the candidate edges and the hatching of a surface with hidden-line removal.
fn draw_candidates(
    surface: &WeldedSurface,
    Candidates { mut edges, is_cut_off, cover, face_hatching }: Candidates<'_>,
    view_projection: &ViewProjection,
    size: [u32; 2],
    options: &DrawOptions,
    workers: Workers<'_>,
) -> Result<LineDrawing, DrawError> {
    let projector = Projector::new(
        view_projection,
        &Viewport::image_for(size[0], size[1], ClipRange::CHAPTER)?,
    );
    let mut warnings = surface.warnings().to_vec();
    warnings.extend(is_cut_off.then_some(Warning::IntersectionsIncomplete));
    let mut regions = outlines(surface, &projector, options);
    for hatching in hatch_surface(surface, face_hatching, &projector, options) {
        regions.extend(hatching.regions);
        warnings.extend(hatching.is_cut_off.then_some(Warning::HatchingIncomplete));
        let class = EdgeClass::Hatching;
        let segments = hatching.segments.into_iter();
        edges.extend(segments.map(|(ends, object)| CandidateEdge { ends, class, object }));
    }
    let crowd = cover.as_ref().and_then(ViewCover::crowd);
    warnings.extend(crowd.map(|_| Warning::CrowdApproximated));
    if let Some(view) = &cover {
        // Behind a crowd, hidden lines would merge into solid black.
        edges.retain(|edge| !view.cover.hides_segment(edge.ends));
    }
    edges.sort_by_key(|candidate| candidate.object);
    let divider = EdgeDivider::new(surface, projector, options, crowd);
    let (segments, is_complete) = divider.divide_edges(&edges, workers);
    if workers.is_canceled() {
        return Err(DrawError::Canceled);
    }
    warnings.extend((!is_complete).then_some(Warning::VisibilityIncomplete));
    warnings.sort_unstable();
    warnings.dedup();
    Ok(LineDrawing {
        size: DVec2::from(size.map(f64::from)),
        objects: surface.object_names().to_vec(),
        segments,
        regions,
        warnings,
    })
}

/// Returns the requested outlines: one per cut face that the viewer sees, object by object, or the
/// outline of all faces if there are no cuts.
fn outlines(surface: &WeldedSurface, projector: &Projector, options: &DrawOptions) -> Vec<Region> {
    if !options.outlines {
        return Vec::new();
    }
    if !surface.is_cut() {
        let triangles = surface.occluder_triangles().map(|vertices| vertices.map(Point::raw));
        let edges = region_edges(triangles, projector);
        return vec![Region { object: None, edges, hatching: None }];
    }
    let caps = surface.section_caps().into_iter().filter(|cap| cap.faces_viewer(projector));
    let outline = |cap: SectionCap| Region {
        object: Some(cap.object),
        edges: region_edges(cap.triangles.into_iter(), projector),
        hatching: None,
    };
    caps.map(outline).collect()
}

/// Returns the hatching of section caps, and of all other faces if requested.
fn hatch_surface(
    surface: &WeldedSurface,
    face_hatching: FaceHatching<'_>,
    projector: &Projector,
    options: &DrawOptions,
) -> Vec<Hatching> {
    if !options.classes.contains(EdgeClass::Hatching) {
        return Vec::new();
    }
    let (spacing, touching) = (options.hatch_spacing, surface.touch_tolerance().world);
    let caps = Hatching::hatch_caps(&surface.section_caps(), projector, spacing, touching);
    let mut hatchings = vec![caps];
    match face_hatching {
        FaceHatching::ByLuma(luma) => {
            let faces = surface
                .colored_faces_without_caps()
                .map(|(vertices, object, color)| (vertices, object, luma(vertices, color)));
            hatchings.push(Hatching::hatch_faces_by_luma(faces, projector, spacing));
        }
        // In a section, hatching marks the cuts; hatching on other faces would be misleading.
        FaceHatching::Parts if !surface.is_cut() => {
            let faces = surface.colored_faces().map(|(vertices, object, _)| (vertices, object));
            let boxes = surface.part_boxes();
            hatchings.push(Hatching::hatch_parts(faces, boxes, projector, spacing, touching));
        }
        FaceHatching::Parts | FaceHatching::None => {}
    }
    hatchings
}

/// The number of faces of a wall. If only the first layer is drawn, lines behind more faces are
/// omitted.
const FACES_OF_A_WALL: u32 = 2;

/// The number of comparisons always allowed per edge, on average.
const MIN_COMPARISONS: u64 = 512;
/// The number of comparisons always allowed for all edges together; they take at most half a
/// second.
const ANY_COMPARISONS: u64 = 1 << 26;
/// The number of comparisons allowed per face, so that a file twice as large takes at most twice
/// the work. An edge of an ordinary model is compared with a few hundred faces, and an edge of a
/// triangle soup with all of them.
const COMPARISONS_PER_FACE: u64 = 4096;

/// Divides edges into visible and hidden segments, using the occluders of one view.
///
/// Edges are independent of each other, so this step runs on several threads.
struct EdgeDivider<'a> {
    projector: Projector,
    /// The faces of the surface, or `None` if visibility is ignored.
    occluders: Option<MeshOccluders<Occluding<'a>>>,
    /// The cover of a crowd of faces.
    crowd: Option<&'a DepthCover>,
    /// The hidden segments to include in the drawing.
    hidden_edges: HiddenEdges,
    /// The approximate maximum number of comparisons.
    max_comparisons: u64,
}

impl<'a> EdgeDivider<'a> {
    /// Creates a divider that uses the faces of a surface as occluders, or no occluders if
    /// visibility is ignored.
    ///
    /// For outlines, faces also hide edges in front of them, so only edges that no face covers
    /// remain.
    fn new(
        surface: &'a WeldedSurface,
        projector: Projector,
        options: &DrawOptions,
        crowd: Option<&'a DepthCover>,
    ) -> Self {
        let tolerance = surface.touch_tolerance();
        let is_ignored = options.hidden_edges == HiddenEdges::Ignored && !options.outline_only;
        let occluders = (!is_ignored).then(|| {
            let parts = crowd.map(|crowd| VisibleParts::new(surface, crowd));
            let triangles = Occluding { surface, parts };
            let of_parts = triangles.parts.is_some().then(|| mesh_bvh(&triangles));
            let bvh = of_parts.as_ref().unwrap_or_else(|| surface.face_bvh());
            let faces = MeshOccluders::new(triangles, bvh, projector, tolerance);
            if options.outline_only { faces.at_any_depth() } else { faces }
        });
        let hidden_edges =
            if options.outline_only { HiddenEdges::Removed } else { options.hidden_edges };
        let faces = u64::from(surface.triangle_count());
        let fitting = ANY_COMPARISONS.saturating_add(COMPARISONS_PER_FACE * faces);
        let limit = if options.is_unlimited { u64::MAX } else { fitting };
        let max_comparisons = options.max_comparisons.min(limit);
        Self { projector, occluders, crowd, hidden_edges, max_comparisons }
    }

    /// Returns the segments of all edges, in edge order, and whether the work limit sufficed.
    ///
    /// The work limit is divided among groups of edges. The groups do not depend on the number of
    /// threads, so neither do the skipped parts.
    fn divide_edges(
        &self,
        edges: &[CandidateEdge],
        workers: Workers<'_>,
    ) -> (Vec<EdgeSegment>, bool) {
        let (done, total) = (AtomicU64::new(0), edges.len() as u64);
        let is_complete = AtomicBool::new(true);
        let for_each = (self.max_comparisons / edges.len().max(1) as u64).max(MIN_COMPARISONS);
        let divide =
            |range: Range<usize>, scratch: &mut OcclusionScratch, segments: &mut Vec<_>| {
                scratch.work_left = Some(for_each.saturating_mul(range.len() as u64));
                let count = range.len() as u64;
                for index in range {
                    self.divide_edge(&edges[index], index as u32, scratch, segments);
                }
                if scratch.work_left == Some(0) {
                    is_complete.store(false, Ordering::Relaxed);
                }
                let done = done.fetch_add(count, Ordering::Relaxed) + count;
                workers.report_progress(done, total);
            };
        let segments = map_in_order(edges.len(), workers, divide);
        (segments, is_complete.into_inner())
    }

    /// Cuts one edge at the ends of its hidden parts: pushes its visible segments, and its hidden
    /// segments if they are retained.
    ///
    /// Hidden parts of hatch lines are never drawn.
    fn divide_edge(
        &self,
        edge: &CandidateEdge,
        edge_index: u32,
        scratch: &mut OcclusionScratch,
        segments: &mut Vec<EdgeSegment>,
    ) {
        let Some(projected) = ProjectedEdge::clip_and_project(edge.ends, &self.projector) else {
            return;
        };
        let hidden_edges = match edge.class {
            EdgeClass::Hatching => HiddenEdges::Removed,
            _ => self.hidden_edges,
        };
        let mut push = |interval: [f64; 2], hidden: bool| {
            segments.push(EdgeSegment {
                ends: interval.map(|s| projected.screen_at(s)),
                depths: interval.map(|s| projected.depth_at(s)),
                class: edge.class,
                visible: !hidden,
                object: edge.object,
                edge: edge_index,
            });
        };
        let mut known = Vec::new();
        if let Some(crowd) = self.crowd {
            crowd.add_hidden_parts(&projected, &mut known);
        }
        let mut deep = OcclusionIntervals::default();
        let hidden = match &self.occluders {
            Some(occluders) if hidden_edges == HiddenEdges::FirstLayer => {
                if !occluders.hidden_intervals(&projected, scratch).is_empty() {
                    deep = occluders.intervals_behind_faces(&projected, FACES_OF_A_WALL, scratch);
                }
                scratch.last_result()
            }
            Some(occluders) => occluders.hidden_intervals_but(&projected, &known, scratch),
            None => scratch.nothing_hidden(),
        };
        for (interval, hidden) in hidden.divide_unit_interval() {
            match hidden_edges {
                _ if !hidden => push(interval, false),
                HiddenEdges::Removed | HiddenEdges::Ignored => {}
                HiddenEdges::Retained | HiddenEdges::FirstLayer => {
                    deep.parts_outside(interval).into_iter().for_each(|part| push(part, true));
                }
            }
        }
    }
}
