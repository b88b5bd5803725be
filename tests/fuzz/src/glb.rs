//! Binary glTF files: taken apart where a mutation has spoilt their lengths, and put together.

/// The JSON and the binary chunk of a file, or of a JSON text alone. Declared lengths are not believed: the second chunk is
/// where its name is.
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

/// A file of two chunks.
pub fn glb(json: &[u8], bytes: &[u8]) -> Vec<u8> {
    let mut file = b"glTF\x02\0\0\0\0\0\0\0".to_vec();
    for (kind, filler, data) in [(b"JSON", b' ', json), (b"BIN\0", 0, bytes)] {
        let length = data.len().next_multiple_of(4);
        file.extend((length as u32).to_le_bytes());
        file.extend(kind);
        file.extend(data);
        file.resize(file.len() + length - data.len(), filler);
    }
    let length = (file.len() as u32).to_le_bytes();
    file[8..12].copy_from_slice(&length);
    file
}
