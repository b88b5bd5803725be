//! Expected outcomes of the files in `shared/assets`: rejected models and blank pictures. All other
//! files are drawn.
//!
//! The test fails if a model that is not listed here is rejected. It also fails if a listed model
//! is drawn; in that case, remove its row.

use crate::corpus::verdict::Verdict;
use alberti_tests::manifest::Row;

/// Rejected models by folder name, with part of the reason.
const REFUSED: &[(&str, &str)] = &[
    ("acme-box-unknown-required-extension", "ACME_gizmo"),
    ("animation-only-jump-flip", "nothing to draw"),
    ("blender-empty-scene", "nothing to draw"),
    ("empty-nodes", "nothing to draw"),
    ("scene-without-nodes", "nothing to draw"),
];

/// Files outside `models` with blank pictures, with the reason.
const BLANK: &[(&str, &str)] = &[
    ("ZeroLengthBufferView.gltf", "a vertex is two billion units away"),
    ("ignored_local_transform.gltf", "its triangle is degenerate"),
    ("node/valid.gltf", "its triangle is degenerate"),
    ("node_skin_without_skinned_mesh.gltf", "its triangle is degenerate"),
    ("node_skinned_mesh_without_skin.gltf", "its triangle is degenerate"),
    ("node_weights_invalid.gltf", "its triangle is degenerate"),
    ("non_sparse_accessor_without_buffer_view.gltf", "all indices are 0"),
    ("one_face_123_mirror.gltf", "its triangle is back-facing"),
    ("skin-shared.gltf", "its meshes have one vertex each"),
];

/// The triangle counts of models with EXT_mesh_gpu_instancing. They are listed because the manifest
/// counts each node once.
const INSTANCED: &[(&str, usize)] =
    &[("blender-gpu-instancing", 4_032 * (958 + 941) + 2), ("simple-instancing", 12 * 125)];

/// Returns the number of triangles in the scene of a model.
pub fn expected_triangles(row: &Row) -> Option<usize> {
    let folder = row.path.strip_prefix("models/")?.split('/').next()?;
    let instanced = INSTANCED.iter().find(|(name, _)| *name == folder);
    instanced.map(|(_, triangles)| *triangles).or(row.scene_triangles)
}

/// Returns the reason why a model must be rejected.
pub fn expected_refusal(row: &Row) -> Option<&'static str> {
    let folder = row.path.strip_prefix("models/")?.split('/').next()?;
    REFUSED.iter().find(|(name, _)| *name == folder).map(|(_, reason)| *reason)
}

/// Returns the difference between a verdict and the manifest column `expected`.
pub fn difference_from_manifest(row: &Row, verdict: &Verdict) -> Option<String> {
    let expected = row.expected.as_deref()?;
    let (agrees, actual) = match verdict {
        Verdict::Drawn => (expected == "drawn", "drawn"),
        Verdict::Blank => (expected == "blank", "blank"),
        Verdict::Refused(reason) | Verdict::Broken(reason) => {
            (reason.contains(expected), reason.as_str())
        }
    };
    (!agrees).then(|| format!("expected {expected}, actual {actual}"))
}

/// Returns the difference between a verdict and the tables. Outside `models`, every rejection is
/// expected.
pub fn difference_from_tables(row: &Row, verdict: &Verdict) -> Option<String> {
    if matches!(verdict, Verdict::Blank) && !BLANK.iter().any(|(end, _)| row.path.ends_with(end)) {
        return Some("the picture is blank".to_owned());
    }
    if row.group() != "models" {
        return None;
    }
    match (expected_refusal(row), verdict) {
        (None, Verdict::Refused(reason)) => Some(format!("refused: {reason}")),
        (Some(expected), Verdict::Refused(reason)) if !reason.contains(expected) => {
            Some(format!("rejected, but not because of {expected}: {reason}"))
        }
        (Some(expected), Verdict::Drawn | Verdict::Blank) => {
            Some(format!("drawn, but must be rejected: {expected}"))
        }
        _ => None,
    }
}
