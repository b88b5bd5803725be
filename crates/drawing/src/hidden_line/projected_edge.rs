//! The visible volume's part of an edge, on the screen and in the world.

use super::super::projector::Projector;
use glam::{DVec2, DVec3};

/// An edge within the view volume.
///
/// Places on it are named by s, the fraction of the way on the screen; the fraction of the way in the world, u, follows
/// by IN-1, for lines go to lines.
#[derive(Clone, Debug)]
pub(crate) struct ProjectedEdge {
    /// The ends on the screen, in pixels.
    pub(crate) screen: [DVec2; 2],
    /// The depths of the ends; on the screen they are linear.
    pub(crate) depths: [f64; 2],
    /// The ends in the world.
    pub(crate) world: [DVec3; 2],
    /// The divisors of the ends.
    w: [f64; 2],
    /// The fractions of the whole edge, in the world, at the ends.
    clip_range: [f64; 2],
}

impl ProjectedEdge {
    /// `None` if nothing of the edge is in the view volume.
    pub(crate) fn clip_and_project(ends: [DVec3; 2], sight: &Projector) -> Option<Self> {
        let clipped = sight.clip_edge(ends)?;
        let [a, b] = [sight.to_screen(clipped.start)?, sight.to_screen(clipped.end)?];
        let position = |t: f64| match t {
            0.0 => ends[0],
            1.0 => ends[1],
            t => ends[0] + (ends[1] - ends[0]) * t,
        };
        Some(Self {
            screen: [a.truncate(), b.truncate()],
            depths: [a.z, b.z],
            world: [position(clipped.t0), position(clipped.t1)],
            w: [clipped.start.w(), clipped.end.w()],
            clip_range: [clipped.t0, clipped.t1],
        })
    }

    /// The length on the screen in pixels.
    pub(crate) fn screen_length(&self) -> f64 {
        (self.screen[1] - self.screen[0]).length()
    }

    /// The place on the screen at s; at 0 and 1 with the bits of the ends.
    pub(crate) fn screen_at(&self, s: f64) -> DVec2 {
        let [a, b] = self.screen;
        if s == 1.0 { b } else { a + (b - a) * s }
    }

    pub(crate) fn depth_at(&self, s: f64) -> f64 {
        let [a, b] = self.depths;
        if s == 1.0 { b } else { a + (b - a) * s }
    }

    /// The fraction of the way in the world at the fraction s of the way on the screen (IN-1, inverse).
    pub(crate) fn world_fraction(&self, s: f64) -> f64 {
        let [r, q] = self.w;
        if r == q { s } else { r * s / (q + s * (r - q)) }
    }

    /// The fraction of the way on the screen at the fraction u of the way in the world (IN-1).
    pub(crate) fn screen_fraction(&self, u: f64) -> f64 {
        let [r, q] = self.w;
        if r == q { u } else { q * u / (r + u * (q - r)) }
    }

    /// The fraction of the whole edge, in the world, at s.
    pub(crate) fn edge_fraction(&self, s: f64) -> f64 {
        let [t0, t1] = self.clip_range;
        t0 + (t1 - t0) * self.world_fraction(s)
    }
}
