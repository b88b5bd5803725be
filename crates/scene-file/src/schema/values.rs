//! Values without declared parts: bounded numbers, strings, lists, tuples and optional values.

use super::{Checker, Data, Form, Notation, SceneValue, ValueType};

/// Declares a number type that allows only some values, which `$expected` describes in messages.
///
/// The number is finite and satisfies `$allowed`. Each range has its own type, so that resolution
/// needs no checks. The doc comment is the entry in the reference.
macro_rules! checked_number {
    ($(#[doc = $doc:literal])* $name:ident, $expected:literal, $allowed:expr) => {
        $(#[doc = $doc])*
        #[derive(Clone, Copy, PartialEq, Debug)]
        pub struct $name(f64);

        impl $name {
            /// Returns the number itself.
            #[must_use]
            pub const fn value(self) -> f64 {
                self.0
            }

            /// Checks a number; returns `None` if `value` is not allowed.
            #[must_use]
            pub fn new(value: f64) -> Option<Self> {
                let allowed: fn(f64) -> bool = $allowed;
                (value.is_finite() && allowed(value)).then_some(Self(value))
            }
        }

        impl $crate::schema::Declared for $name {
            const ENTRY: &'static $crate::schema::TypeEntry =
                &$crate::schema::TypeEntry {
                    name: stringify!($name),
                    doc: concat!($($doc, "\n"),*),
                    shape: $crate::schema::Shape::Plain($crate::schema::Notation {
                        check: |node, checker| checker.check_number(node, $expected, Self::new),
                        form: $crate::schema::Form::Number,
                        read: $crate::schema::read_plain::<Self>,
                    }),
                };
        }

        impl $crate::schema::SceneValue for $name {
            fn value_type() -> $crate::schema::ValueType {
                $crate::schema::ValueType::Declared(
                    <Self as $crate::schema::Declared>::ENTRY,
                )
            }

            fn from_data(data: &$crate::schema::Data) -> Result<Self, String> {
                let value = data.number().ok_or_else(|| format!("expected {}", $expected))?;
                Self::try_from(value).map_err(|error| error.to_string())
            }

            fn to_data(&self) -> $crate::schema::Data {
                $crate::schema::Data::Number(self.0)
            }
        }

        impl TryFrom<f64> for $name {
            type Error = $crate::number::InvalidNumber;

            fn try_from(value: f64) -> Result<Self, Self::Error> {
                Self::new(value).ok_or($crate::number::InvalidNumber {
                    expected: $expected,
                    found: value,
                })
            }
        }

        $crate::schema::serde_by_scene_value! { $name }
    };
}

pub(crate) use checked_number;

/// Implements [`SceneValue`] for a Rust type, given its name in words, its check and its form.
macro_rules! plain_value {
    ($type:ty, $words:literal, $check:ident, $form:ident($value:ident) => $read:expr, $write:expr) => {
        impl SceneValue for $type {
            fn value_type() -> ValueType {
                let check = Checker::$check;
                let notation = Notation { check, form: Form::$form, read: read_plain::<Self> };
                ValueType::Plain($words, notation)
            }

            fn from_data(data: &Data) -> Result<Self, String> {
                match data {
                    Data::$form($value) => $read,
                    _ => Err(concat!("expected ", $words).to_owned()),
                }
            }

            fn to_data(&self) -> Data {
                let $value = self;
                Data::$form($write)
            }
        }
    };
}

/// Checks that a value without parts can be read.
pub(crate) fn read_plain<T: SceneValue>(data: &Data) -> Result<(), String> {
    T::from_data(data).map(drop)
}

/// Converts a whole number to a smaller type.
fn small_number<T: TryFrom<u64>>(number: u64) -> Result<T, String> {
    T::try_from(number).map_err(|_| format!("the number {number} is too large"))
}

plain_value!(u32, "whole number", check_whole_number, Whole(n) => small_number(*n), u64::from(*n));
plain_value!(usize, "whole number", check_whole_number, Whole(n) => small_number(*n), *n as u64);
plain_value!(bool, "true or false", check_bool, Bool(value) => Ok(*value), *value);
plain_value!(String, "string", check_string, Text(text) => Ok(text.clone()), text.clone());

impl<T: SceneValue> SceneValue for Option<T> {
    const IS_OPTIONAL: bool = true;

    fn value_type() -> ValueType {
        T::value_type()
    }

    fn from_data(data: &Data) -> Result<Self, String> {
        match data {
            Data::None => Ok(None),
            value => T::from_data(value).map(Some),
        }
    }

    fn to_data(&self) -> Data {
        self.as_ref().map_or(Data::None, T::to_data)
    }

    fn when_absent() -> Option<Self> {
        Some(None)
    }
}

impl<T: SceneValue> SceneValue for Vec<T> {
    fn value_type() -> ValueType {
        ValueType::List(Box::new(T::value_type()))
    }

    fn from_data(data: &Data) -> Result<Self, String> {
        data.list().ok_or("expected a list")?.iter().map(T::from_data).collect()
    }

    fn to_data(&self) -> Data {
        Data::List(self.iter().map(T::to_data).collect())
    }
}

/// Implements [`SceneValue`] for a tuple of `$count` values.
macro_rules! tuple_value {
    ($count:literal: $($type:ident $index:tt),*) => {
        impl<$($type: SceneValue),*> SceneValue for ($($type,)*) {
            fn value_type() -> ValueType {
                ValueType::Tuple(vec![$($type::value_type()),*])
            }

            fn from_data(data: &Data) -> Result<Self, String> {
                match data.list() {
                    Some(values) if values.len() == $count => {
                        Ok(($($type::from_data(&values[$index])?,)*))
                    }
                    _ => Err(concat!("expected ", $count, " values in brackets").to_owned()),
                }
            }

            fn to_data(&self) -> Data {
                Data::Tuple(vec![$(self.$index.to_data()),*])
            }
        }
    };
}

tuple_value!(2: T0 0, T1 1);
tuple_value!(3: T0 0, T1 1, T2 2);
tuple_value!(4: T0 0, T1 1, T2 2, T3 3);
