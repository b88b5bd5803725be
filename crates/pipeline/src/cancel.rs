//! Cancellation and progress: the monitors of a rendering.
//!
//! The rasterizer polls its monitor once per row of tiles, so it stops within a few milliseconds.
//! Hidden-line removal polls it every few hundred edges. Shadow maps always run to completion.

use raster::Monitor;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// A flag that stops a rendering early. Clones share the flag: pass one to a
/// [`RenderContext`](crate::RenderContext) as its monitor, and keep another in the thread that may
/// cancel.
///
/// ```no_run
/// # use pipeline::{CancelToken, Monitor, Picture, RenderContext, RenderError, Renderer, Scene, Textures};
/// # use std::sync::Arc;
/// # fn wait_for_the_window_to_close() {}
/// # fn draw(scene: &Scene) {
/// let cancel = CancelToken::default();
/// let monitor: Arc<dyn Monitor> = Arc::new(cancel.clone());
/// std::thread::scope(|scope| {
///     let work = scope.spawn(|| {
///         let textures = Textures::for_scene(scene);
///         let context = RenderContext::new(scene, &textures, 2).with_monitor(&monitor);
///         Renderer::default().render(&context, &mut Picture::<u8>::default())
///     });
///     wait_for_the_window_to_close();
///     cancel.cancel();
///     assert!(matches!(work.join(), Ok(Ok(_) | Err(RenderError::Canceled))));
/// });
/// # }
/// ```
#[derive(Clone, Debug, Default)]
pub struct CancelToken(Arc<AtomicBool>);

impl CancelToken {
    /// Requests cancellation. Rendering stops within a few rows of tiles. A request cannot be
    /// withdrawn.
    pub fn cancel(&self) {
        // Relaxed: the flag does not order other memory accesses, and an extra row of tiles does
        // not matter.
        self.0.store(true, Ordering::Relaxed);
    }

    /// Whether cancellation was requested.
    #[must_use]
    pub fn is_canceled(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}

impl Monitor for CancelToken {
    fn is_canceled(&self) -> bool {
        Self::is_canceled(self)
    }
}

/// A monitor that can cancel part of the work but does not receive its progress.
#[derive(Debug)]
pub(crate) struct CancelOnly(pub(crate) Arc<dyn Monitor>);

impl Monitor for CancelOnly {
    fn is_canceled(&self) -> bool {
        self.0.is_canceled()
    }
}

/// The monitor of one frame, which adds the frame's progress to the progress of the whole job.
#[derive(Debug)]
pub(crate) struct PartMonitor {
    /// The monitor of the whole job.
    pub(crate) outer: Arc<dyn Monitor>,
    /// The number of pixels completed before this frame.
    pub(crate) done: u64,
    /// The number of pixels in this frame.
    pub(crate) pixels: u64,
    /// The number of pixels in the whole job.
    pub(crate) total: u64,
}

impl Monitor for PartMonitor {
    fn is_canceled(&self) -> bool {
        self.outer.is_canceled()
    }

    fn report_progress(&self, done: u64, total: u64) {
        self.outer.report_progress(self.done + self.pixels * done / total, self.total);
    }
}
