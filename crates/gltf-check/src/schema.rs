//! The glTF JSON schema as constant tables: the members of every object, and their values.
//!
//! The tables follow the property tables of the specification (glTF 2.0 §5) and the extensions, row
//! by row. The schema walk ([`super::schema_walk`]) interprets them: it finds missing members,
//! unresolved references, and values of the wrong type or out of range, without code for individual
//! members.
//!
//! Each member is a row of its object's table:
//!
//! ```text
//!  requires("byteOffset", "bufferView", Integer(0, MAX_INTEGER))
//!  presence   name          other         kind and range
//! ```

pub(super) mod core;
pub(super) mod extensions;

/// The schema of an object: its name, which extensions refer to, and its members.
///
/// In addition, every object may have `extensions` and `extras`.
#[derive(Debug)]
pub(super) struct ObjectSchema {
    /// The name in the specification, such as `accessor` or `textureInfo`.
    pub(super) name: &'static str,
    /// The members, in the order of the specification.
    pub(super) members: &'static [MemberSchema],
}

/// The schema of a member.
///
/// Default values are not part of the schema, because they never affect validity.
#[derive(Debug)]
pub(super) struct MemberSchema {
    /// The name of the member.
    pub(super) name: &'static str,
    /// The type and range of its value.
    pub(super) kind: ValueKind,
    /// The rule about its presence.
    pub(super) rule: PresenceRule,
}

/// A condition under which a member may or must be present.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum PresenceRule {
    /// It may be present or absent.
    Optional,
    /// It must be present; otherwise `UNDEFINED_PROPERTY` is reported.
    Required,
    /// It may be present only together with another member (`dependencies` in the JSON schema).
    Requires(&'static str),
    /// Exactly one of this member and another must be present (`oneOf` in the JSON schema).
    ExactlyOne(&'static str),
    /// It may be present only without another member (`not` in the JSON schema).
    Excludes(&'static str),
}

/// The type and range of a value.
///
/// Composite kinds refer to the schemas of their objects; all other kinds are leaves of the walk.
#[derive(Clone, Copy, Debug)]
pub(super) enum ValueKind {
    /// Any value.
    Any,
    /// `true` or `false`.
    Boolean,
    /// A string.
    Text,
    /// A string of the form `2.0`.
    Version,
    /// One of these strings; any other string gets only a warning.
    EnumString(&'static [&'static str]),
    /// An integer in an inclusive range.
    Integer(u64, u64),
    /// One of these integers; any other integer gets only a warning.
    EnumInteger(&'static [u64]),
    /// A number in a range.
    Number(NumberRange),
    /// An array of this many numbers in a range; 0 means any length above 0.
    Numbers(usize, NumberRange),
    /// An index into a collection.
    Index(Collection),
    /// Distinct indices into a collection.
    Indices(Collection),
    /// Distinct strings.
    Texts,
    /// An object.
    Object(&'static ObjectSchema),
    /// A non-empty array of objects.
    Objects(&'static ObjectSchema),
    /// Accessor indices by attribute name.
    Attributes,
    /// Morph targets: a non-empty array of attributes.
    Targets,
}

/// A range of numbers, which may exclude its minimum.
///
/// Only the minimum can be exclusive: the specification has ranges such as `yfov > 0`, but no
/// exclusive maximum.
#[derive(Clone, Copy, Debug)]
pub(super) struct NumberRange {
    /// The minimum.
    pub(super) min: f64,
    /// The maximum, which is always included.
    pub(super) max: f64,
    /// Whether the minimum is excluded.
    pub(super) exclusive_min: bool,
}

/// Declares a member that excludes another.
const fn excludes(name: &'static str, other: &'static str, kind: ValueKind) -> MemberSchema {
    MemberSchema { name, kind, rule: PresenceRule::Excludes(other) }
}

/// Any number.
const ANY: NumberRange =
    NumberRange { min: f64::NEG_INFINITY, max: f64::INFINITY, exclusive_min: false };
/// Factors: [0, 1].
const UNIT: NumberRange = NumberRange { min: 0.0, max: 1.0, exclusive_min: false };
/// Components of unit vectors and quaternions: [−1, 1].
const SIGNED_UNIT: NumberRange = NumberRange { min: -1.0, max: 1.0, exclusive_min: false };
/// Numbers of at least 0.
const NOT_NEGATIVE: NumberRange = NumberRange { min: 0.0, ..ANY };
/// Numbers greater than 0.
const POSITIVE: NumberRange = NumberRange { min: 0.0, exclusive_min: true, ..ANY };

/// A collection of objects that indices refer to.
///
/// The discriminants are indices into [`Collection::ALL`] and into the flags of used objects.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Collection {
    Accessors,
    Buffers,
    BufferViews,
    Cameras,
    Images,
    Materials,
    Meshes,
    Nodes,
    Samplers,
    Scenes,
    Skins,
    Textures,
    Lights,
    Variants,
    /// The samplers of the same animation, which are validated with the animation.
    AnimationSamplers,
}

impl Collection {
    /// The collections of a document with their pointers, and whether unused objects get a note.
    ///
    /// Unused nodes and scenes do not get a note: nodes are reached through scenes, and all scenes
    /// except one are unused by design.
    pub(super) const ALL: [(Self, &'static str, bool); 14] = [
        (Self::Accessors, "/accessors", true),
        (Self::Buffers, "/buffers", true),
        (Self::BufferViews, "/bufferViews", true),
        (Self::Cameras, "/cameras", true),
        (Self::Images, "/images", true),
        (Self::Materials, "/materials", true),
        (Self::Meshes, "/meshes", true),
        (Self::Nodes, "/nodes", false),
        (Self::Samplers, "/samplers", true),
        (Self::Scenes, "/scenes", false),
        (Self::Skins, "/skins", true),
        (Self::Textures, "/textures", true),
        (Self::Lights, "/extensions/KHR_lights_punctual/lights", true),
        (Self::Variants, "/extensions/KHR_materials_variants/variants", true),
    ];
}

/// Declares a member that may be absent.
const fn optional(name: &'static str, kind: ValueKind) -> MemberSchema {
    MemberSchema { name, kind, rule: PresenceRule::Optional }
}

/// Declares a member that must be present.
const fn required(name: &'static str, kind: ValueKind) -> MemberSchema {
    MemberSchema { name, kind, rule: PresenceRule::Required }
}

/// Declares a member that is valid only together with another.
const fn requires(name: &'static str, other: &'static str, kind: ValueKind) -> MemberSchema {
    MemberSchema { name, kind, rule: PresenceRule::Requires(other) }
}

/// Declares one of two members of which exactly one must be present.
const fn one_of(name: &'static str, other: &'static str, kind: ValueKind) -> MemberSchema {
    MemberSchema { name, kind, rule: PresenceRule::ExactlyOne(other) }
}
