//! Splits binary glTF files into chunks, even if a mutation has corrupted the lengths, and joins
//! them again.

#[path = "../../../scenes/generator/src/glb.rs"]
mod write;

pub use write::encode_glb as glb;

/// Returns the JSON and the binary chunk of a file, which may also be plain JSON. Declared lengths
/// are not trusted: the second chunk is found by its name.
pub fn parts(file: &[u8]) -> (&[u8], &[u8]) {
    if !file.starts_with(b"glTF") || file.len() < 20 {
        return (file, &[]);
    }
    let body = &file[20..];
    match body.windows(4).position(|word| word == b"BIN\0") {
        Some(at) => (&body[..at.saturating_sub(4)], &body[at + 4..]),
        None => (body, &[]),
    }
}
