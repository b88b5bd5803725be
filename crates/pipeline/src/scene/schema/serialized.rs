//! Values of scene files in the data model of serde, for `ron` and every other format.
//!
//! ```text
//!  scene_struct! ─► impl Deserialize ─► SerdeField<T> ─► T::read     absent fields: their defaults
//!               └► impl Serialize   ─► SerdeRef<T>   ─► T::write    fields equal to them: left out
//! ```
//! Fields are read and written by [`SceneValue`] and not by serde's own traits, because the enums
//! of other crates have no implementation of those.

use super::SceneValue;
use crate::scene::options::NamedOption;
use core::fmt;
use core::marker::PhantomData;
use serde::de::{
    Deserialize, DeserializeSeed, Deserializer, EnumAccess, Error, MapAccess, SeqAccess,
    VariantAccess as _, Visitor,
};
use serde::ser::{Serialize, SerializeTuple as _, Serializer};

/// A value as serde reads it.
pub(crate) struct SerdeValue<T>(pub(crate) T);

impl<'de, T: SceneValue> Deserialize<'de> for SerdeValue<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        T::read(deserializer).map(Self)
    }
}

/// A value as serde writes it.
pub(crate) struct SerdeRef<'a, T>(pub(crate) &'a T);

impl<T: SceneValue> Serialize for SerdeRef<'_, T> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.0.write(serializer)
    }
}

/// A field, which may have been left out.
pub(crate) struct SerdeField<T>(Option<T>);

impl<T> Default for SerdeField<T> {
    fn default() -> Self {
        Self(None)
    }
}

impl<T: SceneValue> SerdeField<T> {
    /// Reads the value of the field.
    ///
    /// # Errors
    /// If it has one already.
    pub(crate) fn read<'de, A: MapAccess<'de>>(
        &mut self,
        name: &'static str,
        map: &mut A,
    ) -> Result<(), A::Error> {
        if self.0.is_some() {
            return Err(A::Error::duplicate_field(name));
        }
        self.0 = Some(map.next_value::<SerdeValue<T>>()?.0);
        Ok(())
    }
}

impl<T> SerdeField<T> {
    /// The value, or the one that the field has if it is left out.
    ///
    /// # Errors
    /// If there is neither: the field is required.
    pub(crate) fn or_default<E: Error>(
        self,
        name: &'static str,
        default: fn() -> Option<T>,
    ) -> Result<T, E> {
        self.0.or_else(default).ok_or_else(|| E::missing_field(name))
    }
}

/// The fields of a struct or a variant while they are read.
pub(crate) trait FieldSet: Default {
    /// Reads the value of one of its fields.
    fn read_field<'de, A: MapAccess<'de>>(
        &mut self,
        name: &'static str,
        map: &mut A,
    ) -> Result<(), A::Error>;
}

/// Reads fields in any order.
pub(crate) struct FieldSetVisitor<T> {
    names: &'static [&'static str],
    fields: PhantomData<T>,
}

impl<T> FieldSetVisitor<T> {
    pub(crate) fn new(names: &'static [&'static str]) -> Self {
        Self { names, fields: PhantomData }
    }
}

impl<'de, T: FieldSet> Visitor<'de> for FieldSetVisitor<T> {
    type Value = T;

    fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str("fields in brackets")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<T, A::Error> {
        let mut fields = T::default();
        while let Some(name) = map.next_key_seed(NameOf(self.names))? {
            fields.read_field(name, &mut map)?;
        }
        Ok(fields)
    }
}

/// Reads one of these names, or its index in formats without names. An unknown one is refused.
pub(crate) struct NameOf(pub(crate) &'static [&'static str]);

impl<'de> DeserializeSeed<'de> for NameOf {
    type Value = &'static str;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<&'static str, D::Error> {
        deserializer.deserialize_identifier(self)
    }
}

impl Visitor<'_> for NameOf {
    type Value = &'static str;

    fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str("the name of a field or of a variant")
    }

    fn visit_str<E: Error>(self, name: &str) -> Result<&'static str, E> {
        let known = self.0.iter().find(|known| **known == name);
        known.copied().ok_or_else(|| E::unknown_field(name, self.0))
    }

    fn visit_u64<E: Error>(self, index: u64) -> Result<&'static str, E> {
        let known = usize::try_from(index).ok().and_then(|index| self.0.get(index));
        known.copied().ok_or_else(|| E::custom("there is no field or variant of this index"))
    }
}

/// Whether a field is written: not if it has the value that it has when it is left out.
pub(crate) fn is_written<T: PartialEq>(value: &T, default: fn() -> Option<T>) -> bool {
    default().is_none_or(|default| default != *value)
}

/// A value that has several forms: the alternatives of a type's notation.
pub(in crate::scene) enum AnyForm<T> {
    /// `true` or `false`.
    Bool(bool),
    /// A number.
    Number(f64),
    /// A string.
    Text(String),
    /// Values in brackets.
    List(Vec<T>),
}

impl<'de, T: SceneValue> Deserialize<'de> for AnyForm<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(AnyVisitor(PhantomData))
    }
}

struct AnyVisitor<T>(PhantomData<T>);

impl<'de, T: SceneValue> Visitor<'de> for AnyVisitor<T> {
    type Value = AnyForm<T>;

    fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str("a value of a scene")
    }

    fn visit_bool<E: Error>(self, value: bool) -> Result<Self::Value, E> {
        Ok(AnyForm::Bool(value))
    }

    fn visit_i64<E: Error>(self, value: i64) -> Result<Self::Value, E> {
        Ok(AnyForm::Number(value as f64))
    }

    fn visit_u64<E: Error>(self, value: u64) -> Result<Self::Value, E> {
        Ok(AnyForm::Number(value as f64))
    }

    fn visit_f64<E: Error>(self, value: f64) -> Result<Self::Value, E> {
        Ok(AnyForm::Number(value))
    }

    fn visit_str<E: Error>(self, value: &str) -> Result<Self::Value, E> {
        Ok(AnyForm::Text(value.to_owned()))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut elements: A) -> Result<Self::Value, A::Error> {
        let mut list = Vec::new();
        while let Some(SerdeValue(element)) = elements.next_element()? {
            list.push(element);
        }
        Ok(AnyForm::List(list))
    }
}

/// Reads one of the names of an enum without fields.
pub(crate) fn read_named<'de, T: NamedOption, D: Deserializer<'de>>(
    deserializer: D,
    names: &'static [&'static str],
) -> Result<T, D::Error> {
    let name = deserializer.deserialize_enum(T::TYPE_NAME, names, UnitVariant(names))?;
    T::from_name(name).ok_or_else(|| D::Error::unknown_variant(name, names))
}

/// Reads a variant without fields, as its name.
struct UnitVariant(&'static [&'static str]);

impl<'de> Visitor<'de> for UnitVariant {
    type Value = &'static str;

    fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str("the name of a value")
    }

    fn visit_enum<A: EnumAccess<'de>>(self, data: A) -> Result<&'static str, A::Error> {
        let (name, variant) = data.variant_seed(NameOf(self.0))?;
        variant.unit_variant()?;
        Ok(name)
    }
}

/// Writes the name of a value.
pub(crate) fn write_named<T: NamedOption, S: Serializer>(
    value: T,
    serializer: S,
) -> Result<S::Ok, S::Error> {
    let index = T::ALL.iter().position(|other| *other == value).unwrap_or(0);
    serializer.serialize_unit_variant(T::TYPE_NAME, index as u32, value.name())
}

/// Reads exactly three numbers in brackets of either kind.
pub(in crate::scene) fn three_numbers<E: Error>(
    numbers: &[crate::scene::file::Finite],
) -> Result<[f64; 3], E> {
    match numbers {
        [x, y, z] => Ok([x.value(), y.value(), z.value()]),
        _ => Err(E::invalid_length(numbers.len(), &"three numbers")),
    }
}

/// Writes a number; whole ones without a decimal point, as people write them.
pub(crate) fn write_number<S: Serializer>(number: f64, serializer: S) -> Result<S::Ok, S::Error> {
    // Up to 2⁵³ all whole numbers are exact. A negative zero has no integer.
    let is_small = number.abs() <= 9_007_199_254_740_992.0;
    let is_whole = is_small && number == libm::trunc(number);
    if serializer.is_human_readable() && is_whole && !(number == 0.0 && number.is_sign_negative()) {
        serializer.serialize_i64(number as i64)
    } else {
        serializer.serialize_f64(number)
    }
}

/// A number inside of another value.
struct Number(f64);

impl Serialize for Number {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        write_number(self.0, serializer)
    }
}

/// Writes three numbers as `(1, 2, 3)`.
pub(in crate::scene) fn write_three_numbers<S: Serializer>(
    numbers: [f64; 3],
    serializer: S,
) -> Result<S::Ok, S::Error> {
    let mut tuple = serializer.serialize_tuple(3)?;
    for number in numbers {
        tuple.serialize_element(&Number(number))?;
    }
    tuple.end()
}

/// Implements serde's traits for a type by its [`SceneValue`].
macro_rules! serde_by_scene_value {
    ($($name:ident),* $(,)?) => {$(
        impl<'de> serde::Deserialize<'de> for $name {
            fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                <Self as $crate::scene::schema::SceneValue>::read(deserializer)
            }
        }

        impl serde::Serialize for $name {
            fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                $crate::scene::schema::SceneValue::write(self, serializer)
            }
        }
    )*};
}

pub(crate) use serde_by_scene_value;
