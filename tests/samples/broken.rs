//! Documents in which one member of a valid file is changed or removed, with the errors that the
//! Khronos validator reports.

use super::{Sample, add_floats, add_times, quad, textured_quad, triangle};
use crate::gltf::Document;
use serde_json::{Value, json};

/// Returns all broken documents as binary files.
pub(super) fn broken_samples() -> Vec<Sample> {
    let mut samples = changed_members();
    samples.extend(wrong_values());
    samples.extend(broken_animations());
    samples
}

fn sample(name: &str, document: &Document, errors: &[&str]) -> Sample {
    Sample::broken(name, "model.glb", document.to_glb(), errors)
}

/// A name, the JSON pointer of a member, its new value, and the error that this value causes.
type Change = (&'static str, &'static str, &'static str, &'static str);

/// Changes to a triangle.
const TRIANGLE_CHANGES: &[Change] = &[
    ("asset-version-is-a-number", "/asset/version", "2", "TYPE_MISMATCH"),
    ("no-such-scene", "/scene", "3", "UNRESOLVED_REFERENCE"),
    ("negative-scene", "/scene", "-1", "INVALID_INDEX"),
    ("empty-list-of-nodes", "/scenes/0/nodes", "[]", "EMPTY_ENTITY"),
    ("duplicate-node", "/scenes/0/nodes", "[0, 0]", "DUPLICATE_ELEMENTS"),
    ("no-such-mesh", "/nodes/0/mesh", "7", "UNRESOLVED_REFERENCE"),
    ("no-such-child", "/nodes/0/children", "[5]", "UNRESOLVED_REFERENCE"),
    ("node-is-its-own-child", "/nodes/0/children", "[0]", "NODE_LOOP"),
    ("rotation-not-normalized", "/nodes/0/rotation", "[0, 0, 0.5, 0.5]", "ROTATION_NON_UNIT"),
    ("rotation-out-of-range", "/nodes/0/rotation", "[0, 0, 0, 2]", "VALUE_NOT_IN_RANGE"),
    (
        "matrix-of-15-numbers",
        "/nodes/0/matrix",
        "[0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0]",
        "ARRAY_LENGTH_NOT_IN_LIST",
    ),
    (
        "singular-matrix",
        "/nodes/0/matrix",
        "[0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0]",
        "NODE_MATRIX_NON_TRS",
    ),
    ("scale-is-text", "/nodes/0/scale", r#"["a", 1, 1]"#, "ARRAY_TYPE_MISMATCH"),
    ("no-such-accessor", "/meshes/0/primitives/0/indices", "9", "UNRESOLVED_REFERENCE"),
    ("no-primitives", "/meshes/0/primitives", "[]", "EMPTY_ENTITY"),
    ("no-such-mode", "/meshes/0/primitives/0/mode", "7", "VALUE_NOT_IN_RANGE"),
    ("no-such-material", "/meshes/0/primitives/0/material", "0", "UNRESOLVED_REFERENCE"),
    (
        "attribute-without-a-name",
        "/meshes/0/primitives/0/attributes/FOO",
        "0",
        "MESH_PRIMITIVE_INVALID_ATTRIBUTE",
    ),
    (
        "indices-as-positions",
        "/meshes/0/primitives/0/attributes/POSITION",
        "1",
        "MESH_PRIMITIVE_ATTRIBUTES_ACCESSOR_INVALID_FORMAT",
    ),
    (
        "positions-as-indices",
        "/meshes/0/primitives/0/indices",
        "0",
        "MESH_PRIMITIVE_INDICES_ACCESSOR_INVALID_FORMAT",
    ),
    ("accessor-too-long", "/accessors/0/count", "30", "ACCESSOR_TOO_LONG"),
    ("accessor-of-no-elements", "/accessors/0/count", "0", "VALUE_NOT_IN_RANGE"),
    ("accessor-of-a-huge-count", "/accessors/0/count", "4000000000", "ACCESSOR_TOO_LONG"),
    ("accessor-unaligned", "/accessors/1/byteOffset", "1", "ACCESSOR_OFFSET_ALIGNMENT"),
    ("wrong-minimum", "/accessors/0/min", "[-1, 0, 0]", "ACCESSOR_MIN_MISMATCH"),
    ("wrong-maximum", "/accessors/0/max", "[9, 1, 0]", "ACCESSOR_MAX_MISMATCH"),
    ("view-beyond-the-buffer", "/bufferViews/0/byteLength", "5000", "BUFFER_VIEW_TOO_LONG"),
    ("view-of-no-buffer", "/bufferViews/0/buffer", "2", "UNRESOLVED_REFERENCE"),
    ("stride-of-5", "/bufferViews/0/byteStride", "5", "VALUE_MULTIPLE_OF"),
    ("buffer-shorter-than-stated", "/buffers/0/byteLength", "4000", "BUFFER_BYTE_LENGTH_MISMATCH"),
];

/// Changes to a textured quad.
const QUAD_CHANGES: &[Change] = &[
    ("alpha-cutoff-is-negative", "/materials/0/alphaCutoff", "-1", "VALUE_NOT_IN_RANGE"),
    (
        "metallic-above-1",
        "/materials/0/pbrMetallicRoughness/metallicFactor",
        "2",
        "VALUE_NOT_IN_RANGE",
    ),
    (
        "base-color-of-3-numbers",
        "/materials/0/pbrMetallicRoughness/baseColorFactor",
        "[1, 1, 1]",
        "ARRAY_LENGTH_NOT_IN_LIST",
    ),
    (
        "no-such-texture",
        "/materials/0/pbrMetallicRoughness/baseColorTexture/index",
        "4",
        "UNRESOLVED_REFERENCE",
    ),
    ("no-such-image", "/textures/0/source", "3", "UNRESOLVED_REFERENCE"),
    ("image-of-two-sources", "/images/0/uri", r#""a.png""#, "ONE_OF_MISMATCH"),
    ("image-without-its-type", "/images/0", r#"{"bufferView": 4}"#, "UNSATISFIED_DEPENDENCY"),
    ("image-of-another-type", "/images/0/mimeType", r#""image/jpeg""#, "IMAGE_MIME_TYPE_INVALID"),
];

/// Returns files in which one member of a valid file is changed.
fn changed_members() -> Vec<Sample> {
    let material =
        json!({"alphaMode": "MASK", "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}});
    let (triangle, quad) = (triangle(), textured_quad(&material));
    let change = |base: &Document, (name, pointer, text, error): Change| {
        let value = serde_json::from_str(text).expect("the table holds JSON");
        sample(name, &base.clone().with_value(pointer, value), &[error])
    };
    let triangles = TRIANGLE_CHANGES.iter().map(|case| change(&triangle, *case));
    triangles.chain(QUAD_CHANGES.iter().map(|case| change(&quad, *case))).collect()
}

/// Returns files whose vertex data or extensions contradict the document.
fn wrong_values() -> Vec<Sample> {
    let mut far_index = triangle();
    let start = far_index.bytes.len() - 8;
    far_index.bytes[start..start + 2].copy_from_slice(&[99, 0]);
    let mut not_a_number = triangle();
    not_a_number.bytes[..4].copy_from_slice(&f32::NAN.to_le_bytes());
    let mut long_normals = quad();
    let normals = add_floats(&mut long_normals, "VEC3", &[0.0, 0.0, 3.0].repeat(4));
    let long_normals =
        long_normals.with_value("/meshes/0/primitives/0/attributes/NORMAL", json!(normals));
    let mut few_normals = quad();
    let normals = add_floats(&mut few_normals, "VEC3", &[0.0, 0.0, 1.0].repeat(3));
    let few_normals =
        few_normals.with_value("/meshes/0/primitives/0/attributes/NORMAL", json!(normals));
    let mut cut_picture = textured_quad(&json!({}));
    let view = cut_picture.add_buffer_view(&crate::gltf::encode_png(4, 4)[..20]);
    let cut_picture = cut_picture.with_value("/images/0/bufferView", json!(view));
    let two_parents = triangle()
        .with_value("/nodes", json!([{"children": [2]}, {"children": [2]}, {"mesh": 0}]))
        .with_value("/scenes/0/nodes", json!([0, 1]));
    let child_as_root = triangle()
        .with_value("/nodes", json!([{"children": [1]}, {"mesh": 0}]))
        .with_value("/scenes/0/nodes", json!([0, 1]));
    let undeclared = triangle()
        .with_value("/materials", json!([{"extensions": {"KHR_materials_unlit": {}}}]))
        .with_value("/meshes/0/primitives/0/material", json!(0));
    let mut required = triangle();
    for list in ["extensionsUsed", "extensionsRequired"] {
        required.json[list] = json!(["VENDOR_unknown"]);
    }
    let lens = json!([{"type": "perspective", "perspective": {"yfov": 1, "znear": 5, "zfar": 1}}]);
    vec![
        sample("index-beyond-the-vertices", &far_index, &["ACCESSOR_INDEX_OOB"]),
        sample("position-is-not-a-number", &not_a_number, &["ACCESSOR_INVALID_FLOAT"]),
        sample("normals-of-length-3", &long_normals, &["ACCESSOR_VECTOR3_NON_UNIT"]),
        sample("too-few-normals", &few_normals, &["MESH_PRIMITIVE_UNEQUAL_ACCESSOR_COUNT"]),
        sample("picture-cut-off", &cut_picture, &["IMAGE_UNEXPECTED_EOS"]),
        sample("node-of-two-parents", &two_parents, &["NODE_PARENT_OVERRIDE"]),
        sample("child-as-a-root", &child_as_root, &["SCENE_NON_ROOT_NODE"]),
        sample("undeclared-extension", &undeclared, &["UNDECLARED_EXTENSION"]),
        sample("unknown-required-extension", &required, &["UNSUPPORTED_REQUIRED_EXTENSION"])
            .expect("VENDOR_unknown"),
        sample(
            "far-plane-before-the-near-one",
            &triangle().with_value("/cameras", lens),
            &["CAMERA_ZFAR_LEQUAL_ZNEAR"],
        ),
        sample(
            "positions-without-bounds",
            &Document::single_triangle(),
            &["MESH_PRIMITIVE_POSITION_ACCESSOR_WITHOUT_BOUNDS"],
        ),
    ]
}

/// Returns animations of a node's translation whose sampler or target is wrong.
fn broken_animations() -> Vec<Sample> {
    let animated = |times: &[f32], shape: &str, values: &[f32], target: Value| {
        let mut document = triangle();
        let times = add_times(&mut document, times);
        let values = add_floats(&mut document, shape, values);
        document.with_value(
            "/animations",
            json!([{"samplers": [{"input": times, "output": values}],
                "channels": [{"sampler": 0, "target": target}]}]),
        )
    };
    let translation = json!({"node": 0, "path": "translation"});
    vec![
        sample(
            "animation-of-falling-times",
            &animated(&[1.0, 0.5], "VEC3", &[0.0; 6], translation.clone()),
            &["ACCESSOR_ANIMATION_INPUT_NON_INCREASING"],
        ),
        sample(
            "animation-before-time-0",
            &animated(&[-1.0, 0.5], "VEC3", &[0.0; 6], translation.clone()),
            &["ACCESSOR_ANIMATION_INPUT_NEGATIVE"],
        ),
        sample(
            "animation-of-too-few-values",
            &animated(&[0.0, 1.0], "VEC3", &[0.0; 3], translation.clone()),
            &["ANIMATION_SAMPLER_OUTPUT_ACCESSOR_INVALID_COUNT"],
        ),
        sample(
            "translation-of-4-numbers",
            &animated(&[0.0, 1.0], "VEC4", &[0.0; 8], translation),
            &["ANIMATION_SAMPLER_OUTPUT_ACCESSOR_INVALID_FORMAT"],
        ),
        sample(
            "animation-of-weights-without-targets",
            &animated(&[0.0, 1.0], "SCALAR", &[0.0; 2], json!({"node": 0, "path": "weights"})),
            &["ANIMATION_CHANNEL_TARGET_NODE_WEIGHTS_NO_MORPHS"],
        ),
    ]
}
