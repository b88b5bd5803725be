//! Declarations of the scene language: one macro call declares a Rust type, its reader and writer,
//! and its entry in the reference.
//!
//! ```text
//!  scene_struct! { pub struct ModelFile as "Model" { pub path: String, pub scale: Scale = … } }
//!        ├─► struct ModelFile            the type that resolution uses
//!        ├─► impl Serialize, Deserialize for `ron` and every other serde format
//!        └─► ModelFile::ENTRY            fields, types, doc comments: for the checker and `scene doc`
//! ```
//! A field with `= value`, or of type `Option`, may be omitted.
//!
//! The declarations are the only description of the language. Reader, checker, reference,
//! formatter, suggestions and the search for misplaced fields all read the same `ENTRY` constants,
//! so they cannot drift apart. Everything is `const` data; nothing is registered at run time.

mod checker;
mod data;
mod declare;
mod search;
mod serialized;
mod values;

pub(super) use checker::Checker;
pub(crate) use data::{Data, push_field, read_named, write_named};
use declare::join_doc_lines;
pub(crate) use declare::{
    default_value, documentation, field_entry, inner_type, named_enum, named_values, read_fields,
    read_variant, scene_enum, scene_struct, variant_value, write_fields, write_variant,
};
pub(super) use search::{example_of, fields_where, variants_where};
pub(crate) use serialized::{read_value, serde_by_scene_value, write_value};
pub(crate) use values::{checked_number, read_plain};

use super::syntax::Node;

/// A type of values in scene files.
pub(super) trait SceneValue: Sized + PartialEq {
    /// Whether a field of this type may be omitted even if its declaration specifies no default.
    const IS_OPTIONAL: bool = false;

    /// Returns the type as the reference names it. This is a function, because the types of lists
    /// and tuples are built from the types of their elements.
    fn value_type() -> ValueType;

    /// Reads a value.
    ///
    /// # Errors
    /// Returns the reason, in words, if the data is not a value of this type.
    fn from_data(data: &Data) -> Result<Self, String>;

    /// Writes the value, omitting fields with default values.
    fn to_data(&self) -> Data;

    /// Returns the value of an omitted field. `None` makes the struct that contains the field
    /// unreadable; only types that are not optional return it.
    fn when_absent() -> Option<Self> {
        None
    }
}

/// A type with an entry in the reference: structs, enums, bounded numbers and colors.
pub(super) trait Declared {
    /// The declaration, which the macros generate from the Rust type and its doc comments.
    const ENTRY: &'static TypeEntry;
}

/// The type of a field or of the value of a variant.
#[derive(Clone, Debug)]
pub enum ValueType {
    /// A type without parts, such as a number, described in words.
    Plain(&'static str, Notation),
    /// A type with an entry in the reference.
    Declared(&'static TypeEntry),
    /// A list in square brackets.
    List(Box<Self>),
    /// A fixed number of values in parentheses.
    Tuple(Vec<Self>),
}

impl ValueType {
    /// Returns the type in words, with declared types shown by name.
    ///
    /// Examples are `list of Model` and `(Finite, Finite)`.
    #[must_use]
    pub fn words(&self) -> String {
        match self {
            Self::Plain(words, _) => (*words).to_owned(),
            Self::Declared(entry) => entry.name.to_owned(),
            Self::List(element) => format!("list of {}", element.words()),
            Self::Tuple(parts) => {
                let parts: Vec<String> = parts.iter().map(Self::words).collect();
                format!("({})", parts.join(", "))
            }
        }
    }

    /// Whether this is a struct whose fields may all be omitted.
    pub(super) fn has_only_optional_fields(&self) -> bool {
        matches!(self, Self::Declared(TypeEntry { shape: Shape::Fields(fields), .. })
            if fields.iter().all(|field| field.is_optional))
    }

    /// Returns the declared types that make up a value of this type.
    ///
    /// Looks through lists and tuples, but not into the fields of the types it finds. A caller that
    /// visits the whole language must remember the types it has seen.
    #[must_use]
    pub fn declared(&self) -> Vec<&'static TypeEntry> {
        match self {
            Self::Plain(..) => Vec::new(),
            Self::Declared(entry) => vec![entry],
            Self::List(element) => element.declared(),
            Self::Tuple(parts) => parts.iter().flat_map(Self::declared).collect(),
        }
    }
}

/// The declaration of a scene file type.
#[derive(Clone, Copy, Debug)]
pub struct TypeEntry {
    /// The name in scene files and messages; it may be written before the bracket.
    pub name: &'static str,
    /// The lines of the doc comment; [`about`](Self::about) joins them into paragraphs.
    pub doc: &'static str,
    /// The form of its values.
    pub shape: Shape,
}

/// The form of a type's values.
#[derive(Clone, Copy, Debug)]
pub enum Shape {
    /// Named fields in brackets.
    Fields(&'static [FieldEntry]),
    /// One of several words, some with fields or a value in brackets.
    Variants(&'static [VariantEntry]),
    /// A number, a color, or another value without named parts.
    Plain(Notation),
}

/// The notation of a value without named parts.
#[derive(Clone, Copy, Debug)]
pub struct Notation {
    /// Reports the mistakes in a value.
    pub(super) check: fn(&Node<'_>, &mut Checker<'_>),
    /// The form of the value.
    pub(super) form: Form,
    /// Checks that a value of this form belongs to the type.
    pub(super) read: fn(&Data) -> Result<(), String>,
}

/// The form of a value without named parts.
#[derive(Clone, Copy, Debug)]
pub(super) enum Form {
    /// `true` or `false`.
    Bool,
    /// A whole number.
    Whole,
    /// A number.
    Number,
    /// A string.
    Text,
    /// Any of the above, or a bracketed list of values of the type that the function returns.
    Any(fn() -> ValueType),
}

/// The declaration of a field.
#[derive(Clone, Copy, Debug)]
pub struct FieldEntry {
    /// The name.
    pub name: &'static str,
    /// The lines of the doc comment: meaning, unit, range and default.
    pub doc: &'static str,
    /// Returns the type of its value.
    pub value_type: fn() -> ValueType,
    /// Whether it may be omitted: its declaration gives a default, or its type is an `Option`.
    pub is_optional: bool,
    /// Whether `None` and `Some(…)` are accepted, because its type is an `Option`.
    pub accepts_none: bool,
}

/// The declaration of a variant.
///
/// A variant has no brackets, brackets with fields, or brackets with one value: `fields` and
/// `value_type` are never both set.
#[derive(Clone, Copy, Debug)]
pub struct VariantEntry {
    /// The name.
    pub name: &'static str,
    /// The lines of the doc comment.
    pub doc: &'static str,
    /// The fields in its brackets.
    pub fields: &'static [FieldEntry],
    /// Returns the type of the value in its brackets, if the variant has one.
    pub value_type: Option<fn() -> ValueType>,
}

impl TypeEntry {
    /// Returns the index of a variant, for formats without names, or 0 if there is no such variant.
    pub(super) fn variant_index(&self, name: &str) -> u32 {
        let Shape::Variants(variants) = self.shape else { return 0 };
        variants.iter().position(|variant| variant.name == name).unwrap_or(0) as u32
    }

    /// Returns the documentation of the type.
    #[must_use]
    pub fn about(&self) -> String {
        join_doc_lines(self.doc)
    }
}

impl FieldEntry {
    /// Returns the documentation of the field.
    #[must_use]
    pub fn about(&self) -> String {
        join_doc_lines(self.doc)
    }
}

impl VariantEntry {
    /// Whether it is written with brackets.
    pub(super) fn has_brackets(&self) -> bool {
        self.value_type.is_some() || !self.fields.is_empty()
    }

    /// Returns the documentation of the variant.
    #[must_use]
    pub fn about(&self) -> String {
        join_doc_lines(self.doc)
    }
}
