//! Parts of kernels: where shading is cut in functions, so that it compiles sooner.
//!
//! All that a kernel calls is inlined into it, and the time that LLVM takes for one function grows
//! faster than the function does. A part is compiled by itself, with the instructions of the kernel;
//! a picture takes no longer for it, because a part is called once for eight fragments.

/// Runs one fragment's part of shading, not inlined.
#[inline(never)]
pub(crate) fn run_scalar_part<R>(part: impl FnOnce() -> R) -> R {
    part()
}

/// Evaluates an expression of a kernel of `N` lanes in a function by itself.
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
