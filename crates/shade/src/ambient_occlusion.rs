//! Screen-space ambient occlusion: the fraction of the light from all directions that arrives at a
//! surface, as far as the picture shows what is in its way (GTAO).
//!
//! ```text
//!          v  to the viewer
//!    h1 ╲  │  ╱ h2          in each of some planes through v, slices, the horizon is the
//!        ╲ │ ╱              highest surface on either side within a radius; between the
//!   ▟█▙▖  ╲│╱  ▗▟██▙        horizons light comes in (Jimenez and others, *Practical
//!   ███████●████████        real-time strategies for accurate indirect occlusion*, 2016)
//! ```
//!
//! Slices and steps are the same at every pixel, so that there is no noise to be blurred away, and
//! depths are read as planes, so that flat surfaces do not occlude themselves.
//!
//! The rule against banding: what a pixel finds must move with the pixel, without a jump. With
//! fixed steps alone it does not, in four ways, and each has its answer.
//! - A step lands somewhere below the upper border of a wall, elsewhere from pixel to pixel, and
//!   draws copies of the border on the ground. The border is therefore searched around the highest
//!   step, by bisection, until it is known to a fraction of a pixel.
//! - A wall that is left at the last step leaves with all that it hides. Nothing is therefore cut
//!   off on the screen: steps go as far as the radius does, however large that is in pixels, and
//!   with the radius occlusion falls off to nothing.
//! - Of a wall that leads away only the near end is within the radius, and steps pass it by. What
//!   is beyond the radius or below the surface is therefore ranked too, by how far it is from
//!   occluding something, and its border searched when nothing ranks above it.
//! - A slice passes a wall's corner at once. Each of many slices has little weight.
//!
//! All directions of all slices take a step at once: loops over them become vector instructions.

use super::lanes::{Lanes, Vec3Lanes};
use super::vector::{add, cross, dot, subtract};
use glam::DMat4;
use raster::SurfaceDepth;
use std::f32::consts::{FRAC_PI_2, PI};
use std::ops::{Add, Mul};

/// The planes through the view in which horizons are searched.
const SLICE_COUNT: usize = 12;
/// The directions on the screen: to both sides in each slice.
const DIRECTION_COUNT: usize = 2 * SLICE_COUNT;
/// The least and the most steps in a direction.
const STEP_COUNT_RANGE: [f32; 2] = [6.0, 20.0];
/// The mean length of a step between these limits.
const PIXELS_PER_STEP: f32 = 8.0;
/// A height below all others, as a cosine: nothing was found.
const NO_HORIZON: f32 = -2.0;
/// The depth below the surface, as a difference of cosines, within which something is the surface
/// itself.
const SURFACE_TOLERANCE: f32 = 0.002;
/// The distance in radii from which on the border of something cannot be within the radius.
const MAX_RADII: f32 = 2.0;
/// The bisections by which the border of the horizon is refined.
const REFINEMENT_STEPS: usize = 6;

/// The nearest surfaces of a picture, from which ambient occlusion is computed.
#[derive(Clone, Debug)]
pub struct AmbientOcclusion {
    /// The nearest surface of each pixel, rows from the top.
    pub nearest: Vec<SurfaceDepth>,
    /// Width and height in pixels.
    size: [u32; 2],
    /// The position that others are relative to, for precision.
    origin: [f32; 3],
    /// The rows of the matrix from relative positions to (x·w, y·w, depth·w, w) on the screen.
    world_to_screen: [[f32; 4]; 4],
    /// The rows of its inverse.
    screen_to_world: [[f32; 4]; 4],
    /// A vector across the view, as long as the radius.
    radius_across_view: [f32; 3],
    /// The distance in the world from which on nothing occludes.
    radius: f32,
    /// The diagonal of the picture in pixels: nothing is farther away.
    diagonal: f32,
    /// The directions on the screen: x and y.
    directions: [DirectionLanes; 2],
}

/// A number for each direction: first the one side of all slices, then the other.
type DirectionLanes = Lanes<DIRECTION_COUNT>;

/// The search for the horizons around one position.
#[derive(Clone, Copy, Debug)]
struct HorizonSearch {
    /// The position, relative to the origin.
    position: [f32; 3],
    /// The unit vector to the viewer.
    view: [f32; 3],
    /// The position on the screen, with its depth.
    screen_position: [f32; 3],
    /// The directions on the screen: x and y.
    directions: [DirectionLanes; 2],
    /// The fraction of a step by which each direction is ahead.
    step_offsets: DirectionLanes,
    /// The cosines of the angles from the view down to the surface itself.
    surface_cosines: DirectionLanes,
}

impl AmbientOcclusion {
    /// Occlusion by the nearest surfaces of a picture of this size.
    ///
    /// `world_to_screen` maps the world to pixels and depth; `origin` is a position near the
    /// surfaces; `across` is a unit vector across the view; within `radius` in the world surfaces
    /// occlude.
    pub fn new(
        nearest: Vec<SurfaceDepth>,
        size: [u32; 2],
        world_to_screen: DMat4,
        origin: glam::DVec3,
        across: glam::DVec3,
        radius: f64,
    ) -> Self {
        let relative_to_screen =
            world_to_screen * DMat4::from_translation(origin.as_vec3().as_dvec3());
        let rows = |m: DMat4| [0, 1, 2, 3].map(|k| m.row(k).as_vec4().to_array());
        let mut directions = [DirectionLanes::ZERO; 2];
        for slice in 0..SLICE_COUNT {
            let angle = std::f64::consts::PI * (slice as f64 + 0.5) / SLICE_COUNT as f64;
            let direction = [libm::cos(angle) as f32, libm::sin(angle) as f32];
            for (axis, component) in directions.iter_mut().zip(direction) {
                axis[slice] = component;
                axis[slice + SLICE_COUNT] = -component;
            }
        }
        Self {
            nearest,
            size,
            origin: origin.as_vec3().to_array(),
            world_to_screen: rows(relative_to_screen),
            screen_to_world: rows(relative_to_screen.inverse()),
            radius_across_view: (across * radius).as_vec3().to_array(),
            radius: radius as f32,
            diagonal: (size[0] as f32 * size[0] as f32 + size[1] as f32 * size[1] as f32).sqrt(),
            directions,
        }
    }

    /// The ambient visibility of positions in the world, 0 to 1: the fraction of the light from all
    /// directions that arrives there, for unit normals and unit vectors to the viewer.
    #[inline(always)]
    pub(super) fn visibility<const N: usize>(
        &self,
        positions: Vec3Lanes<N>,
        normals: Vec3Lanes<N>,
        views: Vec3Lanes<N>,
    ) -> Lanes<N> {
        Lanes::from_fn(|lane| {
            let [position, normal, view] =
                [positions, normals, views].map(|vectors| vectors.lane(lane));
            self.visibility_at(position, normal, view)
        })
    }

    /// The visibility of one position: the cosine-weighted arcs between the horizons, over all
    /// slices.
    ///
    /// The normalization by the unoccluded arcs makes the visibility of an open plane 1.
    #[inline(always)]
    fn visibility_at(&self, position: [f32; 3], normal: [f32; 3], view: [f32; 3]) -> f32 {
        let position = subtract(position, self.origin);
        let beside = self.project_to_screen(add(position, self.radius_across_view));
        let (Some(screen_position), Some(beside)) = (self.project_to_screen(position), beside)
        else {
            return 1.0;
        };
        // The radius in pixels; below one pixel nothing could be found.
        let (dx, dy) = (beside[0] - screen_position[0], beside[1] - screen_position[1]);
        // The projected radius, at most the diagonal of the picture.
        let screen_radius = (dx * dx + dy * dy).sqrt().min(self.diagonal);
        if screen_radius <= 1.0 || screen_radius.is_nan() {
            return 1.0;
        }
        let mut search = HorizonSearch {
            position,
            view,
            screen_position,
            directions: self.directions,
            step_offsets: Lanes::ZERO,
            surface_cosines: Lanes::ZERO,
        };
        let (mut weights, mut tilts) = ([0.0; SLICE_COUNT], [0.0; SLICE_COUNT]);
        for slice in 0..SLICE_COUNT {
            // Steps of one direction lie between those of the others, so that no border is found
            // several times side by side.
            let offset = (0.618_034 * slice as f32) % 1.0;
            search.step_offsets[slice] = offset;
            search.step_offsets[slice + SLICE_COUNT] = 1.0 - offset;
            (weights[slice], tilts[slice]) =
                self.project_normal(&search, normal, slice, screen_radius);
            let [up, down] = surface_horizons(tilts[slice]);
            search.surface_cosines[slice] = libm::cosf(up);
            search.surface_cosines[slice + SLICE_COUNT] = libm::cosf(down);
        }
        // Horizon search, then the visible arc of each slice, weighted by the projected normal.
        let horizons = self.find_horizons(&search, screen_radius);
        let (mut visible, mut all) = (0.0, 0.0);
        for (slice, (weight, tilt)) in weights.into_iter().zip(tilts).enumerate() {
            let mut angles = surface_horizons(tilt);
            for (angle, direction) in angles.iter_mut().zip([slice, slice + SLICE_COUNT]) {
                if horizons[direction] > search.surface_cosines[direction] {
                    *angle = acos_clamped(horizons[direction]);
                }
            }
            visible += weight * (integrate_arc(angles[0], tilt) + integrate_arc(-angles[1], tilt));
            // The arc between the two sides of the surface itself.
            all += weight * (libm::cosf(tilt) + tilt * libm::sinf(tilt));
        }
        if all > 0.0 { (visible / all).clamp(0.0, 1.0) } else { 1.0 }
    }

    /// Projects a normal into the plane of a slice: its length there, and its angle from the view.
    #[inline(always)]
    fn project_normal(
        &self,
        search: &HorizonSearch,
        normal: [f32; 3],
        slice: usize,
        screen_radius: f32,
    ) -> (f32, f32) {
        let HorizonSearch { position, view, screen_position, directions, .. } = search;
        let ahead = [
            screen_position[0] + directions[0][slice] * screen_radius,
            screen_position[1] + directions[1][slice] * screen_radius,
            screen_position[2],
        ];
        // The slice's direction in the world, perpendicular to the view.
        let along = subtract(self.unproject(ahead), *position);
        let along_view = dot(along, *view);
        let across = subtract(along, view.map(|c| c * along_view));
        let length = dot(across, across).sqrt();
        if !(length > 0.0 && length.is_finite()) {
            return (0.0, 0.0);
        }
        let across = across.map(|c| c / length);
        let slice_normal = cross(across, *view);
        let out_of_plane = dot(normal, slice_normal);
        // The projected normal: its length weights the slice, its angle tilts the arc.
        let projected = subtract(normal, slice_normal.map(|c| c * out_of_plane));
        let weight = dot(projected, projected).sqrt();
        let tilt = acos_clamped(dot(projected, *view) / weight.max(1e-6));
        (weight, if dot(projected, across) < 0.0 { -tilt } else { tilt })
    }

    /// The height of the horizon in each direction, as a cosine from the view.
    #[inline(always)]
    fn find_horizons(&self, search: &HorizonSearch, screen_radius: f32) -> DirectionLanes {
        let step_count = screen_radius / PIXELS_PER_STEP;
        let step_count = step_count.clamp(STEP_COUNT_RANGE[0], STEP_COUNT_RANGE[1]) as i32;
        // Steps are short nearby, where they have most weight.
        let distance = |step: f32, offset: f32| {
            let t = (step + offset) / step_count as f32;
            1.0 + t * t * (screen_radius - 1.0)
        };
        let mut horizons = DirectionLanes::splat(NO_HORIZON);
        let mut best_steps = DirectionLanes::splat(-1.0);
        for step in 0..step_count {
            let step = step as f32;
            let probes = search.step_offsets.map(|offset| distance(step, offset));
            let heights = self.horizon_heights(search, probes);
            for k in 0..DIRECTION_COUNT {
                let is_higher = heights[k] > horizons[k];
                best_steps[k] = if is_higher { step } else { best_steps[k] };
                horizons[k] = if is_higher { heights[k] } else { horizons[k] };
            }
        }
        // The best step, and its neighbors on either side.
        let offset = |k: usize| search.step_offsets[k];
        let before = DirectionLanes::from_fn(|k| {
            let before = best_steps[k] - 1.0;
            distance(if before > -offset(k) { before } else { -offset(k) }, offset(k))
        });
        let best = DirectionLanes::from_fn(|k| distance(best_steps[k], offset(k)));
        let after = DirectionLanes::from_fn(|k| distance(best_steps[k] + 1.0, offset(k)));
        self.refine_horizons(search, [before, best, after], &mut horizons);
        DirectionLanes::splat(NO_HORIZON).select(&best_steps.is_below(0.0), horizons)
    }

    /// Searches for higher horizons between the ends of an interval around the best distance, by
    /// bisection of its larger half.
    #[inline(always)]
    fn refine_horizons(
        &self,
        search: &HorizonSearch,
        [mut from, mut best, mut to]: [DirectionLanes; 3],
        horizons: &mut DirectionLanes,
    ) {
        for _ in 0..REFINEMENT_STEPS {
            let (mut probes, mut is_before) = (DirectionLanes::ZERO, [false; DIRECTION_COUNT]);
            for (k, is_before) in is_before.iter_mut().enumerate() {
                *is_before = best[k] - from[k] > to[k] - best[k];
                probes[k] = 0.5 * (best[k] + if *is_before { from[k] } else { to[k] });
            }
            let heights = self.horizon_heights(search, probes);
            for (k, is_before) in is_before.into_iter().enumerate() {
                let is_higher = heights[k] > horizons[k];
                // The end that moves: to the old best on the one side of a new best, and otherwise
                // to the probe on its own side.
                let near = if is_higher { best[k] } else { probes[k] };
                let moves_from = is_higher != is_before;
                from[k] = if moves_from { near } else { from[k] };
                to[k] = if moves_from { to[k] } else { near };
                best[k] = if is_higher { probes[k] } else { best[k] };
                horizons[k] = if is_higher { heights[k] } else { horizons[k] };
            }
        }
    }

    /// The heights of the surfaces at some pixels' distance in each direction, as cosines of the
    /// angle from the view.
    ///
    /// A height is drawn to that of the surface itself the farther away it is: occlusion falls off
    /// with the square of the distance. What is below the surface or beyond the radius occludes
    /// nothing, and is ranked by how far it is from doing so: its border may, between two steps.
    #[inline(always)]
    fn horizon_heights(&self, search: &HorizonSearch, distances: DirectionLanes) -> DirectionLanes {
        let HorizonSearch { position, view, screen_position, directions, .. } = search;
        let surface = &search.surface_cosines;
        // The surfaces there, in the world, relative to the position.
        let x = screen_position[0] + directions[0] * distances;
        let y = screen_position[1] + directions[1] * distances;
        let depths = self.sample_depths(x, y);
        let found = Vec3Lanes::from(self.unproject([x, y, depths]));
        let offsets = found - Vec3Lanes::splat(*position);
        let distances = offsets.dot(offsets).sqrt();
        let radii = distances / self.radius;
        let above = offsets.dot(Vec3Lanes::splat(*view)) / distances - *surface;
        DirectionLanes::from_fn(|k| {
            let (above, radii, surface) = (above[k], radii[k], surface[k]);
            // `&` instead of `&&`: all conditions are computed, without branches.
            let is_found = (depths[k] > 0.0) & (distances[k] > 0.0) & (radii < MAX_RADII);
            let is_surface_itself = (-SURFACE_TOLERANCE < above) & (above <= 0.0);
            // Falloff with the square of the distance over the radius.
            let occluding = surface + above * (1.0 - radii * radii);
            let below = if above < 0.0 { above } else { 0.0 };
            let beyond = if radii > 1.0 { radii - 1.0 } else { 0.0 };
            let ranked = surface + below - beyond;
            let height = if (radii < 1.0) & (above > 0.0) { occluding } else { ranked };
            if is_found & !is_surface_itself { height } else { NO_HORIZON }
        })
    }

    /// The depths of the nearest surfaces at positions on the screen, on the surfaces' planes; not
    /// above 0 where there are none.
    #[inline(always)]
    fn sample_depths(&self, x: DirectionLanes, y: DirectionLanes) -> DirectionLanes {
        let [width, height] = self.size.map(|side| side as f32);
        let (mut columns, mut rows) = ([0; DIRECTION_COUNT], [0; DIRECTION_COUNT]);
        let mut is_inside = [false; DIRECTION_COUNT];
        for k in 0..DIRECTION_COUNT {
            is_inside[k] = (x[k] >= 0.0) & (y[k] >= 0.0) & (x[k] < width) & (y[k] < height);
            columns[k] = if is_inside[k] { x[k] } else { 0.0 } as i32;
            rows[k] = if is_inside[k] { y[k] } else { 0.0 } as i32;
        }
        let mut surfaces = [SurfaceDepth::EMPTY; DIRECTION_COUNT];
        for (surface, (column, row)) in surfaces.iter_mut().zip(columns.into_iter().zip(rows)) {
            // A gather, from a position that is on the picture in any case.
            let index = row as usize * self.size[0] as usize + column as usize;
            *surface = self.nearest.get(index).copied().unwrap_or(SurfaceDepth::EMPTY);
        }
        DirectionLanes::from_fn(|k| {
            let SurfaceDepth { depth, dx, dy } = surfaces[k];
            let (right, down) = (x[k] - columns[k] as f32 - 0.5, y[k] - rows[k] as f32 - 0.5);
            let depth = depth + dx * right + dy * down;
            if is_inside[k] { depth } else { 0.0 }
        })
    }

    /// A relative position on the screen, with its depth; `None` behind the eye.
    #[inline(always)]
    fn project_to_screen(&self, position: [f32; 3]) -> Option<[f32; 3]> {
        let w = transform_row(&self.world_to_screen[3], position);
        let projected =
            [0, 1, 2].map(|k: usize| transform_row(&self.world_to_screen[k], position) / w);
        (w > 0.0).then_some(projected)
    }

    /// The relative position in the world of one on the screen with a depth.
    #[inline(always)]
    fn unproject<T>(&self, screen_position: [T; 3]) -> [T; 3]
    where
        T: Copy + Add<Output = T> + Add<f32, Output = T> + Mul<Output = T> + Mul<f32, Output = T>,
        f32: std::ops::Div<T, Output = T>,
    {
        let inv_w = 1.0 / transform_row(&self.screen_to_world[3], screen_position);
        let [x, y, z, _] = &self.screen_to_world;
        [
            transform_row(x, screen_position) * inv_w,
            transform_row(y, screen_position) * inv_w,
            transform_row(z, screen_position) * inv_w,
        ]
    }
}

/// The angles from the view down to the surface itself, to either side, in a slice where its normal
/// is tilted by an angle.
#[inline(always)]
fn surface_horizons(tilt: f32) -> [f32; 2] {
    [(FRAC_PI_2 + tilt).min(PI), (FRAC_PI_2 - tilt).min(PI)]
}

/// The light between the view and an angle in a slice where the normal is tilted by another: the
/// integral of the cosine to the normal times the sine to the view (Jimenez et al. 2016, eq. 7).
#[inline(always)]
fn integrate_arc(angle: f32, tilt: f32) -> f32 {
    let (sine, cosine) = (libm::sinf(tilt), libm::cosf(tilt));
    0.25 * (cosine - libm::cosf(2.0 * angle - tilt) + 2.0 * angle * sine)
}

/// The angle with a cosine that rounding may have put beyond ±1.
#[inline(always)]
fn acos_clamped(cosine: f32) -> f32 {
    libm::acosf(cosine.clamp(-1.0, 1.0))
}

/// A row of an affine or projective matrix times a position: of one, or of lanes.
#[inline(always)]
fn transform_row<T>(row: &[f32; 4], [x, y, z]: [T; 3]) -> T
where
    T: Copy + Add<Output = T> + Add<f32, Output = T> + Mul<f32, Output = T>,
{
    x * row[0] + y * row[1] + z * row[2] + row[3]
}
