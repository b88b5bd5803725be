//! The page's files, its lesson models and its engine, embedded at build time.

use std::collections::BTreeMap;

/// Paths and compressed contents; see `build.rs`.
const FILES: &[(&str, &[u8])] = include!(concat!(env!("OUT_DIR"), "/explorer_files.rs"));

/// Returns all files by their URL paths, without the leading slash.
pub(super) fn embedded_files() -> BTreeMap<String, Vec<u8>> {
    let unpack = |(path, bytes): &(&str, &[u8])| {
        let bytes = miniz_oxide::inflate::decompress_to_vec_zlib(bytes);
        Some(((*path).to_owned(), bytes.ok()?))
    };
    FILES.iter().filter_map(unpack).collect()
}

/// Returns the bytes of a lesson model: `models/house.glb` for `house`.
pub(crate) fn lesson_model(name: &str) -> Option<Vec<u8>> {
    embedded_files().remove(&format!("models/{name}.glb"))
}

/// Returns a file's content type from its extension.
pub(super) fn content_type(path: &str) -> &'static str {
    match path.rsplit_once('.').map_or("", |(_, ending)| ending) {
        "html" => "text/html; charset=utf-8",
        "css" => "text/css; charset=utf-8",
        "js" => "text/javascript; charset=utf-8",
        "svg" => "image/svg+xml",
        "wasm" => "application/wasm",
        "glb" => "model/gltf-binary",
        _ => "application/octet-stream",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_page_files_are_embedded_with_a_content_type() {
        let files = embedded_files();
        for path in ["index.html", "main.js", "style.css", "worker.js", "models/house.glb"] {
            assert!(files.contains_key(path), "{path}");
        }
        assert_eq!(files.len(), FILES.len(), "a file cannot be unpacked");
        for path in files.keys() {
            assert_ne!(content_type(path), "application/octet-stream", "{path}");
        }
    }

    #[test]
    fn the_page_without_its_engine_is_at_most_80_kilobytes() {
        let files = embedded_files();
        let page = files.iter().filter(|(path, _)| !path.contains('/') && !path.starts_with("web"));
        let bytes: usize = page.map(|(_, bytes)| bytes.len()).sum();
        assert!(bytes <= 80_000, "{bytes} bytes");
    }
}
