//! Content keys: a hash of everything that a picture depends on.
//!
//! That is the version of the program, the settings, and the content of the model or scene with all
//! files it refers to. A picture is up to date if its key is unchanged.
//!
//! Content is hashed rather than compared by time, because models are copied, checked out and
//! mounted in ways that change their times but not their bytes.

use super::job::BatchJob;
use crate::referenced_files::referenced_files;
use crate::render::is_scene_file;
use pipeline::Origin;
use sha2::{Digest, Sha256};
use std::collections::{BTreeSet, VecDeque};
use std::path::{Path, PathBuf};

/// Makes the keys of jobs; the threads share one.
pub(super) struct KeyMaker {
    /// Everything in the flags of the command that changes a picture.
    settings: String,
    /// The folders that scenes may read from besides their own.
    allowed: Vec<PathBuf>,
}

impl KeyMaker {
    /// Keys of jobs with these settings.
    pub(super) fn new(settings: String, allowed: Vec<PathBuf>) -> Self {
        Self { settings, allowed }
    }

    /// The key of a job.
    pub(super) fn job_key(&self, job: &BatchJob) -> String {
        let settings =
            format!("{}\n{:?}\n{}\n{:?}", self.settings, job.flags, job.output, job.scene);
        content_key(&job.input, &settings, &self.allowed)
    }
}

/// The key of a model or a scene: the first 16 bytes of a SHA-256, in hexadecimal.
///
/// Files that cannot be read count as empty; rendering reports what is wrong with them.
///
/// `settings` is the debug form of the flags; a flag that is added changes it and thereby renders
/// everything again, which is the safe side. 128 bits make an accidental collision impossible in
/// practice.
fn content_key(input: &Path, settings: &str, allowed: &[PathBuf]) -> String {
    let mut hash = Sha256::new();
    hash_part(&mut hash, env!("CARGO_PKG_VERSION").as_bytes());
    hash_part(&mut hash, settings.as_bytes());
    if is_scene_file(input) {
        hash_scene(&mut hash, input, allowed);
    } else {
        hash_model(&mut hash, input);
    }
    hash.finalize().iter().take(16).map(|byte| format!("{byte:02x}")).collect()
}

/// Hashes a model with the buffers, material libraries and images it refers to.
///
/// The file is read as bytes and not imported: a key costs a read of the files, not a parse of the
/// meshes. Files in folders above the model are hashed as well, since only their bytes matter here;
/// the importer decides whether they may be read.
fn hash_model(hash: &mut Sha256, path: &Path) {
    let folder = path.parent().unwrap_or(Path::new(""));
    let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let (mut wanted, mut seen) = (VecDeque::from([name]), BTreeSet::new());
    while let Some(name) = wanted.pop_front() {
        if !seen.insert(name.clone()) {
            continue;
        }
        let bytes = read_regular_file(&folder.join(&name));
        hash_part(hash, &bytes);
        wanted.extend(referenced_files(&name, &bytes));
    }
}

/// The bytes of a regular file; none of anything else. A name in a model may be that of a device or
/// a pipe, which would never end.
fn read_regular_file(path: &Path) -> Vec<u8> {
    let is_file = path.metadata().is_ok_and(|metadata| metadata.is_file());
    if is_file { std::fs::read(path).unwrap_or_default() } else { Vec::new() }
}

/// Hashes a scene with its includes, models and images.
///
/// A scene that cannot be parsed is hashed by its own text alone; it fails anyway, and failed jobs
/// are always tried again.
fn hash_scene(hash: &mut Sha256, path: &Path, allowed: &[PathBuf]) {
    hash_part(hash, &read_regular_file(path));
    let Ok((origin, file)) = Origin::read_scene_allowing(path, allowed) else { return };
    origin.included_texts().for_each(|text| hash_part(hash, text.as_bytes()));
    for model in &file.models {
        hash_model(hash, &origin.folder.join(&model.path));
    }
    for path in file.image_paths() {
        hash_part(hash, &read_regular_file(&origin.folder.join(path)));
    }
}

/// Hashes one part, prefixed by its length, so that no two lists of parts give the same bytes.
///
/// Without the length, `ab` + `c` and `a` + `bc` would have the same key.
fn hash_part(hash: &mut Sha256, part: &[u8]) {
    hash.update((part.len() as u64).to_le_bytes());
    hash.update(part);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_models_and_the_includes_of_a_scene_change_its_key() {
        let folder = std::env::temp_dir().join(format!("alberti-key-{}", std::process::id()));
        std::fs::create_dir_all(&folder).expect("a folder");
        let write = |name: &str, content: &str| {
            std::fs::write(folder.join(name), content).expect("a file");
        };
        write("scene.ron", "(include: \"style.ron\", models: [(path: \"a.gltf\")])");
        let of = |name: &str, content: &str| {
            write(name, content);
            content_key(&folder.join("scene.ron"), "", &[])
        };
        let keys = [of("style.ron", "()"), of("style.ron", "(style: Flat)"), of("a.gltf", "{}")];
        assert!(keys[0] != keys[1] && keys[1] != keys[2] && keys[2] == of("a.gltf", "{}"));
        let _ = std::fs::remove_dir_all(&folder);
    }

    #[test]
    fn libraries_and_textures_of_obj_change_the_key_and_devices_are_not_read() {
        let folder = std::env::temp_dir().join(format!("alberti-key-obj-{}", std::process::id()));
        std::fs::create_dir_all(&folder).expect("a folder");
        let of = |name: &str, content: &str| {
            std::fs::write(folder.join(name), content).expect("a file");
            content_key(&folder.join("a.obj"), "", &[])
        };
        let keys = [
            of("a.obj", "mtllib a.mtl\nmtllib /dev/zero\n"),
            of("a.mtl", "newmtl a\nmap_Kd wood.png\n"),
            of("wood.png", "1"),
            of("wood.png", "2"),
        ];
        assert!((1..4).all(|at| keys[at] != keys[at - 1]), "{keys:?}");
        assert_eq!(keys[2], of("wood.png", "1"));
        let _ = std::fs::remove_dir_all(&folder);
    }

    #[test]
    fn settings_and_content_change_the_key() {
        let file = std::env::temp_dir().join(format!("alberti-key-{}.gltf", std::process::id()));
        let of = |content: &str, settings: &str| {
            std::fs::write(&file, content).expect("a file");
            content_key(&file, settings, &[])
        };
        let keys = [of("{}", "a"), of("{}", "b"), of("{ }", "a")];
        assert!(keys[0] != keys[1] && keys[0] != keys[2] && keys[0] == of("{}", "a"));
        let _ = std::fs::remove_file(&file);
    }
}
