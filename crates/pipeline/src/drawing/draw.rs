//! From a scene to its line drawing.

use super::edges::{Candidate, Surface};
use super::in_order::in_order;
use super::options::{Hidden, Options};
use super::sight::Sight;
use super::visibility::{Obstacles, Scratch, Trace};
use super::{Line, LineDrawing};
use crate::render::RenderError;
use crate::scene::Scene;
use glam::DVec2;
use viewport::Viewport;

/// Draws the edges of a scene with up to `threads` threads. Their number does not change the drawing.
///
/// # Errors
/// If the picture has no pixels.
pub fn draw(scene: &Scene, options: &Options, threads: usize) -> Result<LineDrawing, RenderError> {
    let (width, height) = (scene.image.width, scene.image.height);
    let sight = Sight::new(&scene.shot, &Viewport::image(width, height)?);
    let surface = Surface::of(scene);
    let edges = surface.edges(&sight, options, threads);
    let obstacles = match options.hidden {
        Hidden::Ignored => Obstacles::new([], sight, surface.tolerance()),
        _ => Obstacles::new(surface.triangles(), sight, surface.tolerance()),
    };
    let drawer = Drawer { sight, obstacles, keeps_hidden: options.hidden == Hidden::Kept };
    Ok(LineDrawing {
        size: DVec2::new(width.into(), height.into()),
        objects: surface.into_objects(),
        lines: drawer.lines(&edges, threads),
    })
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
        let pieces = hidden.divide().filter(|(_, hidden)| !hidden || self.keeps_hidden);
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
