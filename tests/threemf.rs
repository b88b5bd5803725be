//! One-part 3MF files, for tests.

/// Returns a 3MF file: a zip archive with an uncompressed model part.
#[must_use]
pub fn encode_3mf(part: &[u8]) -> Vec<u8> {
    let name = b"3D/3dmodel.model";
    let length = (part.len() as u32).to_le_bytes();
    let checksum = checksum(part).to_le_bytes();
    let sizes = [&checksum[..], &length, &length, &[name.len() as u8, 0, 0, 0]].concat();
    let mut file = [&b"PK\x03\x04\x14\0\0\0\0\0\0\0\0\0"[..], &sizes, name, part].concat();
    let directory = file.len() as u32;
    file.extend([&b"PK\x01\x02\x14\0\x14\0\0\0\0\0\0\0\0\0"[..], &sizes, &[0; 14], name].concat());
    let size = file.len() as u32 - directory;
    file.extend(b"PK\x05\x06\0\0\0\0\x01\0\x01\0");
    file.extend([size.to_le_bytes(), directory.to_le_bytes()].concat());
    file.extend([0, 0]);
    file
}

/// Returns the checksum (CRC) used in zip archives, with the reflected polynomial 0xEDB88320.
fn checksum(bytes: &[u8]) -> u32 {
    let step = |crc: u32, _| if crc & 1 == 1 { crc >> 1 ^ 0xEDB8_8320 } else { crc >> 1 };
    !bytes.iter().fold(!0, |crc, &byte| (0..8).fold(crc ^ u32::from(byte), step))
}
