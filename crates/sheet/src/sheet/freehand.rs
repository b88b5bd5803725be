//! Freehand lines: the borders of local sections and broken views (ISO 128-2, line 01.1.18).
//!
//! A freehand line wavers around its path. Its deviation is a sum of sines with fixed parameters,
//! so it is the same in every drawing of a part.

use drawing::circle_points;
use glam::DVec2;
use std::f64::consts::TAU;

/// The number of segments of a freehand line.
const POINTS: u32 = 96;

/// The waves, each with its number of periods along the line, its fraction of the amplitude, and
/// its phase in turns.
const WAVES: [(f64, f64, f64); 4] =
    [(3.0, 0.5, 0.11), (5.0, 0.3, 0.63), (8.0, 0.14, 0.37), (13.0, 0.06, 0.81)];

/// Returns the deviation, from −1 to 1, of a freehand line at a fraction of its length. The
/// deviation is periodic.
fn waver(t: f64) -> f64 {
    WAVES.iter().map(|(count, part, phase)| part * libm::sin(TAU * (count * t + phase))).sum()
}

/// Returns a freehand circle, which wavers by the fraction `part` of its radius.
pub(super) fn freehand_circle(center: DVec2, radius: f64, part: f64) -> Vec<DVec2> {
    let circle = circle_points(DVec2::ZERO, radius, POINTS).into_iter().zip(0..POINTS);
    let at = |(point, k): (DVec2, u32)| {
        center + point * (1.0 + part * waver(f64::from(k) / f64::from(POINTS)))
    };
    circle.map(at).collect()
}

/// Returns a freehand line between two points, with deviations up to `amplitude`.
pub(super) fn freehand_line([from, to]: [DVec2; 2], amplitude: f64) -> Vec<DVec2> {
    let aside = (to - from).normalize_or_zero().perp() * amplitude;
    let at = |k: u32| {
        let t = f64::from(k) / f64::from(POINTS);
        from.lerp(to, t) + aside * waver(t)
    };
    (0..=POINTS).map(at).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn freehand_lines_stay_near_their_path() {
        let line = freehand_line([DVec2::ZERO, DVec2::new(100.0, 0.0)], 2.0);
        assert!(line.iter().all(|point| point.y.abs() <= 2.0));
        assert!(line.iter().any(|point| point.y > 0.8) && line.iter().any(|point| point.y < -0.8));
        assert!(line.windows(2).all(|pair| pair[0].x < pair[1].x));
        let circle = freehand_circle(DVec2::ONE, 10.0, 0.1);
        let distances = circle.iter().map(|point| point.distance(DVec2::ONE));
        assert!(distances.into_iter().all(|distance| (9.0..=11.0).contains(&distance)));
    }
}
