//! Collects the files that a model or a scene refers to, so that they can all be sent to a browser.
//!
//! The importer checks whether the files are used correctly. A name that points outside the model's
//! folder, even through a symbolic link, is skipped.

use crate::CliError;
use files::visible_path;
use import::Limits;
use scene::referenced_files;
use scene_file::{is_scene_file, parse_scene};
use std::collections::BTreeMap;
use std::fs::File;
use std::io::{Error, ErrorKind, Read};
use std::path::{Component, Path};

/// A model or a scene and the files it refers to, by path relative to its folder.
#[derive(Debug, Default)]
pub(super) struct ModelFiles {
    /// The name of the model or scene.
    pub(super) name: String,
    /// All files, including the model or scene itself.
    pub(super) files: BTreeMap<String, Vec<u8>>,
}

impl ModelFiles {
    /// Reads a model or a scene and the existing files it refers to.
    ///
    /// # Errors
    /// Returns an error if the model cannot be read, or the files exceed their total size limit.
    pub(super) fn read(path: &Path) -> Result<Self, CliError> {
        let cannot_read =
            |error: Error| CliError::Usage(format!("cannot read {}: {error}", visible_path(path)));
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let bytes = read_file(path).map_err(cannot_read)?;
        let parent = path.parent().filter(|parent| !parent.as_os_str().is_empty());
        let folder = parent.unwrap_or(Path::new(".")).canonicalize().map_err(cannot_read)?;
        let mut wanted = files_of(&name, &bytes);
        let mut files = BTreeMap::from([(name.clone(), bytes)]);
        while let Some(wanted_name) = wanted.pop() {
            if files.contains_key(&wanted_name) {
                continue;
            }
            if let Some(bytes) = read_below(&folder, &wanted_name) {
                wanted.extend(files_of(&wanted_name, &bytes));
                files.insert(wanted_name, bytes);
            }
            let total: usize = files.values().map(Vec::len).sum();
            if total as u64 > Limits::default().total_bytes {
                return Err(cannot_read(too_large("its files total", total as u64)));
            }
        }
        Ok(Self { name, files })
    }
}

/// Returns the files that a scene, a model or a material library refers to.
fn files_of(name: &str, bytes: &[u8]) -> Vec<String> {
    if !is_scene_file(Path::new(name)) {
        return referenced_files(name, bytes);
    }
    // Mistakes in the scene are reported when it is shown.
    let scene = parse_scene(name, &String::from_utf8_lossy(bytes)).unwrap_or_default();
    let images = scene.image_paths().map(str::to_owned).collect::<Vec<_>>();
    scene.models.into_iter().map(|model| model.path).chain(images).collect()
}

/// Returns the content of a file below a folder, if it exists.
fn read_below(folder: &Path, name: &str) -> Option<Vec<u8>> {
    let is_plain = |part| matches!(part, Component::Normal(_) | Component::CurDir);
    if !Path::new(name).components().all(is_plain) {
        return None;
    }
    let path = folder.join(name).canonicalize().ok()?;
    if path.starts_with(folder) { read_file(&path).ok() } else { None }
}

/// Returns the content of a regular file that is not too large.
fn read_file(path: &Path) -> Result<Vec<u8>, Error> {
    let metadata = path.metadata()?;
    let limit = Limits::default().file_bytes;
    if !metadata.is_file() {
        return Err(Error::new(ErrorKind::InvalidInput, "it is not a regular file"));
    }
    let mut bytes = Vec::new();
    File::open(path)?.take(limit + 1).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > limit { Err(too_large("it is", metadata.len())) } else { Ok(bytes) }
}

fn too_large(what: &str, bytes: u64) -> Error {
    Error::new(ErrorKind::InvalidData, format!("{what} {} MiB, more than allowed", bytes >> 20))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_outside_the_folder_are_not_read() {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("src").canonicalize().expect("it");
        assert!(read_below(&folder, "./main.rs").is_some());
        for name in ["../Cargo.toml", "explore/../../Cargo.toml", "/etc/hosts", "explore", "none"] {
            assert!(read_below(&folder, name).is_none(), "{name}");
        }
    }
}
