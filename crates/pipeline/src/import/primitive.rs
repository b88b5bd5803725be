//! Primitives: attributes and indices become plain arrays, and what cannot be drawn is dropped.
//!
//! Positions and indices make the shape; if they cannot be read the file is refused. All other attributes change only
//! its look: one that cannot be read is left out with a warning.

use super::accessor::Source;
use super::elements::Elements;
use super::error::{Fault, FaultKind};
use super::warnings::Warnings;
use super::{normals, topology};
use crate::model::{Mesh, Primitive};
use gltf::json;
use gltf::json::accessor::{ComponentType, Type};
use gltf::json::mesh::Semantic;
use gltf::json::validation::Checked;
use std::ops::Range;

/// So many sets of texture coordinates are read.
const UV_SETS: u32 = 8;

/// Reads all meshes of a file.
pub(super) fn meshes(source: &Source<'_>, warnings: &mut Warnings) -> Result<Vec<Mesh>, Fault> {
    let mut meshes = Vec::with_capacity(source.root.meshes.len());
    for (at, json) in source.root.meshes.iter().enumerate() {
        let mut primitives = Vec::with_capacity(json.primitives.len());
        for (part, json) in json.primitives.iter().enumerate() {
            let pointer = format!("/meshes/{at}/primitives/{part}");
            let reader = Reader { source, json, pointer, warnings: &mut *warnings };
            primitives.push(match reader.primitive() {
                Err(fault) if fault.kind == FaultKind::NoData => {
                    warnings.soft(&fault, "the primitive is left out");
                    Primitive::default()
                }
                primitive => primitive?,
            });
        }
        meshes.push(Mesh { name: json.name.clone(), primitives });
    }
    Ok(meshes)
}

/// Reads one primitive.
struct Reader<'a, 'w> {
    source: &'a Source<'a>,
    json: &'a json::mesh::Primitive,
    pointer: String,
    warnings: &'w mut Warnings,
}

impl<'a> Reader<'a, '_> {
    fn primitive(mut self) -> Result<Primitive, Fault> {
        let Checked::Valid(mode) = self.json.mode else {
            let pointer = format!("{}/mode", self.pointer);
            return Err(Fault::invalid(&pointer, "the mode is not one of 0 to 6"));
        };
        let Some(positions) = self.positions()? else { return Ok(Primitive::default()) };
        let vertices = positions.count;
        let (topology, indices) = topology::list(mode, self.indices(vertices)?);
        let mut primitive = Primitive { topology, indices, ..Primitive::default() };
        self.drop_lost_vertices(&mut primitive, vertices);
        let used = shift_to_zero(&mut primitive.indices);
        primitive.positions = self.source.floats(&positions.only(used.clone()))?;
        self.drop_lost_places(&mut primitive);
        self.attributes(&mut primitive, vertices, &used)?;
        primitive.material = self.material();
        Ok(primitive)
    }

    /// The positions; `None` if there is nothing to draw.
    fn positions(&mut self) -> Result<Option<Elements<'a>>, Fault> {
        let Some(accessor) = self.attribute(Semantic::Positions) else {
            self.warnings.add(&self.pointer, "there are no positions; the primitive is left out");
            return Ok(None);
        };
        if self.is_draco() && self.is_empty(accessor) {
            return Err(Fault::no_data(&self.pointer, "the data is compressed by Draco"));
        }
        use ComponentType::{F32, I8, I16, U8, U16};
        let format = Format { shapes: &[Type::Vec3], components: &[F32, I8, U8, I16, U16] };
        Ok(Some(self.elements("POSITION", accessor, &format)?))
    }

    fn is_draco(&self) -> bool {
        let extensions = self.json.extensions.as_ref();
        extensions.is_some_and(|e| e.others.contains_key("KHR_draco_mesh_compression"))
    }

    /// Whether an accessor exists and has no data of its own.
    fn is_empty(&self, accessor: usize) -> bool {
        let accessor = self.source.root.accessors.get(accessor);
        accessor.is_some_and(|json| json.buffer_view.is_none() && json.sparse.is_none())
    }

    /// The vertices in the order in which they are drawn; without indices that of the file.
    fn indices(&self, vertices: usize) -> Result<Vec<u32>, Fault> {
        let Some(accessor) = self.json.indices else {
            let accessor = self.attribute(Semantic::Positions).unwrap_or(0);
            self.source.charge(accessor, vertices, 4)?;
            return Ok((0..u32::try_from(vertices).unwrap_or(u32::MAX)).collect());
        };
        use ComponentType::{U8, U16, U32};
        let format = Format { shapes: &[Type::Scalar], components: &[U8, U16, U32] };
        let pointer = format!("{}/indices", self.pointer);
        let elements = self.source.elements(accessor.value(), &pointer)?;
        format.check(&elements, "indices", &pointer)?;
        self.source.indices(&elements)
    }

    /// Drops the items that have a corner without a vertex: every index then has one.
    fn drop_lost_vertices(&mut self, primitive: &mut Primitive, vertices: usize) {
        if primitive.indices.iter().all(|&i| (i as usize) < vertices) {
            return;
        }
        let has_vertices = |item: &[u32]| item.iter().all(|&i| (i as usize) < vertices);
        let dropped = retain_items(primitive, has_vertices);
        let message = format!("{dropped} items use vertices that do not exist; they are left out");
        self.warnings.add(&format!("{}/indices", self.pointer), message);
    }

    /// Drops the items that have a corner at a position that is no place: every position then is finite.
    fn drop_lost_places(&mut self, primitive: &mut Primitive) {
        let is_place = |p: &[f32; 3]| p.iter().all(|x| x.is_finite());
        if primitive.positions.iter().all(is_place) {
            return;
        }
        let mut positions = std::mem::take(&mut primitive.positions);
        let has_places = |item: &[u32]| item.iter().all(|&i| is_place(&positions[i as usize]));
        let dropped = retain_items(primitive, has_places);
        positions.iter_mut().filter(|p| !is_place(p)).for_each(|p| *p = [0.0; 3]);
        primitive.positions = positions;
        let message = format!("{dropped} items have corners at no finite place; they are left out");
        self.warnings.add(&format!("{}/attributes/POSITION", self.pointer), message);
    }

    /// Reads the attributes of the vertices in the range `used`; each should have as many elements as there are
    /// `vertices`.
    fn attributes(
        &mut self,
        primitive: &mut Primitive,
        vertices: usize,
        used: &Range<usize>,
    ) -> Result<(), Fault> {
        use ComponentType::{F32, I8, I16, U8, U16};
        let source = self.source;
        let span = Span { vertices, used: used.clone() };
        let normal = Format { shapes: &[Type::Vec3], components: &[F32, I8, I16] };
        primitive.normals =
            self.optional(Semantic::Normals, &normal, &span, |e| source.floats(&e))?;
        self.mend_normals(primitive);
        let uv = Format { shapes: &[Type::Vec2], components: &[F32, I8, U8, I16, U16] };
        for set in 0..UV_SETS {
            let read =
                self.optional(Semantic::TexCoords(set), &uv, &span, |e| source.floats(&e))?;
            let Some(mut uvs) = read else { break };
            self.mend_uvs(set, &mut uvs);
            primitive.uvs.push(uvs);
        }
        let color = Format { shapes: &[Type::Vec3, Type::Vec4], components: &[F32, U8, U16] };
        primitive.colors =
            self.optional(Semantic::Colors(0), &color, &span, |e| colors(source, e))?;
        let joint = Format { shapes: &[Type::Vec4], components: &[U8, U16] };
        primitive.joints =
            self.optional(Semantic::Joints(0), &joint, &span, |e| source.shorts(&e))?;
        let weight = Format { shapes: &[Type::Vec4], components: &[F32, U8, U16] };
        primitive.weights =
            self.optional(Semantic::Weights(0), &weight, &span, |e| source.floats(&e))?;
        Ok(())
    }

    /// An attribute that the picture can do without.
    fn optional<T>(
        &mut self,
        semantic: Semantic,
        format: &Format,
        span: &Span,
        read: impl Fn(Elements<'_>) -> Result<Vec<T>, Fault>,
    ) -> Result<Option<Vec<T>>, Fault> {
        let name = semantic.to_string();
        let Some(accessor) = self.attribute(semantic) else { return Ok(None) };
        if self.is_draco() && self.is_empty(accessor) {
            return Ok(None);
        }
        let checked = self.elements(&name, accessor, format).and_then(|elements| {
            if elements.count == span.vertices {
                return read(elements.only(span.used.clone()));
            }
            let problem = format!("{} values for {} vertices", elements.count, span.vertices);
            Err(Fault::invalid(&format!("{}/attributes/{name}", self.pointer), problem))
        });
        match checked {
            Err(fault) if fault.is_soft() => {
                self.warnings.soft(&fault, &format!("the attribute {name} is left out"));
                Ok(None)
            }
            values => values.map(Some),
        }
    }

    fn attribute(&self, semantic: Semantic) -> Option<usize> {
        self.json.attributes.get(&Checked::Valid(semantic)).map(json::Index::value)
    }

    fn elements(
        &self,
        name: &str,
        accessor: usize,
        format: &Format,
    ) -> Result<Elements<'a>, Fault> {
        let pointer = format!("{}/attributes/{name}", self.pointer);
        let elements = self.source.elements(accessor, &pointer)?;
        format.check(&elements, name, &pointer)?;
        Ok(elements)
    }

    fn mend_normals(&mut self, primitive: &mut Primitive) {
        let repairs = normals::unify(primitive);
        let pointer = format!("{}/attributes/NORMAL", self.pointer);
        if repairs.lengths > 0 {
            let message =
                format!("{} normals were not of unit length; they are now", repairs.lengths);
            self.warnings.add(&pointer, message);
        }
        if repairs.replaced > 0 {
            let message =
                format!("{} normals had no direction; they follow the faces", repairs.replaced);
            self.warnings.add(&pointer, message);
        }
    }

    fn mend_uvs(&mut self, set: u32, uvs: &mut [[f32; 2]]) {
        let mut mended = 0;
        for uv in uvs.iter_mut().filter(|uv| !(uv[0].is_finite() && uv[1].is_finite())) {
            *uv = [0.0; 2];
            mended += 1;
        }
        if mended > 0 {
            let pointer = format!("{}/attributes/TEXCOORD_{set}", self.pointer);
            self.warnings
                .add(&pointer, format!("{mended} texture coordinates are no numbers; they are 0"));
        }
    }

    fn material(&mut self) -> Option<usize> {
        let material = self.json.material?.value();
        let count = self.source.root.materials.len();
        if material < count {
            return Some(material);
        }
        let pointer = format!("{}/material", self.pointer);
        let fault = Fault::unresolved(&pointer, "material", material, count);
        self.warnings.soft(&fault, "the default material is used");
        None
    }
}

/// The vertices of a primitive, and which of them are used.
struct Span {
    vertices: usize,
    used: Range<usize>,
}

/// Counts the indices from the lowest one on; gives the range they came from. Parts of a model often share one long
/// array of vertices, of which each uses a stretch.
fn shift_to_zero(indices: &mut [u32]) -> Range<usize> {
    let (Some(&low), Some(&high)) = (indices.iter().min(), indices.iter().max()) else {
        return 0..0;
    };
    if low > 0 {
        indices.iter_mut().for_each(|index| *index -= low);
    }
    low as usize..high as usize + 1
}

/// Keeps the items that `keep` accepts; gives the number of the others.
fn retain_items(primitive: &mut Primitive, keep: impl Fn(&[u32]) -> bool) -> usize {
    let Primitive { topology, indices, .. } = primitive;
    let before = indices.len();
    let items = indices.chunks_exact(topology.corners());
    *indices = items.filter(|item| keep(item)).flatten().copied().collect();
    (before - indices.len()) / topology.corners()
}

/// Colours of three or four components as four, each in [0, 1]. Integers are normalised even if the file forgot to say
/// so: there is no other way to read them.
fn colors(source: &Source<'_>, mut elements: Elements<'_>) -> Result<Vec<[f32; 4]>, Fault> {
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
}

/// The formats an attribute may have.
struct Format {
    shapes: &'static [Type],
    components: &'static [ComponentType],
}

impl Format {
    fn check(&self, elements: &Elements<'_>, name: &str, pointer: &str) -> Result<(), Fault> {
        if self.shapes.contains(&elements.shape) && self.components.contains(&elements.component) {
            return Ok(());
        }
        let list = |words: Vec<String>| words.join(" or ");
        let shapes = list(self.shapes.iter().map(|s| shape_name(*s).to_owned()).collect());
        let components = list(self.components.iter().map(|c| c.as_gl_enum().to_string()).collect());
        let problem = format!(
            "{name} must be {shapes} of component type {components}, not {} of {}",
            shape_name(elements.shape),
            elements.component.as_gl_enum()
        );
        Err(Fault::invalid(pointer, problem))
    }
}

fn shape_name(shape: Type) -> &'static str {
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
