//! Vertex attributes: their allowed formats, and the reader for optional attributes.
//!
//! The formats listed here go beyond core glTF, because some files use quantized formats without
//! declaring KHR_mesh_quantization, and the meaning is unambiguous. The validator reports such
//! files.

use super::accessor::AccessorReader;
use super::draco::DracoData;
use super::elements::ResolvedAccessor;
use crate::warnings::ImportWarnings;
use files::counted;
use gltf::json::accessor::ComponentType::{self, F32, I8, I16, U8, U16, U32};
use gltf::json::accessor::Type;
use model::Diagnostic;
use std::ops::Range;

/// Element and component types allowed for an attribute or for animation values, including the
/// types that KHR_mesh_quantization adds.
///
/// Normalization is not restricted. Colors and keyframe values are always normalized; other
/// conversions follow the accessor's `normalized` flag.
pub(super) struct AllowedFormats {
    /// glTF's `type`.
    element_types: &'static [Type],
    /// glTF's `componentType`.
    component_types: &'static [ComponentType],
}

/// Primitive indices and edge vertices.
pub(super) const INDICES: AllowedFormats =
    AllowedFormats { element_types: &[Type::Scalar], component_types: &[U8, U16, U32] };
/// Positions; the integers come from KHR_mesh_quantization.
pub(super) const POSITION: AllowedFormats =
    AllowedFormats { element_types: &[Type::Vec3], component_types: &[F32, I8, U8, I16, U16] };
/// Normals; the signed integers come from KHR_mesh_quantization.
pub(super) const NORMAL: AllowedFormats =
    AllowedFormats { element_types: &[Type::Vec3], component_types: &[F32, I8, I16] };
/// Tangents with the handedness of the bitangent in w.
pub(super) const TANGENT: AllowedFormats =
    AllowedFormats { element_types: &[Type::Vec4], component_types: &[F32, I8, I16] };
/// Texture coordinates, possibly outside [0, 1].
pub(super) const TEXCOORD: AllowedFormats =
    AllowedFormats { element_types: &[Type::Vec2], component_types: &[F32, I8, U8, I16, U16] };
/// Vertex colors, linear RGB with or without alpha.
pub(super) const COLOR: AllowedFormats =
    AllowedFormats { element_types: &[Type::Vec3, Type::Vec4], component_types: &[F32, U8, U16] };
/// Scalars of a custom attribute, such as `_TEMPERATURE`.
pub(super) const CUSTOM_SCALAR: AllowedFormats = AllowedFormats {
    element_types: &[Type::Scalar],
    component_types: &[F32, I8, U8, I16, U16, U32],
};
/// Joint indices, four per vertex.
pub(super) const JOINTS: AllowedFormats =
    AllowedFormats { element_types: &[Type::Vec4], component_types: &[U8, U16] };
/// Joint weights, four per vertex; integers are normalized.
pub(super) const WEIGHTS: AllowedFormats =
    AllowedFormats { element_types: &[Type::Vec4], component_types: &[F32, U8, U16] };
/// Keyframe values of translations and scales.
pub(super) const TRANSLATION_OR_SCALE: AllowedFormats =
    AllowedFormats { element_types: &[Type::Vec3], component_types: &[F32] };
/// Keyframe values of rotations: quaternions in the order x, y, z, w.
pub(super) const ROTATION: AllowedFormats =
    AllowedFormats { element_types: &[Type::Vec4], component_types: &[F32, I8, U8, I16, U16] };
/// Keyframe values of single numbers and morph weights.
pub(super) const SCALAR_VALUES: AllowedFormats =
    AllowedFormats { element_types: &[Type::Scalar], component_types: &[F32, I8, U8, I16, U16] };
/// Keyframe values of pairs, such as texture offsets.
pub(super) const VEC2_VALUES: AllowedFormats =
    AllowedFormats { element_types: &[Type::Vec2], ..SCALAR_VALUES };
/// Keyframe values of triples, such as colors.
pub(super) const VEC3_VALUES: AllowedFormats =
    AllowedFormats { element_types: &[Type::Vec3], ..SCALAR_VALUES };

impl AllowedFormats {
    /// Checks that an accessor has one of the formats.
    ///
    /// # Errors
    /// Fails if the format is not allowed. The message lists the allowed types by the names and
    /// numbers that files use for them.
    pub(super) fn check_elements(
        &self,
        elements: &ResolvedAccessor<'_>,
        pointer: &str,
    ) -> Result<(), Diagnostic> {
        if self.element_types.contains(&elements.element_type)
            && self.component_types.contains(&elements.component_type)
        {
            return Ok(());
        }
        let shapes: Vec<&str> = self.element_types.iter().map(|&shape| type_name(shape)).collect();
        let components: Vec<String> =
            self.component_types.iter().map(|c| c.as_gl_enum().to_string()).collect();
        let message = format!(
            "must be {} of component type {}, not {} of {}",
            shapes.join(" or "),
            components.join(" or "),
            type_name(elements.element_type),
            elements.component_type.as_gl_enum()
        );
        Err(Diagnostic::invalid(pointer, message))
    }
}

/// Returns the JSON name of an element type.
fn type_name(shape: Type) -> &'static str {
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

/// The vertices of a primitive, and the range of them that its indices use.
///
/// Attribute arrays have `used.len()` elements; index 0 is the vertex `used.start` in the file.
pub(super) struct VertexRange {
    /// Number of vertices in the file.
    pub(super) vertices: usize,
    /// The vertices from the lowest to the highest index.
    pub(super) used: Range<usize>,
}

/// Reads the attributes of one primitive.
pub(super) struct AttributeReader<'a, 'w> {
    pub(super) source: &'a AccessorReader<'a>,
    pub(super) range: VertexRange,
    /// Decoded attributes of a Draco-compressed primitive. An attribute that is neither here nor in
    /// a buffer is then absent, not zero.
    pub(super) draco: Option<&'a DracoData>,
    pub(super) warnings: &'w mut ImportWarnings,
}

impl AttributeReader<'_, '_> {
    /// Reads an optional attribute. An invalid attribute is skipped with a warning.
    ///
    /// Only the vertices in the range that the indices use are converted.
    ///
    /// # Errors
    /// Fails if a limit is exceeded or a file cannot be read; errors in the content are warnings.
    pub(super) fn read_attribute<T>(
        &mut self,
        accessor: Option<usize>,
        pointer: &str,
        format: &AllowedFormats,
        read: impl Fn(&AccessorReader<'_>, ResolvedAccessor<'_>) -> Result<Vec<T>, Diagnostic>,
    ) -> Result<Option<Vec<T>>, Diagnostic> {
        let Some(accessor) = accessor else { return Ok(None) };
        // A file may declare an attribute that is neither in the stream nor in a buffer.
        let is_absent = |decoded: &DracoData| {
            !decoded.has_accessor(accessor) && self.source.has_no_data(accessor)
        };
        if self.draco.is_some_and(is_absent) {
            return Ok(None);
        }
        let checked = self.source.resolve_accessor(accessor, pointer).and_then(|elements| {
            format.check_elements(&elements, pointer)?;
            let elements = match self.draco {
                Some(decoded) => decoded.attach_data(elements),
                None => elements,
            };
            let VertexRange { vertices, used } = &self.range;
            if elements.count == *vertices {
                return read(self.source, elements.slice_range(used.clone()));
            }
            let message = format!(
                "{} for {}",
                counted(elements.count, "value", "values"),
                counted(vertices, "vertex", "vertices")
            );
            Err(Diagnostic::invalid(pointer, message))
        });
        match checked {
            Err(diagnostic) if diagnostic.is_downgradable() => {
                let name = pointer.rsplit('/').next().unwrap_or(pointer);
                self.warnings.downgrade(&diagnostic, &format!("the attribute {name} is skipped"));
                Ok(None)
            }
            values => values.map(Some),
        }
    }

    /// Reads a set of texture coordinates.
    ///
    /// Non-finite coordinates become 0, because a NaN would disturb a triangle's mip level
    /// selection. Coordinates outside [0, 1] are valid, because the sampler wraps them.
    ///
    /// # Errors
    /// Fails if a limit is exceeded or a file cannot be read.
    pub(super) fn read_texcoords(
        &mut self,
        accessor: Option<usize>,
        pointer: &str,
    ) -> Result<Option<Vec<[f32; 2]>>, Diagnostic> {
        let read =
            self.read_attribute(accessor, pointer, &TEXCOORD, |source, e| source.read_floats(&e))?;
        let Some(mut uvs) = read else { return Ok(None) };
        let is_nonfinite = |uv: &[f32; 2]| !(uv[0].is_finite() && uv[1].is_finite());
        let mut nonfinite = 0;
        for uv in uvs.iter_mut().filter(|uv| is_nonfinite(uv)) {
            *uv = [0.0; 2];
            nonfinite += 1;
        }
        if nonfinite > 0 {
            let (noun, verb) =
                if nonfinite == 1 { ("vertex", "has") } else { ("vertices", "have") };
            let message = format!(
                "{nonfinite} {noun} {verb} texture coordinates that are not finite; \
                 the coordinates are set to 0"
            );
            self.warnings.push_warning(pointer, message);
        }
        Ok(Some(uvs))
    }

    /// Reads colors with three or four components as RGBA, each component clamped to [0, 1].
    ///
    /// Colors with three components are opaque. Only color deltas in morph targets may be negative,
    /// so clamping here loses nothing.
    ///
    /// # Errors
    /// Fails if a limit is exceeded or a file cannot be read.
    pub(super) fn read_colors(
        &mut self,
        accessor: Option<usize>,
        pointer: &str,
    ) -> Result<Option<Vec<[f32; 4]>>, Diagnostic> {
        self.read_attribute(accessor, pointer, &COLOR, |source, mut elements| {
            // Integers are normalized even without `normalized`: integer colors have no other
            // meaning, and some exporters omit the flag.
            elements.normalized = true;
            let mut colors: Vec<[f32; 4]> = source.read_floats(&elements)?;
            for color in &mut colors {
                if elements.element_type == Type::Vec3 {
                    color[3] = 1.0;
                }
                // The comparison is false for NaN, which becomes 0.
                *color = color.map(|x| if x > 0.0 { x.min(1.0) } else { 0.0 });
            }
            Ok(colors)
        })
    }
}
