//! Skins: joints, their matrices, and the weights of the vertices they bend (glTF 2.0 §3.7.3).

use super::codes::{self, Code};
use super::data::{Demand, Demands};
use super::document::{Document, index, integer, items, members, whole};
use super::elements::Elements;
use super::layout::{Component, Layout, MAT4};
use super::nodes::Tree;
use super::store::Store;
use super::usage::{Usage, Use};
use serde_json::{Map, Value};

/// Checks all skins; notes what is demanded of accessors.
pub(super) fn check(
    document: &Document<'_>,
    tree: &Tree,
    usage: &Usage<'_>,
    demands: &mut Demands,
) {
    for (at, skin) in document.all("skins").iter().enumerate() {
        let pointer = format!("/skins/{at}");
        let all = items(skin, "joints");
        let joint = |joint: &Value| usize::try_from(whole(joint)?).ok();
        let joints: Vec<usize> = all.iter().filter_map(joint).collect();
        check_root(document, tree, &joints, skin, &pointer);
        check_matrices(document, usage, demands, all.len(), skin, &pointer);
    }
}

fn check_root(document: &Document<'_>, tree: &Tree, joints: &[usize], skin: &Value, pointer: &str) {
    let findings = document.findings;
    let top = |&joint: &usize| tree.tops.get(joint).copied().flatten();
    let mut tops = joints.iter().map(top);
    let first = tops.next();
    if first.is_some_and(|first| first.is_none() || tops.any(|top| top != first)) {
        let message = "the joints are not all below one node";
        findings.add(&codes::SKIN_NO_COMMON_ROOT, format_args!("{pointer}/joints"), message);
    }
    let skeleton = index(skin, "skeleton").filter(|&node| node < tree.parents.len());
    if let Some(node) = skeleton
        && !joints.iter().all(|&joint| tree.is_below(joint, node))
    {
        let message = format_args!("not all joints are below node {node}");
        findings.add(&codes::SKIN_SKELETON_INVALID, format_args!("{pointer}/skeleton"), message);
    }
}

fn check_matrices(
    document: &Document<'_>,
    usage: &Usage<'_>,
    demands: &mut Demands,
    joints: usize,
    skin: &Value,
    pointer: &str,
) {
    let findings = document.findings;
    let Some(at) = index(skin, "inverseBindMatrices") else { return };
    let Some(accessor) = document.all("accessors").get(at) else { return };
    let pointer = format!("{pointer}/inverseBindMatrices");
    usage.accessor(at, Use::InverseBind, &pointer);
    if usage.has_stride(at) {
        let message = "the view of the matrices must not have a stride";
        findings.add(&codes::SKIN_IBM_ACCESSOR_WITH_BYTESTRIDE, &pointer, message);
    }
    let Some(layout) = Layout::of(accessor) else { return };
    if (layout.shape, layout.component) == (MAT4, Component::F32) {
        demands.add(at, Demand::Matrices, &pointer);
    } else {
        let message = format_args!("the matrices cannot be {}", layout.format());
        findings.add(&codes::SKIN_IBM_INVALID_FORMAT, &pointer, message);
    }
    if layout.count < joints as u64 {
        let message = format_args!("{} matrices for {joints} joints", layout.count);
        findings.add(&codes::INVALID_IBM_ACCESSOR_COUNT, &pointer, message);
    }
}

/// Checks joints and weights of all meshes that a skin bends.
pub(super) fn check_weights(document: &Document<'_>, store: &Store<'_>) {
    // A mesh may be bent by several skins: the one with the fewest joints is the measure.
    let mut most: Vec<Option<usize>> = vec![None; document.all("meshes").len()];
    let skins = document.all("skins");
    for node in document.all("nodes") {
        let skin = index(node, "skin").and_then(|skin| skins.get(skin));
        let mesh = index(node, "mesh").and_then(|mesh| most.get_mut(mesh));
        if let (Some(skin), Some(mesh)) = (skin, mesh) {
            let joints = items(skin, "joints").len();
            *mesh = Some(mesh.map_or(joints, |most| most.min(joints)));
        }
    }
    for (at, (mesh, joints)) in document.all("meshes").iter().zip(most).enumerate() {
        let Some(joints) = joints.filter(|&joints| joints > 0) else { continue };
        for (part, primitive) in items(mesh, "primitives").iter().enumerate() {
            if let Some(named) = members(primitive, "attributes") {
                let pointer = format!("/meshes/{at}/primitives/{part}/attributes");
                Influences { document, store, joints, pointer }.check(named);
            }
        }
    }
}

/// Joints and weights of every vertex, four of each.
type Set = (Vec<[f32; 4]>, Vec<[f32; 4]>);

struct Influences<'a> {
    document: &'a Document<'a>,
    store: &'a Store<'a>,
    joints: usize,
    pointer: String,
}

/// So many sets of joints and weights are looked at; nobody has more.
const MOST_SETS: usize = 16;

/// Weights rounded to bytes may add up to so much more or less than 1 for every two joints beyond the first two. The
/// validator's number.
const ROUNDING: f64 = 0.003_921_6;

impl Influences<'_> {
    fn check(&self, named: &Map<String, Value>) {
        let mut sets = Vec::new();
        while let (true, Some(joints), Some(weights)) = (
            sets.len() < MOST_SETS,
            named.get(&format!("JOINTS_{}", sets.len())),
            named.get(&format!("WEIGHTS_{}", sets.len())),
        ) {
            let (Some(joints), Some(weights)) = (self.read(joints), self.read(weights)) else {
                return;
            };
            sets.push((joints, weights));
        }
        let count = sets.first().map(|(joints, _)| joints.len());
        if sets
            .iter()
            .any(|(joints, weights)| Some(joints.len()) != count || Some(weights.len()) != count)
        {
            return;
        }
        let mut faults = [[0_u64; 4]; MOST_SETS];
        for vertex in 0..count.unwrap_or(0) {
            self.vertex(&sets, vertex, &mut faults);
        }
        let words: [(&Code, &str, &str); 4] = [
            (&codes::ACCESSOR_JOINTS_INDEX_OOB, "JOINTS", "joints are not in the skin"),
            (&codes::ACCESSOR_JOINTS_INDEX_DUPLICATE, "JOINTS", "joints bend a vertex twice"),
            (&codes::ACCESSOR_WEIGHTS_NEGATIVE, "WEIGHTS", "weights are negative"),
            (
                &codes::ACCESSOR_WEIGHTS_NON_NORMALIZED,
                "WEIGHTS",
                "weights of vertices do not add up to 1",
            ),
        ];
        for (set, counts) in faults.iter().enumerate() {
            for (count, (code, name, what)) in counts.iter().zip(words) {
                if *count > 0 {
                    let pointer = format_args!("{}/{name}_{set}", self.pointer);
                    self.document.findings.add(
                        code,
                        pointer,
                        format_args!("{what} (how many: {count})"),
                    );
                }
            }
        }
    }

    /// The four numbers of every vertex.
    fn read(&self, accessor: &Value) -> Option<Vec<[f32; 4]>> {
        let at = usize::try_from(whole(accessor)?).ok()?;
        let accessor = self.document.all("accessors").get(at)?;
        let layout = Layout::of(accessor).filter(|layout| layout.shape.numbers() == 4)?;
        let elements: Elements<'_> = self.store.elements(accessor, layout)?;
        let pointer = format!("/accessors/{at}/count");
        // Only what has bytes is worth the memory.
        layout.view.filter(|_| integer(accessor, "count").is_some())?;
        self.store.may_spend(&pointer, layout.count.saturating_mul(16)).then_some(())?;
        let mut all = Vec::new();
        elements.each(|_, numbers| {
            let number = |at: usize| elements.meaning(numbers[at]) as f32;
            all.push([number(0), number(1), number(2), number(3)]);
        });
        Some(all)
    }

    fn vertex(&self, sets: &[Set], vertex: usize, faults: &mut [[u64; 4]; MOST_SETS]) {
        let mut known = [0.0_f32; 4 * MOST_SETS];
        let (mut number, mut sum) = (0, 0.0_f64);
        for (set, (joints, weights)) in sets.iter().enumerate() {
            for (joint, weight) in joints[vertex].into_iter().zip(weights[vertex]) {
                if joint as usize >= self.joints {
                    faults[set][0] += 1;
                    continue;
                }
                if weight == 0.0 {
                    continue;
                }
                let is_known = known[..number].contains(&joint);
                faults[set][1] += u64::from(is_known);
                faults[set][2] += u64::from(weight < 0.0);
                if !is_known {
                    known[number] = joint;
                    number += 1;
                    sum += f64::from(weight.max(0.0));
                }
            }
        }
        // Adding in single precision, as others do, loses some digits.
        let allowed =
            ROUNDING * (number.div_ceil(2).saturating_sub(1)) as f64 + 2e-7 * number as f64;
        if (sum - 1.0).abs() > allowed {
            (0..sets.len()).for_each(|set| faults[set][3] += 1);
        }
    }
}
