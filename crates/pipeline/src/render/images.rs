//! The images of one primitive's vertices: which of its triangles may be seen, and where their corners are.
//!
//! Of a mesh that stays as it is whole clusters of triangles are left out: those outside of the view volume, and those that show
//! their backs where backs are not drawn. Only vertices that the others need go through the stages, and only where
//! a cluster reaches beyond the volume and its guard band do they stop in clip space, to be clipped.

use super::stage::{Stage, Whereabouts};
use clip::Outcode;
use core::ops::Range;
use homog::{Clip, HPoint, Model, Projective};
use model::{Posed, Primitive, Topology};
use raster::{Instructions, ScreenVertex, Selection};
use std::borrow::Cow;

/// The images of one primitive's vertices; the memory is used again for the next.
#[derive(Debug, Default)]
pub(super) struct Images {
    /// What can be drawn as it is.
    pub(super) whole: Selection,
    /// What may have to be clipped.
    pub(super) cut: Selection,
    /// In clip space, where something may have to be clipped.
    pub(super) clip: Vec<HPoint<Clip>>,
    pub(super) outcodes: Vec<Outcode>,
    /// On the screen; `None` for those outside of the view volume and its guard band.
    pub(super) screen: Vec<Option<ScreenVertex>>,
}

impl Images {
    /// Selects what of a primitive may be seen. `viewer` is where the viewer is in the primitive's own space, if backs are not to
    /// be drawn.
    pub(super) fn select(
        &mut self,
        stage: &Stage,
        model_to_clip: Projective<Model, Clip>,
        primitive: &Primitive,
        posed: &Posed<'_>,
        viewer: Option<HPoint<Model>>,
    ) {
        let positions = &posed.positions;
        self.whole.clear(positions.len());
        self.cut.clear(positions.len());
        if primitive.topology != Topology::Triangles {
            // Points and lines are wider than their vertices tell.
            return self.cut.add_all(primitive.count());
        }
        let Cow::Borrowed(_) = positions else {
            return match stage.whereabouts(model_to_clip, bounds(positions)) {
                Whereabouts::Outside => {}
                Whereabouts::Inside => self.whole.add_all(primitive.count()),
                Whereabouts::Unknown => self.cut.add_all(primitive.count()),
            };
        };
        let clusters = primitive.clusters(viewer.is_some());
        let all = stage.whereabouts(model_to_clip, clusters.bounds());
        if all == Whereabouts::Outside {
            return;
        }
        for cluster in clusters.list() {
            if viewer.is_some_and(|viewer| cluster.is_turned_away(viewer)) {
                continue;
            }
            let whereabouts = match all {
                Whereabouts::Inside => all,
                _ => stage.whereabouts(model_to_clip, cluster.bounds()),
            };
            match whereabouts {
                Whereabouts::Outside => {}
                Whereabouts::Inside => self.whole.add(cluster),
                Whereabouts::Unknown => self.cut.add(cluster),
            }
        }
    }

    /// Takes the vertices of what is selected to the screen.
    pub(super) fn project(
        &mut self,
        stage: &Stage,
        model_to_clip: Projective<Model, Clip>,
        positions: &[[f32; 3]],
        threads: usize,
    ) {
        let instructions = Instructions::best();
        ScreenVertex::project_selected(
            positions,
            &self.whole,
            model_to_clip,
            stage.ndc_to_screen,
            instructions,
            threads,
            &mut self.screen,
        );
        if self.cut.is_empty() {
            return;
        }
        self.clip.resize(positions.len(), HPoint::new(0.0, 0.0, 0.0, 1.0));
        self.outcodes.resize(positions.len(), Outcode::INSIDE);
        for run in self.cut.vertices_within(0..positions.len()) {
            let (clip, outcodes) = (&mut self.clip[run.clone()], &mut self.outcodes[run.clone()]);
            stage.volume.project(model_to_clip, &positions[run.clone()], clip, outcodes);
            let screen = &mut self.screen[run];
            ScreenVertex::snap_all(clip, stage.ndc_to_screen, instructions, screen);
            for (vertex, code) in screen.iter_mut().zip(outcodes) {
                *vertex = vertex.filter(|_| code.is_inside());
            }
        }
    }

    /// The runs of triangles in their order, for each run that may have to be clipped those before it that need not.
    pub(super) fn runs(&self) -> impl Iterator<Item = (&[Range<usize>], Range<usize>)> {
        let mut rest = self.whole.triangles();
        let cut = self.cut.triangles().iter().cloned();
        cut.chain(std::iter::once(usize::MAX..usize::MAX)).map(move |cut| {
            let before = rest.partition_point(|run| run.start < cut.start);
            let whole;
            (whole, rest) = rest.split_at(before);
            (whole, cut)
        })
    }
}

/// The least and the greatest coordinates.
fn bounds(positions: &[[f32; 3]]) -> [[f32; 3]; 2] {
    let (mut least, mut greatest) = ([f32::INFINITY; 3], [f32::NEG_INFINITY; 3]);
    for position in positions {
        for axis in 0..3 {
            least[axis] = least[axis].min(position[axis]);
            greatest[axis] = greatest[axis].max(position[axis]);
        }
    }
    [least, greatest]
}
