//! Frames of films against pictures: with a camera that is given, a frame of an animation has the
//! bytes of the picture at its time.
//!
//! Lights, cameras and grounds of a model move with it, so a film that is resolved only once shows
//! them where they began.

use homog::Bounds;
use model::world_points;
use pipeline::scene::file::{
    CameraChoice, CameraFile, Choice, Finite, GroundFile, Triple, ViewFile,
};
use pipeline::scene::{ResolveOptions, SceneFile};
use pipeline::sequence::{Motion, Sequence};
use pipeline::{Origin, Picture, Scene, render};
use std::convert::Infallible;
use std::path::Path;

/// Frames of each film.
const FRAMES: usize = 3;

/// How the frames of a model's film differ from pictures at their times; nothing if the model has
/// no animation, or if it cannot be drawn.
pub fn compare_frames(model: &Path) -> Vec<String> {
    let (origin, mut file) = Origin::from_model_path(model);
    file.image.size = super::SIZE;
    let Ok(scene) = Scene::resolve(&origin, &file, &ResolveOptions::default()) else {
        return Vec::new();
    };
    let Some(animation) = scene.models.first().and_then(|it| it.model.animations.first()) else {
        return Vec::new();
    };
    let end = animation.duration_seconds;
    let mut faults = Vec::new();
    for (name, camera) in cameras(&scene) {
        for has_ground in [false, true] {
            let mut file = SceneFile { camera: camera.clone(), ..file.clone() };
            file.ground = has_ground.then_some(GroundFile::DEFAULT);
            let outcome = compare_film(&origin, &file, end);
            let fault = outcome.err().map(|fault| format!("{name}, ground {has_ground}: {fault}"));
            faults.extend(fault);
        }
    }
    faults
}

/// A camera that stands still, and the model's first, if it has one.
fn cameras(scene: &Scene) -> Vec<(&'static str, CameraFile)> {
    let bounds = Bounds::from_points(world_points(&scene.models));
    let Some(bounds) = bounds else { return Vec::new() };
    let corners = bounds.corners();
    let middle = (corners[0].raw() + corners[7].raw()) * 0.5;
    let eye = middle + glam::DVec3::new(0.9, 0.6, 1.4) * bounds.diagonal().max(1e-6);
    let triple = |v: glam::DVec3| Triple([v.x, v.y, v.z]);
    let view =
        ViewFile::LookAt { eye: triple(eye), target: triple(middle), up: Triple([0.0, 1.0, 0.0]) };
    let mut cameras = vec![("a given camera", CameraFile { view, ..CameraFile::default() })];
    if !scene.models[0].model.cameras.is_empty() {
        let view = ViewFile::FromModel(CameraChoice::Index(0));
        cameras.push(("the model's camera", CameraFile { view, ..CameraFile::default() }));
    }
    cameras
}

/// Renders a film of the first animation and each of its frames as a picture.
fn compare_film(origin: &Origin, file: &SceneFile, end: f64) -> Result<(), String> {
    let options = ResolveOptions::default();
    let picture_at = |time: f64| {
        let mut file = file.clone();
        file.models[0].animation = Some(Choice::Index(0));
        file.models[0].time = Finite::new(time);
        let scene = Scene::resolve(origin, &file, &options).map_err(|error| error.to_string())?;
        render(&scene, 1).map_err(|error| error.to_string())
    };
    let scene = Scene::resolve(origin, file, &options).map_err(|error| error.to_string())?;
    let animations = vec![Some(0); scene.models.len()];
    let motion = Motion::Animations { animations, from: 0.0, to: end };
    let film = Sequence::new(origin, file, scene, motion, FRAMES);
    let mut frames: Vec<Picture> = Vec::new();
    let taken = film.map_err(|error| error.to_string())?.render_frames(1, |_, frame| {
        frames.push(frame.clone());
        Ok::<(), Infallible>(())
    });
    taken.map_err(|error| error.to_string())?;
    for (index, frame) in frames.iter().enumerate() {
        let time = end * (index as f64 / FRAMES as f64);
        if *frame != picture_at(time)? {
            return Err(format!("frame {index} is not the picture at {time} s"));
        }
    }
    Ok(())
}
