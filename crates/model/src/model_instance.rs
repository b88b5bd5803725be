//! Models in the world: a shared model, and its transform.

use crate::Model;
use homog::{Affine, Model as ModelSpace, Point, World};
use std::sync::Arc;

/// A model placed in the world.
#[derive(Clone, Debug)]
pub struct ModelInstance {
    /// The model; scenes that show it several times share it.
    pub model: Arc<Model>,
    /// From the model's own coordinates to the world.
    pub model_to_world: Affine<ModelSpace, World>,
}

/// Every vertex that some point, line or triangle of the models uses, in the world.
#[must_use]
pub fn world_points(models: &[ModelInstance]) -> Vec<Point<World>> {
    let mut points = Vec::new();
    for ModelInstance { model, model_to_world } in models {
        model.for_each_scene_point(|point| points.push(model_to_world.transform_point(point)));
    }
    points
}

/// The names of the models, each once, joined by commas.
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
