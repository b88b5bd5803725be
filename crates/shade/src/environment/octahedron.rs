//! A picture of all directions on a square.
//!
//! A direction is divided by the sum of its coordinates' sizes, which brings it onto an octahedron; the upper half is seen from
//! above, the lower half folded out over its corners.

/// Red, green and blue, and nothing: four numbers are read at once.
pub(super) type Color = [f32; 4];

/// Colours by direction, at the nodes of a square grid.
#[derive(Clone, PartialEq, Debug)]
pub(super) struct Octahedron {
    /// Nodes along a side: a power of two and one.
    pub(super) side: usize,
    pub(super) texels: Vec<Color>,
}

/// What lies between two neighbours of a chain of pictures, the one with the number `near` and the next, in directions of any
/// length but 0; each lane has its own. Where the next has no share nobody asks for it.
#[inline(always)]
pub(super) fn between<'a, const N: usize>(
    level: impl Fn(usize) -> &'a Octahedron,
    near: &[usize; N],
    share: &[f32; N],
    ways: &[[f32; N]; 3],
) -> [Color; N] {
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
    let places = square(ways);
    let [here, behind] = [Nodes::around(&places, &lasts[0]), Nodes::around(&places, &lasts[1])];
    let mut colors = [[0.0; 4]; N];
    for lane in 0..N {
        let a = pictures[0][lane].color(&here, lane);
        let b = pictures[1][lane].color(&behind, lane);
        for k in 0..4 {
            colors[lane][k] = a[k] + (b[k] - a[k]) * share[lane];
        }
    }
    colors
}

/// Where directions are on the square, between 0 and 1.
#[inline(always)]
fn square<const N: usize>(ways: &[[f32; N]; 3]) -> [[f32; N]; 2] {
    let mut places = [[0.0; N]; 2];
    for lane in 0..N {
        let (x, y, z) = (ways[0][lane], ways[1][lane], ways[2][lane]);
        let sum = x.abs() + y.abs() + z.abs();
        let per = if sum > 0.0 { 1.0 / sum } else { 0.0 };
        let (u, v) = (x * per, z * per);
        let folded = [(1.0 - v.abs()) * sign(u), (1.0 - u.abs()) * sign(v)];
        places[0][lane] = if y < 0.0 { folded[0] } else { u } * 0.5 + 0.5;
        places[1][lane] = if y < 0.0 { folded[1] } else { v } * 0.5 + 0.5;
    }
    places
}

/// The four nodes around a place, in all lanes: the columns and rows of the first, and how far it is to the next.
struct Nodes<const N: usize> {
    columns: [i32; N],
    rows: [i32; N],
    across: [f32; N],
    down: [f32; N],
}

impl<const N: usize> Nodes<N> {
    /// Those around places between 0 and 1; `lasts` are the numbers of the last columns and rows.
    #[inline(always)]
    fn around(places: &[[f32; N]; 2], lasts: &[f32; N]) -> Self {
        let mut nodes = Self { columns: [0; N], rows: [0; N], across: [0.0; N], down: [0.0; N] };
        for lane in 0..N {
            (nodes.columns[lane], nodes.across[lane]) = split(places[0][lane], lasts[lane]);
            (nodes.rows[lane], nodes.down[lane]) = split(places[1][lane], lasts[lane]);
        }
        nodes
    }
}

impl Octahedron {
    /// The picture of a function of unit vectors.
    pub(super) fn of(side: usize, color: impl Fn([f32; 3]) -> [f32; 3]) -> Self {
        let node = |n: usize| {
            let [r, g, b] = color(unit(direction(place(n % side, side), place(n / side, side))));
            [r, g, b, 0.0]
        };
        Self { side, texels: (0..side * side).map(node).collect() }
    }

    /// The colour between the nodes of a lane.
    #[inline(always)]
    fn color<const N: usize>(&self, nodes: &Nodes<N>, lane: usize) -> Color {
        let at = nodes.rows[lane] as usize * self.side + nodes.columns[lane] as usize;
        let [a, b] = [self.texels[at], self.texels[at + 1]];
        let [c, d] = [self.texels[at + self.side], self.texels[at + self.side + 1]];
        let (s, t) = (nodes.across[lane], nodes.down[lane]);
        let mut color = [0.0; 4];
        for k in 0..4 {
            let upper = a[k] + (b[k] - a[k]) * s;
            let lower = c[k] + (d[k] - c[k]) * s;
            color[k] = upper + (lower - upper) * t;
        }
        color
    }

    /// Half as many nodes along a side; each the mean of its neighbours, the nearer counting more.
    pub(super) fn half(&self) -> Self {
        let side = self.side / 2 + 1;
        let node = |n: usize| {
            let (column, row) = (2 * (n % side) as i32, 2 * (n / side) as i32);
            let mut sum = [0.0; 4];
            for (dx, dy) in (-1..=1).flat_map(|dy| (-1..=1).map(move |dx| (dx, dy))) {
                let weight = ((2 - i32::abs(dx)) * (2 - i32::abs(dy))) as f32 / 16.0;
                let texel = self.texels[self.node(column + dx, row + dy)];
                sum = [0, 1, 2, 3].map(|k: usize| sum[k] + texel[k] * weight);
            }
            sum
        };
        Self { side, texels: (0..side * side).map(node).collect() }
    }

    /// The number of a node; those a step beyond a border are on the border's other half.
    fn node(&self, x: i32, y: i32) -> usize {
        let last = self.side as i32 - 1;
        let (x, y) =
            if (0..=last).contains(&x) { (x, y) } else { (x.abs().min(2 * last - x), last - y) };
        let (x, y) =
            if (0..=last).contains(&y) { (x, y) } else { (last - x, y.abs().min(2 * last - y)) };
        (y * (last + 1) + x) as usize
    }
}

/// Where a node is between −1 and 1.
pub(super) fn place(node: usize, side: usize) -> f32 {
    2.0 * node as f32 / (side - 1) as f32 - 1.0
}

/// The direction at a place of the square, on the octahedron.
pub(super) fn direction(u: f32, v: f32) -> [f32; 3] {
    let y = 1.0 - u.abs() - v.abs();
    if y >= 0.0 { [u, y, v] } else { [(1.0 - v.abs()) * sign(u), y, (1.0 - u.abs()) * sign(v)] }
}

pub(crate) fn unit(v: [f32; 3]) -> [f32; 3] {
    let length = (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt();
    v.map(|c| c / length)
}

#[inline(always)]
fn sign(x: f32) -> f32 {
    if x < 0.0 { -1.0 } else { 1.0 }
}

/// The node before a place between 0 and 1, and how far it is to the next.
#[inline(always)]
fn split(place: f32, last: f32) -> (i32, f32) {
    let place = (place * last).clamp(0.0, last);
    let node = (place as i32).min(last as i32 - 1);
    (node, place - node as f32)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(map: &Octahedron, way: [f32; 3]) -> Color {
        let [color] = between(|_| map, &[0], &[0.5], &way.map(|c| [c]));
        color
    }

    #[test]
    fn every_direction_finds_itself() {
        let map = Octahedron::of(129, |way| way);
        for step in 0..1000_u32 {
            let [x, y, z] =
                [step % 10, step / 10 % 10, step / 100].map(|c| c as f32 / 4.5 - 1.0 + 0.01);
            let way = unit([x, y, z]);
            let found = at(&map, [3.0 * x, 3.0 * y, 3.0 * z]);
            assert!((0..3).all(|k| (found[k] - way[k]).abs() < 0.02), "{way:?} {found:?}");
        }
    }

    #[test]
    fn borders_fold_onto_themselves() {
        let map = Octahedron::of(9, |_| [0.0; 3]);
        assert_eq!(map.node(-1, 2), 6 * 9 + 1);
        assert_eq!(map.node(9, 2), 6 * 9 + 7);
        assert_eq!(map.node(3, -1), 9 + 5);
        assert_eq!(map.node(-1, -1), 7 * 9 + 7);
        let smooth = Octahedron::of(65, |way| way).half();
        let found = at(&smooth, [0.3, -0.9, 0.1]);
        let way = unit([0.3, -0.9, 0.1]);
        assert!((0..3).all(|k| (found[k] - way[k]).abs() < 0.02), "{found:?}");
    }
}
