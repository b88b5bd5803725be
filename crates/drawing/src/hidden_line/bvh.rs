//! A tree of boxes, to find the few of many things that a query can touch.
//!
//! Built from the top by the surface-area heuristic over 16 bins (Wald, *On fast construction of SAH-based bounding volume
//! hierarchies*, 2007). What a box costs is given by the caller: half its circumference on the screen, where edges are
//! asked for, or half its surface in space.

use glam::DVec3;

/// A box along the axes.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct Aabb {
    pub(crate) min: DVec3,
    pub(crate) max: DVec3,
}

impl Aabb {
    /// The box around nothing.
    pub(crate) const EMPTY: Self = Self { min: DVec3::INFINITY, max: DVec3::NEG_INFINITY };

    /// The box around some points.
    pub(crate) fn from_points(points: impl IntoIterator<Item = DVec3>) -> Self {
        let grow =
            |grown: Self, point| Self { min: grown.min.min(point), max: grown.max.max(point) };
        points.into_iter().fold(Self::EMPTY, grow)
    }

    pub(crate) fn union(self, other: Self) -> Self {
        Self { min: self.min.min(other.min), max: self.max.max(other.max) }
    }

    /// The box with `by` more on each side.
    pub(crate) fn expanded_by(self, by: DVec3) -> Self {
        Self { min: self.min - by, max: self.max + by }
    }

    pub(crate) fn intersects(&self, other: &Self) -> bool {
        self.min.cmple(other.max).all() && other.min.cmple(self.max).all()
    }

    fn box_center(&self) -> DVec3 {
        (self.min + self.max) * 0.5
    }
}

/// A node of the tree.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Node {
    pub(crate) bounds: Aabb,
    /// The first item of a leaf; the second child of another node, whose first child is the next node.
    first: u32,
    /// The number of items; 0 if the node is no leaf.
    count: u32,
}

/// What is below a node.
#[derive(Clone, PartialEq, Debug)]
pub(crate) enum NodeContents {
    /// The numbers of two nodes.
    Nodes([u32; 2]),
    /// Places in [`Bvh::order`].
    Items(std::ops::Range<usize>),
}

/// The tree.
#[derive(Clone, Debug, Default)]
pub(crate) struct Bvh {
    nodes: Vec<Node>,
    /// The numbers of the items, in the order of the leaves.
    pub(crate) order: Vec<u32>,
}

const MAX_LEAF_ITEMS: usize = 4;
const BIN_COUNT: usize = 16;
/// Below this depth nodes are cut in halves of equal count, so that the depth has a bound whatever the boxes.
const MAX_BINNED_DEPTH: u32 = 48;

impl Bvh {
    /// The tree of some boxes. `cost` tells how often a query meets a box of some size.
    pub(crate) fn new(boxes: &[Aabb], cost: fn(DVec3) -> f64) -> Self {
        let count = u32::try_from(boxes.len()).unwrap_or(u32::MAX);
        let mut tree = Self { nodes: Vec::new(), order: (0..count).collect() };
        if count > 0 {
            tree.nodes.reserve(boxes.len());
            tree.build_node(boxes, 0..count as usize, 0, cost);
        }
        tree
    }

    /// The root, if there is anything.
    pub(crate) fn root_node(&self) -> Option<u32> {
        (!self.nodes.is_empty()).then_some(0)
    }

    pub(crate) fn bounds(&self, node: u32) -> &Aabb {
        &self.nodes[node as usize].bounds
    }

    pub(crate) fn contents(&self, node: u32) -> NodeContents {
        let Node { first, count, .. } = self.nodes[node as usize];
        match count {
            0 => NodeContents::Nodes([node + 1, first]),
            _ => NodeContents::Items(first as usize..(first + count) as usize),
        }
    }

    /// Calls `visit` with every item whose box may meet `area`, but with no more than `most`. False if there were more.
    pub(crate) fn for_each_overlapping(
        &self,
        area: &Aabb,
        most: usize,
        open: &mut Vec<u32>,
        mut visit: impl FnMut(u32),
    ) -> bool {
        open.clear();
        open.extend(self.root_node());
        let mut remaining = most;
        while let Some(node) = open.pop() {
            if !self.bounds(node).intersects(area) {
                continue;
            }
            match self.contents(node) {
                NodeContents::Nodes(children) => open.extend(children),
                NodeContents::Items(places) if places.len() <= remaining => {
                    remaining -= places.len();
                    self.order[places].iter().for_each(|&item| visit(item));
                }
                NodeContents::Items(_) => return false,
            }
        }
        true
    }

    /// How many items a query may visit if each of so many items asks, for an amount of work that has a bound, whatever the
    /// boxes: all of them where there are few, and always more than meet where things are spread as usual.
    pub(crate) fn query_budget(queries: usize) -> usize {
        const ALL: usize = 1 << 31;
        (ALL / queries.max(1)).max(1024)
    }

    fn build_node(
        &mut self,
        boxes: &[Aabb],
        range: std::ops::Range<usize>,
        depth: u32,
        cost: fn(DVec3) -> f64,
    ) {
        let items = &self.order[range.clone()];
        let (mut bounds, mut centers) = (Aabb::EMPTY, Aabb::EMPTY);
        for &item in items {
            let item = boxes[item as usize];
            bounds = bounds.union(item);
            centers = centers.union(Aabb::from_points([item.box_center()]));
        }
        let node_index = self.nodes.len();
        let (first, count) = (range.start as u32, range.len() as u32);
        self.nodes.push(Node { bounds, first, count });
        if range.len() <= MAX_LEAF_ITEMS {
            return;
        }
        let items = &mut self.order[range.clone()];
        let left = if depth < MAX_BINNED_DEPTH {
            partition_by_sah(boxes, items, centers, cost)
        } else {
            None
        };
        let left = left.unwrap_or_else(|| partition_at_median(boxes, items, centers));
        let middle = range.start + left;
        self.build_node(boxes, range.start..middle, depth + 1, cost);
        let second = self.nodes.len() as u32;
        self.build_node(boxes, middle..range.end, depth + 1, cost);
        self.nodes[node_index] = Node { bounds, first: second, count: 0 };
    }
}

/// Parts the items where the sum of the children's costs times their counts is least; the number of those on the left.
fn partition_by_sah(
    boxes: &[Aabb],
    items: &mut [u32],
    centers: Aabb,
    cost: fn(DVec3) -> f64,
) -> Option<usize> {
    let extent = centers.max - centers.min;
    let axis = longest_axis(extent);
    if extent[axis] <= 0.0 || !extent[axis].is_finite() {
        return None;
    }
    let scale = BIN_COUNT as f64 / extent[axis];
    let bin = |item: u32| {
        let along = boxes[item as usize].box_center()[axis] - centers.min[axis];
        ((along * scale) as usize).min(BIN_COUNT - 1)
    };
    let mut bins = [(Aabb::EMPTY, 0_usize); BIN_COUNT];
    for &item in &*items {
        let (bounds, count) = &mut bins[bin(item)];
        *bounds = bounds.union(boxes[item as usize]);
        *count += 1;
    }
    let cut = cheapest_bin_split(&bins, cost)?;
    let mut left = 0;
    for at in 0..items.len() {
        if bin(items[at]) <= cut {
            items.swap(left, at);
            left += 1;
        }
    }
    (left > 0 && left < items.len()).then_some(left)
}

/// The last bin of the left part.
fn cheapest_bin_split(bins: &[(Aabb, usize); BIN_COUNT], cost: fn(DVec3) -> f64) -> Option<usize> {
    let sah_cost = |bounds: Aabb, count: usize| match count {
        0 => 0.0,
        _ => cost(bounds.max - bounds.min) * count as f64,
    };
    let mut right = [0.0; BIN_COUNT];
    let (mut bounds, mut count) = (Aabb::EMPTY, 0);
    for at in (1..BIN_COUNT).rev() {
        (bounds, count) = (bounds.union(bins[at].0), count + bins[at].1);
        right[at - 1] = sah_cost(bounds, count);
    }
    (bounds, count) = (Aabb::EMPTY, 0);
    let mut best = None;
    for at in 0..BIN_COUNT - 1 {
        (bounds, count) = (bounds.union(bins[at].0), count + bins[at].1);
        let sum = sah_cost(bounds, count) + right[at];
        if best.is_none_or(|(least, _)| sum < least) {
            best = Some((sum, at));
        }
    }
    best.map(|(_, at)| at)
}

/// Parts the items in two halves along the longest axis.
fn partition_at_median(boxes: &[Aabb], items: &mut [u32], centers: Aabb) -> usize {
    let axis = longest_axis(centers.max - centers.min);
    let half = items.len() / 2;
    let key = |item: u32| boxes[item as usize].box_center()[axis];
    items.select_nth_unstable_by(half, |&a, &b| key(a).total_cmp(&key(b)).then(a.cmp(&b)));
    half
}

fn longest_axis(extent: DVec3) -> usize {
    if extent.x >= extent.y && extent.x >= extent.z {
        0
    } else if extent.y >= extent.z {
        1
    } else {
        2
    }
}
