//! Accessor formats allowed for each use (glTF 2.0 §3.7.2.1, §3.7.2.2 and §3.11).
//!
//! KHR_mesh_quantization adds integer formats for positions, normals, tangents and texture
//! coordinates.
//!
//! The integer formats of core glTF are normalized, except for joint indices and primitive indices:
//!
//! ```text
//!               float   normalized integers        with KHR_mesh_quantization
//!  POSITION     VEC3                               VEC3 of 8 and 16 bits
//!  NORMAL       VEC3                               VEC3 of signed 8 and 16 bits
//!  TEXCOORD_n   VEC2    VEC2 of unsigned 8, 16     VEC2 of 8 and 16 bits
//!  COLOR_n      VEC3/4  VEC3/4 of unsigned 8, 16
//!  WEIGHTS_n    VEC4    VEC4 of unsigned 8, 16
//! ```

use super::layout::ComponentType::{F32, I8, I16, U8, U16, U32};
use super::layout::{AccessorLayout, ComponentType, ElementType, SCALAR, VEC2, VEC3, VEC4};

/// A format: the element type, the component type, and whether integers are normalized.
type AttributeFormat = (ElementType, ComponentType, bool);

/// An attribute semantic, parsed from the attribute's name.
///
/// It borrows the name from the document.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Semantic<'a> {
    /// POSITION, NORMAL or TANGENT.
    Single(&'a str),
    /// A name with a set index, such as TEXCOORD_0.
    Numbered(&'a str, u32),
    /// An application-specific name, which starts with an underscore.
    Custom,
}

impl<'a> Semantic<'a> {
    /// Parses an attribute name. Returns `None` for a name that glTF does not define.
    ///
    /// A set index has no leading zeros: `TEXCOORD_01` is not an attribute.
    pub(super) fn from_name(name: &'a str) -> Option<Self> {
        if name.starts_with('_') {
            return Some(Self::Custom);
        }
        if ["POSITION", "NORMAL", "TANGENT"].contains(&name) {
            return Some(Self::Single(name));
        }
        let (kind, number) = name.split_once('_')?;
        let is_plain = number.bytes().all(|b| b.is_ascii_digit())
            && (number == "0" || !number.starts_with('0'));
        let is_known = ["TEXCOORD", "COLOR", "JOINTS", "WEIGHTS"].contains(&kind);
        let number = number.parse().ok().filter(|_| is_known && is_plain)?;
        Some(Self::Numbered(kind, number))
    }

    /// Returns the name without its set index, or an empty string for a custom name.
    fn base_name(self) -> &'a str {
        match self {
            Self::Single(kind) | Self::Numbered(kind, _) => kind,
            Self::Custom => "",
        }
    }

    /// Returns the formats that an attribute may have, or `None` for a custom name, which may have
    /// any.
    ///
    /// `in_target` selects the displacements of morph targets: their tangents have three
    /// components, and signed integers are allowed for texture coordinates and colors.
    ///
    /// `quantized` is set if the file uses KHR_mesh_quantization. The extension adds to the formats
    /// of core glTF and never replaces them.
    pub(super) fn allowed_formats(
        self,
        in_target: bool,
        quantized: bool,
    ) -> Option<Vec<AttributeFormat>> {
        let mut formats: Vec<AttributeFormat> = match (self.base_name(), in_target) {
            ("", _) => return None,
            ("TANGENT", false) => vec![(VEC4, F32, false)],
            ("POSITION" | "NORMAL" | "TANGENT", _) => vec![(VEC3, F32, false)],
            ("TEXCOORD", false) => float_or_normalized(&[VEC2], &[U8, U16]),
            ("TEXCOORD", true) => float_or_normalized(&[VEC2], &[I8, U8, I16, U16]),
            ("COLOR", false) => float_or_normalized(&[VEC3, VEC4], &[U8, U16]),
            ("COLOR", true) => float_or_normalized(&[VEC3, VEC4], &[I8, U8, I16, U16]),
            ("JOINTS", _) => vec![(VEC4, U8, false), (VEC4, U16, false)],
            _ => float_or_normalized(&[VEC4], &[U8, U16]),
        };
        if quantized {
            formats.extend(self.quantized_formats(in_target));
        }
        Some(formats)
    }

    /// Returns the formats that KHR_mesh_quantization allows in addition to core glTF.
    fn quantized_formats(self, in_target: bool) -> Vec<AttributeFormat> {
        let all = |shape, components: &[ComponentType], normalized: &[bool]| {
            let pairs = components.iter().flat_map(|&c| normalized.iter().map(move |&n| (c, n)));
            pairs.map(|(component, normalized)| (shape, component, normalized)).collect()
        };
        match (self.base_name(), in_target) {
            ("POSITION", false) => all(VEC3, &[I8, U8, I16, U16], &[false, true]),
            ("POSITION", true) => all(VEC3, &[I8, I16], &[false, true]),
            ("NORMAL", _) | ("TANGENT", true) => all(VEC3, &[I8, I16], &[true]),
            ("TANGENT", false) => all(VEC4, &[I8, I16], &[true]),
            ("TEXCOORD", false) => all(VEC2, &[I8, U8, I16, U16], &[false, true]),
            _ => Vec::new(),
        }
    }
}

/// Returns float formats, and formats with normalized integers of the given types.
///
/// Every element type is combined with every component type.
fn float_or_normalized(
    shapes: &[ElementType],
    components: &[ComponentType],
) -> Vec<AttributeFormat> {
    let of = |&shape: &ElementType| {
        let integers = components.iter().map(move |&component| (shape, component, true));
        std::iter::once((shape, F32, false)).chain(integers)
    };
    shapes.iter().flat_map(of).collect()
}

/// Returns whether the format of a layout is allowed.
pub(super) fn is_allowed(layout: AccessorLayout, formats: &[AttributeFormat]) -> bool {
    formats.contains(&(layout.element_type, layout.component_type, layout.normalized))
}

/// The formats allowed for primitive indices.
pub(super) const INDEX_FORMATS: [AttributeFormat; 3] =
    [(SCALAR, U8, false), (SCALAR, U16, false), (SCALAR, U32, false)];

/// Returns the formats allowed for the output of an animation with this target path, or `None` if
/// the path is unknown.
///
/// Translations and scales are always floats, because they have no natural range (glTF 2.0 §3.11).
pub(super) fn animation_output_formats(path: &str) -> Option<Vec<AttributeFormat>> {
    match path {
        "translation" | "scale" => Some(vec![(VEC3, F32, false)]),
        "rotation" => Some(float_or_normalized(&[VEC4], &[I8, U8, I16, U16])),
        "weights" => Some(float_or_normalized(&[SCALAR], &[I8, U8, I16, U16])),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn attribute_names_are_parsed() {
        assert_eq!(Semantic::from_name("TEXCOORD_10"), Some(Semantic::Numbered("TEXCOORD", 10)));
        assert_eq!(Semantic::from_name("NORMAL"), Some(Semantic::Single("NORMAL")));
        assert_eq!(Semantic::from_name("_HEAT"), Some(Semantic::Custom));
        for wrong in [
            "",
            "TEXCOORD",
            "TEXCOORD_",
            "TEXCOORD_01",
            "TEXCOORD_x",
            "UV_0",
            "NORMAL_0",
            "COLOR_0_1",
        ] {
            assert_eq!(Semantic::from_name(wrong), None, "{wrong}");
        }
    }

    #[test]
    fn quantization_adds_formats() {
        let position = Semantic::Single("POSITION");
        assert_eq!(position.allowed_formats(false, false), Some(vec![(VEC3, F32, false)]));
        assert_eq!(position.allowed_formats(false, true).unwrap().len(), 9);
        assert_eq!(position.allowed_formats(true, true).unwrap().len(), 5);
        assert_eq!(Semantic::Custom.allowed_formats(false, true), None);
        assert!(
            Semantic::Numbered("JOINTS", 0)
                .allowed_formats(false, true)
                .unwrap()
                .iter()
                .all(|f| !f.2)
        );
    }
}
