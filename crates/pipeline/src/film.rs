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
    Clip {
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
pub struct Film {
    scene: Scene,
    motion: Motion,
    frames: usize,
    /// What a turntable turns about.
    middle: Point<World>,
    /// The camera of each picture, if it moves.
    shots: Vec<ViewProjection>,
}

/// A film that cannot be drawn to its end.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum FilmError<E> {
    /// A picture cannot be rendered.
    #[error(transparent)]
    Render(#[from] RenderError),
    /// Whoever gets the pictures cannot take more.
    #[error("{0}")]
    Sink(E),
}

/// Moments at which a framed camera makes sure that everything is in the picture.
const MOMENTS: usize = 16;
/// Pictures that may be ready before their turn, for each thread.
const AHEAD: usize = 2;

impl Film {
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
        let middle = middle(&model::world_points(&scene.models));
        let mut film = Self { scene, motion, frames, middle, shots: Vec::new() };
        let moments = (0..MOMENTS).flat_map(|at| film.models_at(at as f64 / MOMENTS as f64));
        // The surroundings have been read before: whoever was allowed to then is so now.
        let known: Vec<_> = file.pictures().map(|path| origin.folder.join(path)).collect();
        let framed = Scene::around(origin, file, moments.collect(), &known)?;
        (film.scene.view_projection, film.scene.lights) = (framed.view_projection, framed.lights);
        film.scene.ground = framed.ground;
        for (view, framed) in film.scene.views.iter_mut().zip(framed.views) {
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
    pub fn along(
        mut self,
        origin: &Origin,
        path: &CameraPath,
        [from, to]: [f64; 2],
    ) -> Result<Self, ResolveError> {
        let moments = (0..MOMENTS).flat_map(|at| self.models_at(at as f64 / MOMENTS as f64));
        let models: Vec<ModelInstance> =
            if self.motion.is_still() { self.scene.models.clone() } else { moments.collect() };
        let view_projection = |frame: usize| {
            let part = frame as f64 / self.frames.max(1) as f64;
            path.view_projection(origin, from + (to - from) * part, &models, self.scene.image)
        };
        self.shots = (0..self.frames).map(view_projection).collect::<Result<Vec<_>, _>>()?;
        Ok(self)
    }

    /// How many pictures it has.
    #[must_use]
    pub const fn frames(&self) -> usize {
        self.frames
    }

    /// Width and height in pixels.
    #[must_use]
    pub const fn size(&self) -> (u32, u32) {
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
    pub fn draw<E>(
        &self,
        threads: usize,
        mut sink: impl FnMut(usize, &Picture) -> Result<(), E>,
    ) -> Result<(), FilmError<E>> {
        let textures = Textures::of(&self.scene.models);
        let (queue, turned) = (Mutex::new(Queue::default()), Condvar::new());
        let most = threads.clamp(1, self.frames.max(1));
        let lock = || queue.lock().unwrap_or_else(PoisonError::into_inner);
        let work = || {
            let mut camera = Camera::of(self);
            while let Some(frame) = next(lock(), &turned, self.frames, AHEAD * most) {
                let picture = camera.picture(frame, &textures);
                lock().ready.insert(frame, picture);
                turned.notify_all();
            }
        };
        std::thread::scope(|scope| {
            for _ in 0..most {
                scope.spawn(work);
            }
            let result = self.hand_over(&lock, &turned, &mut sink);
            if result.is_err() {
                lock().begun = self.frames;
                turned.notify_all();
            }
            result
        })
    }

    /// Waits for each picture in its turn.
    fn hand_over<'a, E>(
        &self,
        lock: &impl Fn() -> MutexGuard<'a, Queue>,
        turned: &Condvar,
        sink: &mut impl FnMut(usize, &Picture) -> Result<(), E>,
    ) -> Result<(), FilmError<E>> {
        for frame in 0..self.frames {
            let mut queue = lock();
            let picture = loop {
                if let Some(picture) = queue.ready.remove(&frame) {
                    break picture;
                }
                queue = turned.wait(queue).unwrap_or_else(PoisonError::into_inner);
            };
            queue.handed_over = frame + 1;
            drop(queue);
            turned.notify_all();
            sink(frame, &picture?).map_err(FilmError::Sink)?;
        }
        Ok(())
    }

    /// The models at a part of the way, from 0 to 1.
    fn models_at(&self, part: f64) -> Vec<ModelInstance> {
        let mut models = self.scene.models.clone();
        self.motion.apply(&mut models, &self.scene.models, self.middle, part);
        models
    }
}

/// Pictures on their way.
#[derive(Default)]
struct Queue {
    begun: usize,
    handed_over: usize,
    ready: BTreeMap<usize, Result<Picture, RenderError>>,
}

/// The next frame to be drawn, once it is not too far ahead; `None` if all are begun.
fn next(
    mut queue: MutexGuard<'_, Queue>,
    turned: &Condvar,
    frames: usize,
    ahead: usize,
) -> Option<usize> {
    loop {
        if queue.begun >= frames {
            return None;
        }
        if queue.begun < queue.handed_over + ahead {
            queue.begun += 1;
            return Some(queue.begun - 1);
        }
        queue = turned.wait(queue).unwrap_or_else(PoisonError::into_inner);
    }
}

/// What a thread renders with: models of its own, and the memory of its last picture.
struct Camera<'a> {
    film: &'a Film,
    scene: Scene,
    renderer: Renderer,
}

impl<'a> Camera<'a> {
    fn of(film: &'a Film) -> Self {
        let mut scene = film.scene.clone();
        if matches!(film.motion, Motion::Clip { .. }) {
            let copies = copies(&film.scene.models);
            for placed in &mut scene.models {
                placed.model = Arc::new(without_images(&placed.model));
            }
            for (at, first) in copies {
                scene.models[at].model = Arc::clone(&scene.models[first].model);
            }
        }
        Self { film, scene, renderer: Renderer::default() }
    }

    fn picture(&mut self, frame: usize, textures: &Textures<'_>) -> Result<Picture, RenderError> {
        let Film { scene, motion, frames, middle, shots } = self.film;
        let part = frame as f64 / (*frames).max(1) as f64;
        // Views let go of the models that they share, so that those are not copied before they are posed.
        self.scene.views.iter_mut().for_each(|view| view.scene.models.clear());
        motion.apply(&mut self.scene.models, &scene.models, *middle, part);
        if let Some(view_projection) = shots.get(frame) {
            self.scene.view_projection = *view_projection;
        }
        if !scene.views.is_empty() {
            for view in &mut self.scene.views {
                view.scene.models.clone_from(&self.scene.models);
            }
            return render(&self.scene, 1);
        }
        if !scene.style.shows_surfaces() || scene.style.has_outlines() || !scene.overlays.is_empty()
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
    fn apply(
        &self,
        models: &mut [ModelInstance],
        start: &[ModelInstance],
        middle: Point<World>,
        part: f64,
    ) {
        match self {
            Self::Turntable { angle } => {
                let there = Affine::<World, World>::translation(middle - Point::ORIGIN);
                let here = Affine::<World, World>::translation(Point::ORIGIN - middle);
                let turn = here.then(Affine::rotation_y(angle * part)).then(there);
                for (placed, start) in models.iter_mut().zip(start) {
                    placed.model_to_world = start.model_to_world.then(turn);
                }
            }
            Self::Clip { animations, from, to } => {
                let time = from + (to - from) * part;
                let copies = copies(start);
                // Copies let go of the model that they share, so that it is not copied before it is posed.
                let nothing = Arc::new(Model::default());
                for &(at, _) in &copies {
                    models[at].model = Arc::clone(&nothing);
                }
                for (placed, animation) in models.iter_mut().zip(animations) {
                    if let Some(animation) = animation {
                        Arc::make_mut(&mut placed.model).pose(*animation, time);
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
fn copies(models: &[ModelInstance]) -> Vec<(usize, usize)> {
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
fn without_images(model: &Model) -> Model {
    let mut light = Model { images: vec![None; model.images.len()], ..Model::default() };
    let Model { name, meshes, materials, textures, nodes, roots, scenes, scene, .. } = model;
    light.name.clone_from(name);
    light.meshes.clone_from(meshes);
    light.materials.clone_from(materials);
    light.textures.clone_from(textures);
    light.nodes.clone_from(nodes);
    light.roots.clone_from(roots);
    light.scenes.clone_from(scenes);
    light.scene = *scene;
    light.skins.clone_from(&model.skins);
    light.cameras.clone_from(&model.cameras);
    light.lights.clone_from(&model.lights);
    light.animations.clone_from(&model.animations);
    light.uv_transforms.clone_from(&model.uv_transforms);
    light
}

/// The middle of the box around some points.
fn middle(points: &[Point<World>]) -> Point<World> {
    let mut points = points.iter().map(|point| point.raw());
    let Some(first) = points.next() else { return Point::ORIGIN };
    let (least, most) =
        points.fold((first, first), |(least, most), point| (least.min(point), most.max(point)));
    Point::from_raw((least + most) * 0.5)
}
