//! View volume overlay: the frustum of another camera and its eye (C61 to C64).
//!
//! ```text
//!               ╱│         │╲
//!       eye ───╱ │ near    │ ╲ far        edges of the volume, and rays from the eye
//!          ╲───╲ │         │ ╱            to the corners of the near plane
//!               ╲│─────────│╱
//! ```
//!
//! The corners of the clip-space cube are mapped back to the world by the inverse projection. Any
//! projection can therefore be shown: the volume of an oblique projection is a sheared box, and
//! without an eye there are no rays.

use super::{LETTER_HEIGHT, PicturePlane, overlay_layer};
use camera::ViewProjection;
use glam::DVec2;
use homog::{HPoint, Point, World};
use page::palette::BLUE;
use page::{Group, Label, Layer, TextAlign};
use projection::{Convention, ViewVolume};

impl PicturePlane {
    /// Returns the layers of the twelve edges, and of the rays from the eye to the near plane.
    ///
    /// In a volume without a far plane, corners at infinity have no image, and edges to them are
    /// skipped.
    pub(super) fn view_volume_layers(&self, view_projection: &ViewProjection) -> Vec<Layer> {
        let volume = ViewVolume::new(view_projection.view_to_clip, Convention::CHAPTER);
        let view_to_world = view_projection.camera.view_to_world();
        let Some(corners) = volume.corners() else { return Vec::new() };
        let corners = corners.map(|corner| Some(view_to_world.transform_point(corner.divide()?)));
        let edge = |[a, b]: [usize; 2]| Some([corners[a]?, corners[b]?]);
        let edges: Vec<[Point<World>; 2]> =
            ViewVolume::EDGES.into_iter().filter_map(edge).collect();
        let mut layers = self.line_layers("volume", BLUE, &edges).to_vec();
        if let Some(eye) = volume.eye().and_then(HPoint::divide) {
            let eye = view_to_world.transform_point(eye);
            let rays: Vec<_> = corners[..4].iter().flatten().map(|corner| [eye, *corner]).collect();
            let [mut visible, hidden] = self.line_layers("volume-rays", BLUE, &rays);
            visible.pen.width *= 0.5;
            layers.extend([visible, hidden, self.eye_layer(eye)]);
        }
        layers
    }

    /// Returns the label for the eye.
    fn eye_layer(&self, eye: Point<World>) -> Layer {
        let mut layer = overlay_layer("volume-eye", "eye of the view volume", BLUE);
        let strokes = self.point_in_picture(self.project_point(eye)).map(|point| {
            let at = point - DVec2::new(0.0, 1.5);
            Label::new("eye", at, 0.8 * LETTER_HEIGHT).with_align(TextAlign::Middle).strokes()
        });
        layer.groups.push(Group { strokes: strokes.unwrap_or_default(), ..Group::default() });
        layer
    }
}
