//! SIMD dispatch: selects at run time the vector instructions for drawing a frame.
//!
//! There are two levels: the baseline for which the program was built (SSE2 on x86-64, NEON on ARM)
//! and AVX2. Each hot loop is compiled once per level. The picture does not depend on the level.
//! Every operation is exact or correctly rounded (no fused multiply-add, no approximate
//! reciprocal), so each lane computes the same bits as scalar code.
//!
//! On x86, shading is compiled only for AVX2 ([`SimdLevel::run_wide_kernel`]); without it,
//! fragments are shaded one by one.
//!
//! More levels were tried and rejected. SSE4.2 saves little over SSE2 here and adds a third to the
//! compiled code. AVX-512 pays off only for filling large triangles; shading, which is eight lanes
//! wide, takes a tenth to a third longer with it (`cargo xtask bench raster`).

use fearless_simd::Level;
#[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
use fearless_simd::Simd;

/// A set of vector instructions that this processor supports.
#[derive(Clone, Copy, Debug)]
pub struct SimdLevel {
    level: Level,
}

impl SimdLevel {
    /// Returns the fastest level that this processor supports, the default for frames.
    #[must_use]
    pub fn best() -> Self {
        #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
        if let Some(avx2) = Level::new().as_avx2() {
            return Self { level: Level::Avx2(avx2) };
        }
        Self::baseline()
    }

    /// Returns the baseline level, which every processor that can run the program supports.
    #[must_use]
    pub const fn baseline() -> Self {
        Self { level: Level::baseline() }
    }

    /// Returns all levels that this processor supports: the baseline, and AVX2 if available.
    #[must_use]
    pub fn available() -> Vec<Self> {
        let baseline = Self::baseline();
        #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
        if let Some(avx2) = Level::new().as_avx2() {
            return vec![baseline, Self { level: Level::Avx2(avx2) }];
        }
        vec![baseline]
    }

    /// Runs a kernel compiled for these instructions.
    ///
    /// Every kernel is compiled twice: for AVX2 and for the baseline. The call is not inlined, so
    /// large kernels such as shading are compiled once per level rather than in every loop that
    /// runs them.
    #[inline(never)]
    pub fn run_kernel<K: Kernel>(self, kernel: K) -> K::Output {
        #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
        if let Some(avx2) = self.level.as_avx2() {
            return avx2.vectorize(
                #[inline(always)]
                || kernel.run(),
            );
        }
        kernel.run()
    }

    /// Runs a kernel that has no SSE2 copy. On x86, this requires AVX2; without it, the method
    /// returns `None`. On other processors, the kernel always runs.
    ///
    /// Use it for kernels so large that a second copy is not worthwhile for the few processors
    /// without AVX2. If the result is `None`, callers continue fragment by fragment and get the
    /// same bits.
    #[inline(always)]
    pub fn run_wide_kernel<K: Kernel>(self, kernel: K) -> Option<K::Output> {
        #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
        return self.level.as_avx2().map(|avx2| {
            avx2.vectorize(
                #[inline(always)]
                || kernel.run(),
            )
        });
        #[cfg(not(any(target_arch = "x86", target_arch = "x86_64")))]
        Some(self.run_kernel(kernel))
    }

    /// Runs part of a wide kernel as a separate function that uses the kernel's instructions.
    ///
    /// A kernel is one function with all its calls inlined, and LLVM's compile time grows faster
    /// than the size of a function. Divided into a dozen parts, shading compiles in half the time.
    /// Call this only inside [`run_wide_kernel`](Self::run_wide_kernel).
    ///
    /// # Panics
    /// Panics on x86 processors without AVX2, which do not run wide kernels.
    #[inline(always)]
    pub fn run_part<R>(part: impl FnOnce() -> R) -> R {
        #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
        return match Level::new().as_avx2() {
            Some(avx2) => avx2.vectorize(part),
            None => unreachable!("wide kernels run only with AVX2"),
        };
        #[cfg(not(any(target_arch = "x86", target_arch = "x86_64")))]
        run_apart(part)
    }

    pub(crate) const fn level(self) -> Level {
        self.level
    }
}

/// Runs part of a kernel without inlining it.
#[cfg(not(any(target_arch = "x86", target_arch = "x86_64")))]
#[inline(never)]
fn run_apart<R>(part: impl FnOnce() -> R) -> R {
    part()
}

/// A computation compiled once for each SIMD level: see [`SimdLevel::run_kernel`].
pub trait Kernel {
    /// The result of the computation.
    type Output;

    /// Runs the computation.
    ///
    /// Mark it and every function that it calls `#[inline(always)]`, and write it as plain loops
    /// over lanes: only code inlined into the dispatched function is compiled for its instructions.
    fn run(self) -> Self::Output;
}

/// Runs an expression with the SIMD token of a level, like `fearless_simd::dispatch`, but compiled
/// only for the two levels of [`SimdLevel`].
#[cfg(all(any(target_arch = "x86", target_arch = "x86_64"), target_feature = "sse2"))]
macro_rules! dispatch {
    ($level:expr, $simd:pat => $op:expr) => {{
        let level: fearless_simd::Level = $level;
        if let Some(avx2) = level.as_avx2() {
            let $simd = avx2;
            fearless_simd::Simd::vectorize(
                avx2,
                #[inline(always)]
                || $op,
            )
        } else if let Some(sse2) = level.as_sse2() {
            let $simd = sse2;
            fearless_simd::Simd::vectorize(
                sse2,
                #[inline(always)]
                || $op,
            )
        } else {
            unreachable!("the target is built with SSE2")
        }
    }};
}
#[cfg(not(all(any(target_arch = "x86", target_arch = "x86_64"), target_feature = "sse2")))]
macro_rules! dispatch {
    ($level:expr, $simd:pat => $op:expr) => {
        fearless_simd::dispatch!($level, $simd => $op)
    };
}
pub(crate) use dispatch;
