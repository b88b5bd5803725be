//! Where a scene comes from: a file with text and a folder, or a bare model and the program's
//! flags; and where the files of its models are.

use import::MemoryFolder;
use scene_file::{SceneFile, SceneSource};
use std::ops::Deref;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Where a scene comes from. Errors quote it: it derefs to the [`SceneSource`] with the scene's
/// text.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Origin {
    source: SceneSource,
    /// Where the files of its models are.
    pub(super) models: ModelSource,
}

/// Where the files of models are.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(super) enum ModelSource {
    /// On the disk, from the folder of the scene on.
    Disk,
    /// One file in memory, which is complete in itself.
    Bytes(Arc<[u8]>),
    /// In a folder in memory.
    Memory(MemoryFolder),
}

impl Origin {
    /// Where a scene comes from whose text is at hand; its files lie in the folder.
    ///
    /// Errors point into the text. A scene that is built in Rust has that of
    /// [`SceneFile::to_ron`], or an empty one: then errors name a field without its line.
    #[must_use]
    pub fn from_text(file: impl Into<String>, text: impl Into<String>, folder: PathBuf) -> Self {
        SceneSource::from_text(file, text, folder).into()
    }

    /// Where a scene comes from whose text is at hand, and whose models are in memory: their paths
    /// are those of the folder.
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
        // A folder in memory has no outside; loading tells which files it lacks.
        let source = SceneSource::from_text(file, text, PathBuf::new()).unconfined();
        Self { source, models: ModelSource::Memory(models) }
    }

    /// The origin of a scene that is just one model, with every default.
    #[must_use]
    pub fn from_model_path(path: &Path) -> (Self, SceneFile) {
        let folder = path.parent().unwrap_or(Path::new("")).to_owned();
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let file = path.display().to_string();
        (Self::from_text(file, "", folder), SceneFile::from_model_path(name))
    }

    /// The origin of a scene that is just one model, whose file is in memory and complete in
    /// itself.
    #[must_use]
    pub fn from_model_bytes(name: &str, bytes: Vec<u8>) -> (Self, SceneFile) {
        let source = SceneSource::from_text(name, "", PathBuf::new()).unconfined();
        let origin = Self { source, models: ModelSource::Bytes(bytes.into()) };
        (origin, SceneFile::from_model_path(name.to_owned()))
    }

    /// The source, whose files can be parsed into it.
    pub(super) const fn source_mut(&mut self) -> &mut SceneSource {
        &mut self.source
    }

    /// The origin for a viewport: errors point at the viewport's own fields, and at those of the
    /// scene where it has none.
    pub(super) fn for_viewport(&self, number: usize) -> Self {
        Self { source: self.source.for_viewport(number), models: self.models.clone() }
    }
}

impl From<SceneSource> for Origin {
    /// The models are on the disk.
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
