//! The picture of a scene whose triangles are divided by w before they are clipped: the mistake of
//! the lesson on clipping (C36).

use crate::ExplorerError;
use crate::model_store::LoadedScene;
use crate::pane_scene::camera_at_origin;
use crate::triangle_survey::{WorldTriangle, project};
use camera::ViewProjection;
use glam::DMat4;
use homog::{Affine, Clip, HPoint, Point, Projective, World};
use model::{Mesh, Model, ModelInstance, Node, Primitive, Topology};
use pipeline::{Scene, Textures};
use scene::Style;
use std::sync::Arc;

/// The range of depths that are distinguished, in half sides of the view volume.
const DEPTH_RANGE: f64 = 4.0;

/// Returns a scene that shows the images of the triangles' corners, connected by straight lines
/// and only then cut off at the borders of the picture, which cannot correct them.
///
/// The near and far planes do not clip, because that would hide most of the mistake.
///
/// # Errors
/// Never fails in practice, because the camera is a constant.
pub(crate) fn torn_scene(loaded: &LoadedScene) -> Result<Scene, ExplorerError> {
    let mut scene = Scene::clone(&loaded.scene);
    let world_to_clip = scene.view_projection.world_to_clip();
    scene.models = scene.models.iter().map(|placed| divided_model(placed, world_to_clip)).collect();
    let view_to_clip = Projective::from_raw(DMat4::IDENTITY);
    scene.view_projection = ViewProjection { camera: camera_at_origin()?, view_to_clip };
    // The corners keep the normals of their faces in the world, for the lights.
    if scene.style == Style::Flat {
        scene.style = Style::Shaded;
    }
    Ok(scene)
}

/// Returns the textures of the divided models, which have no texture coordinates.
pub(crate) fn torn_textures() -> Textures<'static> {
    Textures::for_models(&[])
}

/// Returns a model with the same materials whose corners are in NDC.
fn divided_model(placed: &ModelInstance, world_to_clip: Projective<World, Clip>) -> ModelInstance {
    let model = &placed.model;
    let mut primitives = Vec::new();
    for (instance, primitive) in model.scene_primitives() {
        if primitive.topology != Topology::Triangles {
            continue;
        }
        let skinned = model.skin_primitive(instance, primitive);
        let to_world = skinned.to_model.then(placed.model_to_world);
        let corner = |index: &u32| {
            let position = skinned.positions[*index as usize];
            to_world.transform_point(Point::from(position.map(f64::from)))
        };
        let mut divided = Primitive {
            normals: Some(Vec::new()),
            material: primitive.material,
            ..Primitive::default()
        };
        for triangle in primitive.indices.as_chunks::<3>().0 {
            add_divided(&mut divided, triangle.each_ref().map(corner), world_to_clip);
        }
        primitives.push(divided);
    }
    let model = Model {
        name: model.name.clone(),
        meshes: vec![Mesh { primitives, ..Mesh::default() }],
        materials: model.materials.clone(),
        nodes: vec![Node { mesh: Some(0), ..Node::default() }],
        roots: vec![0],
        ..Model::default()
    };
    ModelInstance { model: Arc::new(model), model_to_world: Affine::IDENTITY }
}

/// Adds the images of a triangle's corners.
fn add_divided(
    divided: &mut Primitive,
    triangle: WorldTriangle,
    world_to_clip: Projective<World, Clip>,
) {
    let corners = project(&world_to_clip, &triangle);
    let images = corners.map(image);
    let [Some(a), Some(b), Some(c)] = images else { return };
    let [p, q, r] = triangle;
    let Some(normal) = (q - p).cross(r - p).normalized() else { return };
    let normal = <[f64; 3]>::from(normal).map(|c| c as f32);
    // A division by a negative w turns a triangle around; a torn one has no front.
    let behind = corners.iter().filter(|corner| corner.w() <= 0.0).count();
    let fronts: &[[[f32; 3]; 3]] = match behind {
        0 => &[[a, b, c]],
        3 => &[[a, c, b]],
        _ => &[[a, b, c], [a, c, b]],
    };
    for corner in fronts.as_flattened() {
        divided.indices.push(divided.positions.len() as u32);
        divided.positions.push(*corner);
        divided.normals.get_or_insert_default().push(normal);
    }
}

/// Returns the image of a point, with a depth within the canonical view volume.
fn image(corner: HPoint<Clip>) -> Option<[f32; 3]> {
    let [x, y, z] = corner.divide()?.into();
    let depth = z.clamp(-DEPTH_RANGE, DEPTH_RANGE) / (DEPTH_RANGE * 1.001);
    let image = [x, y, depth].map(|c| c as f32);
    image.iter().all(|c| c.is_finite()).then_some(image)
}
