//! The view volume of another camera, with its eye: the frustum of the lessons (C61 to C64).

use super::{BLUE, Glass, LETTERS, layer};
use crate::drawing::{Align, Group, Label, Layer, LineType, Polyline};
use crate::render::Shot;
use glam::DVec2;
use homog::{Point, World};
use projection::{Convention, ViewVolume};

impl Glass {
    /// The twelve edges; and dashed, the rays from the eye to the near plane.
    pub(super) fn volume(&self, shot: Shot) -> Vec<Layer> {
        let volume = ViewVolume::new(shot.view_to_clip, Convention::CHAPTER);
        let view_to_world = shot.camera.view_to_world();
        let Some(corners) = volume.corners() else { return Vec::new() };
        let corners = corners.map(|corner| Some(view_to_world.point(corner.divide()?)));
        let edge = |[a, b]: [usize; 2]| self.line(corners[a]?, corners[b]?);
        let mut edges = layer("volume", "view volume", BLUE);
        let strokes = ViewVolume::EDGES.into_iter().filter_map(edge).collect();
        edges.groups.push(Group { strokes, ..Group::default() });
        let eye = volume.eye().and_then(|eye| Some(view_to_world.point(eye.divide()?)));
        let rays = eye.map(|eye| self.rays(eye, &corners[..4]));
        [Some(edges), rays].into_iter().flatten().collect()
    }

    fn rays(&self, eye: Point<World>, near: &[Option<Point<World>>]) -> Layer {
        let mut rays = layer("volume-eye", "eye of the view volume", BLUE);
        rays.pen.dashes = LineType::Dashed.dashes(rays.pen.width * 0.5);
        let ray = |corner: &Option<Point<World>>| self.line(eye, (*corner)?);
        let mut strokes: Vec<Polyline> = near.iter().filter_map(ray).collect();
        if let Some(place) = self.seen(self.image(eye)) {
            let at = place - DVec2::new(0.0, 1.5);
            let label = Label::new("eye", at, 0.8 * LETTERS).aligned(Align::Middle);
            strokes.extend(label.strokes());
        }
        rays.groups.push(Group { strokes, ..Group::default() });
        rays
    }
}
