//! Which vector instructions a frame is drawn with.
//!
//! The processor decides at run time; the picture does not depend on it, for no instruction is used that rounds otherwise
//! than its scalar counterpart.

use fearless_simd::Level;
#[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
use fearless_simd::Simd;

/// A set of vector instructions that this processor has.
#[derive(Clone, Copy, Debug)]
pub struct SimdLevel {
    level: Level,
}

impl SimdLevel {
    /// The fastest that this processor has: what frames use unless told otherwise.
    ///
    /// That is AVX2 also where there is AVX-512: vectors of sixteen pay for the filling of large triangles alone, and what is
    /// done eight at a time, all of shading, takes a tenth to a third longer with them (`cargo xtask bench raster`).
    #[must_use]
    pub fn best() -> Self {
        let widest = Level::new();
        #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
        if let Some(avx2) = widest.as_avx2() {
            return Self { level: Level::Avx2(avx2) };
        }
        Self { level: widest }
    }

    /// Those that every processor has for which the program was built.
    #[must_use]
    pub const fn baseline() -> Self {
        Self { level: Level::baseline() }
    }

    /// All sets that this processor has, from the baseline to the widest.
    #[must_use]
    pub fn available() -> Vec<Self> {
        let widest = Level::new();
        let mut levels = vec![Level::baseline()];
        #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
        levels.extend(
            [
                widest.as_sse4_2().map(Level::Sse4_2),
                widest.as_avx2().map(Level::Avx2),
                widest.as_avx512().map(Level::Avx512),
            ]
            .into_iter()
            .flatten(),
        );
        #[cfg(not(any(target_arch = "x86", target_arch = "x86_64")))]
        levels.push(widest);
        levels.into_iter().map(|level| Self { level }).collect()
    }

    /// Does a piece of work, with vectors of eight where these instructions have them.
    ///
    /// It is compiled twice: for AVX2, and for what every processor has. Others would gain little and cost as much to compile.
    #[inline(never)]
    pub fn run_kernel<W: Kernel>(self, work: W) -> W::Output {
        #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
        if let Some(avx2) = self.level.as_avx2() {
            return avx2.vectorize(
                #[inline(always)]
                || work.run(),
            );
        }
        work.run()
    }

    pub(crate) const fn level(self) -> Level {
        self.level
    }
}

/// Work that is compiled once for each set of vector instructions, and called as a function: what is large, as shading is, need
/// not be made part of each loop that asks for it.
pub trait Kernel {
    /// What it gives.
    type Output;

    /// Does it. To be marked `#[inline(always)]`, with all that it calls, and written as plain loops over lanes.
    fn run(self) -> Self::Output;
}
