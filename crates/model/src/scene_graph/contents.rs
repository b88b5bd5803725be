//! The contents of the active scene: primitives, points and bounding boxes, after skinning and
//! morphing.

use crate::{MeshInstance, Model, Primitive, SceneRoots, SkinnedPrimitive};
use glam::{DVec3, Vec3};
use homog::{Bounds, Model as ModelSpace, Point};

impl Model {
    /// Returns the primitives of the active scene, each once per instance of its mesh.
    pub fn scene_primitives(&self) -> impl Iterator<Item = (MeshInstance, &Primitive)> {
        self.primitives_below(&self.roots)
    }

    /// Returns the primitives of the meshes at the given nodes and their descendants.
    fn primitives_below(
        &self,
        roots: &[usize],
    ) -> impl Iterator<Item = (MeshInstance, &Primitive)> {
        self.mesh_instances_below(roots).flat_map(|instance| {
            let mesh = self.nodes[instance.node].mesh;
            let primitives = mesh.map_or(&[][..], |mesh| self.meshes[mesh].primitives.as_slice());
            primitives.iter().map(move |primitive| (instance, primitive))
        })
    }

    /// Returns the positions of all vertices that a visible point, line or triangle uses, in the
    /// current pose.
    ///
    /// A large model has millions of these; [`for_each_scene_point`](Self::for_each_scene_point)
    /// does not need memory for them.
    #[must_use]
    pub fn scene_points(&self) -> Vec<Point<ModelSpace>> {
        let mut points = Vec::new();
        self.for_each_scene_point(|point| points.push(point));
        points
    }

    /// Calls `visit` with each of the [`scene_points`](Self::scene_points), without collecting
    /// them.
    pub fn for_each_scene_point(&self, visit: impl FnMut(Point<ModelSpace>)) {
        self.for_each_point_below(&self.roots, visit);
    }

    /// Calls `visit` with the deformed position of every used vertex of the given nodes and their
    /// descendants.
    ///
    /// Vertices that no index uses are skipped, because some files have stray vertices far from the
    /// shape.
    fn for_each_point_below(&self, roots: &[usize], mut visit: impl FnMut(Point<ModelSpace>)) {
        for (instance, primitive) in self.primitives_below(roots) {
            let SkinnedPrimitive { positions, to_model, .. } =
                self.skin_primitive(instance, primitive);
            let used = used_vertices(primitive);
            for (&position, _) in positions.iter().zip(used).filter(|(_, used)| *used) {
                let position = Vec3::from_array(position).as_dvec3();
                visit(to_model.transform_point(position.to_array().into()));
            }
        }
    }

    /// Returns the axis-aligned bounding box of the active scene in model space, or `None` if
    /// nothing is visible.
    ///
    /// Every visible vertex is skinned and transformed, so the box is tight in the current pose.
    /// The time is linear in the number of vertices of all instances.
    #[must_use]
    pub fn bounds(&self) -> Option<Bounds<ModelSpace>> {
        self.bounds_below(&self.roots)
    }

    /// Returns the axis-aligned bounding box of a scene of the file in the current pose, or `None`
    /// if the scene shows nothing.
    ///
    /// Unlike [`bounds`](Self::bounds), this works for scenes that are not active. Their root
    /// indices have not been checked, so indices out of range are skipped.
    #[must_use]
    pub fn scene_bounds(&self, scene: &SceneRoots) -> Option<Bounds<ModelSpace>> {
        let exists = |node: &usize| *node < self.nodes.len();
        let roots: Vec<usize> = scene.nodes.iter().copied().filter(exists).collect();
        self.bounds_below(&roots)
    }

    /// Returns the bounding box of the given nodes and their descendants.
    fn bounds_below(&self, roots: &[usize]) -> Option<Bounds<ModelSpace>> {
        let mut extent: Option<[DVec3; 2]> = None;
        self.for_each_point_below(roots, |point| {
            let [min, max] = extent.get_or_insert([point.raw(); 2]);
            (*min, *max) = (min.min(point.raw()), max.max(point.raw()));
        });
        Bounds::from_points(extent?.map(Point::from_raw))
    }
}

/// Returns for each vertex of a primitive whether any index refers to it.
///
/// Every index must be less than the number of vertices, which the importer checks.
fn used_vertices(primitive: &Primitive) -> Vec<bool> {
    let mut used = vec![false; primitive.positions.len()];
    for &index in &primitive.indices {
        used[index as usize] = true;
    }
    used
}
