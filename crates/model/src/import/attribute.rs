//! Attributes of vertices: the formats each may have, and reading those that the picture can do without.

use super::accessor::Source;
use super::draco::Decoded;
use super::elements::Elements;
use super::error::Fault;
use super::warnings::Warnings;
use gltf::json::accessor::ComponentType::{self, F32, I8, I16, U8, U16, U32};
use gltf::json::accessor::Type;
use std::ops::Range;

/// The formats an attribute of vertices or instances, or the values of an animation, may have, those of KHR_mesh_quantization among them.
pub(super) struct Format {
    shapes: &'static [Type],
    components: &'static [ComponentType],
}

pub(super) const INDICES: Format = Format { shapes: &[Type::Scalar], components: &[U8, U16, U32] };
pub(super) const POSITION: Format =
    Format { shapes: &[Type::Vec3], components: &[F32, I8, U8, I16, U16] };
pub(super) const NORMAL: Format = Format { shapes: &[Type::Vec3], components: &[F32, I8, I16] };
pub(super) const TANGENT: Format = Format { shapes: &[Type::Vec4], components: &[F32, I8, I16] };
pub(super) const TEXCOORD: Format =
    Format { shapes: &[Type::Vec2], components: &[F32, I8, U8, I16, U16] };
pub(super) const COLOR: Format =
    Format { shapes: &[Type::Vec3, Type::Vec4], components: &[F32, U8, U16] };
pub(super) const JOINTS: Format = Format { shapes: &[Type::Vec4], components: &[U8, U16] };
pub(super) const WEIGHTS: Format = Format { shapes: &[Type::Vec4], components: &[F32, U8, U16] };
pub(super) const PLACE: Format = Format { shapes: &[Type::Vec3], components: &[F32] };
pub(super) const TURN: Format =
    Format { shapes: &[Type::Vec4], components: &[F32, I8, U8, I16, U16] };
pub(super) const KEYS: Format =
    Format { shapes: &[Type::Scalar], components: &[F32, I8, U8, I16, U16] };
pub(super) const PAIRS: Format = Format { shapes: &[Type::Vec2], ..KEYS };
pub(super) const TRIPLES: Format = Format { shapes: &[Type::Vec3], ..KEYS };

impl Format {
    pub(super) fn check(&self, elements: &Elements<'_>, pointer: &str) -> Result<(), Fault> {
        if self.shapes.contains(&elements.shape) && self.components.contains(&elements.component) {
            return Ok(());
        }
        let shapes: Vec<&str> = self.shapes.iter().map(|&shape| name(shape)).collect();
        let components: Vec<String> =
            self.components.iter().map(|c| c.as_gl_enum().to_string()).collect();
        let problem = format!(
            "must be {} of component type {}, not {} of {}",
            shapes.join(" or "),
            components.join(" or "),
            name(elements.shape),
            elements.component.as_gl_enum()
        );
        Err(Fault::invalid(pointer, problem))
    }
}

fn name(shape: Type) -> &'static str {
    match shape {
        Type::Scalar => "SCALAR",
        Type::Vec2 => "VEC2",
        Type::Vec3 => "VEC3",
        Type::Vec4 => "VEC4",
        Type::Mat2 => "MAT2",
        Type::Mat3 => "MAT3",
        Type::Mat4 => "MAT4",
    }
}

/// The vertices of a primitive, and which of them are used.
pub(super) struct Span {
    /// How many the file has.
    pub(super) vertices: usize,
    /// Which ones the indices use.
    pub(super) used: Range<usize>,
}

/// Reads the attributes of one primitive.
pub(super) struct Attributes<'a, 'w> {
    pub(super) source: &'a Source<'a>,
    pub(super) span: Span,
    /// What the primitive has in a compressed stream. An accessor without bytes then is not zeros.
    pub(super) decoded: Option<&'a Decoded>,
    pub(super) warnings: &'w mut Warnings,
}

impl Attributes<'_, '_> {
    /// An attribute that the picture can do without: one that cannot be read is left out with a warning.
    pub(super) fn read<T>(
        &mut self,
        accessor: Option<usize>,
        pointer: &str,
        format: &Format,
        read: impl Fn(&Source<'_>, Elements<'_>) -> Result<Vec<T>, Fault>,
    ) -> Result<Option<Vec<T>>, Fault> {
        let Some(accessor) = accessor else { return Ok(None) };
        let is_absent =
            |decoded: &Decoded| !decoded.has(accessor) && self.source.is_empty(accessor);
        if self.decoded.is_some_and(is_absent) {
            return Ok(None);
        }
        let checked = self.source.elements(accessor, pointer).and_then(|elements| {
            format.check(&elements, pointer)?;
            let elements = match self.decoded {
                Some(decoded) => decoded.lend(elements),
                None => elements,
            };
            let Span { vertices, used } = &self.span;
            if elements.count == *vertices {
                return read(self.source, elements.only(used.clone()));
            }
            let problem = format!("{} values for {vertices} vertices", elements.count);
            Err(Fault::invalid(pointer, problem))
        });
        match checked {
            Err(fault) if fault.is_soft() => {
                let name = pointer.rsplit('/').next().unwrap_or(pointer);
                self.warnings.soft(&fault, &format!("the attribute {name} is left out"));
                Ok(None)
            }
            values => values.map(Some),
        }
    }

    /// Texture coordinates, finite.
    pub(super) fn texcoords(
        &mut self,
        accessor: Option<usize>,
        pointer: &str,
    ) -> Result<Option<Vec<[f32; 2]>>, Fault> {
        let read = self.read(accessor, pointer, &TEXCOORD, |source, e| source.floats(&e))?;
        let Some(mut uvs) = read else { return Ok(None) };
        let is_lost = |uv: &[f32; 2]| !(uv[0].is_finite() && uv[1].is_finite());
        let mut lost = 0;
        for uv in uvs.iter_mut().filter(|uv| is_lost(uv)) {
            *uv = [0.0; 2];
            lost += 1;
        }
        if lost > 0 {
            let message = format!("coordinates are no numbers; they are 0 (vertices: {lost})");
            self.warnings.add(pointer, message);
        }
        Ok(Some(uvs))
    }

    /// Colours of three or four components as four, each in [0, 1].
    pub(super) fn colors(
        &mut self,
        accessor: Option<usize>,
        pointer: &str,
    ) -> Result<Option<Vec<[f32; 4]>>, Fault> {
        self.read(accessor, pointer, &COLOR, |source, mut elements| {
            // Integers are normalised even if the file forgot to say so: there is no other way to read them.
            elements.normalized = true;
            let mut colors: Vec<[f32; 4]> = source.floats(&elements)?;
            for color in &mut colors {
                if elements.shape == Type::Vec3 {
                    color[3] = 1.0;
                }
                // What is not a number becomes 0.
                *color = color.map(|x| if x > 0.0 { x.min(1.0) } else { 0.0 });
            }
            Ok(colors)
        })
    }
}
