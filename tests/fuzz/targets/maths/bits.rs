//! The source of numbers: the fuzzer's bytes, followed by zeros.

/// The number of words, which is more than the longest call needs.
const WORDS: usize = 64;

/// The remaining bytes, eight at a time.
#[derive(Clone, Copy)]
pub struct Bits {
    mood: u8,
    words: [u64; WORDS],
    at: usize,
}

impl Bits {
    /// Creates the source. The first byte selects the mood of the call.
    pub fn of(bytes: &[u8]) -> Self {
        let (&mood, bytes) = bytes.split_first().unwrap_or((&0, &[]));
        let mut words = [0; WORDS];
        for (word, chunk) in words.iter_mut().zip(bytes.chunks(8)) {
            let mut eight = [0; 8];
            eight[..chunk.len()].copy_from_slice(chunk);
            *word = u64::from_le_bytes(eight);
        }
        Self { mood, words, at: 0 }
    }

    /// Returns the next 64 bits.
    pub fn next(&mut self) -> u64 {
        let word = self.words.get(self.at).copied().unwrap_or(0);
        self.at += 1;
        word
    }

    /// Returns bits that differ from all later bits.
    pub fn peek(&self) -> u64 {
        self.mood.into()
    }
}
