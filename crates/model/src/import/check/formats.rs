//! The formats that each attribute may have (glTF 2.0 §3.7.2.1 and §3.7.2.2), and those KHR_mesh_quantization adds.

use super::layout::Component::{F32, I8, I16, U8, U16, U32};
use super::layout::{Component, Layout, SCALAR, Shape, VEC2, VEC3, VEC4};

/// A format: how many numbers, their type, and whether integers are normalised.
type Format = (Shape, Component, bool);

/// What the name of an attribute says: its kind, and which one of several it is.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Semantic<'a> {
    /// POSITION, NORMAL, TANGENT.
    One(&'a str),
    /// TEXCOORD_0 and the like.
    Numbered(&'a str, u32),
    /// A name of its own, which begins with an underscore.
    Own,
}

impl<'a> Semantic<'a> {
    /// `None` for a name that glTF does not have.
    pub(super) fn of(name: &'a str) -> Option<Self> {
        if name.starts_with('_') {
            return Some(Self::Own);
        }
        if ["POSITION", "NORMAL", "TANGENT"].contains(&name) {
            return Some(Self::One(name));
        }
        let (kind, number) = name.split_once('_')?;
        let is_plain = number.bytes().all(|b| b.is_ascii_digit())
            && (number == "0" || !number.starts_with('0'));
        let is_known = ["TEXCOORD", "COLOR", "JOINTS", "WEIGHTS"].contains(&kind);
        let number = number.parse().ok().filter(|_| is_known && is_plain)?;
        Some(Self::Numbered(kind, number))
    }

    fn kind(self) -> &'a str {
        match self {
            Self::One(kind) | Self::Numbered(kind, _) => kind,
            Self::Own => "",
        }
    }

    /// The formats that an attribute may have; `None` for a name of its own, which may have any.
    pub(super) fn formats(self, in_target: bool, quantized: bool) -> Option<Vec<Format>> {
        let mut formats: Vec<Format> = match (self.kind(), in_target) {
            ("", _) => return None,
            ("TANGENT", false) => vec![(VEC4, F32, false)],
            ("POSITION" | "NORMAL" | "TANGENT", _) => vec![(VEC3, F32, false)],
            ("TEXCOORD", false) => soft(&[VEC2], &[U8, U16]),
            ("TEXCOORD", true) => soft(&[VEC2], &[I8, U8, I16, U16]),
            ("COLOR", false) => soft(&[VEC3, VEC4], &[U8, U16]),
            ("COLOR", true) => soft(&[VEC3, VEC4], &[I8, U8, I16, U16]),
            ("JOINTS", _) => vec![(VEC4, U8, false), (VEC4, U16, false)],
            _ => soft(&[VEC4], &[U8, U16]),
        };
        if quantized {
            formats.extend(self.quantized(in_target));
        }
        Some(formats)
    }

    fn quantized(self, in_target: bool) -> Vec<Format> {
        let all = |shape, components: &[Component], normalized: &[bool]| {
            let pairs = components.iter().flat_map(|&c| normalized.iter().map(move |&n| (c, n)));
            pairs.map(|(component, normalized)| (shape, component, normalized)).collect()
        };
        match (self.kind(), in_target) {
            ("POSITION", false) => all(VEC3, &[I8, U8, I16, U16], &[false, true]),
            ("POSITION", true) => all(VEC3, &[I8, I16], &[false, true]),
            ("NORMAL", _) | ("TANGENT", true) => all(VEC3, &[I8, I16], &[true]),
            ("TANGENT", false) => all(VEC4, &[I8, I16], &[true]),
            ("TEXCOORD", false) => all(VEC2, &[I8, U8, I16, U16], &[false, true]),
            _ => Vec::new(),
        }
    }
}

/// Floats, or normalised integers of some types.
fn soft(shapes: &[Shape], components: &[Component]) -> Vec<Format> {
    let of = |&shape: &Shape| {
        let integers = components.iter().map(move |&component| (shape, component, true));
        std::iter::once((shape, F32, false)).chain(integers)
    };
    shapes.iter().flat_map(of).collect()
}

/// Whether a layout is one of some formats.
pub(super) fn is_one_of(layout: Layout, formats: &[Format]) -> bool {
    formats.contains(&(layout.shape, layout.component, layout.normalized))
}

/// What indices may be.
pub(super) const INDICES: [Format; 3] =
    [(SCALAR, U8, false), (SCALAR, U16, false), (SCALAR, U32, false)];

/// What the values of an animation may be, by the path they move; `None` for a path that is not known.
pub(super) fn outputs(path: &str) -> Option<Vec<Format>> {
    match path {
        "translation" | "scale" => Some(vec![(VEC3, F32, false)]),
        "rotation" => Some(soft(&[VEC4], &[I8, U8, I16, U16])),
        "weights" => Some(soft(&[SCALAR], &[I8, U8, I16, U16])),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_attributes() {
        assert_eq!(Semantic::of("TEXCOORD_10"), Some(Semantic::Numbered("TEXCOORD", 10)));
        assert_eq!(Semantic::of("NORMAL"), Some(Semantic::One("NORMAL")));
        assert_eq!(Semantic::of("_HEAT"), Some(Semantic::Own));
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
            assert_eq!(Semantic::of(wrong), None, "{wrong}");
        }
    }

    #[test]
    fn quantization_widens_the_formats() {
        let position = Semantic::One("POSITION");
        assert_eq!(position.formats(false, false), Some(vec![(VEC3, F32, false)]));
        assert_eq!(position.formats(false, true).unwrap().len(), 9);
        assert_eq!(position.formats(true, true).unwrap().len(), 5);
        assert_eq!(Semantic::Own.formats(false, true), None);
        assert!(Semantic::Numbered("JOINTS", 0).formats(false, true).unwrap().iter().all(|f| !f.2));
    }
}
