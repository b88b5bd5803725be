//! Which vector instructions a frame is drawn with.
//!
//! The processor decides at run time; the picture does not depend on it, for no instruction is used that rounds otherwise
//! than its scalar counterpart.

use fearless_simd::Level;

/// A set of vector instructions that this processor has.
#[derive(Clone, Copy, Debug)]
pub struct Instructions {
    level: Level,
}

impl Instructions {
    /// The widest that this processor has: what frames use unless told otherwise.
    #[must_use]
    pub fn best() -> Self {
        Self { level: Level::new() }
    }

    /// Those that every processor has for which the program was built.
    #[must_use]
    pub const fn baseline() -> Self {
        Self { level: Level::baseline() }
    }

    /// All sets that this processor has, from the baseline to the best.
    #[must_use]
    pub fn available() -> Vec<Self> {
        let best = Level::new();
        let mut levels = vec![Level::baseline()];
        #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
        levels.extend(
            [
                best.as_sse4_2().map(Level::Sse4_2),
                best.as_avx2().map(Level::Avx2),
                best.as_avx512().map(Level::Avx512),
            ]
            .into_iter()
            .flatten(),
        );
        #[cfg(not(any(target_arch = "x86", target_arch = "x86_64")))]
        levels.push(best);
        levels.into_iter().map(|level| Self { level }).collect()
    }

    pub(crate) const fn level(self) -> Level {
        self.level
    }
}
