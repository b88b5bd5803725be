//! The JSON schema of glTF as tables: which members an object may have, and what each must be.
//!
//! The tables are the specification's own property tables (glTF 2.0 §5) and those of the extensions, line by line. A walk over
//! a document ([`super::walk`]) by these tables finds whatever is of the wrong type, out of range, missing, or refers
//! to nothing, without a line of code for any single member.

pub(super) mod core;
pub(super) mod extensions;

/// An object: its name in the tables of extensions, and its members. All may have `extensions` and `extras` besides.
#[derive(Debug)]
pub(super) struct ObjectSchema {
    pub(super) name: &'static str,
    pub(super) members: &'static [MemberSchema],
}

/// A member of an object.
#[derive(Debug)]
pub(super) struct MemberSchema {
    pub(super) name: &'static str,
    pub(super) kind: ValueKind,
    pub(super) rule: PresenceRule,
}

/// When a member must be there.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum PresenceRule {
    /// Whenever one likes.
    Optional,
    /// Always.
    Required,
    /// Only together with another member.
    Requires(&'static str),
    /// Exactly one of this member and that one must be there.
    ExactlyOne(&'static str),
    /// Only without another member.
    Excludes(&'static str),
}

/// What a member must be.
#[derive(Clone, Copy, Debug)]
pub(super) enum ValueKind {
    /// Anything at all.
    Any,
    /// true or false.
    Boolean,
    /// A text.
    Text,
    /// A text of the form `2.0`.
    Version,
    /// One of these texts; another one is only a warning.
    EnumString(&'static [&'static str]),
    /// A whole number from the first to the second.
    Integer(u64, u64),
    /// One of these whole numbers; another one is only a warning.
    EnumInteger(&'static [u64]),
    /// A number in a range.
    Number(NumberRange),
    /// So many numbers, each in a range; 0 for any number but none.
    Numbers(usize, NumberRange),
    /// The number of something.
    Index(Collection),
    /// The numbers of several things, all different.
    Indices(Collection),
    /// Texts, all different.
    Texts,
    /// An object.
    Object(&'static ObjectSchema),
    /// At least one object.
    Objects(&'static ObjectSchema),
    /// Accessors by the names of attributes.
    Attributes,
    /// Several of them: morph targets.
    Targets,
}

/// The least and the greatest number that is allowed, and whether the least itself is.
#[derive(Clone, Copy, Debug)]
pub(super) struct NumberRange {
    pub(super) min: f64,
    pub(super) max: f64,
    pub(super) exclusive_min: bool,
}

const fn excludes(name: &'static str, other: &'static str, kind: ValueKind) -> MemberSchema {
    MemberSchema { name, kind, rule: PresenceRule::Excludes(other) }
}

const ANY: NumberRange =
    NumberRange { min: f64::NEG_INFINITY, max: f64::INFINITY, exclusive_min: false };
const UNIT: NumberRange = NumberRange { min: 0.0, max: 1.0, exclusive_min: false };
const SIGNED_UNIT: NumberRange = NumberRange { min: -1.0, max: 1.0, exclusive_min: false };
const NOT_NEGATIVE: NumberRange = NumberRange { min: 0.0, ..ANY };
const POSITIVE: NumberRange = NumberRange { min: 0.0, exclusive_min: true, ..ANY };

/// What an index counts.
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
    /// The samplers of the same animation; they are checked with it.
    AnimationSamplers,
}

impl Collection {
    /// Those that are arrays of a document, where each is, and whether something in it that nobody uses is worth a note.
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

const fn optional(name: &'static str, kind: ValueKind) -> MemberSchema {
    MemberSchema { name, kind, rule: PresenceRule::Optional }
}

const fn required(name: &'static str, kind: ValueKind) -> MemberSchema {
    MemberSchema { name, kind, rule: PresenceRule::Required }
}

const fn requires(name: &'static str, other: &'static str, kind: ValueKind) -> MemberSchema {
    MemberSchema { name, kind, rule: PresenceRule::Requires(other) }
}

const fn one_of(name: &'static str, other: &'static str, kind: ValueKind) -> MemberSchema {
    MemberSchema { name, kind, rule: PresenceRule::ExactlyOne(other) }
}
