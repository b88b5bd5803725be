//! Diagnostic codes with their names, severities and help texts.
//!
//! Names and severities match the Khronos glTF validator 2.0 (its `ISSUES.md`) for every issue that
//! it defines; its severities "information" and "hint" are notes here. The other codes are our own:
//! they report how the loader treats the file.

use model::Severity;

/// A kind of diagnostic.
#[derive(Debug)]
pub(super) struct DiagnosticCode {
    /// The code, such as `ACCESSOR_TOO_LONG`.
    pub(super) name: &'static str,
    /// The severity of every diagnostic with this code.
    pub(super) severity: Severity,
    /// The suggested fix, in the imperative.
    pub(super) remedy: &'static str,
}

/// Declares a constant for each code from lists of names that share a severity and a help text.
macro_rules! codes {
    ($($severity:ident { $($remedy:literal => $($name:ident)*;)* })*) => {$($($(
        pub(super) const $name: DiagnosticCode =
            DiagnosticCode { name: stringify!($name), severity: Severity::$severity, remedy: $remedy };
    )*)*)*};
}

codes! {
    Error {
        "export the file again, or use another exporter" =>
            ARRAY_LENGTH_NOT_IN_LIST ARRAY_TYPE_MISMATCH DUPLICATE_ELEMENTS EMPTY_ENTITY INVALID_INDEX
            ONE_OF_MISMATCH PATTERN_MISMATCH TYPE_MISMATCH UNDEFINED_PROPERTY UNSATISFIED_DEPENDENCY
            VALUE_MULTIPLE_OF VALUE_NOT_IN_RANGE UNRESOLVED_REFERENCE
            ACCESSOR_MATRIX_ALIGNMENT ACCESSOR_NORMALIZED_INVALID ACCESSOR_OFFSET_ALIGNMENT
            ACCESSOR_SMALL_BYTESTRIDE ACCESSOR_SPARSE_COUNT_OUT_OF_RANGE ACCESSOR_SPARSE_INDEX_OOB
            ACCESSOR_SPARSE_INDICES_NON_INCREASING ACCESSOR_TOO_LONG ACCESSOR_TOTAL_OFFSET_ALIGNMENT
            ACCESSOR_USAGE_OVERRIDE BUFFER_VIEW_INVALID_BYTE_STRIDE BUFFER_VIEW_TARGET_OVERRIDE
            BUFFER_VIEW_TOO_BIG_BYTE_STRIDE BUFFER_VIEW_TOO_LONG
            ANIMATION_CHANNEL_TARGET_NODE_WEIGHTS_NO_MORPHS ANIMATION_DUPLICATE_TARGETS
            ANIMATION_SAMPLER_ACCESSOR_WITH_BYTESTRIDE ANIMATION_SAMPLER_INPUT_ACCESSOR_INVALID_FORMAT
            ANIMATION_SAMPLER_INPUT_ACCESSOR_TOO_FEW_ELEMENTS
            ANIMATION_SAMPLER_OUTPUT_ACCESSOR_INVALID_COUNT
            ANIMATION_SAMPLER_OUTPUT_ACCESSOR_INVALID_FORMAT
            ACCESSOR_ANIMATION_INPUT_NEGATIVE ACCESSOR_ANIMATION_INPUT_NON_INCREASING
            KHR_ANIMATION_POINTER_ANIMATION_CHANNEL_TARGET_NODE
            KHR_ANIMATION_POINTER_ANIMATION_CHANNEL_TARGET_PATH
            IMAGE_BUFFER_VIEW_WITH_BYTESTRIDE SKIN_IBM_ACCESSOR_WITH_BYTESTRIDE SKIN_IBM_INVALID_FORMAT
            INVALID_IBM_ACCESSOR_COUNT ACCESSOR_INVALID_IBM
            KHR_MATERIALS_VARIANTS_NON_UNIQUE_VARIANT MESH_INVALID_WEIGHTS_COUNT NODE_WEIGHTS_INVALID
            MESH_PRIMITIVES_UNEQUAL_TARGETS_COUNT MESH_PRIMITIVE_ACCESSOR_UNALIGNED
            MESH_PRIMITIVE_ACCESSOR_WITHOUT_BYTESTRIDE
            MESH_PRIMITIVE_ATTRIBUTES_ACCESSOR_INVALID_FORMAT
            MESH_PRIMITIVE_ATTRIBUTES_ACCESSOR_UNSIGNED_INT MESH_PRIMITIVE_INDEXED_SEMANTIC_CONTINUITY
            MESH_PRIMITIVE_INDICES_ACCESSOR_INVALID_FORMAT
            MESH_PRIMITIVE_INDICES_ACCESSOR_WITH_BYTESTRIDE MESH_PRIMITIVE_JOINTS_WEIGHTS_MISMATCH
            MESH_PRIMITIVE_MORPH_TARGET_INVALID_ATTRIBUTE_COUNT MESH_PRIMITIVE_UNEQUAL_ACCESSOR_COUNT
            ACCESSOR_INDEX_OOB ACCESSOR_INDEX_PRIMITIVE_RESTART ACCESSOR_INVALID_FLOAT
            ACCESSOR_JOINTS_INDEX_DUPLICATE ACCESSOR_JOINTS_INDEX_OOB ACCESSOR_WEIGHTS_NEGATIVE;
        "write the actual bounds" =>
            ACCESSOR_MIN_MISMATCH ACCESSOR_MAX_MISMATCH ACCESSOR_ELEMENT_OUT_OF_MIN_BOUND
            ACCESSOR_ELEMENT_OUT_OF_MAX_BOUND MESH_PRIMITIVE_POSITION_ACCESSOR_WITHOUT_BOUNDS
            ANIMATION_SAMPLER_INPUT_ACCESSOR_WITHOUT_BOUNDS;
        "normalize the values before exporting" =>
            ACCESSOR_VECTOR3_NON_UNIT ROTATION_NON_UNIT ACCESSOR_WEIGHTS_NON_NORMALIZED
            ACCESSOR_ANIMATION_SAMPLER_OUTPUT_NON_NORMALIZED_QUATERNION;
        "clamp the values to the valid range" => ACCESSOR_NON_CLAMPED;
        "set the signs to 1 or -1" => ACCESSOR_INVALID_SIGN;
        "correct the JSON, or export the file again" => INVALID_JSON;
        "copy the file next to the model and refer to it by a relative path" => IO_ERROR;
        "use a relative path with / between folders and %20 for spaces, or a valid data URI" =>
            INVALID_URI;
        "start the URI with data:application/octet-stream;base64," =>
            BUFFER_DATA_URI_MIME_TYPE_INVALID;
        "copy or export the file again: it is truncated or was assembled incorrectly" =>
            BUFFER_BYTE_LENGTH_MISMATCH BUFFER_MISSING_GLB_DATA
            GLB_CHUNK_LENGTH_UNALIGNED GLB_DUPLICATE_CHUNK GLB_EMPTY_CHUNK
            GLB_LENGTH_MISMATCH GLB_LENGTH_TOO_SMALL GLB_UNEXPECTED_BIN_CHUNK
            GLB_UNEXPECTED_END_OF_CHUNK_DATA GLB_UNEXPECTED_END_OF_CHUNK_HEADER
            GLB_UNEXPECTED_END_OF_HEADER GLB_UNEXPECTED_FIRST_CHUNK;
        "convert the file to glTF 2.0" =>
            GLB_INVALID_VERSION UNKNOWN_ASSET_MAJOR_VERSION ASSET_MIN_VERSION_GREATER_THAN_VERSION;
        "make zfar larger than znear" => CAMERA_ZFAR_LEQUAL_ZNEAR;
        "set xmag and ymag to half the width and height of the view" => CAMERA_XMAG_YMAG_ZERO;
        "declare the actual format of the image" => IMAGE_MIME_TYPE_INVALID;
        "use an image format that is allowed here" => TEXTURE_INVALID_IMAGE_MIME_TYPE;
        "list the extension in extensionsUsed" => IMAGE_NON_ENABLED_MIME_TYPE;
        "save the image again" => IMAGE_DATA_INVALID IMAGE_UNEXPECTED_EOS;
        "make outerConeAngle larger than innerConeAngle" => KHR_LIGHTS_PUNCTUAL_LIGHT_SPOT_ANGLES;
        "add the attribute to the base mesh, or remove it from the target" =>
            MESH_PRIMITIVE_MORPH_TARGET_NO_BASE_ACCESSOR;
        "use a name from the specification, or start a custom name with _" =>
            MESH_PRIMITIVE_INVALID_ATTRIBUTE;
        "export the mesh with tangents" => MESH_PRIMITIVE_NO_TANGENT_SPACE;
        "export the mesh with as many sets of texture coordinates as its material uses" =>
            MESH_PRIMITIVE_TOO_FEW_TEXCOORDS;
        "give every node at most one parent, and remove cycles" => NODE_LOOP NODE_PARENT_OVERRIDE;
        "list only nodes without a parent" => SCENE_NON_ROOT_NODE;
        "use translation, rotation and scale instead of the matrix" =>
            NODE_MATRIX_NON_TRS NODE_MATRIX_TRS ANIMATION_CHANNEL_TARGET_NODE_MATRIX;
        "add JOINTS_0 and WEIGHTS_0 to the mesh, or remove the skin" => NODE_SKIN_WITH_NON_SKINNED_MESH;
        "put all joints below a common root node" => SKIN_NO_COMMON_ROOT SKIN_SKELETON_INVALID;
        "list it in extensionsUsed" => UNDECLARED_EXTENSION UNUSED_EXTENSION_REQUIRED;
        "move it to the object that the extension's specification names" => UNEXPECTED_EXTENSION_OBJECT;
        "export the file without it, or load the rest with --lenient" =>
            UNSUPPORTED_REQUIRED_EXTENSION;
        "use a .gltf or .glb file" => NOT_GLTF;
        "use a .gltf, .glb, .stl, .obj, .ply or .3mf file" => UNKNOWN_FORMAT;
        "convert the file to plain glTF 2.0" => UNSUPPORTED_VERSION;
        "raise the limit if you trust the file" => LIMIT_EXCEEDED;
        "export the file again" => NOT_LOADED;
    }
    Warning {
        "check the spelling" => UNEXPECTED_PROPERTY;
        "use one of these values" => VALUE_NOT_IN_LIST;
        "use relative paths, which remain valid when the folder is moved" => NON_RELATIVE_URI;
        "no action needed: the file is read as glTF 2.0" => UNKNOWN_ASSET_MINOR_VERSION;
        "use a positive number" => CAMERA_XMAG_YMAG_NEGATIVE;
        "use an angle less than pi" => CAMERA_YFOV_GEQUAL_PI;
        "use alphaMode MASK, or remove alphaCutoff" => MATERIAL_ALPHA_CUTOFF_INVALID_MODE;
        "export the mesh with tangents" => MESH_PRIMITIVE_GENERATED_TANGENT_SPACE;
        "check the number of vertices or indices" => MESH_PRIMITIVE_INCOMPATIBLE_MODE;
        "export the mesh with positions" => MESH_PRIMITIVE_NO_POSITION;
        "export the mesh with normals" => MESH_PRIMITIVE_TANGENT_WITHOUT_NORMAL;
        "store the data in the binary chunk" => DATA_URI_GLB;
        "reduce the padding to fewer than four bytes" => BUFFER_GLB_CHUNK_TOO_BIG;
        "no action needed: the data is ignored" => GLB_UNKNOWN_CHUNK_TYPE GLB_EXTRA_DATA;
        "give the node a skin" => NODE_SKINNED_MESH_WITHOUT_SKIN;
        "save it as PNG or JPEG" => IMAGE_UNRECOGNIZED_FORMAT;
        "export the file again if something is missing from the picture" => LEFT_OUT;
        "no action needed, unless the picture looks wrong" => NOT_SHOWN;
    }
    Info {
        "rename it" => MISLEADING_NAME;
        "remove it" => NODE_EMPTY NODE_MATRIX_DEFAULT UNUSED_OBJECT;
        "remove the triangles" => ACCESSOR_INDEX_TRIANGLE_DEGENERATE;
        "no action needed: unsupported extensions are not validated" => UNSUPPORTED_EXTENSION;
    }
}
