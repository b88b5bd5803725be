//! The inputs of a rendering: scene, textures, threads, stopwatch and monitor.

use super::mip_chains::Textures;
use crate::Timings;
use raster::{Monitor, Workers};
use scene::Scene;
use std::sync::Arc;

/// The inputs of a rendering, except the picture that it fills.
///
/// A context only borrows these inputs, so it is cheap to copy. Create one per picture, or per
/// frame of a sequence.
///
/// ```no_run
/// # use pipeline::{Origin, Picture, RenderContext, Renderer, Scene, Textures};
/// # let origin = Origin::from_model_path("model.glb".as_ref());
/// # let scene = Scene::resolve(&origin.0, &origin.1, &Default::default())?;
/// let textures = Textures::for_scene(&scene);
/// let context = RenderContext::new(&scene, &textures, 2);
/// let mut picture = Picture::<u8>::default();
/// let warnings = Renderer::default().render(&context, &mut picture)?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct RenderContext<'a> {
    /// The models, camera, lights and style.
    pub scene: &'a Scene,
    /// The mip chains of the scene's models. If the models are clones that are posed differently,
    /// use the chains of the original models.
    pub textures: &'a Textures<'a>,
    /// The maximum number of threads for rendering, at least 1. It does not change the result.
    pub threads: usize,
    /// The stopwatch for the stages.
    timings: Option<&'a Timings>,
    /// The monitor, which receives progress and may cancel the rendering.
    pub(super) monitor: Option<&'a Arc<dyn Monitor>>,
}

impl<'a> RenderContext<'a> {
    /// Creates a context that measures nothing and has no monitor.
    #[must_use]
    pub const fn new(scene: &'a Scene, textures: &'a Textures<'a>, threads: usize) -> Self {
        Self { scene, textures, threads, timings: None, monitor: None }
    }

    /// Adds the time of each stage to `timings`.
    #[must_use]
    pub const fn with_timings(self, timings: &'a Timings) -> Self {
        Self { timings: Some(timings), ..self }
    }

    /// Reports rendered pixels and drawn edges to `monitor`, and stops with
    /// [`RenderError::Canceled`](crate::RenderError::Canceled) when the monitor cancels. The
    /// picture is then incomplete. A [`CancelToken`](crate::CancelToken) is a monitor.
    #[must_use]
    pub const fn with_monitor(self, monitor: &'a Arc<dyn Monitor>) -> Self {
        Self { monitor: Some(monitor), ..self }
    }

    /// Returns the context for another scene of the same models, such as an inset.
    pub(super) fn with_scene<'b>(&self, scene: &'b Scene) -> RenderContext<'b>
    where
        'a: 'b,
    {
        RenderContext { scene, ..*self }
    }

    /// Returns the width and height of the whole picture in pixels.
    pub(super) const fn image_size(&self) -> [u32; 2] {
        [self.scene.image.width, self.scene.image.height]
    }

    /// Runs a stage, and adds its time to the stopwatch, if any.
    pub(super) fn measure<T>(&self, stage: &'static str, work: impl FnOnce() -> T) -> T {
        match self.timings {
            Some(timings) => timings.measure(stage, work),
            None => work(),
        }
    }

    /// Returns the stopwatch, or one that measures nothing if none was set.
    pub(super) fn timings(&self) -> Timings {
        self.timings.cloned().unwrap_or_default()
    }

    /// Returns the number of threads and the monitor.
    pub(super) fn workers(&self) -> Workers<'a> {
        Workers { threads: self.threads, monitor: self.monitor.map(|monitor| &**monitor as _) }
    }
}
