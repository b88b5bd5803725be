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

impl Reader<'_, '_> {
    fn primitive(mut self) -> Result<Primitive, Fault> {
        let Checked::Valid(mode) = self.json.mode else {
            let pointer = format!("{}/mode", self.pointer);
            return Err(Fault::invalid(&pointer, "the mode is not one of 0 to 6"));
        };
        let Some(positions) = self.positions()? else { return Ok(Primitive::default()) };
        let (topology, indices) = topology::list(mode, self.indices(positions.len())?);
        let mut primitive = Primitive { topology, indices, positions, ..Primitive::default() };
        self.drop_impossible(&mut primitive);
        self.attributes(&mut primitive)?;
        primitive.material = self.material();
        Ok(primitive)
    }

    /// The positions; `None` if there is nothing to draw.
    fn positions(&mut self) -> Result<Option<Vec<[f32; 3]>>, Fault> {
        let Some(accessor) = self.attribute(Semantic::Positions) else {
            self.warnings.add(&self.pointer, "there are no positions; the primitive is left out");
            return Ok(None);
        };
        if self.is_draco() && self.is_empty(accessor) {
            return Err(Fault::no_data(&self.pointer, "the data is compressed by Draco"));
        }
        use ComponentType::{F32, I8, I16, U8, U16};
        let format = Format { shapes: &[Type::Vec3], components: &[F32, I8, U8, I16, U16] };
        Ok(Some(self.elements("POSITION", accessor, &format)?.floats()))
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
            return Ok((0..vertices as u32).collect());
        };
        use ComponentType::{U8, U16, U32};
        let format = Format { shapes: &[Type::Scalar], components: &[U8, U16, U32] };
        let pointer = format!("{}/indices", self.pointer);
        let elements = self.source.elements(accessor.value(), &pointer)?;
        format.check(&elements, "indices", &pointer)?;
        Ok(elements.indices())
    }

    /// Drops the items that have a corner without a vertex, or at a position that is no place. The list keeps its
    /// promise: every index has a vertex, every position is finite.
    fn drop_impossible(&mut self, primitive: &mut Primitive) {
        let vertices = primitive.positions.len();
        let corners = primitive.topology.corners();
        let is_place = |p: &[f32; 3]| p.iter().all(|x| x.is_finite());
        if primitive.indices.iter().any(|&i| i as usize >= vertices) {
            let has_vertices = |item: &[u32]| item.iter().all(|&i| (i as usize) < vertices);
            let dropped = retain_items(&mut primitive.indices, corners, has_vertices);
            let message =
                format!("{dropped} items use vertices that do not exist; they are left out");
            self.warnings.add(&format!("{}/indices", self.pointer), message);
        }
        if !primitive.positions.iter().all(is_place) {
            let positions = &primitive.positions;
            let has_places = |item: &[u32]| item.iter().all(|&i| is_place(&positions[i as usize]));
            let dropped = retain_items(&mut primitive.indices, corners, has_places);
            primitive.positions.iter_mut().filter(|p| !is_place(p)).for_each(|p| *p = [0.0; 3]);
            let message =
                format!("{dropped} items have corners at no finite place; they are left out");
            self.warnings.add(&format!("{}/attributes/POSITION", self.pointer), message);
        }
    }

    fn attributes(&mut self, primitive: &mut Primitive) -> Result<(), Fault> {
        use ComponentType::{F32, I8, I16, U8, U16};
        let count = primitive.positions.len();
        let normal = Format { shapes: &[Type::Vec3], components: &[F32, I8, I16] };
        primitive.normals = self.optional(Semantic::Normals, &normal, count, |e| e.floats())?;
        self.mend_normals(primitive);
        let uv = Format { shapes: &[Type::Vec2], components: &[F32, I8, U8, I16, U16] };
        for set in 0..UV_SETS {
            let read = self.optional(Semantic::TexCoords(set), &uv, count, |e| e.floats())?;
            let Some(mut uvs) = read else { break };
            self.mend_uvs(set, &mut uvs);
            primitive.uvs.push(uvs);
        }
        let color = Format { shapes: &[Type::Vec3, Type::Vec4], components: &[F32, U8, U16] };
        primitive.colors = self.optional(Semantic::Colors(0), &color, count, colors)?;
        let joint = Format { shapes: &[Type::Vec4], components: &[U8, U16] };
        primitive.joints = self.optional(Semantic::Joints(0), &joint, count, |e| e.shorts())?;
        let weight = Format { shapes: &[Type::Vec4], components: &[F32, U8, U16] };
        primitive.weights = self.optional(Semantic::Weights(0), &weight, count, |e| e.floats())?;
        Ok(())
    }

    /// An attribute that the picture can do without.
    fn optional<T>(
        &mut self,
        semantic: Semantic,
        format: &Format,
        vertices: usize,
        read: impl Fn(&Elements<'_>) -> Vec<T>,
    ) -> Result<Option<Vec<T>>, Fault> {
        let name = semantic.to_string();
        let Some(accessor) = self.attribute(semantic) else { return Ok(None) };
        if self.is_draco() && self.is_empty(accessor) {
            return Ok(None);
        }
        let checked = self.elements(&name, accessor, format).and_then(|elements| {
            let problem = format!("{} values for {vertices} vertices", elements.count);
            let pointer = format!("{}/attributes/{name}", self.pointer);
            if elements.count == vertices {
                Ok(elements)
            } else {
                Err(Fault::invalid(&pointer, problem))
            }
        });
        match checked {
            Ok(elements) => Ok(Some(read(&elements))),
            Err(fault) if fault.is_soft() => {
                self.warnings.soft(&fault, &format!("the attribute {name} is left out"));
                Ok(None)
            }
            Err(fault) => Err(fault),
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
    ) -> Result<Elements<'_>, Fault> {
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

/// Keeps the items of a list that `keep` accepts; gives the number of the others.
fn retain_items(indices: &mut Vec<u32>, corners: usize, keep: impl Fn(&[u32]) -> bool) -> usize {
    let before = indices.len();
    let kept: Vec<u32> =
        indices.chunks_exact(corners).filter(|i| keep(i)).flatten().copied().collect();
    *indices = kept;
    (before - indices.len()) / corners
}

/// Colours of three or four components as four, each in [0, 1].
fn colors(elements: &Elements<'_>) -> Vec<[f32; 4]> {
    // max before clamp: not a number becomes 0.
    let inside = |x: f32| x.max(0.0).min(1.0);
    match elements.shape {
        Type::Vec4 => elements.floats::<4>().into_iter().map(|c| c.map(inside)).collect(),
        _ => {
            let opaque = |[r, g, b]: [f32; 3]| [r, g, b, 1.0];
            elements.floats().into_iter().map(|c: [f32; 3]| opaque(c.map(inside))).collect()
        }
    }
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
