//! The source of random numbers.
//!
//! This is splitmix64 (Steele, Lea, Flood 2014). Its state is a counter, so calls can be repeated.

/// The generator.
#[derive(Clone, Copy)]
pub struct Bits {
    state: u64,
}

impl Bits {
    pub fn new(seed: u64) -> Self {
        Self { state: seed }
    }

    /// Returns the next 64 bits.
    pub fn next(&mut self) -> u64 {
        self.state = self.state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        mixed(self.state)
    }

    /// Returns bits that depend on the state, without changing it, and differ from the next bits.
    pub fn peek(&self) -> u64 {
        mixed(self.state ^ 0x5bd1_e995)
    }
}

/// Computes the output function of splitmix64.
fn mixed(state: u64) -> u64 {
    let z = (state ^ (state >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}
