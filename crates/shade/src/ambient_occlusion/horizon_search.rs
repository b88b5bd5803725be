//! The horizon search: computes the visible arcs around the surfaces of one or eight pixels.

use super::screen_space::{PixelGrid, ScreenSpace};
use crate::approximations::floor_to_int;
use crate::kernel_part::kernel_part;
use crate::lanes::{Lanes, Vec3Lanes};
use raster::{Kernel, LANES};

/// Number of planes through the view direction in which to search for horizons at each pixel.
const SLICE_COUNT: usize = 4;
/// Number of steps in each of the two directions along a slice.
const STEP_COUNT: usize = 6;
/// The minimum cosine by which an occluder must rise above the surface; anything lower is the
/// surface itself.
const SURFACE_TOLERANCE: f32 = 0.002;
/// The minimum weight of a slice, to avoid dividing by zero.
const LEAST_WEIGHT: f32 = 1e-3;
/// The side length of the pattern that rotates the slices, in pixels.
const PATTERN_SIDE: usize = 4;
/// The order of the rotations in the pattern, a Bayer matrix, in which neighbors differ greatly.
const TURNS: [[u8; PATTERN_SIDE]; PATTERN_SIDE] =
    [[0, 8, 2, 10], [12, 4, 14, 6], [3, 11, 1, 9], [15, 7, 13, 5]];

/// The pattern that rotates slices and shifts steps from pixel to pixel.
///
/// Rows and columns repeat after four, so eight pixels are two periods.
pub(super) struct Pattern {
    /// The screen directions of the slices, x and y, for each row of the pattern.
    directions: [[[[f32; LANES]; 2]; SLICE_COUNT]; PATTERN_SIDE],
    /// The fraction of a step by which the steps of a pixel are shifted.
    step_offsets: [[f32; LANES]; PATTERN_SIDE],
}

impl Pattern {
    pub(super) fn new() -> Self {
        let mut directions = [[[[0.0; LANES]; 2]; SLICE_COUNT]; PATTERN_SIDE];
        let mut step_offsets = [[0.0; LANES]; PATTERN_SIDE];
        for (row, lane) in (0..PATTERN_SIDE).flat_map(|row| (0..LANES).map(move |lane| (row, lane)))
        {
            let turn = TURNS[row][lane % PATTERN_SIDE];
            for (slice, direction) in directions[row].iter_mut().enumerate() {
                let turned = slice as f64 + (f64::from(turn) + 0.5) / 16.0;
                let angle = std::f64::consts::PI * turned / SLICE_COUNT as f64;
                direction[0][lane] = libm::cos(angle) as f32;
                direction[1][lane] = libm::sin(angle) as f32;
            }
            // In a different order than the rotations, so that no direction has only long steps.
            step_offsets[row][lane] = ((u32::from(turn) * 5 + 8) % 16) as f32 / 16.0 + 1.0 / 32.0;
        }
        Self { directions, step_offsets }
    }
}

/// The kernel that computes the visibilities of pixels, starting at (x, y) and going right: either
/// eight, where x is a multiple of eight, or one.
pub(super) struct HorizonSearch<'a, const N: usize> {
    pub(super) space: &'a ScreenSpace,
    pub(super) pattern: &'a Pattern,
    pub(super) depths: &'a PixelGrid,
    pub(super) x: usize,
    pub(super) y: usize,
}

/// The surfaces visible at `N` pixels.
struct Surfaces<const N: usize> {
    /// The pixel columns and rows.
    pixels: [Lanes<N>; 2],
    /// Positions relative to the origin.
    positions: Vec3Lanes<N>,
    /// The depths at the pixels.
    depths: Lanes<N>,
    /// Unit normals, toward the viewer.
    normals: Vec3Lanes<N>,
    /// Unit vectors to the viewer.
    views: Vec3Lanes<N>,
    /// The radius in pixels.
    radii: Lanes<N>,
}

/// The plane of a slice at each of `N` pixels.
struct Slice<const N: usize> {
    /// The screen direction: x and y.
    direction: [Lanes<N>; 2],
    /// The length of the normal's projection into the slice, which is the weight of the slice.
    weight: Lanes<N>,
    /// The cosine of the angle from the view to the projected normal.
    cosine: Lanes<N>,
    /// The sine of this angle, positive if the normal leans along the screen direction.
    sine: Lanes<N>,
    /// The unit normal of the slice.
    slice_normal: Vec3Lanes<N>,
    /// A vector along the surface whose component perpendicular to the slice is 1.
    out_of_slice: Vec3Lanes<N>,
}

impl<const N: usize> Slice<N> {
    /// Computes the cosines of the angles from the view down to the surface itself, ahead and
    /// behind.
    #[inline(always)]
    fn surface_horizons(&self) -> [Lanes<N>; 2] {
        [-self.sine, self.sine]
    }

    /// Computes the light between two horizons, given by their cosines ahead and behind.
    #[inline(always)]
    fn visible_arc(&self, [ahead, behind]: [Lanes<N>; 2]) -> Lanes<N> {
        // Behind, the normal leans the other way.
        kernel_part!(
            N,
            integrate_arc(ahead, self.cosine, self.sine)
                + integrate_arc(behind, self.cosine, -self.sine)
        )
    }
}

impl<const N: usize> Kernel for HorizonSearch<'_, N> {
    type Output = [f32; N];

    #[inline(always)]
    fn run(self) -> [f32; N] {
        let depths = self.depths.lanes_at([self.x, self.y], [0, 0]);
        if depths.0 == [0.0; N] {
            return [1.0; N];
        }
        let surfaces = self.find_surfaces(depths);
        let (mut visible, mut open) = (Lanes::ZERO, Lanes::ZERO);
        for index in 0..SLICE_COUNT {
            let slice = self.project_normals(&surfaces, index);
            let [ahead, behind] = kernel_part!(N, self.find_horizons(&surfaces, &slice));
            visible += slice.weight * slice.visible_arc([ahead, behind]);
            // Evaluate the same expression here, so that the visibility of an unoccluded surface is
            // exactly 1.
            open += slice.weight * slice.visible_arc(slice.surface_horizons());
        }
        let visibility = (visible / open).max(0.0).min(1.0);
        // This also covers surfaces seen edge-on, whose visibility is unknown.
        visibility.select(&open.is_above(0.0), Lanes::ONE).0
    }
}

impl<const N: usize> HorizonSearch<'_, N> {
    /// Returns the pattern values for the pixels.
    #[inline(always)]
    fn lanes_of(&self, pattern: &[f32; LANES]) -> Lanes<N> {
        let start = self.x % LANES;
        let mut lanes = Lanes::ZERO;
        lanes.0.copy_from_slice(&pattern[start..start + N]);
        lanes
    }

    /// Reconstructs the surfaces at the pixels from the depth buffer.
    #[inline(always)]
    fn find_surfaces(&self, depths: Lanes<N>) -> Surfaces<N> {
        let space = self.space;
        let columns = Lanes::from_fn(|lane| (self.x + lane) as f32);
        let pixels = [columns, Lanes::splat(self.y as f32)];
        let positions = space.unproject_pixels(pixels, depths);
        // The surface's plane, from the neighboring pixels that continue it best.
        let [dx, dy] = depth_slopes(self.depths, [self.x, self.y], depths);
        let right = space.unproject_pixels([pixels[0] + 1.0, pixels[1]], depths + dx) - positions;
        let down = space.unproject_pixels([pixels[0], pixels[1] + 1.0], depths + dy) - positions;
        let views = space.views(positions);
        let normals = down.cross(right);
        let normals = normals * (1.0 / normals.dot(normals).sqrt());
        let is_away = normals.dot(views).is_below(0.0);
        let normals = (-normals).select(&is_away, normals);
        let screen_positions = space.project(positions);
        let radii = space.radius_in_pixels(positions, screen_positions);
        Surfaces { pixels, positions, depths, normals, views, radii }
    }

    /// Projects the normals into a slice to find the slice's weight and the surface's tilt in it.
    #[inline(always)]
    fn project_normals(&self, surfaces: &Surfaces<N>, index: usize) -> Slice<N> {
        let Surfaces { pixels, positions, depths, normals, views, radii } = surfaces;
        let directions = &self.pattern.directions[self.y % PATTERN_SIDE][index];
        let direction = [0, 1].map(|axis| self.lanes_of(&directions[axis]));
        let reach = radii.max(1.0);
        let ahead = [pixels[0] + direction[0] * reach, pixels[1] + direction[1] * reach];
        let along = self.space.unproject_pixels(ahead, *depths) - *positions;
        // The slice's direction in the world, perpendicular to the view.
        let across = along - *views * along.dot(*views);
        let across = across * (1.0 / across.dot(across).sqrt());
        let slice_normal = across.cross(*views);
        // The length of the projected normal weights the slice, and its angle tilts the arc.
        let lean = normals.dot(slice_normal);
        let projected = *normals - slice_normal * lean;
        let weight = projected.dot(projected).sqrt();
        let inv_weight = 1.0 / weight.max(LEAST_WEIGHT);
        let out_of_slice = slice_normal - projected * (lean * inv_weight * inv_weight);
        let cosine = (projected.dot(*views) * inv_weight).max(0.0).min(1.0);
        let sine = (projected.dot(across) * inv_weight).max(-1.0).min(1.0);
        Slice { direction, weight, cosine, sine, slice_normal, out_of_slice }
    }

    /// Finds the cosines of the angles from the view down to the horizons, ahead and behind.
    ///
    /// Each surface blocks the light between its height and the height of earlier surfaces.
    /// Occlusion falls off as 1 − (distance / radius)². If a surface faces the viewer, the light
    /// below a height is proportional to the square of the height.
    #[inline(always)]
    fn find_horizons(&self, surfaces: &Surfaces<N>, slice: &Slice<N>) -> [Lanes<N>; 2] {
        let inv_radius = 1.0 / self.space.radius();
        let step_offsets = self.lanes_of(&self.pattern.step_offsets[self.y % PATTERN_SIDE]);
        let surface_horizons = slice.surface_horizons();
        let mut occluded = [Lanes::ZERO; 2];
        let mut highest = [Lanes::splat(SURFACE_TOLERANCE * SURFACE_TOLERANCE); 2];
        for step in 0..STEP_COUNT {
            // Steps are shorter near the pixel, where occluders have the most weight.
            let t = (step as f32 + step_offsets) * (1.0 / STEP_COUNT as f32);
            let distance = 1.0 + t * t * (surfaces.radii - 1.0);
            for (side, sign) in [1.0, -1.0].into_iter().enumerate() {
                let (found, depths) = self.surface_at(surfaces, slice, distance * sign);
                let squared = found.dot(found);
                let height = found.dot(surfaces.views) / squared.sqrt() - surface_horizons[side];
                let light = height.max(0.0) * height;
                let radii = squared * (inv_radius * inv_radius);
                // Surfaces that are missing or too far away do not block light: they count as lower
                // than the highest surface.
                let is_near = radii.is_below(1.0);
                let light = light.select(&depths.is_above(0.0), Lanes::ZERO);
                let light = light.select(&is_near, Lanes::ZERO);
                let taken = (light - highest[side]).max(0.0) * (1.0 - radii.min(1.0));
                occluded[side] += taken;
                highest[side] = highest[side].max_lanes(light);
            }
        }
        [0, 1].map(|side| surface_horizons[side] + occluded[side].sqrt())
    }

    /// Returns the surfaces at pixels along a slice: their positions relative to the start of the
    /// slice, and their depths.
    #[inline(always)]
    fn surface_at(
        &self,
        surfaces: &Surfaces<N>,
        slice: &Slice<N>,
        distance: Lanes<N>,
    ) -> (Vec3Lanes<N>, Lanes<N>) {
        let [width, height] = self.space.size();
        let [column, row] = surfaces.pixels;
        let x = containing_pixels(column + slice.direction[0] * distance + 0.5, width);
        let y = containing_pixels(row + slice.direction[1] * distance + 0.5, height);
        let depths = Lanes::from_fn(|lane| self.depths.at([x[lane], y[lane]], [0, 0]));
        let columns = Lanes::from_fn(|lane| x[lane] as f32);
        let rows = Lanes::from_fn(|lane| y[lane] as f32);
        let found = self.space.unproject_pixels([columns, rows], depths) - surfaces.positions;
        // The pixel's center is not exactly in the slice. Move it there along the surface, so that
        // points on the surface stay on it.
        (found - slice.out_of_slice * found.dot(slice.slice_normal), depths)
    }
}

/// Returns the pixels that contain coordinates. Coordinates outside the picture are clamped to the
/// margin.
#[inline(always)]
fn containing_pixels<const N: usize>(coordinates: Lanes<N>, side: u32) -> [i32; N] {
    let mut pixels = [0; N];
    for (pixel, value) in pixels.iter_mut().zip(coordinates.0) {
        let is_inside = (value >= 0.0) & (value < side as f32);
        *pixel = floor_to_int(if is_inside { value } else { -1.0 });
    }
    pixels
}

/// Computes the change in depth per pixel to the right and down on the surface of each pixel.
///
/// Depth is linear on a plane, so this uses the neighbor that is more nearly collinear with the
/// pixel and the next pixel in that direction. At a silhouette, that neighbor is on the same
/// surface; at a crease, it is on one of the two faces.
#[inline(always)]
pub(super) fn depth_slopes<const N: usize>(
    grid: &PixelGrid,
    at: [usize; 2],
    depths: Lanes<N>,
) -> [Lanes<N>; 2] {
    [[1, 0], [0, 1]].map(|[dx, dy]: [isize; 2]| {
        let next = grid.lanes_at(at, [dx, dy]);
        let after_next = grid.lanes_at(at, [2 * dx, 2 * dy]);
        let last = grid.lanes_at(at, [-dx, -dy]);
        let before_last = grid.lanes_at(at, [-2 * dx, -2 * dy]);
        let (forward, backward) = (next - depths, depths - last);
        let forward_bend = (after_next - next - forward).abs();
        let backward_bend = (backward - (last - before_last)).abs();
        let mut slopes = Lanes::ZERO;
        for lane in 0..N {
            let (has_next, has_last) = (next[lane] > 0.0, last[lane] > 0.0);
            let takes_next = has_next & (!has_last | (forward_bend[lane] < backward_bend[lane]));
            let slope = if has_last { backward[lane] } else { 0.0 };
            slopes[lane] = if takes_next { forward[lane] } else { slope };
        }
        slopes
    })
}

/// Computes the light between the view and a horizon: the integral of the cosine to the normal
/// times the sine to the view, (cos n − cos(2h − n) + 2h · sin n) / 4 (Jimenez et al. 2016, eq. 7).
#[inline(always)]
fn integrate_arc<const N: usize>(horizon: Lanes<N>, cosine: Lanes<N>, sine: Lanes<N>) -> Lanes<N> {
    let horizon = horizon.max(-1.0).min(1.0);
    let angle = arc_cosines(horizon);
    let horizon_sine = (1.0 - horizon * horizon).sqrt();
    // The cosine of 2h − n from the cosines of h and n.
    let double_cosine = 2.0 * horizon * horizon - 1.0;
    let double_sine = 2.0 * horizon * horizon_sine;
    let difference = double_cosine * cosine + double_sine * sine;
    0.25 * (cosine - difference + 2.0 * angle * sine)
}

/// Computes the arc cosines of numbers from −1 to 1, with an error of at most 7 · 10⁻⁵ (Abramowitz
/// and Stegun 1964, 4.4.45).
#[inline(always)]
fn arc_cosines<const N: usize>(cosines: Lanes<N>) -> Lanes<N> {
    let x = cosines.abs();
    let polynomial = ((-0.018_729_3 * x + 0.074_261) * x - 0.212_114_4) * x + 1.570_728_8;
    let angle = (1.0 - x).sqrt() * polynomial;
    (std::f32::consts::PI - angle).select(&cosines.is_below(0.0), angle)
}
