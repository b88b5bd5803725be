//! Rendering subjects: placed models with a scene description, and the mip chains of their
//! textures, which are computed once and reused.

use crate::arrays;
use crate::failure::{Failure, Fallible};
use homog::{Affine, Bounds, Model as ModelSpace, World};
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
    /// The models with their mip chains; empty before the first picture. Subjects with the same
    /// models in other poses share them.
    textured: Arc<OnceLock<TexturedModels>>,
}

impl Subject {
    /// Creates a subject from loaded models.
    pub(crate) fn new(origin: Origin, file: SceneFile, models: Vec<ModelInstance>) -> Self {
        let options = ResolveOptions::default();
        Self { origin, file, models, options, textured: Arc::default() }
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

    /// Returns a subject with other models and the same scene description.
    pub(crate) fn with_models(&self, models: Vec<ModelInstance>) -> Self {
        let (origin, file) = (self.origin.clone(), self.file.clone());
        Self { options: self.options.clone(), ..Self::new(origin, file, models) }
    }

    /// Returns a subject with the same models in other places, and with the same mip chains.
    pub(crate) fn with_poses(&self, poses: Vec<Affine<ModelSpace, World>>) -> Self {
        let place = |(placed, model_to_world): (&ModelInstance, _)| ModelInstance {
            model: Arc::clone(&placed.model),
            model_to_world,
        };
        let models = self.models.iter().zip(poses).map(place).collect();
        Self { textured: Arc::clone(&self.textured), ..self.with_models(models) }
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

    /// Whether the models have no points, lines or triangles.
    pub(crate) fn is_empty(&self) -> bool {
        self.item_counts() == [0; 3]
    }

    /// Returns the models without duplicates, in scene order.
    pub(crate) fn distinct_models(&self) -> Vec<&Arc<model::Model>> {
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
    pub(crate) fn item_counts(&self) -> [usize; 3] {
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

    /// Returns the node, mesh or material names by id, from 1; None for unnamed parts.
    fn part_names(&self, what: &str) -> PyResult<Vec<Option<String>>> {
        let names = |model: &Arc<model::Model>| -> PyResult<Vec<Option<String>>> {
            Ok(match what {
                "nodes" => model.nodes.iter().map(|part| part.name.clone()).collect(),
                "meshes" => model.meshes.iter().map(|part| part.name.clone()).collect(),
                "materials" => model.materials.iter().map(|part| part.name.clone()).collect(),
                _ => {
                    return Err(
                        Failure::argument("what", "expected nodes, meshes or materials").into()
                    );
                }
            })
        };
        // Each model instance has separate nodes, but instances share meshes and materials.
        let models: Vec<_> = if what == "nodes" {
            self.models.iter().map(|placed| &placed.model).collect()
        } else {
            self.distinct_models()
        };
        Ok(models.into_iter().map(names).collect::<PyResult<Vec<_>>>()?.concat())
    }

    /// Returns the objects by id, from 1: the model's id and name, the node's id and the names
    /// from the root to the node, the mesh's id and name, and the ids of the materials.
    fn objects(&self) -> Vec<ObjectRow> {
        let mut rows = Vec::new();
        let first_ids = model::FirstIds::of_models(&self.models);
        for ((model_id, placed), first) in (1..).zip(&self.models).zip(first_ids) {
            let model = &placed.model;
            let parents = parent_indices(model);
            for instance in model.mesh_instances() {
                let Some(mesh) = model.nodes[instance.node].mesh else { continue };
                let mut path = Vec::new();
                let mut next = Some(instance.node);
                while let Some(node) = next {
                    path.push(model.nodes[node].name.clone());
                    next = parents[node];
                }
                path.reverse();
                let materials = model.meshes[mesh].primitives.iter();
                let materials =
                    materials.map(|part| part.material.map_or(0, |index| first.material + index));
                rows.push((
                    (model_id, model.name.clone()),
                    (first.node + instance.node, path),
                    (first.mesh + mesh, model.meshes[mesh].name.clone()),
                    materials.collect(),
                ));
            }
        }
        rows
    }

    /// Returns the parts of a scene description that are lost when only its models are used.
    fn scene_settings(&self) -> Vec<&'static str> {
        let (file, default) = (&self.file, SceneFile::default());
        let settings = [
            ("camera", file.camera != default.camera),
            ("lights", file.lights.is_some()),
            ("environment", file.environment.is_some()),
            ("shadows", file.shadows.is_some()),
            ("ground", file.ground.is_some()),
            ("style", file.style != default.style),
            ("overlays", !file.overlays.is_empty()),
            ("sections", !file.sections.is_empty()),
            ("viewports", !file.viewports.is_empty()),
        ];
        settings.into_iter().filter(|(_, is_set)| *is_set).map(|(name, _)| name).collect()
    }
}

/// An object: the id and name of the model, the id and path of the node, the id and name of the
/// mesh, and the ids of the materials.
type ObjectRow =
    ((usize, String), (usize, Vec<Option<String>>), (usize, Option<String>), Vec<usize>);

/// Returns the parent of each node.
fn parent_indices(model: &model::Model) -> Vec<Option<usize>> {
    let mut parents = vec![None; model.nodes.len()];
    for (index, node) in model.nodes.iter().enumerate() {
        for &child in &node.children {
            parents[child] = Some(index);
        }
    }
    parents
}
