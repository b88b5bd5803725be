//! Builds surfaces for mesh formats: converts triangles with corner attributes to primitives, one
//! per material, each with its own normals and vertices.
//!
//! Missing normals are computed by crease angle from all triangles of the surface, so that a border
//! between two colors does not become a crease.

use super::corner_vertices::{CornerAttributes, CornerVertices};
use super::polygons::{CreaseNormals, Smoothing, VertexWelder};
use gltf_import::normalize_normals;
use model::{Primitive, Topology};
use std::borrow::Cow;

/// A surface as stored in a file.
pub(super) struct Surface<'a> {
    /// Positions of the vertices, all finite.
    pub(super) positions: &'a [[f32; 3]],
    /// Normals of the vertices, of any length, if the file has them.
    pub(super) normals: Option<&'a [[f32; 3]]>,
    /// Vertices of the triangles, all in range.
    pub(super) triangles: Vec<[u32; 3]>,
    /// Material of each triangle, less than `material_count`; empty if there is only one material.
    pub(super) materials: Vec<u32>,
    /// The number of materials.
    pub(super) material_count: usize,
    /// Whether corners have texture coordinates.
    pub(super) has_uvs: bool,
    /// Whether corners have colors.
    pub(super) has_colors: bool,
}

/// Builds the primitives of a surface. `attributes_at` returns the attributes of a triangle corner,
/// if any.
///
/// The material of each primitive is an index into the surface's materials. The second result is
/// the number of normals that had no direction and were replaced.
pub(super) fn build_primitives(
    surface: Surface<'_>,
    crease_angle: f64,
    attributes_at: &dyn Fn(usize, usize) -> CornerAttributes,
) -> (Vec<Primitive>, usize) {
    let mut surface = surface;
    let (positions, normals) = match surface.normals {
        Some(normals) => (Cow::Borrowed(surface.positions), Cow::Borrowed(normals)),
        None => {
            let (positions, normals) =
                compute_normals(surface.positions, &mut surface.triangles, crease_angle);
            (Cow::Owned(positions), Cow::Owned(normals))
        }
    };
    let has_attributes = surface.has_uvs || surface.has_colors;
    let mut primitives = Vec::new();
    // The common case: the arrays are used unchanged, and no vertex is split.
    if !has_attributes && surface.materials.is_empty() {
        let indices = std::mem::take(&mut surface.triangles).into_flattened();
        let (positions, normals) = (positions.into_owned(), normals.into_owned());
        primitives.push(surface_primitive(indices, positions, normals));
    } else {
        let mut vertices = CornerVertices::new(positions.len());
        for (material, members) in triangles_by_material(&surface) {
            vertices.clear();
            let mut indices = Vec::with_capacity(3 * members.len());
            for &at in &members {
                for (corner, &vertex) in surface.triangles[at as usize].iter().enumerate() {
                    let attributes = match has_attributes {
                        true => attributes_at(at as usize, corner),
                        false => CornerAttributes::default(),
                    };
                    indices.push(vertices.vertex_at(vertex, attributes));
                }
            }
            let (positions, normals) = (vertices.gather(&positions), vertices.gather(&normals));
            let mut primitive = surface_primitive(indices, positions, normals);
            primitive.material = Some(material);
            let attributes = || vertices.attributes.iter();
            primitive.uvs.extend(surface.has_uvs.then(|| attributes().map(|a| a.uv).collect()));
            primitive.colors = surface.has_colors.then(|| attributes().map(|a| a.color).collect());
            primitives.push(primitive);
        }
    }
    let repaired = primitives.iter_mut().map(|primitive| normalize_normals(primitive).replaced);
    let replaced = repaired.sum();
    (primitives, replaced)
}

/// Returns a primitive with the first material.
fn surface_primitive(
    indices: Vec<u32>,
    positions: Vec<[f32; 3]>,
    normals: Vec<[f32; 3]>,
) -> Primitive {
    Primitive {
        topology: Topology::Triangles,
        indices,
        positions,
        normals: Some(normals),
        material: Some(0),
        ..Primitive::default()
    }
}

/// Computes normals by crease angle, updates the triangles, and returns the positions and normals
/// of the resulting vertices.
fn compute_normals(
    positions: &[[f32; 3]],
    triangles: &mut Vec<[u32; 3]>,
    crease_angle: f64,
) -> (Vec<[f32; 3]>, Vec<[f32; 3]>) {
    let mut welder = VertexWelder::with_capacity(positions.len());
    let vertex_of = welder.weld_all(positions);
    let mut welded = welder.into_positions();
    for corner in triangles.iter_mut().flatten() {
        *corner = vertex_of[*corner as usize];
    }
    let smoothing = Smoothing::CreaseAngle(crease_angle);
    let computed = CreaseNormals::compute(&welded, std::mem::take(triangles), smoothing);
    *triangles = computed.triangles;
    let copies: Vec<_> = computed.copies.iter().map(|&vertex| welded[vertex as usize]).collect();
    welded.extend(copies);
    (welded, computed.normals)
}

/// Returns the warning about normals that were replaced.
pub(crate) fn replaced_normals(count: usize) -> String {
    match count {
        1 => "1 normal without a direction is replaced by a computed normal".to_owned(),
        _ => format!("{count} normals without a direction are replaced by computed normals"),
    }
}

/// Returns each material that has triangles, with the list of its triangles; both ascend.
fn triangles_by_material(surface: &Surface<'_>) -> Vec<(usize, Vec<u32>)> {
    let count = surface.triangles.len() as u32;
    if surface.materials.is_empty() {
        return vec![(0, (0..count).collect())];
    }
    let mut members: Vec<Vec<u32>> = vec![Vec::new(); surface.material_count];
    for (at, &material) in surface.materials.iter().enumerate() {
        members[material as usize].push(at as u32);
    }
    members.into_iter().enumerate().filter(|(_, members)| !members.is_empty()).collect()
}
