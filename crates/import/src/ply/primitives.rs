//! The primitives of a PLY file: triangles by texture, lines, and points.

use super::Contents;
use super::faces::Faces;
use super::vertices::Vertices;
use crate::corner_vertices::CornerAttributes;
use crate::polygons::{PolygonKind, Triangulator};
use crate::surfaces;
use crate::surfaces::Surface;
use files::counted;
use gltf_import::ImportOptions;
use gltf_import::ImportWarnings;
use model::{Model, Primitive, Topology};

/// Returns the maximum number of bytes in the arrays of the primitives.
pub(crate) fn array_bytes(contents: &Contents) -> u64 {
    let Contents { vertices, faces, strips, edges } = contents;
    let vertex =
        24 + 8 * u64::from(vertices.uvs.is_some()) + 16 * u64::from(vertices.colors.is_some());
    let corner = 12 + if faces.uvs.is_some() || faces.colors.is_some() { 80 } else { 24 };
    let corners = faces.corners.len() as u64 + strips.corners.len() as u64;
    vertices.positions.len() as u64 * vertex + corners * corner + edges.len() as u64 * 4
}

/// The triangles of all faces.
#[derive(Default)]
struct Triangles {
    /// The corners of each triangle, as indices into the corners of all faces.
    corners: Vec<[u32; 3]>,
    /// The face of each triangle.
    faces: Vec<u32>,
}

/// Builds the primitives. Items with non-finite positions are skipped.
pub(crate) fn build_primitives(
    contents: Contents,
    model: &Model,
    options: &ImportOptions,
    warnings: &mut ImportWarnings,
) -> Vec<Primitive> {
    let Contents { mut vertices, mut faces, strips, mut edges } = contents;
    faces.append_strips(strips);
    // Without faces and edges, the vertices are a point cloud.
    let is_cloud = faces.corners.is_empty() && edges.is_empty();
    let is_finite: Vec<bool> =
        vertices.positions.iter().map(|p| p.iter().all(|x| x.is_finite())).collect();
    let is_usable = |&vertex: &u32| is_finite.get(vertex as usize) == Some(&true);
    let triangles = triangulate_faces(&faces, &vertices.positions, is_usable, warnings);
    let ends = edges.len();
    edges = edges
        .as_chunks::<2>()
        .0
        .iter()
        .filter(|e| e.iter().all(is_usable))
        .copied()
        .collect::<Vec<_>>()
        .into_flattened();
    let all = if is_cloud { vertices.positions.len() as u32 } else { 0 };
    let points: Vec<u32> = (0..all).filter(is_usable).collect();
    let lost = (ends - edges.len()) / 2 + (all as usize - points.len());
    if lost > 0 {
        let message = match lost {
            1 => "skipped 1 point or edge with vertices that are not finite".to_owned(),
            _ => format!("skipped {lost} points and edges with vertices that are not finite"),
        };
        warnings.push_warning("element vertex", message);
    }
    // No item uses these positions, but bounds are computed from all positions.
    for (position, _) in vertices.positions.iter_mut().zip(&is_finite).filter(|(_, is)| !**is) {
        *position = [0.0; 3];
    }
    let mut primitives = build_surface(&faces, &triangles, &mut vertices, model, options, warnings);
    for (topology, indices) in [(Topology::Lines, edges), (Topology::Points, points)] {
        if !indices.is_empty() {
            primitives.push(Primitive {
                topology,
                indices,
                positions: vertices.positions.clone(),
                colors: vertices.colors.clone(),
                material: Some(0),
                ..Primitive::default()
            });
        }
    }
    primitives
}

impl Faces {
    /// Adds the triangles of strips, which have no face attributes.
    fn append_strips(&mut self, strips: Self) {
        let Self { lengths, corners, .. } = strips;
        if let Some(uvs) = &mut self.uvs {
            uvs.resize(uvs.len() + corners.len(), [0.0; 2]);
        }
        if let Some(colors) = &mut self.colors {
            colors.resize(colors.len() + lengths.len(), [1.0; 4]);
        }
        if let Some(textures) = &mut self.textures {
            textures.resize(textures.len() + lengths.len(), 0);
        }
        self.lengths.extend(lengths);
        self.corners.extend(corners);
    }
}

/// Triangulates the faces. Faces with an unusable vertex are skipped.
fn triangulate_faces(
    faces: &Faces,
    positions: &[[f32; 3]],
    is_usable: impl Fn(&u32) -> bool,
    warnings: &mut ImportWarnings,
) -> Triangles {
    let mut triangles = Triangles::default();
    let (mut triangulator, mut cut, mut polygon) =
        (Triangulator::default(), Vec::new(), Vec::new());
    let (mut left_out, mut fans, mut begin) = (0, 0, 0);
    for (face, &length) in faces.lengths.iter().enumerate() {
        let corners = &faces.corners[begin as usize..(begin + length) as usize];
        if corners.iter().all(&is_usable) {
            cut.clear();
            polygon.clear();
            polygon.extend(corners.iter().map(|&vertex| positions[vertex as usize]));
            let kind = triangulator.triangulate(&polygon, &mut cut);
            fans += usize::from(kind == PolygonKind::Fan);
            triangles.corners.extend(cut.iter().map(|t| t.map(|corner| begin + corner)));
            triangles.faces.resize(triangles.corners.len(), face as u32);
        } else {
            left_out += 1;
        }
        begin += length;
    }
    if left_out > 0 {
        let faces = counted(left_out, "face", "faces");
        let message = format!("skipped {faces} with vertices that are not finite");
        warnings.push_warning("element face", message);
    }
    if fans > 0 {
        let polygons = counted(
            fans,
            "polygon intersects itself or is too complex",
            "polygons intersect themselves or are too complex",
        );
        let message = format!("{polygons}, so triangles may overlap");
        warnings.push_warning("element face", message);
    }
    triangles
}

/// Builds a primitive from the triangles of each texture.
///
/// Corner texture coordinates override vertex texture coordinates, and vertex colors override face
/// colors. A textured surface has no other colors.
fn build_surface(
    faces: &Faces,
    triangles: &Triangles,
    vertices: &mut Vertices,
    model: &Model,
    options: &ImportOptions,
    warnings: &mut ImportWarnings,
) -> Vec<Primitive> {
    if triangles.corners.is_empty() {
        return Vec::new();
    }
    let has_texture = model.materials.iter().any(|m| m.base_color_texture.is_some());
    let vertex_at = |corner: u32| faces.corners[corner as usize];
    let last = model.materials.len().saturating_sub(1) as u32;
    let materials = match &faces.textures {
        Some(textures) if last > 0 => {
            triangles.faces.iter().map(|&face| textures[face as usize].min(last)).collect()
        }
        _ => Vec::new(),
    };
    let colors = (faces.colors.as_deref(), vertices.colors.as_deref());
    let uvs = (faces.uvs.as_deref(), vertices.uvs.as_deref());
    let surface = Surface {
        positions: &vertices.positions,
        normals: vertices.normals.as_deref(),
        triangles: triangles.corners.iter().map(|t| t.map(vertex_at)).collect(),
        materials,
        material_count: model.materials.len(),
        has_uvs: has_texture && (uvs.0.is_some() || uvs.1.is_some()),
        has_colors: !has_texture && (colors.0.is_some() || colors.1.is_some()),
    };
    let attributes_at = |triangle: usize, corner: usize| {
        let corner = triangles.corners[triangle][corner] as usize;
        let (vertex, face) = (faces.corners[corner] as usize, triangles.faces[triangle] as usize);
        let white = CornerAttributes::default();
        CornerAttributes {
            uv: match uvs {
                (Some(uvs), _) => uvs[corner],
                (None, Some(uvs)) => uvs[vertex],
                _ => white.uv,
            },
            color: match colors {
                (_, Some(colors)) => colors[vertex],
                (Some(colors), None) => colors[face],
                _ => white.color,
            },
        }
    };
    let crease_angle = options.crease_degrees();
    let (primitives, replaced) = surfaces::build_primitives(surface, crease_angle, &attributes_at);
    if replaced > 0 && vertices.normals.is_some() {
        warnings.push_warning("element vertex", surfaces::replaced_normals(replaced));
    }
    primitives
}
