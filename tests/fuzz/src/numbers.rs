//! The fuzzer's bytes as numbers.

/// The remaining bytes, followed by zeros.
pub struct Numbers<'a>(pub &'a [u8]);

impl Numbers<'_> {
    /// Returns the next bytes.
    pub fn take<const N: usize>(&mut self) -> [u8; N] {
        let (now, later) = self.0.split_at(N.min(self.0.len()));
        self.0 = later;
        let mut bytes = [0; N];
        bytes[..now.len()].copy_from_slice(now);
        bytes
    }

    /// Returns the next byte.
    pub fn byte(&mut self) -> u8 {
        u8::from_le_bytes(self.take())
    }
}
