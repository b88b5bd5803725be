//! Rendering subjects: placed models with a scene description, and the mip chains of their
//! textures, which are computed once and reused.

use crate::arrays;
use crate::failure::{Failure, Fallible};
use homog::Bounds;
use model::{ModelInstance, Severity, world_points};
use pipeline::{Origin, Scene, SceneFile, Textures};
use pyo3::prelude::*;
use scene::ResolveOptions;
use self_cell::self_cell;
use std::sync::{Arc, OnceLock};

self_cell! {
    /// Models, and the mip chains of their textures, which borrow from the models.
    struct TexturedModels {
        owner: Vec<ModelInstance>,
        #[covariant]
        dependent: Textures,
    }
}

/// Placed models with default settings for rendering them.
#[pyclass(frozen, module = "alberti._native")]
pub(crate) struct Subject {
    /// The source of the scene.
    pub(crate) origin: Origin,
    /// The scene description.
    pub(crate) file: SceneFile,
    /// The models, loaded and placed.
    pub(crate) models: Vec<ModelInstance>,
    /// The folders allowed for scene files, and the model loading options.
    options: ResolveOptions,
    /// The models with their mip chains; empty before the first picture.
    textured: OnceLock<TexturedModels>,
}

impl Subject {
    /// Creates a subject from loaded models.
    pub(crate) fn new(origin: Origin, file: SceneFile, models: Vec<ModelInstance>) -> Self {
        let options = ResolveOptions::default();
        Self { origin, file, models, options, textured: OnceLock::new() }
    }

    /// Creates a subject from a scene and loads its models.
    ///
    /// # Errors
    /// Returns all errors in the scene, including models that cannot be loaded.
    pub(crate) fn from_scene(
        origin: Origin,
        file: SceneFile,
        options: ResolveOptions,
    ) -> Fallible<Self> {
        let models = Scene::resolve(&origin, &file, &options)?.models;
        Ok(Self { options, ..Self::new(origin, file, models) })
    }

    /// Resolves a description that uses the models to a scene.
    ///
    /// # Errors
    /// Returns an error if the description is invalid.
    pub(crate) fn resolve(&self, file: &SceneFile) -> Fallible<Scene> {
        let allowed = &self.options.import.allow_outside;
        let models = self.models.clone();
        Ok(Scene::from_models_allowing(&self.origin, file, &models, allowed)?)
    }

    /// Returns the mip chains of the model textures.
    pub(crate) fn textures(&self) -> &Textures<'_> {
        let make =
            || TexturedModels::new(self.models.clone(), |models| Textures::for_models(models));
        self.textured.get_or_init(make).borrow_dependent()
    }

    /// Returns the models without duplicates, in scene order.
    fn distinct_models(&self) -> Vec<&Arc<model::Model>> {
        let mut distinct: Vec<&Arc<model::Model>> = Vec::new();
        for placed in &self.models {
            if !distinct.iter().any(|known| Arc::ptr_eq(known, &placed.model)) {
                distinct.push(&placed.model);
            }
        }
        distinct
    }
}

#[pymethods]
impl Subject {
    /// Returns the model names.
    #[getter]
    fn name(&self) -> String {
        model::model_names(&self.models)
    }

    /// Returns the corners of the world bounding box of all vertices, or None if there are no
    /// vertices.
    fn bounds<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyAny>>> {
        let Some(bounds) = Bounds::from_points(world_points(&self.models)) else {
            return Ok(None);
        };
        let corners = [bounds.min(), bounds.max()].map(|corner| corner.raw().to_array());
        arrays::new_array(py, corners.as_flattened().to_vec(), &[2, 3]).map(Some)
    }

    /// Returns the point, line and triangle counts.
    fn item_counts(&self) -> [usize; 3] {
        let mut counts = [0; 3];
        for placed in &self.models {
            for (_, primitive) in placed.model.scene_primitives() {
                counts[primitive.topology.vertices_per_item() - 1] += primitive.item_count();
            }
        }
        counts
    }

    /// Returns the importer's warnings, without notes and hints.
    fn warnings(&self) -> Vec<String> {
        let models = self.distinct_models().into_iter();
        let warnings = models.flat_map(|model| {
            let own = model.warnings.iter();
            let shown = own.filter(|warning| warning.severity <= Severity::Warning);
            shown.map(|warning| format!("{}: {}", model.name, warning.sentence()))
        });
        warnings.collect()
    }

    /// Returns the node, mesh or material names in each distinct model; None for unnamed parts.
    fn part_names(&self, what: &str) -> PyResult<Vec<Vec<Option<String>>>> {
        let names = |model: &Arc<model::Model>| match what {
            "nodes" => Ok(model.nodes.iter().map(|part| part.name.clone()).collect()),
            "meshes" => Ok(model.meshes.iter().map(|part| part.name.clone()).collect()),
            "materials" => Ok(model.materials.iter().map(|part| part.name.clone()).collect()),
            _ => Err(PyErr::from(Failure::argument("what", "expected nodes, meshes or materials"))),
        };
        self.distinct_models().into_iter().map(names).collect()
    }
}
