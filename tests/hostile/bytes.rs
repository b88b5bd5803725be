//! Files truncated at every byte, and files with one byte changed.

use crate::hostile::case::{Case, Expected};
use alberti_tests::gltf::Document;

pub fn byte_cases() -> Vec<Case> {
    let mut cases = Vec::new();
    let whole = Document::single_triangle().to_glb();
    for end in 0..whole.len() {
        cases.push(Case::new(
            format!("glb truncated at {end}"),
            whole[..end].to_vec(),
            Expected::Refused,
        ));
        let mut shorter = whole[..end].to_vec();
        if let Some(length) = shorter.get_mut(8..12) {
            length.copy_from_slice(&(end as u32).to_le_bytes());
            // A file that ends after its first chunk is complete, but has no data.
            let ends_well = end == 20 + u32::from_le_bytes([whole[12], whole[13], 0, 0]) as usize;
            let expected = if ends_well { Expected::Warned } else { Expected::Refused };
            cases.push(Case::new(
                format!("glb truncated and repaired at {end}"),
                shorter,
                expected,
            ));
        }
    }
    for at in 0..whole.len() {
        for change in [0x01, 0x80, 0xFF] {
            let mut changed = whole.clone();
            changed[at] ^= change;
            cases.push(Case::new(
                format!("glb byte {at} xor {change:#x}"),
                changed,
                Expected::Anything,
            ));
        }
    }
    let text = Document::single_triangle().json.to_string().into_bytes();
    for end in 0..text.len() {
        cases.push(Case::new(
            format!("gltf truncated at {end}"),
            text[..end].to_vec(),
            Expected::Refused,
        ));
    }
    cases
}
