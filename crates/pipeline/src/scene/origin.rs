//! Where a scene comes from: a file with text and a folder, or a bare model and the program's
//! flags.

use super::diagnostics::with_errors_of_description;
use super::include::{GatheredScene, IncludeMap, gather_includes};
use super::insets::is_viewport_field;
use super::parse::strip_byte_order_mark;
use super::source_text::SourceText;
use super::syntax::PathStep;
use super::{ResolveError, SceneError, SceneErrors, SceneFile};
use import::MemoryFolder;
use std::path::{Component, Path, PathBuf};
use std::sync::Arc;

/// The longest scene file that is read, in bytes: more is no text that a person wrote.
const MAX_SCENE_BYTES: u64 = 16 << 20;

/// Where a scene comes from. Errors quote it.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Origin {
    /// The name in messages.
    pub file: String,
    /// The text; empty for a bare model.
    pub text: SourceText,
    /// The folder that paths of the scene begin at.
    pub folder: PathBuf,
    /// Which parts are written in files that it includes.
    includes: IncludeMap,
    /// The viewport that is spoken of.
    viewport: Option<usize>,
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
        Self {
            file: file.into(),
            text: strip_byte_order_mark(&text.into()).into(),
            folder,
            includes: IncludeMap::default(),
            viewport: None,
            models: ModelSource::Disk,
        }
    }

    /// Where a scene comes from whose text is at hand, and whose models are in memory: their paths
    /// are those of the folder.
    ///
    /// ```
    /// use pipeline::{Origin, Scene, import::MemoryFolder, scene::parse_scene};
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
        let models = ModelSource::Memory(models);
        Self { models, ..Self::from_text(file, text, PathBuf::new()) }
    }

    /// Reads and parses a scene file and those it includes, which must lie below its folder. The
    /// scene that is returned has what they include, and includes nothing itself.
    ///
    /// # Errors
    /// If one cannot be read, is not UTF-8, is too long, or if files include each other; and every
    /// mistake in their texts.
    pub fn read_scene(path: &Path) -> Result<(Self, SceneFile), ResolveError> {
        Self::read_scene_allowing(path, &[])
    }

    /// Reads and parses a scene file and those it includes, which must lie below its folder or one
    /// that is `allowed`.
    ///
    /// # Errors
    /// As [`read_scene`](Self::read_scene).
    pub fn read_scene_allowing(
        path: &Path,
        allowed: &[PathBuf],
    ) -> Result<(Self, SceneFile), ResolveError> {
        let folder = path.parent().unwrap_or(Path::new("")).to_owned();
        let text = read_scene_text(path)?;
        Self::from_text(path.display().to_string(), text, folder).parse_with_includes(allowed)
    }

    /// Parses a scene's text and the files it includes, which must lie below its folder or one that
    /// is `allowed`.
    ///
    /// If there are mistakes in the texts, what could be read is resolved as far as that is
    /// possible without the models, so that all mistakes come at once.
    ///
    /// # Errors
    /// As [`read_scene`](Self::read_scene).
    pub fn parse_with_includes(
        mut self,
        allowed: &[PathBuf],
    ) -> Result<(Self, SceneFile), ResolveError> {
        let GatheredScene { file, includes, mistakes } = gather_includes(&self, allowed);
        self.includes = includes;
        if mistakes.is_empty() {
            return Ok((self, file));
        }
        let errors = with_errors_of_description(&self, &file, mistakes, allowed);
        match SceneErrors::from_list(errors) {
            Some(errors) => Err(ResolveError::Scene(errors)),
            None => Ok((self, file)),
        }
    }

    /// The texts of the files that are included, in the order in which they were read.
    pub fn included_texts(&self) -> impl Iterator<Item = &str> {
        self.includes.included_texts()
    }

    /// The names of the scene file and of the files it includes, in the order in which they were
    /// read.
    pub(super) fn included_files(&self) -> impl Iterator<Item = &str> {
        std::iter::once(self.file.as_str()).chain(self.includes.names())
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
        let models = ModelSource::Bytes(bytes.into());
        let origin = Self { models, ..Self::from_text(name, "", PathBuf::new()) };
        (origin, SceneFile::from_model_path(name.to_owned()))
    }

    /// Whether a model of a scene file may be read: it must be below the file's folder, or below
    /// one of those that are `allowed`, by its path and by where symbolic links lead. A path that
    /// leads elsewhere is refused without looking whether something is there. A bare model may be
    /// anywhere: a person has named it.
    #[must_use]
    pub fn allows_path(&self, path: &Path, allowed: &[PathBuf]) -> bool {
        // A folder in memory has no outside; loading tells which files it lacks.
        if self.text.is_empty() || self.models != ModelSource::Disk {
            return true;
        }
        let here = if self.folder.as_os_str().is_empty() { Path::new(".") } else { &self.folder };
        let Ok(folder) = here.canonicalize() else { return false };
        let wanted = normalize_path(&folder, path);
        let others = allowed.iter().filter_map(|other| other.canonicalize().ok());
        let roots: Vec<PathBuf> = std::iter::once(folder).chain(others).collect();
        let holds = |path: &Path| roots.iter().any(|root| path.starts_with(root));
        // What does not exist does no harm; loading will tell.
        holds(&wanted) && wanted.canonicalize().map_or(true, |path| holds(&path))
    }

    /// The origin for a viewport: errors point at the viewport's own fields, and at those of the
    /// scene where it has none.
    pub(super) fn for_viewport(&self, number: usize) -> Self {
        Self { viewport: Some(number), ..self.clone() }
    }

    /// The path of a field of the scene as a viewport has it, if it says that field.
    fn viewport_field_path<'a>(
        &self,
        number: usize,
        path: &[PathStep<'a>],
    ) -> Option<Vec<PathStep<'a>>> {
        let (field, rest) = match *path {
            [PathStep::Field("image"), PathStep::Field("background"), ref rest @ ..] => {
                ("background", rest)
            }
            [PathStep::Field(field), ref rest @ ..] if is_viewport_field(field) => (field, rest),
            _ => return None,
        };
        let own = [PathStep::Field("viewports"), PathStep::Index(number), PathStep::Field(field)];
        let (source, there) = self.includes.resolve_source(&own);
        let text = source.map_or(&self.text, |(_, text)| text);
        text.has_value(&there).then(|| [&own, rest].concat())
    }

    /// An error that points at the value at the end of `path`.
    pub(super) fn error_at(
        &self,
        path: &[PathStep<'_>],
        message: impl Into<String>,
        help: Option<String>,
    ) -> SceneError {
        let inner = self.viewport.and_then(|number| self.viewport_field_path(number, path));
        let (source, path) = self.includes.resolve_source(inner.as_deref().unwrap_or(path));
        let (file, text) = source.unwrap_or((&self.file, &self.text));
        SceneError {
            file: file.to_owned(),
            span: text.span_of(&path),
            source: text.clone(),
            message: message.into(),
            help,
        }
    }
}

/// The text of a scene file, without the byte order mark that it may begin with.
///
/// # Errors
/// If it cannot be read, is no regular file, is not UTF-8, or is too long.
pub(super) fn read_scene_text(path: &Path) -> Result<String, ResolveError> {
    let unreadable = |cause| ResolveError::Unreadable { path: path.to_owned(), cause };
    let metadata = std::fs::metadata(path).map_err(unreadable)?;
    if !metadata.is_file() {
        // A pipe may never end.
        return Err(unreadable(std::io::Error::other("it is not a regular file")));
    }
    let length = metadata.len();
    if length > MAX_SCENE_BYTES {
        let why = format!("it has {length} bytes; a scene file has {MAX_SCENE_BYTES} at most");
        return Err(unreadable(std::io::Error::other(why)));
    }
    let text = std::fs::read_to_string(path).map_err(unreadable)?;
    Ok(text.strip_prefix('\u{feff}').map(ToOwned::to_owned).unwrap_or(text))
}

/// A path from a folder on, without `.` and `..`.
pub(super) fn normalize_path(folder: &Path, path: &Path) -> PathBuf {
    let mut plain = folder.to_owned();
    for part in path.components() {
        match part {
            Component::CurDir => {}
            Component::ParentDir => {
                plain.pop();
            }
            part => plain.push(part),
        }
    }
    plain
}
