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

use super::seen::{cross, dot, lane_of};
use glam::DMat4;
use raster::Nearest;
use std::f32::consts::{FRAC_PI_2, PI};

/// How many planes through the view are looked along.
const SLICES: usize = 12;
/// The least and the most steps to either side, and how many pixels there are to each between.
const STEPS: [f32; 2] = [6.0, 20.0];
const PER_STEP: f32 = 8.0;
/// A height that nothing has.
const NOWHERE: f32 = -2.0;
/// How far below the surface, as a difference of cosines, something is the surface itself.
const LEVEL: f32 = 0.002;
/// How many radii away something is too far for its border to be within one.
const BEYOND: f32 = 2.0;
/// How often the border of the highest thing is looked for between two steps.
const HALVES: usize = 6;

/// What a picture shows of its scene, to tell occlusion from.
#[derive(Clone, Debug)]
pub struct ScreenSpace {
    pub(crate) nearest: Vec<Nearest>,
    size: [u32; 2],
    /// Where places are counted from.
    origin: [f32; 3],
    /// The rows of the map from places to (x·w, y·w, depth·w, w) on the screen, and of its inverse.
    to_screen: [[f32; 4]; 4],
    to_world: [[f32; 4]; 4],
    /// Across the view, as long as the radius.
    across: [f32; 3],
    radius: f32,
    /// The diagonal of the picture in pixels: nothing is farther away.
    diagonal: f32,
    /// The directions of the planes on the screen.
    ways: [[f32; 2]; SLICES],
}

/// A look from a place in one direction.
#[derive(Clone, Copy, Debug)]
struct Look {
    /// The place, from the origin, and the unit vector to the viewer.
    p: [f32; 3],
    v: [f32; 3],
    /// The place on the screen, and the direction there.
    here: [f32; 3],
    way: [f32; 2],
    /// The cosine of the angle from the view to the surface itself.
    low: f32,
}

impl ScreenSpace {
    /// By the nearest surfaces of a picture of this size, a matrix from the world to its pixels and depth, and how far away things
    /// still count; `across` is a unit vector across the view.
    pub(crate) fn new(
        nearest: Vec<Nearest>,
        size: [u32; 2],
        world_to_screen: DMat4,
        origin: glam::DVec3,
        across: glam::DVec3,
        radius: f64,
    ) -> Self {
        let moved = world_to_screen * DMat4::from_translation(origin.as_vec3().as_dvec3());
        let rows = |m: DMat4| [0, 1, 2, 3].map(|k| m.row(k).as_vec4().to_array());
        let ways = std::array::from_fn(|k| {
            let angle = std::f64::consts::PI * (k as f64 + 0.5) / SLICES as f64;
            [libm::cos(angle) as f32, libm::sin(angle) as f32]
        });
        Self {
            nearest,
            size,
            origin: origin.as_vec3().to_array(),
            to_screen: rows(moved),
            to_world: rows(moved.inverse()),
            across: (across * radius).as_vec3().to_array(),
            radius: radius as f32,
            diagonal: (size[0] as f32 * size[0] as f32 + size[1] as f32 * size[1] as f32).sqrt(),
            ways,
        }
    }

    /// The share of the light from all around that arrives at places with these unit normals and unit vectors to the viewer.
    #[inline(always)]
    pub(super) fn open<const N: usize>(
        &self,
        places: &[[f32; N]; 3],
        normals: &[[f32; N]; 3],
        views: &[[f32; N]; 3],
    ) -> [f32; N] {
        let mut open = [1.0; N];
        for lane in 0..N {
            let [p, n, v] = [places, normals, views].map(|vectors| lane_of(vectors, lane));
            open[lane] = self.open_at(p, n, v);
        }
        open
    }

    #[inline(never)]
    fn open_at(&self, place: [f32; 3], n: [f32; 3], v: [f32; 3]) -> f32 {
        let p = minus(place, self.origin);
        let (Some(here), Some(beside)) = (self.seen(p), self.seen(plus(p, self.across))) else {
            return 1.0;
        };
        let (dx, dy) = (beside[0] - here[0], beside[1] - here[1]);
        let reach = (dx * dx + dy * dy).sqrt().min(self.diagonal);
        if reach <= 1.0 || reach.is_nan() {
            return 1.0;
        }
        let (mut open, mut all) = (0.0, 0.0);
        for (number, way) in self.ways.into_iter().enumerate() {
            // Steps of one direction lie between those of the others, so that no border is seen several times side by side.
            let shift = (0.618_034 * number as f32) % 1.0;
            let ahead = [here[0] + way[0] * reach, here[1] + way[1] * reach, here[2]];
            let along = minus(self.placed(ahead), p);
            let back = dot(along, v);
            let flat = minus(along, v.map(|c| c * back));
            let length = dot(flat, flat).sqrt();
            if !(length > 0.0 && length.is_finite()) {
                continue;
            }
            let flat = flat.map(|c| c / length);
            // The normal within the plane, and its angle from the view.
            let axis = cross(flat, v);
            let lean = dot(n, axis);
            let inside = minus(n, axis.map(|c| c * lean));
            let share = dot(inside, inside).sqrt();
            let tilt = angle_of(dot(inside, v) / share.max(1e-6));
            let tilt = if dot(inside, flat) < 0.0 { -tilt } else { tilt };
            let look = Look { p, v, here, way, low: 0.0 };
            let up = self.horizon(look, [reach, shift], (FRAC_PI_2 + tilt).min(PI));
            let look = Look { way: [-way[0], -way[1]], ..look };
            let down = self.horizon(look, [reach, 1.0 - shift], (FRAC_PI_2 - tilt).min(PI));
            open += share * (arc(up, tilt) + arc(-down, tilt));
            // The same between the two sides of the surface.
            all += share * (libm::cosf(tilt) + tilt * libm::sinf(tilt));
        }
        if all > 0.0 { (open / all).clamp(0.0, 1.0) } else { 1.0 }
    }

    /// The angle from the view down to the highest thing in one direction, no more than that of the surface itself.
    #[inline(always)]
    fn horizon(&self, look: Look, [reach, shift]: [f32; 2], lowest: f32) -> f32 {
        let look = Look { low: libm::cosf(lowest), ..look };
        let steps = (reach / PER_STEP).clamp(STEPS[0], STEPS[1]).floor();
        // Steps are short nearby, where they count most.
        let far = |step: f32| {
            let t = (step + shift) / steps;
            1.0 + t * t * (reach - 1.0)
        };
        let (mut highest, mut at) = (NOWHERE, None);
        for step in 0..steps as i32 {
            let height = self.height(&look, far(step as f32));
            if height > highest {
                (highest, at) = (height, Some(step as f32));
            }
        }
        let Some(step) = at else { return lowest };
        // The best place, and the ends of what it is the best of.
        let (mut from, mut best, mut to) =
            (far((step - 1.0).max(-shift)), far(step), far(step + 1.0));
        for _ in 0..HALVES {
            let is_before = best - from > to - best;
            let probe = 0.5 * (best + if is_before { from } else { to });
            let height = self.height(&look, probe);
            match (height > highest, is_before) {
                (true, true) => (to, best) = (best, probe),
                (true, false) => (from, best) = (best, probe),
                (false, true) => from = probe,
                (false, false) => to = probe,
            }
            highest = highest.max(height);
        }
        if highest > look.low { angle_of(highest) } else { lowest }
    }

    /// The cosine of the angle from the view to what is seen so many pixels away, which is drawn to that of the surface the farther away it
    /// is. What is below the surface or beyond the radius hides nothing, and is ranked by how far it is from doing so: its border may, between
    /// two steps.
    #[inline(always)]
    fn height(&self, look: &Look, far: f32) -> f32 {
        let Look { p, v, here, way, low } = *look;
        let (x, y) = (here[0] + way[0] * far, here[1] + way[1] * far);
        let Some(depth) = self.depth(x, y) else { return NOWHERE };
        let apart = minus(self.placed([x, y, depth]), p);
        let distance = dot(apart, apart).sqrt();
        let near = distance / self.radius;
        let above = dot(apart, v) / distance - low;
        if !(distance > 0.0 && near < BEYOND) || (-LEVEL < above && above <= 0.0) {
            NOWHERE
        } else if near < 1.0 && above > 0.0 {
            low + above * (1.0 - near * near)
        } else {
            low + above.min(0.0) - (near - 1.0).max(0.0)
        }
    }

    /// A place on the screen.
    #[inline(always)]
    fn seen(&self, p: [f32; 3]) -> Option<[f32; 3]> {
        let w = image(&self.to_screen[3], p);
        let seen = [0, 1, 2].map(|k: usize| image(&self.to_screen[k], p) / w);
        (w > 0.0).then_some(seen)
    }

    /// The place in the world of one on the screen.
    #[inline(always)]
    fn placed(&self, s: [f32; 3]) -> [f32; 3] {
        let per = 1.0 / image(&self.to_world[3], s);
        [0, 1, 2].map(|k: usize| image(&self.to_world[k], s) * per)
    }

    /// The depth of what is seen somewhere on the screen.
    #[inline(always)]
    fn depth(&self, x: f32, y: f32) -> Option<f32> {
        let [width, height] = self.size;
        let (column, row) = (x.floor(), y.floor());
        if !(column >= 0.0 && row >= 0.0 && column < width as f32 && row < height as f32) {
            return None;
        }
        let at = self.nearest.get(row as usize * width as usize + column as usize)?;
        let depth = at.depth + at.dx * (x - column - 0.5) + at.dy * (y - row - 0.5);
        (depth > 0.0).then_some(depth)
    }
}

/// The light between the view and an angle in a plane where the normal leans by another: the integral of the cosine to the normal
/// times the sine to the view.
#[inline(always)]
fn arc(angle: f32, tilt: f32) -> f32 {
    let (sine, cosine) = (libm::sinf(tilt), libm::cosf(tilt));
    0.25 * (cosine - libm::cosf(2.0 * angle - tilt) + 2.0 * angle * sine)
}

#[inline(always)]
fn angle_of(cosine: f32) -> f32 {
    libm::acosf(cosine.clamp(-1.0, 1.0))
}

#[inline(always)]
fn image(row: &[f32; 4], p: [f32; 3]) -> f32 {
    row[0] * p[0] + row[1] * p[1] + row[2] * p[2] + row[3]
}

#[inline(always)]
fn minus(a: [f32; 3], b: [f32; 3]) -> [f32; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

#[inline(always)]
fn plus(a: [f32; 3], b: [f32; 3]) -> [f32; 3] {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}
