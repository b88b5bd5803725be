//! The objects of glTF 2.0 itself (§5, in the order of their names there).

use super::Collection::{
    Accessors, AnimationSamplers, BufferViews, Buffers, Cameras, Images, Materials, Meshes, Nodes,
    Samplers, Scenes, Skins, Textures,
};
use super::ValueKind::{
    Any, Attributes, Choice, Flag, Index, Indices, Integer, Number, Numbers, Objects, Targets,
    Text, Texts, Version, Word,
};
use super::{ANY, NOT_NEGATIVE, Object, POSITIVE, SIGNED_UNIT, UNIT, either, may, must, not, with};

const MOST: u64 = u64::MAX;
const NAME: super::MemberSchema = may("name", Text);

const fn object(name: &'static str, members: &'static [super::MemberSchema]) -> Object {
    Object { name, members }
}

const fn one(object: &'static Object) -> super::ValueKind {
    super::ValueKind::Object(object)
}

pub(in super::super) static ROOT: Object = object(
    "glTF",
    &[
        may("extensionsUsed", Texts),
        with("extensionsRequired", "extensionsUsed", Texts),
        may("accessors", Objects(&ACCESSOR)),
        may("animations", Objects(&ANIMATION)),
        must("asset", one(&ASSET)),
        may("buffers", Objects(&BUFFER)),
        may("bufferViews", Objects(&BUFFER_VIEW)),
        may("cameras", Objects(&CAMERA)),
        may("images", Objects(&IMAGE)),
        may("materials", Objects(&MATERIAL)),
        may("meshes", Objects(&MESH)),
        may("nodes", Objects(&NODE)),
        may("samplers", Objects(&SAMPLER)),
        with("scene", "scenes", Index(Scenes)),
        may("scenes", Objects(&SCENE)),
        may("skins", Objects(&SKIN)),
        may("textures", Objects(&TEXTURE)),
    ],
);

static ACCESSOR: Object = object(
    "accessor",
    &[
        may("bufferView", Index(BufferViews)),
        with("byteOffset", "bufferView", Integer(0, MOST)),
        must("componentType", Choice(&[5120, 5121, 5122, 5123, 5125, 5126])),
        may("normalized", Flag),
        must("count", Integer(1, MOST)),
        must("type", Word(&["SCALAR", "VEC2", "VEC3", "VEC4", "MAT2", "MAT3", "MAT4"])),
        // How many there must be depends on the type: see the check of accessors.
        may("max", Numbers(0, ANY)),
        may("min", Numbers(0, ANY)),
        may("sparse", one(&SPARSE)),
        NAME,
    ],
);

static SPARSE: Object = object(
    "sparse",
    &[
        must("count", Integer(1, MOST)),
        must("indices", one(&SPARSE_INDICES)),
        must("values", one(&SPARSE_VALUES)),
    ],
);

static SPARSE_INDICES: Object = object(
    "sparseIndices",
    &[
        must("bufferView", Index(BufferViews)),
        may("byteOffset", Integer(0, MOST)),
        must("componentType", Choice(&[5121, 5123, 5125])),
    ],
);

static SPARSE_VALUES: Object = object(
    "sparseValues",
    &[must("bufferView", Index(BufferViews)), may("byteOffset", Integer(0, MOST))],
);

static ANIMATION: Object = object(
    "animation",
    &[must("channels", Objects(&CHANNEL)), must("samplers", Objects(&ANIMATION_SAMPLER)), NAME],
);

static CHANNEL: Object =
    object("channel", &[must("sampler", Index(AnimationSamplers)), must("target", one(&TARGET))]);

static TARGET: Object = object(
    "target",
    &[
        may("node", Index(Nodes)),
        must("path", Word(&["translation", "rotation", "scale", "weights", "pointer"])),
    ],
);

static ANIMATION_SAMPLER: Object = object(
    "animationSampler",
    &[
        must("input", Index(Accessors)),
        may("interpolation", Word(&["LINEAR", "STEP", "CUBICSPLINE"])),
        must("output", Index(Accessors)),
    ],
);

static ASSET: Object = object(
    "asset",
    &[
        may("copyright", Text),
        may("generator", Text),
        must("version", Version),
        may("minVersion", Version),
    ],
);

static BUFFER: Object =
    object("buffer", &[may("uri", Text), must("byteLength", Integer(1, MOST)), NAME]);

static BUFFER_VIEW: Object = object(
    "bufferView",
    &[
        must("buffer", Index(Buffers)),
        may("byteOffset", Integer(0, MOST)),
        must("byteLength", Integer(1, MOST)),
        may("byteStride", Integer(4, 252)),
        may("target", Choice(&[34_962, 34_963])),
        NAME,
    ],
);

static CAMERA: Object = object(
    "camera",
    &[
        // The one that the type names must be there: see the check of cameras.
        not("orthographic", "perspective", one(&ORTHOGRAPHIC)),
        may("perspective", one(&PERSPECTIVE)),
        must("type", Word(&["perspective", "orthographic"])),
        NAME,
    ],
);

static ORTHOGRAPHIC: Object = object(
    "orthographic",
    &[
        must("xmag", Number(ANY)),
        must("ymag", Number(ANY)),
        must("zfar", Number(POSITIVE)),
        must("znear", Number(NOT_NEGATIVE)),
    ],
);

static PERSPECTIVE: Object = object(
    "perspective",
    &[
        may("aspectRatio", Number(POSITIVE)),
        must("yfov", Number(POSITIVE)),
        may("zfar", Number(POSITIVE)),
        must("znear", Number(POSITIVE)),
    ],
);

static IMAGE: Object = object(
    "image",
    &[
        either("uri", "bufferView", Text),
        may("mimeType", Text),
        either("bufferView", "uri", Index(BufferViews)),
        NAME,
    ],
);

static MATERIAL: Object = object(
    "material",
    &[
        NAME,
        may("pbrMetallicRoughness", one(&METALLIC_ROUGHNESS)),
        may("normalTexture", one(&NORMAL_TEXTURE)),
        may("occlusionTexture", one(&OCCLUSION_TEXTURE)),
        may("emissiveTexture", one(&TEXTURE_INFO)),
        may("emissiveFactor", Numbers(3, UNIT)),
        may("alphaMode", Word(&["OPAQUE", "MASK", "BLEND"])),
        may("alphaCutoff", Number(NOT_NEGATIVE)),
        may("doubleSided", Flag),
    ],
);

static METALLIC_ROUGHNESS: Object = object(
    "pbrMetallicRoughness",
    &[
        may("baseColorFactor", Numbers(4, UNIT)),
        may("baseColorTexture", one(&TEXTURE_INFO)),
        may("metallicFactor", Number(UNIT)),
        may("roughnessFactor", Number(UNIT)),
        may("metallicRoughnessTexture", one(&TEXTURE_INFO)),
    ],
);

pub(super) static TEXTURE_INFO: Object =
    object("textureInfo", &[must("index", Index(Textures)), may("texCoord", Integer(0, MOST))]);

pub(super) static NORMAL_TEXTURE: Object = object(
    "textureInfo",
    &[must("index", Index(Textures)), may("texCoord", Integer(0, MOST)), may("scale", Number(ANY))],
);

static OCCLUSION_TEXTURE: Object = object(
    "textureInfo",
    &[
        must("index", Index(Textures)),
        may("texCoord", Integer(0, MOST)),
        may("strength", Number(UNIT)),
    ],
);

static MESH: Object = object(
    "mesh",
    &[must("primitives", Objects(&PRIMITIVE)), may("weights", Numbers(0, ANY)), NAME],
);

static PRIMITIVE: Object = object(
    "primitive",
    &[
        must("attributes", Attributes),
        may("indices", Index(Accessors)),
        may("material", Index(Materials)),
        may("mode", Integer(0, 6)),
        may("targets", Targets),
    ],
);

static NODE: Object = object(
    "node",
    &[
        may("camera", Index(Cameras)),
        may("children", Indices(Nodes)),
        with("skin", "mesh", Index(Skins)),
        may("matrix", Numbers(16, ANY)),
        may("mesh", Index(Meshes)),
        may("rotation", Numbers(4, SIGNED_UNIT)),
        may("scale", Numbers(3, ANY)),
        may("translation", Numbers(3, ANY)),
        with("weights", "mesh", Numbers(0, ANY)),
        NAME,
    ],
);

static SAMPLER: Object = object(
    "sampler",
    &[
        may("magFilter", Choice(&[9728, 9729])),
        may("minFilter", Choice(&[9728, 9729, 9984, 9985, 9986, 9987])),
        may("wrapS", Choice(&[33_071, 33_648, 10_497])),
        may("wrapT", Choice(&[33_071, 33_648, 10_497])),
        NAME,
    ],
);

static SCENE: Object = object("scene", &[may("nodes", Indices(Nodes)), NAME]);

static SKIN: Object = object(
    "skin",
    &[
        may("inverseBindMatrices", Index(Accessors)),
        may("skeleton", Index(Nodes)),
        must("joints", Indices(Nodes)),
        NAME,
    ],
);

static TEXTURE: Object =
    object("texture", &[may("sampler", Index(Samplers)), may("source", Index(Images)), NAME]);

/// What is not described further.
pub(super) const UNKNOWN: super::ValueKind = Any;
