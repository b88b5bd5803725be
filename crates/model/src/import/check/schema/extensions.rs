//! The objects of extensions, each with the object it may be in.
//!
//! What is here is checked; other extensions may say what they like. An extension that has no object in the file at all,
//! such as KHR_mesh_quantization, has none here either and may be in nothing.

use super::Collection::{Accessors, BufferViews, Buffers, Images, Lights, Materials, Variants};
use super::ValueKind::{
    Flag, Index, Indices, Integer, Number, Numbers, Object as One, Objects, Text, Word,
};
use super::core::{NORMAL_TEXTURE, TEXTURE_INFO, UNKNOWN};
use super::{ANY, NOT_NEGATIVE, NumberRange, Object, POSITIVE, UNIT, may, must};

const MOST: u64 = u64::MAX;
const ABOVE_ONE: NumberRange = NumberRange { min: 1.0, ..ANY };
const QUARTER_TURN: NumberRange =
    NumberRange { min: 0.0, max: std::f64::consts::FRAC_PI_2, exclusive_min: false };

/// An extension's object: the extension's name, the object it is in, and its members.
pub(in super::super) struct Place {
    pub(in super::super) name: &'static str,
    pub(in super::super) host: &'static str,
    pub(in super::super) object: Object,
}

macro_rules! places {
    ($($name:ident in $host:literal: [$($member:expr),* $(,)?];)*) => {
        pub(in super::super) static PLACES: &[Place] = &[$(Place {
            name: stringify!($name),
            host: $host,
            object: Object { name: stringify!($name), members: &[$($member),*] },
        }),*];
    };
}

places! {
    CESIUM_primitive_outline in "primitive": [may("indices", Index(Accessors))];
    EXT_mesh_gpu_instancing in "node": [must("attributes", super::ValueKind::Attributes)];
    EXT_mesh_primitive_edge_visibility in "primitive": [
        may("visibility", Index(Accessors)),
        may("material", Index(Materials)),
        may("lineStrings", UNKNOWN),
        may("silhouetteNormals", Index(Accessors)),
    ];
    EXT_meshopt_compression in "bufferView": [
        must("buffer", Index(Buffers)),
        may("byteOffset", Integer(0, MOST)),
        must("byteLength", Integer(1, MOST)),
        must("byteStride", Integer(1, 256)),
        must("count", Integer(1, MOST)),
        must("mode", Word(&["ATTRIBUTES", "TRIANGLES", "INDICES"])),
        may("filter", Word(&["NONE", "OCTAHEDRAL", "QUATERNION", "EXPONENTIAL"])),
    ];
    EXT_meshopt_compression in "buffer": [may("fallback", Flag)];
    EXT_texture_webp in "texture": [may("source", Index(Images))];
    KHR_animation_pointer in "target": [must("pointer", Text)];
    KHR_draco_mesh_compression in "primitive": [
        must("bufferView", Index(BufferViews)),
        must("attributes", UNKNOWN),
    ];
    KHR_lights_punctual in "glTF": [must("lights", Objects(&LIGHT))];
    KHR_lights_punctual in "node": [must("light", Index(Lights))];
    KHR_materials_anisotropy in "material": [
        may("anisotropyStrength", Number(UNIT)),
        may("anisotropyRotation", Number(ANY)),
        may("anisotropyTexture", One(&TEXTURE_INFO)),
    ];
    KHR_materials_clearcoat in "material": [
        may("clearcoatFactor", Number(UNIT)),
        may("clearcoatTexture", One(&TEXTURE_INFO)),
        may("clearcoatRoughnessFactor", Number(UNIT)),
        may("clearcoatRoughnessTexture", One(&TEXTURE_INFO)),
        may("clearcoatNormalTexture", One(&NORMAL_TEXTURE)),
    ];
    KHR_materials_diffuse_transmission in "material": [
        may("diffuseTransmissionFactor", Number(UNIT)),
        may("diffuseTransmissionTexture", One(&TEXTURE_INFO)),
        may("diffuseTransmissionColorFactor", Numbers(3, UNIT)),
        may("diffuseTransmissionColorTexture", One(&TEXTURE_INFO)),
    ];
    KHR_materials_dispersion in "material": [may("dispersion", Number(NOT_NEGATIVE))];
    KHR_materials_emissive_strength in "material": [may("emissiveStrength", Number(NOT_NEGATIVE))];
    KHR_materials_ior in "material": [may("ior", Number(IOR))];
    KHR_materials_iridescence in "material": [
        may("iridescenceFactor", Number(UNIT)),
        may("iridescenceTexture", One(&TEXTURE_INFO)),
        may("iridescenceIor", Number(ABOVE_ONE)),
        may("iridescenceThicknessMinimum", Number(NOT_NEGATIVE)),
        may("iridescenceThicknessMaximum", Number(NOT_NEGATIVE)),
        may("iridescenceThicknessTexture", One(&TEXTURE_INFO)),
    ];
    KHR_materials_pbrSpecularGlossiness in "material": [
        may("diffuseFactor", Numbers(4, UNIT)),
        may("diffuseTexture", One(&TEXTURE_INFO)),
        may("specularFactor", Numbers(3, UNIT)),
        may("glossinessFactor", Number(UNIT)),
        may("specularGlossinessTexture", One(&TEXTURE_INFO)),
    ];
    KHR_materials_sheen in "material": [
        may("sheenColorFactor", Numbers(3, UNIT)),
        may("sheenColorTexture", One(&TEXTURE_INFO)),
        may("sheenRoughnessFactor", Number(UNIT)),
        may("sheenRoughnessTexture", One(&TEXTURE_INFO)),
    ];
    KHR_materials_specular in "material": [
        may("specularFactor", Number(UNIT)),
        may("specularTexture", One(&TEXTURE_INFO)),
        may("specularColorFactor", Numbers(3, NOT_NEGATIVE)),
        may("specularColorTexture", One(&TEXTURE_INFO)),
    ];
    KHR_materials_transmission in "material": [
        may("transmissionFactor", Number(UNIT)),
        may("transmissionTexture", One(&TEXTURE_INFO)),
    ];
    KHR_materials_unlit in "material": [];
    KHR_materials_variants in "glTF": [must("variants", Objects(&VARIANT))];
    KHR_materials_variants in "primitive": [must("mappings", Objects(&MAPPING))];
    KHR_materials_volume in "material": [
        may("thicknessFactor", Number(NOT_NEGATIVE)),
        may("thicknessTexture", One(&TEXTURE_INFO)),
        may("attenuationDistance", Number(POSITIVE)),
        may("attenuationColor", Numbers(3, UNIT)),
    ];
    KHR_mesh_quantization in "nothing": [];
    KHR_meshopt_compression in "bufferView": [
        must("buffer", Index(Buffers)),
        may("byteOffset", Integer(0, MOST)),
        must("byteLength", Integer(1, MOST)),
        must("byteStride", Integer(1, 256)),
        must("count", Integer(1, MOST)),
        must("mode", Word(&["ATTRIBUTES", "TRIANGLES", "INDICES"])),
        may("filter", Word(&["NONE", "OCTAHEDRAL", "QUATERNION", "EXPONENTIAL", "COLOR"])),
    ];
    KHR_meshopt_compression in "buffer": [may("fallback", Flag)];
    KHR_node_visibility in "node": [may("visible", Flag)];
    KHR_texture_basisu in "texture": [may("source", Index(Images))];
    KHR_texture_transform in "textureInfo": [
        may("offset", Numbers(2, ANY)),
        may("rotation", Number(ANY)),
        may("scale", Numbers(2, ANY)),
        may("texCoord", Integer(0, MOST)),
    ];
    MSFT_texture_dds in "texture": [must("source", Index(Images))];
}

/// An index of refraction is 0, for "as for metals", or at least 1; what is between is found with the materials.
const IOR: NumberRange = NOT_NEGATIVE;

static LIGHT: Object = Object {
    name: "light",
    members: &[
        may("name", Text),
        may("color", Numbers(3, UNIT)),
        may("intensity", Number(NOT_NEGATIVE)),
        may("range", Number(POSITIVE)),
        may("spot", One(&SPOT)),
        must("type", Word(&["directional", "point", "spot"])),
    ],
};

static SPOT: Object = Object {
    name: "spot",
    members: &[
        may("innerConeAngle", Number(QUARTER_TURN)),
        may("outerConeAngle", Number(NumberRange { exclusive_min: true, ..QUARTER_TURN })),
    ],
};

static VARIANT: Object = Object { name: "variant", members: &[must("name", Text)] };

static MAPPING: Object = Object {
    name: "mapping",
    members: &[
        must("variants", Indices(Variants)),
        must("material", Index(Materials)),
        may("name", Text),
    ],
};
