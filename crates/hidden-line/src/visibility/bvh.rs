//! Bounding-volume hierarchy over axis-aligned boxes, built by the binned surface-area heuristic.
//!
//! The construction follows Wald, *On fast construction of SAH-based bounding volume hierarchies*
//! (2007): each node is split along its longest axis, at the bin boundary where the expected cost
//! of its children is lowest. One hierarchy in world space serves both the search for intersections
//! and all views, which compute screen boxes for its nodes (`screen_bvh`).
//!
//! ```text
//!   nodes   0 ─┬─ 1 ─┬─ 2 leaf        depth first: the first child follows its parent,
//!              │     └─ 3 leaf        the second is referenced by index
//!              └─ 4 leaf
//!   order   [ items of 2 │ of 3 │ of 4 ]
//! ```
//!
//! Boxes are stored in single precision, relative to the overall center and rounded outward: a
//! query may report a box just outside its range, but never omits a box inside it.

use super::bounds::Bounds;
use glam::DVec3;
use std::ops::Range;

/// An axis-aligned bounding box.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Aabb {
    /// The minimum coordinates.
    pub(crate) min: DVec3,
    /// The maximum coordinates; less than `min` for the empty box.
    pub(crate) max: DVec3,
}

impl Aabb {
    /// The empty box: the identity of [`Self::union`].
    pub(crate) const EMPTY: Self = Self { min: DVec3::INFINITY, max: DVec3::NEG_INFINITY };

    /// Returns the smallest box around the points.
    pub fn from_points(points: impl IntoIterator<Item = DVec3>) -> Self {
        let grow =
            |grown: Self, point| Self { min: grown.min.min(point), max: grown.max.max(point) };
        points.into_iter().fold(Self::EMPTY, grow)
    }

    /// Returns the smallest box around three points, whose coordinates must not be NaN.
    pub(crate) fn around_triangle([a, b, c]: [DVec3; 3]) -> Self {
        let least = |a: f64, b: f64| if a < b { a } else { b };
        let greatest = |a: f64, b: f64| if a > b { a } else { b };
        let along = |pick: fn(f64, f64) -> f64| {
            let axis = |k: usize| pick(pick(a[k], b[k]), c[k]);
            DVec3::new(axis(0), axis(1), axis(2))
        };
        Self { min: along(least), max: along(greatest) }
    }

    /// Returns the smallest box around both boxes.
    pub(crate) fn union(self, other: Self) -> Self {
        Self { min: self.min.min(other.min), max: self.max.max(other.max) }
    }

    /// Returns the box with a margin `by` on each side.
    pub(crate) fn expanded_by(self, by: DVec3) -> Self {
        Self { min: self.min - by, max: self.max + by }
    }

    /// Whether two boxes have a point in common, including on their borders.
    pub(crate) fn intersects(&self, other: &Self) -> bool {
        self.min.x <= other.max.x
            && other.min.x <= self.max.x
            && self.min.y <= other.max.y
            && other.min.y <= self.max.y
            && self.min.z <= other.max.z
            && other.min.z <= self.max.z
    }

    /// Returns half the surface area, to which the probability that a ray meets the box is
    /// proportional.
    pub(crate) fn half_surface_area(&self) -> f64 {
        let size = self.max - self.min;
        size.x * size.y + size.y * size.z + size.z * size.x
    }
}

/// A node of the hierarchy: a leaf with items, or an inner node with two children.
#[derive(Clone, Copy, Debug)]
struct Node {
    /// The box around all items below the node.
    bounds: Bounds,
    /// For a leaf, the first item, as an index into [`Bvh::order`]; for an inner node, the second
    /// child. The first child is always the next node.
    first: u32,
    /// The number of items of a leaf; 0 marks an inner node.
    count: u32,
}

/// An item during construction.
#[derive(Clone, Copy)]
struct Item {
    bounds: Bounds,
    index: u32,
}

/// The children or the items of a node.
#[derive(Clone, PartialEq, Debug)]
pub(crate) enum NodeContents {
    /// The indices of the two children.
    Nodes([u32; 2]),
    /// A range of [`Bvh::order`].
    Items(Range<usize>),
}

/// A bounding-volume hierarchy.
#[derive(Clone, Debug, Default)]
pub(crate) struct Bvh {
    /// The nodes in depth-first order, with the root at index 0; empty if there are no items.
    nodes: Vec<Node>,
    /// The indices of the items, in the order of the leaves.
    pub(crate) order: Vec<u32>,
    /// The origin of the box coordinates.
    origin: DVec3,
}

/// The maximum number of items in a leaf.
const MAX_LEAF_ITEMS: usize = 6;
/// The number of bins of the surface-area heuristic.
const BIN_COUNT: usize = 16;
/// The number of bins of nodes with few items.
const FEW_BINS: usize = 6;
/// The maximum number of items of a node with few bins.
const FEW_ITEMS: usize = 48;
/// From this depth on, nodes are split at the median, which bounds the depth of any tree.
const MAX_BINNED_DEPTH: u32 = 48;

impl Bvh {
    /// Builds the hierarchy over some boxes; the iterator is traversed twice.
    pub(crate) fn new(boxes: impl Iterator<Item = Aabb> + Clone) -> Self {
        let all = boxes.clone().fold(Aabb::EMPTY, Aabb::union);
        let middle = (all.min + all.max) * 0.5;
        let origin = if middle.is_finite() { middle } else { DVec3::ZERO };
        let item =
            |(area, index): (Aabb, u32)| Item { bounds: Bounds::around(&area, origin), index };
        let mut items: Vec<Item> = boxes.zip(0..).map(item).collect();
        let mut tree = Self { nodes: Vec::new(), order: Vec::new(), origin };
        if !items.is_empty() {
            tree.nodes.reserve(items.len() / 2);
            let (mut bounds, mut centers) = (Bounds::EMPTY, Bounds::EMPTY);
            for item in &items {
                bounds.extend(&item.bounds);
                centers.extend_to(item.bounds.box_center());
            }
            tree.build_node(&mut items, 0, &BoundsOfItems { bounds, centers, count: 0 }, 0);
        }
        // Extends a new vector, because collecting in place would keep the memory of the items.
        tree.order.reserve_exact(items.len());
        tree.order.extend(items.iter().map(|item| item.index));
        tree
    }

    /// Returns the index of the root, or `None` if there are no items.
    pub(crate) fn root_node(&self) -> Option<u32> {
        (!self.nodes.is_empty()).then_some(0)
    }

    /// Returns the number of nodes. Children have higher indices than their parents.
    pub(crate) fn node_count(&self) -> usize {
        self.nodes.len()
    }

    /// Returns the children or the items of a node.
    pub(crate) fn contents(&self, node: u32) -> NodeContents {
        let Node { first, count, .. } = self.nodes[node as usize];
        match count {
            0 => NodeContents::Nodes([node + 1, first]),
            _ => NodeContents::Items(first as usize..(first + count) as usize),
        }
    }

    /// Calls `visit` with every item whose box may overlap `area`, or stops before exceeding `most`
    /// items and returns `false`.
    ///
    /// `open` is the traversal stack, provided by the caller so that its memory can be reused.
    /// Whole leaves are visited: the boxes of individual items are not tested.
    pub(crate) fn for_each_overlapping(
        &self,
        area: &Aabb,
        most: usize,
        open: &mut Vec<u32>,
        visit: impl FnMut(u32),
    ) -> bool {
        let area = Bounds::around(area, self.origin);
        self.for_each_item(|bounds| bounds.intersects(&area), most, open, visit)
    }

    /// Calls `visit` with every item of the leaves for which `may_hold` accepts the leaf's box and
    /// all boxes above it; stops after `most` items and returns `false`.
    fn for_each_item(
        &self,
        may_hold: impl Fn(&Bounds) -> bool,
        most: usize,
        open: &mut Vec<u32>,
        mut visit: impl FnMut(u32),
    ) -> bool {
        open.clear();
        open.extend(self.root_node());
        let mut remaining = most;
        while let Some(node) = open.pop() {
            if !may_hold(&self.nodes[node as usize].bounds) {
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

    /// Like [`for_each_overlapping`](Self::for_each_overlapping), but for every item whose box may
    /// be within `radius` of a segment. For a long segment, these are far fewer than the items that
    /// overlap its box.
    pub(crate) fn for_each_near_segment(
        &self,
        [from, to]: [DVec3; 2],
        radius: f64,
        most: usize,
        open: &mut Vec<u32>,
        visit: impl FnMut(u32),
    ) -> bool {
        let segment = [from - self.origin, to - self.origin];
        self.for_each_item(|bounds| bounds.is_near_segment(segment, radius), most, open, visit)
    }

    /// Returns the node indices of the leaves.
    pub(crate) fn leaf_nodes(&self) -> Vec<u32> {
        let nodes = (0..).zip(&self.nodes);
        nodes.filter(|(_, node)| node.count > 0).map(|(index, _)| index).collect()
    }

    /// Calls `visit` with the items of a leaf and `true`, then with the items of each later leaf
    /// whose box overlaps and `false`. Stops before exceeding `most` items and returns `false`.
    ///
    /// Calling this function for every leaf visits each pair of overlapping leaves once.
    pub(crate) fn for_each_later_leaf(
        &self,
        leaf: u32,
        most: usize,
        open: &mut Vec<u32>,
        mut visit: impl FnMut(&[u32], bool),
    ) -> bool {
        let area = self.nodes[leaf as usize].bounds;
        open.clear();
        open.extend(self.root_node());
        let mut remaining = most;
        while let Some(index) = open.pop() {
            let node = &self.nodes[index as usize];
            if !node.bounds.intersects(&area) {
                continue;
            }
            if node.count == 0 {
                // All nodes below the first child precede the second child; the leaf itself is
                // visited first.
                open.push(node.first);
                if leaf < node.first {
                    open.push(index + 1);
                }
            } else if index >= leaf {
                let count = node.count as usize;
                if count > remaining {
                    return false;
                }
                remaining -= count;
                let items = node.first as usize..node.first as usize + count;
                visit(&self.order[items], index == leaf);
            }
        }
        true
    }

    /// Returns the maximum number of items that each of `queries` queries may visit.
    ///
    /// The limit bounds the time for degenerate input, such as a million triangles in one box,
    /// where every query meets every item. All queries together make at most 2²⁶ visits, or 1024
    /// per query if there are many queries. Scenes with a few thousand items never reach the limit.
    pub(crate) fn query_budget(queries: usize) -> usize {
        const ALL: usize = 1 << 26;
        (ALL / queries.max(1)).max(1024)
    }

    /// Builds the subtree over some items, which start at `first` in the order, and appends its
    /// nodes in depth-first order.
    ///
    /// Each node is pushed as a leaf and becomes an inner node once the index of its second child
    /// is known.
    fn build_node(&mut self, items: &mut [Item], first: u32, extents: &BoundsOfItems, depth: u32) {
        let node = self.nodes.len();
        let bounds = extents.bounds;
        self.nodes.push(Node { bounds, first, count: items.len() as u32 });
        if items.len() <= MAX_LEAF_ITEMS {
            return;
        }
        let split = match items.len() {
            _ if depth >= MAX_BINNED_DEPTH => None,
            ..=FEW_ITEMS => partition_by_sah::<FEW_BINS>(items, &extents.centers),
            _ => partition_by_sah::<BIN_COUNT>(items, &extents.centers),
        };
        let split = split.unwrap_or_else(|| partition_at_median(items, &extents.centers));
        let (left, right) = items.split_at_mut(split[0].count);
        let middle = first + left.len() as u32;
        self.build_node(left, first, &split[0], depth + 1);
        let second = self.nodes.len() as u32;
        self.build_node(right, middle, &split[1], depth + 1);
        self.nodes[node] = Node { bounds, first: second, count: 0 };
    }
}

/// A number of items, with the boxes around the items and around their centers.
#[derive(Clone, Copy)]
struct BoundsOfItems {
    bounds: Bounds,
    centers: Bounds,
    count: usize,
}

impl BoundsOfItems {
    const EMPTY: Self = Self { bounds: Bounds::EMPTY, centers: Bounds::EMPTY, count: 0 };

    fn of_items(items: &[Item]) -> Self {
        let mut extents = Self::EMPTY;
        items.iter().for_each(|item| extents.insert(item, item.bounds.box_center()));
        extents
    }

    fn insert(&mut self, item: &Item, center: [f32; 3]) {
        self.bounds.extend(&item.bounds);
        self.centers.extend_to(center);
        self.count += 1;
    }

    fn extend(&mut self, other: &Self) {
        self.bounds.extend(&other.bounds);
        self.centers.extend(&other.centers);
        self.count += other.count;
    }

    /// Returns the expected cost of a node, up to a factor.
    fn sah_cost(&self) -> f32 {
        if self.count == 0 { 0.0 } else { self.bounds.half_surface_area() * self.count as f32 }
    }
}

/// Partitions items where the sum of the children's costs is lowest, and returns the extents of
/// both parts.
///
/// Items are binned by their centers, along the longest axis of the box around the centers rather
/// than around the items, so that one large item does not waste bins. Returns `None` if all centers
/// coincide, if the boxes have no area to compare, or if the best split leaves one side empty.
fn partition_by_sah<const BINS: usize>(
    items: &mut [Item],
    centers: &Bounds,
) -> Option<[BoundsOfItems; 2]> {
    let (axis, extent) = longest_axis(centers);
    if extent <= 0.0 || !extent.is_finite() {
        return None;
    }
    let (from, scale) = (centers.min[axis], BINS as f32 / extent);
    let bin = |center: f32| (((center - from) * scale) as usize).min(BINS - 1);
    let mut bins = [BoundsOfItems::EMPTY; BINS];
    for item in &*items {
        let center = item.bounds.box_center();
        bins[bin(center[axis])].insert(item, center);
    }
    let cut = cheapest_bin_split(&bins)?;
    let mut split = [BoundsOfItems::EMPTY; 2];
    for (at, extents) in bins.iter().enumerate() {
        split[usize::from(at > cut)].extend(extents);
    }
    let mut left = 0;
    for at in 0..items.len() {
        let bounds = &items[at].bounds;
        if bin((bounds.min[axis] + bounds.max[axis]) * 0.5) <= cut {
            items.swap(left, at);
            left += 1;
        }
    }
    (left > 0 && left < items.len()).then_some(split)
}

/// Returns the last bin on the left side of the cheapest split, or `None` if no box has an area.
/// The split is found by a sweep from the right and a sweep from the left.
fn cheapest_bin_split<const BINS: usize>(bins: &[BoundsOfItems; BINS]) -> Option<usize> {
    let mut right = [0.0; BINS];
    let mut extents = BoundsOfItems::EMPTY;
    for at in (1..BINS).rev() {
        extents.extend(&bins[at]);
        right[at - 1] = extents.sah_cost();
    }
    extents = BoundsOfItems::EMPTY;
    let mut best = None;
    for at in 0..BINS - 1 {
        extents.extend(&bins[at]);
        let sum = extents.sah_cost() + right[at];
        if best.is_none_or(|(least, _)| sum < least) {
            best = Some((sum, at));
        }
    }
    best.filter(|(sum, _)| *sum > 0.0 && sum.is_finite()).map(|(_, at)| at)
}

/// Partitions items into halves of equal count along the longest axis.
fn partition_at_median(items: &mut [Item], centers: &Bounds) -> [BoundsOfItems; 2] {
    let (axis, _) = longest_axis(centers);
    let half = items.len() / 2;
    let key = |item: &Item| item.bounds.box_center()[axis];
    items
        .select_nth_unstable_by(half, |a, b| key(a).total_cmp(&key(b)).then(a.index.cmp(&b.index)));
    let (left, right) = items.split_at(half);
    [left, right].map(BoundsOfItems::of_items)
}

/// Returns the longest side of a box: its axis and its length.
fn longest_axis(bounds: &Bounds) -> (usize, f32) {
    let extent = [0, 1, 2].map(|k| bounds.max[k] - bounds.min[k]);
    let axis = if extent[0] >= extent[1] && extent[0] >= extent[2] {
        0
    } else {
        usize::from(extent[1] < extent[2]) + 1
    };
    (axis, extent[axis])
}
