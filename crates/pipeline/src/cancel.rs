//! Cancellation: ends a rendering early from another thread.
//!
//! The rasterizer polls the flag once per row of tiles, so that a cancelled picture costs at most a
//! few milliseconds more. Line drawings and shadow maps run to their end first.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// A flag that ends a rendering early. Clones share it: one goes into a
/// [`RenderContext`](crate::RenderContext), another stays with the thread that may cancel.
///
/// ```no_run
/// # use pipeline::{CancelToken, Picture, RenderContext, RenderError, Renderer, Scene, Textures};
/// # fn wait_for_the_window_to_close() {}
/// # fn draw(scene: &Scene) {
/// let cancel = CancelToken::default();
/// std::thread::scope(|scope| {
///     let work = scope.spawn(|| {
///         let textures = Textures::for_scene(scene);
///         let context = RenderContext::new(scene, &textures, 2).with_cancel(&cancel);
///         Renderer::default().render(&context, &mut Picture::<u8>::default())
///     });
///     wait_for_the_window_to_close();
///     cancel.cancel();
///     assert!(matches!(work.join(), Ok(Ok(_) | Err(RenderError::Cancelled))));
/// });
/// # }
/// ```
#[derive(Clone, Debug, Default)]
pub struct CancelToken(Arc<AtomicBool>);

impl CancelToken {
    /// Requests the end. Rendering stops within the time of a few rows of tiles; the request is
    /// permanent.
    pub fn cancel(&self) {
        // Relaxed: the flag orders nothing else, and a row of tiles more or less does not matter.
        self.0.store(true, Ordering::Relaxed);
    }

    /// Whether the end was requested.
    #[must_use]
    pub fn is_cancelled(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }

    /// The flag as the rasterizer polls it.
    pub(crate) fn stop_flag(&self) -> Arc<AtomicBool> {
        Arc::clone(&self.0)
    }
}
