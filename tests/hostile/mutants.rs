//! Mutants of files, with changed bytes and numbers, and with removed, repeated and swapped parts.

/// Words that may trip up readers.
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

/// A pseudorandom sequence (Knuth's linear congruential generator).
pub struct Random(u64);

impl Random {
    /// Creates the sequence with this seed.
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// Returns a number below a limit, or 0 if the limit is 0.
    pub fn below(&mut self, limit: usize) -> usize {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) as usize % limit.max(1)
    }

    /// Returns a random range within the bytes, shorter than 64.
    fn range(&mut self, length: usize) -> std::ops::Range<usize> {
        let start = self.below(length);
        start..(start + self.below(64)).min(length)
    }
}

/// Changes a file at one position.
pub fn mutate(file: &mut Vec<u8>, others: &[Vec<u8>], random: &mut Random) {
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
