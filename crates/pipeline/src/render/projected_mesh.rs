//! The images of one primitive's vertices: which of its triangles may be seen, and where their corners are.
//!
//! Of a mesh that stays as it is whole clusters of triangles are left out: those outside of the view volume, and those that show
//! their backs where backs are not drawn. Only vertices that the others need go through the stages, and only where
//! a cluster reaches beyond the volume and its guard band do they stop in clip space, to be clipped.

use super::screen_transform::{Containment, ScreenTransform};
use clip::Outcode;
use core::ops::Range;
use homog::{Clip, HPoint, Model, Projective};
use model::{Primitive, SkinnedPrimitive, Topology};
use raster::{MeshSelection, ScreenVertex, SimdLevel, VertexProjection};
use std::borrow::Cow;

/// The images of one primitive's vertices; the memory is used again for the next.
#[derive(Debug, Default)]
pub(super) struct ProjectedMesh {
    /// What can be drawn as it is.
    pub(super) unclipped: MeshSelection,
    /// What may have to be clipped.
    pub(super) to_clip: MeshSelection,
    /// In clip space, where something may have to be clipped.
    pub(super) clip_positions: Vec<HPoint<Clip>>,
    pub(super) outcodes: Vec<Outcode>,
    /// On the screen; `None` for those outside of the view volume and its guard band.
    pub(super) screen_vertices: Vec<Option<ScreenVertex>>,
}

impl ProjectedMesh {
    /// Selects what of a primitive may be seen. `viewer` is where the viewer is in the primitive's own space, if backs are not to
    /// be drawn.
    pub(super) fn cull_clusters(
        &mut self,
        stage: &ScreenTransform,
        model_to_clip: Projective<Model, Clip>,
        primitive: &Primitive,
        posed: &SkinnedPrimitive<'_>,
        viewer: Option<HPoint<Model>>,
    ) {
        let positions = &posed.positions;
        self.unclipped.clear(positions.len());
        self.to_clip.clear(positions.len());
        if primitive.topology != Topology::Triangles {
            // Points and lines are wider than their vertices tell.
            return self.to_clip.add_all(primitive.item_count());
        }
        let Cow::Borrowed(_) = positions else {
            return match stage.classify_bounds(model_to_clip, position_bounds(positions)) {
                Containment::Outside => {}
                Containment::Inside => self.unclipped.add_all(primitive.item_count()),
                Containment::Intersecting => self.to_clip.add_all(primitive.item_count()),
            };
        };
        let clusters = primitive.clusters(viewer.is_some());
        let mesh_containment = stage.classify_bounds(model_to_clip, clusters.bounds());
        if mesh_containment == Containment::Outside {
            return;
        }
        for cluster in clusters.as_slice() {
            if viewer.is_some_and(|viewer| cluster.is_back_facing(viewer)) {
                continue;
            }
            let containment = match mesh_containment {
                Containment::Inside => mesh_containment,
                _ => stage.classify_bounds(model_to_clip, cluster.bounds()),
            };
            match containment {
                Containment::Outside => {}
                Containment::Inside => self.unclipped.add_cluster(cluster),
                Containment::Intersecting => self.to_clip.add_cluster(cluster),
            }
        }
    }

    /// Takes the vertices of what is selected to the screen.
    pub(super) fn project_vertices(
        &mut self,
        stage: &ScreenTransform,
        model_to_clip: Projective<Model, Clip>,
        positions: &[[f32; 3]],
        threads: usize,
    ) {
        let simd_level = SimdLevel::best();
        let ndc_to_screen = stage.ndc_to_screen;
        let projection =
            VertexProjection { to_clip: model_to_clip, ndc_to_screen, simd_level, threads };
        let screen_vertices = &mut self.screen_vertices;
        projection.project_selected_positions(positions, &self.unclipped, screen_vertices);
        if self.to_clip.is_empty() {
            return;
        }
        self.clip_positions.resize(positions.len(), HPoint::new(0.0, 0.0, 0.0, 1.0));
        self.outcodes.resize(positions.len(), Outcode::INSIDE);
        for run in self.to_clip.vertices_within(0..positions.len()) {
            let (clip, outcodes) =
                (&mut self.clip_positions[run.clone()], &mut self.outcodes[run.clone()]);
            stage.guard_band.project_positions(
                model_to_clip,
                &positions[run.clone()],
                clip,
                outcodes,
            );
            let screen = &mut self.screen_vertices[run];
            ScreenVertex::divide_and_snap_points(clip, ndc_to_screen, simd_level, screen);
            for (vertex, code) in screen.iter_mut().zip(outcodes) {
                *vertex = vertex.filter(|_| code.is_inside());
            }
        }
    }

    /// The runs of triangles in their order, for each run that may have to be clipped those before it that need not.
    pub(super) fn triangle_runs(&self) -> impl Iterator<Item = (&[Range<usize>], Range<usize>)> {
        let mut remaining = self.unclipped.triangles();
        let cut = self.to_clip.triangles().iter().cloned();
        cut.chain(std::iter::once(usize::MAX..usize::MAX)).map(move |cut| {
            let before = remaining.partition_point(|run| run.start < cut.start);
            let whole;
            (whole, remaining) = remaining.split_at(before);
            (whole, cut)
        })
    }
}

/// The least and the greatest coordinates.
fn position_bounds(positions: &[[f32; 3]]) -> [[f32; 3]; 2] {
    let (mut min, mut max) = ([f32::INFINITY; 3], [f32::NEG_INFINITY; 3]);
    for position in positions {
        for axis in 0..3 {
            min[axis] = min[axis].min(position[axis]);
            max[axis] = max[axis].max(position[axis]);
        }
    }
    [min, max]
}
