//! The origin of a scene: a file with text and a folder, or a bare model and the program's flags.
//! It includes the location of the model files.

use import::MemoryFolder;
use scene_file::{SceneFile, SceneSource};
use std::ops::Deref;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// The origin of a scene, which errors quote. It dereferences to the [`SceneSource`] with the
/// scene's text.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Origin {
    source: SceneSource,
    /// The location of the scene's model files.
    pub(super) models: ModelSource,
}

/// The location of model files.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(super) enum ModelSource {
    /// On disk, relative to the scene's folder.
    Disk,
    /// A single self-contained file in memory.
    Bytes(Arc<[u8]>),
    /// In a folder in memory.
    Memory(MemoryFolder),
}

impl Origin {
    /// Creates the origin of a scene whose text is already in memory and whose files are in the
    /// folder.
    ///
    /// Errors point into the text. For a scene built in Rust, pass the text from
    /// [`SceneFile::to_ron`], or an empty string; errors then name a field but not a line.
    #[must_use]
    pub fn from_text(file: impl Into<String>, text: impl Into<String>, folder: PathBuf) -> Self {
        SceneSource::from_text(file, text, folder).into()
    }

    /// Creates the origin of a scene whose text and models are in memory; paths refer to files in
    /// that folder.
    ///
    /// ```
    /// use import::MemoryFolder;
    /// use scene::{Origin, Scene};
    /// use scene_file::parse_scene;
    /// let mut folder = MemoryFolder::default();
    /// folder.insert("triangle.obj", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n".to_vec());
    /// let text = "Scene(models: [Model(path: \"triangle.obj\")])";
    /// let file = parse_scene("scene.ron", text)?;
    /// let origin = Origin::from_text_in_memory("scene.ron", text, folder);
    /// let scene = Scene::resolve(&origin, &file, &Default::default())?;
    /// assert_eq!(scene.world_points().len(), 3);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn from_text_in_memory(
        file: impl Into<String>,
        text: impl Into<String>,
        models: MemoryFolder,
    ) -> Self {
        // A folder in memory has nothing outside it; loading reports missing files.
        let source = SceneSource::from_text(file, text, PathBuf::new()).unconfined();
        Self { source, models: ModelSource::Memory(models) }
    }

    /// Creates the origin of a scene that is just one model, with all defaults.
    #[must_use]
    pub fn from_model_path(path: &Path) -> (Self, SceneFile) {
        let folder = path.parent().unwrap_or(Path::new("")).to_owned();
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let file = path.display().to_string();
        (Self::from_text(file, "", folder), SceneFile::from_model_path(name))
    }

    /// Creates the origin of a scene that is just one model, in a self-contained file in memory.
    #[must_use]
    pub fn from_model_bytes(name: &str, bytes: Vec<u8>) -> (Self, SceneFile) {
        let source = SceneSource::from_text(name, "", PathBuf::new()).unconfined();
        let origin = Self { source, models: ModelSource::Bytes(bytes.into()) };
        (origin, SceneFile::from_model_path(name.to_owned()))
    }

    /// Returns the source for parsing, which adds the included files to it.
    pub(super) const fn source_mut(&mut self) -> &mut SceneSource {
        &mut self.source
    }

    /// Returns the origin for a viewport. Errors point at the viewport's own fields, or at the
    /// scene's if the viewport does not set them.
    pub(super) fn for_viewport(&self, number: usize) -> Self {
        Self { source: self.source.for_viewport(number), models: self.models.clone() }
    }
}

impl From<SceneSource> for Origin {
    /// Creates an origin with models on disk.
    fn from(source: SceneSource) -> Self {
        Self { source, models: ModelSource::Disk }
    }
}

impl Deref for Origin {
    type Target = SceneSource;

    #[inline]
    fn deref(&self) -> &SceneSource {
        &self.source
    }
}
