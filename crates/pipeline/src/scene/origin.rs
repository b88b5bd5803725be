//! Where a scene comes from: a file with text and a folder, or a bare model and the program's flags.

use super::locate::{Step, locate};
use super::{ResolveError, SceneError, SceneFile, parse};
use std::path::{Component, Path, PathBuf};

/// The longest scene file that is read, in bytes: more is no text that a person wrote.
const LONGEST_SCENE: u64 = 16 << 20;

/// Where a scene comes from. Errors quote it.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Origin {
    /// The name in messages.
    pub file: String,
    /// The text; empty for a bare model.
    pub text: String,
    /// The folder that paths of the scene begin at.
    pub folder: PathBuf,
}

impl Origin {
    /// Reads and parses a scene file.
    ///
    /// # Errors
    /// If it cannot be read, is not UTF-8, is too long, or is no scene.
    pub fn read(path: &Path) -> Result<(Self, SceneFile), ResolveError> {
        let unreadable = |cause| ResolveError::Unreadable { path: path.to_owned(), cause };
        let length = std::fs::metadata(path).map_err(unreadable)?.len();
        if length > LONGEST_SCENE {
            let why = format!("it has {length} bytes; a scene file has {LONGEST_SCENE} at most");
            return Err(unreadable(std::io::Error::other(why)));
        }
        let text = std::fs::read_to_string(path).map_err(unreadable)?;
        let file = path.display().to_string();
        let scene = parse(&file, &text)?;
        let folder = path.parent().unwrap_or(Path::new("")).to_owned();
        let text = text.strip_prefix('\u{feff}').map(ToOwned::to_owned).unwrap_or(text);
        Ok((Self { file, text, folder }, scene))
    }

    /// The origin of a scene that is just one model, with every default.
    #[must_use]
    pub fn bare_model(path: &Path) -> (Self, SceneFile) {
        let folder = path.parent().unwrap_or(Path::new("")).to_owned();
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let file = path.display().to_string();
        (Self { file, text: String::new(), folder }, SceneFile::showing(name))
    }

    /// Whether a model of a scene file may be read: it must be below the file's folder, or below one of those that are
    /// `allowed`, by its path and by where symbolic links lead. A path that leads elsewhere is refused without looking whether
    /// something is there. A bare model may be anywhere: a person has named it.
    #[must_use]
    pub fn may_read(&self, path: &Path, allowed: &[PathBuf]) -> bool {
        if self.text.is_empty() {
            return true;
        }
        let here = if self.folder.as_os_str().is_empty() { Path::new(".") } else { &self.folder };
        let Ok(folder) = here.canonicalize() else { return false };
        let wanted = plain(&folder, path);
        let others = allowed.iter().filter_map(|other| other.canonicalize().ok());
        let roots: Vec<PathBuf> = std::iter::once(folder).chain(others).collect();
        let holds = |path: &Path| roots.iter().any(|root| path.starts_with(root));
        // What does not exist does no harm; loading will tell.
        holds(&wanted) && wanted.canonicalize().map_or(true, |path| holds(&path))
    }

    /// An error that points at the value at the end of `path`.
    pub(super) fn fault(
        &self,
        path: &[Step<'_>],
        message: impl Into<String>,
        help: Option<String>,
    ) -> SceneError {
        SceneError {
            file: self.file.clone(),
            span: locate(&self.text, path),
            source: self.text.clone(),
            message: message.into(),
            help,
        }
    }
}

/// A path from a folder on, without `.` and `..`.
fn plain(folder: &Path, path: &Path) -> PathBuf {
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
