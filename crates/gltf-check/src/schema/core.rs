//! Schema tables for the objects of core glTF 2.0 (§5, in the order of the specification).
//!
//! Each table is a static, so that tables can refer to each other in any order at no startup cost.
//! `extensions` and `extras` are not listed, because every object may have them.

use super::Collection::{
    Accessors, AnimationSamplers, BufferViews, Buffers, Cameras, Images, Materials, Meshes, Nodes,
    Samplers, Scenes, Skins, Textures,
};
use super::ValueKind::{
    Any, Attributes, Boolean, EnumInteger, EnumString, Index, Indices, Integer, Number, Numbers,
    Objects, Targets, Text, Texts, Version,
};
use super::{
    ANY, NOT_NEGATIVE, ObjectSchema, POSITIVE, SIGNED_UNIT, UNIT, excludes, one_of, optional,
    required, requires,
};

/// An integer without a maximum.
///
/// JSON does not limit integers; range checks and the loader's limits do.
const MAX_INTEGER: u64 = u64::MAX;
/// The optional name of an object. It need not be unique, because references use indices.
const NAME: super::MemberSchema = optional("name", Text);

/// Declares the schema of an object.
const fn object_schema(
    name: &'static str,
    members: &'static [super::MemberSchema],
) -> ObjectSchema {
    ObjectSchema { name, members }
}

/// Returns the value kind of a member that is an object.
const fn object_kind(object: &'static ObjectSchema) -> super::ValueKind {
    super::ValueKind::Object(object)
}

/// The root object (§5.17): the arrays of all objects, and the extension lists.
///
/// `extensionsRequired` requires `extensionsUsed`, and `scene` requires `scenes`.
pub(in super::super) static ROOT: ObjectSchema = object_schema(
    "glTF",
    &[
        optional("extensionsUsed", Texts),
        requires("extensionsRequired", "extensionsUsed", Texts),
        optional("accessors", Objects(&ACCESSOR)),
        optional("animations", Objects(&ANIMATION)),
        required("asset", object_kind(&ASSET)),
        optional("buffers", Objects(&BUFFER)),
        optional("bufferViews", Objects(&BUFFER_VIEW)),
        optional("cameras", Objects(&CAMERA)),
        optional("images", Objects(&IMAGE)),
        optional("materials", Objects(&MATERIAL)),
        optional("meshes", Objects(&MESH)),
        optional("nodes", Objects(&NODE)),
        optional("samplers", Objects(&SAMPLER)),
        requires("scene", "scenes", Index(Scenes)),
        optional("scenes", Objects(&SCENE)),
        optional("skins", Objects(&SKIN)),
        optional("textures", Objects(&TEXTURE)),
    ],
);

/// `accessor` (§5.1): a typed view into a buffer view; `byteOffset` requires `bufferView`.
///
/// `componentType` is an OpenGL constant: 5120 and 5121 are signed and unsigned bytes, 5122 and
/// 5123 are shorts, 5125 is an unsigned int, and 5126 is a float. glTF has no signed 32-bit
/// integer.
static ACCESSOR: ObjectSchema = object_schema(
    "accessor",
    &[
        optional("bufferView", Index(BufferViews)),
        requires("byteOffset", "bufferView", Integer(0, MAX_INTEGER)),
        required("componentType", EnumInteger(&[5120, 5121, 5122, 5123, 5125, 5126])),
        optional("normalized", Boolean),
        required("count", Integer(1, MAX_INTEGER)),
        required("type", EnumString(&["SCALAR", "VEC2", "VEC3", "VEC4", "MAT2", "MAT3", "MAT4"])),
        // The number of bounds depends on the element type; accessor validation checks it.
        optional("max", Numbers(0, ANY)),
        optional("min", Numbers(0, ANY)),
        optional("sparse", object_kind(&SPARSE)),
        NAME,
    ],
);

/// `accessor.sparse` (§5.2): elements that differ from the buffer view.
static SPARSE: ObjectSchema = object_schema(
    "sparse",
    &[
        required("count", Integer(1, MAX_INTEGER)),
        required("indices", object_kind(&SPARSE_INDICES)),
        required("values", object_kind(&SPARSE_VALUES)),
    ],
);

/// `accessor.sparse.indices` (§5.3): the indices of the replaced elements.
///
/// The component type must be unsigned: byte, short or int.
static SPARSE_INDICES: ObjectSchema = object_schema(
    "sparseIndices",
    &[
        required("bufferView", Index(BufferViews)),
        optional("byteOffset", Integer(0, MAX_INTEGER)),
        required("componentType", EnumInteger(&[5121, 5123, 5125])),
    ],
);

/// `accessor.sparse.values` (§5.4): the replacements.
static SPARSE_VALUES: ObjectSchema = object_schema(
    "sparseValues",
    &[required("bufferView", Index(BufferViews)), optional("byteOffset", Integer(0, MAX_INTEGER))],
);

/// `animation` (§5.5): channels, and the samplers they refer to.
static ANIMATION: ObjectSchema = object_schema(
    "animation",
    &[
        required("channels", Objects(&CHANNEL)),
        required("samplers", Objects(&ANIMATION_SAMPLER)),
        NAME,
    ],
);

/// `animation.channel` (§5.6): a sampler applied to a target.
static CHANNEL: ObjectSchema = object_schema(
    "channel",
    &[required("sampler", Index(AnimationSamplers)), required("target", object_kind(&TARGET))],
);

/// `animation.channel.target` (§5.7): a node and a path; KHR_animation_pointer omits the node.
static TARGET: ObjectSchema = object_schema(
    "target",
    &[
        optional("node", Index(Nodes)),
        required("path", EnumString(&["translation", "rotation", "scale", "weights", "pointer"])),
    ],
);

/// `animation.sampler` (§5.8): keyframe times, values and interpolation.
static ANIMATION_SAMPLER: ObjectSchema = object_schema(
    "animationSampler",
    &[
        required("input", Index(Accessors)),
        optional("interpolation", EnumString(&["LINEAR", "STEP", "CUBICSPLINE"])),
        required("output", Index(Accessors)),
    ],
);

/// `asset` (§5.9): the glTF version, and the generator of the file.
static ASSET: ObjectSchema = object_schema(
    "asset",
    &[
        optional("copyright", Text),
        optional("generator", Text),
        required("version", Version),
        optional("minVersion", Version),
    ],
);

/// `buffer` (§5.10): bytes in a file, a data URI or the binary chunk.
static BUFFER: ObjectSchema = object_schema(
    "buffer",
    &[optional("uri", Text), required("byteLength", Integer(1, MAX_INTEGER)), NAME],
);

/// `bufferView` (§5.11): a range of a buffer, with an optional stride of 4 to 252 bytes.
///
/// `target` is a hint for graphics APIs: 34962 is `ARRAY_BUFFER` for vertices, and 34963 is
/// `ELEMENT_ARRAY_BUFFER` for indices.
static BUFFER_VIEW: ObjectSchema = object_schema(
    "bufferView",
    &[
        required("buffer", Index(Buffers)),
        optional("byteOffset", Integer(0, MAX_INTEGER)),
        required("byteLength", Integer(1, MAX_INTEGER)),
        optional("byteStride", Integer(4, 252)),
        optional("target", EnumInteger(&[34_962, 34_963])),
        NAME,
    ],
);

/// `camera` (§5.12): perspective or orthographic, not both.
static CAMERA: ObjectSchema = object_schema(
    "camera",
    &[
        // The object named by `type` is required; camera validation checks this.
        excludes("orthographic", "perspective", object_kind(&ORTHOGRAPHIC)),
        optional("perspective", object_kind(&PERSPECTIVE)),
        required("type", EnumString(&["perspective", "orthographic"])),
        NAME,
    ],
);

/// `camera.orthographic` (§5.13): half the width and height of the view, and the near and far
/// planes.
///
/// `xmag` and `ymag` must not be 0, and should not be negative.
static ORTHOGRAPHIC: ObjectSchema = object_schema(
    "orthographic",
    &[
        required("xmag", Number(ANY)),
        required("ymag", Number(ANY)),
        required("zfar", Number(POSITIVE)),
        required("znear", Number(NOT_NEGATIVE)),
    ],
);

/// `camera.perspective` (§5.14): vertical field of view, aspect ratio, and near and far planes.
///
/// Without `zfar`, the projection is infinite; `yfov` is in radians and less than π.
static PERSPECTIVE: ObjectSchema = object_schema(
    "perspective",
    &[
        optional("aspectRatio", Number(POSITIVE)),
        required("yfov", Number(POSITIVE)),
        optional("zfar", Number(POSITIVE)),
        required("znear", Number(POSITIVE)),
    ],
);

/// `image` (§5.18): either a URI or a buffer view.
static IMAGE: ObjectSchema = object_schema(
    "image",
    &[
        one_of("uri", "bufferView", Text),
        optional("mimeType", Text),
        one_of("bufferView", "uri", Index(BufferViews)),
        NAME,
    ],
);

/// `material` (§5.19): textures and factors of the metallic-roughness model, alpha, and sidedness.
static MATERIAL: ObjectSchema = object_schema(
    "material",
    &[
        NAME,
        optional("pbrMetallicRoughness", object_kind(&METALLIC_ROUGHNESS)),
        optional("normalTexture", object_kind(&NORMAL_TEXTURE)),
        optional("occlusionTexture", object_kind(&OCCLUSION_TEXTURE)),
        optional("emissiveTexture", object_kind(&TEXTURE_INFO)),
        optional("emissiveFactor", Numbers(3, UNIT)),
        optional("alphaMode", EnumString(&["OPAQUE", "MASK", "BLEND"])),
        optional("alphaCutoff", Number(NOT_NEGATIVE)),
        optional("doubleSided", Boolean),
    ],
);

/// `material.pbrMetallicRoughness` (§5.22): base color, metalness and roughness.
static METALLIC_ROUGHNESS: ObjectSchema = object_schema(
    "pbrMetallicRoughness",
    &[
        optional("baseColorFactor", Numbers(4, UNIT)),
        optional("baseColorTexture", object_kind(&TEXTURE_INFO)),
        optional("metallicFactor", Number(UNIT)),
        optional("roughnessFactor", Number(UNIT)),
        optional("metallicRoughnessTexture", object_kind(&TEXTURE_INFO)),
    ],
);

/// `textureInfo` (§5.30): a texture, and the set of texture coordinates it uses.
pub(super) static TEXTURE_INFO: ObjectSchema = object_schema(
    "textureInfo",
    &[required("index", Index(Textures)), optional("texCoord", Integer(0, MAX_INTEGER))],
);

/// `material.normalTextureInfo` (§5.20): a normal map with a scale for x and y.
pub(super) static NORMAL_TEXTURE: ObjectSchema = object_schema(
    "textureInfo",
    &[
        required("index", Index(Textures)),
        optional("texCoord", Integer(0, MAX_INTEGER)),
        optional("scale", Number(ANY)),
    ],
);

/// `material.occlusionTextureInfo` (§5.21): an occlusion map with its strength.
///
/// The occlusion is in the red channel of the texture.
static OCCLUSION_TEXTURE: ObjectSchema = object_schema(
    "textureInfo",
    &[
        required("index", Index(Textures)),
        optional("texCoord", Integer(0, MAX_INTEGER)),
        optional("strength", Number(UNIT)),
    ],
);

/// `mesh` (§5.23): primitives, and default weights for their morph targets.
static MESH: ObjectSchema = object_schema(
    "mesh",
    &[required("primitives", Objects(&PRIMITIVE)), optional("weights", Numbers(0, ANY)), NAME],
);

/// `mesh.primitive` (§5.24): attributes, indices, material, mode and morph targets.
///
/// `mode` is the topology: points (0), lines (1), line loop (2), line strip (3), triangles (4),
/// triangle strip (5) or triangle fan (6).
static PRIMITIVE: ObjectSchema = object_schema(
    "primitive",
    &[
        required("attributes", Attributes),
        optional("indices", Index(Accessors)),
        optional("material", Index(Materials)),
        optional("mode", Integer(0, 6)),
        optional("targets", Targets),
    ],
);

/// `node` (§5.25): a transform with children and attached objects; a skin requires a mesh.
///
/// The matrix is in column-major order. A rotation is a unit quaternion in the order x, y, z, w.
static NODE: ObjectSchema = object_schema(
    "node",
    &[
        optional("camera", Index(Cameras)),
        optional("children", Indices(Nodes)),
        requires("skin", "mesh", Index(Skins)),
        optional("matrix", Numbers(16, ANY)),
        optional("mesh", Index(Meshes)),
        optional("rotation", Numbers(4, SIGNED_UNIT)),
        optional("scale", Numbers(3, ANY)),
        optional("translation", Numbers(3, ANY)),
        requires("weights", "mesh", Numbers(0, ANY)),
        NAME,
    ],
);

/// `sampler` (§5.26): filters and wrap modes, as OpenGL constants.
///
/// 9728 and 9729 are `NEAREST` and `LINEAR`; 9984 to 9987 combine them with mipmaps. 33071 is
/// `CLAMP_TO_EDGE`, 33648 is `MIRRORED_REPEAT`, and 10497 is `REPEAT`.
static SAMPLER: ObjectSchema = object_schema(
    "sampler",
    &[
        optional("magFilter", EnumInteger(&[9728, 9729])),
        optional("minFilter", EnumInteger(&[9728, 9729, 9984, 9985, 9986, 9987])),
        optional("wrapS", EnumInteger(&[33_071, 33_648, 10_497])),
        optional("wrapT", EnumInteger(&[33_071, 33_648, 10_497])),
        NAME,
    ],
);

/// `scene` (§5.27): the root nodes.
static SCENE: ObjectSchema = object_schema("scene", &[optional("nodes", Indices(Nodes)), NAME]);

/// `skin` (§5.28): joints, inverse bind matrices, and a common root.
///
/// `inverseBindMatrices` has one matrix per joint, in the order of `joints`; if it is absent, all
/// are the identity.
static SKIN: ObjectSchema = object_schema(
    "skin",
    &[
        optional("inverseBindMatrices", Index(Accessors)),
        optional("skeleton", Index(Nodes)),
        required("joints", Indices(Nodes)),
        NAME,
    ],
);

/// `texture` (§5.29): an image and a sampler.
static TEXTURE: ObjectSchema = object_schema(
    "texture",
    &[optional("sampler", Index(Samplers)), optional("source", Index(Images)), NAME],
);

/// An object whose members are not validated.
pub(super) const UNKNOWN: super::ValueKind = Any;
