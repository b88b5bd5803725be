//! Bounding-volume hierarchy over axis-aligned boxes, built by the binned surface-area heuristic.
//!
//! After Wald, *On fast construction of SAH-based bounding volume hierarchies* (2007): each node is
//! split where the expected cost of its children is least, among 16 bins along its longest axis.
//! The cost of a box is given by the caller, since queries differ: a box on the screen is met in
//! proportion to half its perimeter by long edges, a box in space in proportion to its surface.
//!
//! ```text
//!   nodes   0 ─┬─ 1 ─┬─ 2 leaf        depth first: the first child follows its parent,
//!              │     └─ 3 leaf        the second is named by index
//!              └─ 4 leaf
//!   order   [ items of 2 │ of 3 │ of 4 ]
//! ```

use glam::DVec3;

/// An axis-aligned bounding box.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct Aabb {
    /// The least coordinates.
    pub(crate) min: DVec3,
    /// The greatest coordinates; less than `min` for the empty box.
    pub(crate) max: DVec3,
}

impl Aabb {
    /// The box around nothing: the identity of [`Self::union`].
    pub(crate) const EMPTY: Self = Self { min: DVec3::INFINITY, max: DVec3::NEG_INFINITY };

    /// The smallest box around some points.
    pub(crate) fn from_points(points: impl IntoIterator<Item = DVec3>) -> Self {
        let grow =
            |grown: Self, point| Self { min: grown.min.min(point), max: grown.max.max(point) };
        points.into_iter().fold(Self::EMPTY, grow)
    }

    /// The smallest box around both.
    pub(crate) fn union(self, other: Self) -> Self {
        Self { min: self.min.min(other.min), max: self.max.max(other.max) }
    }

    /// The box with a margin `by` on each side.
    pub(crate) fn expanded_by(self, by: DVec3) -> Self {
        Self { min: self.min - by, max: self.max + by }
    }

    /// Whether two boxes have a point in common, borders included.
    pub(crate) fn intersects(&self, other: &Self) -> bool {
        self.min.cmple(other.max).all() && other.min.cmple(self.max).all()
    }

    /// The midpoint, by which items are sorted into bins.
    fn box_center(&self) -> DVec3 {
        (self.min + self.max) * 0.5
    }
}

/// A node of the hierarchy: a leaf with items or an inner node with two children.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Node {
    /// The box around everything below the node.
    pub(crate) bounds: Aabb,
    /// In a leaf the first item, an index into [`Bvh::order`]; otherwise the second child. The
    /// first child is the next node.
    first: u32,
    /// The number of items of a leaf; 0 marks an inner node.
    count: u32,
}

/// The children or the items of a node.
#[derive(Clone, PartialEq, Debug)]
pub(crate) enum NodeContents {
    /// The indices of the two children.
    Nodes([u32; 2]),
    /// A range of [`Bvh::order`].
    Items(std::ops::Range<usize>),
}

/// The hierarchy.
#[derive(Clone, Debug, Default)]
pub(crate) struct Bvh {
    /// Depth first, the root at index 0; empty if there are no items.
    nodes: Vec<Node>,
    /// The indices of the items, in the order of the leaves.
    pub(crate) order: Vec<u32>,
}

/// A node with no more items than this becomes a leaf.
const MAX_LEAF_ITEMS: usize = 4;
/// The number of bins of the surface-area heuristic.
const BIN_COUNT: usize = 16;
/// Below this depth nodes are split at the median, which bounds the depth whatever the boxes.
const MAX_BINNED_DEPTH: u32 = 48;

impl Bvh {
    /// Builds the hierarchy of some boxes. `cost` is proportional to the probability that a query
    /// meets a box of a given extent.
    pub(crate) fn new(boxes: &[Aabb], cost: fn(DVec3) -> f64) -> Self {
        let count = u32::try_from(boxes.len()).unwrap_or(u32::MAX);
        let mut tree = Self { nodes: Vec::new(), order: (0..count).collect() };
        if count > 0 {
            tree.nodes.reserve(boxes.len());
            tree.build_node(boxes, 0..count as usize, 0, cost);
        }
        tree
    }

    /// The index of the root; `None` if there are no items.
    pub(crate) fn root_node(&self) -> Option<u32> {
        (!self.nodes.is_empty()).then_some(0)
    }

    /// The box of a node.
    pub(crate) fn bounds(&self, node: u32) -> &Aabb {
        &self.nodes[node as usize].bounds
    }

    /// The children or the items of a node.
    pub(crate) fn contents(&self, node: u32) -> NodeContents {
        let Node { first, count, .. } = self.nodes[node as usize];
        match count {
            0 => NodeContents::Nodes([node + 1, first]),
            _ => NodeContents::Items(first as usize..(first + count) as usize),
        }
    }

    /// Calls `visit` with every item whose box may overlap `area`; stops and returns `false` after
    /// `most` items.
    ///
    /// `open` is the stack of the traversal, given by the caller so that its memory is reused.
    /// Items are visited by leaf: their own boxes are not tested.
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
                NodeContents::Items(range) if range.len() <= remaining => {
                    remaining -= range.len();
                    self.order[range].iter().for_each(|&item| visit(item));
                }
                NodeContents::Items(_) => return false,
            }
        }
        true
    }

    /// The number of items that each of `queries` queries may visit, so that all together stay
    /// below 2³¹ visits.
    ///
    /// It bounds the time on degenerate input, such as a million triangles in one box, where every
    /// query meets every item. Scenes with a few thousand items are never limited, and each query
    /// may visit at least 1024.
    pub(crate) fn query_budget(queries: usize) -> usize {
        const ALL: usize = 1 << 31;
        (ALL / queries.max(1)).max(1024)
    }

    /// Builds the subtree over a range of `order`, in place, and appends its nodes depth first.
    ///
    /// A node is pushed as a leaf first and turned into an inner node when the index of its second
    /// child is known.
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

/// Partitions items where the sum of the children's costs times their counts is least; returns the
/// size of the left part.
///
/// Items are binned by their centers along the longest axis of the centers' box, not of the items'
/// box, so that one large item does not waste bins. `None` if all centers coincide or the best
/// split leaves a side empty.
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

/// The last bin of the left side at the cheapest split: one sweep from the right for the costs
/// there, one from the left.
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

/// Partitions items into halves of equal count along the longest axis.
fn partition_at_median(boxes: &[Aabb], items: &mut [u32], centers: Aabb) -> usize {
    let axis = longest_axis(centers.max - centers.min);
    let half = items.len() / 2;
    let key = |item: u32| boxes[item as usize].box_center()[axis];
    items.select_nth_unstable_by(half, |&a, &b| key(a).total_cmp(&key(b)).then(a.cmp(&b)));
    half
}

/// The index of the greatest component.
fn longest_axis(extent: DVec3) -> usize {
    if extent.x >= extent.y && extent.x >= extent.z {
        0
    } else if extent.y >= extent.z {
        1
    } else {
        2
    }
}
