//! Builds the primitives of an OBJ file: computes missing normals, and shares vertices between
//! identical corners.

use super::elements::{Corner, NONE};
use super::parser::ObjFile;
use super::parts::{Part, split_elements};
use super::vertex_sharing::VertexSharing;
use crate::polygons::{CreaseNormals, Smoothing, VertexWelder};
use crate::surfaces;
use gltf_import::ImportWarnings;
use gltf_import::linear_from_srgb;
use gltf_import::normalize_normals;
use model::{Diagnostic, Primitive, Topology};

/// A primitive, with the group it belongs to.
pub(super) struct GroupPrimitive {
    /// Index of the group in the file.
    pub(super) group: u32,
    /// The primitive; its material is an index into the file's material names.
    pub(super) primitive: Primitive,
}

/// Builds the primitives of a file, in the order of their first elements.
///
/// # Errors
/// Fails if an element has a vertex without three finite coordinates. In lenient mode, the element
/// is skipped.
pub(super) fn build_primitives(
    mut file: ObjFile<'_>,
    text: &[u8],
    crease_angle: f64,
    warnings: &mut ImportWarnings,
) -> Result<Vec<GroupPrimitive>, Diagnostic> {
    let parts = split_elements(&file, text, warnings)?;
    let computed = compute_normals(&mut file, &parts, crease_angle);
    let colors = linear_colors(&file, warnings);
    let mut sharing = VertexSharing::new(file.positions.len());
    let (mut primitives, mut replaced) = (Vec::with_capacity(parts.len()), 0);
    // Computed normals are consumed in the order of the parts.
    let mut computed = computed.as_slice();
    for part in parts {
        let mut normals = [].as_slice();
        if is_computed(&part) {
            (normals, computed) = computed.split_at(part.corners.len());
        }
        let mut primitive = build_primitive(&file, &colors, &part, normals, &mut sharing);
        if part.key.has_normals {
            replaced += normalize_normals(&mut primitive).replaced;
        }
        primitives.push(GroupPrimitive { group: part.key.group, primitive });
    }
    if replaced > 0 {
        warnings.push_warning("", surfaces::replaced_normals(replaced));
    }
    Ok(primitives)
}

/// Returns whether the normals of a part are computed.
fn is_computed(part: &Part) -> bool {
    part.topology() == Topology::Triangles && !part.key.has_normals
}

/// Computes all missing normals across the whole file, so that a border between two groups or
/// materials does not become a crease.
///
/// The new normals are appended to the file's normals. The result has a normal index for each
/// corner of the parts with missing normals, one part after another.
fn compute_normals(file: &mut ObjFile<'_>, parts: &[Part], crease_angle: f64) -> Vec<u32> {
    let parts = || parts.iter().filter(|part| is_computed(part));
    let count: usize = parts().map(|part| part.corners.len()).sum();
    if count == 0 {
        return Vec::new();
    }
    // Non-finite positions may also have equal bits, but no triangle uses them.
    let mut welder = VertexWelder::with_capacity(file.positions.len());
    let welded = welder.weld_all(&file.positions);
    let mut triangles: Vec<[u32; 3]> = Vec::with_capacity(count / 3);
    let vertex_of = |corner: u32| welded[file.elements.corners[corner as usize].position as usize];
    for part in parts() {
        triangles.extend(part.corners.as_chunks::<3>().0.iter().map(|at| at.map(vertex_of)));
    }
    let groups: Vec<u32> = parts().flat_map(|part| part.smoothing.iter().copied()).collect();
    let smoothing = match file.has_smoothing {
        true => Smoothing::Groups(&groups),
        false => Smoothing::CreaseAngle(crease_angle),
    };
    let computed = CreaseNormals::compute(&welder.into_positions(), triangles, smoothing);
    let first = file.normals.len() as u32;
    file.normals.extend(computed.normals);
    computed.triangles.into_flattened().into_iter().map(|vertex| first + vertex).collect()
}

/// Returns the vertex colors in linear light: one per position, or none if the file has none.
///
/// In the file, they are sRGB encoded and range from 0 to 1, or to 255 if any value exceeds 1.
fn linear_colors(file: &ObjFile<'_>, warnings: &mut ImportWarnings) -> Vec<[f32; 4]> {
    if file.colors.is_empty() {
        return Vec::new();
    }
    // Vertices without a color are white.
    let is_of_bytes = file.colors.as_flattened().iter().any(|&channel| channel > 1.0);
    if is_of_bytes {
        warnings.push_warning("", "vertex colors exceed 1; they are read as numbers from 0 to 255");
    }
    let scale = if is_of_bytes { 1.0 / 255.0 } else { 1.0 };
    let linear = |color: &[f32; 4]| {
        let known = |x: f32| if x.is_nan() { 1.0 } else { (x * scale).clamp(0.0, 1.0) };
        let [r, g, b, a] = color.map(known);
        [linear_from_srgb(r), linear_from_srgb(g), linear_from_srgb(b), a]
    };
    let mut colors: Vec<[f32; 4]> = file.colors.iter().map(linear).collect();
    colors.resize(file.positions.len(), [1.0; 4]);
    colors
}

/// Builds the primitive of a part. If normals are computed, `normals` has the normal index of each
/// corner.
fn build_primitive(
    file: &ObjFile<'_>,
    colors: &[[f32; 4]],
    part: &Part,
    normals: &[u32],
    sharing: &mut VertexSharing,
) -> Primitive {
    sharing.clear();
    let has_uvs = part.key.has_uvs && part.topology() == Topology::Triangles;
    let indices = part.corners.iter().enumerate().map(|(at, &corner)| {
        let Corner { position, uv, normal } = file.elements.corners[corner as usize];
        let normal = normals.get(at).copied().unwrap_or(normal);
        let has_normal = part.key.has_normals || !normals.is_empty();
        sharing.vertex_at(Corner {
            position,
            uv: if has_uvs { uv } else { NONE },
            normal: if has_normal { normal } else { NONE },
        })
    });
    let indices = indices.collect();
    let vertices = sharing.corners.iter();
    let is_surface = part.topology() == Topology::Triangles;
    let uv_at = |corner: &Corner| {
        let [u, v] = file.uvs[corner.uv as usize];
        // In OBJ files, v = 0 is at the bottom; in glTF, it is at the top.
        [u, 1.0 - v]
    };
    Primitive {
        topology: part.topology(),
        indices,
        positions: vertices.clone().map(|at| file.positions[at.position as usize]).collect(),
        normals: is_surface
            .then(|| vertices.clone().map(|at| file.normals[at.normal as usize]).collect()),
        uvs: has_uvs.then(|| vertices.clone().map(uv_at).collect()).into_iter().collect(),
        colors: (!colors.is_empty())
            .then(|| vertices.map(|at| colors[at.position as usize]).collect()),
        material: part.key.material.map(|material| material as usize),
        ..Primitive::default()
    }
}
