//! What the shown scene of a model consists of, and how much room it takes.

use super::{Instance, Model, Posed, Primitive};
use homog::{Bounds, Model as ModelSpace, Point};

impl Model {
    /// The primitives of the shown scene, as often as they are shown, each with its place.
    pub fn shown_primitives(&self) -> impl Iterator<Item = (Instance, &Primitive)> {
        self.shown_meshes().flat_map(|instance| {
            let mesh = self.nodes[instance.node].mesh;
            let primitives = mesh.map_or(&[][..], |mesh| self.meshes[mesh].primitives.as_slice());
            primitives.iter().map(move |primitive| (instance, primitive))
        })
    }

    /// The places of all vertices that some shown point, line or triangle uses, at rest.
    #[must_use]
    pub fn shown_points(&self) -> Vec<Point<ModelSpace>> {
        let mut points = Vec::new();
        for (instance, primitive) in self.shown_primitives() {
            let Posed { positions, to_model, .. } = self.posed(instance, primitive);
            let mut used = vec![false; positions.len()];
            for &index in &primitive.indices {
                used[index as usize] = true;
            }
            let used = positions.iter().zip(used).filter(|(_, used)| *used);
            points.extend(used.map(|(&p, _)| to_model.point(p.map(f64::from).into())));
        }
        points
    }

    /// The box around everything that is shown, along the model's axes; `None` if nothing is.
    #[must_use]
    pub fn bounds(&self) -> Option<Bounds<ModelSpace>> {
        Bounds::of(self.shown_points())
    }
}
