//! The text of a scene with its name and folder, and the texts of the files it includes. Errors
//! quote these texts and point into them.

use super::SceneError;
use super::include_map::IncludeMap;
use super::parse::strip_byte_order_mark;
use super::source_text::SourceText;
use super::syntax::PathStep;
use files::visible_path;
use std::path::{Component, Path, PathBuf};

/// The maximum length of a scene file in bytes, more than anyone would write by hand.
const MAX_SCENE_BYTES: u64 = 16 << 20;

/// The text of a scene and of the files it includes, which errors quote.
///
/// ```
/// use scene_file::SceneSource;
///
/// let text = "Scene(models: [(path: \"a.glb\")], style: Flat)";
/// let source = SceneSource::from_text("scene.ron", text, "scenes".into());
/// let (source, file) = source.parse_with_includes(&[])?;
/// assert_eq!((file.models.len(), source.included_texts().count()), (1, 0));
/// # Ok::<(), scene_file::SceneErrors>(())
/// ```
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct SceneSource {
    /// The name for messages.
    pub file: String,
    /// The text; empty for a bare model.
    pub text: SourceText,
    /// The folder that the scene's paths are relative to.
    pub folder: PathBuf,
    /// The map of the parts that are written in included files.
    pub(super) includes: IncludeMap,
    /// The viewport that errors refer to.
    viewport: Option<usize>,
    /// Whether paths must stay below the folder.
    is_confined: bool,
}

/// A scene file that cannot be read.
#[derive(Debug, thiserror::Error)]
#[error("{}", unreadable_message(path, cause))]
pub struct UnreadableScene {
    /// The scene file.
    pub path: PathBuf,
    /// The reason it could not be read.
    pub cause: std::io::Error,
}

/// Returns the message for an unreadable scene file. A missing scene is reported like a missing
/// model.
fn unreadable_message(path: &Path, cause: &std::io::Error) -> String {
    let path = visible_path(path);
    match cause.kind() {
        std::io::ErrorKind::NotFound => format!("{path}: the file does not exist; check the name"),
        std::io::ErrorKind::InvalidData => format!(
            "{path} is not a scene: it is not UTF-8 text\n  = help: check a model with `alberti check`, and draw it with `alberti render`"
        ),
        _ => format!("cannot read {path}: {cause}"),
    }
}

impl SceneSource {
    /// Creates the source of a scene whose text is already in memory and whose files are in the
    /// folder.
    ///
    /// Errors point into the text. For a scene built in Rust, pass the text from
    /// [`SceneFile::to_ron`](super::SceneFile::to_ron), or an empty string; errors then name a
    /// field but not a line.
    #[must_use]
    pub fn from_text(file: impl Into<String>, text: impl Into<String>, folder: PathBuf) -> Self {
        Self {
            file: file.into(),
            text: strip_byte_order_mark(&text.into()).into(),
            folder,
            includes: IncludeMap::default(),
            viewport: None,
            is_confined: true,
        }
    }

    /// Reads the text of a scene file.
    ///
    /// # Errors
    /// Returns an error if the file cannot be read, is not regular, is not UTF-8, or is too long.
    pub fn read(path: &Path) -> Result<Self, UnreadableScene> {
        let folder = path.parent().unwrap_or(Path::new("")).to_owned();
        let text = read_scene_text(path)?;
        Ok(Self::from_text(path.display().to_string(), text, folder))
    }

    /// Returns this source with unrestricted paths, for a folder in memory, because no files exist
    /// outside it.
    #[must_use]
    pub fn unconfined(self) -> Self {
        Self { is_confined: false, ..self }
    }

    /// Returns the texts of the included files, in reading order.
    pub fn included_texts(&self) -> impl Iterator<Item = &str> {
        self.includes.included_texts()
    }

    /// Returns the file names of the scene and its includes, in reading order.
    pub fn included_files(&self) -> impl Iterator<Item = &str> {
        std::iter::once(self.file.as_str()).chain(self.includes.names())
    }

    /// Whether a model of a scene file may be read. Both its path and the target of any symbolic
    /// links must be below the file's folder or an `allowed` folder. A path that leads elsewhere is
    /// rejected without checking whether it exists. A bare model may be anywhere, because the user
    /// named it.
    #[must_use]
    pub fn allows_path(&self, path: &Path, allowed: &[PathBuf]) -> bool {
        // No files exist outside a folder in memory; loading reports missing files.
        if self.text.is_empty() || !self.is_confined {
            return true;
        }
        let here = if self.folder.as_os_str().is_empty() { Path::new(".") } else { &self.folder };
        let Ok(folder) = here.canonicalize() else { return false };
        let wanted = normalize_path(&folder, path);
        let others = allowed.iter().filter_map(|other| other.canonicalize().ok());
        let roots: Vec<PathBuf> = std::iter::once(folder).chain(others).collect();
        let holds = |path: &Path| roots.iter().any(|root| path.starts_with(root));
        // A missing file is harmless; loading reports it.
        holds(&wanted) && wanted.canonicalize().map_or(true, |path| holds(&path))
    }

    /// Returns the source for a viewport. Errors point at the viewport's fields, or at the scene's
    /// fields if the viewport does not set them.
    #[must_use]
    pub fn for_viewport(&self, number: usize) -> Self {
        Self { viewport: Some(number), ..self.clone() }
    }

    /// Returns the path of a scene field within the viewport, if the viewport sets that field.
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

    /// Creates an error that points at the value at the end of `path`.
    #[must_use]
    pub fn error_at(
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

/// Whether a file is a scene, judging by its extension.
///
/// The content is not examined: a `.ron` file that is not a scene gets a scene error, with line and
/// column. Standard input, which has no extension, is recognized by its content instead.
#[must_use]
pub fn is_scene_file(input: &Path) -> bool {
    input.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("ron"))
}

/// Whether a field of the scene also exists in viewports, so that errors in it point there.
fn is_viewport_field(field: &str) -> bool {
    matches!(field, "camera" | "style" | "overlays" | "caption")
}

/// Reads the text of a scene file, without any byte order mark at its start.
///
/// # Errors
/// Returns an error if the file cannot be read, is not regular, is not UTF-8, or is too long.
pub(super) fn read_scene_text(path: &Path) -> Result<String, UnreadableScene> {
    let unreadable = |cause| UnreadableScene { path: path.to_owned(), cause };
    let metadata = std::fs::metadata(path).map_err(unreadable)?;
    if !metadata.is_file() {
        // Reading a pipe may never end.
        return Err(unreadable(std::io::Error::other("it is not a regular file")));
    }
    let length = metadata.len();
    if length > MAX_SCENE_BYTES {
        let why = format!("it has {length} bytes; a scene file may have at most {MAX_SCENE_BYTES}");
        return Err(unreadable(std::io::Error::other(why)));
    }
    let text = std::fs::read_to_string(path).map_err(unreadable)?;
    Ok(text.strip_prefix('\u{feff}').map(ToOwned::to_owned).unwrap_or(text))
}

/// Joins a path to a folder and resolves `.` and `..`.
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
