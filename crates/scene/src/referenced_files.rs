//! The files that a model refers to: glTF buffers and images, OBJ material libraries and their
//! textures, and PLY textures.
//!
//! A quick scan of the text finds them without the importer, so meshes are not parsed. Extra names
//! are harmless: at worst, a change in an unrelated file causes a picture to be rendered again.

use import::{FileFormat, percent_decode};
use serde_json::Value;
use std::path::Path;

/// The maximum number of names to look up for one file.
const MAX_NAMES: usize = 1024;

/// The maximum number of words in a statement at which a file name may begin.
const MAX_WORDS: usize = 16;

/// Returns the file names that a model or material library refers to, relative to the
/// model's folder, in the order in which they appear. `name` is the name of the file itself.
///
/// The textures of a material library are not listed for the model that refers to it.
#[must_use]
pub fn referenced_files(name: &str, bytes: &[u8]) -> Vec<String> {
    let path = Path::new(name);
    if path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("mtl")) {
        return mtl_files(name, bytes);
    }
    match FileFormat::from_content(bytes).or_else(|| FileFormat::from_extension(path)) {
        Some(FileFormat::Gltf) => gltf_files(bytes),
        Some(FileFormat::Obj) => obj_files(bytes),
        Some(FileFormat::Ply) => ply_files(bytes),
        Some(FileFormat::Stl | FileFormat::ThreeMf) | None => Vec::new(),
    }
}

/// Returns the external buffers and images of a glTF file.
///
/// Embedded `data:` URIs are part of the file itself and are omitted, as are buffers without a URI,
/// which refer to the binary chunk of a GLB. Invalid JSON refers to nothing.
fn gltf_files(bytes: &[u8]) -> Vec<String> {
    let Ok(json) = serde_json::from_slice::<Value>(json_chunk(bytes)) else { return Vec::new() };
    let list = |name: &str| json.get(name).and_then(Value::as_array).cloned().unwrap_or_default();
    let all = list("buffers").into_iter().chain(list("images"));
    let names = all.filter_map(|entry| Some(entry.get("uri")?.as_str()?.to_owned()));
    names.filter(|uri| !uri.starts_with("data:")).flat_map(paths_of_uri).collect()
}

/// Returns the paths that the importer tries for a URI: as written, decoded, and with `\` as `/`.
fn paths_of_uri(uri: String) -> Vec<String> {
    let decoded = percent_decode(&uri);
    let with_slashes = decoded.as_ref().map(|path| path.replace('\\', "/"));
    let mut paths: Vec<String> = [Some(uri), decoded, with_slashes].into_iter().flatten().collect();
    paths.dedup();
    paths
}

/// Returns the material libraries of an OBJ file: `mtllib` takes one name, which may contain
/// spaces, or several names.
fn obj_files(bytes: &[u8]) -> Vec<String> {
    let mut files = Vec::new();
    for statement in statements(bytes, |keyword| keyword == "mtllib").take(MAX_NAMES) {
        let words = statement.split_ascii_whitespace().map(str::to_owned);
        files.extend(words.take(MAX_WORDS).filter(|word| *word != statement));
        files.push(statement);
    }
    files
}

/// Returns the textures of a material library. They are looked up next to the library and next to
/// the model, where the last part of a name is also enough.
fn mtl_files(name: &str, bytes: &[u8]) -> Vec<String> {
    let folder = name.rfind('/').map_or("", |slash| &name[..=slash]);
    let is_texture =
        |keyword: &str| keyword.starts_with("map_") || matches!(keyword, "bump" | "norm");
    let mut files = Vec::new();
    for statement in statements(bytes, is_texture).take(MAX_NAMES) {
        // Options come before the name, which may contain spaces.
        let mut rest = statement.as_str();
        for _ in 0..MAX_WORDS {
            let name = rest.replace('\\', "/");
            files.push(format!("{folder}{name}"));
            files.push(name.rsplit('/').next().unwrap_or_default().to_owned());
            files.push(name);
            let Some((_, after)) = rest.split_once(|c: char| c.is_ascii_whitespace()) else {
                break;
            };
            rest = after.trim_start();
        }
    }
    files
}

/// Returns the arguments of all statements in a text whose keyword, in lowercase, is accepted.
fn statements(text: &[u8], is_wanted: impl Fn(&str) -> bool) -> impl Iterator<Item = String> {
    let lines = text.split(|byte| matches!(byte, b'\n' | b'\r')).map(<[u8]>::trim_ascii);
    // Most lines are vertices and faces, for which a string would be wasted.
    let lines = lines.filter(|line| {
        matches!(line.first(), Some(b'm' | b'M' | b'b' | b'B' | b'n' | b'N')) && line.len() > 5
    });
    lines.filter_map(move |line| {
        let line = String::from_utf8_lossy(line);
        let (keyword, rest) = line.split_once(|c: char| c.is_ascii_whitespace())?;
        is_wanted(&keyword.to_ascii_lowercase()).then(|| rest.trim().to_owned())
    })
}

/// Returns the textures of a PLY file: `comment TextureFile NAME` in its header.
fn ply_files(bytes: &[u8]) -> Vec<String> {
    let lines = bytes.split(|byte| matches!(byte, b'\n' | b'\r')).map(String::from_utf8_lossy);
    let header = lines.take_while(|line| line.trim() != "end_header");
    let names = header.filter_map(|line| {
        let rest = line.trim().strip_prefix("comment")?.trim_start();
        let (word, name) = rest.split_once(|c: char| c.is_ascii_whitespace())?;
        word.eq_ignore_ascii_case("texturefile").then(|| name.trim().to_owned())
    });
    names.take(MAX_NAMES).collect()
}

/// Returns the JSON chunk of a GLB file, or the whole of a `.gltf` file.
///
/// A GLB begins with a header of 12 bytes (magic, version, length), then the length and the type of
/// the first chunk, 4 bytes each, then the JSON (glTF 2.0 §4.4). Truncated files give a shorter
/// slice, never a panic.
fn json_chunk(bytes: &[u8]) -> &[u8] {
    let Some(rest) = bytes.strip_prefix(b"glTF").and_then(|rest| rest.get(8..)) else {
        return bytes;
    };
    let Some(length) = rest.first_chunk() else { return &[] };
    let length = u32::from_le_bytes(*length) as usize;
    rest.get(8..).map_or(&[], |json| &json[..length.min(json.len())])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_of_both_forms_of_gltf_are_found() {
        let json =
            br#"{"buffers":[{"uri":"a%20b.bin"},{}],"images":[{"uri":"data:x"},{"uri":"c.png"}]}"#;
        assert_eq!(gltf_files(json), ["a%20b.bin", "a b.bin", "c.png"]);
        let mut glb = b"glTF\x02\0\0\0\0\0\0\0".to_vec();
        glb.extend((json.len() as u32).to_le_bytes());
        glb.extend(b"JSON");
        glb.extend(json);
        assert_eq!(gltf_files(&glb), gltf_files(json));
        for end in 0..glb.len() {
            gltf_files(&glb[..end]);
        }
    }

    #[test]
    fn windows_paths_are_found_as_the_importer_finds_them() {
        let json = br#"{"images":[{"uri":"maps\\wood%20grain.png"}]}"#;
        assert!(gltf_files(json).iter().any(|name| name == "maps/wood grain.png"));
    }

    #[test]
    fn models_refer_to_libraries_and_libraries_to_textures() {
        let obj = b"# mtllib no.mtl\nv 0 0 0\nmtllib sub/a b.mtl\nf 1 1 1\n";
        assert_eq!(referenced_files("a.obj", obj), ["sub/a", "b.mtl", "sub/a b.mtl"]);
        let library = b"newmtl a\nKd 1 0 0\n  map_Kd -s 2 2 1 C:\\wood grain.png\r\nNORM n.png\n";
        let files = referenced_files("sub/a b.mtl", library);
        for name in ["wood grain.png", "n.png", "sub/n.png"] {
            assert!(files.iter().any(|file| file == name), "{name}: {files:?}");
        }
    }

    #[test]
    fn ply_textures_are_found_in_header_comments() {
        let ply = b"ply\r\nformat ascii 1.0\r\ncomment TextureFile a b.png\r\nend_header\r\n\
            comment TextureFile no.png";
        assert_eq!(referenced_files("a.ply", ply), ["a b.png"]);
    }
}
