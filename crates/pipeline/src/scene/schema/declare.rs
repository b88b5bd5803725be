//! The macros that declare the types of scene files.
//!
//! ```text
//!  scene_struct!  struct with fields           scene_enum!   variants with fields or a value
//!  named_enum!    variants without anything    named_values! names for a foreign enum
//! ```
//! Doc comments are matched as `#[doc = "…"]` literals: rustdoc and the printed reference show one
//! text. The macros expand to absolute `$crate` paths, since they are used in many modules.

/// Joins the lines of a doc comment to paragraphs, with a blank line between them. Links to Rust's
/// items say nothing to the author of a scene: ``[`a`](b)`` and ``[`a`]`` become `` `a` ``.
#[must_use]
pub(super) fn join_doc_lines(doc: &str) -> String {
    let lines: Vec<&str> = doc.lines().map(str::trim).collect();
    let paragraphs = lines.split(|line| line.is_empty()).map(|lines| lines.join(" "));
    let paragraphs: Vec<String> = paragraphs.filter(|paragraph| !paragraph.is_empty()).collect();
    remove_links(&paragraphs.join("\n\n"))
}

/// Replaces links to Rust items by the text they show.
///
/// Quadratic input is impossible: every link is passed once. A bracket that is never closed ends
/// the search, and the rest of the text is kept without it.
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

/// Doc comments of a type, for the reference of the scene language. Without the feature `terminal`
/// nobody can ask for it.
macro_rules! documentation {
    ($($line:literal),* $(,)?) => {
        if cfg!(feature = "terminal") { concat!($($line),*) } else { "" }
    };
}

/// Declares a struct of scene files. `as "Name"` is its name in scene files; a field with `= value`
/// may be left out. If every field has a default, so has the struct.
///
/// The first rule matches structs whose fields all have defaults and adds `impl Default`; the
/// second matches any other; `@declare` is the common part. Fields are read in the order of their
/// declaration and all of them before the first `?`, so that every mistake in the struct is
/// reported.
macro_rules! scene_struct {
    (
        $(#[doc = $doc:literal])*
        $(#[derive($($derive:ident),* $(,)?)])?
        pub struct $name:ident as $shown:literal {
            $($(#[doc = $field_doc:literal])* pub $field:ident: $type:ty = $default:expr),* $(,)?
        }
    ) => {
        $crate::scene::schema::scene_struct! { @declare
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
        $crate::scene::schema::scene_struct! { @declare
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

        impl $crate::scene::schema::Declared for $name {
            const ENTRY: &'static $crate::scene::schema::TypeEntry =
                &$crate::scene::schema::TypeEntry {
                    name: $shown,
                    doc: $crate::scene::schema::documentation!($($doc, "\n"),*),
                    shape: $crate::scene::schema::Shape::Fields(&[
                        $($crate::scene::schema::field_entry!(
                            [$($field_doc)*] $field: $type $(= $default)?
                        )),*
                    ]),
                };
        }

        impl $crate::scene::schema::SceneValue for $name {
            fn value_type() -> $crate::scene::schema::ValueType {
                $crate::scene::schema::ValueType::Declared(
                    <Self as $crate::scene::schema::Declared>::ENTRY,
                )
            }

            fn from_node(
                node: &$crate::scene::syntax::Node<'_>,
                checker: &mut $crate::scene::schema::Checker<'_>,
            ) -> Option<Self> {
                let entry = <Self as $crate::scene::schema::Declared>::ENTRY;
                let fields = checker.open_struct(node, entry)?;
                $(let $field: Option<$type> = fields.read(
                    checker,
                    stringify!($field),
                    $crate::scene::schema::default_value!($type $(= $default)?),
                );)*
                Some(Self { $($field: $field?),* })
            }
        }
    };
}

/// Declares an enum of scene files, whose variants have no value, fields, or one value.
///
/// The generated reader calls `close_variant` on every path, whether or not the variant could be
/// read.
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

        impl $crate::scene::schema::Declared for $name {
            const ENTRY: &'static $crate::scene::schema::TypeEntry =
                &$crate::scene::schema::TypeEntry {
                    name: $shown,
                    doc: $crate::scene::schema::documentation!($($doc, "\n"),*),
                    shape: $crate::scene::schema::Shape::Variants(&[$(
                        $crate::scene::schema::VariantEntry {
                            name: stringify!($variant),
                            doc: $crate::scene::schema::documentation!($($variant_doc, "\n"),*),
                            fields: &[$($($crate::scene::schema::field_entry!(
                                [$($field_doc)*] $field: $type $(= $default)?
                            )),*)?],
                            value_type: $crate::scene::schema::inner_type!($($inner)?),
                        }
                    ),*]),
                };
        }

        impl $crate::scene::schema::SceneValue for $name {
            fn value_type() -> $crate::scene::schema::ValueType {
                $crate::scene::schema::ValueType::Declared(
                    <Self as $crate::scene::schema::Declared>::ENTRY,
                )
            }

            fn from_node(
                node: &$crate::scene::syntax::Node<'_>,
                checker: &mut $crate::scene::schema::Checker<'_>,
            ) -> Option<Self> {
                let entry = <Self as $crate::scene::schema::Declared>::ENTRY;
                let variant = checker.open_variant(node, entry)?;
                let value = match variant.name() {
                    $(stringify!($variant) => $crate::scene::schema::scene_variant!(
                        variant, checker, $name, $variant
                        $({ $($field: $type $(= $default)?),* })?
                        $(($inner))?
                    ),)*
                    _ => None,
                };
                checker.close_variant();
                value
            }
        }
    };
}

/// Makes the declaration of a field. With a default it is optional; without, its type decides.
macro_rules! field_entry {
    ([$($doc:literal)*] $field:ident: $type:ty = $default:expr) => {
        $crate::scene::schema::FieldEntry {
            name: stringify!($field),
            doc: $crate::scene::schema::documentation!($($doc, "\n"),*),
            value_type: <$type as $crate::scene::schema::SceneValue>::value_type,
            is_optional: true,
        }
    };
    ([$($doc:literal)*] $field:ident: $type:ty) => {
        $crate::scene::schema::FieldEntry {
            name: stringify!($field),
            doc: $crate::scene::schema::documentation!($($doc, "\n"),*),
            value_type: <$type as $crate::scene::schema::SceneValue>::value_type,
            is_optional: <$type as $crate::scene::schema::SceneValue>::IS_OPTIONAL,
        }
    };
}

/// Makes the function that returns the value of a field that is left out: the given default, or the
/// type's own answer, which is `None` for required fields.
macro_rules! default_value {
    ($type:ty = $default:expr) => {
        || -> Option<$type> { Some($default) }
    };
    ($type:ty) => {
        <$type as $crate::scene::schema::SceneValue>::when_absent
    };
}

/// Makes the optional type of the value in a variant's brackets.
macro_rules! inner_type {
    () => {
        None
    };
    ($inner:ty) => {
        Some(<$inner as $crate::scene::schema::SceneValue>::value_type)
    };
}

/// Reads the content of a variant: nothing, fields, or one value.
///
/// The labeled block replaces `?`, which would return from the whole reader before the variant is
/// closed.
macro_rules! scene_variant {
    ($read:ident, $checker:ident, $name:ident, $variant:ident) => {
        $read.expect_empty($checker).then_some($name::$variant)
    };
    ($read:ident, $checker:ident, $name:ident, $variant:ident
        { $($field:ident: $type:ty $(= $default:expr)?),* }) => {
        'fields: {
            let Some(fields) = $read.open_fields($checker) else { break 'fields None };
            $(let $field: Option<$type> = fields.read(
                $checker,
                stringify!($field),
                $crate::scene::schema::default_value!($type $(= $default)?),
            );)*
            $(let Some($field) = $field else { break 'fields None };)*
            Some($name::$variant { $($field),* })
        }
    };
    ($read:ident, $checker:ident, $name:ident, $variant:ident ($inner:ty)) => {
        $read.read_inner::<$inner>($checker).map($name::$variant)
    };
}

pub(crate) use {default_value, documentation, field_entry, inner_type};
pub(crate) use {scene_enum, scene_struct, scene_variant};

/// Names the values of an enum without fields: implements `NamedOption`, and reads it from scene
/// files. Each summary is the entry of the value in the reference.
macro_rules! named_values {
    (
        $(#[doc = $doc:literal])*
        $name:ident as $shown:literal { $($variant:ident = $summary:literal),* $(,)? }
    ) => {
        impl $crate::scene::options::NamedOption for $name {
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

        impl $crate::scene::schema::Declared for $name {
            const ENTRY: &'static $crate::scene::schema::TypeEntry =
                &$crate::scene::schema::TypeEntry {
                    name: $shown,
                    doc: $crate::scene::schema::documentation!($($doc, "\n"),*),
                    shape: $crate::scene::schema::Shape::Variants(&[
                        $($crate::scene::schema::VariantEntry {
                            name: stringify!($variant),
                            doc: $summary,
                            fields: &[],
                            value_type: None,
                        }),*
                    ]),
                };
        }

        impl $crate::scene::schema::SceneValue for $name {
            fn value_type() -> $crate::scene::schema::ValueType {
                $crate::scene::schema::ValueType::Declared(
                    <Self as $crate::scene::schema::Declared>::ENTRY,
                )
            }

            fn from_node(
                node: &$crate::scene::syntax::Node<'_>,
                checker: &mut $crate::scene::schema::Checker<'_>,
            ) -> Option<Self> {
                let entry = <Self as $crate::scene::schema::Declared>::ENTRY;
                let variant = checker.open_variant(node, entry)?;
                let value = <Self as $crate::scene::options::NamedOption>::from_name(variant.name());
                let is_empty = variant.expect_empty(checker);
                checker.close_variant();
                value.filter(|_| is_empty)
            }
        }
    };
}

/// Declares an enum without fields whose values have names.
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

        $crate::scene::schema::named_values! {
            $(#[doc = $doc])*
            $name as $shown { $($variant = $summary),* }
        }
    };
}

pub(crate) use {named_enum, named_values};
