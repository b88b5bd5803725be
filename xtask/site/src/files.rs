//! File and folder operations whose error messages name the path, and operations on repository
//! paths.

use crate::Outcome;
use std::fs;
use std::path::Path;

/// The file that marks a folder as written by this program.
const MARK: &str = ".alberti-site";

/// Empties a folder. Fails if it contains files that this program did not write.
pub fn empty_folder(folder: &Path) -> Outcome {
    let named = |error: std::io::Error| format!("{}: {error}", folder.display());
    if folder.exists() {
        let is_ours = folder.join(MARK).exists();
        let is_empty = fs::read_dir(folder).map_err(named)?.next().is_none();
        if !is_ours && !is_empty {
            return Err(format!("{} contains other files: use an empty folder", folder.display()));
        }
        fs::remove_dir_all(folder).map_err(named)?;
    }
    fs::create_dir_all(folder).map_err(named)?;
    write(&folder.join(MARK), b"")
}

/// Writes a file and creates its parent folders.
pub fn write(path: &Path, bytes: &[u8]) -> Outcome {
    let named = |error: std::io::Error| format!("{}: {error}", path.display());
    if let Some(folder) = path.parent() {
        fs::create_dir_all(folder).map_err(named)?;
    }
    fs::write(path, bytes).map_err(named)
}

/// Copies a file and creates the parent folders of the copy.
pub fn copy(from: &Path, to: &Path) -> Outcome {
    write(to, &fs::read(from).map_err(|error| format!("{}: {error}", from.display()))?)
}

/// Reads the text of a file.
pub fn read_text(path: &Path) -> Result<String, String> {
    fs::read_to_string(path).map_err(|error| format!("{}: {error}", path.display()))
}

/// Returns the names in a folder, sorted.
pub fn names_in(folder: &Path) -> Result<Vec<String>, String> {
    let entries = fs::read_dir(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    let mut names: Vec<String> =
        entries.filter_map(|entry| entry.ok()?.file_name().into_string().ok()).collect();
    names.sort();
    Ok(names)
}

/// Returns the folder of a repository path: `docs` for `docs/faq.md`, an empty string for
/// `README.md`.
pub fn folder_of(path: &str) -> &str {
    path.rsplit_once('/').map_or("", |(folder, _)| folder)
}

/// Resolves a relative path from a folder of the repository, removing `.` and `..`. Returns `None`
/// if the path leaves the repository.
pub fn join(folder: &str, relative: &str) -> Option<String> {
    let mut parts: Vec<&str> = folder.split('/').filter(|part| !part.is_empty()).collect();
    for part in relative.split('/') {
        match part {
            "" | "." => {}
            ".." => drop(parts.pop()?),
            name => parts.push(name),
        }
    }
    Some(parts.join("/"))
}

/// Returns the relative path from a page to another file of the site.
pub fn relative(from: &str, to: &str) -> String {
    let above: Vec<&str> = folder_of(from).split('/').filter(|part| !part.is_empty()).collect();
    let target: Vec<&str> = to.split('/').collect();
    let common = above.iter().zip(&target[..target.len() - 1]).take_while(|(a, b)| a == b).count();
    "../".repeat(above.len() - common) + &target[common..].join("/")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn relative_paths_lead_from_page_to_page() {
        let table = [
            ("index.html", "style.css", "style.css"),
            ("docs/faq.html", "style.css", "../style.css"),
            ("docs/guide/print.html", "docs/faq.html", "../faq.html"),
            ("gallery/index.html", "gallery/house.png", "house.png"),
            ("crates/clip/README.html", "crates/homog/README.html", "../homog/README.html"),
        ];
        for (from, to, way) in table {
            assert_eq!(relative(from, to), way, "{from} to {to}");
        }
    }

    #[test]
    fn paths_may_not_leave_the_repository() {
        assert_eq!(join("docs/guide", "../faq.md").as_deref(), Some("docs/faq.md"));
        assert_eq!(join("docs", "./exercises/").as_deref(), Some("docs/exercises"));
        assert_eq!(join("", "../other"), None);
    }
}
