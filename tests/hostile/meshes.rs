//! Mutants of small files of every format of meshes: bytes and numbers changed, parts left out,
//! repeated and exchanged.

use crate::case::{Case, Expected};

/// Mutants of each format.
const MUTANTS: usize = 2_000;

/// Formats with the file names that stand for them, and small files that the mutants are made of.
const FORMATS: [(&str, fn() -> Vec<Vec<u8>>); 2] =
    [("model.stl", stl_files), ("model.obj", obj_files)];

/// Words that readers might stumble over.
const WORDS: [&[u8]; 22] = [
    b"nan",
    b"-inf",
    b"1e999",
    b"-0",
    b"1e-46",
    b"3.5e38",
    b"0x10",
    b"4294967295",
    b"-1",
    b"99999999999999999999",
    b"\0",
    b"\r",
    b"\n",
    b"\\\n",
    b"\xFF\xFE",
    b"\xEF\xBB\xBF",
    b"/",
    b"#",
    b"solid",
    b"\xFF\xFF\xFF\xFF",
    b"\0\0\0\x80",
    b"\0\0\xC0\x7F",
];

pub fn mesh_cases() -> Vec<Case> {
    let mut cases = Vec::new();
    for (file_name, files) in FORMATS {
        let files = files();
        for (at, file) in files.iter().enumerate() {
            let case = Case::new(format!("{file_name} {at}"), file.clone(), Expected::Loads);
            cases.push(Case { file_name, ..case });
        }
        for number in 0..MUTANTS {
            let mut random = Random(number as u64);
            let file = &files[number % files.len()];
            let mut mutant = file.clone();
            for _ in 0..=random.below(4) {
                mutate(&mut mutant, &files, &mut random);
            }
            let name = format!("{file_name} mutant {number}");
            cases.push(Case { file_name, ..Case::new(name, mutant, Expected::Anything) });
        }
    }
    cases
}

/// A sequence of numbers that looks random (Knuth's linear congruence).
struct Random(u64);

impl Random {
    /// A number below a limit; 0 if that is 0.
    fn below(&mut self, limit: usize) -> usize {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) as usize % limit.max(1)
    }

    /// A part of some bytes, shorter than 64 of them.
    fn range(&mut self, length: usize) -> std::ops::Range<usize> {
        let start = self.below(length);
        start..(start + self.below(64)).min(length)
    }
}

/// Changes one place of a file.
fn mutate(file: &mut Vec<u8>, others: &[Vec<u8>], random: &mut Random) {
    let range = random.range(file.len());
    let at = range.start;
    match random.below(8) {
        0 => file.truncate(at),
        1 => drop(file.drain(range)),
        2 => {
            let part = file[range].to_vec();
            file.splice(at..at, part);
        }
        3 => {
            let other = &others[random.below(others.len())];
            let part = other[random.range(other.len())].to_vec();
            file.splice(range, part);
        }
        4 => {
            let word = WORDS[random.below(WORDS.len())];
            file.splice(at..at, word.iter().copied());
        }
        5 => {
            let word = WORDS[random.below(WORDS.len())];
            let end = (at + word.len()).min(file.len());
            file.splice(at..end, word.iter().copied());
        }
        6 => file.iter_mut().skip(at).take(1).for_each(|byte| *byte ^= 1 << random.below(8)),
        _ => file.iter_mut().skip(at).take(1).for_each(|byte| *byte = random.below(256) as u8),
    }
}

/// Two solids as text, and a binary file with colors of either convention.
fn stl_files() -> Vec<Vec<u8>> {
    let text = "solid a b\nfacet normal 0 0 1\n outer loop\n  vertex 0 0 0\n  vertex 1 0 0\n  \
                vertex 1 1e0 -0.0\n endloop\nendfacet\nendsolid a b\nsolid\nfacet normal 0 0 0\nouter \
                loop\nvertex 0 0 0\nvertex 1 1 0\nvertex 0 1 2.5e-3\nendloop\nendfacet\nendsolid\n";
    let binary = |header: &[u8], attributes: [u16; 3]| {
        let mut file = header.to_vec();
        file.resize(80, b' ');
        file.extend(3u32.to_le_bytes());
        for (at, attribute) in attributes.into_iter().enumerate() {
            let x = at as f32;
            let numbers = [0.0, 0.0, 1.0, 0.0, 0.0, x, 1.0, x, 0.0, 1.0, 1.0, -0.0];
            numbers.iter().for_each(|number: &f32| file.extend(number.to_le_bytes()));
            file.extend(attribute.to_le_bytes());
        }
        file
    };
    vec![
        text.as_bytes().to_vec(),
        binary(b"solid made by a program", [0, 0x801F, 0xFC00]),
        binary(b"COLOR=\x10\x20\x30\xFF", [0x8000, 31, 31 << 10]),
    ]
}

/// Every statement that is read, faces of all kinds of references, and a cloud of points.
fn obj_files() -> Vec<Vec<u8>> {
    let text = "# two squares\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0 \nv 0.5 0.25 0 1\nvt 0 0\nvt 1 0 0\n\
                vn 0 0 1\no first thing\ng a b\nusemtl red\ns 1\nf 1/1/1 2/2/1 3//1 -1\ns off\n\
                f -5/-2 -4/-1 -3/1 \\\n-2/2\nl 1 2 3\np 1 2\ng\nf 1 2 3 4 1 2 3\nvp 1 2\n";
    let colors =
        "mtllib none.mtl\r\nv 0 0 0 1 0 0\r\nv 1 0 1e-3 0 1 0 0.5\r\nv 1 1 0\r\nf 1 2 3\r\n";
    let points = "v 0 0 0\nv 1 2 3\nv -1 +2. .5\n";
    [text, colors, points].map(|text| text.as_bytes().to_vec()).to_vec()
}
