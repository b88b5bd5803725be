//! Drawing a subject: candidate edges, hatching, hidden-line removal, face fill.
//!
//! ```text
//!   WeldedSurface ─► candidate edges ─┐
//!               └──► hatch lines ─────┴─► EdgeDivider ─► visible and hidden segments
//!               └──► occluders ───────────────┘
//! ```

use super::edges::{CandidateEdge, WeldedSurface};
use super::face_fill::{KeyLight, rasterize_flat_fill};
use super::hatching::Hatching;
use super::hidden_line::{Occluders, OcclusionScratch, ProjectedEdge};
use super::options::{DrawOptions, HiddenEdges};
use super::parallel::map_in_order;
use super::projector::Projector;
use super::{EdgeClass, EdgeSegment, FaceFill, LineDrawing, Warning};
use crate::{DrawError, Subject};
use glam::DVec2;

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
    let [width, height] = subject.size;
    let projector = Projector::new(&subject.view_projection, &subject.viewport()?);
    let mut surface = WeldedSurface::from_subject(subject);
    let mut edges = surface.candidate_edges(&projector, options, threads);
    let mut warnings = surface.warnings().to_vec();
    for hatching in hatch_surface(&surface, subject, &projector, options) {
        warnings.extend(hatching.is_cut_off.then_some(Warning::HatchingIncomplete));
        let class = EdgeClass::Hatching;
        let lines = hatching.segments.into_iter();
        edges.extend(lines.map(|(ends, object)| CandidateEdge { ends, class, object }));
    }
    edges.sort_by_key(|candidate| candidate.object);
    warnings.sort_unstable();
    warnings.dedup();
    let face_fill = match options.face_fill {
        FaceFill::Flat => {
            let faces = surface.colored_faces().map(|(corners, _, color)| (corners, color));
            Some(rasterize_flat_fill(faces, &subject.view_projection, [width, height], options)?)
        }
        _ => None,
    };
    let occluders = match options.hidden_edges {
        HiddenEdges::Ignored => Occluders::new([], projector, surface.touch_tolerance()),
        _ => Occluders::new(surface.occluder_triangles(), projector, surface.touch_tolerance()),
    };
    let drawer = EdgeDivider {
        projector,
        occluders,
        retains_hidden: options.hidden_edges == HiddenEdges::Retained,
    };
    Ok(LineDrawing {
        size: DVec2::new(width.into(), height.into()),
        objects: surface.into_object_names(),
        segments: drawer.divide_edges(&edges, threads),
        face_fill,
        warnings,
    })
}

/// The hatching of section caps, and that of all other faces if the fill asks for it.
fn hatch_surface(
    surface: &WeldedSurface,
    subject: &Subject<'_>,
    sight: &Projector,
    options: &DrawOptions,
) -> Vec<Hatching> {
    if !options.classes.contains(EdgeClass::Hatching) {
        return Vec::new();
    }
    let touching = surface.touch_tolerance().world;
    let mut all =
        vec![Hatching::hatch_caps(&surface.section_caps(), sight, options.hatch_spacing, touching)];
    if options.face_fill == FaceFill::Hatching {
        let key_light = KeyLight::new(&subject.view_projection, *sight);
        let toned = surface
            .colored_faces_without_caps()
            .map(|(corners, object, color)| (corners, object, key_light.face_luma(corners, color)));
        all.push(Hatching::hatch_faces_by_luma(toned, sight, options.hatch_spacing));
    }
    all
}

/// Divides edges into visible and hidden segments.
struct EdgeDivider {
    projector: Projector,
    occluders: Occluders,
    /// Whether hidden segments are part of the drawing.
    retains_hidden: bool,
}

impl EdgeDivider {
    /// The segments of all edges, in the order of the edges.
    fn divide_edges(&self, edges: &[CandidateEdge], threads: usize) -> Vec<EdgeSegment> {
        map_in_order(edges.len(), threads, |range, scratch, lines| {
            for number in range {
                self.divide_edge(&edges[number], number as u32, scratch, lines);
            }
        })
    }

    /// Pushes the visible segments of one edge, and the hidden ones if they are retained.
    ///
    /// Hatch lines are never drawn where they are hidden.
    fn divide_edge(
        &self,
        edge: &CandidateEdge,
        edge_index: u32,
        scratch: &mut OcclusionScratch,
        lines: &mut Vec<EdgeSegment>,
    ) {
        let Some(projected) = ProjectedEdge::clip_and_project(edge.ends, &self.projector) else {
            return;
        };
        let hidden = self.occluders.hidden_intervals(&projected, scratch);
        // Hatching is never drawn where it is hidden.
        let retains_hidden = self.retains_hidden && edge.class != EdgeClass::Hatching;
        let pieces = hidden.divide_unit_interval().filter(|(_, hidden)| !hidden || retains_hidden);
        lines.extend(pieces.map(|(span, hidden)| EdgeSegment {
            ends: span.map(|s| projected.screen_at(s)),
            depths: span.map(|s| projected.depth_at(s)),
            class: edge.class,
            visible: !hidden,
            object: edge.object,
            edge: edge_index,
        }));
    }
}
