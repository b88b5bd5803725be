//! Exploded views: how far each part moves along an axis to be clear of all others.
//!
//! ```text
//!   ┌──┐                      the largest part stays. Every other part leaves on its free side,
//!   └──┘        up, in the    starting with the nearest, and moves beyond all parts in its way,
//!    ┆          order of      that is, all parts in the column of its box
//!   ┌──┐        their ends
//!   └──┘
//!  ┌────┐
//!  └────┘  base
//! ```
//!
//! The box of a moved part does not touch any part that was placed earlier, so no two parts
//! intersect. Each part is placed once, so the computation always terminates.

use super::part_shapes::{Column, Corners, PartShapes, PlacedPart};
use super::removal::removal_sides;
use glam::DVec3;

/// The maximum number of parts to explode, limited because each is compared with all earlier ones.
pub(crate) const MAX_EXPLODED_PARTS: usize = 5000;

/// The distance between parts, as a fraction of the assembly's diagonal.
const DEFAULT_DISTANCE: f64 = 0.08;

/// The maximum distance between the center of an aligned part and the axis through the base's
/// center, as a fraction of that diagonal.
const IN_LINE: f64 = 0.01;

/// The direction in which the parts of an exploded view move.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum ExplosionAxis {
    /// Along the axis on which most parts are aligned with the largest one; in a tie, along the
    /// axis on which the parts move the least.
    #[default]
    Auto,
    /// To the left and to the right.
    X,
    /// Up and down.
    Y,
    /// To the front and to the back.
    Z,
    /// Each part away from the largest one, along the axis on which it is farthest from that part.
    All,
}

/// Settings for moving the parts of an exploded view.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct ExplosionSettings {
    /// The direction of the moves.
    pub axis: ExplosionAxis,
    /// The minimum distance between parts along that direction, in scene units, not negative;
    /// `None` means 0.08 of the assembly's diagonal.
    pub distance: Option<f64>,
}

impl ExplosionSettings {
    /// Returns the move of each part, which is zero for the largest part.
    pub(crate) fn moves(&self, shapes: &PartShapes) -> Vec<DVec3> {
        let boxes = &shapes.boxes;
        let whole = boxes.iter().copied().reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])]);
        let Some([low, high]) = whole else { return Vec::new() };
        let size = high - low;
        let gap = self.distance.unwrap_or(size.length() * DEFAULT_DISTANCE).max(0.0);
        // With a gap of 0, rounding could make touching parts overlap.
        let gap = gap.max(size.length() * 1e-6);
        let base = largest(boxes);
        let axis = match self.axis {
            ExplosionAxis::X => Some(0),
            ExplosionAxis::Y => Some(1),
            ExplosionAxis::Z => Some(2),
            ExplosionAxis::Auto => Some(axis_of_assembly(shapes, base, size, gap)),
            ExplosionAxis::All => None,
        };
        moves_along(shapes, base, axis, gap)
    }
}

/// Returns the moves of all parts away from the base, either along one axis or each along its own
/// axis.
fn moves_along(shapes: &PartShapes, base: usize, axis: Option<usize>, gap: f64) -> Vec<DVec3> {
    let boxes = &shapes.boxes;
    let directions: Vec<Direction> =
        boxes.iter().map(|part| Direction::away_from_base(*part, boxes[base], axis)).collect();
    let axes: Vec<usize> = directions.iter().map(|direction| direction.axis).collect();
    let preferred: Vec<usize> = directions.iter().map(|one| usize::from(one.sign > 0.0)).collect();
    let sides = removal_sides(shapes, base, &axes, &preferred);
    let mut order: Vec<(Direction, usize)> = (0..boxes.len())
        .filter(|&part| part != base)
        .map(|part| {
            let sign = if sides[part] == 0 { -1.0 } else { 1.0 };
            (Direction { sign, ..directions[part] }, part)
        })
        .collect();
    // Work outward from the base, so that each part clears the parts already placed. Part numbers
    // break ties.
    order.sort_by(|(way, i), (other, k)| {
        way.distance(boxes[*i]).total_cmp(&other.distance(boxes[*k])).then(i.cmp(k))
    });
    let mut moves = vec![DVec3::ZERO; boxes.len()];
    let mut placed = vec![PlacedPart { part: base, by: DVec3::ZERO }];
    for (direction, part) in order {
        let by = direction.clearance(boxes[part], shapes, &placed, gap);
        moves[part] = direction.unit() * by;
        placed.push(PlacedPart { part, by: moves[part] });
    }
    moves
}

/// A direction along a world axis, and the position of the base's center on it.
#[derive(Clone, Copy, Debug)]
struct Direction {
    axis: usize,
    sign: f64,
    base: f64,
}

impl Direction {
    /// Returns the direction of a part away from the base: along `axis` if set, otherwise along the
    /// axis on which it is farthest from the base, relative to the base's size.
    ///
    /// On that axis, the direction is toward the part's center.
    fn away_from_base(part: Corners, base: Corners, axis: Option<usize>) -> Self {
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

    /// Returns the distance from the center of the base to the far end of a part. A part whose end
    /// is farther out blocks the others, as the head of a bolt blocks the parts that it holds.
    fn distance(self, part: Corners) -> f64 {
        (part[usize::from(self.sign > 0.0)][self.axis] - self.base) * self.sign
    }

    /// Returns how far the box of a part must move to clear all parts in its column. The result is
    /// never negative.
    fn clearance(self, part: Corners, shapes: &PartShapes, placed: &[PlacedPart], gap: f64) -> f64 {
        // The margin keeps rounding from deciding whether a part at the border is in the column.
        let column = Column::new(part, self.axis, gap * 1e-3);
        let near = part[usize::from(self.sign < 0.0)][self.axis] * self.sign;
        let reaches = placed.iter().filter_map(|other| shapes.reach(*other, &column, self.sign));
        reaches.map(|reach| reach - near + gap).fold(0.0, f64::max)
    }
}

/// Returns the part with the largest box, or the first such part in a tie.
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

/// Returns the axis on which most parts are aligned with the base. Ties are broken by the least
/// movement, then in the order y, x, z.
fn axis_of_assembly(shapes: &PartShapes, base: usize, size: DVec3, gap: f64) -> usize {
    let boxes = &shapes.boxes;
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
    let way = |axis| moves_along(shapes, base, Some(axis), gap).iter().map(|by| by.length()).sum();
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

    fn boxed(low: [f64; 3], high: [f64; 3]) -> Corners {
        [low.into(), high.into()]
    }

    /// Returns the moves of solid boxes.
    fn moves_of(settings: ExplosionSettings, boxes: &[Corners]) -> Vec<DVec3> {
        let triangles = vec![Vec::new(); boxes.len()];
        settings.moves(&PartShapes::from_raw(boxes.to_vec(), triangles))
    }

    #[test]
    fn parts_move_away_from_the_largest_in_order() {
        // A plate, a ring on it with a pin through both, and a nut below.
        let boxes = [
            boxed([-1.0, 2.0, -1.0], [1.0, 3.0, 1.0]),
            boxed([-5.0, 0.0, -5.0], [5.0, 2.0, 5.0]),
            boxed([-0.5, -1.0, -0.5], [0.5, 5.0, 0.5]),
            boxed([-1.0, -1.0, -1.0], [1.0, 0.0, 1.0]),
        ];
        let settings = ExplosionSettings { axis: ExplosionAxis::Y, distance: Some(1.0) };
        let heights: Vec<f64> = moves_of(settings, &boxes).iter().map(|by| by.y).collect();
        // The pin extends beyond the ring, so the ring moves first, to 3, and then the pin, to 5.
        assert_eq!(heights, [1.0, 0.0, 6.0, -1.0]);
    }

    #[test]
    fn parts_side_by_side_move_equally_far() {
        let bolt = |x: f64| boxed([x - 1.0, 1.0, -0.5], [x + 1.0, 4.0, 0.5]);
        let boxes = [boxed([-9.0, 0.0, -9.0], [9.0, 2.0, 9.0]), bolt(-5.0), bolt(0.0), bolt(5.0)];
        let settings = ExplosionSettings { axis: ExplosionAxis::Auto, distance: Some(0.5) };
        // One bolt is aligned with the plate along y. All bolts move by the same distance.
        assert_eq!(moves_of(settings, &boxes)[1..], [DVec3::Y * 1.5; 3]);
        let settings = ExplosionSettings { axis: ExplosionAxis::Y, distance: Some(0.5) };
        assert_eq!(moves_of(settings, &boxes)[1..], [DVec3::Y * 1.5; 3]);
    }

    #[test]
    fn moved_boxes_are_disjoint_in_every_direction() {
        let mut state = 7_u64;
        let mut fraction = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888);
            (state >> 40) as f64 / (1_u64 << 24) as f64
        };
        let boxes: Vec<Corners> = (0..120)
            .map(|_| {
                let low = [(); 3].map(|()| fraction() * 10.0);
                boxed(low, low.map(|c| c + 0.1 + 3.0 * fraction()))
            })
            .collect();
        use ExplosionAxis::{All, Auto, X, Y, Z};
        for axis in [Auto, X, Y, Z, All] {
            let moves = moves_of(ExplosionSettings { axis, distance: None }, &boxes);
            let moved: Vec<Corners> =
                boxes.iter().zip(&moves).map(|(one, by)| one.map(|corner| corner + *by)).collect();
            for (index, a) in moved.iter().enumerate() {
                for b in &moved[index + 1..] {
                    assert!(a[1].cmplt(b[0]).any() || b[1].cmplt(a[0]).any(), "{axis:?}");
                }
            }
        }
    }

    #[test]
    fn a_single_part_does_not_move() {
        let settings = ExplosionSettings::default();
        assert!(moves_of(settings, &[]).is_empty());
        assert_eq!(moves_of(settings, &[boxed([0.0; 3], [0.0; 3])]), [DVec3::ZERO]);
    }
}
