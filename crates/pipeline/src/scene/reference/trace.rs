//! Tests: what the reader of scene files accepts, found out by reading scenes that are made up as they are asked for.
//!
//! Serde's types tell a deserializer the names of the fields and variants they expect. This one writes them down, gives each
//! field a value, and of each list of variants another one every time, until it has seen them all.

use crate::scene::SceneFile;
use serde::Deserialize;
use serde::de::value::{Error, StrDeserializer};
use serde::de::{
    DeserializeSeed, Deserializer, EnumAccess, IntoDeserializer, MapAccess, SeqAccess,
    VariantAccess, Visitor,
};
use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet};

/// Scenes are made up until this many in a row had nothing new.
const ENOUGH: usize = 100;

/// The names that are accepted in each struct (`Camera`), enum (`View`), and variant with fields (`View::LookAt`).
pub(super) fn accepted() -> BTreeMap<String, BTreeSet<String>> {
    let notes = RefCell::new(Notes::default());
    let mut idle = 0;
    while idle < ENOUGH {
        let before = notes.borrow().taken.clone();
        SceneFile::deserialize(Maker(&notes)).expect("a made-up scene is read");
        idle = if notes.borrow().taken == before { idle + 1 } else { 0 };
    }
    notes.into_inner().accepted
}

#[derive(Default)]
struct Notes {
    accepted: BTreeMap<String, BTreeSet<String>>,
    /// How often a variant was asked for, by enum.
    turns: BTreeMap<String, usize>,
    /// The variants that were given.
    taken: BTreeSet<(String, usize)>,
}

impl Notes {
    fn note(&mut self, name: &str, members: &[&str]) {
        let members = members.iter().map(|&member| member.to_owned());
        self.accepted.entry(name.to_owned()).or_default().extend(members);
    }

    /// The number of the variant whose turn it is.
    fn turn(&mut self, name: &str, count: usize) -> usize {
        let turn = self.turns.entry(name.to_owned()).or_default();
        let chosen = *turn % count;
        *turn += 1;
        self.taken.insert((name.to_owned(), chosen));
        chosen
    }
}

/// Makes up the value that is asked for.
#[derive(Clone, Copy)]
struct Maker<'a>(&'a RefCell<Notes>);

macro_rules! give {
    ($($method:ident => $visit:ident($($value:expr)?),)*) => {$(
        fn $method<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Error> {
            visitor.$visit($($value)?)
        }
    )*};
}

impl<'de> Deserializer<'de> for Maker<'_> {
    type Error = Error;

    give! {
        deserialize_bool => visit_bool(true),
        deserialize_u8 => visit_u8(1), deserialize_u16 => visit_u16(1),
        deserialize_u32 => visit_u32(1), deserialize_u64 => visit_u64(1),
        deserialize_i32 => visit_i32(1), deserialize_i64 => visit_i64(1),
        deserialize_f32 => visit_f32(1.0), deserialize_f64 => visit_f64(1.0),
        deserialize_str => visit_str("text"), deserialize_string => visit_str("text"),
        deserialize_identifier => visit_str("text"), deserialize_unit => visit_unit(),
    }

    /// Who takes anything takes three numbers: a triple, or a scale.
    fn deserialize_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Error> {
        visitor.visit_seq(Repeat(self, 3))
    }

    fn deserialize_option<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Error> {
        visitor.visit_some(self)
    }

    fn deserialize_seq<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Error> {
        visitor.visit_seq(Repeat(self, 1))
    }

    fn deserialize_tuple<V: Visitor<'de>>(self, len: usize, visitor: V) -> Result<V::Value, Error> {
        visitor.visit_seq(Repeat(self, len))
    }

    fn deserialize_newtype_struct<V: Visitor<'de>>(
        self,
        _: &'static str,
        visitor: V,
    ) -> Result<V::Value, Error> {
        visitor.visit_newtype_struct(self)
    }

    fn deserialize_struct<V: Visitor<'de>>(
        self,
        name: &'static str,
        fields: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Error> {
        self.0.borrow_mut().note(name, fields);
        visitor.visit_map(Each(self, fields.iter()))
    }

    fn deserialize_enum<V: Visitor<'de>>(
        self,
        name: &'static str,
        variants: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Error> {
        self.0.borrow_mut().note(name, variants);
        let chosen = self.0.borrow_mut().turn(name, variants.len());
        visitor.visit_enum(Chosen { maker: self, owner: name, variant: variants[chosen] })
    }

    serde::forward_to_deserialize_any! {
        i8 i16 i128 u128 char bytes byte_buf unit_struct tuple_struct map ignored_any
    }
}

/// A list of made-up values.
struct Repeat<'a>(Maker<'a>, usize);

impl<'de> SeqAccess<'de> for Repeat<'_> {
    type Error = Error;

    fn next_element_seed<T: DeserializeSeed<'de>>(
        &mut self,
        seed: T,
    ) -> Result<Option<T::Value>, Error> {
        if self.1 == 0 {
            return Ok(None);
        }
        self.1 -= 1;
        seed.deserialize(self.0).map(Some)
    }
}

/// A made-up value for each of some fields.
struct Each<'a>(Maker<'a>, std::slice::Iter<'static, &'static str>);

impl<'de> MapAccess<'de> for Each<'_> {
    type Error = Error;

    fn next_key_seed<K: DeserializeSeed<'de>>(
        &mut self,
        seed: K,
    ) -> Result<Option<K::Value>, Error> {
        let key =
            |name: &&'static str| -> StrDeserializer<'static, Error> { name.into_deserializer() };
        self.1.next().map(|name| seed.deserialize(key(name))).transpose()
    }

    fn next_value_seed<V: DeserializeSeed<'de>>(&mut self, seed: V) -> Result<V::Value, Error> {
        seed.deserialize(self.0)
    }
}

/// A variant with what it holds.
struct Chosen<'a> {
    maker: Maker<'a>,
    owner: &'static str,
    variant: &'static str,
}

impl<'de> EnumAccess<'de> for Chosen<'_> {
    type Error = Error;
    type Variant = Self;

    fn variant_seed<V: DeserializeSeed<'de>>(self, seed: V) -> Result<(V::Value, Self), Error> {
        let name: StrDeserializer<'static, Error> = self.variant.into_deserializer();
        Ok((seed.deserialize(name)?, self))
    }
}

impl<'de> VariantAccess<'de> for Chosen<'_> {
    type Error = Error;

    fn unit_variant(self) -> Result<(), Error> {
        Ok(())
    }

    fn newtype_variant_seed<T: DeserializeSeed<'de>>(self, seed: T) -> Result<T::Value, Error> {
        seed.deserialize(self.maker)
    }

    fn tuple_variant<V: Visitor<'de>>(self, len: usize, visitor: V) -> Result<V::Value, Error> {
        visitor.visit_seq(Repeat(self.maker, len))
    }

    fn struct_variant<V: Visitor<'de>>(
        self,
        fields: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Error> {
        let owner = format!("{}::{}", self.owner, self.variant);
        self.maker.0.borrow_mut().note(&owner, fields);
        visitor.visit_map(Each(self.maker, fields.iter()))
    }
}
