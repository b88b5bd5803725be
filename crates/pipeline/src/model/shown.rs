//! What the shown scene of a model consists of, and how much room it takes.

use super::{Instance, Model, Posed, Primitive, SceneRoots};
use homog::{Bounds, Model as ModelSpace, Point};

impl Model {
    /// The primitives of the shown scene, as often as they are shown, each with its place.
    pub fn shown_primitives(&self) -> impl Iterator<Item = (Instance, &Primitive)> {
        self.primitives_below(&self.roots)
    }

    fn primitives_below(&self, roots: &[usize]) -> impl Iterator<Item = (Instance, &Primitive)> {
        self.meshes_below(roots).flat_map(|instance| {
            let mesh = self.nodes[instance.node].mesh;
            let primitives = mesh.map_or(&[][..], |mesh| self.meshes[mesh].primitives.as_slice());
            primitives.iter().map(move |primitive| (instance, primitive))
        })
    }

    /// The places of all vertices that some shown point, line or triangle uses, as the nodes stand.
    #[must_use]
    pub fn shown_points(&self) -> Vec<Point<ModelSpace>> {
        self.points_below(&self.roots).collect()
    }

    /// The places of the vertices below some nodes, one primitive after the other: never all of them at once.
    fn points_below(&self, roots: &[usize]) -> impl Iterator<Item = Point<ModelSpace>> {
        self.primitives_below(roots).flat_map(|(instance, primitive)| {
            let Posed { positions, to_model, .. } = self.posed(instance, primitive);
            let used = used_vertices(primitive).into_iter().enumerate().filter(|(_, used)| *used);
            used.map(move |(vertex, _)| to_model.point(positions[vertex].map(f64::from).into()))
        })
    }

    /// The box around everything that is shown, along the model's axes; `None` if nothing is.
    #[must_use]
    pub fn bounds(&self) -> Option<Bounds<ModelSpace>> {
        Bounds::of(self.points_below(&self.roots))
    }

    /// The box around a scene of the file, as the nodes stand.
    #[must_use]
    pub fn scene_bounds(&self, scene: &SceneRoots) -> Option<Bounds<ModelSpace>> {
        let exists = |node: &usize| *node < self.nodes.len();
        let roots: Vec<usize> = scene.nodes.iter().copied().filter(exists).collect();
        Bounds::of(self.points_below(&roots))
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
