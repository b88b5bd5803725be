//! Scenes built from models in memory, without files.

use super::{Origin, ResolveError, Scene};
use homog::{Affine, Model as ModelSpace, World};
use model::{Mesh, Model, ModelInstance, Node, Primitive};
use scene_file::file::{CameraFile, LightFile, SceneFile, StyleFile};
use std::path::PathBuf;
use std::sync::Arc;

/// A builder for scenes from models, meshes, cameras and lights in memory. Create one with
/// [`Scene::builder`].
///
/// Everything else has the defaults of `alberti render` for a model without a scene file. The
/// camera faces the front of the models from slightly above and to the right, in a studio
/// environment with a light on the left.
#[derive(Clone, Debug, Default)]
pub struct SceneBuilder {
    models: Vec<ModelInstance>,
    file: SceneFile,
}

impl Scene {
    /// Starts a scene with models in memory.
    ///
    /// ```
    /// use scene_file::file::{CameraFile, LightFile};
    /// use scene::Scene;
    ///
    /// let scene = Scene::builder()
    ///     .mesh([[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [0.0, 1.0, 0.0]], [0, 1, 2])
    ///     .camera(CameraFile::look_at([0.0, 0.0, 4.0], [0.0; 3]))
    ///     .light(LightFile::directional([0.0, 0.0, -1.0], 2.0)?)
    ///     .size(64, 48)
    ///     .build()?;
    /// assert_eq!((scene.image.width, scene.image.height), (64, 48));
    /// assert_eq!((scene.models.len(), scene.lights.len()), (1, 1));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn builder() -> SceneBuilder {
        SceneBuilder::default()
    }
}

impl SceneBuilder {
    /// Adds a model with its nodes at their original positions.
    #[must_use]
    pub fn model(self, model: impl Into<Arc<Model>>) -> Self {
        self.model_at(model, Affine::IDENTITY)
    }

    /// Adds a model that is moved, rotated or scaled. Models that share an `Arc` are stored once.
    #[must_use]
    pub fn model_at(
        mut self,
        model: impl Into<Arc<Model>>,
        model_to_world: Affine<ModelSpace, World>,
    ) -> Self {
        self.models.push(ModelInstance { model: model.into(), model_to_world });
        self
    }

    /// Adds a mesh of triangles without a material: points in world space, and three indices per
    /// triangle, counterclockwise as seen from the front.
    #[must_use]
    pub fn mesh(
        self,
        positions: impl IntoIterator<Item = [f32; 3]>,
        indices: impl IntoIterator<Item = u32>,
    ) -> Self {
        let primitive = Primitive {
            positions: positions.into_iter().collect(),
            indices: indices.into_iter().collect(),
            ..Primitive::default()
        };
        self.primitive(primitive)
    }

    /// Adds a primitive, optionally with normals, colors and texture coordinates.
    #[must_use]
    pub fn primitive(self, primitive: Primitive) -> Self {
        self.model(Model {
            meshes: vec![Mesh { primitives: vec![primitive], ..Mesh::default() }],
            nodes: vec![Node { mesh: Some(0), ..Node::default() }],
            roots: vec![0],
            ..Model::default()
        })
    }

    /// Sets the camera.
    #[must_use]
    pub fn camera(mut self, camera: CameraFile) -> Self {
        self.file.camera = camera;
        self
    }

    /// Adds a light, which disables the default lights.
    #[must_use]
    pub fn light(mut self, light: LightFile) -> Self {
        self.file.lights.get_or_insert_default().push(light);
        self
    }

    /// Sets the style of surfaces and lines.
    #[must_use]
    pub fn style(mut self, style: StyleFile) -> Self {
        self.file.style = style;
        self
    }

    /// Sets the width and height of the picture in pixels.
    #[must_use]
    pub const fn size(mut self, width: u32, height: u32) -> Self {
        self.file.image.size = (width, height);
        self
    }

    /// Modifies the scene file directly, for settings without a method here. Its field `models` is
    /// ignored.
    ///
    /// ```
    /// use scene::Scene;
    /// use scene_file::file::{BackgroundFile, Color};
    ///
    /// let sky = |file: &mut scene_file::SceneFile| {
    ///     file.image.background = Some(BackgroundFile::Color(Color([128, 160, 255])));
    /// };
    /// let triangle = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    /// let scene = Scene::builder().mesh(triangle, [0, 1, 2]).with(sky).build()?;
    /// assert_eq!(scene.image.background[3], 1.0);
    /// # Ok::<(), scene::ResolveError>(())
    /// ```
    #[must_use]
    pub fn with(mut self, change: impl FnOnce(&mut SceneFile)) -> Self {
        change(&mut self.file);
        self
    }

    /// Builds the scene, ready to be rendered.
    ///
    /// # Errors
    /// Returns all errors, such as a camera without a direction, or a camera that frames the models
    /// when there are none.
    pub fn build(self) -> Result<Scene, ResolveError> {
        let origin = Origin::from_text("scene", "", PathBuf::new());
        Scene::from_models(&origin, &self.file, &self.models)
    }
}
