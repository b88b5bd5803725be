//! The models to render: shared models, the models in a folder, or the scene models.

use crate::skip::report_skip;
use crate::workspace::{list_files, project_root};
use std::path::{Path, PathBuf};

/// The shared models that are rendered by default. They have textures, many triangles, skins, many
/// meshes or large surfaces.
const DEFAULT_NAMES: [&str; 6] =
    ["flight-helmet", "cave", "cesium-man", "many-cubes", "house", "carbon-sphere"];

/// The scene models that are rendered if there are no shared models.
const COMMITTED_NAMES: [&str; 4] = ["teapot", "crate", "floor", "finishes"];

/// A model to render.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub struct BenchModel {
    /// Its name in tables.
    pub name: String,
    /// Its file.
    pub path: PathBuf,
}

/// The requested models.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum ModelSelection {
    /// The default models.
    Default,
    /// All models in a folder and its direct subfolders.
    Folder(PathBuf),
    /// Shared models or scene models, by name.
    Names(Vec<String>),
}

impl ModelSelection {
    /// Parses the words after `--models`. A single word that names a folder selects its contents;
    /// any other words are model names.
    pub fn parse_words(words: Vec<String>) -> Self {
        match words.as_slice() {
            [] => Self::Default,
            [word] if Path::new(word).is_dir() => Self::Folder(word.into()),
            _ => Self::Names(words),
        }
    }

    /// Returns the models. Missing default models are reported on standard output.
    pub fn list_models(&self) -> Result<Vec<BenchModel>, String> {
        match self {
            Self::Default => default_models(&shared_folder()),
            Self::Folder(folder) => {
                // The program runs in the workspace root, not in the folder in which xtask was
                // started.
                let folder = std::fs::canonicalize(folder)
                    .map_err(|error| format!("{}: {error}", folder.display()))?;
                models_below(&folder)
            }
            Self::Names(names) => {
                names.iter().map(|name| named_model(&shared_folder(), name)).collect()
            }
        }
    }
}

/// Returns the folder `models` in the folder that the variable `ASSETS` names or, by default, in
/// `../shared/assets`.
fn shared_folder() -> PathBuf {
    let assets = std::env::var_os("ASSETS").unwrap_or_else(|| "../shared/assets".into());
    project_root().join(assets).join("models")
}

fn default_models(shared: &Path) -> Result<Vec<BenchModel>, String> {
    let mut models = Vec::new();
    for name in DEFAULT_NAMES {
        match shared_model(shared, name) {
            Some(model) => models.push(model),
            None => report_skip(name, &format!("no model in {}", shared.join(name).display())),
        }
    }
    if models.is_empty() {
        println!("Rendering scene models instead: {}", COMMITTED_NAMES.join(", "));
        return COMMITTED_NAMES.into_iter().map(|name| named_model(shared, name)).collect();
    }
    Ok(models)
}

fn named_model(shared: &Path, name: &str) -> Result<BenchModel, String> {
    let committed = project_root().join("scenes/models").join(format!("{name}.glb"));
    let committed = || {
        let path = committed.is_file().then_some(committed)?;
        Some(BenchModel { name: name.to_owned(), path })
    };
    shared_model(shared, name)
        .or_else(committed)
        .ok_or_else(|| format!("no model `{name}` in {} or scenes/models", shared.display()))
}

/// Returns the first model in the subfolder of the shared folder with this name.
fn shared_model(shared: &Path, name: &str) -> Option<BenchModel> {
    let path = models_in(&shared.join(name)).ok()?.into_iter().next()?;
    Some(BenchModel { name: name.to_owned(), path })
}

/// Returns the models in a folder and its direct subfolders, sorted by name.
fn models_below(folder: &Path) -> Result<Vec<BenchModel>, String> {
    let mut paths = models_in(folder)?;
    let entries = std::fs::read_dir(folder).map_err(|e| format!("{}: {e}", folder.display()))?;
    for inner in entries.flatten().map(|entry| entry.path()).filter(|path| path.is_dir()) {
        paths.extend(models_in(&inner)?);
    }
    let named = |path: PathBuf| {
        let name = path.strip_prefix(folder).unwrap_or(&path);
        let name = name.to_string_lossy().replace('\\', "/");
        BenchModel { name, path }
    };
    let mut models: Vec<BenchModel> = paths.into_iter().map(named).collect();
    models.sort();
    if models.is_empty() {
        return Err(format!("{}: it contains no .glb or .gltf file", folder.display()));
    }
    Ok(models)
}

fn models_in(folder: &Path) -> Result<Vec<PathBuf>, String> {
    Ok([list_files(folder, "gltf")?, list_files(folder, "glb")?].concat())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn committed_models_replace_missing_shared_models() {
        let models = default_models(Path::new("/no/such/folder")).unwrap();
        assert_eq!(models.len(), COMMITTED_NAMES.len());
        assert!(models.iter().all(|model| model.path.is_file()));
    }

    #[test]
    fn folders_are_searched_and_unknown_names_are_errors() {
        let models = models_below(&project_root().join("scenes")).unwrap();
        assert!(models.iter().any(|model| model.name == "models/teapot.glb"), "{models:?}");
        let error = named_model(Path::new("/no/such/folder"), "unicorn").unwrap_err();
        assert!(error.contains("`unicorn`"), "{error}");
        assert!(models_below(&project_root().join("crates/clip")).unwrap_err().contains("no .glb"));
    }

    #[test]
    fn a_single_folder_is_not_a_model_name() {
        let folder = project_root().join("scenes").to_string_lossy().into_owned();
        assert_eq!(
            ModelSelection::parse_words(vec![folder.clone()]),
            ModelSelection::Folder(folder.into())
        );
        assert_eq!(
            ModelSelection::parse_words(vec!["teapot".into()]),
            ModelSelection::Names(vec!["teapot".into()])
        );
    }
}
