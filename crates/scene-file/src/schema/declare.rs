//! The macros that declare the types of scene files.
//!
//! ```text
//!  scene_struct!  struct with fields           scene_enum!   variants with fields or a value
//!  named_enum!    variants without fields      named_values! names for a foreign enum
//! ```
//! Doc comments are matched as `#[doc = "…"]` literals, so that rustdoc and the printed reference
//! show the same text. The macros expand to absolute `$crate` paths, for use in many modules.

/// Joins the lines of a doc comment into paragraphs, with a blank line between them. Links to Rust
/// items mean nothing to scene authors, so ``[`a`](b)`` and ``[`a`]`` become `` `a` ``.
#[must_use]
pub(super) fn join_doc_lines(doc: &str) -> String {
    let lines: Vec<&str> = doc.lines().map(str::trim).collect();
    let paragraphs = lines.split(|line| line.is_empty()).map(|lines| lines.join(" "));
    let paragraphs: Vec<String> = paragraphs.filter(|paragraph| !paragraph.is_empty()).collect();
    remove_links(&paragraphs.join("\n\n"))
}

/// Replaces links to Rust items with the text they show.
///
/// The time is linear, because every link is visited once. An unclosed bracket is dropped and ends
/// the search; the rest of the text is kept.
fn remove_links(text: &str) -> String {
    let mut plain = String::new();
    let mut rest = text;
    while let Some((before, link)) = rest.split_once("[`") {
        plain.push_str(before);
        let Some((name, after)) = link.split_once("`]") else {
            rest = link;
            break;
        };
        plain.push_str(&format!("`{name}`"));
        let target = after.strip_prefix('(').and_then(|target| target.split_once(')'));
        rest = target.map_or(after, |(_, after)| after);
    }
    plain + rest
}

/// Joins doc comments for the reference of the scene language. Without the feature `terminal`,
/// which prints it, the result is empty.
macro_rules! documentation {
    ($($line:literal),* $(,)?) => {
        if cfg!(feature = "terminal") { concat!($($line),*) } else { "" }
    };
}

/// Declares a scene file struct. `as "Name"` is its name in scene files; a field with `= value` may
/// be omitted. If every field has a default, so does the struct.
///
/// The first rule matches structs whose fields all have defaults and adds `impl Default`. The
/// second matches any other struct. `@declare` is their common part.
macro_rules! scene_struct {
    (
        $(#[doc = $doc:literal])*
        $(#[derive($($derive:ident),* $(,)?)])?
        pub struct $name:ident as $shown:literal {
            $($(#[doc = $field_doc:literal])* pub $field:ident: $type:ty = $default:expr),* $(,)?
        }
    ) => {
        $crate::schema::scene_struct! { @declare
            $(#[doc = $doc])*
            $(#[derive($($derive),*)])?
            pub struct $name as $shown {
                $($(#[doc = $field_doc])* pub $field: $type = $default),*
            }
        }

        impl Default for $name {
            fn default() -> Self {
                Self { $($field: $default),* }
            }
        }
    };
    (
        $(#[doc = $doc:literal])*
        $(#[derive($($derive:ident),* $(,)?)])?
        pub struct $name:ident as $shown:literal { $($fields:tt)* }
    ) => {
        $crate::schema::scene_struct! { @declare
            $(#[doc = $doc])*
            $(#[derive($($derive),*)])?
            pub struct $name as $shown { $($fields)* }
        }
    };
    (@declare
        $(#[doc = $doc:literal])*
        $(#[derive($($derive:ident),* $(,)?)])?
        pub struct $name:ident as $shown:literal {
            $($(#[doc = $field_doc:literal])* pub $field:ident: $type:ty $(= $default:expr)?),* $(,)?
        }
    ) => {
        $(#[doc = $doc])*
        #[derive(Clone, PartialEq, Debug $($(, $derive)*)?)]
        pub struct $name {
            $($(#[doc = $field_doc])* pub $field: $type,)*
        }

        impl $crate::schema::Declared for $name {
            const ENTRY: &'static $crate::schema::TypeEntry =
                &$crate::schema::TypeEntry {
                    name: $shown,
                    doc: $crate::schema::documentation!($($doc, "\n"),*),
                    shape: $crate::schema::Shape::Fields(&[
                        $($crate::schema::field_entry!(
                            [$($field_doc)*] $field: $type $(= $default)?
                        )),*
                    ]),
                };
        }

        impl $crate::schema::SceneValue for $name {
            fn value_type() -> $crate::schema::ValueType {
                $crate::schema::ValueType::Declared(
                    <Self as $crate::schema::Declared>::ENTRY,
                )
            }

            fn from_data(data: &$crate::schema::Data) -> Result<Self, String> {
                $crate::schema::read_fields!(
                    data, $name; $($field: $type $(= $default)?),*
                )
            }

            fn to_data(&self) -> $crate::schema::Data {
                let Self { $($field),* } = self;
                $crate::schema::write_fields!($($field: $type $(= $default)?),*)
            }
        }

        $crate::schema::serde_by_scene_value! { $name }
    };
}

/// Declares a scene file enum. Its variants may have fields, one value, or neither.
macro_rules! scene_enum {
    (
        $(#[doc = $doc:literal])*
        $(#[derive($($derive:ident),* $(,)?)])?
        pub enum $name:ident as $shown:literal {
            $(
                $(#[doc = $variant_doc:literal])*
                $variant:ident
                $({ $($(#[doc = $field_doc:literal])* $field:ident: $type:ty $(= $default:expr)?),* $(,)? })?
                $(($inner:ty))?
            ),* $(,)?
        }
    ) => {
        $(#[doc = $doc])*
        #[derive(Clone, PartialEq, Debug $($(, $derive)*)?)]
        pub enum $name {
            $(
                $(#[doc = $variant_doc])*
                $variant
                $({ $($(#[doc = $field_doc])* $field: $type,)* })?
                $(($inner))?,
            )*
        }

        impl $crate::schema::Declared for $name {
            const ENTRY: &'static $crate::schema::TypeEntry =
                &$crate::schema::TypeEntry {
                    name: $shown,
                    doc: $crate::schema::documentation!($($doc, "\n"),*),
                    shape: $crate::schema::Shape::Variants(&[$(
                        $crate::schema::VariantEntry {
                            name: stringify!($variant),
                            doc: $crate::schema::documentation!($($variant_doc, "\n"),*),
                            fields: &[$($($crate::schema::field_entry!(
                                [$($field_doc)*] $field: $type $(= $default)?
                            )),*)?],
                            value_type: $crate::schema::inner_type!($($inner)?),
                        }
                    ),*]),
                };
        }

        impl $crate::schema::SceneValue for $name {
            fn value_type() -> $crate::schema::ValueType {
                $crate::schema::ValueType::Declared(
                    <Self as $crate::schema::Declared>::ENTRY,
                )
            }

            fn from_data(data: &$crate::schema::Data) -> Result<Self, String> {
                match data.variant() {
                    $((stringify!($variant), value) => $crate::schema::read_variant!(
                        value, $name, $variant
                        $({ $($field: $type $(= $default)?),* })?
                        $(($inner))?
                    ),)*
                    (name, _) => Err(format!("`{name}` is not a variant of {}", $shown)),
                }
            }

            fn to_data(&self) -> $crate::schema::Data {
                match self {$(
                    Self::$variant
                    $({ $($field),* })?
                    $(($crate::schema::variant_value!(value, $inner)))?
                    => $crate::schema::Data::of_variant(
                        stringify!($variant),
                        $crate::schema::write_variant!(
                            value $({ $($field: $type $(= $default)?),* })? $(($inner))?
                        ),
                    )
                ),*}
            }
        }

        $crate::schema::serde_by_scene_value! { $name }
    };
}

/// Builds the declaration of a field. A field with a default is optional; any other field is
/// optional if its type is.
macro_rules! field_entry {
    ([$($doc:literal)*] $field:ident: $type:ty = $default:expr) => {
        $crate::schema::FieldEntry {
            name: stringify!($field),
            doc: $crate::schema::documentation!($($doc, "\n"),*),
            value_type: <$type as $crate::schema::SceneValue>::value_type,
            is_optional: true,
            accepts_none: <$type as $crate::schema::SceneValue>::IS_OPTIONAL,
        }
    };
    ([$($doc:literal)*] $field:ident: $type:ty) => {
        $crate::schema::FieldEntry {
            name: stringify!($field),
            doc: $crate::schema::documentation!($($doc, "\n"),*),
            value_type: <$type as $crate::schema::SceneValue>::value_type,
            is_optional: <$type as $crate::schema::SceneValue>::IS_OPTIONAL,
            accepts_none: <$type as $crate::schema::SceneValue>::IS_OPTIONAL,
        }
    };
}

/// Builds the function that returns the value of an omitted field: the declared default, or else
/// the type's default, which is `None` for required fields.
macro_rules! default_value {
    ($type:ty = $default:expr) => {
        || -> Option<$type> { Some($default) }
    };
    ($type:ty) => {
        <$type as $crate::schema::SceneValue>::when_absent
    };
}

/// Builds the optional type of the value in a variant's brackets.
macro_rules! inner_type {
    () => {
        None
    };
    ($inner:ty) => {
        Some(<$inner as $crate::schema::SceneValue>::value_type)
    };
}

/// Expands to the name that a pattern binds to the value in a variant's brackets.
macro_rules! variant_value {
    ($value:ident, $inner:ty) => {
        $value
    };
}

/// Reads the fields of a struct or a variant.
macro_rules! read_fields {
    ($data:ident, $($name:ident)::+; $($field:ident: $type:ty $(= $default:expr)?),*) => {
        Ok($($name)::+ {
            $($field: $data.field(
                stringify!($field),
                $crate::schema::default_value!($type $(= $default)?),
            )?),*
        })
    };
}

/// Reads a variant: its fields, its value, or nothing after its name.
macro_rules! read_variant {
    ($data:ident, $name:ident, $variant:ident) => {{
        let _ = $data;
        Ok($name::$variant)
    }};
    ($data:ident, $name:ident, $variant:ident { $($fields:tt)* }) => {
        $crate::schema::read_fields!($data, $name::$variant; $($fields)*)
    };
    ($data:ident, $name:ident, $variant:ident ($inner:ty)) => {
        <$inner as $crate::schema::SceneValue>::from_data($data).map($name::$variant)
    };
}

/// Writes the fields bound to variables, omitting those with default values.
macro_rules! write_fields {
    ($($field:ident: $type:ty $(= $default:expr)?),*) => {{
        let mut fields = Vec::new();
        $($crate::schema::push_field(
            &mut fields,
            stringify!($field),
            $field,
            $crate::schema::default_value!($type $(= $default)?),
        );)*
        $crate::schema::Data::Fields(fields)
    }};
}

/// Writes the fields or the value of a variant, after its name.
macro_rules! write_variant {
    ($value:ident) => {
        $crate::schema::Data::None
    };
    ($value:ident { $($fields:tt)* }) => {
        $crate::schema::write_fields!($($fields)*)
    };
    ($value:ident ($inner:ty)) => {
        $crate::schema::SceneValue::to_data($value)
    };
}

pub(crate) use {default_value, documentation, field_entry, inner_type};
pub(crate) use {read_fields, read_variant, scene_enum, scene_struct};
pub(crate) use {variant_value, write_fields, write_variant};

/// Names the values of an enum without fields: implements `NamedOption`, and reads and writes them
/// in scene files. Each summary is the value's entry in the reference.
macro_rules! named_values {
    (
        $(#[doc = $doc:literal])*
        $name:ident as $shown:literal { $($variant:ident = $summary:literal),* $(,)? }
    ) => {
        impl $crate::options::NamedOption for $name {
            const TYPE_NAME: &'static str = $shown;
            const ALL: &'static [Self] = &[$(Self::$variant),*];

            fn name(self) -> &'static str {
                match self {
                    $(Self::$variant => stringify!($variant),)*
                }
            }

            fn summary(self) -> &'static str {
                match self {
                    $(Self::$variant => $summary,)*
                }
            }
        }

        impl $crate::schema::Declared for $name {
            const ENTRY: &'static $crate::schema::TypeEntry =
                &$crate::schema::TypeEntry {
                    name: $shown,
                    doc: $crate::schema::documentation!($($doc, "\n"),*),
                    shape: $crate::schema::Shape::Variants(&[
                        $($crate::schema::VariantEntry {
                            name: stringify!($variant),
                            doc: $summary,
                            fields: &[],
                            value_type: None,
                        }),*
                    ]),
                };
        }

        impl $crate::schema::SceneValue for $name {
            fn value_type() -> $crate::schema::ValueType {
                $crate::schema::ValueType::Declared(
                    <Self as $crate::schema::Declared>::ENTRY,
                )
            }

            fn from_data(data: &$crate::schema::Data) -> Result<Self, String> {
                $crate::schema::read_named(data)
            }

            fn to_data(&self) -> $crate::schema::Data {
                $crate::schema::write_named(*self)
            }
        }
    };
}

/// Declares an enum without fields and names its values.
macro_rules! named_enum {
    (
        $(#[doc = $doc:literal])*
        pub enum $name:ident as $shown:literal { $($variant:ident = $summary:literal),* $(,)? }
    ) => {
        $(#[doc = $doc])*
        #[derive(Clone, Copy, PartialEq, Eq, Debug)]
        pub enum $name {
            $(#[doc = $summary] $variant,)*
        }

        $crate::schema::named_values! {
            $(#[doc = $doc])*
            $name as $shown { $($variant = $summary),* }
        }

        $crate::schema::serde_by_scene_value! { $name }
    };
}

pub(crate) use {named_enum, named_values};
