//! What the shown scene of a model consists of, and how much room it takes.

use crate::{MeshInstance, Model, Primitive, SceneRoots, SkinnedPrimitive};
use glam::DVec3;
use homog::{Bounds, Model as ModelSpace, Point};

impl Model {
    /// The primitives of the shown scene, as often as they are shown, each with its place.
    pub fn scene_primitives(&self) -> impl Iterator<Item = (MeshInstance, &Primitive)> {
        self.primitives_below(&self.roots)
    }

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

    /// The places of all vertices that some shown point, line or triangle uses, as the nodes stand.
    #[must_use]
    pub fn scene_points(&self) -> Vec<Point<ModelSpace>> {
        let mut points = Vec::new();
        self.for_each_scene_point(|point| points.push(point));
        points
    }

    /// Calls `visit` with each of the [`shown_points`](Self::shown_points), in their order, without a list of them all.
    pub fn for_each_scene_point(&self, visit: impl FnMut(Point<ModelSpace>)) {
        self.for_each_point_below(&self.roots, visit);
    }

    fn for_each_point_below(&self, roots: &[usize], mut visit: impl FnMut(Point<ModelSpace>)) {
        for (instance, primitive) in self.primitives_below(roots) {
            let SkinnedPrimitive { positions, to_model, .. } =
                self.skin_primitive(instance, primitive);
            let used = used_vertices(primitive);
            for (&position, _) in positions.iter().zip(used).filter(|(_, used)| *used) {
                visit(to_model.transform_point(position.map(f64::from).into()));
            }
        }
    }

    /// The box around everything that is shown, along the model's axes; `None` if nothing is.
    #[must_use]
    pub fn bounds(&self) -> Option<Bounds<ModelSpace>> {
        self.bounds_below(&self.roots)
    }

    /// The box around a scene of the file, as the nodes stand.
    #[must_use]
    pub fn scene_bounds(&self, scene: &SceneRoots) -> Option<Bounds<ModelSpace>> {
        let exists = |node: &usize| *node < self.nodes.len();
        let roots: Vec<usize> = scene.nodes.iter().copied().filter(exists).collect();
        self.bounds_below(&roots)
    }

    fn bounds_below(&self, roots: &[usize]) -> Option<Bounds<ModelSpace>> {
        let mut extent: Option<[DVec3; 2]> = None;
        self.for_each_point_below(roots, |point| {
            let [min, max] = extent.get_or_insert([point.raw(); 2]);
            (*min, *max) = (min.min(point.raw()), max.max(point.raw()));
        });
        Bounds::from_points(extent?.map(Point::from_raw))
    }
}

/// For each vertex of a primitive, whether some item uses it.
fn used_vertices(primitive: &Primitive) -> Vec<bool> {
    let mut used = vec![false; primitive.positions.len()];
    for &index in &primitive.indices {
        used[index as usize] = true;
    }
    used
}
