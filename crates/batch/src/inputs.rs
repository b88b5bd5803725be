//! The inputs of a batch: files, folders and lists of names, with a unique picture name for each.

use super::job::{BatchJob, JobGroup};
use super::picture_name::{NameSource, PictureName, normal_parts};
use crate::BatchError;
use files::visible_path;
use import::FileFormat;
use std::collections::{BTreeMap, BTreeSet, VecDeque};
use std::io::Read as _;
use std::path::{Path, PathBuf};

/// The maximum depth of the folder search. No real folder is that deep.
const MAX_DEPTH: usize = 64;

/// Finds and sorts the jobs of all inputs, so that every shard sees the same order.
///
/// A file that is found twice under the same path and name is one job. Files named directly are
/// accepted with any extension; the importer then reports those it cannot read.
///
/// # Errors
/// Returns an error if a folder or a list cannot be read. A listed file that does not exist is not
/// an error here: its job fails, and the others run.
pub(super) fn find_jobs(
    inputs: &[PathBuf],
    scene: Option<&Path>,
    picture_name: Option<&PictureName>,
) -> Result<Vec<JobGroup>, BatchError> {
    let mut found = Vec::new();
    for input in inputs {
        if input.as_os_str() == "-" {
            let mut list = String::new();
            std::io::stdin()
                .read_to_string(&mut list)
                .map_err(|cause| read_error(input, &cause))?;
            add_listed(&list, Path::new(""), &mut found);
        } else if input.is_dir() {
            FolderSearch::new(input).run(&mut found)?;
        } else if lowercase_extension(input).as_deref() == Some("txt") {
            let list = std::fs::read_to_string(input).map_err(|cause| read_error(input, &cause))?;
            add_listed(&list, input.parent().unwrap_or(Path::new("")), &mut found);
        } else {
            let name = PathBuf::from(input.file_name().unwrap_or_default());
            found.push((input.clone(), name));
        }
    }
    found.sort();
    found.dedup();
    let named = match picture_name {
        Some(template) => name_by_template(found, template)?,
        None => name_outputs(found),
    };
    let group = |(input, output): (PathBuf, String)| {
        let scene = scene.map(Path::to_owned);
        let fault = unreadable_name(&input);
        let job = BatchJob { input, output, scene, flags: Vec::new(), line: None, fault };
        JobGroup { jobs: vec![job], bytes: None }
    };
    Ok(named.into_iter().map(group).collect())
}

/// Returns the error for a file name that is not UTF-8: reports and workers could not name it.
pub(super) fn unreadable_name(input: &Path) -> Option<String> {
    let fault = || "the name is not UTF-8\n  = help: rename the file".to_owned();
    input.to_str().is_none().then(fault)
}

/// Returns the error for an input that cannot be read.
fn read_error(path: &Path, cause: &std::io::Error) -> BatchError {
    BatchError::Unusable(format!("cannot read {}: {cause}", visible_path(path)))
}

/// Returns the extension of a path in lower case.
fn lowercase_extension(path: &Path) -> Option<String> {
    Some(path.extension()?.to_string_lossy().to_lowercase())
}

/// Adds the files in a list, relative to its folder. Empty lines and `#` comments are skipped.
///
/// Each pair in `found` holds the path to read and the name below the output folder. A line is a
/// literal path, without quotes or escapes; spaces at both ends are removed.
fn add_listed(list: &str, folder: &Path, found: &mut Vec<(PathBuf, PathBuf)>) {
    let lines =
        list.lines().map(str::trim).filter(|line| !line.is_empty() && !line.starts_with('#'));
    found.extend(
        lines.map(|line| (folder.join(line), PathBuf::from(normal_parts(Path::new(line))))),
    );
}

/// A search for models below a folder.
///
/// Scenes are not included: they are rare among models, and often refer to these very models. Each
/// folder is visited once, under its real path if that is below the root. Symbolic links are
/// followed last, so that the names do not depend on the order on disk.
struct FolderSearch<'a> {
    /// The folder to search. Pictures get their names from the models' paths below it.
    root: &'a Path,
    /// The visited folders, by their real paths.
    visited: BTreeSet<PathBuf>,
    /// Symbolic links to folders that are still to be visited, with their depths.
    links: VecDeque<(PathBuf, usize)>,
}

impl<'a> FolderSearch<'a> {
    fn new(root: &'a Path) -> Self {
        Self { root, visited: BTreeSet::new(), links: VecDeque::new() }
    }

    /// Adds all models.
    ///
    /// # Errors
    /// Returns an error if a folder cannot be read. A run must not silently skip models.
    fn run(mut self, found: &mut Vec<(PathBuf, PathBuf)>) -> Result<(), BatchError> {
        self.visit(self.root, 0, found)?;
        while let Some((link, depth)) = self.links.pop_front() {
            self.visit(&link, depth, found)?;
        }
        Ok(())
    }

    /// Adds the models in a folder and its subfolders, and queues symbolic links to folders.
    fn visit(
        &mut self,
        folder: &Path,
        depth: usize,
        found: &mut Vec<(PathBuf, PathBuf)>,
    ) -> Result<(), BatchError> {
        let fault = |cause: std::io::Error| read_error(folder, &cause);
        // Links may form cycles, so each folder is visited once.
        if depth > MAX_DEPTH || !self.visited.insert(folder.canonicalize().map_err(fault)?) {
            return Ok(());
        }
        let entries: Result<Vec<_>, _> = std::fs::read_dir(folder).map_err(fault)?.collect();
        let mut paths: Vec<PathBuf> =
            entries.map_err(fault)?.into_iter().map(|entry| entry.path()).collect();
        // The order of entries depends on the file system.
        paths.sort();
        for path in paths {
            if path.is_dir() {
                if path.is_symlink() {
                    // Links are followed last, so that a model gets the name of its real folder.
                    self.links.push_back((path, depth + 1));
                } else {
                    self.visit(&path, depth + 1, found)?;
                }
            } else if FileFormat::from_extension(&path).is_some() {
                let name = path.strip_prefix(self.root).unwrap_or(&path).to_owned();
                found.push((path, name));
            }
        }
        Ok(())
    }
}

/// Names the picture of each file after the file, with the extension `.png`.
///
/// If two files would get the same name, the original extension is kept; if that is not enough, a
/// number is appended. Names are compared case-insensitively, because some file systems ignore
/// case.
///
/// ```text
/// fox.glb                ─►  fox.png
/// fox.glb, fox.gltf      ─►  fox.glb.png, fox.gltf.png
/// a/fox.glb, b/fox.glb   ─►  fox.glb.png, fox.glb-2.png     (both named directly)
/// ```
/// The input is sorted, so numbers are the same in every shard.
fn name_outputs(found: Vec<(PathBuf, PathBuf)>) -> Vec<(PathBuf, String)> {
    let stem = |name: &Path| slash_path(&name.with_extension(""));
    let mut shared: BTreeMap<String, usize> = BTreeMap::new();
    for (_, name) in &found {
        *shared.entry(stem(name).to_lowercase()).or_default() += 1;
    }
    let mut taken: BTreeMap<String, usize> = BTreeMap::new();
    let job = |(input, name): (PathBuf, PathBuf)| {
        let alone = shared.get(&stem(&name).to_lowercase()) == Some(&1);
        let base = if alone { stem(&name) } else { slash_path(&name) };
        let times = taken.entry(base.to_lowercase()).or_default();
        *times += 1;
        let output =
            if *times == 1 { format!("{base}.png") } else { format!("{base}-{times}.png") };
        (input, output)
    };
    found.into_iter().map(job).collect()
}

/// Names the picture of each file by a template.
///
/// # Errors
/// Returns an error if two files would get the same name.
fn name_by_template(
    found: Vec<(PathBuf, PathBuf)>,
    template: &PictureName,
) -> Result<Vec<(PathBuf, String)>, BatchError> {
    let mut taken: BTreeMap<String, PathBuf> = BTreeMap::new();
    let mut named = Vec::new();
    for (at, (input, name)) in found.into_iter().enumerate() {
        let output = template.name_picture(NameSource { input: &name, line: at + 1, picture: 1 });
        if let Some(other) = taken.insert(output.to_lowercase(), input.clone()) {
            return Err(BatchError::Unusable(format!(
                "{} and {} would both be rendered to {output}\n  = help: add {{folder}}, {{name}} \
                 or {{line}} to --name",
                visible_path(&other),
                visible_path(&input)
            )));
        }
        named.push((input, output));
    }
    Ok(named)
}

/// Returns a path with `/` as separator on every system, because it is written to reports.
fn slash_path(path: &Path) -> String {
    let parts: Vec<_> = path.iter().map(|part| part.to_string_lossy()).collect();
    parts.join("/")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn outputs(names: &[&str]) -> Vec<String> {
        let found = names.iter().enumerate();
        let found = found.map(|(at, name)| (PathBuf::from(format!("{at}")), PathBuf::from(name)));
        name_outputs(found.collect()).into_iter().map(|(_, output)| output).collect()
    }

    #[test]
    fn no_two_pictures_have_the_same_name() {
        assert_eq!(outputs(&["a.glb", "b/a.glb", "c.d.gltf"]), ["a.png", "b/a.png", "c.d.png"]);
        assert_eq!(outputs(&["a.glb", "a.gltf"]), ["a.glb.png", "a.gltf.png"]);
        assert_eq!(
            outputs(&["a.glb", "A.glb"]),
            ["a.glb.png", "A.glb-2.png"],
            "some file systems ignore case"
        );
    }

    #[test]
    fn listed_names_stay_below_the_output_folder() {
        let mut found = Vec::new();
        add_listed("# models\n\n ../up/x.glb \n/abs/y.glb\n", Path::new("lists"), &mut found);
        let names: Vec<_> = found.iter().map(|(_, name)| slash_path(name)).collect();
        assert_eq!(names, ["up/x.glb", "abs/y.glb"]);
        assert_eq!(found[0].0, Path::new("lists/../up/x.glb"));
    }
}
