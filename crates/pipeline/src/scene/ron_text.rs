//! Scenes as text in RON: read and written by the package `ron`.

use super::SceneErrors;
use super::file::SceneFile;
use super::format::format_source;
use super::parse::parse_scene;
use ron::Options;
use ron::extensions::Extensions;

/// How `ron` reads and writes scene files: with the extensions `implicit_some`, `unwrap_newtypes`
/// and `unwrap_variant_newtypes`, so that no file has to begin with an attribute.
///
/// With them any function of `ron` reads scenes and their parts:
///
/// ```
/// use pipeline::scene::file::{ModelFile, SceneFile};
///
/// let options = pipeline::scene::scene_ron_options();
/// let model: ModelFile = options.from_str("(path: \"duck.glb\", scale: 2)")?;
/// let scene = SceneFile { models: vec![model], ..SceneFile::default() };
/// let text = options.to_string(&scene)?;
/// assert_eq!(text, "(models:[(path:\"duck.glb\",scale:2)])");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[must_use]
pub fn scene_ron_options() -> Options {
    Options::default()
        .with_default_extension(Extensions::IMPLICIT_SOME)
        .with_default_extension(Extensions::UNWRAP_NEWTYPES)
        .with_default_extension(Extensions::UNWRAP_VARIANT_NEWTYPES)
}

impl SceneFile {
    /// Reads a scene from the text of a scene file. Nothing else is read, neither models nor
    /// included files: [`Scene::resolve`](super::Scene::resolve) does that.
    ///
    /// # Errors
    /// Every mistake in the text, in its order.
    pub fn from_ron(text: &str) -> Result<Self, SceneErrors> {
        parse_scene("scene", text)
    }

    /// The text of a scene file that reads back as this scene, laid out as `alberti scene fmt` does.
    /// Fields that have their defaults are left out.
    ///
    /// ```
    /// use pipeline::scene::SceneFile;
    ///
    /// let scene = SceneFile::from_model_path("duck.glb".to_owned());
    /// assert_eq!(scene.to_ron()?, "Scene(models: [(path: \"duck.glb\")])\n");
    /// assert_eq!(SceneFile::from_ron(&scene.to_ron()?)?, scene);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// [`write_file`](crate::write_file) writes it to a file, which is there whole or not at all.
    ///
    /// # Errors
    /// If a number of the scene is one that scene files refuse, such as NaN or a scale of 0.
    pub fn to_ron(&self) -> Result<String, ron::Error> {
        let text = format!("Scene{}\n", scene_ron_options().to_string(self)?);
        scene_ron_options().from_str::<Self>(&text).map_err(|error| error.code)?;
        Ok(format_source("scene", &text).unwrap_or(text))
    }
}
