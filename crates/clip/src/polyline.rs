//! Polyline clipping: the result is one or more runs of points.

use crate::{Volume, clip_segment};
use alloc::vec::Vec;
use homog::{Clip, HPoint};

/// A point of a clipped polyline.
#[derive(Clone, Copy, PartialEq, Debug)]
#[non_exhaustive]
pub struct PolylinePoint {
    /// The position before the divide.
    pub point: HPoint<Clip>,
    /// The index of the source segment that contains the point, which runs from point `segment` to
    /// point `segment + 1`.
    pub segment: usize,
    /// The fraction along that segment. Use it to interpolate attributes of the endpoints.
    pub t: f64,
}

/// Returns the parts of a polyline inside a volume, in order. Each part is an unbroken run of at
/// least two points.
///
/// While the line stays inside, the run continues, so dash patterns and joins can follow it. A
/// closed line repeats its first point as its last; if that point is inside, the first and last
/// runs meet there. Segments with an endpoint that is not finite are skipped.
///
/// ```
/// use clip::{Volume, clip_polyline};
/// use homog::HPoint;
/// let zigzag = [(0.0, 0.0), (0.0, 2.0), (0.5, 0.0), (0.9, 0.5)];
/// let zigzag = zigzag.map(|(x, y)| HPoint::new(x, y, 0.0, 1.0));
/// let runs = clip_polyline(&zigzag, &Volume::CHAPTER);
/// assert_eq!(runs.len(), 2); // it leaves at the top, returns, and stays
/// assert_eq!(runs[1].len(), 3);
/// assert_eq!((runs[1][0].segment, runs[1][0].t), (1, 0.5));
/// ```
#[must_use]
pub fn clip_polyline(points: &[HPoint<Clip>], volume: &Volume) -> Vec<Vec<PolylinePoint>> {
    let mut runs: Vec<Vec<PolylinePoint>> = Vec::new();
    let mut connected = false;
    for (segment, ends) in points.windows(2).enumerate() {
        let Some(left) = clip_segment(ends[0], ends[1], volume) else {
            connected = false;
            continue;
        };
        let place = |point, t| PolylinePoint { point, segment, t };
        match runs.last_mut() {
            Some(run) if connected && left.enter.is_none() => run.push(place(left.end, left.t1)),
            _ => runs.push([place(left.start, left.t0), place(left.end, left.t1)].into()),
        }
        connected = left.exit.is_none();
    }
    runs
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_that_only_touches_the_border_stays_in_one_run() {
        let tent = [(-0.5, 0.0), (0.0, 1.0), (0.5, 0.0)].map(|(x, y)| HPoint::new(x, y, 0.0, 1.0));
        let runs = clip_polyline(&tent, &Volume::CHAPTER);
        assert_eq!(runs.len(), 1);
        assert_eq!(runs[0].iter().map(|p| p.point).collect::<Vec<_>>(), tent);
    }

    #[test]
    fn nonfinite_points_break_the_line_and_short_lines_have_no_parts() {
        let mut line = [(-0.5, 0.0), (0.0, 0.5), (0.5, 0.0), (0.0, 0.0), (0.1, 0.0)]
            .map(|(x, y)| HPoint::new(x, y, 0.0, 1.0));
        line[2] = HPoint::new(f64::NAN, 0.0, 0.0, 1.0);
        let runs = clip_polyline(&line, &Volume::CHAPTER);
        assert_eq!(runs.iter().map(|run| run[0].segment).collect::<Vec<_>>(), [0, 3]);
        assert!(clip_polyline(&line[..1], &Volume::CHAPTER).is_empty());
        assert!(clip_polyline(&[], &Volume::CHAPTER).is_empty());
    }
}
