//! Drawing a subject: candidate edges, hatching, hidden-line removal, face fill.
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
//!   visible and hidden segments + flat fill = LineDrawing
//! ```
//!
//! The surface depends on models and sections only, everything below it on the viewer too. Edges
//! keep the order of their objects, so drawings are reproducible and diffs of files are small.

use super::edges::{CandidateEdge, SectionCap, WeldedSurface};
use super::face_fill::{KeyLight, rasterize_fill};
use super::hatching::Hatching;
use super::hidden_line::{
    DepthCover, MeshOccluders, OcclusionIntervals, OcclusionScratch, ProjectedEdge,
    TriangleMesh as _,
};
use super::options::{DrawOptions, HiddenEdges};
use super::parallel::map_in_order;
use super::projector::Projector;
use super::region::{Region, region_edges};
use super::retained_points::idle_section_warnings;
use super::{EdgeClass, EdgeSegment, FaceFill, LineDrawing, Warning};
use crate::{DrawError, Subject};
use camera::ViewProjection;
use glam::DVec2;
use homog::Point;
use std::ops::Range;
use std::sync::atomic::{AtomicBool, Ordering};
use viewport::Viewport;

/// Draws the edges of a subject with hidden-line removal, with up to `threads` threads.
///
/// The drawing does not depend on the number of threads.
///
/// # Errors
/// If the image has no pixels.
pub fn draw(
    subject: &Subject<'_>,
    options: &DrawOptions,
    threads: usize,
) -> Result<LineDrawing, DrawError> {
    let projector = Projector::new(&subject.view_projection, &subject.viewport()?);
    let mut surface = WeldedSurface::new(subject.models, subject.sections, subject.uncut);
    let mut candidates = surface.mesh_edges(&projector, options);
    // There is no other view: memory of millions of edges is free for what follows.
    surface.forget_half_edges();
    let cover = view_cover(&surface, projector, subject.size, options);
    let wanted = (options, cover.as_ref());
    let is_cut_off = surface.add_intersections(&mut candidates, wanted, threads);
    let view = (&subject.view_projection, subject.size);
    let candidates = Candidates { edges: candidates, is_cut_off, cover };
    let mut drawing = draw_candidates(&surface, candidates, view, options, threads)?;
    drawing.warnings.extend(idle_section_warnings(subject.models, subject.sections));
    drawing.warnings.sort_unstable();
    Ok(drawing)
}

/// Draws a welded surface as one camera sees it, on an image of `size` pixels.
///
/// A sheet draws the same surface from several sides; see [`draw`] for the rest.
pub(crate) fn draw_surface(
    surface: &WeldedSurface,
    view_projection: &ViewProjection,
    size: [u32; 2],
    options: &DrawOptions,
    threads: usize,
) -> Result<LineDrawing, DrawError> {
    let projector = Projector::new(view_projection, &Viewport::image(size[0], size[1])?);
    let mut candidates = surface.mesh_edges(&projector, options);
    // Other views need other intersections: all are found once.
    let is_cut_off = surface.add_intersections(&mut candidates, (options, None), threads);
    let view = (view_projection, size);
    let cover = view_cover(surface, projector, size, options);
    let candidates = Candidates { edges: candidates, is_cut_off, cover };
    draw_candidates(surface, candidates, view, options, threads)
}

/// The edges of a surface that may be visible.
struct Candidates {
    edges: Vec<CandidateEdge>,
    /// Whether intersections are missing.
    is_cut_off: bool,
    /// The depths behind which nothing is visible; `None` where hidden edges are wanted, and where
    /// no face is large enough.
    cover: Option<DepthCover>,
}

/// What a surface hides of itself by single faces, where hidden lines are not drawn.
fn view_cover(
    surface: &WeldedSurface,
    projector: Projector,
    size: [u32; 2],
    options: &DrawOptions,
) -> Option<DepthCover> {
    let is_removed = options.hidden_edges == HiddenEdges::Removed && !options.outline_only;
    let cover = is_removed.then(|| surface.depth_cover(projector, size))?;
    (!cover.is_empty()).then_some(cover)
}

/// Draws the candidate edges of a surface, and its hatching, where they are visible.
fn draw_candidates(
    surface: &WeldedSurface,
    Candidates { mut edges, is_cut_off, cover }: Candidates,
    (view_projection, size): (&ViewProjection, [u32; 2]),
    options: &DrawOptions,
    threads: usize,
) -> Result<LineDrawing, DrawError> {
    let projector = Projector::new(view_projection, &Viewport::image(size[0], size[1])?);
    let key_light = KeyLight::new(view_projection, projector);
    let mut warnings = surface.warnings().to_vec();
    warnings.extend(is_cut_off.then_some(Warning::IntersectionsIncomplete));
    let mut regions = outlines(surface, &projector, options);
    for hatching in hatch_surface(surface, &key_light, &projector, options) {
        regions.extend(hatching.regions);
        warnings.extend(hatching.is_cut_off.then_some(Warning::HatchingIncomplete));
        let class = EdgeClass::Hatching;
        let segments = hatching.segments.into_iter();
        edges.extend(segments.map(|(ends, object)| CandidateEdge { ends, class, object }));
    }
    if let Some(cover) = cover {
        edges.retain(|edge| !cover.hides_segment(edge.ends));
    }
    edges.sort_by_key(|candidate| candidate.object);
    let face_fill = match options.face_fill {
        FaceFill::Flat | FaceFill::Gray => {
            let faces = surface.colored_faces().zip(&surface.mesh().faces);
            let faces = faces.map(|((vertices, _, color), face)| {
                (vertices, face.cap_section.is_none().then_some(color))
            });
            Some(rasterize_fill(faces, view_projection, size, options)?)
        }
        _ => None,
    };
    let divider = EdgeDivider::new(surface, projector, options);
    let (segments, is_complete) = divider.divide_edges(&edges, threads);
    warnings.extend((!is_complete).then_some(Warning::VisibilityIncomplete));
    warnings.sort_unstable();
    warnings.dedup();
    Ok(LineDrawing {
        size: DVec2::from(size.map(f64::from)),
        objects: surface.object_names().to_vec(),
        segments,
        regions,
        face_fill,
        warnings,
    })
}

/// The outlines that the options ask for: those of the cut faces that the viewer sees, object by
/// object; where nothing is cut, the one around all faces.
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

/// The hatching of section caps, and that of all other faces if the fill asks for it.
fn hatch_surface(
    surface: &WeldedSurface,
    key_light: &KeyLight,
    projector: &Projector,
    options: &DrawOptions,
) -> Vec<Hatching> {
    if !options.classes.contains(EdgeClass::Hatching) {
        return Vec::new();
    }
    let (spacing, touching) = (options.hatch_spacing, surface.touch_tolerance().world);
    let caps = Hatching::hatch_caps(&surface.section_caps(), projector, spacing, touching);
    let mut hatchings = vec![caps];
    let colors_count = options.face_fill == FaceFill::Hatching;
    if colors_count || options.face_fill == FaceFill::ShadeHatching {
        let faces = surface.colored_faces_without_caps().map(|(vertices, object, color)| {
            let color = if colors_count { color } else { [1.0; 3] };
            (vertices, object, key_light.face_luma(vertices, color))
        });
        hatchings.push(Hatching::hatch_faces_by_luma(faces, projector, spacing));
    }
    // Beside cuts, whose sign it is, a hatching of other faces would be misread.
    if options.face_fill == FaceFill::PartHatching && !surface.is_cut() {
        let faces = surface.colored_faces().map(|(vertices, object, _)| (vertices, object));
        let boxes = surface.part_boxes();
        hatchings.push(Hatching::hatch_parts(faces, boxes, projector, spacing, touching));
    }
    hatchings
}

/// The faces of a wall: lines behind more are not drawn if only the first layer is.
const FACES_OF_A_WALL: u32 = 2;

/// Edges may have this many comparisons each, on average, whatever their number.
const MIN_COMPARISONS: u64 = 512;
/// All edges together may have this many, below which no drawing takes long: half a second.
const ANY_COMPARISONS: u64 = 1 << 26;
/// They may have this many more for each face, so that a file twice as large is at most twice the
/// work. Edges of a model meet a few hundred faces; those of a soup of triangles meet all.
const COMPARISONS_PER_FACE: u64 = 4096;

/// Divides edges into visible and hidden segments against the occluders of one view.
///
/// Edges are independent of each other, so this is where threads are used.
struct EdgeDivider<'a> {
    projector: Projector,
    /// The faces of the surface; `None` where visibility is ignored.
    occluders: Option<MeshOccluders<&'a WeldedSurface>>,
    /// Which hidden segments are part of the drawing.
    hidden_edges: HiddenEdges,
    /// About how many comparisons there may be.
    max_comparisons: u64,
}

impl<'a> EdgeDivider<'a> {
    /// A divider with the faces of a surface as occluders, or none where visibility is ignored.
    ///
    /// For outlines faces hide what is before them as well: what is left has nothing beside it.
    fn new(surface: &'a WeldedSurface, projector: Projector, options: &DrawOptions) -> Self {
        let tolerance = surface.touch_tolerance();
        let is_ignored = options.hidden_edges == HiddenEdges::Ignored && !options.outline_only;
        let occluders = (!is_ignored).then(|| {
            let faces = MeshOccluders::new(surface, surface.face_bvh(), projector, tolerance);
            if options.outline_only { faces.at_any_depth() } else { faces }
        });
        let hidden_edges =
            if options.outline_only { HiddenEdges::Removed } else { options.hidden_edges };
        let faces = u64::from((&surface).triangle_count());
        let fitting = ANY_COMPARISONS.saturating_add(COMPARISONS_PER_FACE * faces);
        let max_comparisons = options.max_comparisons.min(fitting);
        Self { projector, occluders, hidden_edges, max_comparisons }
    }

    /// The segments of all edges, in the order of the edges; `false` if there was too much work.
    ///
    /// The work is divided among groups of edges that do not depend on the number of threads, so
    /// that what is left out does not either.
    fn divide_edges(&self, edges: &[CandidateEdge], threads: usize) -> (Vec<EdgeSegment>, bool) {
        let is_complete = AtomicBool::new(true);
        let for_each = (self.max_comparisons / edges.len().max(1) as u64).max(MIN_COMPARISONS);
        let divide =
            |range: Range<usize>, scratch: &mut OcclusionScratch, segments: &mut Vec<_>| {
                scratch.work_left = Some(for_each.saturating_mul(range.len() as u64));
                for index in range {
                    self.divide_edge(&edges[index], index as u32, scratch, segments);
                }
                if scratch.work_left == Some(0) {
                    is_complete.store(false, Ordering::Relaxed);
                }
            };
        let segments = map_in_order(edges.len(), threads, divide);
        (segments, is_complete.into_inner())
    }

    /// Cuts one edge where hidden lines begin and end: pushes its visible segments, and the hidden
    /// ones if they are retained.
    ///
    /// Hatch lines are never drawn where they are hidden.
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
        let mut deep = OcclusionIntervals::default();
        let hidden = match &self.occluders {
            Some(occluders) if hidden_edges == HiddenEdges::FirstLayer => {
                if !occluders.hidden_intervals(&projected, scratch).is_empty() {
                    deep = occluders.intervals_behind_faces(&projected, FACES_OF_A_WALL, scratch);
                }
                scratch.last_result()
            }
            Some(occluders) => occluders.hidden_intervals(&projected, scratch),
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
