//! Imports meshes from memory: converts arrays of vertices and polygons to a [`Model`].
//!
//! The arrays are treated like a PLY file: polygons are triangulated, missing normals are computed
//! with the crease angle, and vertices are split between faces of different colors.

use super::ply::{self, Contents};
use crate::load::{check_scene_limits, surface_without_area};
use gltf_import::ImportOptions;
use gltf_import::ImportWarnings;
use gltf_import::MemoryBudget;
use homog::{Affine, Model as ModelSpace};
use model::{
    AlphaMode, Diagnostic, Image, ImageInfo, Material, Mesh, Model, Node, Sampler, Texture,
    TextureInfo, codes,
};

/// A mesh as arrays: vertices, polygons and their appearance.
///
/// ```
/// use import::{MeshArrays, MeshNode, load_arrays};
/// let square = MeshArrays {
///     positions: vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]],
///     lengths: vec![4],
///     corners: vec![0, 1, 2, 3],
///     ..MeshArrays::default()
/// };
/// let model = load_arrays("square", vec![square], &[MeshNode::default()], &Default::default())?;
/// assert_eq!(model.meshes[0].primitives[0].item_count(), 2);
/// # Ok::<(), model::Diagnostic>(())
/// ```
#[derive(Clone, PartialEq, Debug, Default)]
pub struct MeshArrays {
    /// The name, if it has one.
    pub name: Option<String>,
    /// Positions of the vertices, which must all be finite.
    pub positions: Vec<[f32; 3]>,
    /// The number of corners of each polygon, at least 3.
    pub lengths: Vec<u32>,
    /// Vertex indices of the corners of all polygons, counterclockwise as seen from outside.
    pub corners: Vec<u32>,
    /// Vertex indices of the endpoints of lines, two per line. Without polygons and lines, the
    /// vertices form a point cloud.
    pub line_ends: Vec<u32>,
    /// Normals of the vertices, which may have any length. Without them, normals are computed with
    /// the crease angle.
    pub normals: Option<Vec<[f32; 3]>>,
    /// Texture coordinates of the vertices, with (0, 0) at the upper left.
    pub uvs: Option<Vec<[f32; 2]>>,
    /// Linear colors of the vertices.
    pub vertex_colors: Option<Vec<[f32; 4]>>,
    /// Linear colors of the polygons, used if the vertices have no colors.
    pub face_colors: Option<Vec<[f32; 4]>>,
    /// The texture image, which multiplies the base color; vertex and face colors are then ignored.
    pub image: Option<Image>,
    /// The material, or `None` for the default of formats without materials.
    pub material: Option<Material>,
}

/// A placement of a mesh in the model.
#[derive(Clone, PartialEq, Debug)]
pub struct MeshNode {
    /// The name, if it has one.
    pub name: Option<String>,
    /// The index of the mesh.
    pub mesh: usize,
    /// The transform from mesh to model coordinates.
    pub to_model: Affine<ModelSpace, ModelSpace>,
}

impl Default for MeshNode {
    /// Returns a node for the first mesh, without a transform.
    fn default() -> Self {
        Self { name: None, mesh: 0, to_model: Affine::IDENTITY }
    }
}

/// Creates a model from meshes in memory, placed by `nodes`.
///
/// Only the limits, up axis, unit and crease angle in the options are used.
///
/// # Errors
/// Fails if a limit is exceeded, the lengths of arrays are inconsistent, an index is out of range,
/// or a position is not finite. Locations begin with the mesh or node: `/meshes/0/corners/7`.
pub fn load_arrays(
    name: &str,
    meshes: Vec<MeshArrays>,
    nodes: &[MeshNode],
    options: &ImportOptions,
) -> Result<Model, Diagnostic> {
    let mut model = Model { name: name.to_owned(), ..Model::default() };
    let mut warnings = ImportWarnings::new(options.lenient);
    let (budget, mut images) = (MemoryBudget::new(&options.limits), Vec::new());
    for (index, mut mesh) in meshes.into_iter().enumerate() {
        let location = format!("/meshes/{index}");
        // Checked before anything is built, so that later code can index without checks.
        mesh.check_arrays(&location)?;
        // An image cannot be shown without texture coordinates.
        let image = mesh.image.take().filter(|_| mesh.uvs.is_some());
        let texture = image.is_some().then_some(images.len());
        if image.is_some() {
            images.push(image);
            model.textures.push(Texture { image: texture, sampler: Sampler::default() });
            model.image_infos.push(ImageInfo::default());
        }
        let materials = vec![mesh.to_material(texture)];
        let (name, contents) = mesh.into_contents();
        let bytes = ply::array_bytes(&contents);
        budget.charge_bytes(&location, bytes, bytes)?;
        // Only the materials of this temporary model are read.
        let carrier = Model { materials, ..Model::default() };
        let built = ply::build_primitives(contents, &carrier, options, &mut warnings);
        let mut primitives: Vec<_> = built.into_iter().filter(|p| p.item_count() > 0).collect();
        primitives.iter_mut().for_each(|primitive| primitive.material = Some(index));
        model.materials.extend(carrier.materials);
        model.meshes.push(Mesh { name, primitives, ..Mesh::default() });
    }
    model.images = images.into();
    add_nodes(&mut model, nodes)?;
    model.warnings = warnings.into_list();
    model.length_unit = options.length_unit.unwrap_or_default();
    model.rotate_roots(options.up.unwrap_or_default());
    check_scene_limits(&model, &options.limits)?;
    model.warnings.extend(surface_without_area(&model));
    Ok(model)
}

/// Adds the nodes, all as roots.
fn add_nodes(model: &mut Model, nodes: &[MeshNode]) -> Result<(), Diagnostic> {
    for (index, MeshNode { name, mesh, to_model }) in nodes.iter().enumerate() {
        let location = format!("/nodes/{index}");
        if *mesh >= model.meshes.len() {
            let count = model.meshes.len();
            return Err(Diagnostic::unresolved_index(&location, "mesh", *mesh, count));
        }
        if !to_model.is_finite() {
            return Err(wrong_arrays(&location, "its transform is not finite".to_owned()));
        }
        model.roots.push(model.nodes.len());
        model.nodes.push(Node {
            name: name.clone(),
            to_parent: *to_model,
            trs: None,
            to_model: *to_model,
            mesh: Some(*mesh),
            ..Node::default()
        });
    }
    Ok(())
}

/// Returns the error for inconsistent arrays.
fn wrong_arrays(location: &str, message: String) -> Diagnostic {
    Diagnostic::error(codes::INVALID_DATA, location, message, "correct the arrays")
}

impl MeshArrays {
    /// Checks the lengths, indices and positions.
    fn check_arrays(&self, location: &str) -> Result<(), Diagnostic> {
        let (vertices, faces) = (self.positions.len(), self.lengths.len());
        let lengths = [
            ("normals", self.normals.as_ref().map(Vec::len), vertices),
            ("uvs", self.uvs.as_ref().map(Vec::len), vertices),
            ("vertex_colors", self.vertex_colors.as_ref().map(Vec::len), vertices),
            ("face_colors", self.face_colors.as_ref().map(Vec::len), faces),
        ];
        for (array, found, expected) in lengths {
            if let Some(found) = found.filter(|found| *found != expected) {
                let message = format!("it has {found} entries, but {expected} are expected");
                return Err(wrong_arrays(&format!("{location}/{array}"), message));
            }
        }
        // Indices have 32 bits, and the largest one marks missing values.
        let most = u32::MAX as usize;
        if vertices.max(self.corners.len()).max(self.line_ends.len()) >= most {
            let what = format!("it has {vertices} vertices and {} corners", self.corners.len());
            let message = format!("{what}; fewer than {most} are supported");
            return Err(wrong_arrays(location, message));
        }
        let finite = |position: &[f32; 3]| position.iter().all(|x| x.is_finite());
        if let Some(at) = self.positions.iter().position(|position| !finite(position)) {
            let location = format!("{location}/positions/{at}");
            return Err(wrong_arrays(&location, "it is not finite".to_owned()));
        }
        let indices = [("corners", &self.corners), ("line_ends", &self.line_ends)];
        for (array, indices) in indices {
            if let Some(at) = indices.iter().position(|&vertex| vertex as usize >= vertices) {
                let location = format!("{location}/{array}/{at}");
                let index = indices[at] as usize;
                return Err(Diagnostic::unresolved_index(&location, "vertex", index, vertices));
            }
        }
        // A sum of u32 lengths may overflow u32.
        let corners: u64 = self.lengths.iter().map(|&length| u64::from(length)).sum();
        let is_polygon = |&length: &u32| length >= 3;
        if corners != self.corners.len() as u64 || !self.lengths.iter().all(is_polygon) {
            let corners = self.corners.len();
            let message = format!("the lengths must be at least 3 and add up to {corners} corners");
            return Err(wrong_arrays(&format!("{location}/lengths"), message));
        }
        if !self.line_ends.len().is_multiple_of(2) {
            let message = "lines need an even number of endpoints".to_owned();
            return Err(wrong_arrays(&format!("{location}/line_ends"), message));
        }
        Ok(())
    }

    /// Returns the material, with the texture at this index if there is one.
    fn to_material(&self, texture: Option<usize>) -> Material {
        let colors = self.vertex_colors.as_ref().or(self.face_colors.as_ref());
        let colors = colors.filter(|_| texture.is_none());
        let mut material = self.material.clone().unwrap_or_else(|| {
            let has_own = texture.is_some() || colors.is_some();
            let base_color = if has_own { [1.0; 4] } else { Material::plain().base_color };
            Material { base_color, ..Material::plain() }
        });
        if self.material.is_none() && colors.is_some_and(|all| all.iter().any(|c| c[3] < 1.0)) {
            material.alpha_mode = AlphaMode::Blend;
        }
        material.base_color_texture = texture.map(|texture| TextureInfo {
            texture,
            uv_set: 0,
            uv_matrix: TextureInfo::IDENTITY_UV,
        });
        material
    }

    /// Returns the name, and the arrays in the form of PLY contents.
    fn into_contents(self) -> (Option<String>, Contents) {
        let vertices = ply::Vertices {
            positions: self.positions,
            normals: self.normals,
            uvs: self.uvs,
            colors: self.vertex_colors,
            scalars: None,
        };
        let faces = ply::Faces {
            lengths: self.lengths,
            corners: self.corners,
            colors: self.face_colors,
            ..ply::Faces::default()
        };
        let strips = ply::Faces::default();
        (self.name, Contents { vertices, faces, strips, edges: self.line_ends })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square() -> MeshArrays {
        MeshArrays {
            positions: vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]],
            lengths: vec![3, 3],
            corners: vec![0, 1, 2, 0, 2, 3],
            ..MeshArrays::default()
        }
    }

    fn load(mesh: MeshArrays) -> Result<Model, Diagnostic> {
        load_arrays("mesh", vec![mesh], &[MeshNode::default()], &ImportOptions::default())
    }

    #[test]
    fn meshes_keep_their_order_and_have_separate_materials() {
        let image = Image { width: 1, height: 1, rgba: vec![[1, 2, 3, 255]] };
        let textured = MeshArrays { image: Some(image), uvs: Some(vec![[0.0; 2]; 4]), ..square() };
        let colored = MeshArrays { face_colors: Some(vec![[0.5; 4]; 2]), ..square() };
        let to_model = Affine::translation(homog::Vector::new(1.0, 2.0, 3.0));
        let nodes = [
            MeshNode { mesh: 2, to_model, name: Some("c".into()) },
            MeshNode { mesh: 1, ..MeshNode::default() },
        ];
        let options = ImportOptions::default();
        let model = load_arrays("m", vec![square(), colored, textured], &nodes, &options)
            .expect("valid meshes");
        assert_eq!(model.materials.len(), 3);
        assert_eq!(model.materials[0], Material::plain());
        assert_eq!(model.materials[1].alpha_mode, AlphaMode::Blend);
        assert_eq!(model.materials[2].base_color_texture.map(|texture| texture.texture), Some(0));
        let shown: Vec<_> = model.scene_primitives().map(|(_, p)| p.material).collect();
        assert_eq!(shown, [Some(2), Some(1)]);
        assert_eq!(model.meshes[1].primitives[0].colors.as_ref().map(Vec::len), Some(4));
    }

    #[test]
    fn points_and_lines_are_built() {
        let cloud = MeshArrays { positions: vec![[0.0; 3]; 5], ..MeshArrays::default() };
        let lines = MeshArrays { line_ends: vec![0, 1], ..cloud.clone() };
        for (mesh, count) in [(cloud, 5), (lines, 1)] {
            let model = load(mesh).expect("a valid mesh");
            assert_eq!(model.meshes[0].primitives[0].item_count(), count);
        }
    }

    #[test]
    fn inconsistent_arrays_are_rejected_with_a_location() {
        let nan = vec![[0.0; 3], [f32::NAN; 3], [0.0; 3], [0.0; 3]];
        let table = [
            (MeshArrays { corners: vec![0, 1, 4, 0, 2, 3], ..square() }, "/meshes/0/corners/2"),
            (MeshArrays { normals: Some(vec![[0.0; 3]; 3]), ..square() }, "/meshes/0/normals"),
            (MeshArrays { face_colors: Some(vec![]), ..square() }, "/meshes/0/face_colors"),
            (MeshArrays { positions: nan, ..square() }, "/meshes/0/positions/1"),
            (MeshArrays { lengths: vec![3, 0, 3], ..square() }, "/meshes/0/lengths"),
            (MeshArrays { lengths: vec![6, 3], ..square() }, "/meshes/0/lengths"),
            (MeshArrays { line_ends: vec![0], ..square() }, "/meshes/0/line_ends"),
        ];
        for (mesh, location) in table {
            assert_eq!(load(mesh).expect_err("inconsistent arrays").location, location);
        }
    }

    #[test]
    fn limits_are_enforced() {
        let mut options = ImportOptions::default();
        options.limits.array_bytes = 100;
        let refused = load_arrays("m", vec![square()], &[], &options).expect_err("too large");
        assert_eq!(refused.code, codes::LIMIT_EXCEEDED);
    }
}
