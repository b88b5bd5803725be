//! Where things are: the root of the workspace, its scenes, its files.

use std::fs;
use std::path::{Path, PathBuf};

/// The folder of the workspace's `Cargo.toml`. Known from this file's own place, so commands work
/// from any folder.
pub fn project_root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap_or(Path::new("."))
}

/// The folder that Cargo builds into when it is run at the root.
pub fn target_folder() -> PathBuf {
    project_root().join(std::env::var_os("CARGO_TARGET_DIR").unwrap_or_else(|| "target".into()))
}

/// A scene file and the name by which goldens and commands know it: its file name without `.ron`.
pub struct Scene {
    pub name: String,
    pub path: PathBuf,
}

impl Scene {
    /// The comment that opens the file: what the picture shows and why.
    pub fn scene_caption(&self) -> Result<String, String> {
        Ok(caption(&read_text(&self.path)?))
    }

    /// Where the golden image of this scene is kept.
    pub fn golden_path(&self) -> PathBuf {
        project_root().join("tests/goldens").join(format!("{}.png", self.name))
    }
}

fn caption(source: &str) -> String {
    let lines = source.lines().map_while(|line| line.trim().strip_prefix("//"));
    lines.map(str::trim).collect::<Vec<_>>().join(" ")
}

/// All of `scenes/*.ron`, by name.
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

/// The files directly in `folder` whose names end in `.extension`, sorted.
pub fn list_files(folder: &Path, extension: &str) -> Result<Vec<PathBuf>, String> {
    let entries = fs::read_dir(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    let mut paths: Vec<PathBuf> = entries
        .filter_map(|entry| Some(entry.ok()?.path()))
        .filter(|path| path.is_file() && path.extension().is_some_and(|found| found == extension))
        .collect();
    paths.sort();
    Ok(paths)
}

/// The text of a file, or a sentence that names it.
pub fn read_text(path: &Path) -> Result<String, String> {
    fs::read_to_string(path).map_err(|error| format!("{}: {error}", path.display()))
}

/// Makes a folder and those above it.
pub fn create_folder(path: &Path) -> Result<(), String> {
    fs::create_dir_all(path).map_err(|error| format!("{}: {error}", path.display()))
}

/// `path` as seen from the root, with forward slashes: how rules and messages name files.
pub fn relative_path(path: &Path) -> String {
    path.strip_prefix(project_root()).unwrap_or(path).to_string_lossy().replace('\\', "/")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_caption_is_the_leading_comment_only() {
        let source = "// A teapot.\n// It pours.\nScene(\n    // not this\n)";
        assert_eq!(caption(source), "A teapot. It pours.");
        assert_eq!(caption("Scene()"), "");
    }

    #[test]
    fn the_root_is_where_the_workspace_is_declared() {
        assert!(read_text(&project_root().join("Cargo.toml")).unwrap().contains("[workspace]"));
    }
}
