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
use super::face_fill::{KeyLight, rasterize_flat_fill};
use super::hatching::Hatching;
use super::hidden_line::{MeshOccluders, OcclusionIntervals, OcclusionScratch, ProjectedEdge};
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
    subject.viewport()?;
    let surface = WeldedSurface::new(subject.models, subject.sections, subject.uncut);
    let mut drawing =
        draw_surface(&surface, &subject.view_projection, subject.size, options, threads)?;
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
    let key_light = KeyLight::new(view_projection, projector);
    let (mut edges, is_cut_off) = surface.candidate_edges(&projector, options, threads);
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
    edges.sort_by_key(|candidate| candidate.object);
    warnings.sort_unstable();
    warnings.dedup();
    let face_fill = match options.face_fill {
        FaceFill::Flat => {
            let faces = surface.colored_faces().map(|(vertices, _, color)| (vertices, color));
            Some(rasterize_flat_fill(faces, view_projection, size, options)?)
        }
        _ => None,
    };
    Ok(LineDrawing {
        size: DVec2::from(size.map(f64::from)),
        objects: surface.object_names().to_vec(),
        segments: EdgeDivider::new(surface, projector, options).divide_edges(&edges, threads),
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
    if options.face_fill == FaceFill::Hatching {
        let faces = surface.colored_faces_without_caps().map(|(vertices, object, color)| {
            (vertices, object, key_light.face_luma(vertices, color))
        });
        hatchings.push(Hatching::hatch_faces_by_luma(faces, projector, spacing));
    }
    hatchings
}

/// The faces of a wall: lines behind more are not drawn if only the first layer is.
const FACES_OF_A_WALL: u32 = 2;

/// Divides edges into visible and hidden segments against the occluders of one view.
///
/// Edges are independent of each other, so this is where threads are used.
struct EdgeDivider<'a> {
    projector: Projector,
    /// The faces of the surface; `None` where visibility is ignored.
    occluders: Option<MeshOccluders<&'a WeldedSurface>>,
    /// Which hidden segments are part of the drawing.
    hidden_edges: HiddenEdges,
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
        Self { projector, occluders, hidden_edges }
    }

    /// The segments of all edges, in the order of the edges.
    fn divide_edges(&self, edges: &[CandidateEdge], threads: usize) -> Vec<EdgeSegment> {
        map_in_order(edges.len(), threads, |range, scratch, segments| {
            for index in range {
                self.divide_edge(&edges[index], index as u32, scratch, segments);
            }
        })
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
        let hidden = match &self.occluders {
            Some(occluders) => occluders.hidden_intervals(&projected, scratch),
            None => scratch.nothing_hidden(),
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
        let deep = match &self.occluders {
            Some(occluders) if hidden_edges == HiddenEdges::FirstLayer && !hidden.is_empty() => {
                occluders.intervals_behind_faces(&projected, FACES_OF_A_WALL)
            }
            _ => OcclusionIntervals::default(),
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
