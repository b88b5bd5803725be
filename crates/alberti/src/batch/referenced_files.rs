//! The files that a model refers to: buffers and images of glTF, material libraries of OBJ with
//! their textures, textures of PLY.
//!
//! They are found by a quick look at the text and not by the importer, so that a key costs a read
//! of the files and no parse of the meshes. A name too many does no harm: it is a file that does
//! not exist, or one whose change renders a picture again.

use pipeline::import::FileFormat;
use serde_json::Value;
use std::path::Path;

/// Material libraries of an OBJ file, and textures of a library, that are looked for.
const MAX_NAMES: usize = 1024;

/// Words of a statement that a file name may begin at.
const MAX_WORDS: usize = 16;

/// The names of the files that a model in a folder refers to, relative to that folder, in the order
/// in which they are mentioned.
pub(super) fn referenced_files(path: &Path, bytes: &[u8]) -> Vec<String> {
    match FileFormat::from_content(bytes).or_else(|| FileFormat::from_extension(path)) {
        Some(FileFormat::Gltf) => gltf_files(bytes),
        Some(FileFormat::Obj) => obj_files(path.parent().unwrap_or(Path::new("")), bytes),
        Some(FileFormat::Ply) => ply_files(bytes),
        Some(FileFormat::Stl | FileFormat::ThreeMf) | None => Vec::new(),
    }
}

/// The external buffers and images of a glTF file.
///
/// Embedded `data:` URIs are part of the file's bytes and are left out, as are buffers without a
/// URI, the binary chunk of a GLB. Invalid JSON refers to nothing.
fn gltf_files(bytes: &[u8]) -> Vec<String> {
    let Ok(json) = serde_json::from_slice::<Value>(json_chunk(bytes)) else { return Vec::new() };
    let list = |name: &str| json.get(name).and_then(Value::as_array).cloned().unwrap_or_default();
    let all = list("buffers").into_iter().chain(list("images"));
    let names = all.filter_map(|entry| Some(entry.get("uri")?.as_str()?.to_owned()));
    names.filter(|uri| !uri.starts_with("data:")).map(|uri| percent_decode(&uri)).collect()
}

/// The material libraries of an OBJ file and, after each, the textures that it names.
///
/// `mtllib` takes one name, which may contain spaces, or several; a texture is looked for beside
/// its library, beside the model, and there by the last part of its name alone.
fn obj_files(folder: &Path, bytes: &[u8]) -> Vec<String> {
    let mut files = Vec::new();
    for statement in statements(bytes, |keyword| keyword == "mtllib").take(MAX_NAMES) {
        let words = statement.split_ascii_whitespace().map(str::to_owned);
        for library in std::iter::once(statement.clone()).chain(words.take(MAX_WORDS)) {
            let text = std::fs::read(folder.join(&library)).unwrap_or_default();
            let beside = library.rfind('/').map_or("", |slash| &library[..=slash]).to_owned();
            files.push(library);
            for texture in statements(&text, is_texture).take(MAX_NAMES) {
                push_texture(&mut files, &beside, &texture);
            }
        }
    }
    files
}

/// Whether a statement of a material library, in lower case, names a texture.
fn is_texture(keyword: &str) -> bool {
    keyword.starts_with("map_") || matches!(keyword, "bump" | "norm")
}

/// Pushes the places of a texture whose name is the end of a statement: options come before it, and
/// it may contain spaces.
fn push_texture(files: &mut Vec<String>, beside: &str, statement: &str) {
    let mut rest = statement;
    for _ in 0..MAX_WORDS {
        let name = rest.replace('\\', "/");
        files.push(format!("{beside}{name}"));
        files.push(name.rsplit('/').next().unwrap_or_default().to_owned());
        files.push(name);
        let Some((_, after)) = rest.split_once(|c: char| c.is_ascii_whitespace()) else { return };
        rest = after.trim_start();
    }
}

/// The arguments of all statements of a text whose keyword, in lower case, is accepted.
fn statements(text: &[u8], is_wanted: impl Fn(&str) -> bool) -> impl Iterator<Item = String> {
    let lines = text.split(|byte| matches!(byte, b'\n' | b'\r')).map(<[u8]>::trim_ascii);
    // Most lines are vertices and faces, which are not worth a string.
    let lines = lines.filter(|line| {
        matches!(line.first(), Some(b'm' | b'M' | b'b' | b'B' | b'n' | b'N')) && line.len() > 5
    });
    lines.filter_map(move |line| {
        let line = String::from_utf8_lossy(line);
        let (keyword, rest) = line.split_once(|c: char| c.is_ascii_whitespace())?;
        is_wanted(&keyword.to_ascii_lowercase()).then(|| rest.trim().to_owned())
    })
}

/// The textures of a PLY file: `comment TextureFile NAME` in its header.
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
    fn the_files_of_gltf_are_found_in_both_forms() {
        let json =
            br#"{"buffers":[{"uri":"a%20b.bin"},{}],"images":[{"uri":"data:x"},{"uri":"c.png"}]}"#;
        assert_eq!(gltf_files(json), ["a b.bin", "c.png"]);
        let mut glb = b"glTF\x02\0\0\0\0\0\0\0".to_vec();
        glb.extend((json.len() as u32).to_le_bytes());
        glb.extend(b"JSON");
        glb.extend(json);
        assert_eq!(gltf_files(&glb), ["a b.bin", "c.png"]);
        for end in 0..glb.len() {
            gltf_files(&glb[..end]);
        }
    }

    #[test]
    fn libraries_of_obj_bring_their_textures() {
        let folder = std::env::temp_dir().join(format!("alberti-files-{}", std::process::id()));
        std::fs::create_dir_all(folder.join("sub")).expect("a folder");
        let library = "newmtl a\nKd 1 0 0\n  map_Kd -s 2 2 1 C:\\wood grain.png\r\nNORM n.png\n";
        std::fs::write(folder.join("sub/a b.mtl"), library).expect("a file");
        let files = referenced_files(
            &folder.join("a.obj"),
            b"# mtllib no.mtl\nv 0 0 0\nmtllib sub/a b.mtl\nf 1 1 1\n",
        );
        let has = |name: &str| files.iter().any(|file| file == name);
        assert!(has("sub/a b.mtl") && has("sub/a") && has("b.mtl"), "{files:?}");
        assert!(has("wood grain.png") && has("n.png") && has("sub/n.png"), "{files:?}");
        assert!(!files.iter().any(|file| file.contains("no.mtl")), "{files:?}");
        let _ = std::fs::remove_dir_all(&folder);
    }

    #[test]
    fn textures_of_ply_are_named_in_comments_of_its_header() {
        let ply = b"ply\r\nformat ascii 1.0\r\ncomment TextureFile a b.png\r\nend_header\r\n\
            comment TextureFile no.png";
        assert_eq!(referenced_files(Path::new("a.ply"), ply), ["a b.png"]);
    }
}
