//! Edges for line drawings: EXT_mesh_primitive_edge_visibility and CESIUM_primitive_outline.
//!
//! The first packs two bits per triangle edge, lowest bits first, and may add edges as line
//! strings. The second lists pairs of vertices. Invalid data is skipped with a warning; line
//! drawings then detect edges from the shape. The silhouette normals of the first extension are not
//! read, because the triangles have normals.
//!
//! ```text
//!  byte    0                 1                 2
//!  bits    7 6 5 4 3 2 1 0   7 6 5 4 3 2 1 0   …
//!  edge    t1e0 t0e2 t0e1 t0e0   t2e1 t2e0 t1e2 t1e1     two bits each
//! ```

use super::accessor::AccessorReader;
use super::attribute::INDICES;
use crate::warnings::ImportWarnings;
use files::counted;
use gltf::json::accessor::{ComponentType, Type};
use gltf::json::mesh::Primitive as Json;
use model::{Diagnostic, EdgeList, EdgeVisibility, PrimitiveEdges, Topology};
use serde_json::Value;

/// The extension with visibility bits for triangle edges.
const VISIBILITY_EXTENSION: &str = "EXT_mesh_primitive_edge_visibility";
/// The older extension by Cesium, with pairs of vertices.
const OUTLINE_EXTENSION: &str = "CESIUM_primitive_outline";

/// Reads the edges of one primitive.
///
/// The counts are taken before invalid triangles are dropped, because the bits refer to the
/// triangles in the file.
pub(super) struct EdgeReader<'a, 'w> {
    pub(super) source: &'a AccessorReader<'a>,
    pub(super) json: &'a Json,
    /// Location of the primitive.
    pub(super) pointer: &'a str,
    /// Number of vertices of the primitive.
    pub(super) vertices: usize,
    /// Number of triangles of the primitive.
    pub(super) triangles: usize,
    pub(super) warnings: &'w mut ImportWarnings,
}

impl EdgeReader<'_, '_> {
    /// Reads the edges of a primitive with this topology, if the file marks any.
    ///
    /// Only triangles have edges. Errors in the extensions are only warnings; exceeded limits and
    /// unreadable files are errors, as elsewhere.
    pub(super) fn read_edges(
        mut self,
        topology: Topology,
    ) -> Result<Option<Box<PrimitiveEdges>>, Diagnostic> {
        let others = self.json.extensions.as_ref().map(|extensions| &extensions.others);
        let [visibility, outline] = [VISIBILITY_EXTENSION, OUTLINE_EXTENSION]
            .map(|name| others.and_then(|others| others.get(name)));
        if topology != Topology::Triangles || visibility.is_none() && outline.is_none() {
            return Ok(None);
        }
        let mut edges = PrimitiveEdges::default();
        if let Some(json) = visibility {
            let read = self.read_visibility(json, &mut edges);
            self.warn_if_soft(read)?;
        }
        if let Some(json) = outline {
            let read = self.read_outline(json, &mut edges);
            self.warn_if_soft(read)?;
        }
        let is_empty = edges.visibility.is_none() && edges.lines.is_empty();
        Ok((!is_empty).then(|| Box::new(edges)))
    }

    /// Downgrades errors in the file's content to warnings.
    ///
    /// Edges are optional, so an error in them never discards the primitive.
    fn warn_if_soft(&mut self, read: Result<(), Diagnostic>) -> Result<(), Diagnostic> {
        match read {
            Err(diagnostic) if diagnostic.is_downgradable() => {
                self.warnings.downgrade(&diagnostic, "the edges are skipped");
                Ok(())
            }
            read => read,
        }
    }

    /// Reads EXT_mesh_primitive_edge_visibility.
    ///
    /// A line string is a sequence of vertices: n vertices give n − 1 edges. Strings are separated
    /// by the primitive restart index.
    fn read_visibility(
        &mut self,
        json: &Value,
        edges: &mut PrimitiveEdges,
    ) -> Result<(), Diagnostic> {
        let pointer = format!("{}/extensions/{VISIBILITY_EXTENSION}", self.pointer);
        edges.material = self.edge_material(json, &pointer);
        if let Some(accessor) = index_member(json, "visibility") {
            edges.visibility =
                Some(self.read_visibility_bits(accessor, &format!("{pointer}/visibility"))?);
        }
        let strings = json.get("lineStrings").and_then(Value::as_array);
        for (at, json) in strings.into_iter().flatten().enumerate() {
            let pointer = format!("{pointer}/lineStrings/{at}");
            let Some(accessor) = index_member(json, "indices") else {
                return Err(Diagnostic::invalid(&pointer, "`indices` is required"));
            };
            let (vertices, restart) =
                self.read_line_indices(accessor, &format!("{pointer}/indices"))?;
            let strings = vertices.split(|&vertex| vertex == restart);
            let ends = strings.flat_map(<[u32]>::array_windows::<2>).copied();
            let lines = EdgeList {
                vertex_pairs: ends.collect(),
                material: self.edge_material(json, &pointer),
            };
            edges.lines.push(self.retain_existing_vertices(lines, &format!("{pointer}/indices")));
        }
        Ok(())
    }

    /// Reads CESIUM_primitive_outline.
    ///
    /// An unpaired vertex at the end is ignored.
    fn read_outline(&mut self, json: &Value, edges: &mut PrimitiveEdges) -> Result<(), Diagnostic> {
        let pointer = format!("{}/extensions/{OUTLINE_EXTENSION}/indices", self.pointer);
        let Some(accessor) = index_member(json, "indices") else {
            return Err(Diagnostic::invalid(&pointer, "expected an index"));
        };
        let (vertices, _) = self.read_line_indices(accessor, &pointer)?;
        let lines = EdgeList { vertex_pairs: vertices.as_chunks().0.to_vec(), material: None };
        edges.lines.push(self.retain_existing_vertices(lines, &pointer));
        Ok(())
    }

    /// Unpacks the two bits per triangle edge.
    ///
    /// Edge e of triangle t is at bit 2 (3t + e) of the byte array, lowest bits first, so a
    /// triangle's six bits may span two bytes. The number of bytes must be exactly 6 · triangles /
    /// 8, rounded up.
    ///
    /// # Errors
    /// Fails if the accessor is not a SCALAR of unsigned bytes, or has the wrong number of bytes.
    fn read_visibility_bits(
        &self,
        accessor: usize,
        pointer: &str,
    ) -> Result<Vec<[EdgeVisibility; 3]>, Diagnostic> {
        let elements = self.source.resolve_accessor(accessor, pointer)?;
        if (elements.element_type, elements.component_type) != (Type::Scalar, ComponentType::U8) {
            return Err(Diagnostic::invalid(
                pointer,
                "the visibility values must be unsigned bytes of type SCALAR",
            ));
        }
        let (actual, expected) = (elements.count, (6 * self.triangles).div_ceil(8));
        if actual != expected {
            let bytes = counted(expected, "byte", "bytes");
            let triangles = counted(self.triangles, "triangle", "triangles");
            let message = format!("expected {bytes} for {triangles}, found {actual}");
            return Err(Diagnostic::invalid(pointer, message));
        }
        self.source.charge_array(accessor, self.triangles, 3)?;
        let bytes = self.source.read_u16s::<1>(&elements)?;
        let edge = |at: usize| {
            let byte = bytes.get(at / 4).map_or(0, |[byte]| *byte as u8);
            EdgeVisibility::from_bits(byte >> (2 * (at % 4)))
        };
        Ok((0..self.triangles).map(|at| [0, 1, 2].map(|k| edge(3 * at + k))).collect())
    }

    /// Returns the vertices of line strings, and the primitive restart index that separates the
    /// strings: the largest value of the component type.
    fn read_line_indices(
        &self,
        accessor: usize,
        pointer: &str,
    ) -> Result<(Vec<u32>, u32), Diagnostic> {
        let elements = self.source.resolve_accessor(accessor, pointer)?;
        INDICES.check_elements(&elements, pointer)?;
        let restart = match elements.component_type {
            ComponentType::U8 => u32::from(u8::MAX),
            ComponentType::U16 => u32::from(u16::MAX),
            _ => u32::MAX,
        };
        // The pairs built from the indices take up to 8 bytes per index.
        self.source.charge_array(accessor, elements.count, 8)?;
        Ok((self.source.read_indices(&elements)?, restart))
    }

    /// Removes edges that refer to a missing vertex, and adds a warning.
    fn retain_existing_vertices(&mut self, mut lines: EdgeList, pointer: &str) -> EdgeList {
        let before = lines.vertex_pairs.len();
        lines.vertex_pairs.retain(|ends| ends.iter().all(|&end| (end as usize) < self.vertices));
        let dropped = before - lines.vertex_pairs.len();
        if dropped > 0 {
            let edges = counted(dropped, "edge", "edges");
            let message = format!("skipped {edges} with missing vertices");
            self.warnings.push_warning(pointer, message);
        }
        lines
    }

    /// Returns the material of edges. An out-of-range index is replaced by `None` with a warning.
    fn edge_material(&mut self, json: &Value, pointer: &str) -> Option<usize> {
        let (material, count) = (index_member(json, "material")?, self.source.root.materials.len());
        if material < count {
            return Some(material);
        }
        let pointer = format!("{pointer}/material");
        let diagnostic = Diagnostic::unresolved_index(&pointer, "material", material, count);
        self.warnings.downgrade(&diagnostic, "the material of the primitive is used");
        None
    }
}

/// Returns a member that is an index. An index that does not fit in `usize` becomes `usize::MAX`,
/// which is always out of range.
fn index_member(json: &Value, member: &str) -> Option<usize> {
    json.get(member).and_then(Value::as_u64).map(|at| usize::try_from(at).unwrap_or(usize::MAX))
}

/// Renumbers edge vertices relative to the first used vertex, as is done for triangles. Edges with
/// unused vertices are removed.
pub(super) fn rebase_edges(edges: &mut PrimitiveEdges, used: &std::ops::Range<usize>) {
    for lines in &mut edges.lines {
        lines.vertex_pairs.retain(|ends| ends.iter().all(|&end| used.contains(&(end as usize))));
        let low = u32::try_from(used.start).unwrap_or(0);
        lines.vertex_pairs.as_flattened_mut().iter_mut().for_each(|end| *end -= low);
    }
}
