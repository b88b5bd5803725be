//! A folder of files in memory, for models with buffers and images in environments without a file
//! system, such as a browser.

use std::collections::BTreeMap;
use std::sync::Arc;

/// Files in memory, identified by their paths in a common folder.
///
/// Path components are separated by `/`. `.` and `..` are resolved, and no path leads out of the
/// folder.
///
/// ```
/// use import::MemoryFolder;
/// let mut folder = MemoryFolder::default();
/// assert!(folder.insert("models/house.glb", vec![1, 2]));
/// assert_eq!(folder.file("models/../models/house.glb"), Some(&[1, 2][..]));
/// assert!(!folder.insert("../house.glb", Vec::new()));
/// ```
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct MemoryFolder {
    /// The file contents by normalized path, shared by clones of the folder.
    files: BTreeMap<String, Arc<[u8]>>,
}

impl MemoryFolder {
    /// Adds a file, or replaces the file at this path. Returns false and does not add the file if
    /// the path is empty or leads out of the folder.
    pub fn insert(&mut self, path: &str, bytes: Vec<u8>) -> bool {
        let Some(path) = normalize_path("", path).filter(|path| !path.is_empty()) else {
            return false;
        };
        self.files.insert(path, bytes.into());
        true
    }

    /// Removes a file. Returns false if there is no file at this path.
    pub fn remove(&mut self, path: &str) -> bool {
        normalize_path("", path).is_some_and(|path| self.files.remove(&path).is_some())
    }

    /// Returns the content of the file at this path, if it exists.
    #[must_use]
    pub fn file(&self, path: &str) -> Option<&[u8]> {
        self.files.get(&normalize_path("", path)?).map(|bytes| &**bytes)
    }

    /// Returns the paths of all files, in alphabetical order.
    pub fn paths(&self) -> impl Iterator<Item = &str> {
        self.files.keys().map(String::as_str)
    }
}

/// Resolves a path relative to `folder` to a path without `.` and `..`. Returns `None` if it leads
/// above the top folder.
pub(super) fn normalize_path(folder: &str, path: &str) -> Option<String> {
    if path.starts_with(['/', '\\']) || path.contains('\0') {
        return None;
    }
    let mut parts: Vec<&str> = folder.split('/').filter(|part| !part.is_empty()).collect();
    for part in path.split('/') {
        match part {
            "" | "." => {}
            ".." => {
                parts.pop()?;
            }
            part => parts.push(part),
        }
    }
    Some(parts.join("/"))
}

#[cfg(test)]
mod tests {
    use super::normalize_path;

    #[test]
    fn paths_stay_in_the_folder() {
        let path = |folder, path| normalize_path(folder, path);
        assert_eq!(path("models", "../textures/a b.png").as_deref(), Some("textures/a b.png"));
        assert_eq!(path("models", "./x/../y.bin").as_deref(), Some("models/y.bin"));
        assert_eq!(path("models", "../../y.bin"), None);
        assert_eq!(path("", "/etc/passwd"), None);
        assert_eq!(path("", "\\\\server\\share"), None);
    }
}
