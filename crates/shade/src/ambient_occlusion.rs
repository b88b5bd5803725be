//! Ambient occlusion in screen space: how much of the light from all around a place sees, as far as the picture shows what is in
//! the way.
//!
//! ```text
//!          v  to the viewer
//!    h1 ╲  │  ╱ h2          in each of some planes through v, the highest
//!        ╲ │ ╱              thing on either side within a radius; between the two
//!   ▟█▙▖  ╲│╱  ▗▟██▙        the light comes in (Jimenez and others, *Practical
//!   ███████●████████        real-time strategies for accurate indirect occlusion*, 2016)
//! ```
//!
//! The planes and steps are the same at every pixel, so there is no noise to be blurred away, and depths are read as planes, so
//! that flat surfaces do not occlude themselves.
//!
//! The rule against stripes: what a pixel finds must move with the pixel, without a step. With fixed steps alone it does not, in four
//! ways, and each has its answer.
//! - A step lands somewhere below the upper border of a wall, elsewhere from pixel to pixel, and draws copies of the border on the
//!   ground. The border is therefore sought around the highest step, by halves, until it is known to a part of a pixel.
//! - A wall that is left at the last step leaves with all that it hides. Nothing is therefore cut off on the screen: steps go as far as
//!   the radius does, however large that is in pixels, and at the radius nothing counts any more.
//! - Of a wall that leads away only the near end is within the radius, and steps pass it by. What is beyond the radius or below the
//!   surface is therefore ranked too, by how far it is from hiding something, and its border sought when nothing ranks above it.
//! - A plane passes a wall's corner at once. Each of many planes counts little.
//!
//! All directions of all planes take a step at once: plain loops over them become vector instructions.

use super::fragment_lanes::{cross, dot, lane_vector};
use glam::DMat4;
use raster::SurfaceDepth;
use std::f32::consts::{FRAC_PI_2, PI};

/// How many planes through the view are looked along.
const SLICE_COUNT: usize = 12;
/// To either side.
const DIRECTION_COUNT: usize = 2 * SLICE_COUNT;
/// The least and the most steps to either side, and how many pixels there are to each between.
const STEP_COUNT_RANGE: [f32; 2] = [6.0, 20.0];
const PIXELS_PER_STEP: f32 = 8.0;
/// A height that nothing has.
const NO_HORIZON: f32 = -2.0;
/// How far below the surface, as a difference of cosines, something is the surface itself.
const SURFACE_TOLERANCE: f32 = 0.002;
/// How many radii away something is too far for its border to be within one.
const MAX_RADII: f32 = 2.0;
/// How often the border of the highest thing is looked for between two steps.
const REFINEMENT_STEPS: usize = 6;

/// What a picture shows of its scene, to tell occlusion from.
#[derive(Clone, Debug)]
pub struct AmbientOcclusion {
    /// The nearest surface of each pixel.
    pub nearest: Vec<SurfaceDepth>,
    size: [u32; 2],
    /// Where places are counted from.
    origin: [f32; 3],
    /// The rows of the map from places to (x·w, y·w, depth·w, w) on the screen, and of its inverse.
    world_to_screen: [[f32; 4]; 4],
    screen_to_world: [[f32; 4]; 4],
    /// Across the view, as long as the radius.
    radius_across_view: [f32; 3],
    radius: f32,
    /// The diagonal of the picture in pixels: nothing is farther away.
    diagonal: f32,
    /// The directions on the screen.
    directions: [DirectionLanes; 2],
}

/// A number for each direction: first those to one side, then those to the other.
type DirectionLanes = [f32; DIRECTION_COUNT];

/// A look from a place in all directions.
#[derive(Clone, Copy, Debug)]
struct HorizonSearch {
    /// The place, from the origin, and the unit vector to the viewer.
    position: [f32; 3],
    view: [f32; 3],
    /// The place on the screen, and the directions there.
    screen_position: [f32; 3],
    directions: [DirectionLanes; 2],
    /// How far the steps of each direction are from full ones.
    step_offsets: DirectionLanes,
    /// The cosines of the angles from the view to the surface itself.
    surface_cosines: DirectionLanes,
}

impl AmbientOcclusion {
    /// By the nearest surfaces of a picture of this size, a matrix from the world to its pixels and depth, and how far away things
    /// still count; `across` is a unit vector across the view.
    pub fn new(
        nearest: Vec<SurfaceDepth>,
        size: [u32; 2],
        world_to_screen: DMat4,
        origin: glam::DVec3,
        across: glam::DVec3,
        radius: f64,
    ) -> Self {
        let moved = world_to_screen * DMat4::from_translation(origin.as_vec3().as_dvec3());
        let rows = |m: DMat4| [0, 1, 2, 3].map(|k| m.row(k).as_vec4().to_array());
        let mut directions = [[0.0; DIRECTION_COUNT]; 2];
        for slice in 0..SLICE_COUNT {
            let angle = std::f64::consts::PI * (slice as f64 + 0.5) / SLICE_COUNT as f64;
            let way = [libm::cos(angle) as f32, libm::sin(angle) as f32];
            for axis in 0..2 {
                directions[axis][slice] = way[axis];
                directions[axis][slice + SLICE_COUNT] = -way[axis];
            }
        }
        Self {
            nearest,
            size,
            origin: origin.as_vec3().to_array(),
            world_to_screen: rows(moved),
            screen_to_world: rows(moved.inverse()),
            radius_across_view: (across * radius).as_vec3().to_array(),
            radius: radius as f32,
            diagonal: (size[0] as f32 * size[0] as f32 + size[1] as f32 * size[1] as f32).sqrt(),
            directions,
        }
    }

    /// The share of the light from all around that arrives at places with these unit normals and unit vectors to the viewer.
    #[inline(always)]
    pub(super) fn visibility<const N: usize>(
        &self,
        places: &[[f32; N]; 3],
        normals: &[[f32; N]; 3],
        views: &[[f32; N]; 3],
    ) -> [f32; N] {
        let mut open = [1.0; N];
        for lane in 0..N {
            let [p, n, v] = [places, normals, views].map(|vectors| lane_vector(vectors, lane));
            open[lane] = self.visibility_at(p, n, v);
        }
        open
    }

    #[inline(always)]
    fn visibility_at(&self, place: [f32; 3], n: [f32; 3], v: [f32; 3]) -> f32 {
        let p = subtract(place, self.origin);
        let (Some(here), Some(beside)) = (
            self.project_to_screen(p),
            self.project_to_screen(add_vectors(p, self.radius_across_view)),
        ) else {
            return 1.0;
        };
        let (dx, dy) = (beside[0] - here[0], beside[1] - here[1]);
        let reach = (dx * dx + dy * dy).sqrt().min(self.diagonal);
        if reach <= 1.0 || reach.is_nan() {
            return 1.0;
        }
        let nothing = [0.0; DIRECTION_COUNT];
        let mut look = HorizonSearch {
            position: p,
            view: v,
            screen_position: here,
            directions: self.directions,
            step_offsets: nothing,
            surface_cosines: nothing,
        };
        let (mut shares, mut tilts) = ([0.0; SLICE_COUNT], [0.0; SLICE_COUNT]);
        for slice in 0..SLICE_COUNT {
            // Steps of one direction lie between those of the others, so that no border is seen several times side by side.
            let shift = (0.618_034 * slice as f32) % 1.0;
            (look.step_offsets[slice], look.step_offsets[slice + SLICE_COUNT]) =
                (shift, 1.0 - shift);
            (shares[slice], tilts[slice]) = self.project_normal(&look, n, slice, reach);
            let [up, down] = surface_horizons(tilts[slice]);
            (look.surface_cosines[slice], look.surface_cosines[slice + SLICE_COUNT]) =
                (libm::cosf(up), libm::cosf(down));
        }
        let highest = self.find_horizons(&look, reach);
        let (mut open, mut all) = (0.0, 0.0);
        for slice in 0..SLICE_COUNT {
            let (share, tilt) = (shares[slice], tilts[slice]);
            let mut angles = surface_horizons(tilt);
            for (angle, direction) in angles.iter_mut().zip([slice, slice + SLICE_COUNT]) {
                if highest[direction] > look.surface_cosines[direction] {
                    *angle = acos_clamped(highest[direction]);
                }
            }
            open += share * (integrate_arc(angles[0], tilt) + integrate_arc(-angles[1], tilt));
            // The same between the two sides of the surface.
            all += share * (libm::cosf(tilt) + tilt * libm::sinf(tilt));
        }
        if all > 0.0 { (open / all).clamp(0.0, 1.0) } else { 1.0 }
    }

    /// How much of a normal lies within a plane, and its angle from the view there.
    #[inline(always)]
    fn project_normal(
        &self,
        look: &HorizonSearch,
        n: [f32; 3],
        slice: usize,
        reach: f32,
    ) -> (f32, f32) {
        let HorizonSearch { position: p, view: v, screen_position: here, directions: ways, .. } =
            look;
        let ahead = [here[0] + ways[0][slice] * reach, here[1] + ways[1][slice] * reach, here[2]];
        let along = subtract(self.unproject(ahead), *p);
        let back = dot(along, *v);
        let flat = subtract(along, v.map(|c| c * back));
        let length = dot(flat, flat).sqrt();
        if !(length > 0.0 && length.is_finite()) {
            return (0.0, 0.0);
        }
        let flat = flat.map(|c| c / length);
        let axis = cross(flat, *v);
        let lean = dot(n, axis);
        let inside = subtract(n, axis.map(|c| c * lean));
        let share = dot(inside, inside).sqrt();
        let tilt = acos_clamped(dot(inside, *v) / share.max(1e-6));
        (share, if dot(inside, flat) < 0.0 { -tilt } else { tilt })
    }

    /// The height of the highest thing in each direction.
    #[inline(always)]
    fn find_horizons(&self, look: &HorizonSearch, reach: f32) -> DirectionLanes {
        let steps =
            (reach / PIXELS_PER_STEP).clamp(STEP_COUNT_RANGE[0], STEP_COUNT_RANGE[1]) as i32;
        // Steps are short nearby, where they count most.
        let far = |step: f32, shift: f32| {
            let t = (step + shift) / steps as f32;
            1.0 + t * t * (reach - 1.0)
        };
        let (mut highest, mut at) = ([NO_HORIZON; DIRECTION_COUNT], [-1.0; DIRECTION_COUNT]);
        for step in 0..steps {
            let mut probes = [0.0; DIRECTION_COUNT];
            for (probe, &shift) in probes.iter_mut().zip(&look.step_offsets) {
                *probe = far(step as f32, shift);
            }
            let heights = self.horizon_heights(look, &probes);
            for k in 0..DIRECTION_COUNT {
                let is_higher = heights[k] > highest[k];
                at[k] = if is_higher { step as f32 } else { at[k] };
                highest[k] = if is_higher { heights[k] } else { highest[k] };
            }
        }
        // The best place, and the ends of what it is the best of.
        let mut ends = [[0.0; DIRECTION_COUNT]; 3];
        for (k, &shift) in look.step_offsets.iter().enumerate() {
            let before = at[k] - 1.0;
            ends[0][k] = far(if before > -shift { before } else { -shift }, shift);
            ends[1][k] = far(at[k], shift);
            ends[2][k] = far(at[k] + 1.0, shift);
        }
        self.refine_horizons(look, ends, &mut highest);
        for k in 0..DIRECTION_COUNT {
            highest[k] = if at[k] < 0.0 { NO_HORIZON } else { highest[k] };
        }
        highest
    }

    /// Looks for higher places between the ends, which are on both sides of the best.
    #[inline(always)]
    fn refine_horizons(
        &self,
        look: &HorizonSearch,
        [mut from, mut best, mut to]: [DirectionLanes; 3],
        highest: &mut DirectionLanes,
    ) {
        for _ in 0..REFINEMENT_STEPS {
            let (mut probes, mut is_before) = ([0.0; DIRECTION_COUNT], [false; DIRECTION_COUNT]);
            for k in 0..DIRECTION_COUNT {
                is_before[k] = best[k] - from[k] > to[k] - best[k];
                probes[k] = 0.5 * (best[k] + if is_before[k] { from[k] } else { to[k] });
            }
            let heights = self.horizon_heights(look, &probes);
            for k in 0..DIRECTION_COUNT {
                let is_higher = heights[k] > highest[k];
                // What is nearer on the one side of the new best is the old best, and the probe on its own side otherwise.
                let near = if is_higher { best[k] } else { probes[k] };
                let moves_from = is_higher != is_before[k];
                from[k] = if moves_from { near } else { from[k] };
                to[k] = if moves_from { to[k] } else { near };
                best[k] = if is_higher { probes[k] } else { best[k] };
                highest[k] = if is_higher { heights[k] } else { highest[k] };
            }
        }
    }

    /// The cosine of the angle from the view to what is seen so many pixels away in each direction, which is drawn to that of the
    /// surface the farther away it is. What is below the surface or beyond the radius hides nothing, and is ranked by how far it is from
    /// doing so: its border may, between two steps.
    #[inline(always)]
    fn horizon_heights(&self, look: &HorizonSearch, far: &DirectionLanes) -> DirectionLanes {
        let HorizonSearch {
            position: p,
            view: v,
            screen_position: here,
            directions: ways,
            surface_cosines: lows,
            ..
        } = look;
        let (mut x, mut y) = ([0.0; DIRECTION_COUNT], [0.0; DIRECTION_COUNT]);
        for k in 0..DIRECTION_COUNT {
            x[k] = here[0] + ways[0][k] * far[k];
            y[k] = here[1] + ways[1][k] * far[k];
        }
        let depths = self.sample_depths(&x, &y);
        let mut heights = [0.0; DIRECTION_COUNT];
        for k in 0..DIRECTION_COUNT {
            let apart = subtract(self.unproject([x[k], y[k], depths[k]]), *p);
            let distance = dot(apart, apart).sqrt();
            let near = distance / self.radius;
            let above = dot(apart, *v) / distance - lows[k];
            let is_seen = (depths[k] > 0.0) & (distance > 0.0) & (near < MAX_RADII);
            let is_level = (-SURFACE_TOLERANCE < above) & (above <= 0.0);
            let hiding = lows[k] + above * (1.0 - near * near);
            let below = if above < 0.0 { above } else { 0.0 };
            let beyond = if near > 1.0 { near - 1.0 } else { 0.0 };
            let ranked = lows[k] + below - beyond;
            let height = if (near < 1.0) & (above > 0.0) { hiding } else { ranked };
            heights[k] = if is_seen & !is_level { height } else { NO_HORIZON };
        }
        heights
    }

    /// The depths of what is seen somewhere on the screen, not above 0 where nothing is.
    #[inline(always)]
    fn sample_depths(&self, x: &DirectionLanes, y: &DirectionLanes) -> DirectionLanes {
        let [width, height] = self.size.map(|side| side as f32);
        let (mut columns, mut rows) = ([0; DIRECTION_COUNT], [0; DIRECTION_COUNT]);
        let mut is_inside = [false; DIRECTION_COUNT];
        for k in 0..DIRECTION_COUNT {
            is_inside[k] = (x[k] >= 0.0) & (y[k] >= 0.0) & (x[k] < width) & (y[k] < height);
            columns[k] = if is_inside[k] { x[k] } else { 0.0 } as i32;
            rows[k] = if is_inside[k] { y[k] } else { 0.0 } as i32;
        }
        let mut seen = [SurfaceDepth::EMPTY; DIRECTION_COUNT];
        for k in 0..DIRECTION_COUNT {
            let at = rows[k] as usize * self.size[0] as usize + columns[k] as usize;
            seen[k] = self.nearest.get(at).copied().unwrap_or(SurfaceDepth::EMPTY);
        }
        let mut depths = [0.0; DIRECTION_COUNT];
        for k in 0..DIRECTION_COUNT {
            let (right, down) = (x[k] - columns[k] as f32 - 0.5, y[k] - rows[k] as f32 - 0.5);
            let depth = seen[k].depth + seen[k].dx * right + seen[k].dy * down;
            depths[k] = if is_inside[k] { depth } else { 0.0 };
        }
        depths
    }

    /// A place on the screen.
    #[inline(always)]
    fn project_to_screen(&self, p: [f32; 3]) -> Option<[f32; 3]> {
        let w = transform_row(&self.world_to_screen[3], p);
        let seen = [0, 1, 2].map(|k: usize| transform_row(&self.world_to_screen[k], p) / w);
        (w > 0.0).then_some(seen)
    }

    /// The place in the world of one on the screen.
    #[inline(always)]
    fn unproject(&self, s: [f32; 3]) -> [f32; 3] {
        let per = 1.0 / transform_row(&self.screen_to_world[3], s);
        [0, 1, 2].map(|k: usize| transform_row(&self.screen_to_world[k], s) * per)
    }
}

/// The angles from the view down to the surface itself, to either side, in a plane where its normal leans by an angle.
#[inline(always)]
fn surface_horizons(tilt: f32) -> [f32; 2] {
    [(FRAC_PI_2 + tilt).min(PI), (FRAC_PI_2 - tilt).min(PI)]
}

/// The light between the view and an angle in a plane where the normal leans by another: the integral of the cosine to the normal
/// times the sine to the view.
#[inline(always)]
fn integrate_arc(angle: f32, tilt: f32) -> f32 {
    let (sine, cosine) = (libm::sinf(tilt), libm::cosf(tilt));
    0.25 * (cosine - libm::cosf(2.0 * angle - tilt) + 2.0 * angle * sine)
}

#[inline(always)]
fn acos_clamped(cosine: f32) -> f32 {
    libm::acosf(cosine.clamp(-1.0, 1.0))
}

#[inline(always)]
fn transform_row(row: &[f32; 4], p: [f32; 3]) -> f32 {
    row[0] * p[0] + row[1] * p[1] + row[2] * p[2] + row[3]
}

#[inline(always)]
fn subtract(a: [f32; 3], b: [f32; 3]) -> [f32; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

#[inline(always)]
fn add_vectors(a: [f32; 3], b: [f32; 3]) -> [f32; 3] {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}
