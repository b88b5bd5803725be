//! Model instances in the world: each is a shared model with a transform.

use crate::Model;
use homog::{Affine, Model as ModelSpace, Point, World};
use std::collections::BTreeMap;
use std::sync::Arc;

/// A model placed in the world.
#[derive(Clone, Debug)]
pub struct ModelInstance {
    /// The model, which all its instances share.
    pub model: Arc<Model>,
    /// The transform from model space to world space.
    pub model_to_world: Affine<ModelSpace, World>,
}

/// Returns the world positions of all vertices that a point, line or triangle of the models uses.
#[must_use]
pub fn world_points(models: &[ModelInstance]) -> Vec<Point<World>> {
    let mut points = Vec::new();
    for ModelInstance { model, model_to_world } in models {
        model.for_each_scene_point(|point| points.push(model_to_world.transform_point(point)));
    }
    points
}

/// The ids of the first node, mesh and material of a model in a scene.
///
/// Ids count from 1 through the whole scene. Each model instance has separate nodes, but
/// instances of one model share its meshes and materials.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct FirstIds {
    /// The id of the first node.
    pub node: usize,
    /// The id of the first mesh.
    pub mesh: usize,
    /// The id of the first material.
    pub material: usize,
}

impl FirstIds {
    /// Returns the first ids of each model instance, in scene order.
    #[must_use]
    pub fn of_models(models: &[ModelInstance]) -> Vec<Self> {
        let mut next = Self { node: 1, mesh: 1, material: 1 };
        let mut shared: BTreeMap<*const Model, Self> = BTreeMap::new();
        let number = |ModelInstance { model, .. }: &ModelInstance| {
            let first = *shared.entry(Arc::as_ptr(model)).or_insert_with(|| {
                let first = next;
                next.mesh += model.meshes.len();
                next.material += model.materials.len();
                first
            });
            let node = next.node;
            next.node += model.nodes.len();
            Self { node, ..first }
        };
        models.iter().map(number).collect()
    }
}

/// Returns the model names without duplicates, separated by commas.
#[must_use]
pub fn model_names(models: &[ModelInstance]) -> String {
    let mut names: Vec<&str> = Vec::new();
    for ModelInstance { model, .. } in models {
        if !names.contains(&model.name.as_str()) {
            names.push(&model.name);
        }
    }
    names.join(", ")
}
