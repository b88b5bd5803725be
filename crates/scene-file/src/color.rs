//! Scene file colors: `#rgb`, `#rrggbb` and CSS names in sRGB, or three linear numbers for light.

mod names;

use super::number::{Finite, Triple, check_three_numbers, unnamed_group};
use super::schema::{
    Checker, Data, Declared, Form, Notation, SceneValue, Shape, TypeEntry, ValueType, read_plain,
    serde_by_scene_value,
};
use super::suggest::closest_name;
use super::syntax::{Node, NodeKind};
use names::CSS_COLORS;
use shade::color::{parse_hex_srgb, srgb_to_linear_table};

serde_by_scene_value! { Color, LightColor }

/// A color in sRGB, with eight bits per channel.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Color(pub [u8; 3]);

impl Color {
    /// Black.
    pub const BLACK: Self = Self([0; 3]);
    /// White.
    pub const WHITE: Self = Self([255; 3]);

    /// Parses `#rgb`, `#rrggbb` or a CSS color name in any case; returns `None` for any other text.
    ///
    /// In `#rgb`, each digit is doubled, so `#1af` is `#11aaff`. Colors have no alpha channel:
    /// where opacity exists, it is a separate field.
    #[must_use]
    pub fn parse(text: &str) -> Option<Self> {
        parse_hex_srgb(text).or_else(|| parse_color_name(text)).map(Self)
    }

    /// Returns red, green and blue as linear light from 0 to 1, from a 256-entry table of the sRGB
    /// transfer function (IEC 61966-2-1).
    #[must_use]
    pub fn to_linear(self) -> [f32; 3] {
        self.0.map(|code| srgb_to_linear_table()[usize::from(code)])
    }
}

/// Looks up a CSS color name (CSS Color 4, § 6.1) by binary search in the sorted table.
fn parse_color_name(text: &str) -> Option<[u8; 3]> {
    let name = text.to_ascii_lowercase();
    let index = CSS_COLORS.binary_search_by_key(&name.as_str(), |(name, _)| name).ok()?;
    let [_, r, g, b] = CSS_COLORS[index].1.to_be_bytes();
    Some([r, g, b])
}

/// Returns the CSS color names in alphabetical order.
pub fn color_names() -> impl Iterator<Item = &'static str> {
    CSS_COLORS.iter().map(|(name, _)| *name)
}

impl Declared for Color {
    const ENTRY: &'static TypeEntry = &TypeEntry {
        name: "Color",
        doc: "An sRGB color in quotation marks: \"#rgb\", \"#rrggbb\", or a CSS color name such as \"white\".",
        shape: Shape::Plain(Notation {
            check: check_color,
            form: Form::Text,
            read: read_plain::<Self>,
        }),
    };
}

impl SceneValue for Color {
    fn value_type() -> ValueType {
        ValueType::Declared(Self::ENTRY)
    }

    fn from_data(data: &Data) -> Result<Self, String> {
        let text = String::from_data(data)?;
        Self::parse(&text).ok_or_else(|| format!("`{text}` is not a color"))
    }

    fn to_data(&self) -> Data {
        let [r, g, b] = self.0;
        Data::Text(format!("#{r:02x}{g:02x}{b:02x}"))
    }
}

/// Reports the mistakes in a color.
fn check_color(node: &Node<'_>, checker: &mut Checker<'_>) {
    let help = match &node.kind {
        NodeKind::String(_) => return check_color_string(node, checker),
        NodeKind::Word(word) if Color::parse(word).is_some() => {
            format!("write the color in quotation marks: \"{word}\"")
        }
        NodeKind::Group(_) => color_of_numbers(node).map_or_else(hex_help, |[r, g, b]| {
            format!("write \"#{r:02x}{g:02x}{b:02x}\" if the numbers are sRGB from 0 to 1")
        }),
        NodeKind::Number(word)
            if word.starts_with("0x") && Color::parse(&word.replacen("0x", "#", 1)).is_some() =>
        {
            format!("write the color in quotation marks: \"{}\"", word.replacen("0x", "#", 1))
        }
        _ => hex_help(),
    };
    checker.report_type(node, "a color", Some(help));
}

/// Reports the mistakes in the color of a light.
fn check_light_color(node: &Node<'_>, checker: &mut Checker<'_>) {
    match (&node.kind, unnamed_group(node)) {
        (NodeKind::String(_), _) => check_color_string(node, checker),
        (_, Some(group)) => check_three_numbers(node, group, checker),
        _ => {
            let help = "write linear red, green and blue such as (1, 0.9, 0.8), or \"#ffe0c0\"";
            checker.report_type(node, "a color", Some(help.to_owned()));
        }
    }
}

/// Reports a string that is not a color; a misspelled name gets the closest name as a hint.
fn check_color_string(node: &Node<'_>, checker: &mut Checker<'_>) {
    let Some(text) = checker.read_string(node) else { return };
    if Color::parse(&text).is_none() {
        let names: Vec<&str> = CSS_COLORS.iter().map(|(name, _)| *name).collect();
        let help = match closest_name(&text, &names).filter(|_| !text.starts_with('#')) {
            Some(name) => format!("did you mean \"{name}\"?"),
            None => hex_help(),
        };
        let message = format!("`{text}` is not a color");
        checker.report(node.span.clone(), message, Some(help));
    }
}

/// Returns the help text on color notation.
fn hex_help() -> String {
    "write \"#rrggbb\", such as \"#1a1f26\", or a CSS color name, such as \"white\"".to_owned()
}

/// Converts a tuple of three or four numbers in [0, 1] to an 8-bit color, for the hint in a
/// message. Alpha is ignored.
fn color_of_numbers(node: &Node<'_>) -> Option<[u8; 3]> {
    let items = &unnamed_group(node)?.items;
    let number = |index: usize| match items.get(index)?.value.kind {
        NodeKind::Number(word) => {
            super::syntax::parse_number(word).filter(|x| (0.0..=1.0).contains(x))
        }
        _ => None,
    };
    let code = |index: usize| Some(libm::round(number(index)? * 255.0) as u8);
    Some([code(0)?, code(1)?, code(2)?]).filter(|_| items.len() <= 4)
}

/// The color of a light: linear red, green and blue.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct LightColor(pub [f64; 3]);

impl LightColor {
    /// White, (1, 1, 1), which leaves the intensity of the light unchanged.
    pub const WHITE: Self = Self([1.0; 3]);
}

impl Declared for LightColor {
    const ENTRY: &'static TypeEntry = &TypeEntry {
        name: "LightColor",
        doc: "The color of light: linear red, green and blue such as (1, 0.9, 0.8), or an sRGB color such as \"#ffe0c0\" or \"white\".",
        shape: Shape::Plain(Notation {
            check: check_light_color,
            form: Form::Any(Finite::value_type),
            read: read_plain::<Self>,
        }),
    };
}

impl SceneValue for LightColor {
    fn value_type() -> ValueType {
        ValueType::Declared(Self::ENTRY)
    }

    fn from_data(data: &Data) -> Result<Self, String> {
        match data {
            Data::Text(_) => {
                let color = Color::from_data(data)?;
                Ok(Self(color.to_linear().map(f64::from)))
            }
            other => Triple::from_data(other).map(|numbers| Self(numbers.0)),
        }
    }

    fn to_data(&self) -> Data {
        Data::of_three_numbers(self.0)
    }
}
