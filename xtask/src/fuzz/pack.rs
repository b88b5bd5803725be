//! Packs models with several files into one binary file, because the targets read a single input,
//! and extracts compressed parts from them.

use scene_models::glb::encode_glb;
use serde_json::{Value, json};
use std::fs;
use std::path::Path;

/// A model, packed into one file if possible.
pub struct PackedModel {
    /// The whole file.
    pub file: Vec<u8>,
    /// The document, whose only buffer is the binary chunk.
    pub json: Value,
    /// The bytes of the first buffer.
    pub binary: Vec<u8>,
}

impl PackedModel {
    /// Reads a `.glb`, or a `.gltf` with all files that it refers to. A file that cannot be packed
    /// is returned unchanged. Returns `None` if the file cannot be read.
    pub fn read_model(path: &Path) -> Option<Self> {
        let file = fs::read(path).ok()?;
        if let Some((json, binary)) = glb_chunks(&file) {
            let (json, binary) =
                (serde_json::from_slice(json).unwrap_or_default(), binary.to_vec());
            return Some(Self { file, json, binary });
        }
        let json: Value = serde_json::from_slice(&file).unwrap_or_default();
        Some(Self::join_buffers(&json, path.parent()?).unwrap_or(Self {
            file,
            json,
            binary: Vec::new(),
        }))
    }

    fn join_buffers(json: &Value, folder: &Path) -> Option<Self> {
        let (mut json, mut binary, mut starts) = (json.clone(), Vec::new(), Vec::new());
        for buffer in json.get("buffers")?.as_array()? {
            starts.push(append_aligned(
                &mut binary,
                &fs::read(folder.join(buffer["uri"].as_str()?)).ok()?,
            ));
        }
        for view in json["bufferViews"].as_array_mut()? {
            shift_view(view, &starts)?;
            for extension in ["EXT_meshopt_compression", "KHR_meshopt_compression"] {
                if let Some(compressed) = view.pointer_mut(&format!("/extensions/{extension}")) {
                    shift_view(compressed, &starts)?;
                }
            }
        }
        let mut images = json["images"].as_array().cloned().unwrap_or_default();
        for image in &mut images {
            let Some(uri) = image["uri"].as_str().map(str::to_owned) else { continue };
            let bytes = fs::read(folder.join(&uri)).ok()?;
            let start = append_aligned(&mut binary, &bytes);
            let views = json["bufferViews"].as_array_mut()?;
            views.push(json!({"buffer": 0, "byteOffset": start, "byteLength": bytes.len()}));
            let kind = if uri.ends_with("png") { "image/png" } else { "image/jpeg" };
            *image = json!({"bufferView": views.len() - 1, "mimeType": kind});
        }
        if !images.is_empty() {
            json["images"] = images.into();
        }
        json["buffers"] = json!([{"byteLength": binary.len()}]);
        Some(Self { file: encode_glb(json.to_string().as_bytes(), &binary), json, binary })
    }

    /// Returns the bytes in a range of the first buffer: `{"byteOffset": …, "byteLength": …}`.
    pub fn view_bytes(&self, view: &Value) -> Option<&[u8]> {
        let start = view["byteOffset"].as_u64().unwrap_or(0) as usize;
        let length = view["byteLength"].as_u64()? as usize;
        (view["buffer"].as_u64() == Some(0)).then(|| self.binary.get(start..)?.get(..length))?
    }
}

/// Appends a file and returns its offset, a multiple of 4.
fn append_aligned(binary: &mut Vec<u8>, file: &[u8]) -> usize {
    let start = binary.len().next_multiple_of(4);
    binary.resize(start, 0);
    binary.extend(file);
    start
}

/// Converts a view of one buffer into a view of the combined buffer.
fn shift_view(view: &mut Value, starts: &[usize]) -> Option<()> {
    let start = *starts.get(view["buffer"].as_u64()? as usize)?;
    let offset = view["byteOffset"].as_u64().unwrap_or(0);
    view["byteOffset"] = json!(offset + start as u64);
    view["buffer"] = json!(0);
    Some(())
}

/// Returns the JSON and the binary chunk of a valid binary file.
fn glb_chunks(file: &[u8]) -> Option<(&[u8], &[u8])> {
    let word = |at: usize| Some(u32::from_le_bytes(*file.get(at..)?.first_chunk()?) as usize);
    let json = file.starts_with(b"glTF").then(|| file.get(20..)?.get(..word(12)?))??;
    let rest = 20 + json.len();
    let binary = word(rest).and_then(|length| file.get(rest + 8..)?.get(..length));
    Some((json, binary.unwrap_or(&[])))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_packed_file_can_be_split_again() {
        let file = encode_glb(b"{\"asset\":{}}", &[1, 2, 3]);
        let (json, binary) = glb_chunks(&file).unwrap();
        assert_eq!((json, binary), (&b"{\"asset\":{}}"[..], &[1, 2, 3, 0][..]));
        assert_eq!(glb_chunks(b"{}"), None);
    }

    #[test]
    fn views_of_several_buffers_become_views_of_one() {
        let mut view = json!({"buffer": 1, "byteOffset": 2, "byteLength": 3});
        shift_view(&mut view, &[0, 40]).unwrap();
        assert_eq!(view, json!({"buffer": 0, "byteOffset": 42, "byteLength": 3}));
        assert_eq!(shift_view(&mut json!({"buffer": 2}), &[0, 40]), None);
    }
}
