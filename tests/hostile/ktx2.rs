//! KTX2 images truncated or changed at every byte, and mutants of them with wrong numbers.

use crate::hostile::case::{Case, Expected};
use crate::hostile::images::textured_case;
use crate::hostile::mutants::{Random, mutate};

/// The total number of mutants of all images.
const MUTANTS: usize = 2_000;

/// ETC1S with alpha and with mip levels, and UASTC with and without Zstandard compression.
const IMAGES: [&[u8]; 4] = [
    include_bytes!("../../crates/gltf-import/tests/ktx2/etc1s.ktx2"),
    include_bytes!("../../crates/gltf-import/tests/ktx2/etc1s_opaque_mips.ktx2"),
    include_bytes!("../../crates/gltf-import/tests/ktx2/uastc.ktx2"),
    include_bytes!("../../crates/gltf-import/tests/ktx2/uastc_zstd.ktx2"),
];

/// Returns all KTX2 cases.
pub fn ktx2_cases() -> Vec<Case> {
    let mut cases = Vec::new();
    for (number, image) in IMAGES.into_iter().enumerate() {
        let mut add = |name: &str, image: &[u8], expected: Expected| {
            cases.push(textured_case(&format!("KTX2 {number} {name}"), image, expected));
        };
        add("whole", image, Expected::LoadsClean);
        for end in 0..image.len() {
            add(&format!("truncated at {end}"), &image[..end], Expected::Warned);
            let mut changed = image.to_vec();
            changed[end] ^= 0xFF;
            add(&format!("byte {end} changed"), &changed, Expected::Loads);
        }
        for (at, value) in (12..104).step_by(4).flat_map(|at| LYING_NUMBERS.map(|n| (at, n))) {
            let mut changed = image.to_vec();
            changed[at..at + 4].copy_from_slice(&value.to_le_bytes());
            add(&format!("{value} at {at}"), &changed, Expected::Loads);
        }
    }
    let others = IMAGES.map(<[u8]>::to_vec);
    for number in 0..MUTANTS {
        let mut random = Random::new(number as u64);
        let mut mutant = others[number % others.len()].clone();
        for _ in 0..=random.below(4) {
            mutate(&mut mutant, &others, &mut random);
        }
        let name = format!("KTX2 mutant {number}");
        cases.push(textured_case(&name, &mutant, Expected::Loads));
    }
    cases
}

/// Values for the header fields.
const LYING_NUMBERS: [u32; 8] = [0, 1, 2, 4096, 16_384, 65_536, i32::MAX as u32, u32::MAX];
