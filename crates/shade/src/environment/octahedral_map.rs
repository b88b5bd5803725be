//! The octahedral map: colors by direction on a square (Engelhardt and Dachsbacher 2008).
//!
//! ```text
//!   ┌────┬────┐     A direction is divided by the sum of its coordinates' magnitudes, which
//!   │ ╲−y│−y╱ │     projects it onto an octahedron. The upper half, seen from above, is the
//!   │  ╲ │ ╱  │     diamond in the middle; the lower half unfolds over the four corners.
//!   ├── +y ───┤
//!   │  ╱ │ ╲  │     A step beyond a border re-enters at the mirrored position on that border.
//!   │ ╱−y│−y╲ │
//!   └────┴────┘
//! ```

use crate::approximations::floor_to_int;
use crate::lanes::{Lanes, Vec3Lanes, map_to_lanes};
use crate::vector::normalize;

/// Red, green, blue and padding, so that four numbers are loaded at once.
pub(super) type Texel = [f32; 4];

/// Colors by direction, at the nodes of a square grid.
#[derive(Clone, PartialEq, Debug)]
pub(super) struct OctahedralMap {
    /// Number of nodes along a side: a power of two plus one.
    pub(super) side: usize,
    /// `side` × `side` nodes, row by row.
    pub(super) texels: Vec<Texel>,
}

/// Samples trilinearly between mip levels `near` and `near + 1` of each lane. Directions need not
/// be normalized.
///
/// `level` is not called for the next level if its weight is zero, because levels may be computed
/// on demand.
#[inline(always)]
pub(super) fn sample_trilinear<'a, const N: usize>(
    level: impl Fn(usize) -> &'a OctahedralMap,
    near_levels: &[usize; N],
    fractions: Lanes<N>,
    directions: Vec3Lanes<N>,
) -> [Texel; N] {
    // All lanes usually use the same pair of maps, because roughness rarely varies much.
    let first = near_levels[0];
    let has_next = fractions.0.iter().any(|fraction| *fraction != 0.0);
    let mut maps = [[level(first); N], [level(first + usize::from(has_next)); N]];
    if near_levels.iter().any(|near_level| *near_level != first) {
        for (lane, &near_level) in near_levels.iter().enumerate() {
            maps[0][lane] = level(near_level);
            maps[1][lane] = level(near_level + usize::from(fractions[lane] != 0.0));
        }
    }
    // The map sizes are also stored in lanes.
    let last_nodes =
        map_to_lanes(&maps, |maps| Lanes::from_fn(|lane| (maps[lane].side - 1) as f32));
    let positions = encode_octahedral(directions);
    let near = BilinearNodes::locate(positions, last_nodes[0]);
    let next = BilinearNodes::locate(positions, last_nodes[1]);
    // Process the four channels of one lane at a time, in one vector register.
    let mut colors = [[0.0; 4]; N];
    for (lane, color) in colors.iter_mut().enumerate() {
        let a = maps[0][lane].sample_bilinear(&near, lane);
        let b = maps[1][lane].sample_bilinear(&next, lane);
        *color = lerp_texels(a, b, fractions[lane]);
    }
    colors
}

/// Maps directions to positions on the square, between 0 and 1.
#[inline(always)]
pub(super) fn encode_octahedral<const N: usize>(directions: Vec3Lanes<N>) -> [Lanes<N>; 2] {
    let Vec3Lanes { x, y, z } = directions;
    let sum = x.abs() + y.abs() + z.abs();
    let inv_sum = sum.map(|sum| if sum > 0.0 { 1.0 / sum } else { 0.0 });
    let (u, v) = (x * inv_sum, z * inv_sum);
    // The lower half is folded over the diamond's edges.
    let folded_u = (1.0 - v.abs()) * u.map(sign_not_zero);
    let folded_v = (1.0 - u.abs()) * v.map(sign_not_zero);
    let is_lower = y.is_below(0.0);
    let (u, v) = (folded_u.select(&is_lower, u), folded_v.select(&is_lower, v));
    [u * 0.5 + 0.5, v * 0.5 + 0.5]
}

/// The four nodes around the position of each lane: the column and row of the first node, and the
/// fractions of the way to the next.
pub(super) struct BilinearNodes<const N: usize> {
    columns: [i32; N],
    rows: [i32; N],
    column_fractions: Lanes<N>,
    row_fractions: Lanes<N>,
}

impl<const N: usize> BilinearNodes<N> {
    /// Locates the nodes around positions between 0 and 1. `last_nodes` is the index of the last
    /// row and column of each lane's map.
    #[inline(always)]
    pub(super) fn locate([u, v]: [Lanes<N>; 2], last_nodes: Lanes<N>) -> Self {
        let (columns, column_fractions) = split_coordinates(u, last_nodes);
        let (rows, row_fractions) = split_coordinates(v, last_nodes);
        Self { columns, rows, column_fractions, row_fractions }
    }
}

impl OctahedralMap {
    /// Samples a function of unit vectors at all nodes.
    pub(super) fn from_function(side: usize, color: impl Fn([f32; 3]) -> [f32; 3]) -> Self {
        let texel = |node: usize| {
            let (u, v) = (node_coordinate(node % side, side), node_coordinate(node / side, side));
            let [r, g, b] = color(normalize(decode_octahedral(u, v)));
            [r, g, b, 0.0]
        };
        Self { side, texels: (0..side * side).map(texel).collect() }
    }

    /// Interpolates bilinearly between the nodes of a lane.
    #[inline(always)]
    pub(super) fn sample_bilinear<const N: usize>(
        &self,
        nodes: &BilinearNodes<N>,
        lane: usize,
    ) -> Texel {
        let first = nodes.rows[lane] as usize * self.side + nodes.columns[lane] as usize;
        let [a, b] = [self.texels[first], self.texels[first + 1]];
        let [c, d] = [self.texels[first + self.side], self.texels[first + self.side + 1]];
        let (s, t) = (nodes.column_fractions[lane], nodes.row_fractions[lane]);
        lerp_texels(lerp_texels(a, b, s), lerp_texels(c, d, s), t)
    }

    /// Computes the next mip level, with half as many intervals per side, by a tent filter over 3 ×
    /// 3 nodes.
    ///
    /// Nodes keep their positions, so that levels differ in sharpness but are not shifted.
    pub(super) fn downsample(&self) -> Self {
        let side = self.side / 2 + 1;
        let texel = |node: usize| {
            let (column, row) = (2 * (node % side) as i32, 2 * (node / side) as i32);
            let mut sum = [0.0; 4];
            for (dx, dy) in (-1..=1).flat_map(|dy| (-1..=1).map(move |dx| (dx, dy))) {
                let weight = ((2 - i32::abs(dx)) * (2 - i32::abs(dy))) as f32 / 16.0;
                let texel = self.texels[self.wrap_node(column + dx, row + dy)];
                sum = [0, 1, 2, 3].map(|k: usize| sum[k] + texel[k] * weight);
            }
            sum
        };
        Self { side, texels: (0..side * side).map(texel).collect() }
    }

    /// Returns the index of a node. A node one step beyond a border is mirrored along that border.
    fn wrap_node(&self, x: i32, y: i32) -> usize {
        let last = self.side as i32 - 1;
        // Beyond the left or right border, step back inside with the row mirrored. The upper and
        // lower borders are handled likewise.
        let (x, y) =
            if (0..=last).contains(&x) { (x, y) } else { (x.abs().min(2 * last - x), last - y) };
        let (x, y) =
            if (0..=last).contains(&y) { (x, y) } else { (last - x, y.abs().min(2 * last - y)) };
        (y * (last + 1) + x) as usize
    }
}

/// Computes `a + (b − a)·t` for all four components.
#[inline(always)]
fn lerp_texels(a: Texel, b: Texel, t: f32) -> Texel {
    let mut texel = a;
    for (a, b) in texel.iter_mut().zip(b) {
        *a += (b - *a) * t;
    }
    texel
}

/// Computes the coordinate of a node along one axis of the square, between −1 and 1.
pub(super) fn node_coordinate(node: usize, side: usize) -> f32 {
    2.0 * node as f32 / (side - 1) as f32 - 1.0
}

/// Converts a position in the square, with coordinates from −1 to 1, to a direction: a point on the
/// octahedron, not normalized.
pub(super) fn decode_octahedral(u: f32, v: f32) -> [f32; 3] {
    let y = 1.0 - u.abs() - v.abs();
    if y >= 0.0 {
        [u, y, v]
    } else {
        [(1.0 - v.abs()) * sign_not_zero(u), y, (1.0 - u.abs()) * sign_not_zero(v)]
    }
}

/// Returns −1 below 0, and 1 otherwise.
#[inline(always)]
fn sign_not_zero(x: f32) -> f32 {
    if x < 0.0 { -1.0 } else { 1.0 }
}

/// Returns, for each position between 0 and 1, the index of the node at or before it, and the
/// fraction of the way to the next node.
///
/// This uses `max` and `min` instead of `clamp`, which checks its bounds, so that the loops are
/// vectorized.
#[inline(always)]
fn split_coordinates<const N: usize>(
    positions: Lanes<N>,
    last_nodes: Lanes<N>,
) -> ([i32; N], Lanes<N>) {
    let positions = (positions * last_nodes).max(0.0).min_lanes(last_nodes);
    let mut nodes = [0; N];
    for ((node, position), last) in nodes.iter_mut().zip(&positions.0).zip(&last_nodes.0) {
        *node = floor_to_int(*position).min(floor_to_int(*last) - 1);
    }
    let fractions = Lanes::from_fn(|lane| positions[lane] - nodes[lane] as f32);
    (nodes, fractions)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sample(map: &OctahedralMap, direction: [f32; 3]) -> Texel {
        let direction = Vec3Lanes::<1>::splat(direction);
        let [texel] = sample_trilinear(|_| map, &[0], Lanes([0.5]), direction);
        texel
    }

    #[test]
    fn a_map_of_directions_returns_every_direction() {
        let map = OctahedralMap::from_function(129, |direction| direction);
        for step in 0..1000_u32 {
            let [x, y, z] =
                [step % 10, step / 10 % 10, step / 100].map(|c| c as f32 / 4.5 - 1.0 + 0.01);
            let expected = normalize([x, y, z]);
            let actual = sample(&map, [3.0 * x, 3.0 * y, 3.0 * z]);
            let is_near = (0..3).all(|k| (actual[k] - expected[k]).abs() < 0.02);
            assert!(is_near, "{expected:?} {actual:?}");
        }
    }

    #[test]
    fn borders_fold_onto_themselves() {
        let map = OctahedralMap::from_function(9, |_| [0.0; 3]);
        assert_eq!(map.wrap_node(-1, 2), 6 * 9 + 1);
        assert_eq!(map.wrap_node(9, 2), 6 * 9 + 7);
        assert_eq!(map.wrap_node(3, -1), 9 + 5);
        assert_eq!(map.wrap_node(-1, -1), 7 * 9 + 7);
        let smooth = OctahedralMap::from_function(65, |direction| direction).downsample();
        let actual = sample(&smooth, [0.3, -0.9, 0.1]);
        let expected = normalize([0.3, -0.9, 0.1]);
        assert!((0..3).all(|k| (actual[k] - expected[k]).abs() < 0.02), "{actual:?}");
    }
}
