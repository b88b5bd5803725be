//! Model instances in the world: each is a shared model with a transform.

use crate::Model;
use homog::{Affine, Model as ModelSpace, Point, World};
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
