//! From a scene to its line drawing.

use super::edges::{Candidate, Surface};
use super::hatch::Hatching;
use super::in_order::in_order;
use super::options::{Hidden, Options};
use super::sight::Sight;
use super::tone::{Lamp, painted};
use super::visibility::{Obstacles, Scratch, Trace};
use super::{EdgeClass, Line, LineDrawing, Tone, Warning};
use crate::{DrawError, Subject};
use glam::DVec2;

/// Draws the edges of a subject with up to `threads` threads. Their number does not change the drawing.
///
/// # Errors
/// If the picture has no pixels.
pub fn draw(
    subject: &Subject<'_>,
    options: &Options,
    threads: usize,
) -> Result<LineDrawing, DrawError> {
    let [width, height] = subject.size;
    let sight = Sight::new(&subject.view_projection, &subject.viewport()?);
    let mut surface = Surface::of(subject);
    let mut edges = surface.edges(&sight, options, threads);
    let mut warnings = surface.warnings().to_vec();
    for hatching in hatchings(&surface, subject, &sight, options) {
        warnings.extend(hatching.is_cut_off.then_some(Warning::HatchingLeftOut));
        let class = EdgeClass::Hatching;
        let lines = hatching.segments.into_iter();
        edges.extend(lines.map(|(ends, object)| Candidate { ends, class, object }));
    }
    edges.sort_by_key(|candidate| candidate.object);
    warnings.sort_unstable();
    warnings.dedup();
    let tone = match options.tone {
        Tone::Flat => {
            let faces = surface.painted().map(|(corners, _, color)| (corners, color));
            Some(painted(faces, &subject.view_projection, [width, height], options)?)
        }
        _ => None,
    };
    let obstacles = match options.hidden {
        Hidden::Ignored => Obstacles::new([], sight, surface.tolerance()),
        _ => Obstacles::new(surface.triangles(), sight, surface.tolerance()),
    };
    let drawer = Drawer { sight, obstacles, keeps_hidden: options.hidden == Hidden::Kept };
    Ok(LineDrawing {
        size: DVec2::new(width.into(), height.into()),
        objects: surface.into_objects(),
        lines: drawer.lines(&edges, threads),
        tone,
        warnings,
    })
}

/// The hatching of caps, and that of all other faces if it is wanted.
fn hatchings(
    surface: &Surface,
    subject: &Subject<'_>,
    sight: &Sight,
    options: &Options,
) -> Vec<Hatching> {
    if !options.classes.contains(EdgeClass::Hatching) {
        return Vec::new();
    }
    let touching = surface.tolerance().world;
    let mut all = vec![Hatching::of_caps(&surface.caps(), sight, options.hatch, touching)];
    if options.tone == Tone::Hatching {
        let lamp = Lamp::of(&subject.view_projection, *sight);
        let toned = surface
            .toned()
            .map(|(corners, object, color)| (corners, object, lamp.tone(corners, color)));
        all.push(Hatching::of_tones(toned, sight, options.hatch));
    }
    all
}

struct Drawer {
    sight: Sight,
    obstacles: Obstacles,
    keeps_hidden: bool,
}

impl Drawer {
    /// The pieces of all edges, in the order of the edges.
    fn lines(&self, edges: &[Candidate], threads: usize) -> Vec<Line> {
        in_order(edges.len(), threads, |range, scratch, lines| {
            for number in range {
                self.divide(&edges[number], number as u32, scratch, lines);
            }
        })
    }

    /// The pieces of an edge.
    fn divide(&self, edge: &Candidate, number: u32, scratch: &mut Scratch, lines: &mut Vec<Line>) {
        let Some(trace) = Trace::of(edge.ends, &self.sight) else { return };
        let hidden = self.obstacles.hidden(&trace, scratch);
        // Hatching is never drawn where it is hidden.
        let keeps_hidden = self.keeps_hidden && edge.class != EdgeClass::Hatching;
        let pieces = hidden.divide().filter(|(_, hidden)| !hidden || keeps_hidden);
        lines.extend(pieces.map(|(span, hidden)| Line {
            ends: span.map(|s| trace.at(s)),
            depths: span.map(|s| trace.depth_at(s)),
            class: edge.class,
            visible: !hidden,
            object: edge.object,
            edge: number,
        }));
    }
}
