//! Scene file values without their Rust types.
//!
//! ```text
//!  serde's formats ◄─► Data ◄─► scene_struct!, scene_enum!
//! ```
//! One reader and one writer per format then serve all types ([`serialized`](super::serialized)).
//! Readers generated for each type took a third of this crate's compile time.

use super::SceneValue;
use crate::options::NamedOption;

/// A value of a scene file.
#[derive(Clone, PartialEq, Debug)]
pub(crate) enum Data {
    /// An absent optional value, or no value after the name of a variant.
    None,
    /// `true` or `false`.
    Bool(bool),
    /// A whole number, where only whole numbers are allowed.
    Whole(u64),
    /// A number.
    Number(f64),
    /// A string.
    Text(String),
    /// Values in square brackets.
    List(Vec<Self>),
    /// A fixed number of values. Reading treats it as a list.
    Tuple(Vec<Self>),
    /// Named fields. Those with default values are omitted when written.
    Fields(Vec<(&'static str, Self)>),
    /// A variant with its fields or its value.
    Variant(&'static str, Box<Self>),
}

impl Data {
    /// Creates a variant with the value after its name.
    pub(crate) fn of_variant(name: &'static str, value: Self) -> Self {
        Self::Variant(name, Box::new(value))
    }

    /// Creates three numbers in round brackets.
    pub(crate) fn of_three_numbers(numbers: [f64; 3]) -> Self {
        Self::Tuple(numbers.map(Self::Number).to_vec())
    }

    /// Returns the value of a field, or its default if it was omitted.
    ///
    /// # Errors
    /// Returns an error if the value cannot be read, or if the field is required but was omitted.
    pub(crate) fn field<T: SceneValue>(
        &self,
        name: &str,
        default: fn() -> Option<T>,
    ) -> Result<T, String> {
        match self.field_data(name) {
            Some(value) => T::from_data(value),
            None => default().ok_or_else(|| missing_field(name)),
        }
    }

    /// Returns the value of a field, or `None` if it was omitted.
    pub(super) fn field_data(&self, name: &str) -> Option<&Self> {
        let Self::Fields(fields) = self else { return None };
        fields.iter().find(|(field, _)| *field == name).map(|(_, value)| value)
    }

    /// Returns the name of a variant and the value after it.
    pub(crate) fn variant(&self) -> (&str, &Self) {
        match self {
            Self::Variant(name, value) => (name, value),
            _ => ("", &Self::None),
        }
    }

    /// Returns the number, or `None` for any other value.
    pub(crate) fn number(&self) -> Option<f64> {
        match self {
            Self::Number(number) => Some(*number),
            _ => None,
        }
    }

    /// Returns the elements, or `None` for any other value.
    pub(super) fn list(&self) -> Option<&[Self]> {
        match self {
            Self::List(elements) | Self::Tuple(elements) => Some(elements),
            _ => None,
        }
    }

    /// Reads exactly three numbers.
    pub(crate) fn three_numbers(&self) -> Option<[f64; 3]> {
        match self.list()? {
            [x, y, z] => Some([x.number()?, y.number()?, z.number()?]),
            _ => None,
        }
    }
}

/// Returns the message about a missing required field.
pub(super) fn missing_field(name: &str) -> String {
    format!("missing field `{name}`")
}

/// Adds a field to the list of fields to write, unless it has its default value.
pub(crate) fn push_field<T: SceneValue>(
    fields: &mut Vec<(&'static str, Data)>,
    name: &'static str,
    value: &T,
    default: fn() -> Option<T>,
) {
    if default().is_none_or(|default| default != *value) {
        fields.push((name, value.to_data()));
    }
}

/// Reads a value by its name.
pub(crate) fn read_named<T: NamedOption>(data: &Data) -> Result<T, String> {
    let (name, _) = data.variant();
    T::from_name(name).ok_or_else(|| format!("`{name}` is not a value of {}", T::TYPE_NAME))
}

/// Writes the name of a value.
pub(crate) fn write_named<T: NamedOption>(value: T) -> Data {
    Data::of_variant(value.name(), Data::None)
}
