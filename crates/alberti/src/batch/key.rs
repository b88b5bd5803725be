//! Content keys: a hash of everything that a picture depends on.
//!
//! That is the version of the program, the settings, and the content of the model or scene with all
//! files it refers to. A picture is up to date if its key is unchanged.
//!
//! Content is hashed rather than compared by time, because models are copied, checked out and
//! mounted in ways that change their times but not their bytes.

use crate::render::is_scene_file;
use pipeline::Origin;
use serde_json::Value;
use sha2::{Digest, Sha256};
use std::path::{Path, PathBuf};

/// The key of a model or a scene: the first 16 bytes of a SHA-256, in hexadecimal.
///
/// Files that cannot be read count as empty; rendering reports what is wrong with them.
///
/// `settings` is the debug form of the flags; a flag that is added changes it and thereby renders
/// everything again, which is the safe side. 128 bits make an accidental collision impossible in
/// practice.
pub(super) fn content_key(input: &Path, settings: &str, allowed: &[PathBuf]) -> String {
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

/// Hashes a model with the buffers and images it refers to.
///
/// The file is read as bytes and not imported: a key costs a read of the files, not a parse of the
/// meshes. Files in folders above the model are hashed as well, since only their bytes matter here;
/// the importer decides whether they may be read.
fn hash_model(hash: &mut Sha256, path: &Path) {
    let bytes = std::fs::read(path).unwrap_or_default();
    hash_part(hash, &bytes);
    let folder = path.parent().unwrap_or(Path::new(""));
    for name in referenced_files(&bytes) {
        hash_part(hash, &std::fs::read(folder.join(name)).unwrap_or_default());
    }
}

/// Hashes a scene with its includes, models and images.
///
/// A scene that cannot be parsed is hashed by its own text alone; it fails anyway, and failed jobs
/// are always tried again.
fn hash_scene(hash: &mut Sha256, path: &Path, allowed: &[PathBuf]) {
    hash_part(hash, &std::fs::read(path).unwrap_or_default());
    let Ok((origin, file)) = Origin::read_scene_allowing(path, allowed) else { return };
    origin.included_texts().for_each(|text| hash_part(hash, text.as_bytes()));
    for model in &file.models {
        hash_model(hash, &origin.folder.join(&model.path));
    }
    for path in file.image_paths() {
        hash_part(hash, &std::fs::read(origin.folder.join(path)).unwrap_or_default());
    }
}

/// Hashes one part, prefixed by its length, so that no two lists of parts give the same bytes.
///
/// Without the length, `ab` + `c` and `a` + `bc` would have the same key.
fn hash_part(hash: &mut Sha256, part: &[u8]) {
    hash.update((part.len() as u64).to_le_bytes());
    hash.update(part);
}

/// The external buffers and images of a glTF file.
///
/// Embedded `data:` URIs are part of the file's bytes and are left out, as are buffers without a
/// URI, the binary chunk of a GLB. Invalid JSON refers to nothing.
fn referenced_files(bytes: &[u8]) -> Vec<String> {
    let Ok(json) = serde_json::from_slice::<Value>(json_chunk(bytes)) else { return Vec::new() };
    let list = |name: &str| json.get(name).and_then(Value::as_array).cloned().unwrap_or_default();
    let all = list("buffers").into_iter().chain(list("images"));
    let names = all.filter_map(|entry| Some(entry.get("uri")?.as_str()?.to_owned()));
    names.filter(|uri| !uri.starts_with("data:")).map(|uri| percent_decode(&uri)).collect()
}

/// The JSON chunk of a GLB file, or all of a `.gltf` file.
///
/// A GLB begins with a header of 12 bytes (magic, version, length), then the length and the type of
/// the first chunk, 4 bytes each, then the JSON (glTF 2.0 §4.4). Truncated files give a shorter
/// slice and never a panic.
fn json_chunk(bytes: &[u8]) -> &[u8] {
    let Some(rest) = bytes.strip_prefix(b"glTF").and_then(|rest| rest.get(8..)) else {
        return bytes;
    };
    let Some(length) = rest.first_chunk() else { return &[] };
    let length = u32::from_le_bytes(*length) as usize;
    rest.get(8..).map_or(&[], |json| &json[..length.min(json.len())])
}

/// Decodes the `%XX` escapes of a URI (RFC 3986 §2.1).
///
/// A `%` without two hexadecimal digits is left as it is. Bytes that are not UTF-8 become
/// replacement characters; such a file is not found and counts as empty.
fn percent_decode(uri: &str) -> String {
    let mut bytes = Vec::with_capacity(uri.len());
    let mut rest = uri.as_bytes();
    while let Some((&first, after)) = rest.split_first() {
        let hex = |at: usize| after.get(at).and_then(|&digit| char::from(digit).to_digit(16));
        match (first, hex(0), hex(1)) {
            (b'%', Some(high), Some(low)) => {
                bytes.push((high * 16 + low) as u8);
                rest = &after[2..];
            }
            _ => {
                bytes.push(first);
                rest = after;
            }
        }
    }
    String::from_utf8_lossy(&bytes).into_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_files_of_a_model_are_found_in_both_forms() {
        let json =
            br#"{"buffers":[{"uri":"a%20b.bin"},{}],"images":[{"uri":"data:x"},{"uri":"c.png"}]}"#;
        assert_eq!(referenced_files(json), ["a b.bin", "c.png"]);
        let mut glb = b"glTF\x02\0\0\0\0\0\0\0".to_vec();
        glb.extend((json.len() as u32).to_le_bytes());
        glb.extend(b"JSON");
        glb.extend(json);
        assert_eq!(referenced_files(&glb), ["a b.bin", "c.png"]);
        for end in 0..glb.len() {
            referenced_files(&glb[..end]);
        }
    }

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
