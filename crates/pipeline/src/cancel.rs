//! Stopping a picture that nobody waits for any more.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// A wish that work end early. Its copies are one wish: one is given to a [`Renderer`](crate::Renderer), another is kept.
///
/// ```no_run
/// # use pipeline::{Cancel, Picture, RenderError, Renderer, Scene, Textures, Timings};
/// # fn wait_for_the_window_to_close() {}
/// # fn draw(scene: &Scene) {
/// let cancel = Cancel::default();
/// let mut renderer = Renderer::default().cancelled_by(cancel.clone());
/// std::thread::scope(|scope| {
///     let work = scope.spawn(move || {
///         let textures = Textures::of(&scene.models);
///         renderer.render(scene, &textures, 2, &Timings::default(), &mut Picture::<u8>::default())
///     });
///     wait_for_the_window_to_close();
///     cancel.cancel();
///     assert!(matches!(work.join(), Ok(Ok(()) | Err(RenderError::Cancelled))));
/// });
/// # }
/// ```
#[derive(Clone, Debug, Default)]
pub struct CancelToken(Arc<AtomicBool>);

impl CancelToken {
    /// Asks for the end. Work ends within the time that a few rows of tiles take, and the wish stays.
    pub fn cancel(&self) {
        self.0.store(true, Ordering::Relaxed);
    }

    /// Whether the end was asked for.
    #[must_use]
    pub fn is_cancelled(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }

    /// What drawing looks at.
    pub(crate) fn stop_flag(&self) -> Arc<AtomicBool> {
        Arc::clone(&self.0)
    }
}
