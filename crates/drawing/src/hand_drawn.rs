//! Hand-drawn lines: draws each line twice, as strokes that waver around its true position.
//!
//! ```text
//!   true     ●───────────────────●
//!
//!   drawn   ╶──────╌╌───────────────╴    two strokes, each displaced by smooth noise and extended
//!            ╶─╌╌──────────╌╌──────╴     at both ends by a random fraction of the overshoot
//! ```
//!
//! Only strokes on the page change, by less than twice the amplitude and, at open ends, the
//! overshoot. Edges, visibility and the model stay the same. The random numbers depend only on the
//! line itself, so its shape does not depend on the run or on other lines.

use glam::DVec2;
use page::{PagePoint, Polyline, to_micrometers, to_millimeters};

/// The maximum distance between consecutive points of a drawn stroke, in millimeters.
const STEP: f64 = 1.5;

/// The distance along a line between independent random displacements, in millimeters.
const WAVELENGTH: f64 = 12.0;

/// The number of strokes per line.
const ROUNDS: u64 = 2;

/// The maximum overshoot of a stroke at each end of an open line, in amplitudes.
const OVERSHOOT: f64 = 4.0;

/// The maximum number of points in a stroke; longer lines have larger steps.
const MOST_POINTS: f64 = 20_000.0;

/// Returns hand-drawn strokes for lines, displaced by up to `amplitude` millimeters in x and y.
pub(super) fn draw_by_hand(lines: &[Polyline], amplitude: f64) -> Vec<Polyline> {
    let rounds = lines.iter().flat_map(|line| (0..ROUNDS).map(move |round| (line, round)));
    rounds.filter_map(|(line, round)| drawn_stroke(line, round, amplitude)).collect()
}

/// Draws one stroke along a line.
fn drawn_stroke(line: &Polyline, round: u64, amplitude: f64) -> Option<Polyline> {
    let seed = seed_of_line(&line.points, round);
    let mut points: Vec<DVec2> = line.points.iter().copied().map(to_millimeters).collect();
    if line.closed {
        points.push(points[0]);
    } else {
        let lengths = [0, 1].map(|end| OVERSHOOT * amplitude * random(seed, u64::MAX - end));
        extend_ends(&mut points, lengths);
    }
    let length: f64 = points.windows(2).map(|pair| pair[0].distance(pair[1])).sum();
    let step = STEP.max(length / MOST_POINTS);
    let displaced = resample(&points, step).into_iter().map(|(point, distance)| {
        let waver = [0, 1].map(|axis| smooth_noise(seed ^ axis, distance / WAVELENGTH));
        to_micrometers(point + DVec2::from(waver) * amplitude)
    });
    let mut points: Vec<PagePoint> = displaced.collect();
    points.dedup();
    (points.len() > 1).then_some(Polyline { points, closed: false })
}

/// Moves both ends outward along their segments by the specified lengths, in millimeters.
fn extend_ends(points: &mut [DVec2], [first, last]: [f64; 2]) {
    let end = points.len() - 1;
    let outward = |from: DVec2, to: DVec2| (to - from).normalize_or_zero();
    let (start, finish) =
        (outward(points[1], points[0]) * first, outward(points[end - 1], points[end]) * last);
    points[0] += start;
    points[end] += finish;
}

/// Returns points along a line at most `step` apart, including corners, and the distance of each
/// from the start in millimeters.
fn resample(points: &[DVec2], step: f64) -> Vec<(DVec2, f64)> {
    let mut samples = vec![(points[0], 0.0)];
    let mut start = 0.0;
    for pair in points.windows(2) {
        let length = pair[0].distance(pair[1]);
        let parts = (length / step).ceil().max(1.0);
        samples.extend((1..=parts as u32).map(|part| {
            let t = f64::from(part) / parts;
            (pair[0].lerp(pair[1], t), start + t * length)
        }));
        start += length;
    }
    samples
}

/// Returns smooth value noise from −1 to 1: random values at integers, joined by cubics.
fn smooth_noise(seed: u64, x: f64) -> f64 {
    let cell = x.floor();
    let t = x - cell;
    let [from, to] = [cell, cell + 1.0].map(|at| 2.0 * random(seed, at as u64) - 1.0);
    from + (to - from) * t * t * (3.0 - 2.0 * t)
}

/// Derives a seed from the points of a line.
fn seed_of_line(points: &[PagePoint], round: u64) -> u64 {
    let numbers = points.iter().flatten().map(|micrometers| *micrometers as u64);
    numbers.fold(mix(round), |seed, number| mix(seed ^ number)) << 1
}

/// Returns a pseudorandom number from 0 to 1 for a seed and an index.
fn random(seed: u64, index: u64) -> f64 {
    (mix(seed ^ mix(index)) >> 11) as f64 / (1_u64 << 53) as f64
}

/// Maps integers one-to-one so that each output bit depends on every input bit (SplitMix64, Steele,
/// Lea and Flood 2014).
const fn mix(number: u64) -> u64 {
    let bits = number.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    bits ^ (bits >> 31)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line(points: &[(f64, f64)], closed: bool) -> Polyline {
        let points: Vec<DVec2> = points.iter().map(|&at| DVec2::from(at)).collect();
        Polyline::through_points(&points, closed).expect("different points")
    }

    #[test]
    fn strokes_stay_near_their_line() {
        let lines = [line(&[(0.0, 0.0), (80.0, 0.0)], false)];
        let strokes = draw_by_hand(&lines, 0.3);
        assert_eq!(strokes.len(), 2);
        for stroke in &strokes {
            let points: Vec<DVec2> = stroke.points.iter().copied().map(to_millimeters).collect();
            assert!(points.iter().all(|point| point.y.abs() <= 0.301), "{points:?}");
            assert!(points.iter().any(|point| point.y.abs() > 0.05), "the stroke must waver");
            assert!(points.iter().all(|point| (-1.6..=81.6).contains(&point.x)));
            let reaches = |end: f64| points.iter().any(|point| (point.x - end).abs() < 1.6);
            assert!(reaches(0.0) && reaches(80.0));
        }
        assert_ne!(strokes[0], strokes[1], "the two strokes must differ");
    }

    #[test]
    fn a_line_keeps_its_shape_when_others_are_added() {
        let (one, other) =
            (line(&[(0.0, 0.0), (9.0, 5.0)], false), line(&[(3.0, 0.0), (3.0, 7.0)], false));
        let both = draw_by_hand(&[other, one.clone()], 0.2);
        assert_eq!(both[2..], draw_by_hand(&[one], 0.2));
    }

    #[test]
    fn strokes_of_a_closed_line_keep_its_corners() {
        let corners = [(0.0, 0.0), (20.0, 0.0), (20.0, 10.0)];
        for stroke in draw_by_hand(&[line(&corners, true)], 0.1) {
            for corner in corners.map(DVec2::from) {
                let nearest = stroke.points.iter().map(|at| to_millimeters(*at).distance(corner));
                assert!(nearest.fold(f64::INFINITY, f64::min) < 0.15, "{corner}");
            }
        }
    }
}
