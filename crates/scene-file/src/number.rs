//! Numbers in scene files: each type allows only the values that are valid in its fields.
//!
//! RON itself accepts `NaN`, `inf` and `1e400`; none of these types does.

use super::schema::{
    Checker, Data, Declared, Form, Notation, SceneValue, Shape, TypeEntry, ValueType,
    checked_number, read_plain, serde_by_scene_value,
};
use super::syntax::{Group, Key, Node, NodeKind, parse_integer, parse_number};

serde_by_scene_value! { Triple, Scale }

/// A number that a scene file field does not allow.
#[derive(Clone, Copy, PartialEq, Debug, thiserror::Error)]
#[error("expected {expected}, found {found}")]
pub struct InvalidNumber {
    /// A description of the numbers that are allowed.
    pub expected: &'static str,
    /// The number.
    pub found: f64,
}

checked_number! {
    /// Any number that is neither infinite nor NaN.
    Finite, "a finite number", |_| true
}
checked_number! {
    /// A number greater than 0.
    Positive, "a number greater than 0", |x| x > 0.0
}
checked_number! {
    /// 0 or a number greater than 0.
    NonNegative, "0 or a positive number", |x| x >= 0.0
}
checked_number! {
    /// A field of view in degrees, greater than 0 and less than 180.
    FieldOfView, "an angle between 0 and 180 degrees", |x| x > 0.0 && x < 180.0
}
checked_number! {
    /// A fraction in percent, from 0 to 100.
    Percent, "a number from 0 to 100", |x| (0.0..=100.0).contains(&x)
}
checked_number! {
    /// A fraction, from 0 to 1.
    Fraction, "a number from 0 to 1", |x| (0.0..=1.0).contains(&x)
}
checked_number! {
    /// The angle that a light subtends in the sky, in degrees, from 0 to 30.
    Softness, "an angle from 0 to 30 degrees", |x| (0.0..=30.0).contains(&x)
}
checked_number! {
    /// An angle between two faces in degrees, from 0 to 180.
    CreaseAngle, "an angle from 0 to 180 degrees", |x| (0.0..=180.0).contains(&x)
}
checked_number! {
    /// The distance between hatch lines in millimeters, from 0.1 to 1000.
    HatchSpacing, "a distance from 0.1 to 1000 millimeters", |x| (0.1..=1000.0).contains(&x)
}

checked_number! {
    /// The amplitude of hand-drawn lines in millimeters, from 0 to 5.
    HandDrawn, "an amplitude from 0 to 5 millimeters", |x| (0.0..=5.0).contains(&x)
}

impl HandDrawn {
    /// No displacement.
    pub const EXACT: Self = Self(0.0);
    /// The amplitude of the sketch style.
    pub const SKETCH: Self = Self(0.35);
}

checked_number! {
    /// The height of text in pixels, from 1 to 1000.
    LabelSize, "a height from 1 to 1000 pixels", |x| (1.0..=1000.0).contains(&x)
}

impl LabelSize {
    /// 12 pixels.
    pub const DEFAULT: Self = Self(12.0);
}

impl HatchSpacing {
    /// 2 millimeters.
    pub const DEFAULT: Self = Self(2.0);
    /// 1.2 millimeters, for patent shading.
    pub const PATENT: Self = Self(1.2);
}

impl Fraction {
    /// One half.
    pub const HALF: Self = Self(0.5);
}

impl Percent {
    /// 0%.
    pub const ZERO: Self = Self(0.0);
    /// 80%.
    pub const EIGHTY: Self = Self(80.0);
}

checked_number! {
    /// The size of points in pixels, from 1 to 256.
    PointSize, "a size from 1 to 256 pixels", |x| (1.0..=256.0).contains(&x)
}

impl PointSize {
    /// 3 pixels.
    pub const DEFAULT: Self = Self(3.0);
}

impl CreaseAngle {
    /// 30 degrees, so that a twelve-sided cylinder is still smooth.
    pub const DEFAULT: Self = Self(30.0);
}

impl Positive {
    /// 1.
    pub const ONE: Self = Self(1.0);

    /// Creates a constant greater than 0.
    pub(super) const fn constant(value: f64) -> Self {
        debug_assert!(value > 0.0, "the number must be greater than 0");
        Self(value)
    }
}

impl Default for Finite {
    fn default() -> Self {
        Self(0.0)
    }
}

impl Finite {
    /// 0.
    pub const ZERO: Self = Self(0.0);

    /// Creates a finite constant.
    pub(super) const fn constant(value: f64) -> Self {
        debug_assert!(value.is_finite(), "the number must be finite");
        Self(value)
    }
}

impl NonNegative {
    /// 1.
    pub const ONE: Self = Self(1.0);

    /// 1.45, the illuminance in lux of the key light of a model without a scene file.
    pub const KEY_LIGHT: Self = Self(1.45);

    /// 0.45, the strength of the studio around a model without a scene file.
    pub const BARE_STUDIO: Self = Self(0.45);

    /// 0.2, the strength of the studio around a model with lights but without a scene file.
    pub const DIMMED_STUDIO: Self = Self(0.2);

    /// 5, the default padding in percent.
    pub const FIVE: Self = Self(5.0);
}

impl FieldOfView {
    /// 35 degrees, about the angle that a picture subtends at one and a half times its height.
    pub const DEFAULT: Self = Self(35.0);
}

impl Default for FieldOfView {
    fn default() -> Self {
        Self::DEFAULT
    }
}

/// Three finite numbers: a point, a vector, or angles about three axes. Written `(1, 2, 3)` or `[1,
/// 2, 3]`.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Triple(pub [f64; 3]);

impl Triple {
    /// (0, 0, 0).
    pub(super) const ZERO: Self = Self([0.0; 3]);
    /// (0, 1, 0), up in glTF.
    pub(super) const Y_AXIS: Self = Self([0.0, 1.0, 0.0]);
    /// (1, 1, 1).
    pub(super) const ONES: Self = Self([1.0; 3]);
}

impl From<[f64; 3]> for Triple {
    fn from(numbers: [f64; 3]) -> Self {
        Self(numbers)
    }
}

impl TryFrom<f64> for Scale {
    type Error = InvalidNumber;

    /// Creates a scale with one factor for all axes.
    fn try_from(factor: f64) -> Result<Self, InvalidNumber> {
        let is_valid = factor.is_finite() && factor != 0.0;
        let expected = "a finite factor other than 0";
        is_valid.then_some(Self([factor; 3])).ok_or(InvalidNumber { expected, found: factor })
    }
}

impl Declared for Triple {
    const ENTRY: &'static TypeEntry = &TypeEntry {
        name: "Triple",
        doc: "Three finite numbers: a point, a vector, or angles about three axes. Written `(1, 2, 3)` or `[1, 2, 3]`.",
        shape: Shape::Plain(Notation {
            check: check_triple,
            form: Form::Any(Finite::value_type),
            read: read_plain::<Self>,
        }),
    };
}

impl SceneValue for Triple {
    fn value_type() -> ValueType {
        ValueType::Declared(Self::ENTRY)
    }

    fn from_data(data: &Data) -> Result<Self, String> {
        let numbers = data.three_numbers().map(Self);
        numbers.ok_or_else(|| "expected three numbers, such as (1, 2, 3)".to_owned())
    }

    fn to_data(&self) -> Data {
        Data::of_three_numbers(self.0)
    }
}

/// Returns the direction of the axis with this name.
fn axis_vector(node: &Node<'_>) -> Option<&'static str> {
    let name = match node.kind {
        NodeKind::Word(name) => name,
        NodeKind::String(name) => name.trim_matches('"'),
        _ => return None,
    };
    match name {
        "x" | "X" => Some("(1, 0, 0)"),
        "y" | "Y" => Some("(0, 1, 0)"),
        "z" | "Z" => Some("(0, 0, 1)"),
        "-x" | "-X" => Some("(-1, 0, 0)"),
        "-y" | "-Y" => Some("(0, -1, 0)"),
        "-z" | "-Z" => Some("(0, 0, -1)"),
        _ => None,
    }
}

/// A nonzero factor for each axis, written as one number or as three.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Scale(pub [f64; 3]);

impl Scale {
    /// The factor 1 for each axis.
    pub const ONE: Self = Self([1.0; 3]);
}

impl Default for Scale {
    fn default() -> Self {
        Self::ONE
    }
}

impl Declared for Scale {
    const ENTRY: &'static TypeEntry = &TypeEntry {
        name: "Scale",
        doc: "A nonzero factor for each axis, written as one number or as three.",
        shape: Shape::Plain(Notation {
            check: check_scale,
            form: Form::Any(Finite::value_type),
            read: read_plain::<Self>,
        }),
    };
}

impl SceneValue for Scale {
    fn value_type() -> ValueType {
        ValueType::Declared(Self::ENTRY)
    }

    fn from_data(data: &Data) -> Result<Self, String> {
        let factors = data.number().map(|factor| [factor; 3]).or_else(|| data.three_numbers());
        let factors = factors.ok_or("expected one factor, such as 2, or three")?;
        let is_valid = factors.iter().all(|factor| factor.is_finite() && *factor != 0.0);
        let valid = is_valid.then_some(Self(factors));
        valid.ok_or_else(|| "expected finite factors other than 0".to_owned())
    }

    fn to_data(&self) -> Data {
        match self.0 {
            [x, y, z] if x == y && y == z => Data::Number(x),
            factors => Data::of_three_numbers(factors),
        }
    }
}

/// Reports the mistakes in three numbers.
fn check_triple(node: &Node<'_>, checker: &mut Checker<'_>) {
    match unnamed_group(node) {
        Some(group) => check_three_numbers(node, group, checker),
        None => {
            let help = axis_vector(node).map(|axis| format!("write {axis}"));
            checker.report_type(node, "three numbers, such as (1, 2, 3)", help);
        }
    }
}

/// Reports the mistakes in the factors of a scale.
fn check_scale(node: &Node<'_>, checker: &mut Checker<'_>) {
    let is_zero = |node: &Node<'_>| match node.kind {
        NodeKind::Number(word) => parse_number(word) == Some(0.0) || parse_integer(word) == Some(0),
        _ => false,
    };
    let has_zero = match unnamed_group(node) {
        Some(group) => {
            check_three_numbers(node, group, checker);
            group.items.iter().any(|item| is_zero(&item.value))
        }
        // Whole numbers in any base are allowed where a value may be one number or three.
        None if matches!(node.kind, NodeKind::Number(word) if parse_integer(word).is_some()) => {
            is_zero(node)
        }
        None => {
            let expected = "one factor, such as 2, or three, such as (1, 2, 1)";
            let factor = checker.read_number(node, expected);
            factor.is_some_and(|factor| !factor.is_finite() || factor == 0.0)
        }
    };
    if has_zero {
        checker.report_value(node, "expected finite factors other than 0", None);
    }
}

/// Returns the group of a vector, in either kind of brackets. Like `ron`, it skips a struct name
/// before the group.
pub(super) fn unnamed_group<'n, 'a>(node: &'n Node<'a>) -> Option<&'n Group<'a>> {
    let is_struct_name = |key: &Key<'_>| {
        let is_word = key.name.starts_with(|c: char| c.is_alphabetic() || c == '_');
        is_word && !["true", "false", "Some", "None", "inf", "NaN"].contains(&key.name)
    };
    let has_values =
        |group: &Group<'_>| group.items.len() > 1 && group.items.iter().all(|i| i.key.is_none());
    let is_vector = |group: &&Group<'_>| match &group.name {
        None => group.open != '{',
        Some(name) => group.open == '(' && is_struct_name(name) && has_values(group),
    };
    node.group().filter(is_vector)
}

/// Reports every mistake in a group that must hold exactly three finite numbers.
pub(super) fn check_three_numbers(node: &Node<'_>, group: &Group<'_>, checker: &mut Checker<'_>) {
    if group.items.len() != 3 {
        let problem = format!("expected three numbers, found {}", group.items.len());
        let help = checker.suggest_three_axes(group);
        checker.report_value(node, &problem, help);
        return;
    }
    checker.check_elements(&group.items, &Finite::value_type());
}
