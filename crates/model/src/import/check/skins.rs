//! Skins: joints, their matrices, and the weights of the vertices they bend (glTF 2.0 §3.7.3).

use super::codes::{self, DiagnosticCode};
use super::data::{ElementRule, ElementRules};
use super::document::{
    CheckedDocument, array_items, as_whole_number, index_member, integer_member, object_members,
};
use super::elements::AccessorElements;
use super::layout::{AccessorLayout, ComponentType, MAT4};
use super::nodes::NodeTree;
use super::store::BufferStore;
use super::usage::{AccessorUse, UsageMap};
use serde_json::{Map, Value};

/// Checks all skins; notes what is demanded of accessors.
pub(super) fn check_skins(
    document: &CheckedDocument<'_>,
    tree: &NodeTree,
    usage: &UsageMap<'_>,
    demands: &mut ElementRules,
) {
    for (at, skin) in document.root_array("skins").iter().enumerate() {
        let pointer = format!("/skins/{at}");
        let all = array_items(skin, "joints");
        let joint = |joint: &Value| usize::try_from(as_whole_number(joint)?).ok();
        let joints: Vec<usize> = all.iter().filter_map(joint).collect();
        check_common_root(document, tree, &joints, skin, &pointer);
        check_inverse_bind_matrices(document, usage, demands, all.len(), skin, &pointer);
    }
}

fn check_common_root(
    document: &CheckedDocument<'_>,
    tree: &NodeTree,
    joints: &[usize],
    skin: &Value,
    pointer: &str,
) {
    let diagnostics = document.diagnostics;
    let top = |&joint: &usize| tree.roots.get(joint).copied().flatten();
    let mut tops = joints.iter().map(top);
    let first = tops.next();
    if first.is_some_and(|first| first.is_none() || tops.any(|top| top != first)) {
        let message = "the joints are not all below one node";
        diagnostics.add(&codes::SKIN_NO_COMMON_ROOT, format_args!("{pointer}/joints"), message);
    }
    let skeleton = index_member(skin, "skeleton").filter(|&node| node < tree.parents.len());
    if let Some(node) = skeleton
        && !joints.iter().all(|&joint| tree.is_at_or_below(joint, node))
    {
        let message = format_args!("not all joints are below node {node}");
        diagnostics.add(&codes::SKIN_SKELETON_INVALID, format_args!("{pointer}/skeleton"), message);
    }
}

fn check_inverse_bind_matrices(
    document: &CheckedDocument<'_>,
    usage: &UsageMap<'_>,
    demands: &mut ElementRules,
    joints: usize,
    skin: &Value,
    pointer: &str,
) {
    let diagnostics = document.diagnostics;
    let Some(at) = index_member(skin, "inverseBindMatrices") else { return };
    let Some(accessor) = document.root_array("accessors").get(at) else { return };
    let pointer = format!("{pointer}/inverseBindMatrices");
    usage.note_accessor(at, AccessorUse::InverseBind, &pointer);
    if usage.has_stride(at) {
        let message = "the view of the matrices must not have a stride";
        diagnostics.add(&codes::SKIN_IBM_ACCESSOR_WITH_BYTESTRIDE, &pointer, message);
    }
    let Some(layout) = AccessorLayout::from_accessor(accessor) else { return };
    if (layout.element_type, layout.component_type) == (MAT4, ComponentType::F32) {
        demands.add(at, ElementRule::Matrices, &pointer);
    } else {
        let message = format_args!("the matrices cannot be {}", layout.format_name());
        diagnostics.add(&codes::SKIN_IBM_INVALID_FORMAT, &pointer, message);
    }
    if layout.count < joints as u64 {
        let message = format_args!("{} matrices for {joints} joints", layout.count);
        diagnostics.add(&codes::INVALID_IBM_ACCESSOR_COUNT, &pointer, message);
    }
}

/// Checks joints and weights of all meshes that a skin bends.
pub(super) fn check_skinned_meshes(document: &CheckedDocument<'_>, store: &BufferStore<'_>) {
    // A mesh may be bent by several skins: the one with the fewest joints is the measure.
    let mut fewest_joints: Vec<Option<usize>> = vec![None; document.root_array("meshes").len()];
    let skins = document.root_array("skins");
    for node in document.root_array("nodes") {
        let skin = index_member(node, "skin").and_then(|skin| skins.get(skin));
        let mesh = index_member(node, "mesh").and_then(|mesh| fewest_joints.get_mut(mesh));
        if let (Some(skin), Some(mesh)) = (skin, mesh) {
            let joints = array_items(skin, "joints").len();
            *mesh = Some(mesh.map_or(joints, |most| most.min(joints)));
        }
    }
    for (at, (mesh, joints)) in document.root_array("meshes").iter().zip(fewest_joints).enumerate()
    {
        let Some(joints) = joints.filter(|&joints| joints > 0) else { continue };
        for (part, primitive) in array_items(mesh, "primitives").iter().enumerate() {
            if let Some(named) = object_members(primitive, "attributes") {
                let pointer = format!("/meshes/{at}/primitives/{part}/attributes");
                InfluenceChecker { document, store, joints, pointer }.check_influences(named);
            }
        }
    }
}

/// Joints and weights of every vertex, four of each.
type InfluenceSet = (Vec<[f32; 4]>, Vec<[f32; 4]>);

struct InfluenceChecker<'a> {
    document: &'a CheckedDocument<'a>,
    store: &'a BufferStore<'a>,
    joints: usize,
    pointer: String,
}

/// So many sets of joints and weights are looked at; nobody has more.
const MAX_SETS: usize = 16;

/// Weights rounded to bytes may add up to so much more or less than 1 for every two joints beyond the first two. The
/// validator's number.
const WEIGHT_ROUNDING: f64 = 0.003_921_6;

impl InfluenceChecker<'_> {
    fn check_influences(&self, named: &Map<String, Value>) {
        let mut sets = Vec::new();
        while let (true, Some(joints), Some(weights)) = (
            sets.len() < MAX_SETS,
            named.get(&format!("JOINTS_{}", sets.len())),
            named.get(&format!("WEIGHTS_{}", sets.len())),
        ) {
            let (Some(joints), Some(weights)) = (self.read_vec4s(joints), self.read_vec4s(weights))
            else {
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
        let mut faults = [[0_u64; 4]; MAX_SETS];
        for vertex in 0..count.unwrap_or(0) {
            self.check_vertex(&sets, vertex, &mut faults);
        }
        let words: [(&DiagnosticCode, &str, &str); 4] = [
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
                    self.document.diagnostics.add(
                        code,
                        pointer,
                        format_args!("{what} (how many: {count})"),
                    );
                }
            }
        }
    }

    /// The four numbers of every vertex.
    fn read_vec4s(&self, accessor: &Value) -> Option<Vec<[f32; 4]>> {
        let at = usize::try_from(as_whole_number(accessor)?).ok()?;
        let accessor = self.document.root_array("accessors").get(at)?;
        let layout = AccessorLayout::from_accessor(accessor)
            .filter(|layout| layout.element_type.component_count() == 4)?;
        let elements: AccessorElements<'_> = self.store.accessor_elements(accessor, layout)?;
        let pointer = format!("/accessors/{at}/count");
        // Only what has bytes is worth the memory.
        layout.buffer_view.filter(|_| integer_member(accessor, "count").is_some())?;
        self.store.charge_budget(&pointer, layout.count.saturating_mul(16)).then_some(())?;
        let mut all = Vec::new();
        elements.for_each_element(|_, numbers| {
            let number = |at: usize| elements.dequantize(numbers[at]) as f32;
            all.push([number(0), number(1), number(2), number(3)]);
        });
        Some(all)
    }

    fn check_vertex(
        &self,
        sets: &[InfluenceSet],
        vertex: usize,
        faults: &mut [[u64; 4]; MAX_SETS],
    ) {
        let mut known = [0.0_f32; 4 * MAX_SETS];
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
            WEIGHT_ROUNDING * (number.div_ceil(2).saturating_sub(1)) as f64 + 2e-7 * number as f64;
        if (sum - 1.0).abs() > allowed {
            (0..sets.len()).for_each(|set| faults[set][3] += 1);
        }
    }
}
