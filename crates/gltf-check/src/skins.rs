//! Validation of skins: joints, inverse bind matrices, and vertex weights (glTF 2.0 §3.7.3).

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

/// Validates all skins, and records rules for the elements of their accessors.
///
/// [`check_skinned_meshes`] validates the joint weights of vertices later, because that requires
/// both a mesh and a skin.
///
/// Invalid indices in `joints` are skipped, because the schema walk has reported them. They still
/// count toward the required number of inverse bind matrices, which correspond to joints by
/// position.
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

/// Validates that the joints have a common root, and that `skeleton` is a common ancestor.
///
/// Each check takes constant time per joint, because the tree stores the root and the traversal
/// interval of each node. Walking up from each joint would take quadratic time for a long chain.
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
        let message = "the joints have no common root node";
        diagnostics.add(&codes::SKIN_NO_COMMON_ROOT, format_args!("{pointer}/joints"), message);
    }
    let skeleton = index_member(skin, "skeleton").filter(|&node| node < tree.parents.len());
    if let Some(node) = skeleton
        && !joints.iter().all(|&joint| tree.is_at_or_below(joint, node))
    {
        let message = format_args!("node {node} is not a common ancestor of the joints");
        diagnostics.add(&codes::SKIN_SKELETON_INVALID, format_args!("{pointer}/skeleton"), message);
    }
}

/// Validates the inverse bind matrices: their format, their stride, and that there is at least one
/// per joint.
///
/// The format is always MAT4 of floats (glTF 2.0 §5.28). More matrices than joints are allowed. The
/// last row of each matrix is tested when the data is read.
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
        let message = "byteStride must not be set on the buffer view of inverse bind matrices";
        diagnostics.add(&codes::SKIN_IBM_ACCESSOR_WITH_BYTESTRIDE, &pointer, message);
    }
    let Some(layout) = AccessorLayout::from_accessor(accessor) else { return };
    if (layout.element_type, layout.component_type) == (MAT4, ComponentType::F32) {
        demands.add(at, ElementRule::Matrices, &pointer);
    } else {
        let message =
            format_args!("inverse bind matrices cannot have the format {}", layout.format_name());
        diagnostics.add(&codes::SKIN_IBM_INVALID_FORMAT, &pointer, message);
    }
    if layout.count < joints as u64 {
        let message =
            format_args!("there are fewer matrices ({}) than joints ({joints})", layout.count);
        diagnostics.add(&codes::INVALID_IBM_ACCESSOR_COUNT, &pointer, message);
    }
}

/// Validates the joints and weights of all skinned meshes.
///
/// This runs after the accessors have been validated, so that only data in a valid format is
/// decoded.
///
/// The cost is linear in the number of vertices times the number of sets. A mesh without a skinned
/// node is skipped, because its joint indices refer to nothing.
pub(super) fn check_skinned_meshes(document: &CheckedDocument<'_>, store: &BufferStore<'_>) {
    // A mesh may be used with several skins; its joint indices must fit the smallest skin.
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

/// One set of joints and weights, with four of each per vertex.
///
/// Contains the components of `JOINTS_n` and the dequantized components of `WEIGHTS_n`.
type InfluenceSet = (Vec<[f32; 4]>, Vec<[f32; 4]>);

/// The context for validating one primitive's joints and weights.
struct InfluenceChecker<'a> {
    document: &'a CheckedDocument<'a>,
    store: &'a BufferStore<'a>,
    /// The number of joints of the skin.
    joints: usize,
    /// The JSON pointer to the attributes.
    pointer: String,
}

/// The maximum number of sets of joints and weights to validate.
///
/// Exporters write one or two sets, for four or eight influences. The maximum limits memory,
/// because the sum of the weights needs all sets of a primitive at once.
const MAX_SETS: usize = 16;

/// The tolerance for the sum of weights that are rounded to bytes, per two joints beyond the first
/// two (the Khronos validator's value).
///
/// It is 1/255: quantization to bytes changes each weight by at most half a step, so two joints can
/// change the sum by one step.
const WEIGHT_ROUNDING: f64 = 0.003_921_6;

impl InfluenceChecker<'_> {
    /// Validates all sets of joints and weights of a primitive together, because the weights of a
    /// vertex sum to 1 over all sets.
    ///
    /// Sets are read up to the first missing one. The four kinds of errors are counted per set, so
    /// that each kind gets one diagnostic per attribute.
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
            (
                &codes::ACCESSOR_JOINTS_INDEX_OOB,
                "JOINTS",
                "joint indices are out of range for the skin",
            ),
            (
                &codes::ACCESSOR_JOINTS_INDEX_DUPLICATE,
                "JOINTS",
                "joints influence a vertex more than once",
            ),
            (&codes::ACCESSOR_WEIGHTS_NEGATIVE, "WEIGHTS", "weights are negative"),
            (&codes::ACCESSOR_WEIGHTS_NON_NORMALIZED, "WEIGHTS", "vertex weights do not sum to 1"),
        ];
        for (set, counts) in faults.iter().enumerate() {
            for (count, (code, name, what)) in counts.iter().zip(words) {
                if *count > 0 {
                    let pointer = format_args!("{}/{name}_{set}", self.pointer);
                    self.document.diagnostics.add(
                        code,
                        pointer,
                        format_args!("{what} (count: {count})"),
                    );
                }
            }
        }
    }

    /// Decodes the four components of every vertex.
    ///
    /// Returns `None` if the accessor is invalid, which has been reported, or has no buffer view;
    /// the primitive is then not validated.
    fn read_vec4s(&self, accessor: &Value) -> Option<Vec<[f32; 4]>> {
        let at = usize::try_from(as_whole_number(accessor)?).ok()?;
        let accessor = self.document.root_array("accessors").get(at)?;
        let layout = AccessorLayout::from_accessor(accessor)
            .filter(|layout| layout.element_type.component_count() == 4)?;
        let elements: AccessorElements<'_> = self.store.accessor_elements(accessor, layout)?;
        let pointer = format!("/accessors/{at}/count");
        // An accessor without a buffer view is all zeros, so do not allocate for it.
        layout.buffer_view.filter(|_| integer_member(accessor, "count").is_some())?;
        self.store.charge_budget(&pointer, layout.count.saturating_mul(16)).then_some(())?;
        let mut all = Vec::new();
        elements.for_each_element(|_, numbers| {
            let number = |at: usize| elements.dequantize(numbers[at]) as f32;
            all.push([number(0), number(1), number(2), number(3)]);
        });
        Some(all)
    }

    /// Counts the violations of one vertex, by set and rule.
    ///
    /// A joint may influence a vertex only once, not counting joints with weight 0 (glTF 2.0
    /// §3.7.3.3).
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
        // The second term covers the rounding of a single-precision sum.
        let allowed =
            WEIGHT_ROUNDING * (number.div_ceil(2).saturating_sub(1)) as f64 + 2e-7 * number as f64;
        if (sum - 1.0).abs() > allowed {
            (0..sets.len()).for_each(|set| faults[set][3] += 1);
        }
    }
}
