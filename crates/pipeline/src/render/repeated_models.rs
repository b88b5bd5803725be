//! Repeated models: a model that coincides with an earlier model does not have to be drawn again.
//!
//! A two-megabyte scene file can name a model a hundred thousand times, and each copy could fill
//! the picture. Among opaque surfaces at the same depth the first wins, so drawing the others
//! changes nothing.

use super::vertex_inputs::material_opacity;
use model::ModelInstance;
use raster::Opacity;
use scene::Style;
use std::sync::Arc;

/// Returns, for each model of a scene, whether an identical earlier model has the same transform
/// and no translucent surface, which would become denser if drawn twice.
pub(super) fn find_repeated(models: &[ModelInstance], style: Style) -> Vec<bool> {
    let mut is_repeated = vec![false; models.len()];
    // In the X-ray style all surfaces are translucent.
    if models.len() < 2 || style == Style::XRay {
        return is_repeated;
    }
    let place = |index: usize| {
        let ModelInstance { model, model_to_world } = &models[index];
        (Arc::as_ptr(model).addr(), model_to_world.raw().to_cols_array().map(f64::to_bits))
    };
    let mut order: Vec<usize> = (0..models.len()).collect();
    // The sort is stable, so the first model of each group is the first in scene order.
    order.sort_by_key(|index| place(*index));
    for pair in order.windows(2) {
        if place(pair[0]) == place(pair[1]) {
            let materials = &models[pair[1]].model.materials;
            let is_opaque = materials.iter().all(|it| material_opacity(it) != Opacity::Translucent);
            is_repeated[pair[1]] = is_opaque;
        }
    }
    is_repeated
}

#[cfg(test)]
mod tests {
    use super::*;
    use homog::{Affine, Vector};
    use model::{AlphaMode, Material, Model};

    #[test]
    fn opaque_models_with_equal_transforms_are_found() {
        let opaque = Arc::new(Model::default());
        let glass = Material { alpha_mode: AlphaMode::Blend, ..Material::default() };
        let glass = Arc::new(Model { materials: vec![glass], ..Model::default() });
        let at = |model: &Arc<Model>, x: f64| ModelInstance {
            model: Arc::clone(model),
            model_to_world: Affine::translation(Vector::new(x, 0.0, 0.0)),
        };
        let models = [
            at(&opaque, 1.0),
            at(&glass, 1.0),
            at(&opaque, 2.0),
            at(&opaque, 1.0),
            at(&glass, 1.0),
            at(&opaque, 1.0),
        ];
        let expected = [false, false, false, true, false, true];
        assert_eq!(find_repeated(&models, Style::Shaded), expected);
        assert_eq!(find_repeated(&models, Style::XRay), [false; 6]);
    }
}
