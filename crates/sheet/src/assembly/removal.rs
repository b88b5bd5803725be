//! Removal order: the sides on which parts can leave an assembly without collisions.
//!
//! ```text
//!     ┌─┐ bolt          nothing blocks the bolt upward, but downward the plate blocks its head.
//!   ┌─┤ ├─┐             Once the bolt is gone, the plate can follow.
//!   └─┤ ├─┘ plate
//!     └─┘
//! ```
//!
//! A part blocks another part by being ahead of it in more than a few cells of a grid across the
//! axis. Parts are removed one by one as soon as nothing blocks them, on the preferred side if
//! possible. If no part can leave, the part that is blocked least leaves first.

use super::part_shapes::{CellHeights, Column, PartShapes};
use std::collections::VecDeque;

/// A part that covers at most this fraction of another part's cells does not block it, because the
/// facets of round parts cause such small overlaps.
const LEAST_COVER: f64 = 0.05;

/// The cost of comparing two parts, in visits, not counting their triangles.
const PAIR_VISITS: usize = 300;

/// A direction along an axis: 0 is negative, 1 is positive.
type AxisSide = usize;

/// The parts that prevent others from leaving.
#[derive(Debug)]
struct Hindrances {
    /// For each part, the parts that it blocks, each with the blocked side and the fraction of
    /// cells covered.
    hinders: Vec<Vec<(usize, AxisSide, f64)>>,
    /// The number of parts that block each part on each side.
    counts: Vec<[u32; 2]>,
    /// For each part and side, the sum of the fractions of its cells that blocking parts cover.
    covers: Vec<[f64; 2]>,
}

/// Returns the sides on which parts leave along their axes, for all parts except the base, which
/// stays.
pub(super) fn removal_sides(
    shapes: &PartShapes,
    base: usize,
    axes: &[usize],
    preferred: &[AxisSide],
) -> Vec<AxisSide> {
    let Some(mut hindrances) = Hindrances::find(shapes, base, axes) else {
        // There are too many pairs to compare, so every part leaves on its preferred side.
        return preferred.to_vec();
    };
    let mut sides: Vec<Option<AxisSide>> = vec![None; preferred.len()];
    sides[base] = Some(preferred[base]);
    // Parts that are free to leave on their preferred side, and on the other side.
    let mut queues = [VecDeque::new(), VecDeque::new()];
    for part in 0..preferred.len() {
        for side in 0..2 {
            if hindrances.counts[part][side] == 0 {
                queues[usize::from(side != preferred[part])].push_back((part, side));
            }
        }
    }
    loop {
        let next = queues[0].pop_front().or_else(|| queues[1].pop_front());
        // If the remaining parts interlock, the part that is blocked least breaks the cycle.
        let next = next.or_else(|| hindrances.least_hindered(&sides, preferred));
        let Some((part, side)) = next else { break };
        // A part may be queued for both sides.
        if sides[part].is_some() {
            continue;
        }
        sides[part] = Some(side);
        for (other, side) in hindrances.take_away(part) {
            queues[usize::from(side != preferred[other])].push_back((other, side));
        }
    }
    sides.into_iter().zip(preferred).map(|(side, other)| side.unwrap_or(*other)).collect()
}

impl Hindrances {
    /// Compares all parts, or returns `None` if that would take too long.
    fn find(shapes: &PartShapes, base: usize, axes: &[usize]) -> Option<Self> {
        let count = shapes.boxes.len();
        let mut found = Self {
            hinders: vec![Vec::new(); count],
            counts: vec![[0; 2]; count],
            covers: vec![[0.0; 2]; count],
        };
        for part in (0..count).filter(|&part| part != base) {
            let corners = shapes.boxes[part];
            let column = Column::new(corners, axes[part], 0.0);
            let mut own = shapes.heights(part, &column);
            // A part whose triangles are all edge-on covers no cells, so its box is used instead.
            if own.count() == 0 {
                own.add_box(corners, &column);
            }
            // Rounding must not decide whether touching parts block each other.
            let touch = (corners[1] - corners[0]).length() * 1e-3;
            for other in (0..count).filter(|&other| other != part) {
                if !column.meets(shapes.boxes[other]) {
                    continue;
                }
                // One budget of triangle visits limits the total time for all pairs.
                if !shapes.take_visits(PAIR_VISITS + shapes.triangle_count(other)) {
                    return None;
                }
                let covers = covered_cells(&own, &shapes.heights(other, &column), touch);
                for (side, cover) in covers.into_iter().enumerate() {
                    if cover > LEAST_COVER {
                        found.hinders[other].push((part, side, cover));
                        found.counts[part][side] += 1;
                        found.covers[part][side] += cover;
                    }
                }
            }
        }
        Some(found)
    }

    /// Removes a part and returns the parts that only it still blocked, each with the side now
    /// free.
    fn take_away(&mut self, part: usize) -> Vec<(usize, AxisSide)> {
        let mut freed = Vec::new();
        for (other, side, cover) in std::mem::take(&mut self.hinders[part]) {
            self.counts[other][side] -= 1;
            self.covers[other][side] -= cover;
            if self.counts[other][side] == 0 {
                freed.push((other, side));
            }
        }
        freed
    }

    /// Returns the remaining part that is blocked least, and the side on which it leaves.
    fn least_hindered(
        &self,
        sides: &[Option<AxisSide>],
        preferred: &[AxisSide],
    ) -> Option<(usize, AxisSide)> {
        let mut least: Option<(f64, usize, AxisSide)> = None;
        for part in (0..sides.len()).filter(|&part| sides[part].is_none()) {
            for side in [preferred[part], 1 - preferred[part]] {
                let cover = self.covers[part][side];
                // The tolerance keeps the order of summation from affecting the choice.
                if least.is_none_or(|(most, ..)| cover < most - 1e-9) {
                    least = Some((cover, part, side));
                }
            }
        }
        least.map(|(_, part, side)| (part, side))
    }
}

/// Returns the fractions of a part's cells where another part is below its top and where it is
/// above its bottom.
fn covered_cells(own: &CellHeights, other: &CellHeights, touch: f64) -> [f64; 2] {
    let mut covered = [0_u32; 2];
    for ([low, high], [other_low, other_high]) in own.0.iter().zip(&other.0) {
        if low <= high && other_low <= other_high {
            covered[0] += u32::from(*other_low < high - touch);
            covered[1] += u32::from(*other_high > low + touch);
        }
    }
    covered.map(|cells| f64::from(cells) / own.count().max(1) as f64)
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;

    /// Returns the sides on which boxes leave along y. A box is its minimum and maximum corners.
    fn sides_of(boxes: &[([f64; 3], [f64; 3])], preferred: &[AxisSide]) -> Vec<AxisSide> {
        let corners = |(low, high): &([f64; 3], [f64; 3])| [DVec3::from(*low), DVec3::from(*high)];
        let boxes: Vec<_> = boxes.iter().map(corners).collect();
        let triangles = vec![Vec::new(); boxes.len()];
        let axes = vec![1; boxes.len()];
        removal_sides(&PartShapes::from_raw(boxes, triangles), 0, &axes, preferred)
    }

    #[test]
    fn parts_leave_on_the_unblocked_side() {
        // A plate, a washer on it and a screw on top, with a foot below.
        let boxes = [
            ([-5.0, 0.0, -5.0], [5.0, 1.0, 5.0]),
            ([-1.0, 1.0, -1.0], [1.0, 1.2, 1.0]),
            ([-0.8, 1.2, -0.8], [0.8, 2.0, 0.8]),
            ([-1.0, -1.0, -1.0], [1.0, 0.0, 1.0]),
        ];
        for preferred in [[0; 4], [1; 4]] {
            assert_eq!(sides_of(&boxes, &preferred)[1..], [1, 1, 0]);
        }
    }

    #[test]
    fn free_parts_leave_on_the_preferred_side() {
        // Three plates next to the base: the lowest can leave downward, and upward once the others
        // have left.
        let plate = |y: f64| ([9.0, y, 9.0], [10.0, y + 1.0, 10.0]);
        let boxes = [([-5.0; 3], [5.0; 3]), plate(0.0), plate(1.0), plate(2.0)];
        for side in 0..2 {
            assert_eq!(sides_of(&boxes, &[side; 4]), [side; 4]);
        }
    }

    #[test]
    fn interlocked_parts_leave_on_the_least_blocked_side() {
        // A pin through a plate and the collar on it; the pin is a quarter as wide as the collar.
        let boxes = [
            ([-5.0, 0.0, -5.0], [5.0, 1.0, 5.0]),
            ([-2.0, 1.0, -2.0], [2.0, 2.0, 2.0]),
            ([-0.5, -1.0, -0.5], [0.5, 5.0, 0.5]),
        ];
        assert_eq!(sides_of(&boxes, &[0, 0, 0])[1..], [1, 0]);
        assert_eq!(sides_of(&boxes, &[1, 1, 1])[1..], [1, 1]);
    }
}
