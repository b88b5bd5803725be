//! Schema tables for extension objects, each with the object that may contain it.
//!
//! Extensions without a table are not validated. An extension without objects, such as
//! KHR_mesh_quantization, has the parent "nothing": the extension is known, but its object must not
//! appear anywhere.
//!
//! To support an extension, add a row for each object that may contain its object, and a static for
//! each nested object. The walk finds unknown members, missing members and out-of-range values
//! without additional code. Rules about two members belong in the check of the parent object.

use super::Collection::{Accessors, BufferViews, Buffers, Images, Lights, Materials, Variants};
use super::ValueKind::{
    Boolean, EnumString, Index, Indices, Integer, Number, Numbers, Object as ObjectKind, Objects,
    Text,
};
use super::core::{NORMAL_TEXTURE, TEXTURE_INFO, UNKNOWN};
use super::{ANY, NOT_NEGATIVE, NumberRange, ObjectSchema, POSITIVE, UNIT, optional, required};

/// An integer without a maximum.
const MAX_INTEGER: u64 = u64::MAX;
/// Indices of refraction: at least 1.
///
/// A vacuum has an index of refraction of 1, and no film or coating has a lower one.
const ABOVE_ONE: NumberRange = NumberRange { min: 1.0, ..ANY };
/// Cone angles of spot lights, in radians.
///
/// A cone with an outer angle of π/2 is a half space, the widest that KHR_lights_punctual allows.
const QUARTER_TURN: NumberRange =
    NumberRange { min: 0.0, max: std::f64::consts::FRAC_PI_2, exclusive_min: false };

/// An extension object: the extension's name, the parent object, and the members.
///
/// An extension may have several objects: KHR_lights_punctual has a list of lights in the root, and
/// indices into it in nodes.
pub(in super::super) struct ExtensionObject {
    /// The name of the extension.
    pub(in super::super) name: &'static str,
    /// The name of the object that may contain it.
    pub(in super::super) parent: &'static str,
    /// The members of the extension's object.
    pub(in super::super) object: ObjectSchema,
}

/// Declares the table, with one row per extension and parent object.
macro_rules! extension_objects {
    ($($name:ident in $parent:literal: [$($member:expr),* $(,)?];)*) => {
        pub(in super::super) static EXTENSION_OBJECTS: &[ExtensionObject] = &[$(ExtensionObject {
            name: stringify!($name),
            parent: $parent,
            object: ObjectSchema { name: stringify!($name), members: &[$($member),*] },
        }),*];
    };
}

extension_objects! {
    CESIUM_primitive_outline in "primitive": [optional("indices", Index(Accessors))];
    EXT_mesh_gpu_instancing in "node": [required("attributes", super::ValueKind::Attributes)];
    EXT_mesh_primitive_edge_visibility in "primitive": [
        optional("visibility", Index(Accessors)),
        optional("material", Index(Materials)),
        optional("lineStrings", UNKNOWN),
        optional("silhouetteNormals", Index(Accessors)),
    ];
    EXT_meshopt_compression in "bufferView": [
        required("buffer", Index(Buffers)),
        optional("byteOffset", Integer(0, MAX_INTEGER)),
        required("byteLength", Integer(1, MAX_INTEGER)),
        required("byteStride", Integer(1, 256)),
        required("count", Integer(1, MAX_INTEGER)),
        required("mode", EnumString(&["ATTRIBUTES", "TRIANGLES", "INDICES"])),
        optional("filter", EnumString(&["NONE", "OCTAHEDRAL", "QUATERNION", "EXPONENTIAL"])),
    ];
    EXT_meshopt_compression in "buffer": [optional("fallback", Boolean)];
    EXT_texture_webp in "texture": [optional("source", Index(Images))];
    KHR_animation_pointer in "target": [required("pointer", Text)];
    KHR_draco_mesh_compression in "primitive": [
        required("bufferView", Index(BufferViews)),
        required("attributes", UNKNOWN),
    ];
    KHR_lights_punctual in "glTF": [required("lights", Objects(&LIGHT))];
    KHR_lights_punctual in "node": [required("light", Index(Lights))];
    KHR_materials_anisotropy in "material": [
        optional("anisotropyStrength", Number(UNIT)),
        optional("anisotropyRotation", Number(ANY)),
        optional("anisotropyTexture", ObjectKind(&TEXTURE_INFO)),
    ];
    KHR_materials_clearcoat in "material": [
        optional("clearcoatFactor", Number(UNIT)),
        optional("clearcoatTexture", ObjectKind(&TEXTURE_INFO)),
        optional("clearcoatRoughnessFactor", Number(UNIT)),
        optional("clearcoatRoughnessTexture", ObjectKind(&TEXTURE_INFO)),
        optional("clearcoatNormalTexture", ObjectKind(&NORMAL_TEXTURE)),
    ];
    KHR_materials_diffuse_transmission in "material": [
        optional("diffuseTransmissionFactor", Number(UNIT)),
        optional("diffuseTransmissionTexture", ObjectKind(&TEXTURE_INFO)),
        optional("diffuseTransmissionColorFactor", Numbers(3, UNIT)),
        optional("diffuseTransmissionColorTexture", ObjectKind(&TEXTURE_INFO)),
    ];
    KHR_materials_dispersion in "material": [optional("dispersion", Number(NOT_NEGATIVE))];
    KHR_materials_emissive_strength in "material": [optional("emissiveStrength", Number(NOT_NEGATIVE))];
    KHR_materials_ior in "material": [optional("ior", Number(IOR))];
    KHR_materials_iridescence in "material": [
        optional("iridescenceFactor", Number(UNIT)),
        optional("iridescenceTexture", ObjectKind(&TEXTURE_INFO)),
        optional("iridescenceIor", Number(ABOVE_ONE)),
        optional("iridescenceThicknessMinimum", Number(NOT_NEGATIVE)),
        optional("iridescenceThicknessMaximum", Number(NOT_NEGATIVE)),
        optional("iridescenceThicknessTexture", ObjectKind(&TEXTURE_INFO)),
    ];
    KHR_materials_pbrSpecularGlossiness in "material": [
        optional("diffuseFactor", Numbers(4, UNIT)),
        optional("diffuseTexture", ObjectKind(&TEXTURE_INFO)),
        optional("specularFactor", Numbers(3, UNIT)),
        optional("glossinessFactor", Number(UNIT)),
        optional("specularGlossinessTexture", ObjectKind(&TEXTURE_INFO)),
    ];
    KHR_materials_sheen in "material": [
        optional("sheenColorFactor", Numbers(3, UNIT)),
        optional("sheenColorTexture", ObjectKind(&TEXTURE_INFO)),
        optional("sheenRoughnessFactor", Number(UNIT)),
        optional("sheenRoughnessTexture", ObjectKind(&TEXTURE_INFO)),
    ];
    KHR_materials_specular in "material": [
        optional("specularFactor", Number(UNIT)),
        optional("specularTexture", ObjectKind(&TEXTURE_INFO)),
        optional("specularColorFactor", Numbers(3, NOT_NEGATIVE)),
        optional("specularColorTexture", ObjectKind(&TEXTURE_INFO)),
    ];
    KHR_materials_transmission in "material": [
        optional("transmissionFactor", Number(UNIT)),
        optional("transmissionTexture", ObjectKind(&TEXTURE_INFO)),
    ];
    KHR_materials_unlit in "material": [];
    KHR_materials_variants in "glTF": [required("variants", Objects(&VARIANT))];
    KHR_materials_variants in "primitive": [required("mappings", Objects(&MAPPING))];
    KHR_materials_volume in "material": [
        optional("thicknessFactor", Number(NOT_NEGATIVE)),
        optional("thicknessTexture", ObjectKind(&TEXTURE_INFO)),
        optional("attenuationDistance", Number(POSITIVE)),
        optional("attenuationColor", Numbers(3, UNIT)),
    ];
    KHR_mesh_quantization in "nothing": [];
    KHR_meshopt_compression in "bufferView": [
        required("buffer", Index(Buffers)),
        optional("byteOffset", Integer(0, MAX_INTEGER)),
        required("byteLength", Integer(1, MAX_INTEGER)),
        required("byteStride", Integer(1, 256)),
        required("count", Integer(1, MAX_INTEGER)),
        required("mode", EnumString(&["ATTRIBUTES", "TRIANGLES", "INDICES"])),
        optional("filter", EnumString(&["NONE", "OCTAHEDRAL", "QUATERNION", "EXPONENTIAL", "COLOR"])),
    ];
    KHR_meshopt_compression in "buffer": [optional("fallback", Boolean)];
    KHR_node_visibility in "node": [optional("visible", Boolean)];
    KHR_texture_basisu in "texture": [optional("source", Index(Images))];
    KHR_texture_transform in "textureInfo": [
        optional("offset", Numbers(2, ANY)),
        optional("rotation", Number(ANY)),
        optional("scale", Numbers(2, ANY)),
        optional("texCoord", Integer(0, MAX_INTEGER)),
    ];
    MSFT_texture_dds in "texture": [required("source", Index(Images))];
}

/// The index of refraction is 0 (full reflection at every angle) or at least 1; material validation
/// rejects values in between.
///
/// A [`NumberRange`] cannot express an interval with a gap.
const IOR: NumberRange = NOT_NEGATIVE;

/// A light of KHR_lights_punctual.
///
/// `color` is linear RGB. `intensity` is in candela for point and spot lights, and in lux for
/// directional lights; `range`, in meters, is a hint for culling.
static LIGHT: ObjectSchema = ObjectSchema {
    name: "light",
    members: &[
        optional("name", Text),
        optional("color", Numbers(3, UNIT)),
        optional("intensity", Number(NOT_NEGATIVE)),
        optional("range", Number(POSITIVE)),
        optional("spot", ObjectKind(&SPOT)),
        required("type", EnumString(&["directional", "point", "spot"])),
    ],
};

/// The cone of a spot light of KHR_lights_punctual.
///
/// Both angles are in radians from the axis of the cone. The inner angle must be less than the
/// outer angle; material validation checks this.
static SPOT: ObjectSchema = ObjectSchema {
    name: "spot",
    members: &[
        optional("innerConeAngle", Number(QUARTER_TURN)),
        optional("outerConeAngle", Number(NumberRange { exclusive_min: true, ..QUARTER_TURN })),
    ],
};

/// A variant of KHR_materials_variants.
static VARIANT: ObjectSchema = ObjectSchema { name: "variant", members: &[required("name", Text)] };

/// A primitive's material in some variants (KHR_materials_variants).
///
/// A primitive without a mapping for the active variant uses its default material.
static MAPPING: ObjectSchema = ObjectSchema {
    name: "mapping",
    members: &[
        required("variants", Indices(Variants)),
        required("material", Index(Materials)),
        optional("name", Text),
    ],
};
