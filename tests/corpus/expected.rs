//! What is refused of the shared models, and why; all others are drawn. And which pictures show nothing, and why.
//!
//! A change that refuses one more fails the test, and so does one that draws what stands here: then the line goes.

use crate::manifest::Row;
use crate::verdict::Verdict;

/// Models by the name of their folder, with a part of the reason.
const REFUSED: &[(&str, &str)] = &[
    ("acme-box-unknown-required-extension", "ACME_gizmo"),
    ("animation-only-jump-flip", "nothing to draw"),
    ("blender-empty-scene", "nothing to draw"),
    ("empty-nodes", "nothing to draw"),
    ("scene-without-nodes", "nothing to draw"),
];

/// Files outside of `models` whose pictures show nothing, with the reason.
const BLANK: &[(&str, &str)] = &[
    ("ZeroLengthBufferView.gltf", "one corner is two thousand million units away"),
    ("ignored_local_transform.gltf", "the corners of its triangle are one point"),
    ("node/valid.gltf", "the corners of its triangle are one point"),
    ("node_skin_without_skinned_mesh.gltf", "the corners of its triangle are one point"),
    ("node_skinned_mesh_without_skin.gltf", "the corners of its triangle are one point"),
    ("node_weights_invalid.gltf", "the corners of its triangle are one point"),
    ("non_sparse_accessor_without_buffer_view.gltf", "its indices are zeros"),
    ("one_face_123_mirror.gltf", "its triangle is seen from behind"),
    ("skin-shared.gltf", "its meshes have one vertex each"),
];

/// Models whose meshes are shown many times by one node, with the number of triangles: the manifest counts each node once.
const INSTANCED: &[(&str, usize)] =
    &[("blender-gpu-instancing", 4_032 * (958 + 941) + 2), ("simple-instancing", 12 * 125)];

/// How many triangles the scene of a model has.
pub fn expected_triangles(row: &Row) -> Option<usize> {
    let folder = row.path.strip_prefix("models/")?.split('/').next()?;
    let instanced = INSTANCED.iter().find(|(name, _)| *name == folder);
    instanced.map(|(_, triangles)| *triangles).or(row.scene_triangles)
}

/// Why a model is to be refused, if it is.
pub fn expected_refusal(row: &Row) -> Option<&'static str> {
    let folder = row.path.strip_prefix("models/")?.split('/').next()?;
    REFUSED.iter().find(|(name, _)| *name == folder).map(|(_, reason)| *reason)
}

/// How a verdict differs from what is expected; outside of `models` every refusal is.
pub fn difference_from_expected(row: &Row, verdict: &Verdict) -> Option<String> {
    if matches!(verdict, Verdict::Blank) && !BLANK.iter().any(|(end, _)| row.path.ends_with(end)) {
        return Some("nothing is to be seen in the picture".to_owned());
    }
    if row.group() != "models" {
        return None;
    }
    match (expected_refusal(row), verdict) {
        (None, Verdict::Refused(reason)) => Some(format!("refused: {reason}")),
        (Some(expected), Verdict::Refused(reason)) if !reason.contains(expected) => {
            Some(format!("refused, and not because of {expected}: {reason}"))
        }
        (Some(expected), Verdict::Drawn | Verdict::Blank) => {
            Some(format!("drawn, and was to be refused: {expected}"))
        }
        _ => None,
    }
}
