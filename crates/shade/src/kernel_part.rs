//! Kernel parts: functions into which shading is split so that it compiles faster.
//!
//! Everything that a kernel calls is inlined into it, and LLVM's compile time grows faster than
//! linearly with the size of a function. A part is compiled separately, with the kernel's
//! instruction set. This does not slow down rendering, because a part is called once for eight
//! fragments.

/// Runs a part of shading for one fragment, without inlining.
#[inline(never)]
pub(crate) fn run_scalar_part<R>(part: impl FnOnce() -> R) -> R {
    part()
}

/// Evaluates an expression in a kernel with `N` lanes as a separate function.
macro_rules! kernel_part {
    ($lanes:expr, $part:expr) => {
        if const { $lanes == 1 } {
            $crate::kernel_part::run_scalar_part(
                #[inline(always)]
                || $part,
            )
        } else {
            raster::SimdLevel::run_part(
                #[inline(always)]
                || $part,
            )
        }
    };
}
pub(crate) use kernel_part;
