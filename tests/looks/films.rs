//! Compares frames of animations with still pictures: with the same camera, a frame has the same
//! bytes as the picture at its time, in every style.
//!
//! A model's lights, cameras and ground move with it, so a film whose scene is resolved only once
//! would show them at their starting positions.

use super::styles::{all_styles, keep_few};
use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use homog::Bounds;
use model::world_points;
use pipeline::sequence::{Motion, Sequence};
use pipeline::{Origin, Picture, Scene, render};
use scene::ResolveOptions;
use scene_file::SceneFile;
use scene_file::file::{CameraChoice, CameraFile, Choice, Finite, GroundFile, Triple, ViewFile};
use serde_json::json;
use std::convert::Infallible;
use std::f64::consts::FRAC_1_SQRT_2;
use std::fs::{create_dir_all, write};
use std::path::{Path, PathBuf};

/// The generated model, whose light and camera move.
const MOVING_LAMP: &str = "moving-lamp.gltf";

/// The number of frames per film.
const FRAMES: usize = 3;

/// Writes a square below a point light and a camera that move to the right within a second.
pub fn write_moving_lamp(folder: &Path) -> Result<PathBuf, String> {
    let square = [-1.0, 0.0, -1.0, -1.0, 0.0, 1.0, 1.0, 0.0, 1.0, 1.0, 0.0, -1.0];
    let [times, places] = [vec![0.0, 1.0], vec![-0.8, 0.5, 0.0, 0.8, 0.5, 0.0]];
    let numbers = square.into_iter().chain(times).chain(places);
    let mut bytes: Vec<u8> = numbers.flat_map(|number: f32| number.to_le_bytes()).collect();
    bytes.extend([0_u16, 1, 2, 0, 2, 3].into_iter().flat_map(u16::to_le_bytes));
    let accessor = |view: usize, kind: &str, component: u32, count: usize| json!({ "bufferView": view, "type": kind, "componentType": component, "count": count });
    let mut positions = accessor(0, "VEC3", 5126, 4);
    (positions["min"], positions["max"]) = (json!([-1, 0, -1]), json!([1, 0, 1]));
    let mut input = accessor(1, "SCALAR", 5126, 2);
    (input["min"], input["max"]) = (json!([0]), json!([1]));
    let channel =
        |node: usize| json!({ "sampler": 0, "target": { "node": node, "path": "translation" } });
    let document = json!({
        "asset": { "version": "2.0" },
        "extensionsUsed": ["KHR_lights_punctual"],
        "extensions": { "KHR_lights_punctual": { "lights": [{ "type": "point", "intensity": 2 }] } },
        "buffers": [{
            "byteLength": bytes.len(),
            "uri": format!("data:application/octet-stream;base64,{}", STANDARD.encode(&bytes)),
        }],
        "bufferViews": [
            { "buffer": 0, "byteOffset": 0, "byteLength": 48 },
            { "buffer": 0, "byteOffset": 48, "byteLength": 8 },
            { "buffer": 0, "byteOffset": 56, "byteLength": 24 },
            { "buffer": 0, "byteOffset": 80, "byteLength": 12 },
        ],
        "accessors": [
            positions, input, accessor(2, "VEC3", 5126, 2), accessor(3, "SCALAR", 5123, 6),
        ],
        "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0 }, "indices": 3 }] }],
        "cameras": [{ "type": "perspective", "perspective": { "yfov": 1.0, "znear": 0.1 } }],
        "nodes": [
            { "mesh": 0 },
            { "translation": [-0.8, 0.5, 0], "extensions": { "KHR_lights_punctual": { "light": 0 } } },
            { "translation": [-0.8, 0.5, 0], "children": [3] },
            { "camera": 0, "translation": [0.8, 2.5, 0], "rotation": [-FRAC_1_SQRT_2, 0, 0, FRAC_1_SQRT_2] },
        ],
        "scenes": [{ "nodes": [0, 1, 2] }],
        "animations": [{
            "samplers": [{ "input": 1, "output": 2 }],
            "channels": [channel(1), channel(2)],
        }],
    });
    let path = folder.join(MOVING_LAMP);
    let written = create_dir_all(folder).and_then(|()| write(&path, document.to_string()));
    written.map_err(|error| format!("{}: {error}", path.display()))?;
    Ok(path)
}

/// Returns the differences between the frames of a model's film and the pictures at the same times,
/// or none if the model has no animation or cannot be drawn.
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
    let must_move = model.ends_with(MOVING_LAMP);
    let cameras = cameras(&scene);
    let mut cases: Vec<_> = cameras
        .iter()
        .flat_map(|camera| [false, true].map(|has_ground| (camera, has_ground)))
        .collect();
    if !must_move {
        keep_few(&mut cases, &super::model_name(model), 1);
    }
    let mut faults = Vec::new();
    for ((name, camera), has_ground) in cases {
        let mut file = SceneFile { camera: camera.clone(), ..file.clone() };
        file.ground = has_ground.then_some(GroundFile::DEFAULT);
        let outcome = compare_film(&origin, &file, end, must_move);
        let fault = outcome.err().map(|fault| format!("{name}, ground {has_ground}: {fault}"));
        faults.extend(fault);
    }
    let mut styles = all_styles();
    keep_few(&mut styles, &super::model_name(model), 1);
    for (name, style) in styles {
        let style = style.with_fitting_lines(super::SIZE);
        let mut file = SceneFile { style, ..file.clone() };
        if let Some((_, camera)) = cameras.first() {
            file.camera = camera.clone();
        }
        let fault = compare_film(&origin, &file, end, false).err();
        faults.extend(fault.map(|fault| format!("{name}: {fault}")));
    }
    faults
}

/// Returns a static camera, and the model's first camera if it has one.
fn cameras(scene: &Scene) -> Vec<(&'static str, CameraFile)> {
    let bounds = Bounds::from_points(world_points(&scene.models));
    let Some(bounds) = bounds else { return Vec::new() };
    let corners = bounds.corners();
    let middle = (corners[0].raw() + corners[7].raw()) * 0.5;
    let eye = middle + glam::DVec3::new(0.9, 0.6, 1.4) * bounds.diagonal().max(1e-6);
    let triple = |v: glam::DVec3| Triple([v.x, v.y, v.z]);
    let view =
        ViewFile::LookAt { eye: triple(eye), target: triple(middle), up: Triple([0.0, 1.0, 0.0]) };
    let mut cameras = vec![("a static camera", CameraFile { view, ..CameraFile::default() })];
    if !scene.models[0].model.cameras.is_empty() {
        let view = ViewFile::FromModel(CameraChoice::Index(0));
        cameras.push(("the model's camera", CameraFile { view, ..CameraFile::default() }));
    }
    cameras
}

/// Renders a film of the first animation and each of its frames as a picture.
fn compare_film(
    origin: &Origin,
    file: &SceneFile,
    end: f64,
    must_move: bool,
) -> Result<(), String> {
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
    if frames.windows(2).all(|pair| pair[0] == pair[1]) && must_move {
        return Err("all frames are identical".to_owned());
    }
    for (index, frame) in frames.iter().enumerate() {
        let time = end * (index as f64 / FRAMES as f64);
        if *frame != picture_at(time)? {
            return Err(format!("frame {index} differs from the picture at {time} s"));
        }
    }
    Ok(())
}
