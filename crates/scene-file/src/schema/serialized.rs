//! Scene file values in serde's data model, for `ron` and every other format.
//!
//! ```text
//!  Deserializer ─► Reader(ValueType) ─► Data     with declared fields and variants
//!  Data ─► Writer(ValueType) ─► Serializer       with type and variant names
//! ```

use super::data::{Data, missing_field};
use super::{FieldEntry, Form, SceneValue, Shape, TypeEntry, ValueType, VariantEntry};
use crate::file::is_dimensions_list;
use core::fmt;
use serde::de::{
    DeserializeSeed, Deserializer, EnumAccess, Error, IgnoredAny, MapAccess, SeqAccess,
    VariantAccess as _, Visitor,
};
use serde::ser::{
    Serialize, SerializeStruct as _, SerializeStructVariant as _, SerializeTuple as _, Serializer,
};

/// Reads a value of a scene file from any format.
pub(crate) fn read_value<'de, T: SceneValue, D: Deserializer<'de>>(
    deserializer: D,
) -> Result<T, D::Error> {
    let data = Reader(&T::value_type()).deserialize(deserializer)?;
    T::from_data(&data).map_err(D::Error::custom)
}

/// Writes a value of a scene file to any format.
pub(crate) fn write_value<T: SceneValue, S: Serializer>(
    value: &T,
    serializer: S,
) -> Result<S::Ok, S::Error> {
    Writer(&T::value_type(), &value.to_data()).serialize(serializer)
}

/// Reads a value of this type. Errors are raised where they occur in the text.
struct Reader<'a>(&'a ValueType);

impl<'de> DeserializeSeed<'de> for Reader<'_> {
    type Value = Data;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<Data, D::Error> {
        let notation = match self.0 {
            ValueType::Plain(_, notation) => notation,
            ValueType::Declared(entry) => match &entry.shape {
                Shape::Fields(fields) => {
                    return deserializer.deserialize_struct(entry.name, &[], FieldsVisitor(fields));
                }
                Shape::Variants(variants) => {
                    let visitor = VariantVisitor(variants);
                    return deserializer.deserialize_enum(entry.name, &[], visitor);
                }
                Shape::Plain(notation) => notation,
            },
            // A sheet's dimensions may be `true` or `false`.
            ValueType::List(element) if is_dimensions_list(element) => {
                return deserializer.deserialize_any(PlainVisitor(Some(element)));
            }
            ValueType::List(element) => {
                return deserializer.deserialize_seq(PlainVisitor(Some(element)));
            }
            ValueType::Tuple(parts) => return deserializer.deserialize_any(TupleVisitor(parts)),
        };
        let data = match notation.form {
            Form::Bool => deserializer.deserialize_bool(PlainVisitor(None))?,
            Form::Whole => match deserializer.deserialize_u32(PlainVisitor(None))? {
                Data::Number(number) => Data::Whole(number as u64),
                other => other,
            },
            Form::Number => deserializer.deserialize_f64(PlainVisitor(None))?,
            Form::Text => deserializer.deserialize_str(PlainVisitor(None))?,
            Form::Any(element) => deserializer.deserialize_any(PlainVisitor(Some(&element())))?,
        };
        (notation.read)(&data).map(|()| data).map_err(D::Error::custom)
    }
}

/// Reads a value that may be absent.
struct OptionalReader<'a>(&'a ValueType);

impl<'de> DeserializeSeed<'de> for OptionalReader<'_> {
    type Value = Data;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<Data, D::Error> {
        deserializer.deserialize_option(self)
    }
}

impl<'de> Visitor<'de> for OptionalReader<'_> {
    type Value = Data;

    fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str("a value or none")
    }

    fn visit_none<E: Error>(self) -> Result<Data, E> {
        Ok(Data::None)
    }

    fn visit_unit<E: Error>(self) -> Result<Data, E> {
        Ok(Data::None)
    }

    fn visit_some<D: Deserializer<'de>>(self, deserializer: D) -> Result<Data, D::Error> {
        Reader(self.0).deserialize(deserializer)
    }
}

/// Reads a value without named parts, or a list whose elements have this type.
struct PlainVisitor<'a>(Option<&'a ValueType>);

impl<'de> Visitor<'de> for PlainVisitor<'_> {
    type Value = Data;

    fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str("a scene value")
    }

    fn visit_bool<E: Error>(self, value: bool) -> Result<Data, E> {
        Ok(Data::Bool(value))
    }

    fn visit_i64<E: Error>(self, value: i64) -> Result<Data, E> {
        Ok(Data::Number(value as f64))
    }

    fn visit_u64<E: Error>(self, value: u64) -> Result<Data, E> {
        Ok(Data::Number(value as f64))
    }

    fn visit_f64<E: Error>(self, value: f64) -> Result<Data, E> {
        Ok(Data::Number(value))
    }

    fn visit_str<E: Error>(self, value: &str) -> Result<Data, E> {
        Ok(Data::Text(value.to_owned()))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut elements: A) -> Result<Data, A::Error> {
        let Some(element) = self.0 else {
            return Err(A::Error::custom("expected one value, not a list"));
        };
        let mut list = Vec::new();
        while let Some(data) = elements
            .next_element_seed(Reader(element))
            .map_err(|error| error_in(&format!("[{}]", list.len()), &error))?
        {
            list.push(data);
        }
        Ok(Data::List(list))
    }
}

/// Reads as many values as there are types, in either kind of brackets if the format has two.
struct TupleVisitor<'a>(&'a [ValueType]);

impl<'de> Visitor<'de> for TupleVisitor<'_> {
    type Value = Data;

    fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "{} values in brackets", self.0.len())
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut elements: A) -> Result<Data, A::Error> {
        let mut values = Vec::new();
        for part in self.0 {
            let value = elements.next_element_seed(Reader(part))?;
            values.push(value.ok_or_else(|| A::Error::invalid_length(values.len(), &self))?);
        }
        match elements.next_element::<IgnoredAny>()? {
            Some(_) => Err(A::Error::invalid_length(values.len() + 1, &self)),
            None => Ok(Data::Tuple(values)),
        }
    }
}

/// Reads fields in any order.
struct FieldsVisitor(&'static [FieldEntry]);

impl<'de> Visitor<'de> for FieldsVisitor {
    type Value = Data;

    fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str("fields in brackets")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Data, A::Error> {
        let mut values: Vec<(&'static str, Data)> = Vec::new();
        while let Some(index) =
            map.next_key_seed(NameOf("field", &|index| Some(self.0.get(index)?.name)))?
        {
            let field = &self.0[index];
            if values.iter().any(|(name, _)| *name == field.name) {
                return Err(A::Error::duplicate_field(field.name));
            }
            let value_type = (field.value_type)();
            let value = if field.accepts_none {
                map.next_value_seed(OptionalReader(&value_type))
            } else {
                map.next_value_seed(Reader(&value_type))
            };
            values.push((field.name, value.map_err(|error| error_in(field.name, &error))?));
        }
        let is_missing = |field: &&FieldEntry| {
            !field.is_optional && values.iter().all(|(name, _)| *name != field.name)
        };
        match self.0.iter().find(is_missing) {
            Some(field) => Err(A::Error::custom(missing_field(field.name))),
            None => Ok(Data::Fields(values)),
        }
    }
}

/// Prefixes a value's error with the field or element that holds the value, as in ``
/// `camera.projection.near`: expected … ``.
fn error_in<E: Error>(place: &str, error: &E) -> E {
    let text = error.to_string();
    match text.strip_prefix('`').and_then(|rest| rest.split_once("`: ")) {
        Some((path, message)) if path.starts_with('[') => {
            E::custom(format_args!("`{place}{path}`: {message}"))
        }
        Some((path, message)) => E::custom(format_args!("`{place}.{path}`: {message}")),
        None => E::custom(format_args!("`{place}`: {text}")),
    }
}

/// Reads a variant: its fields, its value, or nothing after its name.
struct VariantVisitor(&'static [VariantEntry]);

impl<'de> Visitor<'de> for VariantVisitor {
    type Value = Data;

    fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str("a variant name")
    }

    fn visit_enum<A: EnumAccess<'de>>(self, data: A) -> Result<Data, A::Error> {
        let (index, data) =
            data.variant_seed(NameOf("variant", &|index| Some(self.0.get(index)?.name)))?;
        let variant = &self.0[index];
        let value = match variant.value_type {
            Some(value_type) => data.newtype_variant_seed(Reader(&value_type()))?,
            None if variant.has_brackets() => {
                data.struct_variant(&[], FieldsVisitor(variant.fields))?
            }
            None => data.unit_variant().map(|()| Data::None)?,
        };
        Ok(Data::of_variant(variant.name, value))
    }
}

/// Reads a name as its index, or the index itself in formats without names. The first member is the
/// kind of name; the second returns the name with an index. Unknown names and indices are rejected.
struct NameOf<'a>(&'static str, &'a dyn Fn(usize) -> Option<&'static str>);

impl<'de> DeserializeSeed<'de> for NameOf<'_> {
    type Value = usize;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<usize, D::Error> {
        deserializer.deserialize_identifier(self)
    }
}

impl Visitor<'_> for NameOf<'_> {
    type Value = usize;

    fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str("a field or variant name")
    }

    fn visit_str<E: Error>(self, name: &str) -> Result<usize, E> {
        let names = || (0..).map_while(self.1);
        names().position(|known| known == name).ok_or_else(|| {
            let names: Vec<_> = names().map(|name| format!("`{name}`")).collect();
            let (kind, names) = (self.0, names.join(", "));
            E::custom(format_args!("unknown {kind} `{name}`, expected one of {names}"))
        })
    }

    fn visit_u64<E: Error>(self, index: u64) -> Result<usize, E> {
        let known = usize::try_from(index).ok().filter(|index| (self.1)(*index).is_some());
        known.ok_or_else(|| E::custom("there is no field or variant with this index"))
    }
}

/// Writes a value of this type.
struct Writer<'a>(&'a ValueType, &'a Data);

impl Serialize for Writer<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self.1 {
            Data::None => serializer.serialize_none(),
            Data::Bool(value) => serializer.serialize_bool(*value),
            Data::Whole(number) => serializer.serialize_u64(*number),
            Data::Number(number) => write_number(*number, serializer),
            Data::Text(text) => serializer.serialize_str(text),
            Data::List(elements) => {
                let writer = |(index, data)| ListElement(self.0, index, data);
                serializer.collect_seq(elements.iter().enumerate().map(writer))
            }
            Data::Tuple(elements) => {
                let mut tuple = serializer.serialize_tuple(elements.len())?;
                for (index, data) in elements.iter().enumerate() {
                    tuple.serialize_element(&ListElement(self.0, index, data))?;
                }
                tuple.end()
            }
            Data::Fields(_) => self.write_struct(serializer),
            Data::Variant(name, value) => self.write_variant(name, value, serializer),
        }
    }
}

impl Writer<'_> {
    fn write_struct<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let (name, entries) = match self.0 {
            ValueType::Declared(TypeEntry { name, shape: Shape::Fields(fields), .. }) => {
                (*name, *fields)
            }
            _ => ("", &[][..]),
        };
        let values = WrittenField::all(entries, self.1);
        let count = values.iter().flatten().count();
        let mut fields = serializer.serialize_struct(name, count)?;
        for (entry, value) in entries.iter().zip(&values) {
            match value {
                Some(value) => fields.serialize_field(entry.name, value)?,
                None => fields.skip_field(entry.name)?,
            }
        }
        fields.end()
    }

    fn write_variant<S: Serializer>(
        &self,
        variant: &'static str,
        value: &Data,
        serializer: S,
    ) -> Result<S::Ok, S::Error> {
        let (name, index, entry) = match self.0 {
            ValueType::Declared(entry @ TypeEntry { shape: Shape::Variants(variants), .. }) => {
                let index = entry.variant_index(variant);
                (entry.name, index, variants.get(index as usize))
            }
            _ => ("", 0, None),
        };
        if let Some(value_type) = entry.and_then(|entry| entry.value_type) {
            let value = &Writer(&value_type(), value);
            return serializer.serialize_newtype_variant(name, index, variant, value);
        }
        let entries = entry.map_or(&[][..], |entry| entry.fields);
        if entries.is_empty() {
            return serializer.serialize_unit_variant(name, index, variant);
        }
        let values = WrittenField::all(entries, value);
        let count = values.iter().flatten().count();
        let mut fields = serializer.serialize_struct_variant(name, index, variant, count)?;
        for (entry, value) in entries.iter().zip(&values) {
            match value {
                Some(value) => fields.serialize_field(entry.name, value)?,
                None => fields.skip_field(entry.name)?,
            }
        }
        fields.end()
    }
}

/// Writes an element of a list or tuple of this type.
struct ListElement<'a>(&'a ValueType, usize, &'a Data);

impl Serialize for ListElement<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let Self(list, index, data) = *self;
        match list {
            ValueType::List(element) => Writer(element, data).serialize(serializer),
            ValueType::Tuple(parts) if index < parts.len() => {
                Writer(&parts[index], data).serialize(serializer)
            }
            // Numbers and strings need no names.
            other => Writer(other, data).serialize(serializer),
        }
    }
}

/// Writes the value of a field.
struct WrittenField<'a>(&'a FieldEntry, &'a Data);

impl<'a> WrittenField<'a> {
    /// Returns the value of each field, or `None` if it is not written.
    fn all(entries: &'a [FieldEntry], fields: &'a Data) -> Vec<Option<Self>> {
        let field = |entry: &'a FieldEntry| Some(Self(entry, fields.field_data(entry.name)?));
        entries.iter().map(field).collect()
    }
}

impl Serialize for WrittenField<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let value_type = (self.0.value_type)();
        let writer = Writer(&value_type, self.1);
        match self.1 {
            Data::None => serializer.serialize_none(),
            _ if self.0.accepts_none => serializer.serialize_some(&writer),
            _ => writer.serialize(serializer),
        }
    }
}

/// Writes a number as people do, without a decimal point if it is whole.
fn write_number<S: Serializer>(number: f64, serializer: S) -> Result<S::Ok, S::Error> {
    // Up to 2⁵³ all whole numbers are exact. Negative zero has no integer form.
    let is_small = number.abs() <= 9_007_199_254_740_992.0;
    let is_whole = is_small && number == libm::trunc(number);
    if serializer.is_human_readable() && is_whole && !(number == 0.0 && number.is_sign_negative()) {
        serializer.serialize_i64(number as i64)
    } else {
        serializer.serialize_f64(number)
    }
}

/// Implements serde's traits for a type from its [`SceneValue`].
macro_rules! serde_by_scene_value {
    ($($name:ident),* $(,)?) => {$(
        impl<'de> serde::Deserialize<'de> for $name {
            fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                $crate::schema::read_value(deserializer)
            }
        }

        impl serde::Serialize for $name {
            fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                $crate::schema::write_value(self, serializer)
            }
        }
    )*};
}

pub(crate) use serde_by_scene_value;
