//! Balloon positions on a rectangle around a view, assigned to spots so that the leaders are as
//! short as possible.
//!
//! ```text
//!   ○  ○  ○  ○        places are a fixed distance apart; the total length of the leaders is
//!   ○ ┌────┐ ○        minimal (Kuhn 1955, in the form of Jonker and Volgenant), so
//!   ○ │view│ ○        leaders do not cross: if two leaders crossed, swapping their
//!   ○ └────┘ ○        places would shorten the total
//!   ○  ○  ○  ○
//! ```

use super::annotation::Extent;
use glam::DVec2;

/// The extra cost of a leader that would pass too close to another balloon position.
const FORBIDDEN: f64 = 1e9;

/// Returns positions that are evenly spaced along the sides of a rectangle, at least `pitch` apart.
pub(super) fn ring_places([low, high]: Extent, pitch: f64) -> Vec<DVec2> {
    let size = high - low;
    if size.min_element() < 0.0 {
        return Vec::new();
    }
    let steps = |length: f64| (length / pitch).floor().max(0.0) as usize;
    let (across, down) = (steps(size.x), steps(size.y));
    let mut places = Vec::new();
    for k in 0..=across {
        let t = if across == 0 { 0.5 } else { k as f64 / across as f64 };
        let x = low.x + size.x * t;
        places.push(DVec2::new(x, low.y));
        if size.y >= pitch {
            places.push(DVec2::new(x, high.y));
        }
    }
    for k in 1..down {
        let y = low.y + size.y * (k as f64 / down as f64);
        places.push(DVec2::new(low.x, y));
        if size.x >= pitch {
            places.push(DVec2::new(high.x, y));
        }
    }
    places
}

/// Assigns a distinct position to each spot so that the total length of the leaders is minimal,
/// which keeps the leaders from crossing. Returns `None` if there are too few positions, or if a
/// leader comes closer than `clearance` to the position of another balloon.
pub(super) fn shortest_places(
    spots: &[DVec2],
    places: &[DVec2],
    clearance: f64,
) -> Option<Vec<DVec2>> {
    if spots.len() > places.len() {
        return None;
    }
    let lengths = |spot: &DVec2| places.iter().map(|place| (*place - *spot).length()).collect();
    let costs: Vec<Vec<f64>> = spots.iter().map(lengths).collect();
    let assigned: Vec<DVec2> =
        least_assignment(&costs).into_iter().map(|place| places[place]).collect();
    let passes = |(spot, place): (&DVec2, &DVec2)| {
        let is_near = |other: &DVec2| distance_to_segment(*other, [*spot, *place]) < clearance;
        assigned.iter().any(|other| other != place && is_near(other))
    };
    (!spots.iter().zip(&assigned).any(passes)).then_some(assigned)
}

/// Assigns a distinct position to each spot so that all leaders stay at least `clearance` away from
/// other positions and their total length is minimal. A spot without such a leader gets `None`.
///
/// Because some positions are ruled out, leaders may cross.
pub(super) fn clear_places(
    spots: &[DVec2],
    places: &[DVec2],
    clearance: f64,
) -> Vec<Option<DVec2>> {
    if spots.len() > places.len() {
        return vec![None; spots.len()];
    }
    let cost = |spot: DVec2, place: usize| {
        let to = places[place];
        let passes = |(other, at): (usize, &DVec2)| {
            other != place && distance_to_segment(*at, [spot, to]) < clearance
        };
        let length = (to - spot).length();
        if places.iter().enumerate().any(passes) { FORBIDDEN + length } else { length }
    };
    let costs: Vec<Vec<f64>> = spots
        .iter()
        .map(|spot| (0..places.len()).map(|place| cost(*spot, place)).collect())
        .collect();
    let assigned = least_assignment(&costs);
    let is_free =
        |(spot, place): (usize, usize)| (costs[spot][place] < FORBIDDEN).then_some(places[place]);
    assigned.into_iter().enumerate().map(is_free).collect()
}

/// Returns the distance from a point to a segment.
fn distance_to_segment(point: DVec2, [a, b]: [DVec2; 2]) -> f64 {
    let along = b - a;
    let length = along.length_squared();
    let t = if length > 0.0 { ((point - a).dot(along) / length).clamp(0.0, 1.0) } else { 0.0 };
    (point - a - along * t).length()
}

/// Assigns a distinct column to each row so that the sum of the costs is minimal.
///
/// Uses shortest augmenting paths with potentials and takes O(rows² · columns) time. There must be
/// at least as many columns as rows.
fn least_assignment(costs: &[Vec<f64>]) -> Vec<usize> {
    let columns = costs.first().map_or(0, Vec::len);
    // Index 0 means "no row" or "no column".
    let mut row_potential = vec![0.0; costs.len() + 1];
    let mut column_potential = vec![0.0; columns + 1];
    let mut row_of_column = vec![0_usize; columns + 1];
    for row in 1..=costs.len() {
        row_of_column[0] = row;
        let mut column = 0;
        let mut least = vec![f64::INFINITY; columns + 1];
        let mut previous = vec![0_usize; columns + 1];
        let mut is_done = vec![false; columns + 1];
        // The search ends at a free column, which has row 0.
        while row_of_column[column] != 0 {
            is_done[column] = true;
            let at = row_of_column[column];
            let (mut delta, mut next) = (f64::INFINITY, 0);
            for other in (1..=columns).filter(|&other| !is_done[other]) {
                let reduced =
                    costs[at - 1][other - 1] - row_potential[at] - column_potential[other];
                if reduced < least[other] {
                    (least[other], previous[other]) = (reduced, column);
                }
                if least[other] < delta {
                    (delta, next) = (least[other], other);
                }
            }
            // Reduced costs stay nonnegative and become 0 along the path.
            for other in 0..=columns {
                if is_done[other] {
                    row_potential[row_of_column[other]] += delta;
                    column_potential[other] -= delta;
                } else {
                    least[other] -= delta;
                }
            }
            column = next;
        }
        // Augment the assignment by shifting rows along the path, back to its start.
        while column != 0 {
            row_of_column[column] = row_of_column[previous[column]];
            column = previous[column];
        }
    }
    let mut assigned = vec![0; costs.len()];
    for (column, row) in row_of_column.iter().enumerate().skip(1) {
        if *row > 0 {
            assigned[row - 1] = column - 1;
        }
    }
    assigned
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_assignment_has_minimal_cost() {
        let costs = [vec![4.0, 1.0, 3.0, 9.0], vec![2.0, 0.0, 5.0, 9.0], vec![3.0, 2.0, 2.0, 9.0]];
        // The minimum over all permutations, found by hand, is 1 + 2 + 2.
        assert_eq!(least_assignment(&costs), [1, 0, 2]);
        assert!(least_assignment(&[]).is_empty());
    }

    #[test]
    fn leaders_do_not_cross() {
        let ring = [DVec2::splat(-60.0), DVec2::splat(60.0)];
        let places = ring_places(ring, 11.0);
        let mut state = 3_u64;
        let mut fraction = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888);
            (state >> 40) as f64 / (1_u64 << 24) as f64
        };
        let spots: Vec<DVec2> =
            (0..30).map(|_| DVec2::new(fraction() - 0.5, fraction() - 0.5) * 90.0).collect();
        let assigned = shortest_places(&spots, &places, 0.0).expect("places");
        let leaders: Vec<[DVec2; 2]> =
            spots.iter().zip(&assigned).map(|(spot, place)| [*spot, *place]).collect();
        let side = |[a, b]: [DVec2; 2], p: DVec2| (b - a).perp_dot(p - a);
        for (index, a) in leaders.iter().enumerate() {
            for b in &leaders[index + 1..] {
                let crosses =
                    side(*a, b[0]) * side(*a, b[1]) < 0.0 && side(*b, a[0]) * side(*b, a[1]) < 0.0;
                assert!(!crosses, "{a:?} {b:?}");
            }
        }
    }

    #[test]
    fn leaders_stay_clear_of_other_positions() {
        // All spots are near one corner, so their leaders reach most positions at a flat angle.
        let places = ring_places([DVec2::ZERO, DVec2::splat(100.0)], 11.0);
        let spots: Vec<DVec2> =
            (0..20).map(|k| DVec2::new(8.0 + f64::from(k % 5), 8.0 + f64::from(k / 5))).collect();
        let assigned = clear_places(&spots, &places, 5.0);
        assert!(assigned.iter().flatten().count() > 10);
        for (spot, place) in spots.iter().zip(&assigned) {
            let Some(place) = place else { continue };
            let mut others = places.iter().filter(|other| *other != place);
            assert!(others.all(|other| distance_to_segment(*other, [*spot, *place]) >= 5.0));
        }
        assert_eq!(shortest_places(&spots, &places[..10], 5.0), None);
    }

    #[test]
    fn positions_are_on_the_ring_and_at_least_the_pitch_apart() {
        let ring = [DVec2::ZERO, DVec2::new(100.0, 37.0)];
        let places = ring_places(ring, 10.0);
        for (index, a) in places.iter().enumerate() {
            assert!(a.x == 0.0 || a.y == 0.0 || a.x == 100.0 || a.y == 37.0, "{a}");
            assert!(places[index + 1..].iter().all(|b| (*a - *b).length() > 10.0 - 1e-9), "{a}");
        }
        assert_eq!(places.len(), 2 * 11 + 2 * 2);
    }
}
