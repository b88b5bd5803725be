//! Files in the workspace: the root, the scenes, and helpers whose error messages name the file.

use std::fs;
use std::path::{Path, PathBuf};

/// Returns the folder of the workspace's `Cargo.toml`. It is known at compile time, so commands
/// work from any folder.
pub fn project_root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap_or(Path::new("."))
}

/// Returns the target folder that Cargo uses in the workspace root.
pub fn target_folder() -> PathBuf {
    project_root().join(std::env::var_os("CARGO_TARGET_DIR").unwrap_or_else(|| "target".into()))
}

/// A scene file.
pub struct Scene {
    /// The file name without `.ron`, which goldens and commands use.
    pub name: String,
    /// The absolute path.
    pub path: PathBuf,
}

impl Scene {
    /// Returns the comment at the beginning of the file, which describes the picture.
    pub fn scene_caption(&self) -> Result<String, String> {
        Ok(caption(&read_text(&self.path)?))
    }

    /// Returns the path of the golden image.
    pub fn golden_path(&self) -> PathBuf {
        project_root().join("tests/goldens").join(format!("{}.png", self.name))
    }
}

fn caption(source: &str) -> String {
    let lines = source.lines().map_while(|line| line.trim().strip_prefix("//"));
    lines.map(str::trim).collect::<Vec<_>>().join(" ")
}

/// Returns all scenes in `scenes/*.ron`, sorted by name.
pub fn list_scenes() -> Result<Vec<Scene>, String> {
    let mut scenes: Vec<Scene> =
        list_files(&project_root().join("scenes"), "ron")?.into_iter().filter_map(scene).collect();
    scenes.sort_by(|a, b| a.name.cmp(&b.name));
    Ok(scenes)
}

fn scene(path: PathBuf) -> Option<Scene> {
    let name = path.file_stem()?.to_str()?.to_owned();
    Some(Scene { name, path })
}

/// Returns the files directly in `folder` whose names end in `.extension`, sorted.
pub fn list_files(folder: &Path, extension: &str) -> Result<Vec<PathBuf>, String> {
    let entries = fs::read_dir(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    let mut paths: Vec<PathBuf> = entries
        .filter_map(|entry| Some(entry.ok()?.path()))
        .filter(|path| path.is_file() && path.extension().is_some_and(|actual| actual == extension))
        .collect();
    paths.sort();
    Ok(paths)
}

/// Reads the text of a file. The error message names the file.
pub fn read_text(path: &Path) -> Result<String, String> {
    fs::read_to_string(path).map_err(|error| format!("{}: {error}", path.display()))
}

/// Creates a folder and its parents.
pub fn create_folder(path: &Path) -> Result<(), String> {
    fs::create_dir_all(path).map_err(|error| format!("{}: {error}", path.display()))
}

/// Returns the path relative to the workspace root, with forward slashes, for messages.
pub fn relative_path(path: &Path) -> String {
    path.strip_prefix(project_root()).unwrap_or(path).to_string_lossy().replace('\\', "/")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_caption_is_only_the_leading_comment() {
        let source = "// A teapot.\n// It pours.\nScene(\n    // not this\n)";
        assert_eq!(caption(source), "A teapot. It pours.");
        assert_eq!(caption("Scene()"), "");
    }

    #[test]
    fn the_root_contains_the_workspace_manifest() {
        assert!(read_text(&project_root().join("Cargo.toml")).unwrap().contains("[workspace]"));
    }
}
