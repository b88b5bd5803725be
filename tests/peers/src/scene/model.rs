//! A model from the shared assets as plain arrays, for measuring the cost of an ordinary textured
//! model.

use super::{Lens, Part, Scene, Texture, Vertex, aspect};
use camera::{NamedView, Slopes, frame_perspective};
use homog::{Normal, Point, World};
use import::{ImportOptions, load};
use model::{Image, Model, Primitive, SkinnedPrimitive, Topology};
use projection::{Fov, Perspective};
use std::path::{Path, PathBuf};

/// Returns the folder of shared models: `$ASSETS`, or `shared/assets` next to the project.
pub fn assets() -> Option<PathBuf> {
    let beside = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/assets");
    let folder = std::env::var_os("ASSETS").map_or(beside, PathBuf::from);
    folder.is_dir().then_some(folder)
}

/// Returns the flight helmet with base colors from textures and Lambert's law.
pub fn helmet(name: &'static str, folder: &Path) -> Result<Scene, String> {
    let path = folder.join("models/flight-helmet/FlightHelmet.gltf");
    let model = load(&path, &ImportOptions::default()).map_err(|error| error.to_string())?;
    let mut scene = framed(name, &model)?;
    for (instance, primitive) in model.scene_primitives() {
        if primitive.topology == Topology::Triangles {
            add(&mut scene, &model, primitive, &model.skin_primitive(instance, primitive));
        }
    }
    scene.about =
        format!("{}, {} triangles, textured, diffuse shading", model.name, scene.triangles());
    Ok(scene)
}

/// Returns the scene with its camera, lens and textures, but without triangles.
fn framed(name: &'static str, model: &Model) -> Result<Scene, String> {
    let fov = Fov::vertical_degrees(35.0);
    let half = fov.half_slopes(aspect()).map_err(|error| error.to_string())?;
    let slopes = Slopes { left: -half.x, right: half.x, bottom: -half.y, top: half.y };
    let points: Vec<Point<World>> =
        model.scene_points().iter().map(|p| Point::from_raw(p.raw())).collect();
    let view = NamedView::Front.basis();
    let framing =
        frame_perspective(points, view, slopes, 0.03).map_err(|error| error.to_string())?;
    let (near, far) = (framing.near * 0.9, framing.far * 1.1);
    let lens = Perspective::new(fov, aspect(), near, far).map_err(|error| error.to_string())?;
    Ok(Scene {
        name,
        about: String::new(),
        vertices: Vec::new(),
        indices: Vec::new(),
        parts: Vec::new(),
        textures: model.images.iter().map(texture).collect(),
        camera: framing.camera,
        lens: Lens::Perspective(lens),
        behind_the_eye: false,
    })
}

fn texture(image: &Option<Image>) -> Texture {
    image.as_ref().map_or_else(
        || Texture { width: 1, height: 1, rgba: vec![[255; 4]] },
        |image| Texture {
            width: image.width as usize,
            height: image.height as usize,
            rgba: image.rgba.clone(),
        },
    )
}

fn add(scene: &mut Scene, model: &Model, primitive: &Primitive, posed: &SkinnedPrimitive<'_>) {
    let first = scene.vertices.len() as u32;
    let (begin, map) = (scene.indices.len(), posed.to_model);
    let uvs = primitive.uvs.first();
    for (at, &position) in posed.positions.iter().enumerate() {
        let normal = posed.normals.as_ref().map_or([0.0, 0.0, 1.0], |normals| normals[at]);
        let normal =
            map.transform_normal(Normal::from_raw(normal.map(f64::from).into())).normalized();
        scene.vertices.push(Vertex {
            position: map
                .transform_point(Point::from(position.map(f64::from)))
                .raw()
                .as_vec3()
                .to_array(),
            normal: normal.map_or([0.0, 0.0, 1.0], |n| n.raw().as_vec3().to_array()),
            uv: uvs.map_or([0.0; 2], |uvs| uvs[at]),
        });
    }
    scene.indices.extend(primitive.indices.iter().map(|index| first + index));
    let material = primitive.material.map(|at| &model.materials[at]);
    let used = material.and_then(|material| material.base_color_texture);
    scene.parts.push(Part {
        indices: begin..scene.indices.len(),
        tint: material.map_or([1.0; 3], |m| [m.base_color[0], m.base_color[1], m.base_color[2]]),
        lit: true,
        texture: used.and_then(|used| model.textures[used.texture].image),
        two_sided: material.is_some_and(|material| material.double_sided),
    });
}
