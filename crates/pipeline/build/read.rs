//! From Rust's declarations to what a scene file may say.

use syn::parse::{ParseStream, Parser};
use syn::punctuated::Punctuated;
use syn::{Attribute, Expr, Fields, GenericArgument, Item, Lit, Meta, PathArguments, Token, Type};

/// A type of scene files.
pub(crate) struct Described {
    /// Its name in Rust.
    pub(crate) ident: String,
    /// Its name in RON and in messages.
    pub(crate) name: String,
    pub(crate) about: String,
    pub(crate) shape: Shape,
}

/// What a value of a type looks like.
pub(crate) enum Shape {
    Fields(Vec<Field>),
    Variants(Vec<Variant>),
    /// A number, or a few, read by code of its own.
    Number,
}

pub(crate) struct Field {
    pub(crate) name: String,
    pub(crate) holds: Holds,
    pub(crate) optional: bool,
    pub(crate) about: String,
}

pub(crate) struct Variant {
    pub(crate) name: String,
    pub(crate) about: String,
    pub(crate) fields: Vec<Field>,
    /// The value in brackets of a variant without fields.
    pub(crate) holds: Option<Holds>,
}

/// What kind of value a field has.
#[derive(Clone)]
pub(crate) enum Holds {
    Words(&'static str),
    /// A type by its name in Rust.
    Named(String),
    List(Box<Self>),
    Tuple(Vec<Self>),
}

/// The types that are read from files, and the numbers.
pub(crate) fn types(items: &[Item]) -> Vec<Described> {
    items.iter().filter_map(described).collect()
}

fn described(item: &Item) -> Option<Described> {
    match item {
        Item::Struct(item) if derives_deserialize(&item.attrs) => {
            let defaulted = serde_words(&item.attrs).iter().any(|word| word == "default");
            let shape = Shape::Fields(fields(&item.fields, defaulted));
            Some(named(item.ident.to_string(), &item.attrs, shape))
        }
        Item::Enum(item) if derives_deserialize(&item.attrs) => {
            let shape = Shape::Variants(item.variants.iter().map(variant).collect());
            Some(named(item.ident.to_string(), &item.attrs, shape))
        }
        // Public structs beside them implement `Deserialize` by hand; so does what `checked_number!` makes.
        Item::Struct(item) if matches!(item.vis, syn::Visibility::Public(_)) => {
            Some(named(item.ident.to_string(), &item.attrs, Shape::Number))
        }
        Item::Macro(item) if item.mac.path.is_ident("checked_number") => {
            let head = |input: ParseStream<'_>| {
                let attributes = input.call(Attribute::parse_outer)?;
                let ident: syn::Ident = input.parse()?;
                let _: proc_macro2::TokenStream = input.parse()?;
                Ok(named(ident.to_string(), &attributes, Shape::Number))
            };
            head.parse2(item.mac.tokens.clone()).ok()
        }
        _ => None,
    }
}

fn named(ident: String, attributes: &[Attribute], shape: Shape) -> Described {
    let name = renamed(attributes).unwrap_or_else(|| ident.clone());
    Described { ident, name, about: docs(attributes), shape }
}

fn variant(variant: &syn::Variant) -> Variant {
    let holds = match &variant.fields {
        Fields::Unnamed(content) => content.unnamed.first().map(|field| holds(&field.ty).0),
        _ => None,
    };
    let name = renamed(&variant.attrs).unwrap_or_else(|| variant.ident.to_string());
    let fields = fields(&variant.fields, false);
    Variant { name, about: docs(&variant.attrs), fields, holds }
}

fn fields(fields: &Fields, defaulted: bool) -> Vec<Field> {
    let Fields::Named(fields) = fields else { return Vec::new() };
    let field = |field: &syn::Field| {
        let words = serde_words(&field.attrs);
        if words.iter().any(|word| word == "skip") {
            return None;
        }
        let (holds, option) = holds(&field.ty);
        let optional = option || defaulted || words.iter().any(|word| word == "default");
        let ident = field.ident.as_ref()?.to_string();
        let name = renamed(&field.attrs).unwrap_or(ident);
        Some(Field { name, holds, optional, about: docs(&field.attrs) })
    };
    fields.named.iter().filter_map(field).collect()
}

/// What a type of Rust holds, and whether it may be left out.
fn holds(of: &Type) -> (Holds, bool) {
    let path = match of {
        Type::Tuple(tuple) => {
            return (Holds::Tuple(tuple.elems.iter().map(|of| holds(of).0).collect()), false);
        }
        Type::Path(path) => &path.path,
        _ => return (Holds::Words("value"), false),
    };
    let Some(last) = path.segments.last() else { return (Holds::Words("value"), false) };
    let inner = || match &last.arguments {
        PathArguments::AngleBracketed(arguments) => arguments.args.iter().find_map(|argument| {
            if let GenericArgument::Type(of) = argument { Some(holds(of).0) } else { None }
        }),
        _ => None,
    };
    let ident = last.ident.to_string();
    let held = match (ident.as_str(), inner()) {
        ("Option", Some(inner)) => return (inner, true),
        ("Vec", Some(inner)) => Holds::List(Box::new(inner)),
        ("Box" | "Arc", Some(inner)) => inner,
        ("String", _) => Holds::Words("text"),
        ("bool", _) => Holds::Words("true or false"),
        ("u8" | "u16" | "u32" | "u64" | "usize", _) => Holds::Words("whole number"),
        ("f32" | "f64", _) => Holds::Words("number"),
        _ => Holds::Named(ident),
    };
    (held, false)
}

fn derives_deserialize(attributes: &[Attribute]) -> bool {
    attributes.iter().filter(|attribute| attribute.path().is_ident("derive")).any(|attribute| {
        let paths = attribute.parse_args_with(Punctuated::<syn::Path, Token![,]>::parse_terminated);
        paths.is_ok_and(|paths| {
            paths
                .iter()
                .filter_map(|path| path.segments.last())
                .any(|last| last.ident == "Deserialize")
        })
    })
}

/// What the `serde` attributes say.
fn serde_metas(attributes: &[Attribute]) -> Vec<Meta> {
    let serde = attributes.iter().filter(|attribute| attribute.path().is_ident("serde"));
    let metas = serde.filter_map(|attribute| {
        attribute.parse_args_with(Punctuated::<Meta, Token![,]>::parse_terminated).ok()
    });
    metas.flatten().collect()
}

fn serde_words(attributes: &[Attribute]) -> Vec<String> {
    let metas = serde_metas(attributes);
    metas.iter().filter_map(|meta| meta.path().get_ident().map(ToString::to_string)).collect()
}

fn renamed(attributes: &[Attribute]) -> Option<String> {
    serde_metas(attributes).iter().find_map(|meta| match meta {
        Meta::NameValue(pair) if pair.path.is_ident("rename") => text(&pair.value),
        _ => None,
    })
}

/// The doc comment, its paragraphs parted by a blank line.
fn docs(attributes: &[Attribute]) -> String {
    let lines = attributes.iter().filter_map(|attribute| match &attribute.meta {
        Meta::NameValue(pair) if pair.path.is_ident("doc") => text(&pair.value),
        _ => None,
    });
    let lines: Vec<String> = lines.map(|line| line.trim().to_owned()).collect();
    let paragraphs = lines.split(String::is_empty).map(|paragraph| paragraph.join(" "));
    let told: Vec<String> = paragraphs.filter(|text| !text.is_empty()).collect();
    without_links(&told.join("\n\n"))
}

fn text(value: &Expr) -> Option<String> {
    match value {
        Expr::Lit(literal) => match &literal.lit {
            Lit::Str(text) => Some(text.value()),
            _ => None,
        },
        _ => None,
    }
}

/// Links to Rust's items say nothing to somebody who writes a scene: ``[`a`](b)`` and ``[`a`]`` become `` `a` ``.
fn without_links(text: &str) -> String {
    let mut plain = String::new();
    let mut rest = text;
    while let Some(start) = rest.find("[`") {
        plain.push_str(&rest[..start]);
        rest = &rest[start + 1..];
        let Some(end) = rest.find("`]") else { break };
        plain.push_str(&rest[..=end]);
        rest = &rest[end + 2..];
        if let Some(close) = rest.strip_prefix('(').and_then(|target| target.find(')')) {
            rest = &rest[close + 2..];
        }
    }
    plain + rest
}
