//! A picture of all directions on a square.
//!
//! A direction is divided by the sum of its coordinates' sizes, which brings it onto an octahedron; the upper half is seen from
//! above, the lower half folded out over its corners.

/// Red, green and blue, and nothing: four numbers are read at once.
pub(super) type Texel = [f32; 4];

/// Colours by direction, at the nodes of a square grid.
#[derive(Clone, PartialEq, Debug)]
pub(super) struct OctahedralMap {
    /// Nodes along a side: a power of two and one.
    pub(super) side: usize,
    pub(super) texels: Vec<Texel>,
}

/// What lies between two neighbours of a chain of pictures, the one with the number `near` and the next, in directions of any
/// length but 0; each lane has its own. Where the next has no share nobody asks for it.
#[inline(always)]
pub(super) fn sample_trilinear<'a, const N: usize>(
    level: impl Fn(usize) -> &'a OctahedralMap,
    near: &[usize; N],
    share: &[f32; N],
    ways: &[[f32; N]; 3],
) -> [Texel; N] {
    let mut pictures = [[level(near[0]); N]; 2];
    let mut lasts = [[0.0; N]; 2];
    for lane in 0..N {
        let next = near[lane] + usize::from(share[lane] != 0.0);
        pictures[0][lane] = level(near[lane]);
        pictures[1][lane] = level(next);
    }
    for (pictures, lasts) in pictures.iter().zip(&mut lasts) {
        for lane in 0..N {
            lasts[lane] = (pictures[lane].side - 1) as f32;
        }
    }
    let places = encode_octahedral(ways);
    let [here, behind] =
        [BilinearNodes::locate(&places, &lasts[0]), BilinearNodes::locate(&places, &lasts[1])];
    let mut colors = [[0.0; 4]; N];
    for lane in 0..N {
        let a = pictures[0][lane].sample_bilinear(&here, lane);
        let b = pictures[1][lane].sample_bilinear(&behind, lane);
        for k in 0..4 {
            colors[lane][k] = a[k] + (b[k] - a[k]) * share[lane];
        }
    }
    colors
}

/// Where directions are on the square, between 0 and 1.
#[inline(always)]
fn encode_octahedral<const N: usize>(ways: &[[f32; N]; 3]) -> [[f32; N]; 2] {
    let mut places = [[0.0; N]; 2];
    for lane in 0..N {
        let (x, y, z) = (ways[0][lane], ways[1][lane], ways[2][lane]);
        let sum = x.abs() + y.abs() + z.abs();
        let per = if sum > 0.0 { 1.0 / sum } else { 0.0 };
        let (u, v) = (x * per, z * per);
        let folded = [(1.0 - v.abs()) * sign_not_zero(u), (1.0 - u.abs()) * sign_not_zero(v)];
        places[0][lane] = if y < 0.0 { folded[0] } else { u } * 0.5 + 0.5;
        places[1][lane] = if y < 0.0 { folded[1] } else { v } * 0.5 + 0.5;
    }
    places
}

/// The four nodes around a place, in all lanes: the columns and rows of the first, and how far it is to the next.
struct BilinearNodes<const N: usize> {
    columns: [i32; N],
    rows: [i32; N],
    column_fractions: [f32; N],
    row_fractions: [f32; N],
}

impl<const N: usize> BilinearNodes<N> {
    /// Those around places between 0 and 1; `lasts` are the numbers of the last columns and rows.
    #[inline(always)]
    fn locate(places: &[[f32; N]; 2], lasts: &[f32; N]) -> Self {
        let mut nodes = Self {
            columns: [0; N],
            rows: [0; N],
            column_fractions: [0.0; N],
            row_fractions: [0.0; N],
        };
        for lane in 0..N {
            (nodes.columns[lane], nodes.column_fractions[lane]) =
                split_coordinate(places[0][lane], lasts[lane]);
            (nodes.rows[lane], nodes.row_fractions[lane]) =
                split_coordinate(places[1][lane], lasts[lane]);
        }
        nodes
    }
}

impl OctahedralMap {
    /// The picture of a function of unit vectors.
    pub(super) fn from_function(side: usize, color: impl Fn([f32; 3]) -> [f32; 3]) -> Self {
        let node = |n: usize| {
            let [r, g, b] = color(normalize(decode_octahedral(
                node_coordinate(n % side, side),
                node_coordinate(n / side, side),
            )));
            [r, g, b, 0.0]
        };
        Self { side, texels: (0..side * side).map(node).collect() }
    }

    /// The colour between the nodes of a lane.
    #[inline(always)]
    fn sample_bilinear<const N: usize>(&self, nodes: &BilinearNodes<N>, lane: usize) -> Texel {
        let at = nodes.rows[lane] as usize * self.side + nodes.columns[lane] as usize;
        let [a, b] = [self.texels[at], self.texels[at + 1]];
        let [c, d] = [self.texels[at + self.side], self.texels[at + self.side + 1]];
        let (s, t) = (nodes.column_fractions[lane], nodes.row_fractions[lane]);
        let mut color = [0.0; 4];
        for k in 0..4 {
            let upper = a[k] + (b[k] - a[k]) * s;
            let lower = c[k] + (d[k] - c[k]) * s;
            color[k] = upper + (lower - upper) * t;
        }
        color
    }

    /// Half as many nodes along a side; each the mean of its neighbours, the nearer counting more.
    pub(super) fn downsample(&self) -> Self {
        let side = self.side / 2 + 1;
        let node = |n: usize| {
            let (column, row) = (2 * (n % side) as i32, 2 * (n / side) as i32);
            let mut sum = [0.0; 4];
            for (dx, dy) in (-1..=1).flat_map(|dy| (-1..=1).map(move |dx| (dx, dy))) {
                let weight = ((2 - i32::abs(dx)) * (2 - i32::abs(dy))) as f32 / 16.0;
                let texel = self.texels[self.wrap_node(column + dx, row + dy)];
                sum = [0, 1, 2, 3].map(|k: usize| sum[k] + texel[k] * weight);
            }
            sum
        };
        Self { side, texels: (0..side * side).map(node).collect() }
    }

    /// The number of a node; those a step beyond a border are on the border's other half.
    fn wrap_node(&self, x: i32, y: i32) -> usize {
        let last = self.side as i32 - 1;
        let (x, y) =
            if (0..=last).contains(&x) { (x, y) } else { (x.abs().min(2 * last - x), last - y) };
        let (x, y) =
            if (0..=last).contains(&y) { (x, y) } else { (last - x, y.abs().min(2 * last - y)) };
        (y * (last + 1) + x) as usize
    }
}

/// Where a node is between −1 and 1.
pub(super) fn node_coordinate(node: usize, side: usize) -> f32 {
    2.0 * node as f32 / (side - 1) as f32 - 1.0
}

/// The direction at a place of the square, on the octahedron.
pub(super) fn decode_octahedral(u: f32, v: f32) -> [f32; 3] {
    let y = 1.0 - u.abs() - v.abs();
    if y >= 0.0 {
        [u, y, v]
    } else {
        [(1.0 - v.abs()) * sign_not_zero(u), y, (1.0 - u.abs()) * sign_not_zero(v)]
    }
}

pub(crate) fn normalize(v: [f32; 3]) -> [f32; 3] {
    let length = (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt();
    v.map(|c| c / length)
}

#[inline(always)]
fn sign_not_zero(x: f32) -> f32 {
    if x < 0.0 { -1.0 } else { 1.0 }
}

/// The node before a place between 0 and 1, and how far it is to the next.
#[inline(always)]
fn split_coordinate(place: f32, last: f32) -> (i32, f32) {
    let place = (place * last).clamp(0.0, last);
    let node = (place as i32).min(last as i32 - 1);
    (node, place - node as f32)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(map: &OctahedralMap, way: [f32; 3]) -> Texel {
        let [color] = sample_trilinear(|_| map, &[0], &[0.5], &way.map(|c| [c]));
        color
    }

    #[test]
    fn every_direction_finds_itself() {
        let map = OctahedralMap::from_function(129, |way| way);
        for step in 0..1000_u32 {
            let [x, y, z] =
                [step % 10, step / 10 % 10, step / 100].map(|c| c as f32 / 4.5 - 1.0 + 0.01);
            let way = normalize([x, y, z]);
            let found = at(&map, [3.0 * x, 3.0 * y, 3.0 * z]);
            assert!((0..3).all(|k| (found[k] - way[k]).abs() < 0.02), "{way:?} {found:?}");
        }
    }

    #[test]
    fn borders_fold_onto_themselves() {
        let map = OctahedralMap::from_function(9, |_| [0.0; 3]);
        assert_eq!(map.wrap_node(-1, 2), 6 * 9 + 1);
        assert_eq!(map.wrap_node(9, 2), 6 * 9 + 7);
        assert_eq!(map.wrap_node(3, -1), 9 + 5);
        assert_eq!(map.wrap_node(-1, -1), 7 * 9 + 7);
        let smooth = OctahedralMap::from_function(65, |way| way).downsample();
        let found = at(&smooth, [0.3, -0.9, 0.1]);
        let way = normalize([0.3, -0.9, 0.1]);
        assert!((0..3).all(|k| (found[k] - way[k]).abs() < 0.02), "{found:?}");
    }
}
