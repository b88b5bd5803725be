//! Frame sequences: turntables and animations. Several frames are rendered at a time and delivered
//! in order.
//!
//! ```text
//!  motion ─► frame 0, 1, 2 … ─► one worker per thread ─► reorder queue ─► files, APNG, GIF, a pipe
//! ```
//! Models are loaded, and mip chains are built, only once. Each worker poses a separate copy of the
//! models and reuses the buffers of its last frame; frames, not tiles, run in parallel.

use crate::Picture;
use crate::render::{RenderContext, RenderError, Renderer, Textures};
use camera::ViewProjection;
use homog::{Affine, Point, World};
use model::Model;
use model::ModelInstance;
use scene::{CameraPath, FileAccess, Origin, ResolveError, Scene};
use scene_file::SceneFile;
use scene_file::file::{CameraFile, ViewFile};
use std::collections::BTreeMap;
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};

/// The motion of a sequence.
///
/// Frame i of n shows the motion at the fraction i / n. The end of the motion would be frame n,
/// which is not rendered, so a full turn or a looping animation repeats without a duplicate frame.
#[derive(Clone, PartialEq, Debug)]
pub enum Motion {
    /// The models rotate about the vertical axis through the center of their bounding box:
    /// counterclockwise seen from above, at constant speed.
    Turntable {
        /// The total angle in radians; 2π for a full turn.
        angle: f64,
    },
    /// The models follow their glTF animations.
    Animations {
        /// The index of the animation for each model of the scene; `None` means that the model does
        /// not move.
        animations: Vec<Option<usize>>,
        /// The time of the first frame in seconds.
        from: f64,
        /// The time in seconds of the frame that would follow the last.
        to: f64,
    },
}

/// A frame sequence, ready to render.
///
/// It is immutable while it renders, because workers share it by reference.
#[derive(Debug)]
pub struct Sequence {
    /// The source of the scene, for error messages.
    origin: Origin,
    /// The description, used to resolve the camera, lights and ground of each frame.
    file: SceneFile,
    /// The scene at the start of the motion, with the views that are the same in all frames.
    scene: Scene,
    /// The motion of the models.
    motion: Motion,
    /// The number of frames.
    frame_count: usize,
    /// The point that a turntable's axis passes through.
    pivot: Point<World>,
    /// The camera of each frame if the camera moves; otherwise empty, and the scene's camera
    /// applies to all frames.
    view_projections: Vec<ViewProjection>,
}

/// The reason why a sequence could not be completed.
///
/// `E` is the error from the function that receives the frames, such as an encoder's I/O error.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SequenceError<E> {
    /// A frame cannot be rendered.
    #[error(transparent)]
    Render(#[from] RenderError),
    /// The scene is invalid at the time of a frame.
    #[error(transparent)]
    Scene(#[from] ResolveError),
    /// The function that receives the frames failed.
    #[error("{0}")]
    Output(E),
}

/// The number of moments in the motion that an automatic camera is fitted to.
///
/// A turntable with 16 samples misses the maximum extent of a corner by at most 1 − cos(π/16),
/// which is 2% of the corner's radius.
const FRAMING_SAMPLES: usize = 16;
/// The number of frames per worker that may be started before the oldest frame is delivered. It
/// limits the memory for frames that finish out of order.
///
/// With w workers, at most 2 w pictures exist at a time, however long the sequence is.
const FRAMES_AHEAD: usize = 2;

impl Sequence {
    /// Prepares a sequence of `frames` pictures for the scene that `file` describes. An automatic
    /// camera is fitted to the whole motion.
    ///
    /// Each frame is resolved like a single picture at that time, so the models' lights and cameras
    /// and the ground follow the models. Only an automatic view is shared by the whole motion: it
    /// is resolved as if the models at all 16 moments existed at once.
    ///
    /// # Errors
    /// Returns an error if the scene cannot be framed.
    pub fn new(
        origin: &Origin,
        file: &SceneFile,
        scene: Scene,
        motion: Motion,
        frames: usize,
    ) -> Result<Self, ResolveError> {
        let middle = bounds_center(&model::world_points(&scene.models));
        let mut sequence = Self {
            origin: origin.clone(),
            file: file.clone(),
            scene,
            motion,
            frame_count: frames,
            pivot: middle,
            view_projections: Vec::new(),
        };
        let is_view_kept = |index| sequence.keeps_view(index);
        if !(0..=sequence.scene.insets.len()).any(is_view_kept) {
            return Ok(sequence);
        }
        let sampled_models = (0..FRAMING_SAMPLES)
            .flat_map(|at| sequence.models_at_fraction(at as f64 / FRAMING_SAMPLES as f64));
        let access = FileAccess::Loaded(&sequence.scene);
        let framed =
            Scene::resolve_posed(origin, file, &sampled_models.collect::<Vec<_>>(), access)?;
        sequence.scene.view_projection = framed.view_projection;
        for (inset, framed) in sequence.scene.insets.iter_mut().zip(framed.insets) {
            inset.scene.view_projection = framed.scene.view_projection;
        }
        Ok(sequence)
    }

    /// Returns whether a view is the same in all frames. View 0 is the picture; the insets are
    /// views 1 and up. An automatic view stays the same and, in a turntable, so does a camera of
    /// the model, which would otherwise turn with the model.
    fn keeps_view(&self, index: usize) -> bool {
        let own = index.checked_sub(1).and_then(|inset| self.file.viewports.get(inset));
        let camera: &CameraFile =
            own.and_then(|viewport| viewport.camera.as_ref()).unwrap_or(&self.file.camera);
        match camera.view {
            ViewFile::Frame { .. } => true,
            ViewFile::FromModel(..) => matches!(self.motion, Motion::Turntable { .. }),
            _ => false,
        }
    }

    /// Moves the camera along a path between two times in seconds. Insets keep their cameras.
    ///
    /// The view for each frame is computed before rendering starts, so errors are reported early.
    /// Automatic views use the models at 16 moments, or at one moment if they do not move.
    ///
    /// # Errors
    /// Returns an error if the view is undefined at any time, for example because the eye coincides
    /// with its target.
    pub fn with_camera_path(
        mut self,
        origin: &Origin,
        path: &CameraPath,
        [from, to]: [f64; 2],
    ) -> Result<Self, ResolveError> {
        let sampled_models = (0..FRAMING_SAMPLES)
            .flat_map(|at| self.models_at_fraction(at as f64 / FRAMING_SAMPLES as f64));
        let models: Vec<ModelInstance> = if self.motion.is_still() {
            self.scene.models.clone()
        } else {
            sampled_models.collect()
        };
        let view_projection = |frame: usize| {
            let fraction = frame as f64 / self.frame_count.max(1) as f64;
            path.view_projection_at(
                origin,
                from + (to - from) * fraction,
                &models,
                self.scene.image,
            )
        };
        self.view_projections =
            (0..self.frame_count).map(view_projection).collect::<Result<Vec<_>, _>>()?;
        Ok(self)
    }

    /// Returns the number of frames.
    #[must_use]
    pub const fn frame_count(&self) -> usize {
        self.frame_count
    }

    /// Returns the width and height of each frame in pixels.
    #[must_use]
    pub const fn image_size(&self) -> (u32, u32) {
        (self.scene.image.width, self.scene.image.height)
    }

    /// Returns whether the background, and therefore every frame, is opaque.
    #[must_use]
    pub fn is_opaque(&self) -> bool {
        self.scene.has_opaque_background()
    }

    /// Renders all frames with up to `threads` workers and passes them to `sink` in order, on the
    /// calling thread. The number of threads does not change a frame.
    ///
    /// ```text
    ///  workers:  start frame ─► render ─► finished[frame]     at most FRAMES_AHEAD · w ahead
    ///  caller:   wait for finished[next] ─► delivered += 1 ─► sink
    /// ```
    /// Each frame is rendered on one thread. Parallel frames scale better than parallel tiles,
    /// because no stage is serial. The sink runs without holding the lock and may block, for
    /// example on a pipe; the workers then stop at the limit. A poisoned lock is acquired anyway,
    /// because the queue is consistent after every statement.
    ///
    /// # Errors
    /// Returns an error if a frame cannot be rendered, or if the sink fails. In either case no more
    /// frames are started.
    pub fn render_frames<E>(
        &self,
        threads: usize,
        mut sink: impl FnMut(usize, &Picture) -> Result<(), E>,
    ) -> Result<(), SequenceError<E>> {
        let textures = Textures::for_scene(&self.scene);
        let (queue, progress) = (Mutex::new(Queue::default()), Condvar::new());
        let workers = threads.clamp(1, self.frame_count.max(1));
        let lock = || queue.lock().unwrap_or_else(PoisonError::into_inner);
        let work = || {
            let mut worker = FrameWorker::new(self);
            while let Some(frame) =
                next_frame(lock(), &progress, self.frame_count, FRAMES_AHEAD * workers)
            {
                let picture = worker.render_frame(frame, &textures);
                lock().finished.insert(frame, picture);
                progress.notify_all();
            }
        };
        std::thread::scope(|scope| {
            for _ in 0..workers {
                scope.spawn(work);
            }
            let result = self.deliver_frames(&lock, &progress, &mut sink);
            if result.is_err() {
                // Workers stop as if all frames were started.
                lock().started = self.frame_count;
                progress.notify_all();
            }
            result
        })
    }

    /// Waits for each frame in order and delivers it.
    ///
    /// `delivered` is advanced before the sink runs, so that a slow sink does not stall workers. On
    /// an error the caller marks all frames as started, which ends the workers after their current
    /// frame.
    fn deliver_frames<'a, E>(
        &self,
        lock: &impl Fn() -> MutexGuard<'a, Queue>,
        progress: &Condvar,
        sink: &mut impl FnMut(usize, &Picture) -> Result<(), E>,
    ) -> Result<(), SequenceError<E>> {
        for frame in 0..self.frame_count {
            let mut queue = lock();
            let picture = loop {
                if let Some(picture) = queue.finished.remove(&frame) {
                    break picture;
                }
                queue = progress.wait(queue).unwrap_or_else(PoisonError::into_inner);
            };
            queue.delivered = frame + 1;
            drop(queue);
            progress.notify_all();
            let picture = picture.map_err(|error| match error {
                FrameError::Render(error) => SequenceError::Render(error),
                FrameError::Scene(error) => SequenceError::Scene(error),
            })?;
            sink(frame, &picture).map_err(SequenceError::Output)?;
        }
        Ok(())
    }

    /// Returns the models at a fraction of the motion, from 0 to 1.
    fn models_at_fraction(&self, fraction: f64) -> Vec<ModelInstance> {
        let mut models = self.scene.models.clone();
        self.motion.pose_models(&mut models, &self.scene.models, self.pivot, fraction);
        models
    }
}

/// The reason why a frame cannot be rendered.
#[derive(Debug, thiserror::Error)]
enum FrameError {
    #[error(transparent)]
    Render(#[from] RenderError),
    #[error(transparent)]
    Scene(#[from] ResolveError),
}

/// The frames that are started but not yet delivered.
#[derive(Default)]
struct Queue {
    /// The next frame to start; equal to the frame count if all are started or the sequence is
    /// aborted.
    started: usize,
    /// The next frame to deliver.
    delivered: usize,
    /// Rendered frames that wait for earlier frames, by index.
    finished: BTreeMap<usize, Result<Picture, FrameError>>,
}

/// Waits until the next frame is at most `ahead` frames beyond the last delivered frame, and starts
/// it. Returns `None` if all frames are started.
///
/// The condition variable is notified on every delivery and when the sequence is aborted. The loop
/// tolerates spurious wakeups.
fn next_frame(
    mut queue: MutexGuard<'_, Queue>,
    progress: &Condvar,
    frames: usize,
    ahead: usize,
) -> Option<usize> {
    loop {
        if queue.started >= frames {
            return None;
        }
        if queue.started < queue.delivered + ahead {
            queue.started += 1;
            return Some(queue.started - 1);
        }
        queue = progress.wait(queue).unwrap_or_else(PoisonError::into_inner);
    }
}

/// The state of one thread: a scene with separate models, and the buffers of its last frame.
///
/// Copies of the scene are cheap: models, images and the environment are shared through `Arc`s
/// until models are posed.
struct FrameWorker<'a> {
    /// The sequence, whose scene stays unposed.
    sequence: &'a Sequence,
    scene: Scene,
    /// The renderer, whose buffers are reused from frame to frame.
    renderer: Renderer,
}

impl<'a> FrameWorker<'a> {
    /// Creates a worker with copies of the models that animations pose. Instances of a model share
    /// one copy, and all copies share the images.
    ///
    /// A turntable changes only `model_to_world` and needs no copies.
    fn new(sequence: &'a Sequence) -> Self {
        let mut scene = sequence.scene.clone();
        if matches!(sequence.motion, Motion::Animations { .. }) {
            let shared = shared_models(&sequence.scene.models);
            for instance in &mut scene.models {
                instance.model = Arc::new(Model::clone(&instance.model));
            }
            for (index, first) in shared {
                scene.models[index].model = Arc::clone(&scene.models[first].model);
            }
        }
        Self { sequence, scene, renderer: Renderer::default() }
    }

    /// Poses the models for a frame and renders it on this thread.
    ///
    /// Insets show the models in the same pose as the main view.
    fn render_frame(
        &mut self,
        frame: usize,
        textures: &Textures<'_>,
    ) -> Result<Picture, FrameError> {
        let Sequence { origin, file, scene, motion, frame_count, pivot, view_projections } =
            self.sequence;
        let fraction = frame as f64 / (*frame_count).max(1) as f64;
        // Insets release the shared models first, because posing a model that is in use elsewhere
        // copies it.
        self.scene.insets.iter_mut().for_each(|inset| inset.scene.models.clear());
        motion.pose_models(&mut self.scene.models, &scene.models, *pivot, fraction);
        let models = std::mem::take(&mut self.scene.models);
        let posed = Scene::resolve_posed(origin, file, &models, FileAccess::Loaded(scene))?;
        let kept =
            |index, start: &Scene| self.sequence.keeps_view(index).then_some(start.view_projection);
        for (index, (inset, posed)) in (1..).zip(self.scene.insets.iter_mut().zip(posed.insets)) {
            let start = &scene.insets[index - 1].scene;
            take_posed(&mut inset.scene, posed.scene, kept(index, start));
        }
        let path = view_projections.get(frame).copied();
        let view = path.or_else(|| kept(0, scene));
        let posed = Scene { insets: Vec::new(), ..posed };
        take_posed(&mut self.scene, posed, view);
        let mut picture = Picture::default();
        self.renderer.render(&RenderContext::new(&self.scene, textures, 1), &mut picture)?;
        Ok(picture)
    }
}

/// Updates the pose-dependent parts of a scene. `view` overrides the view of the pose.
fn take_posed(scene: &mut Scene, posed: Scene, view: Option<ViewProjection>) {
    scene.models = posed.models;
    scene.view_projection = view.unwrap_or(posed.view_projection);
    scene.lights = posed.lights;
    scene.ground = posed.ground;
    scene.environment = posed.environment;
    scene.occlusion_radius = posed.occlusion_radius;
    scene.tone_mapper = posed.tone_mapper;
    scene.overlays = posed.overlays;
}

impl Motion {
    /// Returns whether all models are static.
    fn is_still(&self) -> bool {
        matches!(self, Self::Turntable { angle } if *angle == 0.0)
    }

    /// Poses models at a fraction of the motion; `start` holds the unposed models.
    ///
    /// A turntable computes model_to_world · T(−p) · R_y(αf) · T(p), written in the order of
    /// application. It starts from the unposed transform each time, so rotations do not drift over
    /// thousands of frames. An animation is evaluated at t = from + (to − from) f seconds. A model
    /// with several instances is posed once, and they share the result.
    fn pose_models(
        &self,
        models: &mut [ModelInstance],
        start: &[ModelInstance],
        pivot: Point<World>,
        fraction: f64,
    ) {
        match self {
            Self::Turntable { angle } => {
                let translate_back = Affine::<World, World>::translation(pivot - Point::ORIGIN);
                let translate_to_origin =
                    Affine::<World, World>::translation(Point::ORIGIN - pivot);
                let rotation = translate_to_origin
                    .then(Affine::rotation_y(angle * fraction))
                    .then(translate_back);
                for (instance, start) in models.iter_mut().zip(start) {
                    instance.model_to_world = start.model_to_world.then(rotation);
                }
            }
            Self::Animations { animations, from, to } => {
                let time = from + (to - from) * fraction;
                let shared = shared_models(start);
                // Instances release the shared model first, because `make_mut` copies a model that
                // is in use.
                let empty_model = Arc::new(Model::default());
                for &(index, _) in &shared {
                    models[index].model = Arc::clone(&empty_model);
                }
                for (instance, animation) in models.iter_mut().zip(animations) {
                    if let Some(animation) = animation {
                        Arc::make_mut(&mut instance.model).apply_animation(*animation, time);
                    }
                }
                for (index, first) in shared {
                    models[index].model = Arc::clone(&models[first].model);
                }
            }
        }
    }
}

/// Finds instances that share the model of their predecessor, as pairs of an index and the first
/// index of the run.
///
/// Instances of one file are consecutive, so it is enough to compare neighbors by pointer, which
/// takes O(n).
fn shared_models(models: &[ModelInstance]) -> Vec<(usize, usize)> {
    let mut first = 0;
    let mut shared = Vec::new();
    for (index, pair) in (1..).zip(models.windows(2)) {
        if Arc::ptr_eq(&pair[0].model, &pair[1].model) {
            shared.push((index, first));
        } else {
            first = index;
        }
    }
    shared
}

/// Returns the center of the points' bounding box, or the origin if there are no points.
///
/// The box is computed for the start pose. A center of mass would depend on the tessellation.
fn bounds_center(points: &[Point<World>]) -> Point<World> {
    let mut points = points.iter().map(|point| point.raw());
    let Some(first) = points.next() else { return Point::ORIGIN };
    let (min, max) =
        points.fold((first, first), |(least, most), point| (least.min(point), most.max(point)));
    Point::from_raw((min + max) * 0.5)
}
