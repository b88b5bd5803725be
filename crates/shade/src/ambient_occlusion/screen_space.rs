//! The mapping between a depth buffer and the world, and pixel grids with a margin.

use crate::approximations::floor_to_int;
use crate::lanes::{Lanes, Vec3Lanes};
use glam::{DMat4, DVec3};
use raster::LANES;
use std::ops::{Add, Mul};

/// The mapping between the depth buffer of a picture and the world.
///
/// Positions are relative to a point near the surfaces, for precision in `f32`.
#[derive(Clone, Debug)]
pub struct ScreenSpace {
    /// Width and height in pixels.
    size: [u32; 2],
    /// The position in each pixel at which depth was sampled, from the upper left corner.
    sample_offset: [f32; 2],
    /// The origin that positions are relative to.
    origin: [f32; 3],
    /// The rows of the matrix from relative positions to (x·w, y·w, depth·w, w) on the screen.
    world_to_screen: [[f32; 4]; 4],
    /// The rows of the inverse matrix.
    screen_to_world: [[f32; 4]; 4],
    /// The viewer as a homogeneous relative position.
    viewer: [f32; 4],
    /// A vector perpendicular to the view, whose length is the radius.
    radius_across_view: [f32; 3],
    /// The distance in the world beyond which nothing occludes.
    radius: f32,
}

impl ScreenSpace {
    /// Creates the mapping for a picture of this size, whose depths were sampled at `sample_offset`
    /// in each pixel.
    ///
    /// `world_to_screen` maps the world to pixels and depth. `origin` is a position near the
    /// surfaces. `viewer` is the eye or, in parallel projection, the direction to it.
    /// `radius_across_view` is a vector in the world, perpendicular to the view, whose length is
    /// the distance within which surfaces occlude.
    pub fn new(
        size: [u32; 2],
        sample_offset: [f32; 2],
        world_to_screen: DMat4,
        origin: DVec3,
        viewer: [f64; 4],
        radius_across_view: DVec3,
    ) -> Self {
        let origin = origin.as_vec3();
        let relative_to_screen = world_to_screen * DMat4::from_translation(origin.as_dvec3());
        let rows = |m: DMat4| [0, 1, 2, 3].map(|k| m.row(k).as_vec4().to_array());
        let [x, y, z, w] = viewer;
        let eye = (DVec3::new(x, y, z) - origin.as_dvec3() * w).as_vec3();
        Self {
            size,
            sample_offset,
            origin: origin.to_array(),
            world_to_screen: rows(relative_to_screen),
            screen_to_world: rows(relative_to_screen.inverse()),
            viewer: [eye.x, eye.y, eye.z, w as f32],
            radius_across_view: radius_across_view.as_vec3().to_array(),
            radius: radius_across_view.length() as f32,
        }
    }

    /// Returns the width and height in pixels.
    pub(super) fn size(&self) -> [u32; 2] {
        self.size
    }

    /// Returns the distance in the world beyond which nothing occludes.
    #[inline(always)]
    pub(super) fn radius(&self) -> f32 {
        self.radius
    }

    /// Converts positions in the world to positions relative to the origin.
    #[inline(always)]
    pub(super) fn to_relative<const N: usize>(&self, positions: Vec3Lanes<N>) -> Vec3Lanes<N> {
        positions - Vec3Lanes::splat(self.origin)
    }

    /// Returns the unit vectors to the viewer.
    #[inline(always)]
    pub(super) fn views<const N: usize>(&self, positions: Vec3Lanes<N>) -> Vec3Lanes<N> {
        let [x, y, z, w] = self.viewer;
        let to_viewer = Vec3Lanes::splat([x, y, z]) - positions * w;
        to_viewer * (1.0 / to_viewer.dot(to_viewer).sqrt())
    }

    /// Returns positions on the screen, in pixels from the upper left corner, with their depths.
    #[inline(always)]
    pub(super) fn project<const N: usize>(&self, positions: Vec3Lanes<N>) -> Vec3Lanes<N> {
        let Vec3Lanes { x, y, z } = positions;
        let inv_w = 1.0 / transform_row(&self.world_to_screen[3], [x, y, z]);
        let [column, row, depth, _] = &self.world_to_screen;
        Vec3Lanes {
            x: transform_row(column, [x, y, z]),
            y: transform_row(row, [x, y, z]),
            z: transform_row(depth, [x, y, z]),
        } * inv_w
    }

    /// Converts screen positions with depths to relative positions in the world.
    #[inline(always)]
    pub(super) fn unproject<const N: usize>(
        &self,
        [x, y]: [Lanes<N>; 2],
        depth: Lanes<N>,
    ) -> Vec3Lanes<N> {
        let inv_w = 1.0 / transform_row(&self.screen_to_world[3], [x, y, depth]);
        let [to_x, to_y, to_z, _] = &self.screen_to_world;
        Vec3Lanes {
            x: transform_row(to_x, [x, y, depth]),
            y: transform_row(to_y, [x, y, depth]),
            z: transform_row(to_z, [x, y, depth]),
        } * inv_w
    }

    /// Computes the relative positions of the surfaces visible at pixels, given the columns, rows
    /// and depths.
    #[inline(always)]
    pub(super) fn unproject_pixels<const N: usize>(
        &self,
        [columns, rows]: [Lanes<N>; 2],
        depths: Lanes<N>,
    ) -> Vec3Lanes<N> {
        let [x, y] = self.sample_offset;
        self.unproject([columns + x, rows + y], depths)
    }

    /// Returns the columns and rows of the pixels in which positions appear. For positions outside
    /// the picture or behind the eye, returns a pixel in the margin.
    #[inline(always)]
    pub(super) fn pixels_at<const N: usize>(&self, positions: Vec3Lanes<N>) -> [[i32; 2]; N] {
        let projected = self.project(positions);
        let mut pixels = [[-2; 2]; N];
        let [width, height] = self.size.map(|side| side as f32);
        for (lane, pixel) in pixels.iter_mut().enumerate() {
            let [x, y, depth] = projected.lane(lane);
            // `&` instead of `&&` evaluates all conditions, without branches.
            let is_inside = (x >= 0.0) & (x < width) & (y >= 0.0) & (y < height) & (depth > 0.0);
            *pixel = [x, y].map(|c| if is_inside { floor_to_int(c) } else { -2 });
        }
        pixels
    }

    /// Computes the radius in pixels at `N` positions, limited to the diagonal of the picture.
    #[inline(always)]
    pub(super) fn radius_in_pixels<const N: usize>(
        &self,
        positions: Vec3Lanes<N>,
        screen_positions: Vec3Lanes<N>,
    ) -> Lanes<N> {
        let beside = self.project(positions + Vec3Lanes::splat(self.radius_across_view));
        let (x, y) = (beside.x - screen_positions.x, beside.y - screen_positions.y);
        let [width, height] = self.size.map(|side| side as f32);
        (x * x + y * y).sqrt().min((width * width + height * height).sqrt())
    }
}

/// Multiplies a row of an affine or projective matrix by positions.
#[inline(always)]
fn transform_row<T>(row: &[f32; 4], [x, y, z]: [T; 3]) -> T
where
    T: Copy + Add<Output = T> + Add<f32, Output = T> + Mul<f32, Output = T>,
{
    x * row[0] + y * row[1] + z * row[2] + row[3]
}

/// A number for each pixel of a picture, surrounded by a margin of zeros, so that pixels just
/// outside the picture can be read without a special case.
#[derive(Clone, Debug, Default)]
pub(super) struct PixelGrid {
    /// Width and height of the picture.
    size: [usize; 2],
    /// Number of values in a row including the margins, a multiple of eight.
    stride: usize,
    /// Rows from the top, starting with the margin.
    values: Vec<f32>,
}

/// The width of the margin in pixels on each side. Filters and lookups reach less far beyond the
/// border.
const MARGIN: usize = LANES;

impl PixelGrid {
    /// Resets the grid to zeros for a picture of this size.
    pub(super) fn reset(&mut self, size: [u32; 2]) {
        self.size = size.map(|side| side as usize);
        let [width, height] = self.size;
        self.stride = width.next_multiple_of(LANES) + 2 * MARGIN;
        self.values.clear();
        self.values.resize(self.stride * (height + 2 * MARGIN), 0.0);
    }

    /// Sets the pixels from the values of the picture, row by row.
    pub(super) fn fill_from(&mut self, mut numbers: impl Iterator<Item = f32>) {
        let width = self.size[0];
        for y in 0..self.size[1] {
            let start = (y + MARGIN) * self.stride + MARGIN;
            for (value, number) in self.values[start..start + width].iter_mut().zip(&mut numbers) {
                *value = number;
            }
        }
    }

    /// Returns the rows of the picture with their indices. Each row is extended to a multiple of
    /// eight pixels.
    pub(super) fn rows_mut(&mut self) -> impl ExactSizeIterator<Item = (usize, &mut [f32])> + Send {
        let width = self.stride - 2 * MARGIN;
        let rows = self.values.chunks_exact_mut(self.stride).skip(MARGIN).take(self.size[1]);
        rows.map(move |row| &mut row[MARGIN..MARGIN + width]).enumerate()
    }

    /// Returns the value of the pixel at an offset from another pixel, which is in the picture or
    /// up to two pixels outside it.
    #[inline(always)]
    pub(super) fn at(&self, [x, y]: [i32; 2], [dx, dy]: [i32; 2]) -> f32 {
        let (column, row) = ((x + dx) as isize, (y + dy) as isize);
        self.values
            [((row + MARGIN as isize) * self.stride as isize + column + MARGIN as isize) as usize]
    }

    /// Returns the values of a run of pixels to the right, starting at an offset of at most eight
    /// from a pixel.
    #[inline(always)]
    pub(super) fn lanes_at<const N: usize>(
        &self,
        [x, y]: [usize; 2],
        [dx, dy]: [isize; 2],
    ) -> Lanes<N> {
        let row = (y + MARGIN).wrapping_add_signed(dy);
        let start = row * self.stride + (x + MARGIN).wrapping_add_signed(dx);
        let mut lanes = Lanes::ZERO;
        lanes.0.copy_from_slice(&self.values[start..start + N]);
        lanes
    }
}
