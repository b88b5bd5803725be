//! Visible spots of parts in a parallel view, where the leaders of balloons end.
//!
//! ```text
//!   ┌─────────┐      a z-buffer of part numbers, with one sample in the middle of each pixel;
//!   │ 1 1 2 2 │      the spot of a part is the sample farthest from all other parts,
//!   │ 1 1 2 ● │      the paper and the border
//!   └─────────┘
//! ```

use super::sheet_view::SheetView;
use crate::assembly::Part;
use drawing::Drawing;
use glam::{DVec2, DVec3};
use homog::Point;
use model::ModelInstance;
use std::collections::BTreeMap;
use viewport::DrawingScale;

/// The number of pixels along the longer side of the view.
const LONG_SIDE: f64 = 1200.0;

/// The index of 1:1 among the standard scales.
const NATURAL_SCALE: usize = 5;

/// The value of a pixel that shows no part.
const NO_PART: u32 = u32::MAX;

/// A position in a view where one part is in front of all others.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) struct VisibleSpot {
    /// The position from the center of the view, to the right and down, in scene units.
    pub(super) at: DVec2,
    /// Half the side of a square around the position in which only this part is visible, in scene
    /// units.
    pub(super) clearance: f64,
}

/// The parts with their moves, in world space.
pub(super) struct MovedParts<'a> {
    pub(super) parts: &'a [Part],
    pub(super) models: &'a [ModelInstance],
    /// The move of each part.
    pub(super) moves: &'a [DVec3],
}

/// Finds the spot with the largest clearance for each part, or `None` for parts that are hidden or
/// narrower than a pixel.
pub(super) fn find_visible_spots(
    moved: &MovedParts<'_>,
    view: &SheetView,
) -> Vec<Option<VisibleSpot>> {
    let image = PartImage::rasterize(moved, view);
    let mut spots: Vec<Option<VisibleSpot>> = vec![None; moved.parts.len()];
    let distances = image.distances_to_others();
    for (pixel, (&part, &distance)) in image.parts.iter().zip(&distances).enumerate() {
        let Some(spot) = spots.get_mut(part as usize) else { continue };
        let clearance = (f64::from(distance) - 0.5) / image.pixels_per_unit;
        if spot.is_none_or(|best| clearance > best.clearance) {
            let at = DVec2::new((pixel % image.width) as f64, (pixel / image.width) as f64) + 0.5;
            let at = (at - image.middle()) / image.pixels_per_unit;
            *spot = Some(VisibleSpot { at, clearance });
        }
    }
    spots
}

/// Finds spots for parts that have none because they are narrower than a pixel. Each spot is the
/// middle of the part's longest visible edge segment. `object` maps a part to its object in the
/// drawing of the view.
pub(super) fn add_spots_on_edges(
    spots: &mut [Option<VisibleSpot>],
    drawing: &Drawing,
    object: impl Fn(usize) -> u32,
    view: &SheetView,
) {
    let missing = (0..spots.len()).filter(|part| spots[*part].is_none());
    let part_of: BTreeMap<u32, usize> = missing.map(|part| (object(part), part)).collect();
    if part_of.is_empty() {
        return;
    }
    let mut longest = vec![0.0; spots.len()];
    let window = view.placement(drawing, DrawingScale::STANDARD[NATURAL_SCALE], DVec2::ZERO);
    for segment in drawing.segments.iter().filter(|segment| segment.visible) {
        let Some(&part) = part_of.get(&segment.object) else { continue };
        let [from, to] = segment.ends;
        let length = (to - from).length();
        if length > longest[part] {
            longest[part] = length;
            let millimeters = (from + to) * 0.5 * window.scale + window.corner;
            let at = millimeters / view.millimeters_per_unit;
            spots[part] = Some(VisibleSpot { at, clearance: 0.0 });
        }
    }
}

/// The index of the nearest part in each pixel of a view.
struct PartImage {
    width: usize,
    height: usize,
    pixels_per_unit: f64,
    parts: Vec<u32>,
    /// The view-space z of the nearest part; larger is nearer.
    depths: Vec<f64>,
}

impl PartImage {
    /// Draws the triangles of all parts.
    fn rasterize(moved: &MovedParts<'_>, view: &SheetView) -> Self {
        let size = view.size / view.millimeters_per_unit;
        let pixels_per_unit = LONG_SIDE / size.max_element().max(1e-300);
        let [width, height] = (size * pixels_per_unit).to_array().map(|side| side as usize + 3);
        let mut image = Self {
            width,
            height,
            pixels_per_unit,
            parts: vec![NO_PART; width * height],
            depths: vec![f64::NEG_INFINITY; width * height],
        };
        let world_to_view = view.camera.world_to_view();
        for (number, (part, by)) in (0..).zip(moved.parts.iter().zip(moved.moves)) {
            part.for_each_triangle(moved.models, |triangle| {
                let corners = triangle.map(|corner| {
                    let at = world_to_view.transform_point(Point::from_raw(corner + *by)).raw();
                    let pixel = DVec2::new(at.x, -at.y) * image.pixels_per_unit + image.middle();
                    pixel.extend(at.z)
                });
                image.fill_triangle(corners, number);
            });
        }
        image
    }

    /// Returns the pixel coordinates of the center of the view.
    fn middle(&self) -> DVec2 {
        DVec2::new(self.width as f64, self.height as f64) * 0.5
    }

    /// Draws one triangle row by row, covering the pixel centers between its sides in each row.
    fn fill_triangle(&mut self, corners: [DVec3; 3], number: u32) {
        let [a, b, c] = corners;
        let normal = (b - a).cross(c - a);
        // A triangle seen edge-on covers no pixels.
        if !normal.is_finite() || normal.z == 0.0 {
            return;
        }
        let ys = corners.map(|corner| corner.y);
        let [top, bottom] =
            [ys.into_iter().fold(ys[0], f64::min), ys.into_iter().fold(ys[0], f64::max)];
        let index = |bound: f64, most: usize| (bound - 0.5).ceil().clamp(0.0, most as f64) as usize;
        for row in index(top, self.height)..index(bottom, self.height) {
            let y = row as f64 + 0.5;
            let mut span = [f64::INFINITY, f64::NEG_INFINITY];
            for [from, to] in [[a, b], [b, c], [c, a]] {
                // The interval is half-open, so that a row through a vertex meets two sides, not
                // three.
                if (from.y <= y) != (to.y <= y) {
                    let x = from.x + (to.x - from.x) * ((y - from.y) / (to.y - from.y));
                    span = [span[0].min(x), span[1].max(x)];
                }
            }
            if span[0] >= span[1] {
                continue;
            }
            for column in index(span[0], self.width)..index(span[1], self.width) {
                let x = column as f64 + 0.5;
                let z = a.z - (normal.x * (x - a.x) + normal.y * (y - a.y)) / normal.z;
                let pixel = row * self.width + column;
                if z > self.depths[pixel] {
                    self.depths[pixel] = z;
                    self.parts[pixel] = number;
                }
            }
        }
    }

    /// Returns each pixel's distance to another part, the paper or the border, in steps between
    /// neighbors, including diagonals. Uses two passes, from above and from below.
    fn distances_to_others(&self) -> Vec<u32> {
        let (width, height) = (self.width as isize, self.height as isize);
        let mut distances = vec![u32::MAX / 2; self.parts.len()];
        let mut update = |pixel: usize, ways: [[isize; 2]; 4]| {
            let (x, y) = ((pixel % self.width) as isize, (pixel / self.width) as isize);
            for [dx, dy] in ways {
                let (i, k) = (x + dx, y + dy);
                let is_inside = (0..width).contains(&i) && (0..height).contains(&k);
                let other = (k * width + i) as usize;
                let is_same = is_inside && self.parts[other] == self.parts[pixel];
                let steps = if is_same { distances[other] + 1 } else { 1 };
                distances[pixel] = distances[pixel].min(steps);
            }
        };
        let above = [[-1, 0], [-1, -1], [0, -1], [1, -1]];
        let below = above.map(|[dx, dy]| [-dx, -dy]);
        (0..self.parts.len()).for_each(|pixel| update(pixel, above));
        (0..self.parts.len()).rev().for_each(|pixel| update(pixel, below));
        distances
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::assembly::gather_parts;
    use camera::NamedView;
    use homog::Affine;
    use model::{Mesh, Model, Node, Primitive, world_points};
    use std::sync::Arc;

    /// Returns a model in which each triangle is a separate part.
    fn triangles(corners: &[[[f32; 3]; 3]]) -> ModelInstance {
        let mut model = Model::default();
        for (index, positions) in corners.iter().enumerate() {
            let (positions, indices) = (positions.to_vec(), vec![0, 1, 2]);
            let primitive = Primitive { positions, indices, ..Primitive::default() };
            model.meshes.push(Mesh { primitives: vec![primitive], ..Mesh::default() });
            model.nodes.push(Node { mesh: Some(index), ..Node::default() });
            model.roots.push(index);
        }
        ModelInstance { model: Arc::new(model), model_to_world: Affine::IDENTITY }
    }

    #[test]
    fn spots_are_on_the_nearest_part() {
        let mut state = 11_u64;
        let mut fraction = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888);
            (state >> 40) as f32 / (1_u32 << 24) as f32
        };
        let corners: Vec<[[f32; 3]; 3]> =
            (0..60).map(|_| [(); 3].map(|()| [(); 3].map(|()| fraction() * 10.0))).collect();
        let models = [triangles(&corners)];
        let parts = gather_parts(&models);
        let moves: Vec<DVec3> = (0..60).map(|k| DVec3::X * f64::from(k % 4)).collect();
        let points = world_points(&models);
        let view = SheetView::frame_points(&points, NamedView::Isometric, 1.0).expect("a view");
        let moved = MovedParts { parts: &parts, models: &models, moves: &moves };
        let spots = find_visible_spots(&moved, &view);
        assert!(spots.iter().flatten().count() > 40);
        let to_view = view.camera.world_to_view();
        for (part, spot) in spots.iter().enumerate() {
            let Some(VisibleSpot { at, .. }) = spot else { continue };
            // Returns the depth of a triangle at the spot, by barycentric coordinates.
            let depth = |number: usize| {
                let [a, b, c] = corners[number].map(|corner| {
                    let world = DVec3::from(corner.map(f64::from)) + moves[number];
                    to_view.transform_point(Point::from_raw(world)).raw()
                });
                let p = DVec2::new(at.x, -at.y) - a.truncate();
                let (u, v) = ((b - a).truncate(), (c - a).truncate());
                let [s, t] = [p.perp_dot(v), u.perp_dot(p)].map(|area| area / u.perp_dot(v));
                let is_inside = s >= 0.0 && t >= 0.0 && s + t <= 1.0;
                is_inside.then_some(a.z + (b.z - a.z) * s + (c.z - a.z) * t)
            };
            let own = depth(part).expect("the spot is on its part");
            assert!((0..60).filter_map(depth).all(|other| other <= own + 1e-9), "{part}");
        }
    }
}
