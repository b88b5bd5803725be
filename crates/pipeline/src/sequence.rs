//! Films: many pictures of one scene, several at a time, handed over in their order.
//!
//! ```text
//!  motion ─► frame 0, 1, 2 … ─► as many at a time as there are threads ─► in order ─► files, APNG, GIF, a pipe
//! ```
//! Models are loaded, and the mip chains of their textures built, once. Each thread poses a copy of its own and renders in
//! the memory of its picture before.

use crate::render::{RenderError, Renderer, Textures};
use crate::scene::{CameraPath, Origin, ResolveError, Scene, SceneFile};
use crate::{Picture, Timings, render};
use camera::ViewProjection;
use homog::{Affine, Point, World};
use model::Model;
use model::ModelInstance;
use std::collections::BTreeMap;
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};

/// What moves.
#[derive(Clone, PartialEq, Debug)]
pub enum Motion {
    /// The models turn about the vertical line through their middle, by this angle in radians from the first frame to the one
    /// after the last: counter-clockwise seen from above.
    Turntable {
        /// The angle; 2π for a whole turn.
        angle: f64,
    },
    /// The models move as their animations have them.
    Animations {
        /// For each model of the scene, which of its animations.
        animations: Vec<Option<usize>>,
        /// The time of the first frame, in seconds.
        from: f64,
        /// The time of the frame after the last.
        to: f64,
    },
}

/// A film ready to be drawn.
#[derive(Debug)]
pub struct Sequence {
    scene: Scene,
    motion: Motion,
    frame_count: usize,
    /// What a turntable turns about.
    pivot: Point<World>,
    /// The camera of each picture, if it moves.
    view_projections: Vec<ViewProjection>,
}

/// A film that cannot be drawn to its end.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SequenceError<E> {
    /// A picture cannot be rendered.
    #[error(transparent)]
    Render(#[from] RenderError),
    /// Whoever gets the pictures cannot take more.
    #[error("{0}")]
    Output(E),
}

/// Moments at which a framed camera makes sure that everything is in the picture.
const FRAMING_SAMPLES: usize = 16;
/// Pictures that may be ready before their turn, for each thread.
const FRAMES_AHEAD: usize = 2;

impl Sequence {
    /// A film of `frames` pictures of a scene that `file` describes. A camera that frames everything frames all of the motion.
    ///
    /// # Errors
    /// If the scene cannot be framed.
    pub fn new(
        origin: &Origin,
        file: &SceneFile,
        scene: Scene,
        motion: Motion,
        frames: usize,
    ) -> Result<Self, ResolveError> {
        let middle = bounds_center(&model::world_points(&scene.models));
        let mut film = Self {
            scene,
            motion,
            frame_count: frames,
            pivot: middle,
            view_projections: Vec::new(),
        };
        let sampled_models = (0..FRAMING_SAMPLES)
            .flat_map(|at| film.models_at_fraction(at as f64 / FRAMING_SAMPLES as f64));
        // The surroundings have been read before: whoever was allowed to then is so now.
        let known: Vec<_> = file.image_paths().map(|path| origin.folder.join(path)).collect();
        let framed = Scene::resolve_with_models(origin, file, sampled_models.collect(), &known)?;
        (film.scene.view_projection, film.scene.lights) = (framed.view_projection, framed.lights);
        film.scene.ground = framed.ground;
        for (view, framed) in film.scene.insets.iter_mut().zip(framed.insets) {
            (view.scene.view_projection, view.scene.lights) =
                (framed.scene.view_projection, framed.scene.lights);
            view.scene.ground = framed.scene.ground;
        }
        Ok(film)
    }

    /// The same film with a camera that moves: along its way from one time to another, in seconds. Views with cameras of their own keep
    /// them.
    ///
    /// # Errors
    /// If it cannot see on its way, such as where the eye is in the place that it looks at.
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

    /// How many pictures it has.
    #[must_use]
    pub const fn frame_count(&self) -> usize {
        self.frame_count
    }

    /// Width and height in pixels.
    #[must_use]
    pub const fn image_size(&self) -> (u32, u32) {
        (self.scene.image.width, self.scene.image.height)
    }

    /// Whether the background is opaque, and with it every picture.
    #[must_use]
    pub fn is_opaque(&self) -> bool {
        self.scene.has_opaque_background()
    }

    /// Draws all pictures with up to `threads` threads and hands them to `sink` in their order. The pictures do not depend on
    /// the number of threads.
    ///
    /// # Errors
    /// If a picture cannot be rendered, or the sink fails; no further picture is begun then.
    pub fn render_frames<E>(
        &self,
        threads: usize,
        mut sink: impl FnMut(usize, &Picture) -> Result<(), E>,
    ) -> Result<(), SequenceError<E>> {
        let textures = Textures::for_models(&self.scene.models);
        let (queue, progress) = (Mutex::new(Queue::default()), Condvar::new());
        let workers = threads.clamp(1, self.frame_count.max(1));
        let lock = || queue.lock().unwrap_or_else(PoisonError::into_inner);
        let work = || {
            let mut camera = FrameWorker::new(self);
            while let Some(frame) =
                next_frame(lock(), &progress, self.frame_count, FRAMES_AHEAD * workers)
            {
                let picture = camera.render_frame(frame, &textures);
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
                lock().started = self.frame_count;
                progress.notify_all();
            }
            result
        })
    }

    /// Waits for each picture in its turn.
    fn deliver_frames<'a, E>(
        &self,
        lock: &impl Fn() -> MutexGuard<'a, Queue>,
        turned: &Condvar,
        sink: &mut impl FnMut(usize, &Picture) -> Result<(), E>,
    ) -> Result<(), SequenceError<E>> {
        for frame in 0..self.frame_count {
            let mut queue = lock();
            let picture = loop {
                if let Some(picture) = queue.finished.remove(&frame) {
                    break picture;
                }
                queue = turned.wait(queue).unwrap_or_else(PoisonError::into_inner);
            };
            queue.delivered = frame + 1;
            drop(queue);
            turned.notify_all();
            sink(frame, &picture?).map_err(SequenceError::Output)?;
        }
        Ok(())
    }

    /// The models at a part of the way, from 0 to 1.
    fn models_at_fraction(&self, part: f64) -> Vec<ModelInstance> {
        let mut models = self.scene.models.clone();
        self.motion.pose_models(&mut models, &self.scene.models, self.pivot, part);
        models
    }
}

/// Pictures on their way.
#[derive(Default)]
struct Queue {
    started: usize,
    delivered: usize,
    finished: BTreeMap<usize, Result<Picture, RenderError>>,
}

/// The next frame to be drawn, once it is not too far ahead; `None` if all are begun.
fn next_frame(
    mut queue: MutexGuard<'_, Queue>,
    turned: &Condvar,
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
        queue = turned.wait(queue).unwrap_or_else(PoisonError::into_inner);
    }
}

/// What a thread renders with: models of its own, and the memory of its last picture.
struct FrameWorker<'a> {
    sequence: &'a Sequence,
    scene: Scene,
    renderer: Renderer,
}

impl<'a> FrameWorker<'a> {
    fn new(sequence: &'a Sequence) -> Self {
        let mut scene = sequence.scene.clone();
        if matches!(sequence.motion, Motion::Animations { .. }) {
            let copies = shared_models(&sequence.scene.models);
            for placed in &mut scene.models {
                placed.model = Arc::new(clone_without_images(&placed.model));
            }
            for (at, first) in copies {
                scene.models[at].model = Arc::clone(&scene.models[first].model);
            }
        }
        Self { sequence, scene, renderer: Renderer::default() }
    }

    fn render_frame(
        &mut self,
        frame: usize,
        textures: &Textures<'_>,
    ) -> Result<Picture, RenderError> {
        let Sequence { scene, motion, frame_count: frames, pivot: middle, view_projections: shots } =
            self.sequence;
        let fraction = frame as f64 / (*frames).max(1) as f64;
        // Views let go of the models that they share, so that those are not copied before they are posed.
        self.scene.insets.iter_mut().for_each(|view| view.scene.models.clear());
        motion.pose_models(&mut self.scene.models, &scene.models, *middle, fraction);
        if let Some(view_projection) = shots.get(frame) {
            self.scene.view_projection = *view_projection;
        }
        if !scene.insets.is_empty() {
            for view in &mut self.scene.insets {
                view.scene.models.clone_from(&self.scene.models);
            }
            return render(&self.scene, 1);
        }
        if !scene.style.draws_surfaces() || scene.style.has_outlines() || !scene.overlays.is_empty()
        {
            return render(&self.scene, 1);
        }
        let mut picture = Picture::default();
        self.renderer.render(&self.scene, textures, 1, &Timings::default(), &mut picture)?;
        Ok(picture)
    }
}

impl Motion {
    /// Whether nothing moves.
    fn is_still(&self) -> bool {
        matches!(self, Self::Turntable { angle } if *angle == 0.0)
    }

    /// Brings models to a part of the way; `start` has them where they are without motion.
    fn pose_models(
        &self,
        models: &mut [ModelInstance],
        start: &[ModelInstance],
        middle: Point<World>,
        part: f64,
    ) {
        match self {
            Self::Turntable { angle } => {
                let translate_back = Affine::<World, World>::translation(middle - Point::ORIGIN);
                let translate_to_origin =
                    Affine::<World, World>::translation(Point::ORIGIN - middle);
                let rotation =
                    translate_to_origin.then(Affine::rotation_y(angle * part)).then(translate_back);
                for (placed, start) in models.iter_mut().zip(start) {
                    placed.model_to_world = start.model_to_world.then(rotation);
                }
            }
            Self::Animations { animations, from, to } => {
                let time = from + (to - from) * part;
                let copies = shared_models(start);
                // Copies let go of the model that they share, so that it is not copied before it is posed.
                let empty_model = Arc::new(Model::default());
                for &(at, _) in &copies {
                    models[at].model = Arc::clone(&empty_model);
                }
                for (placed, animation) in models.iter_mut().zip(animations) {
                    if let Some(animation) = animation {
                        Arc::make_mut(&mut placed.model).apply_animation(*animation, time);
                    }
                }
                for (at, first) in copies {
                    models[at].model = Arc::clone(&models[first].model);
                }
            }
        }
    }
}

/// Models that are the same as the one before them, with the first of their row.
fn shared_models(models: &[ModelInstance]) -> Vec<(usize, usize)> {
    let mut first = 0;
    let mut copies = Vec::new();
    for (at, pair) in (1..).zip(models.windows(2)) {
        if Arc::ptr_eq(&pair[0].model, &pair[1].model) {
            copies.push((at, first));
        } else {
            first = at;
        }
    }
    copies
}

/// A copy that can be posed: the textures are kept elsewhere.
fn clone_without_images(model: &Model) -> Model {
    let mut copy = Model { images: vec![None; model.images.len()], ..Model::default() };
    let Model {
        name, meshes, materials, textures, nodes, roots, scenes, active_scene: scene, ..
    } = model;
    copy.name.clone_from(name);
    copy.meshes.clone_from(meshes);
    copy.materials.clone_from(materials);
    copy.textures.clone_from(textures);
    copy.nodes.clone_from(nodes);
    copy.roots.clone_from(roots);
    copy.scenes.clone_from(scenes);
    copy.active_scene = *scene;
    copy.skins.clone_from(&model.skins);
    copy.cameras.clone_from(&model.cameras);
    copy.lights.clone_from(&model.lights);
    copy.animations.clone_from(&model.animations);
    copy.uv_transforms.clone_from(&model.uv_transforms);
    copy
}

/// The middle of the box around some points.
fn bounds_center(points: &[Point<World>]) -> Point<World> {
    let mut points = points.iter().map(|point| point.raw());
    let Some(first) = points.next() else { return Point::ORIGIN };
    let (min, max) =
        points.fold((first, first), |(least, most), point| (least.min(point), most.max(point)));
    Point::from_raw((min + max) * 0.5)
}
