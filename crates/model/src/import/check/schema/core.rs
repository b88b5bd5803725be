//! The objects of glTF 2.0 itself (§5, in the order of their names there).

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

const MAX_INTEGER: u64 = u64::MAX;
const NAME: super::MemberSchema = optional("name", Text);

const fn object_schema(
    name: &'static str,
    members: &'static [super::MemberSchema],
) -> ObjectSchema {
    ObjectSchema { name, members }
}

const fn object_kind(object: &'static ObjectSchema) -> super::ValueKind {
    super::ValueKind::Object(object)
}

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

static ACCESSOR: ObjectSchema = object_schema(
    "accessor",
    &[
        optional("bufferView", Index(BufferViews)),
        requires("byteOffset", "bufferView", Integer(0, MAX_INTEGER)),
        required("componentType", EnumInteger(&[5120, 5121, 5122, 5123, 5125, 5126])),
        optional("normalized", Boolean),
        required("count", Integer(1, MAX_INTEGER)),
        required("type", EnumString(&["SCALAR", "VEC2", "VEC3", "VEC4", "MAT2", "MAT3", "MAT4"])),
        // How many there must be depends on the type: see the check of accessors.
        optional("max", Numbers(0, ANY)),
        optional("min", Numbers(0, ANY)),
        optional("sparse", object_kind(&SPARSE)),
        NAME,
    ],
);

static SPARSE: ObjectSchema = object_schema(
    "sparse",
    &[
        required("count", Integer(1, MAX_INTEGER)),
        required("indices", object_kind(&SPARSE_INDICES)),
        required("values", object_kind(&SPARSE_VALUES)),
    ],
);

static SPARSE_INDICES: ObjectSchema = object_schema(
    "sparseIndices",
    &[
        required("bufferView", Index(BufferViews)),
        optional("byteOffset", Integer(0, MAX_INTEGER)),
        required("componentType", EnumInteger(&[5121, 5123, 5125])),
    ],
);

static SPARSE_VALUES: ObjectSchema = object_schema(
    "sparseValues",
    &[required("bufferView", Index(BufferViews)), optional("byteOffset", Integer(0, MAX_INTEGER))],
);

static ANIMATION: ObjectSchema = object_schema(
    "animation",
    &[
        required("channels", Objects(&CHANNEL)),
        required("samplers", Objects(&ANIMATION_SAMPLER)),
        NAME,
    ],
);

static CHANNEL: ObjectSchema = object_schema(
    "channel",
    &[required("sampler", Index(AnimationSamplers)), required("target", object_kind(&TARGET))],
);

static TARGET: ObjectSchema = object_schema(
    "target",
    &[
        optional("node", Index(Nodes)),
        required("path", EnumString(&["translation", "rotation", "scale", "weights", "pointer"])),
    ],
);

static ANIMATION_SAMPLER: ObjectSchema = object_schema(
    "animationSampler",
    &[
        required("input", Index(Accessors)),
        optional("interpolation", EnumString(&["LINEAR", "STEP", "CUBICSPLINE"])),
        required("output", Index(Accessors)),
    ],
);

static ASSET: ObjectSchema = object_schema(
    "asset",
    &[
        optional("copyright", Text),
        optional("generator", Text),
        required("version", Version),
        optional("minVersion", Version),
    ],
);

static BUFFER: ObjectSchema = object_schema(
    "buffer",
    &[optional("uri", Text), required("byteLength", Integer(1, MAX_INTEGER)), NAME],
);

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

static CAMERA: ObjectSchema = object_schema(
    "camera",
    &[
        // The one that the type names must be there: see the check of cameras.
        excludes("orthographic", "perspective", object_kind(&ORTHOGRAPHIC)),
        optional("perspective", object_kind(&PERSPECTIVE)),
        required("type", EnumString(&["perspective", "orthographic"])),
        NAME,
    ],
);

static ORTHOGRAPHIC: ObjectSchema = object_schema(
    "orthographic",
    &[
        required("xmag", Number(ANY)),
        required("ymag", Number(ANY)),
        required("zfar", Number(POSITIVE)),
        required("znear", Number(NOT_NEGATIVE)),
    ],
);

static PERSPECTIVE: ObjectSchema = object_schema(
    "perspective",
    &[
        optional("aspectRatio", Number(POSITIVE)),
        required("yfov", Number(POSITIVE)),
        optional("zfar", Number(POSITIVE)),
        required("znear", Number(POSITIVE)),
    ],
);

static IMAGE: ObjectSchema = object_schema(
    "image",
    &[
        one_of("uri", "bufferView", Text),
        optional("mimeType", Text),
        one_of("bufferView", "uri", Index(BufferViews)),
        NAME,
    ],
);

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

pub(super) static TEXTURE_INFO: ObjectSchema = object_schema(
    "textureInfo",
    &[required("index", Index(Textures)), optional("texCoord", Integer(0, MAX_INTEGER))],
);

pub(super) static NORMAL_TEXTURE: ObjectSchema = object_schema(
    "textureInfo",
    &[
        required("index", Index(Textures)),
        optional("texCoord", Integer(0, MAX_INTEGER)),
        optional("scale", Number(ANY)),
    ],
);

static OCCLUSION_TEXTURE: ObjectSchema = object_schema(
    "textureInfo",
    &[
        required("index", Index(Textures)),
        optional("texCoord", Integer(0, MAX_INTEGER)),
        optional("strength", Number(UNIT)),
    ],
);

static MESH: ObjectSchema = object_schema(
    "mesh",
    &[required("primitives", Objects(&PRIMITIVE)), optional("weights", Numbers(0, ANY)), NAME],
);

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

static SCENE: ObjectSchema = object_schema("scene", &[optional("nodes", Indices(Nodes)), NAME]);

static SKIN: ObjectSchema = object_schema(
    "skin",
    &[
        optional("inverseBindMatrices", Index(Accessors)),
        optional("skeleton", Index(Nodes)),
        required("joints", Indices(Nodes)),
        NAME,
    ],
);

static TEXTURE: ObjectSchema = object_schema(
    "texture",
    &[optional("sampler", Index(Samplers)), optional("source", Index(Images)), NAME],
);

/// What is not described further.
pub(super) const UNKNOWN: super::ValueKind = Any;
