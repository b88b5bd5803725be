//! Edges that the file wants to be seen: EXT_mesh_primitive_edge_visibility and CESIUM_primitive_outline.
//!
//! The first packs two bits for each edge of each triangle, lowest bits first, and may name more edges as line strings; the
//! second lists pairs of vertices. What cannot be read is left out with a warning: drawings then find edges from the
//! shape. The normals at silhouettes that the first can bring along are not read: the triangles have them.

use super::accessor::Source;
use super::attribute::INDICES;
use super::error::Fault;
use super::warnings::Warnings;
use crate::{EdgeLines, EdgeVisibility, Edges, Topology};
use gltf::json::accessor::{ComponentType, Type};
use gltf::json::mesh::Primitive as Json;
use serde_json::Value;

const VISIBILITY: &str = "EXT_mesh_primitive_edge_visibility";
const OUTLINE: &str = "CESIUM_primitive_outline";

/// What the reader of edges knows of their primitive.
pub(super) struct Reader<'a, 'w> {
    pub(super) source: &'a Source<'a>,
    pub(super) json: &'a Json,
    /// Where the primitive is.
    pub(super) pointer: &'a str,
    /// How many vertices it has.
    pub(super) vertices: usize,
    /// How many triangles it has.
    pub(super) triangles: usize,
    pub(super) warnings: &'w mut Warnings,
}

impl Reader<'_, '_> {
    /// The edges of a primitive that draws `topology`, if the file names any.
    pub(super) fn edges(mut self, topology: Topology) -> Result<Option<Box<Edges>>, Fault> {
        let others = self.json.extensions.as_ref().map(|extensions| &extensions.others);
        let [visibility, outline] =
            [VISIBILITY, OUTLINE].map(|name| others.and_then(|others| others.get(name)));
        if topology != Topology::Triangles || visibility.is_none() && outline.is_none() {
            return Ok(None);
        }
        let mut edges = Edges::default();
        if let Some(json) = visibility {
            let read = self.visibility(json, &mut edges);
            self.keep_going(read)?;
        }
        if let Some(json) = outline {
            let read = self.outline(json, &mut edges);
            self.keep_going(read)?;
        }
        let is_empty = edges.visibility.is_none() && edges.lines.is_empty();
        Ok((!is_empty).then(|| Box::new(edges)))
    }

    fn keep_going(&mut self, read: Result<(), Fault>) -> Result<(), Fault> {
        match read {
            Err(fault) if fault.is_soft() => {
                self.warnings.soft(&fault, "its edges are left out");
                Ok(())
            }
            read => read,
        }
    }

    fn visibility(&mut self, json: &Value, edges: &mut Edges) -> Result<(), Fault> {
        let pointer = format!("{}/extensions/{VISIBILITY}", self.pointer);
        edges.material = self.material(json, &pointer);
        if let Some(accessor) = index(json, "visibility") {
            edges.visibility = Some(self.bits(accessor, &format!("{pointer}/visibility"))?);
        }
        let strings = json.get("lineStrings").and_then(Value::as_array);
        for (at, json) in strings.into_iter().flatten().enumerate() {
            let pointer = format!("{pointer}/lineStrings/{at}");
            let Some(accessor) = index(json, "indices") else {
                return Err(Fault::invalid(&pointer, "the member `indices` is due"));
            };
            let (vertices, restart) = self.indices(accessor, &format!("{pointer}/indices"))?;
            let strings = vertices.split(|&vertex| vertex == restart);
            let ends = strings.flat_map(<[u32]>::array_windows::<2>).copied();
            let lines = EdgeLines { ends: ends.collect(), material: self.material(json, &pointer) };
            edges.lines.push(self.existing(lines, &format!("{pointer}/indices")));
        }
        Ok(())
    }

    fn outline(&mut self, json: &Value, edges: &mut Edges) -> Result<(), Fault> {
        let pointer = format!("{}/extensions/{OUTLINE}/indices", self.pointer);
        let Some(accessor) = index(json, "indices") else {
            return Err(Fault::invalid(&pointer, "an index is due"));
        };
        let (vertices, _) = self.indices(accessor, &pointer)?;
        let lines = EdgeLines { ends: vertices.as_chunks().0.to_vec(), material: None };
        edges.lines.push(self.existing(lines, &pointer));
        Ok(())
    }

    /// Two bits for each edge.
    fn bits(&self, accessor: usize, pointer: &str) -> Result<Vec<[EdgeVisibility; 3]>, Fault> {
        let elements = self.source.elements(accessor, pointer)?;
        if (elements.shape, elements.component) != (Type::Scalar, ComponentType::U8) {
            return Err(Fault::invalid(pointer, "the visibility must be SCALAR of unsigned bytes"));
        }
        let (found, due) = (elements.count, (6 * self.triangles).div_ceil(8));
        if found != due {
            let problem = format!("{found} bytes for {} triangles, not {due}", self.triangles);
            return Err(Fault::invalid(pointer, problem));
        }
        self.source.charge(accessor, self.triangles, 3)?;
        let bytes = self.source.shorts::<1>(&elements)?;
        let edge = |at: usize| {
            let byte = bytes.get(at / 4).map_or(0, |[byte]| *byte as u8);
            EdgeVisibility::from_bits(byte >> (2 * (at % 4)))
        };
        Ok((0..self.triangles).map(|at| [0, 1, 2].map(|k| edge(3 * at + k))).collect())
    }

    /// Vertices, and the number that parts strings of them: the largest of the component type.
    fn indices(&self, accessor: usize, pointer: &str) -> Result<(Vec<u32>, u32), Fault> {
        let elements = self.source.elements(accessor, pointer)?;
        INDICES.check(&elements, pointer)?;
        let restart = match elements.component {
            ComponentType::U8 => u32::from(u8::MAX),
            ComponentType::U16 => u32::from(u16::MAX),
            _ => u32::MAX,
        };
        // The pairs take twice as much room again.
        self.source.charge(accessor, elements.count, 8)?;
        Ok((self.source.indices(&elements)?, restart))
    }

    /// The lines whose ends are vertices.
    fn existing(&mut self, mut lines: EdgeLines, pointer: &str) -> EdgeLines {
        let before = lines.ends.len();
        lines.ends.retain(|ends| ends.iter().all(|&end| (end as usize) < self.vertices));
        let lost = before - lines.ends.len();
        if lost > 0 {
            let message =
                format!("edges use vertices that do not exist; they are left out (edges: {lost})");
            self.warnings.add(pointer, message);
        }
        lines
    }

    fn material(&mut self, json: &Value, pointer: &str) -> Option<usize> {
        let (material, count) = (index(json, "material")?, self.source.root.materials.len());
        if material < count {
            return Some(material);
        }
        let pointer = format!("{pointer}/material");
        let fault = Fault::unresolved(&pointer, "material", material, count);
        self.warnings.soft(&fault, "the material of the primitive is used");
        None
    }
}

fn index(json: &Value, member: &str) -> Option<usize> {
    json.get(member).and_then(Value::as_u64).map(|at| usize::try_from(at).unwrap_or(usize::MAX))
}

/// Counts the vertices of edges from the first used one on, as those of the triangles are; edges at unused vertices go.
pub(super) fn shift(edges: &mut Edges, used: &std::ops::Range<usize>) {
    for lines in &mut edges.lines {
        lines.ends.retain(|ends| ends.iter().all(|&end| used.contains(&(end as usize))));
        let low = u32::try_from(used.start).unwrap_or(0);
        lines.ends.as_flattened_mut().iter_mut().for_each(|end| *end -= low);
    }
}
