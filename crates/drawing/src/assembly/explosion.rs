//! Exploded views: how far each part moves along an axis until no boxes of parts meet.
//!
//! ```text
//!   ┌──┐                      the largest part stays; every other one moves away from it along
//!   └──┘        up, in the    its axis, those near first, beyond all boxes that are in its way
//!    ┆          order of
//!   ┌──┐        their ends    a box is in the way if it meets the column in which the part moves
//!   └──┘
//!  ┌────┐
//!  └────┘  base
//! ```
//!
//! Boxes of moved parts are disjoint, and so are the parts. The moves depend on the boxes and their
//! order alone: there is no iteration that might not end.

use glam::DVec3;
use homog::{Bounds, World};

/// More parts than these stay in their places: each is compared with all before it.
pub(crate) const MAX_EXPLODED_PARTS: usize = 5000;

/// The distance between two parts, as a fraction of the diagonal of the assembly.
const DEFAULT_DISTANCE: f64 = 0.04;

/// Parts whose centers are no farther from a line, as a fraction of that diagonal, are in line.
const IN_LINE: f64 = 0.01;

/// The direction in which the parts of an exploded view move.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum ExplosionAxis {
    /// Along the axis on which most parts are in line with the largest one; among equal ones that on
    /// which parts move least.
    #[default]
    Auto,
    /// To the left and to the right.
    X,
    /// Up and down.
    Y,
    /// To the front and to the back.
    Z,
    /// Each part away from the largest one, along the axis on which it is farthest from it.
    All,
}

/// How the parts of an exploded view move.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct ExplosionSettings {
    /// The direction.
    pub axis: ExplosionAxis,
    /// The least distance of two parts along it, in units of the scene, not negative; `None` for a
    /// twenty-fifth of the diagonal of the assembly.
    pub distance: Option<f64>,
}

/// A box by its least and its greatest corner.
type Corners = [DVec3; 2];

impl ExplosionSettings {
    /// The move of each part by its bounding box in the world: 0 for the largest.
    pub(crate) fn moves(&self, boxes: &[Bounds<World>]) -> Vec<DVec3> {
        let boxes: Vec<Corners> =
            boxes.iter().map(|bounds| [bounds.min().raw(), bounds.max().raw()]).collect();
        let whole = boxes.iter().copied().reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])]);
        let Some([low, high]) = whole else { return Vec::new() };
        let size = high - low;
        let gap = self.distance.unwrap_or(size.length() * DEFAULT_DISTANCE).max(0.0);
        // Boxes that touch would be one for rounding.
        let gap = gap.max(size.length() * 1e-6);
        let base = largest(&boxes);
        let axis = match self.axis {
            ExplosionAxis::X => Some(0),
            ExplosionAxis::Y => Some(1),
            ExplosionAxis::Z => Some(2),
            ExplosionAxis::Auto => Some(axis_of_assembly(&boxes, base, (size, gap))),
            ExplosionAxis::All => None,
        };
        moves_along(&boxes, base, (axis, gap))
    }
}

/// The moves of all parts away from the base, along an axis or each along its own.
fn moves_along(boxes: &[Corners], base: usize, (axis, gap): (Option<usize>, f64)) -> Vec<DVec3> {
    let mut order: Vec<(Corners, Direction, usize)> = (0..boxes.len())
        .filter(|&part| part != base)
        .map(|part| (boxes[part], Direction::of_part(boxes[part], boxes[base], axis), part))
        .collect();
    order.sort_by(|(a, way, i), (b, other, k)| {
        way.distance(*a).total_cmp(&other.distance(*b)).then(i.cmp(k))
    });
    let mut moves = vec![DVec3::ZERO; boxes.len()];
    let mut placed = vec![boxes[base]];
    for (corners, direction, part) in order {
        let by = direction.clearance(corners, &placed, gap);
        moves[part] = direction.unit() * by;
        placed.push(corners.map(|corner| corner + moves[part]));
    }
    moves
}

/// A direction along an axis of the world, and where the center of the base is on it.
#[derive(Clone, Copy, Debug)]
struct Direction {
    axis: usize,
    sign: f64,
    base: f64,
}

impl Direction {
    /// The direction of a part away from the base: on its axis, or on that on which it is farthest
    /// from the base, measured by the size of the base.
    fn of_part(part: Corners, base: Corners, axis: Option<usize>) -> Self {
        let away = (part[0] + part[1] - base[0] - base[1]) * 0.5;
        let half = (base[1] - base[0]) * 0.5;
        let relative = |axis: usize| {
            let least = half.max_element().max(1e-300) * 1e-3;
            away[axis].abs() / half[axis].max(least)
        };
        let farthest = |a, b| if relative(b) > relative(a) { b } else { a };
        let axis = axis.unwrap_or_else(|| [1, 0, 2].into_iter().reduce(farthest).unwrap_or(1));
        let sign = if away[axis] < 0.0 { -1.0 } else { 1.0 };
        Self { axis, sign, base: (base[0] + base[1])[axis] * 0.5 }
    }

    fn unit(self) -> DVec3 {
        DVec3::AXES[self.axis] * self.sign
    }

    /// How far the farther end of a part is from the center of the base: a part that ends beyond
    /// another one is in its way, as a bolt with its head is in the way of what it holds.
    fn distance(self, part: Corners) -> f64 {
        (part[usize::from(self.sign > 0.0)][self.axis] - self.base) * self.sign
    }

    /// The way that a part has to go beyond all boxes in its column, 0 or more.
    fn clearance(self, part: Corners, placed: &[Corners], gap: f64) -> f64 {
        let across = [(self.axis + 1) % 3, (self.axis + 2) % 3];
        let (near, far) = if self.sign > 0.0 { (0, 1) } else { (1, 0) };
        // Where a column ends, rounding must not decide.
        let margin = gap * 1e-3;
        let in_column = |other: &&Corners| {
            across.iter().all(|&axis| {
                other[0][axis] < part[1][axis] + margin && part[0][axis] < other[1][axis] + margin
            })
        };
        let ways = placed
            .iter()
            .filter(in_column)
            .map(|other| (other[far][self.axis] - part[near][self.axis]) * self.sign + gap);
        ways.fold(0.0, f64::max)
    }
}

/// The part with the greatest box; the first of equal ones.
fn largest(boxes: &[Corners]) -> usize {
    let size = |[low, high]: Corners| {
        let sides = high - low;
        (sides.x * sides.y * sides.z, sides.length())
    };
    let greater = |a: usize, b: usize| {
        let (own, other) = (size(boxes[a]), size(boxes[b]));
        let order = other.0.total_cmp(&own.0).then(other.1.total_cmp(&own.1));
        if order.is_gt() { b } else { a }
    };
    (0..boxes.len()).reduce(greater).unwrap_or(0)
}

/// The axis on which most parts are in line with the base; among equal ones that on which parts move
/// least, y before x before z.
fn axis_of_assembly(boxes: &[Corners], base: usize, (size, gap): (DVec3, f64)) -> usize {
    let center = |[low, high]: Corners| (low + high) * 0.5;
    let near = size.length() * IN_LINE;
    let in_line = |axis: usize| {
        let across = [(axis + 1) % 3, (axis + 2) % 3];
        let is_in_line = |other: &&Corners| {
            let away = center(**other) - center(boxes[base]);
            across.iter().all(|&axis| away[axis].abs() <= near)
        };
        boxes.iter().filter(is_in_line).count()
    };
    let way = |axis| moves_along(boxes, base, (Some(axis), gap)).iter().map(|by| by.length()).sum();
    let scored = [1, 0, 2].map(|axis| (axis, in_line(axis)));
    let most = scored.iter().map(|(_, count)| *count).max();
    let mut best: Option<(usize, f64)> = None;
    for (axis, count) in scored {
        let way = if Some(count) == most { way(axis) } else { f64::INFINITY };
        if best.is_none_or(|(_, least)| way < least * (1.0 - 1e-6)) {
            best = Some((axis, way));
        }
    }
    best.map_or(1, |(axis, _)| axis)
}

#[cfg(test)]
mod tests {
    use super::*;
    use homog::Point;

    fn boxed(low: [f64; 3], high: [f64; 3]) -> Bounds<World> {
        Bounds::from_points([low, high].map(|corner| Point::from_raw(corner.into())))
            .expect("corners")
    }

    #[test]
    fn parts_leave_the_largest_in_their_order() {
        // A plate, a ring on it with a pin through both, and a nut below.
        let boxes = [
            boxed([-1.0, 2.0, -1.0], [1.0, 3.0, 1.0]),
            boxed([-5.0, 0.0, -5.0], [5.0, 2.0, 5.0]),
            boxed([-0.5, -1.0, -0.5], [0.5, 5.0, 0.5]),
            boxed([-1.0, -1.0, -1.0], [1.0, 0.0, 1.0]),
        ];
        let settings = ExplosionSettings { axis: ExplosionAxis::Y, distance: Some(1.0) };
        let heights: Vec<f64> = settings.moves(&boxes).iter().map(|by| by.y).collect();
        // The pin ends beyond the ring: the ring goes first, to 3, then the pin to 5.
        assert_eq!(heights, [1.0, 0.0, 6.0, -1.0]);
    }

    #[test]
    fn parts_beside_each_other_move_alike() {
        let bolt = |x: f64| boxed([x - 1.0, 1.0, -0.5], [x + 1.0, 4.0, 0.5]);
        let boxes = [boxed([-9.0, 0.0, -9.0], [9.0, 2.0, 9.0]), bolt(-5.0), bolt(0.0), bolt(5.0)];
        let settings = ExplosionSettings { axis: ExplosionAxis::Auto, distance: Some(0.5) };
        // One bolt is in line with the plate along y; they move by the same way.
        assert_eq!(settings.moves(&boxes)[1..], [DVec3::Y * 1.5; 3]);
        let up = ExplosionSettings { axis: ExplosionAxis::Y, distance: Some(0.5) }.moves(&boxes);
        assert_eq!(up[1..], [DVec3::Y * 1.5; 3]);
    }

    #[test]
    fn moved_boxes_are_disjoint_in_every_direction() {
        let mut state = 7_u64;
        let mut fraction = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888);
            (state >> 40) as f64 / (1_u64 << 24) as f64
        };
        let boxes: Vec<Bounds<World>> = (0..120)
            .map(|_| {
                let low = [(); 3].map(|()| fraction() * 10.0);
                boxed(low, low.map(|c| c + 0.1 + 3.0 * fraction()))
            })
            .collect();
        use ExplosionAxis::{All, Auto, X, Y, Z};
        for axis in [Auto, X, Y, Z, All] {
            let moves = ExplosionSettings { axis, distance: None }.moves(&boxes);
            let moved: Vec<Corners> = boxes
                .iter()
                .zip(&moves)
                .map(|(one, by)| [one.min().raw() + *by, one.max().raw() + *by])
                .collect();
            for (index, a) in moved.iter().enumerate() {
                for b in &moved[index + 1..] {
                    assert!(a[1].cmplt(b[0]).any() || b[1].cmplt(a[0]).any(), "{axis:?}");
                }
            }
        }
    }

    #[test]
    fn one_part_or_none_stays() {
        let settings = ExplosionSettings::default();
        assert!(settings.moves(&[]).is_empty());
        assert_eq!(settings.moves(&[boxed([0.0; 3], [0.0; 3])]), [DVec3::ZERO]);
    }
}
