//! Scenes as RON text, read and written with the `ron` crate.

use super::SceneErrors;
use super::file::SceneFile;
use super::format::format_source;
use super::parse::parse_scene;
use super::ron_options::scene_ron_options;

impl SceneFile {
    /// Reads a scene from the text of a scene file, without reading models or included files.
    ///
    /// # Errors
    /// Returns every mistake in the text, in order.
    pub fn from_ron(text: &str) -> Result<Self, SceneErrors> {
        parse_scene("scene", text)
    }

    /// Returns the text of a scene file that reads back as this scene, formatted like `alberti
    /// scene fmt` output. Fields with default values are omitted.
    ///
    /// ```
    /// use scene_file::SceneFile;
    ///
    /// let scene = SceneFile::from_model_path("duck.glb".to_owned());
    /// assert_eq!(scene.to_ron()?, "Scene(models: [(path: \"duck.glb\")])\n");
    /// assert_eq!(SceneFile::from_ron(&scene.to_ron()?)?, scene);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// Returns an error if the scene contains a number that scene files do not allow, such as NaN
    /// or a scale of 0.
    pub fn to_ron(&self) -> Result<String, ron::Error> {
        let text = format!("Scene{}\n", scene_ron_options().to_string(self)?);
        scene_ron_options().from_str::<Self>(&text).map_err(|error| error.code)?;
        Ok(format_source("scene", &text).unwrap_or(text))
    }
}
