//! The binary glTF container, for the scene models and for the files that tests and fuzzers build.

/// Encodes a `.glb` file: header, JSON chunk, binary chunk, both padded to a multiple of four bytes
/// (glTF 2.0, §4.4).
#[must_use]
pub fn encode_glb(json: &[u8], bytes: &[u8]) -> Vec<u8> {
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
