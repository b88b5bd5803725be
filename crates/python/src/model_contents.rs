//! The content of models: world positions and faces, animations, variants and cameras, and poses
//! from animations.

use crate::arrays::new_array;
use crate::detached::run_detached;
use crate::failure::{Failure, Fallible};
use crate::keywords::Keywords;
use crate::loading::{choice, pose_model};
use crate::subject::Subject;
use homog::Point;
use model::{Model, ModelInstance};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::sync::Arc;

/// Returns the world positions (V, 3) of all vertices, and the vertex indices (F, 3) of the points,
/// lines and triangles in the order of their ids. Points and lines repeat their last index.
#[pyfunction]
pub(crate) fn mesh_arrays<'py>(
    py: Python<'py>,
    subject: &Bound<'py, Subject>,
) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyAny>)> {
    let subject = subject.get();
    let (positions, corners) = py.detach(|| collect_arrays(&subject.models));
    let counts = [positions.len(), corners.len()];
    Ok((
        new_array(py, positions.into_flattened(), &[counts[0], 3])?,
        new_array(py, corners.into_flattened(), &[counts[1], 3])?,
    ))
}

/// Collects the posed positions and the indices of all models.
fn collect_arrays(models: &[ModelInstance]) -> (Vec<[f64; 3]>, Vec<[u32; 3]>) {
    let (mut positions, mut corners) = (Vec::new(), Vec::new());
    for ModelInstance { model, model_to_world } in models {
        for (instance, primitive) in model.scene_primitives() {
            let skinned = model.skin_primitive(instance, primitive);
            let to_world = skinned.to_model.then(*model_to_world);
            let first = positions.len() as u32;
            positions.extend(skinned.positions.iter().map(|position| {
                let [x, y, z] = position.map(f64::from);
                to_world.transform_point(Point::new(x, y, z)).raw().to_array()
            }));
            let count = primitive.topology.vertices_per_item();
            let item = |item: &[u32]| [0, 1, 2].map(|k: usize| first + item[k.min(count - 1)]);
            corners.extend(primitive.indices.chunks_exact(count).map(item));
        }
    }
    (positions, corners)
}

/// Returns the names and durations in seconds of the animations.
#[pyfunction]
pub(crate) fn animations(subject: &Bound<'_, Subject>) -> Vec<(Option<String>, f64)> {
    let models = subject.get().distinct_models();
    let animations = models.iter().flat_map(|model| &model.animations);
    animations.map(|animation| (animation.name.clone(), animation.duration_seconds)).collect()
}

/// Returns the material variants by name.
#[pyfunction]
pub(crate) fn variants(subject: &Bound<'_, Subject>) -> Vec<String> {
    subject.get().distinct_models().iter().flat_map(|model| model.variants.clone()).collect()
}

/// Returns a model in the pose of an animation, which shares the images of the given one.
#[pyfunction]
pub(crate) fn pose(
    py: Python<'_>,
    subject: &Bound<'_, Subject>,
    options: &Bound<'_, PyDict>,
) -> PyResult<Subject> {
    let options = Keywords(options);
    let (animation, time) = (choice(&options, "animation")?, options.number("time")?);
    let subject = subject.get();
    run_detached(py, |_| -> Fallible<Subject> {
        let [placed] = &subject.models[..] else {
            let message = format!("consists of {} models, expected one", subject.models.len());
            let help = "pose the models before you combine them";
            return Err(Failure::argument("model", message).with_help(help));
        };
        let mut model = Model::clone(&placed.model);
        pose_model(&mut model, animation.as_ref(), time)?;
        let placed =
            ModelInstance { model: Arc::new(model), model_to_world: placed.model_to_world };
        Ok(subject.with_models(vec![placed]))
    })
}
