//! Builds mesh primitives: converts accessors to plain arrays and drops items that cannot be drawn.
//!
//! Positions and indices define the shape; if they are invalid, the file is rejected. All other
//! attributes affect only the appearance; if they are invalid, they are skipped with a warning.
//!
//! ```text
//!  POSITION ──► number of vertices ─┐
//!  indices ───► expand strips, fans ┴─► drop items out of range ─► renumber from the lowest vertex
//!                                             │
//!  positions of that range ─► drop items with vertices that are not finite ─► other attributes
//! ```
//!
//! Only the vertices from the lowest to the highest index are read. If all were read, files in
//! which all primitives share one vertex array would take memory proportional to the square of the
//! number of primitives.

use super::accessor::AccessorReader;
use super::attribute::{
    AttributeReader, INDICES, JOINTS, NORMAL, POSITION, TANGENT, VertexRange, WEIGHTS,
};
use super::draco::DracoData;
use super::elements::ResolvedAccessor;
use super::morph_target::MorphTargetReader;
use super::scalars::CollectedScalars;
use super::untyped_members::UntypedMembers;
use super::{draco, edge_visibility, selection, topology};
use crate::normals;
use crate::warnings::ImportWarnings;
use files::counted;
use gltf::json;
use gltf::json::mesh::Semantic;
use gltf::json::validation::Checked;
use model::{
    Diagnostic, Material, Mesh, Primitive, PrimitiveEdges, Topology, VariantMaterial, codes,
};
use std::ops::Range;

/// Maximum number of texture coordinate sets to read.
///
/// Materials rarely use more than two; the specification does not set a maximum.
pub(super) const UV_SETS: u32 = 8;
/// Maximum number of joint sets to read.
///
/// Each set has four influences, so a vertex may follow up to 64 joints.
const JOINT_SETS: u32 = 16;

/// The context of primitives: the other parts of the file that they refer to.
#[derive(Clone, Copy)]
pub(super) struct PrimitiveContext<'a> {
    /// The imported materials, which determine whether tangents are needed.
    pub(super) materials: &'a [Material],
    /// The number of material variants that the file declares (KHR_materials_variants).
    pub(super) variants: usize,
    /// Members that the `gltf` crate's types lack, such as further attributes of morph targets.
    pub(super) untyped: &'a UntypedMembers,
}

/// Reads all meshes of a file, and collects the values of a scalar attribute.
///
/// A primitive that cannot be read becomes an empty primitive, because primitive indices are part
/// of JSON pointers and of the public interface, and must not shift.
///
/// # Errors
/// Fails if a limit is exceeded, a file cannot be read, or positions or indices are invalid. In
/// lenient mode, invalid positions and indices are only warnings.
pub(super) fn import_meshes(
    source: &AccessorReader<'_>,
    context: PrimitiveContext<'_>,
    scalars: &mut CollectedScalars,
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
                scalars: &mut *scalars,
                warnings: &mut *warnings,
            };
            primitives.push(match reader.read_primitive() {
                // Missing data is a warning in every mode, because the rest of the file is intact.
                Err(diagnostic) if diagnostic.code == codes::MISSING_DATA => {
                    warnings.downgrade(&diagnostic, "the primitive is skipped");
                    Primitive::default()
                }
                Err(diagnostic) => {
                    warnings.downgrade_if_lenient(diagnostic, "the primitive is skipped")?;
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

/// Reads one primitive.
///
/// A new reader is created for each primitive; `scalars` and `warnings` are shared by the whole
/// import.
struct PrimitiveReader<'a, 'w> {
    source: &'a AccessorReader<'a>,
    json: &'a json::mesh::Primitive,
    context: PrimitiveContext<'a>,
    /// The index of the mesh, and the index of the primitive in it.
    mesh_and_part: (usize, usize),
    pointer: String,
    scalars: &'w mut CollectedScalars,
    warnings: &'w mut ImportWarnings,
}

impl<'a> PrimitiveReader<'a, '_> {
    /// Reads the primitive: decompresses it, expands strips and fans, removes invalid items, and
    /// then reads the attributes of the used vertices.
    ///
    /// The order of the steps matters. Invalid indices are removed before the range of used
    /// vertices is determined, because a single wrong index could widen that range to the whole
    /// array. Attributes are read last, for that range only.
    ///
    /// # Errors
    /// Fails if the mode, the positions or the indices are invalid, or a limit is exceeded.
    fn read_primitive(mut self) -> Result<Primitive, Diagnostic> {
        let Checked::Valid(mode) = self.json.mode else {
            let pointer = format!("{}/mode", self.pointer);
            return Err(Diagnostic::invalid(&pointer, "the mode must be from 0 to 6"));
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

    /// Returns whether any material of the primitive needs a tangent frame. Tangents are read only
    /// in this case.
    ///
    /// Tangents take 16 bytes per vertex, and have no effect without a normal map or anisotropy.
    /// All material variants count, because they can be selected after the import.
    fn needs_tangents(&self, material: Option<usize>, variants: &[VariantMaterial]) -> bool {
        let others = variants.iter().map(|variant| variant.material);
        let mut all = material.into_iter().chain(others);
        all.any(|at| self.context.materials.get(at).is_some_and(Material::needs_tangents))
    }

    /// Reads the materials of the primitive for the variants of the file (KHR_materials_variants).
    ///
    /// An invalid mapping is dropped with a warning.
    fn read_variants(&mut self) -> Vec<VariantMaterial> {
        let PrimitiveContext { variants, .. } = self.context;
        let root = self.source.root;
        selection::variant_materials(root, self.json, &self.pointer, variants, self.warnings)
    }

    /// Reads the edges for line drawings, if an extension marks any.
    ///
    /// Edges must be read before any triangle is dropped, because the extension has bits for each
    /// triangle in the file, in order.
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

    /// Decodes the data of a Draco-compressed primitive.
    ///
    /// Returns `None` if the primitive is not compressed. Also returns `None`, with a warning, if
    /// the stream is broken and the file has uncompressed data as a fallback for readers without
    /// the extension.
    fn decode_draco_data(&mut self, tangents: bool) -> Result<Option<DracoData>, Diagnostic> {
        let positions = self.attribute_accessor(Semantic::Positions);
        let has_other_data = positions.is_some_and(|accessor| !self.source.has_no_data(accessor));
        let custom = self.scalars.attribute.as_ref();
        match draco::decode_draco(self.source, self.json, tangents, custom, &self.pointer) {
            Err(diagnostic) if diagnostic.is_downgradable() && has_other_data => {
                self.warnings.downgrade(&diagnostic, "the uncompressed data is used");
                Ok(None)
            }
            decoded => decoded,
        }
    }

    /// Returns the positions, or `None` if the primitive has none.
    ///
    /// The specification allows a primitive without positions, for extensions that supply them
    /// in other ways (glTF 2.0 §3.7.2.1); no such extension is supported.
    ///
    /// # Errors
    /// Fails if the accessor is invalid, or its format is neither three floats nor quantized
    /// integers.
    fn position_elements<'e>(
        &mut self,
        decoded: Option<&'e DracoData>,
    ) -> Result<Option<ResolvedAccessor<'e>>, Diagnostic>
    where
        'a: 'e,
    {
        let Some(accessor) = self.attribute_accessor(Semantic::Positions) else {
            self.warnings
                .push_warning(&self.pointer, "the primitive has no positions; it is skipped");
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

    /// Reads the vertices in drawing order: the indices if they exist, otherwise the file order.
    ///
    /// A primitive without indices gets `0, 1, 2, …`, so that all later steps have a single case.
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

    /// Removes items with an out-of-range index. All remaining indices are valid.
    ///
    /// Whole points, lines or triangles are removed, never single indices, because removing one
    /// would shift all the others. The highest index is tested first, in one pass that the compiler
    /// vectorizes; almost all files need only this test.
    fn drop_items_without_vertices(&mut self, primitive: &mut Primitive, vertices: usize) {
        if used_range(&primitive.indices).end <= vertices {
            return;
        }
        let has_vertices = |item: &[u32]| item.iter().all(|&i| (i as usize) < vertices);
        let dropped = retain_items(primitive, has_vertices);
        let message = format!("skipped {} with missing vertices", item_count(primitive, dropped));
        self.warnings.push_warning(&format!("{}/indices", self.pointer), message);
    }

    /// Removes items with a non-finite vertex position. All remaining positions are finite.
    ///
    /// The non-finite positions are set to 0, so that bounding boxes of all positions are also
    /// finite.
    fn drop_nonfinite_items(&mut self, primitive: &mut Primitive) {
        // The compiler vectorizes a fold without an early exit.
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
        let items = item_count(primitive, dropped);
        let message = format!("skipped {items} with a position that is not finite");
        self.warnings.push_warning(&format!("{}/attributes/POSITION", self.pointer), message);
    }

    /// Reads all attributes except positions.
    ///
    /// Texture coordinates are read up to the last set that the primitive has. Missing sets before
    /// it are filled with zeros, because materials refer to sets by number.
    ///
    /// # Errors
    /// Fails if a limit is exceeded or a file cannot be read. An invalid attribute is dropped with
    /// a warning.
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
                // A missing set between others is filled with zeros.
                primitive.uvs.resize(set as usize, vec![[0.0; 2]; primitive.positions.len()]);
                primitive.uvs.push(uvs);
            }
        }
        let (color, pointer) = named(Semantic::Colors(0));
        primitive.colors = attributes.read_colors(color, &pointer)?;
        let (mesh, part) = self.mesh_and_part;
        self.scalars.read_values(mesh, part, &mut attributes, named)?;
        read_joints(primitive, &mut attributes, named)?;
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

    /// Returns the accessor of an attribute if the primitive has it. The index may be out of range.
    fn attribute_accessor(&self, semantic: Semantic) -> Option<usize> {
        self.json.attributes.get(&Checked::Valid(semantic)).map(json::Index::value)
    }

    /// Normalizes the normals and warns about corrections.
    ///
    /// Quantized normals rarely have unit length, so corrections are counted and reported once per
    /// primitive.
    fn repair_normals(&mut self, primitive: &mut Primitive) {
        let normals::NormalRepairs { lengths, replaced } = normals::normalize_normals(primitive);
        let pointer = format!("{}/attributes/NORMAL", self.pointer);
        if lengths > 0 {
            let normals = counted(lengths, "normal", "normals");
            let message = format!("normalized {normals} that did not have unit length");
            self.warnings.push_warning(&pointer, message);
        }
        if replaced > 0 {
            let message = match replaced {
                1 => "1 normal without a direction is replaced by a face normal".to_owned(),
                _ => format!("{replaced} normals without a direction are replaced by face normals"),
            };
            self.warnings.push_warning(&pointer, message);
        }
    }

    /// Returns the material. A missing material is replaced by the default material, with a
    /// warning.
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

/// Formats a number of points, lines or triangles with its noun.
fn item_count(primitive: &Primitive, count: usize) -> String {
    let [singular, plural] = match primitive.topology {
        Topology::Points => ["point", "points"],
        Topology::Lines => ["line", "lines"],
        Topology::Triangles => ["triangle", "triangles"],
    };
    counted(count, singular, plural)
}

/// Reads the sets of joints and weights up to the first missing or invalid set.
///
/// `named` returns the accessor of an attribute, if it exists, and the attribute's location. Joints
/// without weights are meaningless, as are weights without joints, so both are dropped. Each set
/// has four influences: `JOINTS_0` with `WEIGHTS_0`, `JOINTS_1` with `WEIGHTS_1`, and so on (glTF
/// 2.0 §3.7.3.3).
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

/// Renumbers indices relative to the lowest, and returns the original range.
///
/// Exporters often store the vertices of all primitives in one array, of which each primitive uses
/// a range.
fn rebase_indices(indices: &mut [u32]) -> Range<usize> {
    let used = used_range(indices);
    let low = used.start as u32;
    if low > 0 {
        indices.iter_mut().for_each(|index| *index -= low);
    }
    used
}

/// Returns the range from the lowest to the highest index.
///
/// The range is empty if there are no indices. The time is linear in the number of indices.
fn used_range(indices: &[u32]) -> Range<usize> {
    let (low, high) =
        indices.iter().fold((u32::MAX, 0), |(low, high), &i| (low.min(i), high.max(i)));
    if indices.is_empty() { 0..0 } else { low as usize..high as usize + 1 }
}

/// Retains the points, lines or triangles that `keep` accepts, and returns the number of removed
/// items.
///
/// Edge visibility bits are stored per triangle and are filtered along with the triangles.
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
