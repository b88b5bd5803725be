//! Content keys: a hash of everything that a picture depends on.
//!
//! The hash covers the program version, the settings, the picture's name, and the contents of the
//! model, the scene and all files they refer to. If its key is unchanged, a picture is up to date,
//! and a failed job would fail again.
//!
//! Content is hashed because modification times are unreliable: copying, checking out or mounting a
//! model changes its time but not its bytes.

use super::job::BatchJob;
use crate::content_digest::to_hexadecimal;
use import::FileFormat;
use scene::{Origin, referenced_files};
use scene_file::is_scene_file;
use sha2::{Digest, Sha256};
use std::collections::{BTreeMap, BTreeSet, VecDeque};
use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

/// The number of models and scenes whose hashes are cached.
const MAX_CACHED: usize = 4096;
/// The size of the blocks in which a file is hashed.
const PIECE_BYTES: usize = 1 << 16;
/// The number of leading bytes of a file that determine its format.
const HEAD_BYTES: u64 = 1 << 16;
/// The number of bytes at the start of a PLY file that are searched for texture names.
const MAX_HEADER_BYTES: u64 = 1 << 20;

/// A SHA-256 hash.
type ContentHash = [u8; 32];

/// Computes the keys of jobs; all threads share one instance.
///
/// Many lines of a list may share a model or a scene, so its content is hashed only once. A file
/// that changes during the run may keep its old hash to the end.
pub(super) struct KeyMaker {
    /// The hash of everything common to all jobs: version, settings, files named by flags.
    common: ContentHash,
    /// The files and folders that scenes may read in addition to the scene's folder.
    allowed: Vec<PathBuf>,
    /// The hashes of the most recent models and scenes.
    cache: Mutex<HashCache>,
}

/// The hashes of the most recent models and scenes, by path. The oldest is dropped when there are
/// too many.
#[derive(Default)]
struct HashCache {
    hashes: BTreeMap<PathBuf, ContentHash>,
    /// The paths, oldest first.
    order: VecDeque<PathBuf>,
}

impl KeyMaker {
    /// Prepares to compute the keys of jobs with these settings.
    ///
    /// `settings` is the debug output of the flags. A new flag changes this output, so everything
    /// is rendered again, which is the safe choice. Files in `allowed`, such as the `--environment`
    /// file, count by their content.
    pub(super) fn new(settings: &str, allowed: Vec<PathBuf>) -> Self {
        let mut hash = Sha256::new();
        hash_part(&mut hash, env!("CARGO_PKG_VERSION").as_bytes());
        hash_part(&mut hash, settings.as_bytes());
        allowed.iter().for_each(|path| hash.update(hash_file(path).0));
        Self { common: hash.finalize().into(), allowed, cache: Mutex::default() }
    }

    /// Returns the key of a job: the first 16 bytes of a SHA-256, in hexadecimal.
    ///
    /// Files that cannot be read count as empty; rendering reports the errors. 128 bits make an
    /// accidental collision impossible in practice.
    pub(super) fn job_key(&self, job: &BatchJob) -> String {
        let mut hash = Sha256::new();
        hash.update(self.common);
        hash_part(&mut hash, job.output.as_bytes());
        for flag in &job.flags {
            hash_part(&mut hash, flag.as_bytes());
        }
        if let Some(fault) = &job.fault {
            hash_part(&mut hash, fault.as_bytes());
        } else {
            let named = job.flags.iter().filter_map(|flag| Some(flag.split_once('=')?.1));
            for file in named.map(Path::new).filter(|path| path.is_file()) {
                hash.update(self.content_hash(file));
            }
            if let Some(scene) = &job.scene {
                hash_part(&mut hash, b"scene");
                hash.update(self.content_hash(scene));
            }
            hash.update(self.content_hash(&job.input));
        }
        to_hexadecimal(&hash.finalize()[..16])
    }

    /// Returns the hash of a model or a scene with everything it refers to.
    fn content_hash(&self, path: &Path) -> ContentHash {
        let lock = || self.cache.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(known) = lock().hashes.get(path) {
            return *known;
        }
        let mut hash = Sha256::new();
        if is_scene_file(path) {
            hash_scene(&mut hash, path, &self.allowed);
        } else {
            hash_model(&mut hash, path);
        }
        let hash = hash.finalize().into();
        lock().insert(path.to_owned(), hash);
        hash
    }
}

impl HashCache {
    fn insert(&mut self, path: PathBuf, hash: ContentHash) {
        if self.hashes.insert(path.clone(), hash).is_none() {
            self.order.push_back(path);
        }
        if self.order.len() > MAX_CACHED
            && let Some(oldest) = self.order.pop_front()
        {
            self.hashes.remove(&oldest);
        }
    }
}

/// Hashes a model with the buffers, material libraries and images it refers to.
///
/// The file is read as bytes, not imported, so a key requires reading the files but not parsing the
/// meshes. Files in folders above the model are also hashed, since only their bytes matter here;
/// the importer decides whether they may be read.
fn hash_model(hash: &mut Sha256, path: &Path) {
    let folder = path.parent().unwrap_or(Path::new(""));
    let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let (mut wanted, mut seen) = (VecDeque::from([name]), BTreeSet::new());
    while let Some(name) = wanted.pop_front() {
        if !seen.insert(name.clone()) {
            continue;
        }
        let (content, references) = hash_file(&folder.join(&name));
        hash.update(content);
        wanted.extend(references);
    }
}

/// Hashes a scene with its includes, models and images.
///
/// If a scene cannot be parsed, its text and the mistake are hashed: the mistake may be in an
/// include, and fixing it must change the key.
fn hash_scene(hash: &mut Sha256, path: &Path, allowed: &[PathBuf]) {
    hash.update(hash_file(path).0);
    let (origin, file) = match Origin::read_scene_allowing(path, allowed) {
        Ok(scene) => scene,
        Err(mistake) => return hash_part(hash, mistake.to_string().as_bytes()),
    };
    origin.included_texts().for_each(|text| hash_part(hash, text.as_bytes()));
    for model in &file.models {
        hash_model(hash, &origin.folder.join(&model.path));
    }
    for path in file.image_paths() {
        hash.update(hash_file(&origin.folder.join(path)).0);
    }
}

/// Returns the hash of a file's content, and the referenced file names.
///
/// Only the part of a large file that may contain names is kept in memory. Only regular files have
/// content here, because a model may name a device or a pipe, which would never end.
fn hash_file(path: &Path) -> (ContentHash, Vec<String>) {
    let mut hash = Sha256::new();
    let is_file = path.metadata().is_ok_and(|metadata| metadata.is_file());
    let Some(mut file) = is_file.then(|| File::open(path).ok()).flatten() else {
        return (hash.finalize().into(), Vec::new());
    };
    let mut text = Vec::new();
    let read_text = |file: &mut File, text: &mut Vec<u8>| {
        file.take(HEAD_BYTES).read_to_end(text)?;
        let rest = text_length(path, text).saturating_sub(text.len() as u64);
        file.take(rest).read_to_end(text)
    };
    // A file that cannot be read cannot be rendered either.
    let is_whole = read_text(&mut file, &mut text).is_ok();
    hash.update(&text);
    let mut piece = vec![0; if is_whole { PIECE_BYTES } else { 0 }];
    while let Ok(count @ 1..) = file.read(&mut piece) {
        hash.update(&piece[..count]);
    }
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    (hash.finalize().into(), referenced_files(&name, &text))
}

/// Returns the length of the part of a file that may name other files, based on its extension and
/// first bytes.
fn text_length(path: &Path, head: &[u8]) -> u64 {
    if path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("mtl")) {
        return u64::MAX;
    }
    // A header of 12 bytes, then the length of the JSON, its type, and the JSON itself.
    if let Some(json) = head.strip_prefix(b"glTF").and_then(|rest| rest.get(8..12)) {
        let mut length = [0; 4];
        length.copy_from_slice(json);
        return 20 + u64::from(u32::from_le_bytes(length));
    }
    match FileFormat::from_content(head).or_else(|| FileFormat::from_extension(path)) {
        Some(FileFormat::Gltf | FileFormat::Obj) => u64::MAX,
        Some(FileFormat::Ply) => MAX_HEADER_BYTES,
        Some(FileFormat::Stl | FileFormat::ThreeMf) | None => 0,
    }
}

/// Hashes one part, preceded by its length, so that no two lists of parts give the same bytes.
///
/// Without the length, `ab` + `c` and `a` + `bc` would have the same key.
fn hash_part(hash: &mut Sha256, part: &[u8]) {
    hash.update((part.len() as u64).to_le_bytes());
    hash.update(part);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::test_records::ReportFolder;

    /// Creates a job that does not come from a list.
    fn job_of(input: PathBuf) -> BatchJob {
        let output = "a.png".to_owned();
        BatchJob { input, output, scene: None, flags: Vec::new(), line: None, fault: None }
    }

    /// Returns the key of a single file.
    fn content_key(input: &Path, settings: &str) -> String {
        KeyMaker::new(settings, Vec::new()).job_key(&job_of(input.to_owned()))
    }

    #[test]
    fn models_and_includes_of_a_scene_change_its_key() {
        let folder = ReportFolder::new("key");
        let include = "(include: \"style.ron\", models: [(path: \"a.gltf\")])";
        folder.add_text("scene.ron", include.as_bytes());
        let of = |name: &str, content: &str| {
            folder.add_text(name, content.as_bytes());
            content_key(&folder.path().join("scene.ron"), "")
        };
        let keys = [of("style.ron", "()"), of("style.ron", "(style: Flat)"), of("a.gltf", "{}")];
        assert!(keys[0] != keys[1] && keys[1] != keys[2] && keys[2] == of("a.gltf", "{}"));
        let broken = [of("style.ron", "(sty: 1)"), of("style.ron", "(stile: 1)")];
        assert!(!keys.contains(&broken[0]) && broken[0] != broken[1], "the mistake changed");
    }

    #[test]
    fn obj_libraries_and_textures_change_the_key_and_devices_are_not_read() {
        let folder = ReportFolder::new("key-obj");
        let of = |name: &str, content: &str| {
            folder.add_text(name, content.as_bytes());
            content_key(&folder.path().join("a.obj"), "")
        };
        let keys = [
            of("a.obj", "mtllib a.mtl\nmtllib /dev/zero\n"),
            of("a.mtl", "newmtl a\nmap_Kd wood.png\n"),
            of("wood.png", "1"),
            of("wood.png", "2"),
        ];
        assert!((1..4).all(|at| keys[at] != keys[at - 1]), "{keys:?}");
        assert_eq!(keys[2], of("wood.png", "1"));
    }

    #[test]
    fn settings_and_content_change_the_key() {
        let folder = ReportFolder::new("key-settings");
        let of = |content: &str, settings: &str| {
            folder.add_text("a.gltf", content.as_bytes());
            content_key(&folder.path().join("a.gltf"), settings)
        };
        let keys = [of("{}", "a"), of("{}", "b"), of("{ }", "a")];
        assert!(keys[0] != keys[1] && keys[0] != keys[2] && keys[0] == of("{}", "a"));
    }

    #[test]
    fn flags_scene_and_output_of_a_line_change_the_key() {
        let folder = ReportFolder::new("key-lines");
        folder.add_text("a.gltf", b"{}");
        folder.add_text("scene.ron", b"(models: [(path: \"{input}\")])");
        folder.add_text("sky.hdr", b"1");
        let plain = job_of(folder.path().join("a.gltf"));
        let sky = format!("--environment={}", folder.path().join("sky.hdr").display());
        let jobs = [
            plain.clone(),
            BatchJob { output: "b.png".to_owned(), ..plain.clone() },
            BatchJob { flags: vec!["--size=8x8".to_owned()], ..plain.clone() },
            BatchJob { flags: vec!["--view=top".to_owned()], ..plain.clone() },
            BatchJob { flags: vec![sky], ..plain.clone() },
            BatchJob { scene: Some(folder.path().join("scene.ron")), ..plain.clone() },
            BatchJob { fault: Some("no such flag".to_owned()), ..plain },
        ];
        let keys = || jobs.each_ref().map(|job| KeyMaker::new("", Vec::new()).job_key(job));
        let first = keys();
        assert_eq!(first.iter().collect::<BTreeSet<_>>().len(), jobs.len(), "{first:?}");
        assert_eq!(keys(), first);
        folder.add_text("sky.hdr", b"2");
        folder.add_text("scene.ron", b"(style: Flat, models: [(path: \"{input}\")])");
        let changed: Vec<usize> = (0..jobs.len()).filter(|at| keys()[*at] != first[*at]).collect();
        assert_eq!(changed, [4, 5]);
    }

    #[test]
    fn large_files_are_hashed_in_full_and_names_are_found_at_their_start() {
        let folder = ReportFolder::new("key-large");
        let json = b"{\"buffers\":[{\"uri\":\"a.bin\"}]} ";
        let mut glb = [b"glTF\x02\0\0\0".as_slice(), &200_000_u32.to_le_bytes()].concat();
        glb.extend_from_slice(&u32::try_from(json.len()).unwrap().to_le_bytes());
        glb.extend_from_slice(b"JSON");
        glb.extend_from_slice(json);
        glb.resize(200_000, 7);
        let of = |name: &str, content: &[u8]| {
            folder.add_text(name, content);
            content_key(&folder.path().join("a.glb"), "")
        };
        let first = of("a.glb", &glb);
        assert_ne!(first, of("a.bin", b"1"), "the key depends on the buffer");
        *glb.last_mut().unwrap() = 8;
        assert_ne!(of("a.bin", b"1"), of("a.glb", &glb), "the key depends on the last byte");
    }

    #[test]
    fn the_cache_is_bounded() {
        let mut cache = HashCache::default();
        for at in 0..MAX_CACHED + 10 {
            cache.insert(PathBuf::from(at.to_string()), [0; 32]);
        }
        assert_eq!((cache.hashes.len(), cache.order.len()), (MAX_CACHED, MAX_CACHED));
        assert!(!cache.hashes.contains_key(Path::new("0")));
    }
}
