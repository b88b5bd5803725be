//! Values without declared parts: numbers with bounds, strings, lists, tuples, and optional values.

use super::{Checker, Notation, SceneValue, SerdeRef, SerdeValue, ValueType};
use core::fmt;
use core::marker::PhantomData;
use serde::de::{Deserialize, Deserializer, Error as _, IgnoredAny, SeqAccess, Visitor};
use serde::ser::{SerializeTuple as _, Serializer};

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
                    shape: $crate::scene::schema::Shape::Plain($crate::scene::schema::Notation(
                        |node, checker| checker.check_number(node, $expected, Self::new),
                    )),
                };
        }

        impl $crate::scene::schema::SceneValue for $name {
            fn value_type() -> $crate::scene::schema::ValueType {
                $crate::scene::schema::ValueType::Declared(
                    <Self as $crate::scene::schema::Declared>::ENTRY,
                )
            }

            fn read<'de, D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                let value: f64 = serde::Deserialize::deserialize(deserializer)?;
                Self::try_from(value).map_err(serde::de::Error::custom)
            }

            fn write<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                $crate::scene::schema::write_number(self.0, serializer)
            }
        }

        impl TryFrom<f64> for $name {
            type Error = $crate::scene::number::InvalidNumber;

            fn try_from(value: f64) -> Result<Self, Self::Error> {
                Self::new(value).ok_or($crate::scene::number::InvalidNumber {
                    expected: $expected,
                    found: value,
                })
            }
        }

        $crate::scene::schema::serde_by_scene_value! { $name }
    };
}

pub(crate) use checked_number;

impl SceneValue for u32 {
    fn value_type() -> ValueType {
        ValueType::Plain("whole number", Notation(Checker::check_whole_number))
    }

    fn read<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        Self::deserialize(deserializer)
    }

    fn write<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_u32(*self)
    }
}

impl SceneValue for usize {
    fn value_type() -> ValueType {
        ValueType::Plain("whole number", Notation(Checker::check_whole_number))
    }

    fn read<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        u32::deserialize(deserializer).map(|value| value as Self)
    }

    fn write<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_u64(*self as u64)
    }
}

impl SceneValue for bool {
    fn value_type() -> ValueType {
        ValueType::Plain("true or false", Notation(Checker::check_bool))
    }

    fn read<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        Self::deserialize(deserializer)
    }

    fn write<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_bool(*self)
    }
}

impl SceneValue for String {
    fn value_type() -> ValueType {
        ValueType::Plain("string", Notation(Checker::check_string))
    }

    fn read<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        Self::deserialize(deserializer)
    }

    fn write<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self)
    }
}

impl<T: SceneValue> SceneValue for Option<T> {
    const IS_OPTIONAL: bool = true;

    fn value_type() -> ValueType {
        T::value_type()
    }

    fn read<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        Option::<SerdeValue<T>>::deserialize(deserializer).map(|value| value.map(|value| value.0))
    }

    fn write<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Some(value) => serializer.serialize_some(&SerdeRef(value)),
            None => serializer.serialize_none(),
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

    fn read<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let values = Vec::<SerdeValue<T>>::deserialize(deserializer)?;
        Ok(values.into_iter().map(|value| value.0).collect())
    }

    fn write<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(self.iter().map(SerdeRef))
    }
}

/// Implements [`SceneValue`] for a tuple of `$count` values.
macro_rules! tuple_value {
    ($count:literal: $($type:ident $index:tt),*) => {
        impl<$($type: SceneValue),*> SceneValue for ($($type,)*) {
            fn value_type() -> ValueType {
                ValueType::Tuple(vec![$($type::value_type()),*])
            }

            /// Brackets of either kind, where the format has two.
            fn read<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                struct Elements<$($type),*>(PhantomData<($($type,)*)>);
                impl<'de, $($type: SceneValue),*> Visitor<'de> for Elements<$($type),*> {
                    type Value = ($($type,)*);

                    fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
                        write!(formatter, "{} values in brackets", $count)
                    }

                    fn visit_seq<S: SeqAccess<'de>>(
                        self,
                        mut elements: S,
                    ) -> Result<Self::Value, S::Error> {
                        let values = ($(
                            elements
                                .next_element::<SerdeValue<$type>>()?
                                .ok_or_else(|| S::Error::invalid_length($index, &self))?
                                .0,
                        )*);
                        match elements.next_element::<IgnoredAny>()? {
                            Some(_) => Err(S::Error::invalid_length($count + 1, &self)),
                            None => Ok(values),
                        }
                    }
                }
                deserializer.deserialize_any(Elements(PhantomData))
            }

            fn write<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                let mut tuple = serializer.serialize_tuple($count)?;
                $(tuple.serialize_element(&SerdeRef(&self.$index))?;)*
                tuple.end()
            }
        }
    };
}

tuple_value!(2: T0 0, T1 1);
tuple_value!(3: T0 0, T1 1, T2 2);
tuple_value!(4: T0 0, T1 1, T2 2, T3 3);
