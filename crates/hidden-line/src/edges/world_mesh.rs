//! The primitives of all models as one indexed mesh in world space.
//!
//! Skinning, morph targets and node transforms are applied here. Every node with a mesh becomes one
//! *object*, the unit for grouping and hatching.

use super::vertex_normal::VertexNormal;
use glam::DVec3;
use homog::{Affine, Model as ModelSpace, World};
use model::{
    AlphaMode, EdgeVisibility, Material, MeshInstance, Model, ModelInstance, Primitive,
    SkinnedPrimitive, Topology,
};

/// A triangle of an object.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct Face {
    /// Indices into [`WorldMesh::points`].
    pub(crate) vertices: [u32; 3],
    /// The object that the face belongs to: an index into [`WorldMesh::objects`].
    pub(crate) object: u32,
    /// The material index, unique over all models: an index into [`WorldMesh::colors`], or a number
    /// counted down from `u32::MAX` for the caps of a section plane.
    pub(crate) material: u32,
    /// The vertex normals from the file, in the space of the primitive.
    pub(crate) normals: [VertexNormal; 3],
    /// The index of the section plane, if the face is part of a section cap.
    pub(crate) cap_section: Option<u16>,
    /// The visibility of the face's three sides in the file (`EXT_mesh_primitive_edge_visibility`),
    /// starting with the side from the first vertex to the second, or `None` if the file does not
    /// specify it.
    pub(crate) edge_visibility: Option<[EdgeVisibility; 3]>,
}

/// A separate line, not a side of a face.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct LineEdge {
    /// Indices into [`WorldMesh::points`].
    pub(crate) ends: [u32; 2],
    /// The object it belongs to.
    pub(crate) object: u32,
    /// Whether the file marks the line as an edge of a surface; otherwise it is a line primitive.
    pub(crate) is_marked: bool,
}

/// A point primitive.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub(crate) struct Dot {
    /// The object it belongs to.
    pub(crate) object: u32,
    /// The index into [`WorldMesh::points`].
    pub(crate) point: u32,
}

/// Everything in a scene that has edges or hides them, as an indexed mesh in world space.
#[derive(Clone, Debug, Default)]
pub(crate) struct WorldMesh {
    /// Positions in world space.
    pub(crate) points: Vec<DVec3>,
    /// Triangles; both of their sides hide lines.
    pub(crate) faces: Vec<Face>,
    /// Line primitives and lines that the file marks as edges.
    pub(crate) line_edges: Vec<LineEdge>,
    /// Point primitives.
    pub(crate) dots: Vec<Dot>,
    /// The edges created by section planes. After welding, they are sorted, and each runs from the
    /// lower index to the higher.
    pub(crate) section_edges: Vec<[u32; 2]>,
    /// Base colors of the materials by index, linear RGB.
    pub(crate) colors: Vec<[f32; 3]>,
    /// Whether the textures of the materials have cut-outs, by index.
    pub(crate) cut_outs: Vec<bool>,
    /// Whether to retain coincident faces of different objects. This is true until the sections are
    /// cut, because each body must be closed by its own faces.
    pub(crate) keeps_duplicates: bool,
    /// The object names.
    pub(crate) objects: Vec<String>,
    /// The objects that section planes do not cut, in ascending order.
    pub(crate) uncut: Vec<u32>,
}

impl WorldMesh {
    /// Returns the corners of a face.
    pub(crate) fn triangle(&self, face: u32) -> [DVec3; 3] {
        self.faces[face as usize].vertices.map(|vertex| self.points[vertex as usize])
    }

    /// Gathers all visible primitives of the models in their current poses.
    pub(crate) fn from_models(models: &[ModelInstance]) -> Self {
        let mut mesh = Self::default();
        let mut first_material = 0;
        for placed in models {
            let model = &*placed.model;
            for instance in model.mesh_instances() {
                let object = mesh.objects.len() as u32;
                mesh.objects.push(object_name(model, instance));
                let node_mesh = model.nodes[instance.node].mesh.map(|index| &model.meshes[index]);
                for primitive in node_mesh.into_iter().flat_map(|mesh| &mesh.primitives) {
                    let SkinnedPrimitive { positions, to_model, .. } =
                        model.skin_primitive(instance, primitive);
                    let to_world = to_model.then(placed.model_to_world);
                    let material = first_material + primitive.material.map_or(0, |m| m as u32 + 1);
                    mesh.add_primitive(primitive, &positions, to_world, object, material);
                }
            }
            mesh.cut_outs.push(false);
            mesh.cut_outs.extend(model.materials.iter().map(|material| has_holes(model, material)));
            let colors = model.materials.iter().map(|material| material.base_color);
            mesh.colors.push([1.0; 3]);
            mesh.colors.extend(colors.map(|[r, g, b, _]| [r, g, b]));
            first_material += model.materials.len() as u32 + 1;
        }
        mesh
    }

    /// Appends a primitive, with its vertices transformed to world space.
    ///
    /// Faces and lines with a vertex that is not finite are skipped. If a file lists the edges of a
    /// primitive, the list is complete: other sides are drawn only as silhouettes.
    fn add_primitive(
        &mut self,
        primitive: &Primitive,
        positions: &[[f32; 3]],
        to_world: Affine<ModelSpace, World>,
        object: u32,
        material: u32,
    ) {
        let first = self.points.len() as u32;
        let to_position =
            |position: &[f32; 3]| to_world.transform_point(position.map(f64::from).into()).raw();
        self.points.extend(positions.iter().map(to_position));
        match primitive.topology {
            Topology::Points => {
                let points = primitive.indices.iter().map(|index| index + first);
                let finite = points.filter(|point| are_finite(&self.points, &[*point]));
                self.dots.extend(finite.map(|point| Dot { object, point }));
            }
            Topology::Lines => {
                let (pairs, _) = primitive.indices.as_chunks::<2>();
                self.add_lines(pairs, first, object, false);
            }
            Topology::Triangles => {
                self.add_faces(primitive, first, object, material);
                let lists = primitive.edges.as_deref().into_iter().flat_map(|edges| &edges.lines);
                lists.for_each(|list| self.add_lines(&list.vertex_pairs, first, object, true));
            }
        }
    }

    /// Appends lines with finite ends; `first` is the index of the primitive's first vertex.
    fn add_lines(&mut self, pairs: &[[u32; 2]], first: u32, object: u32, is_marked: bool) {
        let ends = pairs.iter().map(|pair| pair.map(|vertex| vertex + first));
        let finite = ends.filter(|ends| are_finite(&self.points, ends));
        self.line_edges.extend(finite.map(|ends| LineEdge { ends, object, is_marked }));
    }

    /// Appends the triangles of a primitive that have finite vertices.
    fn add_faces(&mut self, primitive: &Primitive, first: u32, object: u32, material: u32) {
        let edges = primitive.edges.as_deref();
        let listed = |face: usize| Some(*edges?.visibility.as_ref()?.get(face)?);
        // If a file lists visible edges, other edges are drawn only as silhouettes.
        let unlisted = edges.map(|_| [EdgeVisibility::Silhouette; 3]);
        let normal = |vertex: u32| {
            let given = primitive.normals.as_ref().and_then(|list| list.get(vertex as usize));
            given.map_or(VertexNormal::NONE, |n| VertexNormal::pack(n.map(f64::from).into()))
        };
        let (triangles, _) = primitive.indices.as_chunks::<3>();
        let faces = triangles.iter().enumerate().map(|(index, triangle)| Face {
            vertices: triangle.map(|vertex| vertex + first),
            object,
            material,
            normals: triangle.map(normal),
            cap_section: None,
            edge_visibility: listed(index).or(unlisted),
        });
        self.faces.extend(faces.filter(|face| are_finite(&self.points, &face.vertices)));
    }

    /// Whether the texture of a face's material has cut-outs.
    pub(crate) fn is_cut_out(&self, face: &Face) -> bool {
        self.cut_outs.get(face.material as usize).copied().unwrap_or_default()
    }

    /// Removes the faces whose textures have cut-outs.
    pub(crate) fn remove_cut_outs(&mut self) {
        let faces = std::mem::take(&mut self.faces);
        self.faces = faces.into_iter().filter(|face| !self.is_cut_out(face)).collect();
    }

    /// Whether section planes cut an object.
    pub(crate) fn is_cut(&self, object: u32) -> bool {
        self.uncut.binary_search(&object).is_err()
    }

    /// Returns the diagonal of the bounding box of all finite points, or 0 if there are none.
    pub(crate) fn bounds_diagonal(&self) -> f64 {
        let finite = self.points.iter().filter(|point| point.is_finite());
        let (min, max) = finite.fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(min, max), &p| {
            (min.min(p), max.max(p))
        });
        let diagonal = (max - min).length();
        if diagonal.is_finite() { diagonal } else { 0.0 }
    }
}

/// Whether all these vertices have finite coordinates.
fn are_finite(points: &[DVec3], vertices: &[u32]) -> bool {
    vertices.iter().all(|&vertex| points[vertex as usize].is_finite())
}

/// Whether the base color texture of a material cuts out parts of its faces, as for leaves on
/// rectangles. Masks without a decoded image are assumed to have cut-outs.
fn has_holes(model: &Model, material: &Material) -> bool {
    let Some(used) = material.base_color_texture else { return false };
    let texture = model.textures.get(used.texture);
    let image = texture.and_then(|texture| model.images.get(texture.image?)?.as_ref());
    let has_less = |limit: u8| image.is_some_and(|i| i.rgba.iter().any(|[.., a]| *a < limit));
    match material.alpha_mode {
        AlphaMode::Opaque => false,
        AlphaMode::Mask { .. } => image.is_none() || has_less(255),
        AlphaMode::Blend => has_less(128),
    }
}

/// Returns the name of an object: the name of its node or mesh, or `node N` if both are unnamed.
fn object_name(model: &Model, instance: MeshInstance) -> String {
    let node = &model.nodes[instance.node];
    let mesh = || node.mesh.and_then(|mesh| model.meshes[mesh].name.clone());
    node.name.clone().or_else(mesh).unwrap_or_else(|| format!("node {}", instance.node))
}
