//! Depth cover: for each cell of a grid on the screen, a depth behind which nothing is visible.
//!
//! ```text
//!  cell   0     1     2     3     4     5           ■  completely covered by one face:
//!         │     │■■■■■│■■■■■│■■■■■│     │              everything behind it is hidden there
//!         │  ╱▒▒│▒▒▒▒▒│▒▒▒▒▒│▒▒▒▒▒│▒╲   │           ▒  the face
//! ```
//! This is the hierarchical z-buffer of Greene, Kass and Miller (*Hierarchical Z-buffer
//! visibility*, 1993), made conservative. A face contributes to a cell only if it covers the whole
//! cell, and then with its farthest depth there. Anything reported as hidden is hidden; anything
//! else is decided by the exact tests. Where surfaces overlap many times, as in a soup of random
//! triangles, most faces are eliminated before any pair is compared.
//!
//! Small faces do not cover any cell. If they form a crowd, the cover is computed from all faces
//! together, sampled at cell centers like a z-buffer. Gaps of a few pixels count as closed, and the
//! work is bounded by the number of visible parts.

use super::depth_level::{DepthPlane, Level};
use super::occluders::Tolerance;
use super::projected_edge::ProjectedEdge;
use crate::projector::Projector;
use glam::{DVec2, DVec3};

/// The number of cells along the longer side of the screen.
const CELLS: f64 = 256.0;
/// The number of pixels by which a face is shrunk on all sides: more than any tolerance of the
/// exact tests.
const MARGIN: f64 = 1.0 / 64.0;
/// The number of touching distances by which a face is moved back, so that anything that touches it
/// does not count as hidden.
const SETBACK: f64 = 32.0;
/// Faces seen at an angle with a smaller sine hide nothing here: even when moved back, they would
/// still be within the touching distance of anything that touches them.
const LEAST_SINE: f64 = 0.125;

/// Faces are a crowd if, on average, more faces than this cover each pixel of their bounding box.
/// Ordinary models have fewer than six.
const CROWD: f64 = 32.0;
/// The maximum number of samples of all faces together in the cover of a crowd.
const MAX_SAMPLES: f64 = 134_217_728.0;
/// The maximum number of cells along the longer side of the screen in the cover of a crowd.
const MAX_CROWD_CELLS: f64 = 1024.0;
/// The number of times that a segment is halved before it counts as visible.
const DIVISIONS: u32 = 6;
/// The number of times that a triangle is divided to skip its hidden parts.
const PART_DIVISIONS: u32 = 4;
/// Parts whose boxes are smaller than this many cells in both directions are not divided further.
const SMALL_PART: f64 = 16.0;

/// The depths behind which nothing is visible, as a pyramid of grids.
///
/// Depths are screen depths: 0 at the far plane, 1 at the near plane.
#[derive(Clone, Debug)]
pub(crate) struct DepthCover {
    projector: Projector,
    /// Cells per pixel.
    scale: f64,
    /// The levels, starting with the finest; each coarser level stores the minimum of four depths.
    levels: Vec<Level>,
}

/// The image of a face or segment: a box on the screen, with its nearest depth.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct ScreenBox {
    min: DVec2,
    max: DVec2,
    nearest: f64,
}

impl ScreenBox {
    /// Returns the box around points in front of the viewer, or `None` if a point has no image.
    fn around(points: &[DVec3], projector: &Projector) -> Option<Self> {
        let mut all = Self::around_images(&[]);
        for point in points {
            all.extend(image_of(*point, projector)?);
        }
        Some(all)
    }

    /// Returns the box around points on the screen.
    fn around_images(images: &[DVec3]) -> Self {
        let mut all =
            Self { min: DVec2::INFINITY, max: DVec2::NEG_INFINITY, nearest: f64::NEG_INFINITY };
        images.iter().for_each(|image| all.extend(*image));
        all
    }

    /// Extends the box to contain a point on the screen.
    fn extend(&mut self, image: DVec3) {
        self.min = self.min.min(image.truncate());
        self.max = self.max.max(image.truncate());
        self.nearest = self.nearest.max(image.z);
    }

    /// Returns the box around the intersection of both images.
    pub(crate) fn intersection(&self, other: &Self) -> Self {
        Self {
            min: self.min.max(other.min),
            max: self.max.min(other.max),
            nearest: self.nearest.min(other.nearest),
        }
    }
}

impl DepthCover {
    /// Creates the cover formed by single faces on a screen of the given size in pixels.
    pub(crate) fn new(
        faces: impl Iterator<Item = [DVec3; 3]>,
        projector: Projector,
        size: [u32; 2],
        tolerance: &Tolerance,
    ) -> Self {
        let size = DVec2::from(size.map(f64::from));
        let scale = CELLS / size.max_element();
        let cells = (size * scale).ceil().max(DVec2::ONE).to_array().map(|side| side as usize);
        let mut cover = Self { projector, scale, levels: vec![Level::empty(cells)] };
        for face in faces {
            cover.add_face(face, SETBACK * tolerance.world);
        }
        cover.add_levels();
        cover
    }

    /// Creates the cover formed by a crowd of faces, or returns `None` if the faces are not a
    /// crowd.
    pub(crate) fn of_crowd<I: Iterator<Item = [DVec3; 3]>>(
        faces: impl Fn() -> I,
        projector: Projector,
        size: [u32; 2],
    ) -> Option<Self> {
        let size = DVec2::from(size.map(f64::from));
        let images = || faces().filter_map(|corners| images_of(&corners, &projector));
        let mut around = ScreenBox::around_images(&[]);
        let mut area = 0.0;
        for image in images() {
            area += area_within(image, size);
            image.iter().for_each(|corner| around.extend(*corner));
        }
        let covered = (around.max.min(size) - around.min.max(DVec2::ZERO)).max(DVec2::ONE);
        if area < CROWD * covered.x * covered.y {
            return None;
        }
        let finest = (MAX_CROWD_CELLS / size.max_element()).min(1.0);
        let scale = libm::sqrt(MAX_SAMPLES / area).min(finest);
        let cells = (size * scale).ceil().max(DVec2::ONE).to_array().map(|side| side as usize);
        let mut samples = Level::empty(cells);
        for image in images() {
            samples.sample(image.map(|corner| (corner.truncate() * scale).extend(corner.z)));
        }
        let mut cover = Self { projector, scale, levels: vec![samples.eroded()] };
        cover.add_levels();
        Some(cover)
    }

    /// Adds the coarser levels of the pyramid.
    fn add_levels(&mut self) {
        while let Some(coarser) = self.levels.last().and_then(Level::halved) {
            self.levels.push(coarser);
        }
    }

    /// Whether everything whose image is inside a box is hidden.
    pub(crate) fn hides(&self, image: &ScreenBox) -> bool {
        let [low, high] = [image.min, image.max].map(|corner| corner * self.scale);
        let size = DVec2::from(self.levels[0].size.map(|side| side as f64));
        // Parts beyond the border of the screen are not drawn.
        let (low, high) = (low.max(DVec2::ZERO), high.min(size));
        if !(low.cmple(high).all()) {
            return false;
        }
        let [first, last] = [low, high].map(|corner| corner.to_array().map(|side| side as usize));
        // This is the level at which the box meets only a few cells.
        let span = (last[0] - first[0]).max(last[1] - first[1]);
        let level = (usize::BITS - (span / 8).leading_zeros()) as usize;
        let Some(grid) = self.levels.get(level) else { return false };
        let [first, last] = [first, last].map(|cell| [0, 1].map(|k| cell[k] >> level));
        (first[1]..=last[1].min(grid.size[1] - 1)).all(|row| {
            (first[0]..=last[0].min(grid.size[0] - 1))
                .all(|column| image.nearest < grid.depths[row * grid.size[0] + column])
        })
    }

    /// Whether a world-space segment is hidden from end to end.
    pub(crate) fn hides_segment(&self, ends: [DVec3; 2]) -> bool {
        images_of(&ends, &self.projector).is_some_and(|ends| self.hides_image(ends, DIVISIONS))
    }

    /// Adds the parts of an edge that are hidden, as intervals of its image.
    pub(crate) fn add_hidden_parts(&self, edge: &ProjectedEdge, parts: &mut Vec<[f64; 2]>) {
        let ends = [0.0, 1.0].map(|s| edge.screen_at(s).extend(edge.depth_at(s)));
        self.divide_hidden(ends, [0.0, 1.0], DIVISIONS, parts);
    }

    /// Adds the hidden parts of a screen segment: the interval [from, to] of a longer segment.
    fn divide_hidden(
        &self,
        [a, b]: [DVec3; 2],
        [from, to]: [f64; 2],
        divisions: u32,
        parts: &mut Vec<[f64; 2]>,
    ) {
        if self.hides(&ScreenBox::around_images(&[a, b])) {
            match parts.last_mut().filter(|last| last[1] == from) {
                Some(last) => last[1] = to,
                None => parts.push([from, to]),
            }
            return;
        }
        let is_short = ((b - a).truncate() * self.scale).abs().max_element() < 2.0;
        if divisions > 0 && !is_short {
            let (middle, at) = (0.5 * (a + b), 0.5 * (from + to));
            self.divide_hidden([a, middle], [from, at], divisions - 1, parts);
            self.divide_hidden([middle, b], [at, to], divisions - 1, parts);
        }
    }

    /// Adds the visible parts of a world-space triangle: quarters, quarters of quarters and so on,
    /// or the whole triangle.
    pub(crate) fn add_visible_parts(&self, corners: [DVec3; 3], parts: &mut Vec<[DVec3; 3]>) {
        self.divide_visible(corners, PART_DIVISIONS, parts);
    }

    /// Adds the parts that are not hidden, and returns whether they are the whole triangle.
    fn divide_visible(
        &self,
        corners: [DVec3; 3],
        divisions: u32,
        parts: &mut Vec<[DVec3; 3]>,
    ) -> bool {
        let image = self.image_of(&corners);
        if image.is_some_and(|image| self.hides(&image)) {
            return false;
        }
        // A part that crosses the plane of the eye has no box to test.
        let size = image.map_or(0.0, |image| ((image.max - image.min) * self.scale).max_element());
        let first = parts.len();
        let mut is_whole = true;
        if divisions > 0 && size >= SMALL_PART {
            for part in quarters(corners) {
                is_whole &= self.divide_visible(part, divisions - 1, parts);
            }
        }
        if is_whole {
            parts.truncate(first);
            parts.push(corners);
        }
        is_whole
    }

    /// Whether a segment on the screen is hidden, tested by its box or by the boxes of its halves.
    fn hides_image(&self, [a, b]: [DVec3; 2], divisions: u32) -> bool {
        if self.hides(&ScreenBox::around_images(&[a, b])) {
            return true;
        }
        let is_short = ((b - a).truncate() * self.scale).abs().max_element() < 2.0;
        if divisions == 0 || is_short {
            return false;
        }
        let middle = 0.5 * (a + b);
        [[a, middle], [middle, b]].into_iter().all(|half| self.hides_image(half, divisions - 1))
    }

    /// Returns the box around the images of points, or `None` if a point has no image.
    pub(crate) fn image_of(&self, points: &[DVec3]) -> Option<ScreenBox> {
        ScreenBox::around(points, &self.projector)
    }

    /// Whether no face covers a cell.
    pub(crate) fn is_empty(&self) -> bool {
        self.levels[0].depths.iter().all(|depth| *depth == 0.0)
    }

    /// Adds a face, moved away from the viewer by `setback`.
    fn add_face(&mut self, corners: [DVec3; 3], setback: f64) {
        // Most faces of a fine mesh are smaller than a cell.
        let image = self.image_of(&corners);
        if image.is_none_or(|image| ((image.max - image.min) * self.scale).min_element() < 1.0) {
            return;
        }
        let [a, b, c] = corners;
        let normal = (b - a).cross(c - a).normalize_or_zero();
        let mut images = [DVec3::ZERO; 3];
        for (image, corner) in images.iter_mut().zip(corners) {
            let gaze = -self.projector.towards_viewer(corner).normalize_or_zero();
            if normal.dot(gaze).abs() < LEAST_SINE {
                return;
            }
            let Some(moved) = image_of(corner + gaze * setback, &self.projector) else { return };
            *image = (moved.truncate() * self.scale).extend(moved.z);
        }
        let Some(plane) = DepthPlane::through(images) else { return };
        self.levels[0].cover(images.map(DVec3::truncate), &plane, MARGIN * self.scale);
    }
}

/// Divides a triangle into four at the midpoints of its sides.
fn quarters([a, b, c]: [DVec3; 3]) -> [[DVec3; 3]; 4] {
    let [ab, bc, ca] = [0.5 * (a + b), 0.5 * (b + c), 0.5 * (c + a)];
    [[ab, bc, ca], [a, ab, ca], [ab, b, bc], [ca, bc, c]]
}

/// Returns the image of a point, or `None` if it is outside the depths of the view volume.
fn image_of(point: DVec3, projector: &Projector) -> Option<DVec3> {
    let clip = projector.world_to_clip_point(point);
    if clip.w() <= 0.0 {
        return None;
    }
    let image = projector.project_to_screen(clip)?;
    (0.0..=1.0).contains(&image.z).then_some(image)
}

/// Returns the images of points, or `None` if one is outside the depths of the view volume.
fn images_of<const N: usize>(points: &[DVec3; N], projector: &Projector) -> Option<[DVec3; N]> {
    let mut images = [DVec3::ZERO; N];
    for (image, point) in images.iter_mut().zip(points) {
        *image = image_of(*point, projector)?;
    }
    Some(images)
}

/// Returns an upper bound on the area in pixels that a triangle covers on a screen.
fn area_within(images: [DVec3; 3], size: DVec2) -> f64 {
    let around = ScreenBox::around_images(&images);
    let visible = (around.max.min(size) - around.min.max(DVec2::ZERO)).max(DVec2::ZERO);
    let [a, b, c] = images.map(DVec3::truncate);
    let area = 0.5 * (b - a).perp_dot(c - a).abs();
    area.min(visible.x * visible.y)
}

#[cfg(test)]
mod tests {
    use super::*;
    use camera::{Camera, ViewProjection};
    use homog::{ClipRange, Point, Vector};
    use projection::{Convention, Fov, Orthographic, Perspective};
    use viewport::Viewport;

    fn projector(is_parallel: bool) -> Projector {
        let camera =
            Camera::look_to(Point::new(0.0, 0.0, 5.0), -Vector::Z, Vector::Y).expect("a camera");
        let view_to_clip = if is_parallel {
            let window = Orthographic::new(-2.0, 2.0, -2.0, 2.0, 1.0, 10.0).expect("a window");
            window.view_to_clip(Convention::CHAPTER)
        } else {
            let lens = Perspective::new(Fov::Vertical(0.8), 1.0, 1.0, 10.0).expect("a lens");
            lens.view_to_clip(Convention::CHAPTER)
        };
        let view_projection = ViewProjection { camera, view_to_clip };
        Projector::new(
            &view_projection,
            &Viewport::image_for(400, 400, ClipRange::CHAPTER).expect("pixels"),
        )
    }

    fn triangle(z: f64, size: f64) -> [DVec3; 3] {
        [[-size, -size, z], [size, -size, z], [0.0, size, z]].map(DVec3::from)
    }

    #[test]
    fn only_points_behind_a_face_are_hidden() {
        for is_parallel in [true, false] {
            let tolerance = Tolerance::for_scene(4.0);
            let faces = [triangle(0.0, 1.5)].into_iter();
            let cover = DepthCover::new(faces, projector(is_parallel), [400; 2], &tolerance);
            let hides = |z, size| {
                cover.image_of(&triangle(z, size)).is_some_and(|image| cover.hides(&image))
            };
            assert!(hides(-0.01, 0.3) && hides(-2.0, 0.3), "behind: {is_parallel}");
            // Not hidden: the face itself, anything that touches it, anything in front of it, and
            // anything larger.
            assert!(!hides(0.0, 0.3) && !hides(-tolerance.world, 0.3) && !hides(0.5, 0.3));
            assert!(!hides(-0.01, 1.6), "larger: {is_parallel}");
            let along = |z| [[-0.2, 0.0, z], [0.2, 0.1, z]].map(DVec3::from);
            assert!(cover.hides_segment(along(-1.0)) && !cover.hides_segment(along(1.0)));
            let beside = [[1.8, 1.8, -1.0], [1.9, 1.9, -1.0]].map(DVec3::from);
            assert!(!cover.hides_segment(beside));
        }
    }

    #[test]
    fn faces_that_do_not_cover_a_whole_cell_hide_nothing() {
        let small = (0..900).map(|k| {
            let at = DVec3::new(f64::from(k % 30) * 0.004 - 0.06, f64::from(k / 30) * 0.004, 0.0);
            triangle(0.0, 0.004).map(|corner| corner + at)
        });
        let cover = DepthCover::new(small, projector(true), [400; 2], &Tolerance::for_scene(4.0));
        let behind = [[0.0, 0.05, -1.0], [0.01, 0.05, -1.0]].map(DVec3::from);
        assert!(!cover.hides_segment(behind));
    }

    #[test]
    fn visible_parts_contain_every_point_that_is_not_hidden() {
        for is_parallel in [true, false] {
            let cover = DepthCover::new(
                [triangle(0.0, 1.5)].into_iter(),
                projector(is_parallel),
                [400; 2],
                &Tolerance::for_scene(4.0),
            );
            let parts_of = |corners| {
                let mut parts = Vec::new();
                cover.add_visible_parts(corners, &mut parts);
                parts
            };
            assert!(parts_of(triangle(-1.0, 0.5)).is_empty(), "behind: {is_parallel}");
            let before = triangle(0.5, 1.9);
            assert_eq!(parts_of(before), [before], "in front: {is_parallel}");
            // The triangle extends beyond all sides of the face that hides its middle.
            let larger = triangle(-0.5, 1.9);
            let area = |[a, b, c]: [DVec3; 3]| 0.5 * (b - a).cross(c - a).length();
            let parts = parts_of(larger);
            let seen: f64 = parts.iter().map(|part| area(*part)).sum();
            assert!(seen > 0.3 * area(larger) && seen < 0.9 * area(larger), "{seen}");
            let is_in = |[a, b, c]: [DVec3; 3], p: DVec3| {
                let side = |a: DVec3, b: DVec3| (b - a).truncate().perp_dot((p - a).truncate());
                side(a, b) >= -1e-9 && side(b, c) >= -1e-9 && side(c, a) >= -1e-9
            };
            let [a, b, c] = larger;
            for k in 0..400_u32 {
                let [u, v] = [f64::from(k % 20) / 20.0, f64::from(k / 20) / 20.0];
                let point = a + (b - a) * u * (1.0 - v) + (c - a) * v;
                let is_hidden = cover.hides_segment([point, point]);
                assert!(is_hidden || parts.iter().any(|part| is_in(*part, point)), "{point}");
            }
        }
    }
}
