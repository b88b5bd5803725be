//! Reads the meshes and components of 3MF objects, and converts meshes to primitives.

use super::model_part::{ObjectReference, PartReader};
use super::properties::{Palette, PartProperties, Property};
use super::xml::Element;
use crate::corner_vertices::CornerAttributes;
use crate::surfaces;
use crate::surfaces::Surface;
use crate::text::{parse_f32, parse_integer};
use gltf_import::ImportWarnings;
use model::{Diagnostic, Mesh, Primitive};
use std::collections::BTreeMap;

/// Marks a vertex or property that a triangle does not specify.
const NONE: u32 = u32::MAX;

/// An object.
#[derive(Debug)]
pub(super) struct Object {
    /// The id within the part.
    pub(super) id: u32,
    /// The name, if it has one.
    pub(super) name: Option<String>,
    /// Whether the object is part of the print, rather than a support or a slicer helper.
    pub(super) is_shown: bool,
    /// The default property group, for triangles that do not specify one.
    pub(super) group: Option<u32>,
    /// The index of the default property.
    pub(super) property: Option<u32>,
    /// Location of the object, for messages.
    pub(super) location: String,
    /// The mesh or the components.
    pub(super) content: ObjectContent,
}

/// The content of an object.
#[derive(Debug, Default)]
pub(super) struct ObjectContent {
    pub(super) mesh: Option<ObjectMesh>,
    pub(super) components: Vec<ObjectReference>,
}

/// The mesh of an object.
#[derive(Debug, Default)]
pub(super) struct ObjectMesh {
    positions: Vec<[f32; 3]>,
    triangles: Vec<[u32; 3]>,
    /// The properties of each triangle; empty if no triangle specifies any.
    properties: Vec<TriangleProperties>,
}

/// The properties that a triangle specifies: a group, and an index for each corner.
#[derive(Clone, Copy, Debug)]
struct TriangleProperties {
    group: u32,
    indices: [u32; 3],
}

impl TriangleProperties {
    /// The properties of a triangle that specifies none.
    const NONE: Self = Self { group: NONE, indices: [NONE; 3] };
}

impl PartReader<'_, '_> {
    /// Reads the mesh of an object.
    pub(super) fn read_mesh(&mut self) -> Result<ObjectMesh, Diagnostic> {
        let depth = self.xml.depth();
        let mut mesh = ObjectMesh::default();
        while let Some(child) = self.xml.next_child(depth)? {
            if !self.is_read(&child) {
                continue;
            }
            match child.local_name() {
                "vertices" => self.read_vertices(&mut mesh)?,
                "triangles" => self.read_triangles(&mut mesh)?,
                _ => {}
            }
        }
        Ok(mesh)
    }

    /// Reads the vertices. In lenient mode, a vertex without finite coordinates keeps its index.
    fn read_vertices(&mut self, mesh: &mut ObjectMesh) -> Result<(), Diagnostic> {
        let depth = self.xml.depth();
        while let Some(vertex) = self.xml.next_child(depth)? {
            let mut position = [f32::NAN; 3];
            for (_, name, value) in vertex.attributes() {
                let axis = match name {
                    b"x" => 0,
                    b"y" => 1,
                    b"z" => 2,
                    _ => continue,
                };
                position[axis] = parse_f32(value.trim_ascii()).unwrap_or(f32::NAN);
            }
            if !is_finite(&position) {
                let message = "the vertex does not have three finite coordinates";
                let fault = Diagnostic::invalid(&self.xml.location_of(&vertex), message);
                self.warnings.downgrade_if_lenient(fault, "its triangles are skipped")?;
            }
            mesh.positions.push(position);
        }
        Ok(())
    }

    /// Reads the triangles. In lenient mode, triangles with missing vertices are skipped.
    fn read_triangles(&mut self, mesh: &mut ObjectMesh) -> Result<(), Diagnostic> {
        let depth = self.xml.depth();
        while let Some(element) = self.xml.next_child(depth)? {
            let (corners, properties) = self.parse_triangle(&element);
            let position = |corner: &u32| mesh.positions.get(*corner as usize);
            if let Some(corner) = corners.iter().find(|corner| position(corner).is_none()) {
                let count = mesh.positions.len();
                let location = self.xml.location_of(&element);
                let fault = match *corner {
                    NONE => Diagnostic::invalid(&location, "the triangle lacks a vertex"),
                    corner => {
                        let message = format!("there is no vertex {corner}: the mesh has {count}");
                        Diagnostic::invalid(&location, message + ", numbered from 0")
                    }
                };
                self.warnings.downgrade_if_lenient(fault, "the triangle is skipped")?;
                continue;
            }
            if !corners.iter().filter_map(position).all(is_finite) {
                continue;
            }
            // Most meshes have no properties, so the first triangle with properties creates the
            // list.
            if properties.group != NONE || properties.indices[0] != NONE {
                mesh.properties.resize(mesh.triangles.len(), TriangleProperties::NONE);
                mesh.properties.push(properties);
            }
            mesh.triangles.push(corners);
        }
        if !mesh.properties.is_empty() {
            mesh.properties.resize(mesh.triangles.len(), TriangleProperties::NONE);
        }
        Ok(())
    }

    /// Returns the vertices and properties of a triangle; unspecified properties are [`NONE`].
    fn parse_triangle(&mut self, element: &Element<'_>) -> ([u32; 3], TriangleProperties) {
        let (mut corners, mut properties) = ([NONE; 3], TriangleProperties::NONE);
        for (_, name, value) in element.attributes() {
            let slot = match name {
                b"v1" => &mut corners[0],
                b"v2" => &mut corners[1],
                b"v3" => &mut corners[2],
                b"pid" => &mut properties.group,
                b"p1" => &mut properties.indices[0],
                b"p2" => &mut properties.indices[1],
                b"p3" => &mut properties.indices[2],
                b"paint_color" | b"mmu_segmentation" => {
                    let message = "colors painted in a slicer (paint_color) are not shown";
                    self.say_once(element, "paint_color", message);
                    continue;
                }
                _ => continue,
            };
            let number = parse_integer(value.trim_ascii());
            *slot = number.and_then(|number| number.try_into().ok()).unwrap_or(NONE);
        }
        (corners, properties)
    }
}

/// Returns whether all coordinates are finite.
fn is_finite(position: &[f32; 3]) -> bool {
    position.iter().all(|coordinate| coordinate.is_finite())
}

impl ObjectMesh {
    /// Returns the maximum number of bytes in the primitives of the mesh.
    pub(super) fn array_bytes(&self) -> u64 {
        let (vertices, triangles) = (self.positions.len() as u64, self.triangles.len() as u64);
        let corner = if self.properties.is_empty() { 0 } else { 3 * 80 };
        vertices * 24 + triangles * (24 + corner)
    }

    /// Converts the mesh to primitives, one per material.
    pub(super) fn into_mesh(
        self,
        object: &Object,
        part: &PartProperties,
        palette: &mut Palette,
        crease_angle: f64,
        warnings: &mut ImportWarnings,
    ) -> Mesh {
        let Self { mut positions, triangles, properties } = self;
        // No triangle uses these positions, but bounds are computed from all positions.
        for position in positions.iter_mut().filter(|position| !is_finite(position)) {
            *position = [0.0; 3];
        }
        let default = TriangleProperties {
            group: object.group.unwrap_or(NONE),
            indices: [object.property.unwrap_or(NONE); 3],
        };
        let lookup = PropertyLookup { properties: &properties, default, part };
        let summary = lookup.summarize(triangles.len(), palette);
        if summary.missing > 0 {
            let message = match summary.missing {
                1 => "1 triangle names a property that does not exist and is drawn without it"
                    .to_owned(),
                n => format!(
                    "{n} triangles name properties that do not exist and are drawn without them"
                ),
            };
            warnings.push_warning(&object.location, message);
        }
        let surface = Surface {
            positions: &positions,
            normals: None,
            triangles,
            materials: summary.materials,
            material_count: summary.numbers.len(),
            has_uvs: summary.has_uvs,
            has_colors: summary.has_colors,
        };
        let attributes_at = |triangle: usize, corner: usize| {
            let property = lookup.property_at(triangle, corner).ok().flatten();
            property.map_or_else(CornerAttributes::default, |property| CornerAttributes {
                uv: property.uv,
                color: property.color,
            })
        };
        let (mut primitives, _) = surfaces::build_primitives(surface, crease_angle, &attributes_at);
        for Primitive { material, .. } in &mut primitives {
            *material = material.and_then(|at| summary.numbers.get(at)).map(|&at| at as usize);
        }
        primitives.retain(|primitive| primitive.item_count() > 0);
        Mesh { name: object.name.clone(), primitives, ..Mesh::default() }
    }
}

/// The properties of the triangles of an object.
struct PropertyLookup<'a> {
    /// The properties of each triangle; empty if no triangle specifies any.
    properties: &'a [TriangleProperties],
    /// The properties of the object, for triangles that do not specify any.
    default: TriangleProperties,
    part: &'a PartProperties,
}

/// A summary of the properties of an object's triangles.
struct PropertySummary {
    /// The materials that the triangles use, in order of first use.
    numbers: Vec<u32>,
    /// The index of each triangle's material in `numbers`; empty if there is only one material.
    materials: Vec<u32>,
    has_uvs: bool,
    has_colors: bool,
    /// The number of triangles that specify a missing property.
    missing: usize,
}

impl PropertyLookup<'_> {
    /// Returns the property of a corner, if it has one.
    ///
    /// # Errors
    /// Fails if the property is specified but does not exist.
    fn property_at(&self, triangle: usize, corner: usize) -> Result<Option<Property>, ()> {
        let named = self.properties.get(triangle).unwrap_or(&self.default);
        let [group, default_group] = [named.group, self.default.group];
        let group = if group == NONE { default_group } else { group };
        // A corner without an index uses the first corner's index; a triangle without properties
        // uses the object's.
        let indices = [named.indices[corner], named.indices[0], self.default.indices[0]];
        let index = indices.into_iter().find(|&index| index != NONE);
        let Some(index) = index.filter(|_| group != NONE) else { return Ok(None) };
        let group = self.part.group(group).ok_or(())?;
        group.entries.get(index as usize).copied().map(Some).ok_or(())
    }

    /// Summarizes all triangles.
    fn summarize(&self, triangles: usize, palette: &mut Palette) -> PropertySummary {
        let (mut numbers, mut number_of) = (Vec::new(), BTreeMap::new());
        let (mut has_uvs, mut has_colors, mut missing) = (false, false, 0);
        let mut materials = Vec::new();
        // If no triangle specifies properties, all have the same, so the first is enough.
        let distinct = if self.properties.is_empty() { triangles.min(1) } else { triangles };
        for triangle in 0..distinct {
            let mut first = None;
            let mut is_missing = false;
            for corner in 0..3 {
                let property = self.property_at(triangle, corner);
                is_missing |= property.is_err();
                let Ok(Some(property)) = property else { continue };
                has_colors |= property.color != [1.0; 4];
                has_uvs |= palette.has_texture(property.material);
                first = first.or(Some(property.material));
            }
            missing += usize::from(is_missing);
            let material = first.unwrap_or_else(|| palette.plain_material());
            let number = *number_of.entry(material).or_insert_with(|| {
                numbers.push(material);
                numbers.len() as u32 - 1
            });
            materials.push(number);
        }
        if numbers.len() < 2 {
            materials = Vec::new();
        }
        PropertySummary { numbers, materials, has_uvs, has_colors, missing }
    }
}
