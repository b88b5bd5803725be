//! Random numbers for the scenes: splitmix64 (Steele, Lea, Flood 2014).

/// The generator.
pub struct Random {
    state: u64,
}

impl Random {
    /// Creates the generator for a scene number.
    pub fn new(seed: u64) -> Self {
        Self { state: seed.wrapping_mul(0xd134_2543_de82_ef95) }
    }

    /// Returns the next 64 bits.
    fn next_bits(&mut self) -> u64 {
        self.state = self.state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.state ^ (self.state >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Returns an integer from 0 up to but not including `end`.
    pub fn below(&mut self, end: u64) -> u64 {
        self.next_bits() % end
    }

    /// Returns a number in the interval, with three decimals as in a handwritten file.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        let fraction = (self.next_bits() >> 11) as f64 / (1_u64 << 53) as f64;
        libm::round((low + (high - low) * fraction) * 1000.0) / 1000.0
    }

    /// Returns true once in `times` calls on average.
    pub fn once_in(&mut self, times: u64) -> bool {
        self.below(times) == 0
    }

    /// Returns one of the options.
    pub fn choose<T: Clone>(&mut self, choices: &[T]) -> T {
        choices[self.below(choices.len() as u64) as usize].clone()
    }
}
