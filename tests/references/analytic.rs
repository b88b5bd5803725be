//! References computed by this test: scenes of spheres and rectangles, ray traced with exact
//! intersections and shaded with the formulas of the glTF specification.
//!
//! They have the same form as the references from another renderer, so that both are scored in the
//! same way: `NAME.json` with the camera, lights and model path, `NAME.png`, and the model as
//! triangles.

mod brdf;
mod tracer;

use brdf::{Lights, Material};
use glam::{DVec3, dvec3};
use scene_models::document::{Document, MaterialId};
use scene_models::mesh::Mesh;
use serde_json::{Value, json};
use std::path::Path;
use tracer::{Camera, Shape, Surface, World};

/// The width and height of the pictures.
const SIZE: (u32, u32) = (320, 240);
/// The number of segments around the spheres. Their outline is within 0.01 pixels of a circle.
const SEGMENTS: u32 = 192;

/// Computes all references and writes them to a folder, with the models below `models`.
pub fn write_references(folder: &Path) -> Result<(), String> {
    let models = folder.join("models");
    std::fs::create_dir_all(&models).map_err(|e| format!("{}: {e}", models.display()))?;
    for (name, world) in worlds() {
        let write = |file: String, bytes: Vec<u8>| {
            let path = folder.join(file);
            std::fs::write(&path, bytes).map_err(|error| format!("{}: {error}", path.display()))
        };
        write(format!("models/{name}.glb"), triangulate(&world))?;
        write(format!("{name}.json"), describe(name, &world).to_string().into_bytes())?;
        world.render(SIZE.0, SIZE.1).write_png(&folder.join(format!("{name}.png")))?;
    }
    Ok(())
}

/// Returns the scenes with their names.
fn worlds() -> Vec<(&'static str, World)> {
    let gray = [0.5; 3];
    let gold = [1.0, 0.76, 0.33];
    let row = (0..5).map(|at| {
        let x = f64::from(at) * 2.2 - 4.4;
        sphere(dvec3(x, 0.0, 0.0), Material::dielectric([0.1, 0.3, 0.7], 0.2 + 0.2 * f64::from(at)))
    });
    // The spheres appear large, because the renderer adds the variation of normals within a pixel
    // to the roughness (geometric specular antialiasing). Their roughness is below 1, because the
    // renderer's albedo table ends at 15.5/16.
    let metals = [(-1.05, 0.6), (1.05, 0.85)]
        .map(|(x, roughness)| sphere(dvec3(x, 0.0, 0.0), Material::metal(gold, roughness)));
    let floor = rectangle(
        dvec3(-8.0, -1.0, 8.0),
        dvec3(16.0, 0.0, 0.0),
        dvec3(0.0, 0.0, -16.0),
        Material::dielectric(gray, 1.0),
    );
    let panes = [
        (dvec3(-2.0, -1.2, 0.0), Material::unlit([0.9, 0.1, 0.1], 0.5)),
        (dvec3(-0.7, -0.4, -0.6), Material::unlit([0.1, 0.8, 0.1], 0.3)),
        (dvec3(-1.4, -1.6, 0.6), Material::unlit([0.1, 0.1, 0.9], 0.7)),
        (dvec3(-3.0, -2.0, -1.5), Material::unlit([0.8, 0.8, 0.6], 1.0)),
    ];
    let panes = panes.map(|(vertex, material)| {
        let scale = if material.alpha < 1.0 { 1.0 } else { 2.0 };
        rectangle(vertex, DVec3::X * 2.4 * scale, DVec3::Y * 2.0 * scale, material)
    });
    let wide = Camera { fov_y_degrees: 90.0, ..camera(dvec3(0.0, 0.0, 4.0)) };
    let corners = [(-3.5, -2.2), (3.5, -2.2), (0.0, 0.0), (-3.5, 2.2), (3.5, 2.2)];
    let off_axis = corners.map(|(x, y)| sphere(dvec3(x, y, 0.0), Material::dielectric(gray, 0.6)));
    vec![
        ("lambert-floor", world(camera(dvec3(0.0, 2.5, 9.0)), vec![floor])),
        (
            "sphere-on-a-floor",
            world(
                camera(dvec3(1.0, 1.5, 6.0)),
                vec![
                    rectangle(
                        dvec3(-3.0, -1.0, 3.0),
                        DVec3::X * 6.0,
                        DVec3::Z * -6.0,
                        Material::unlit([0.2, 0.3, 0.2], 1.0),
                    ),
                    sphere(DVec3::ZERO, Material::dielectric([0.8, 0.2, 0.1], 0.5)),
                ],
            ),
        ),
        ("dielectrics-by-roughness", world(camera(dvec3(0.0, 0.0, 14.0)), row.collect())),
        ("rough-metals", world(camera(dvec3(0.0, 0.0, 4.4)), metals.to_vec())),
        ("spheres-off-the-axis", world(wide, off_axis.to_vec())),
        ("blended-panes", world(camera(dvec3(0.3, 0.2, 7.0)), panes.to_vec())),
    ]
}

/// Returns a camera that looks at the origin.
fn camera(eye: DVec3) -> Camera {
    Camera { eye, target: DVec3::ZERO, up: DVec3::Y, fov_y_degrees: 45.0 }
}

fn world(camera: Camera, surfaces: Vec<Surface>) -> World {
    let lights = Lights { sun_direction: dvec3(-0.5, -0.8, -1.0), sun: 3.0, ambient: 1.0 };
    World { surfaces, camera, lights, background: [51; 3] }
}

fn sphere(center: DVec3, material: Material) -> Surface {
    Surface { shape: Shape::Sphere { center, radius: 1.0 }, material }
}

fn rectangle(origin: DVec3, right: DVec3, up: DVec3, material: Material) -> Surface {
    Surface { shape: Shape::Rectangle { origin, right, up }, material }
}

/// Returns the surfaces as triangles with smooth normals.
fn triangulate(world: &World) -> Vec<u8> {
    let mut document = Document::default();
    for (index, Surface { shape, material }) in world.surfaces.iter().enumerate() {
        let name = format!("surface {index}");
        let material = add_material(&mut document, &name, material);
        let mesh = match *shape {
            Shape::Sphere { center, radius } => Mesh::sphere(radius, SEGMENTS).translated(center),
            Shape::Rectangle { origin, right, up } => {
                let mut mesh = Mesh::default();
                mesh.add_quad([origin, origin + right, origin + right + up, origin + up]);
                mesh.without_uvs()
            }
        };
        let mesh = document.add_mesh(&name, &[(&mesh, material)]);
        document.add_root(&name, Some(mesh), json!({}));
    }
    document.into_glb()
}

fn add_material(document: &mut Document, name: &str, material: &Material) -> MaterialId {
    let Material { base_color: [r, g, b], alpha, metallic, roughness, unlit } = *material;
    let mut json = json!({"pbrMetallicRoughness": {"baseColorFactor": [r, g, b, alpha],
        "metallicFactor": metallic, "roughnessFactor": roughness}});
    if alpha < 1.0 {
        json["alphaMode"] = json!("BLEND");
    }
    if unlit {
        json["extensions"] = json!({"KHR_materials_unlit": {}});
    }
    document.add_finish(name, json)
}

/// Returns the setup in the form of the other references.
fn describe(name: &str, world: &World) -> Value {
    let World { camera, lights, background, .. } = world;
    json!({
        "model": format!("models/{name}.glb"),
        "size": [SIZE.0, SIZE.1],
        "time": null,
        "camera": {"eye": camera.eye.to_array(), "target": camera.target.to_array(),
            "up": camera.up.to_array(), "fov_y_degrees": camera.fov_y_degrees, "near": 0.5, "far": 50.0},
        "lights": {"sun_direction_of_travel": lights.sun_direction.to_array(),
            "sun_illuminance": lights.sun, "ambient_irradiance": lights.ambient},
        "background_srgb": background,
    })
}
