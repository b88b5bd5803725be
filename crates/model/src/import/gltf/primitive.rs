//! Mesh primitives: accessors become plain arrays, and what cannot be drawn is removed.
//!
//! Positions and indices define the shape; if they are invalid the file is refused. All other
//! attributes change only the look: an invalid one is left out with a warning.
//!
//! ```text
//!  POSITION ──► number of vertices ─┐
//!  indices ───► expand strips, fans ┴─► drop items out of range ─► renumber from the lowest vertex
//!                                             │
//!  positions of that range ─► drop items with vertices that are not finite ─► other attributes
//! ```
//!
//! Only the range of vertices between the lowest and the highest index is read: exporters that
//! share one array of vertices between all primitives would otherwise cost memory in the square of
//! their number.

use super::accessor::AccessorReader;
use super::attribute::{
    AttributeReader, INDICES, JOINTS, NORMAL, POSITION, TANGENT, VertexRange, WEIGHTS,
};
use super::draco::DracoData;
use super::elements::ResolvedAccessor;
use super::morph_target::MorphTargetReader;
use super::untyped_members::UntypedMembers;
use super::{draco, edge_visibility, selection, topology};
use crate::diagnostic::{Diagnostic, codes};
use crate::import::normals;
use crate::import::warnings::ImportWarnings;
use crate::{Material, Mesh, Primitive, PrimitiveEdges, Topology, VariantMaterial};
use gltf::json;
use gltf::json::mesh::Semantic;
use gltf::json::validation::Checked;
use std::ops::Range;

/// Sets of texture coordinates that are read.
pub(super) const UV_SETS: u32 = 8;
/// Sets of joints that are read.
const JOINT_SETS: u32 = 16;

/// Context of primitives: other parts of the file that they refer to.
#[derive(Clone, Copy)]
pub(super) struct PrimitiveContext<'a> {
    pub(super) materials: &'a [Material],
    pub(super) variants: usize,
    pub(super) untyped: &'a UntypedMembers,
}

/// Reads all meshes of a file.
pub(super) fn import_meshes(
    source: &AccessorReader<'_>,
    context: PrimitiveContext<'_>,
    warnings: &mut ImportWarnings,
) -> Result<Vec<Mesh>, Diagnostic> {
    let mut meshes = Vec::with_capacity(source.root.meshes.len());
    for (at, json) in source.root.meshes.iter().enumerate() {
        let mut primitives = Vec::with_capacity(json.primitives.len());
        for (part, json) in json.primitives.iter().enumerate() {
            let pointer = format!("/meshes/{at}/primitives/{part}");
            let place = (at, part);
            let reader = PrimitiveReader {
                source,
                json,
                context,
                mesh_and_part: place,
                pointer,
                warnings: &mut *warnings,
            };
            primitives.push(match reader.read_primitive() {
                Err(diagnostic) if diagnostic.code == codes::MISSING_DATA => {
                    warnings.downgrade(&diagnostic, "the primitive is left out");
                    Primitive::default()
                }
                Err(diagnostic) => {
                    warnings.downgrade_if_lenient(diagnostic, "the primitive is left out")?;
                    Primitive::default()
                }
                Ok(primitive) => primitive,
            });
        }
        let weights = json.weights.clone().unwrap_or_default();
        meshes.push(Mesh { name: json.name.clone(), primitives, morph_weights: weights });
    }
    Ok(meshes)
}

/// Reader of one primitive.
struct PrimitiveReader<'a, 'w> {
    source: &'a AccessorReader<'a>,
    json: &'a json::mesh::Primitive,
    context: PrimitiveContext<'a>,
    /// Index of the mesh, and of the primitive in it.
    mesh_and_part: (usize, usize),
    pointer: String,
    warnings: &'w mut ImportWarnings,
}

impl<'a> PrimitiveReader<'a, '_> {
    /// Reads the primitive: decompresses it, expands strips and fans, removes invalid items, then
    /// reads the attributes of the vertices that are used.
    fn read_primitive(mut self) -> Result<Primitive, Diagnostic> {
        let Checked::Valid(mode) = self.json.mode else {
            let pointer = format!("{}/mode", self.pointer);
            return Err(Diagnostic::invalid(&pointer, "the mode is not one of 0 to 6"));
        };
        let (material, variants) = (self.checked_material(), self.read_variants());
        let needs_tangents = self.needs_tangents(material, &variants);
        let mut decoded = self.decode_draco_data(needs_tangents)?;
        let triangles = decoded.as_mut().map(|decoded| std::mem::take(&mut decoded.indices));
        let decoded = decoded.as_ref();
        let Some(positions) = self.position_elements(decoded)? else {
            return Ok(Primitive::default());
        };
        let vertices = positions.count;
        let (topology, indices) = match triangles {
            Some(triangles) => (Topology::Triangles, triangles),
            None => topology::expand_to_list(mode, self.read_vertex_order(vertices)?),
        };
        let mut primitive = Primitive {
            topology,
            indices,
            material,
            material_variants: variants,
            ..Primitive::default()
        };
        primitive.edges = self.read_edges(&primitive, vertices)?;
        self.drop_items_without_vertices(&mut primitive, vertices);
        let used = rebase_indices(&mut primitive.indices);
        if let Some(edges) = &mut primitive.edges {
            edge_visibility::rebase_edges(edges, &used);
        }
        primitive.positions = self.source.read_floats(&positions.slice_range(used.clone()))?;
        self.drop_nonfinite_items(&mut primitive);
        self.read_attributes(
            &mut primitive,
            VertexRange { vertices, used },
            decoded,
            needs_tangents,
        )?;
        self.repair_normals(&mut primitive);
        Ok(primitive)
    }

    /// Whether some material of the primitive needs a tangent frame; tangents are read only then.
    fn needs_tangents(&self, material: Option<usize>, variants: &[VariantMaterial]) -> bool {
        let others = variants.iter().map(|variant| variant.material);
        let mut all = material.into_iter().chain(others);
        all.any(|at| self.context.materials.get(at).is_some_and(Material::needs_tangents))
    }

    fn read_variants(&mut self) -> Vec<VariantMaterial> {
        let PrimitiveContext { variants, .. } = self.context;
        let root = self.source.root;
        selection::variant_materials(root, self.json, &self.pointer, variants, self.warnings)
    }

    /// Edges for line drawings.
    fn read_edges(
        &mut self,
        primitive: &Primitive,
        vertices: usize,
    ) -> Result<Option<Box<PrimitiveEdges>>, Diagnostic> {
        let reader = edge_visibility::EdgeReader {
            source: self.source,
            json: self.json,
            pointer: &self.pointer,
            vertices,
            triangles: primitive.item_count(),
            warnings: self.warnings,
        };
        reader.read_edges(primitive.topology)
    }

    /// Decoded data of a Draco-compressed primitive.
    ///
    /// `None` if it is not compressed, or if the stream is broken and the file has uncompressed
    /// data as a fallback for readers without the extension; a warning says so.
    fn decode_draco_data(&mut self, tangents: bool) -> Result<Option<DracoData>, Diagnostic> {
        let positions = self.attribute_accessor(Semantic::Positions);
        let has_other_data = positions.is_some_and(|accessor| !self.source.has_no_data(accessor));
        match draco::decode_draco(self.source, self.json, tangents, &self.pointer) {
            Err(diagnostic) if diagnostic.is_downgradable() && has_other_data => {
                self.warnings.downgrade(&diagnostic, "the uncompressed data is used");
                Ok(None)
            }
            decoded => decoded,
        }
    }

    /// The positions; `None` if the primitive has none.
    fn position_elements<'e>(
        &mut self,
        decoded: Option<&'e DracoData>,
    ) -> Result<Option<ResolvedAccessor<'e>>, Diagnostic>
    where
        'a: 'e,
    {
        let Some(accessor) = self.attribute_accessor(Semantic::Positions) else {
            self.warnings
                .push_warning(&self.pointer, "there are no positions; the primitive is left out");
            return Ok(None);
        };
        let pointer = format!("{}/attributes/POSITION", self.pointer);
        let elements = self.source.resolve_accessor(accessor, &pointer)?;
        POSITION.check_elements(&elements, &pointer)?;
        Ok(Some(match decoded {
            Some(decoded) => decoded.attach_data(elements),
            None => elements,
        }))
    }

    /// The vertices in drawing order: the indices, or without them the order of the file.
    fn read_vertex_order(&self, vertices: usize) -> Result<Vec<u32>, Diagnostic> {
        let Some(accessor) = self.json.indices else {
            let accessor = self.attribute_accessor(Semantic::Positions).unwrap_or(0);
            self.source.charge_array(accessor, vertices, 4)?;
            return Ok((0..u32::try_from(vertices).unwrap_or(u32::MAX)).collect());
        };
        let pointer = format!("{}/indices", self.pointer);
        let elements = self.source.resolve_accessor(accessor.value(), &pointer)?;
        INDICES.check_elements(&elements, &pointer)?;
        self.source.read_indices(&elements)
    }

    /// Removes items with an index out of range: all remaining indices are valid.
    ///
    /// Whole points, lines or triangles are removed, never single indices, which would shift all
    /// others.
    fn drop_items_without_vertices(&mut self, primitive: &mut Primitive, vertices: usize) {
        if used_range(&primitive.indices).end <= vertices {
            return;
        }
        let has_vertices = |item: &[u32]| item.iter().all(|&i| (i as usize) < vertices);
        let dropped = retain_items(primitive, has_vertices);
        let message =
            format!("items use vertices that do not exist; they are left out (items: {dropped})");
        self.warnings.push_warning(&format!("{}/indices", self.pointer), message);
    }

    /// Removes items with a vertex at a position that is not finite: all remaining positions are
    /// finite.
    fn drop_nonfinite_items(&mut self, primitive: &mut Primitive) {
        // Without a way out of the loop the compiler takes many numbers at a time.
        let all = primitive.positions.as_flattened();
        if all.iter().fold(true, |finite, x| finite & x.is_finite()) {
            return;
        }
        let is_place = |p: &[f32; 3]| p.iter().all(|x| x.is_finite());
        let mut positions = std::mem::take(&mut primitive.positions);
        let has_places = |item: &[u32]| item.iter().all(|&i| is_place(&positions[i as usize]));
        let dropped = retain_items(primitive, has_places);
        positions.iter_mut().filter(|p| !is_place(p)).for_each(|p| *p = [0.0; 3]);
        primitive.positions = positions;
        let message =
            format!("items have corners at no finite place; they are left out (items: {dropped})");
        self.warnings.push_warning(&format!("{}/attributes/POSITION", self.pointer), message);
    }

    /// Reads all attributes but the positions.
    fn read_attributes(
        &mut self,
        primitive: &mut Primitive,
        span: VertexRange,
        decoded: Option<&DracoData>,
        tangents: bool,
    ) -> Result<(), Diagnostic> {
        let json = self.json;
        let named = |semantic: Semantic| {
            let pointer = format!("{}/attributes/{}", self.pointer, semantic.to_string());
            (json.attributes.get(&Checked::Valid(semantic)).map(json::Index::value), pointer)
        };
        let mut attributes = AttributeReader {
            source: self.source,
            range: span,
            draco: decoded,
            warnings: &mut *self.warnings,
        };
        let (normal, pointer) = named(Semantic::Normals);
        primitive.normals =
            attributes.read_attribute(normal, &pointer, &NORMAL, |s, e| s.read_floats(&e))?;
        if tangents {
            let (tangent, pointer) = named(Semantic::Tangents);
            primitive.tangents =
                attributes.read_attribute(tangent, &pointer, &TANGENT, |s, e| s.read_floats(&e))?;
        }
        for set in 0..UV_SETS {
            let (texcoord, pointer) = named(Semantic::TexCoords(set));
            if let Some(uvs) = attributes.read_texcoords(texcoord, &pointer)? {
                // A set that is lacking between others is zeros.
                primitive.uvs.resize(set as usize, vec![[0.0; 2]; primitive.positions.len()]);
                primitive.uvs.push(uvs);
            }
        }
        let (color, pointer) = named(Semantic::Colors(0));
        primitive.colors = attributes.read_colors(color, &pointer)?;
        read_joints(primitive, &mut attributes, named)?;
        let (mesh, part) = self.mesh_and_part;
        for (at, json) in json.targets.iter().flatten().enumerate() {
            let further = self.context.untyped.extra_morph_attributes.get(&(mesh, part, at));
            let mut reader = MorphTargetReader {
                attributes: &mut attributes,
                pointer: format!("{}/targets/{at}", self.pointer),
                tangents,
            };
            primitive
                .morph_targets
                .push(reader.read_target(json, further.map_or(&[], Vec::as_slice))?);
        }
        Ok(())
    }

    fn attribute_accessor(&self, semantic: Semantic) -> Option<usize> {
        self.json.attributes.get(&Checked::Valid(semantic)).map(json::Index::value)
    }

    /// Normalizes the normals, with warnings.
    fn repair_normals(&mut self, primitive: &mut Primitive) {
        let normals::NormalRepairs { lengths, replaced } = normals::normalize_normals(primitive);
        let pointer = format!("{}/attributes/NORMAL", self.pointer);
        if lengths > 0 {
            let message = "normals were not of unit length; they are now";
            self.warnings.push_warning(&pointer, format!("{message} (normals: {lengths})"));
        }
        if replaced > 0 {
            let message = "normals had no direction; they follow the faces";
            self.warnings.push_warning(&pointer, format!("{message} (normals: {replaced})"));
        }
    }

    /// The material; one that does not exist is replaced by the default material with a warning.
    fn checked_material(&mut self) -> Option<usize> {
        let material = self.json.material?.value();
        let count = self.source.root.materials.len();
        if material < count {
            return Some(material);
        }
        let pointer = format!("{}/material", self.pointer);
        let diagnostic = Diagnostic::unresolved_index(&pointer, "material", material, count);
        self.warnings.downgrade(&diagnostic, "the default material is used");
        None
    }
}

/// Reads the sets of joints and weights, up to the first that is missing or invalid.
///
/// `named` gives the accessor of an attribute, if the primitive has it, and its location. A set of
/// joints without weights means nothing, nor do weights without joints: both are dropped.
fn read_joints(
    primitive: &mut Primitive,
    attributes: &mut AttributeReader<'_, '_>,
    named: impl Fn(Semantic) -> (Option<usize>, String),
) -> Result<(), Diagnostic> {
    for set in 0..JOINT_SETS {
        let (joints, pointer) = named(Semantic::Joints(set));
        let joints =
            attributes.read_attribute(joints, &pointer, &JOINTS, |s, e| s.read_u16s(&e))?;
        let (weights, pointer) = named(Semantic::Weights(set));
        let weights =
            attributes.read_attribute(weights, &pointer, &WEIGHTS, |s, e| s.read_floats(&e))?;
        let (Some(joints), Some(weights)) = (joints, weights) else { break };
        primitive.joint_indices.push(joints);
        primitive.joint_weights.push(weights);
    }
    Ok(())
}

/// Renumbers indices from the lowest one on; returns the range they came from.
///
/// Primitives often share one long array of vertices, of which each uses a range.
fn rebase_indices(indices: &mut [u32]) -> Range<usize> {
    let used = used_range(indices);
    let low = used.start as u32;
    if low > 0 {
        indices.iter_mut().for_each(|index| *index -= low);
    }
    used
}

/// The range from the lowest to the highest index.
fn used_range(indices: &[u32]) -> Range<usize> {
    let (low, high) =
        indices.iter().fold((u32::MAX, 0), |(low, high), &i| (low.min(i), high.max(i)));
    if indices.is_empty() { 0..0 } else { low as usize..high as usize + 1 }
}

/// Keeps the points, lines or triangles that `keep` accepts; returns the number of the others.
fn retain_items(primitive: &mut Primitive, keep: impl Fn(&[u32]) -> bool) -> usize {
    let Primitive { topology, indices, edges, .. } = primitive;
    let before = indices.len();
    if let Some(visibility) = edges.as_mut().and_then(|edges| edges.visibility.as_mut()) {
        let mut items = indices.chunks_exact(topology.vertices_per_item());
        visibility.retain(|_| items.next().is_some_and(&keep));
    }
    let items = indices.chunks_exact(topology.vertices_per_item());
    *indices = items.filter(|item| keep(item)).flatten().copied().collect();
    (before - indices.len()) / topology.vertices_per_item()
}
