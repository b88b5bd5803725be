//! Values without declared parts: numbers with bounds, strings, lists, tuples, and optional values.
//!
//! Each implementation of [`SceneValue`] accepts what RON's own reader accepts for the Rust type,
//! with the extensions `implicit_some`, `unwrap_newtypes` and `unwrap_variant_newtypes` always on,
//! so that a scene needs no attribute at its top.

use super::{Checker, SceneValue, ValueType};
use crate::scene::syntax::{Node, NodeKind, parse_integer, parse_number, unescape_string};

/// Declares a number type that only admits some values. `"…"` names them in messages.
///
/// The number is finite and satisfies `$allowed`; the type is a new one for each range, so that
/// resolution needs no checks. The doc comment is the entry in the reference.
macro_rules! checked_number {
    ($(#[doc = $doc:literal])* $name:ident, $expected:literal, $allowed:expr) => {
        $(#[doc = $doc])*
        #[derive(Clone, Copy, PartialEq, Debug)]
        pub struct $name(f64);

        impl $name {
            /// The number itself.
            #[must_use]
            pub const fn value(self) -> f64 {
                self.0
            }

            /// A checked number; `None` if `value` is not one of those that are allowed.
            #[must_use]
            pub fn new(value: f64) -> Option<Self> {
                let allowed: fn(f64) -> bool = $allowed;
                (value.is_finite() && allowed(value)).then_some(Self(value))
            }
        }

        impl $crate::scene::schema::Declared for $name {
            const ENTRY: &'static $crate::scene::schema::TypeEntry =
                &$crate::scene::schema::TypeEntry {
                    name: stringify!($name),
                    doc: concat!($($doc, "\n"),*),
                    shape: $crate::scene::schema::Shape::Plain,
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
                let value = checker.read_number(node, $expected)?;
                let number = Self::new(value);
                if number.is_none() {
                    checker.report_value(node, &format!("expected {}, found {value}", $expected), None);
                }
                number
            }
        }
    };
}

pub(crate) use checked_number;

impl Checker<'_> {
    /// A number of any value; `expected` names the numbers that are possible.
    ///
    /// A number in quotation marks gets a help of its own. Infinities and NaN parse here and are
    /// refused by the range.
    pub(in crate::scene) fn read_number(&mut self, node: &Node<'_>, expected: &str) -> Option<f64> {
        if let NodeKind::Number(word) = node.kind {
            let number = parse_number(word);
            if number.is_none() {
                let help = self.suggest_fraction(word, expected);
                let help =
                    help.unwrap_or_else(|| "numbers are written like 4, -1.5 or 2e-3".to_owned());
                self.report_type(node, expected, Some(help));
            }
            return number;
        }
        let help = match node.kind {
            NodeKind::String(_) => "numbers are written without quotation marks, such as 1.5",
            _ => "numbers are written like 4, -1.5 or 2e-3",
        };
        self.report_type(node, expected, Some(help.to_owned()));
        None
    }

    /// For a number of percent what is written here: without the sign, or as a fraction.
    fn suggest_fraction(&self, word: &str, expected: &str) -> Option<String> {
        let percent = word.strip_suffix('%')?;
        let number = parse_number(percent)?;
        if self.innermost_field()?.ends_with("_percent") {
            return Some(format!("write {percent}"));
        }
        let is_fraction = expected == "a number from 0 to 1";
        is_fraction.then(|| format!("write {}", number / 100.0))
    }

    /// A whole number from 0 to `most`.
    ///
    /// Decimal, hexadecimal, octal and binary, with underscores, as in RON. `4.0` is refused with
    /// the hint to leave out the decimal point.
    fn read_integer(&mut self, node: &Node<'_>, most: u64) -> Option<u64> {
        let help = || Some("such as 4".to_owned());
        let NodeKind::Number(word) = node.kind else {
            self.report_type(node, "a whole number", help());
            return None;
        };
        let Some(value) = parse_integer(word) else {
            self.report_type(
                node,
                "a whole number",
                Some("such as 4, without a decimal point".to_owned()),
            );
            return None;
        };
        let value = u64::try_from(value).ok().filter(|value| *value <= most);
        if value.is_none() {
            self.report_type(node, &format!("a whole number from 0 to {most}"), help());
        }
        value
    }
}

impl SceneValue for u32 {
    fn value_type() -> ValueType {
        ValueType::Plain("whole number")
    }

    fn from_node(node: &Node<'_>, checker: &mut Checker<'_>) -> Option<Self> {
        checker.read_integer(node, Self::MAX.into()).and_then(|value| value.try_into().ok())
    }
}

impl SceneValue for usize {
    fn value_type() -> ValueType {
        ValueType::Plain("whole number")
    }

    fn from_node(node: &Node<'_>, checker: &mut Checker<'_>) -> Option<Self> {
        checker.read_integer(node, u32::MAX.into()).and_then(|value| value.try_into().ok())
    }
}

impl SceneValue for bool {
    fn value_type() -> ValueType {
        ValueType::Plain("true or false")
    }

    fn from_node(node: &Node<'_>, checker: &mut Checker<'_>) -> Option<Self> {
        match node.kind {
            NodeKind::Word("true") => Some(true),
            NodeKind::Word("false") => Some(false),
            _ => {
                checker.report_type(node, "true or false", None);
                None
            }
        }
    }
}

impl SceneValue for String {
    fn value_type() -> ValueType {
        ValueType::Plain("string")
    }

    fn from_node(node: &Node<'_>, checker: &mut Checker<'_>) -> Option<Self> {
        let NodeKind::String(literal) = node.kind else {
            let written = match node.kind {
                NodeKind::Word(word) | NodeKind::Number(word) => word,
                _ => "like this",
            };
            let help = format!("strings are written in quotation marks: \"{written}\"");
            checker.report_type(node, "a string", Some(help));
            return None;
        };
        match unescape_string(literal) {
            Ok(text) => Some(text),
            Err((offset, problem)) => {
                let start = node.span.start + offset;
                let help = "a raw string has no escapes: r\"C:\\path\"".to_owned();
                checker.report(start..start + 1, problem, Some(help));
                None
            }
        }
    }
}

impl<T: SceneValue> SceneValue for Option<T> {
    const IS_OPTIONAL: bool = true;

    fn value_type() -> ValueType {
        T::value_type()
    }

    /// `value`, `Some(value)` or `None`.
    fn from_node(node: &Node<'_>, checker: &mut Checker<'_>) -> Option<Self> {
        match &node.kind {
            NodeKind::Word("None") => Some(None),
            NodeKind::Group(group)
                if group.name.as_ref().is_some_and(|name| name.name == "Some") =>
            {
                group.items.first().and_then(|item| T::from_node(&item.value, checker)).map(Some)
            }
            _ => T::from_node(node, checker).map(Some),
        }
    }

    fn when_absent() -> Option<Self> {
        Some(None)
    }
}

impl<T: SceneValue> SceneValue for Vec<T> {
    fn value_type() -> ValueType {
        ValueType::List(Box::new(T::value_type()))
    }

    fn from_node(node: &Node<'_>, checker: &mut Checker<'_>) -> Option<Self> {
        checker.read_list_value(node)
    }
}

/// A value that is no tuple, as one: `"320x240"` and `"1:20"` as their numbers, and one number in
/// the place of two.
fn suggest_tuple(node: &Node<'_>, count: usize, checker: &Checker<'_>) -> Option<String> {
    let parts: Vec<&str> = match node.kind {
        NodeKind::String(text) => {
            text.trim_matches('"').split(['x', '×', ':', ',', '/', '*']).map(str::trim).collect()
        }
        NodeKind::Number(number) if count == 2 => match checker.innermost_field() {
            Some("scale") => vec!["1", number],
            _ => vec![number, number],
        },
        _ if count == 4 => {
            return Some("such as (0, 0, 0.5, 0.5): left, top, width and height".to_owned());
        }
        _ => return None,
    };
    let is_number = |part: &&str| parse_number(part).is_some();
    let fits = parts.len() == count && parts.iter().all(is_number);
    fits.then(|| format!("write ({})", parts.join(", ")))
}

impl Checker<'_> {
    /// For counts and steps of a grid along two axes only, those along all three.
    pub(in crate::scene) fn suggest_three_axes(
        &self,
        group: &crate::scene::syntax::Group<'_>,
    ) -> Option<String> {
        let [x, z] = group.items.as_slice() else { return None };
        let (NodeKind::Number(x), NodeKind::Number(z)) = (&x.value.kind, &z.value.kind) else {
            return None;
        };
        let height = match self.innermost_field()? {
            "count" => "1",
            "step" => "0",
            _ => return None,
        };
        Some(format!("along x, y and z, and y is up; on the ground write ({x}, {height}, {z})"))
    }
}

/// The elements of a tuple of `count` values, in brackets of either kind.
///
/// Round and square brackets are both accepted, since vectors are written either way by hand; a
/// name before the bracket is not.
fn tuple_items<'n, 'a>(
    node: &'n Node<'a>,
    count: usize,
    checker: &mut Checker<'_>,
) -> Option<&'n [crate::scene::syntax::SyntaxItem<'a>]> {
    let group = node.group().filter(|group| group.name.is_none() && group.open != '{');
    let expected = format!("{count} values in brackets");
    let Some(group) = group else {
        checker.report_type(node, &expected, suggest_tuple(node, count, checker));
        return None;
    };
    if group.items.len() != count {
        let problem = format!("expected {expected}, found {}", group.items.len());
        let help = checker.suggest_three_axes(group);
        checker.report_value(node, &problem, help);
        return None;
    }
    Some(&group.items)
}

/// Implements [`SceneValue`] for a tuple of `$count` values. All elements are read before the first
/// missing one ends it, so that each mistake is reported.
macro_rules! tuple_value {
    ($count:literal: $($type:ident $value:ident $index:literal),*) => {
        impl<$($type: SceneValue),*> SceneValue for ($($type,)*) {
            fn value_type() -> ValueType {
                ValueType::Tuple(vec![$($type::value_type()),*])
            }

            fn from_node(node: &Node<'_>, checker: &mut Checker<'_>) -> Option<Self> {
                let items = tuple_items(node, $count, checker)?;
                $(let $value = checker.read_element::<$type>($index, &items[$index]);)*
                Some(($($value?,)*))
            }
        }
    };
}

tuple_value!(2: A a 0, B b 1);
tuple_value!(3: A a 0, B b 1, C c 2);
tuple_value!(4: A a 0, B b 1, C c 2, D d 3);
