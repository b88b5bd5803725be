//! The panes around the picture: the world from outside, and the canonical view volume after the
//! divide.
//!
//! ```text
//!  world:   eye ─── near ─── far        triangles inside, clipped and outside in three colors
//!  volume:  ┌─────────┐                 the same after clipping and the divide, in [−1, 1]³
//! ```

use crate::ExplorerError;
use crate::facts::views;
use crate::model_store::LoadedScene;
use crate::triangle_survey::{Containment, WorldTriangle, classify, project};
use camera::{Basis, Camera, ViewProjection, frame_parallel};
use clip::{Volume, clip_triangle};
use drawing::{Overlay, PointLabel, palette};
use glam::DVec2;
use homog::{Affine, Point, Projective, View, World};
use model::{Material, Mesh, Model, ModelInstance, Node, Primitive, Topology};
use pipeline::explain::ApiConventions;
use pipeline::scene::parse_scene;
use pipeline::{Origin, Scene};
use projection::{Convention, Orthographic, ViewVolume};
use std::sync::Arc;

/// The colors of triangles inside, clipped and outside, in sRGB.
pub(crate) const COLORS: [(&str, [u8; 3]); 3] =
    [("inside", [122, 166, 218]), ("clipped", [230, 159, 0]), ("outside", [190, 186, 180])];

/// What both panes have in common; camera, size and overlays follow.
const SCENE: &str = r##"Scene(
    models: [Model(path: "triangles")],
    camera: Camera(projection: Orthographic()),
    lights: [Directional(direction: (-1, -2, -1.5), intensity: 1.6), Ambient(intensity: 1)],
    style: Flat,
    image: Image(background: Color("#ffffff")),
)"##;

/// The margin around what is framed, as a part of the picture's side.
const PADDING: f64 = 0.07;

/// How a pane is looked at.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Observer {
    /// Azimuth and elevation in degrees.
    pub(crate) orbit: [f64; 2],
    pub(crate) size: [u32; 2],
    pub(crate) samples: u32,
}

/// The scene of the world from outside. It is framed around the scene of the lesson's defaults, so
/// that it stands still while a value is dragged.
///
/// # Errors
/// As the stages that refuse; what they say.
pub(crate) fn world_scene(
    loaded: &LoadedScene,
    defaults: &LoadedScene,
    observer: Observer,
) -> Result<Scene, ExplorerError> {
    let shown = views(&loaded.scene);
    let first = shown[0].view_projection;
    let mut groups: [Vec<[[f32; 3]; 3]>; 3] = Default::default();
    for triangle in loaded.models.triangles.drawn() {
        let (containment, _) = classify(project(&first, triangle));
        groups[containment as usize].push(triangle.map(to_f32));
    }
    let framed = framed_points(&views(&defaults.scene), defaults.models.triangles.drawn());
    let mut scene = pane_scene(&groups, observer, framed)?;
    for view in shown.iter().take(4) {
        scene.overlays.push(Overlay::Volume(Box::new(view.view_projection)));
        scene.overlays.extend(plane_labels(&view.view_projection));
    }
    Ok(scene)
}

/// The scene of the canonical view volume, with what clipping leaves of the triangles in it.
///
/// # Errors
/// As [`world_scene`].
pub(crate) fn volume_scene(
    loaded: &LoadedScene,
    conventions: ApiConventions,
    observer: Observer,
) -> Result<Scene, ExplorerError> {
    let view = views(&loaded.scene)[0].view_projection;
    let mut groups: [Vec<[[f32; 3]; 3]>; 3] = Default::default();
    for triangle in loaded.models.triangles.drawn() {
        let corners = project(&view, triangle);
        let (containment, _) = classify(corners);
        if containment == Containment::Outside {
            continue;
        }
        let clipped = clip_triangle(corners, &Volume::CHAPTER);
        let divided = clipped.triangles().filter_map(|fan| {
            let [a, b, c] = fan.map(|corner| corner.point.divide());
            Some([a?, b?, c?].map(|ndc| <[f64; 3]>::from(ndc).map(|c| c as f32)))
        });
        groups[containment as usize].extend(divided);
    }
    let corners = [-1.0, 1.0].map(|x| [-1.0, 1.0].map(|y| [-1.0, 1.0].map(|z| [x, y, z])));
    let cube = corners.as_flattened().as_flattened().iter().map(|corner| Point::from(*corner));
    let mut scene = pane_scene(&groups, observer, cube.collect())?;
    let camera = Camera::new(Point::ORIGIN, Basis::WORLD).map_err(camera_error)?;
    let canonical =
        ViewProjection { camera, view_to_clip: Projective::from_raw(glam::DMat4::IDENTITY) };
    scene.overlays.push(Overlay::Volume(Box::new(canonical)));
    scene.overlays.extend(canonical_labels(conventions));
    Ok(scene)
}

fn to_f32(point: Point<World>) -> [f32; 3] {
    <[f64; 3]>::from(point).map(|c| c as f32)
}

fn camera_error(error: camera::CameraError) -> ExplorerError {
    ExplorerError::new("invalid_scene", error.to_string(), "reset the view")
}

/// The points that the world is framed around: the models, the eyes and the corners of the volumes.
fn framed_points(shown: &[&Scene], triangles: &[WorldTriangle]) -> Vec<Point<World>> {
    let mut points: Vec<Point<World>> = triangles.iter().flatten().copied().collect();
    for scene in shown {
        let view = scene.view_projection;
        let volume = ViewVolume::new(view.view_to_clip, Convention::CHAPTER);
        let to_world = view.camera.view_to_world();
        let corners = volume.corners().into_iter().flatten().chain(volume.eye());
        let finite = corners.filter_map(|corner| corner.divide());
        points.extend(finite.map(|point: Point<View>| to_world.transform_point(point)));
    }
    points
}

/// The scene of groups of triangles, framed around points.
fn pane_scene(
    groups: &[Vec<[[f32; 3]; 3]>; 3],
    observer: Observer,
    framed: Vec<Point<World>>,
) -> Result<Scene, ExplorerError> {
    let file = parse_scene("pane", SCENE)
        .map_err(|errors| ExplorerError::from(pipeline::ResolveError::Scene(errors)))?;
    let origin = Origin::from_text("pane", SCENE, Default::default());
    let mut file = file;
    let [width, height] = observer.size;
    file.image.size = (width, height);
    file.image.samples = observer.samples;
    let instance = triangle_model(groups, &framed);
    let mut scene = Scene::from_models(&origin, &file, vec![instance])?;
    scene.view_projection = observer_view(observer, framed)?;
    Ok(scene)
}

/// A parallel view of points, with room in depth for what is beside them.
fn observer_view(
    observer: Observer,
    points: Vec<Point<World>>,
) -> Result<ViewProjection, ExplorerError> {
    let [azimuth, elevation] = observer.orbit.map(f64::to_radians);
    let basis = Basis::from_azimuth_elevation(azimuth, elevation).map_err(camera_error)?;
    let aspect = f64::from(observer.size[0]) / f64::from(observer.size[1]);
    let invalid = |message: String| ExplorerError::new("invalid_scene", message, "reset the view");
    let framed = frame_parallel(points, basis, aspect, PADDING)
        .map_err(|error| invalid(error.to_string()))?;
    let room = 4.0 * (framed.far - framed.near + framed.top - framed.bottom);
    let (near, far) = (framed.near - room, framed.far + room);
    let volume = Orthographic::new(framed.left, framed.right, framed.bottom, framed.top, near, far)
        .map_err(|error| invalid(error.to_string()))?;
    let view_to_clip = volume.view_to_clip(Convention::CHAPTER);
    Ok(ViewProjection { camera: framed.camera, view_to_clip })
}

/// A model of three groups of triangles, each in its color. Without any triangle it has one without
/// area, so that the overlays have something to stand around.
fn triangle_model(groups: &[Vec<[[f32; 3]; 3]>; 3], framed: &[Point<World>]) -> ModelInstance {
    let mut primitives: Vec<Primitive> = groups
        .iter()
        .enumerate()
        .filter(|(_, triangles)| !triangles.is_empty())
        .map(|(group, triangles)| primitive(group, triangles))
        .collect();
    if primitives.is_empty() {
        let point = framed.first().map_or([0.0; 3], |point| to_f32(*point));
        primitives.push(primitive(0, &[[point; 3]]));
    }
    let materials = COLORS.map(|(name, color)| material(name, color)).to_vec();
    let node = Node { mesh: Some(0), ..Node::default() };
    let meshes = vec![Mesh { primitives, ..Mesh::default() }];
    let name = "triangles".to_owned();
    let model =
        Model { name, meshes, materials, nodes: vec![node], roots: vec![0], ..Model::default() };
    ModelInstance { model: Arc::new(model), model_to_world: Affine::IDENTITY }
}

fn primitive(material: usize, triangles: &[[[f32; 3]; 3]]) -> Primitive {
    Primitive {
        topology: Topology::Triangles,
        indices: (0..3 * triangles.len() as u32).collect(),
        positions: triangles.as_flattened().to_vec(),
        material: Some(material),
        ..Primitive::default()
    }
}

fn material(name: &str, color: [u8; 3]) -> Material {
    let linear = color.map(|code| {
        let encoded = (f64::from(code) / 255.0 + 0.055) / 1.055;
        libm::pow(encoded, 2.4) as f32
    });
    let [r, g, b] = linear;
    Material {
        name: Some(name.to_owned()),
        base_color: [r, g, b, 1.0],
        metallic: 0.0,
        double_sided: true,
        ..Material::default()
    }
}

/// The names of the near and the far plane, at a corner of each.
fn plane_labels(view: &ViewProjection) -> Vec<Overlay> {
    let volume = ViewVolume::new(view.view_to_clip, Convention::CHAPTER);
    let Some(corners) = volume.corners() else { return Vec::new() };
    let to_world = view.camera.view_to_world();
    let label = |(at, text): (usize, &str)| {
        let corner = to_world.transform_point(corners[at].divide()?);
        Some(label_at(corner, text, DVec2::new(4.0, -4.0)))
    };
    [(2, "near"), (6, "far")].into_iter().filter_map(label).collect()
}

/// The coordinates of the faces of the canonical view volume, in these conventions.
fn canonical_labels(conventions: ApiConventions) -> Vec<Overlay> {
    let [near, far] = match conventions {
        ApiConventions::OpenGl => [-1, 1],
        ApiConventions::Vulkan | ApiConventions::Direct3d | ApiConventions::WebGpu => [0, 1],
        _ => [1, -1],
    };
    let faces: [([f64; 3], String); 6] = [
        ([-1.0, 0.0, 0.0], "x = -1".to_owned()),
        ([1.0, 0.0, 0.0], "x = 1".to_owned()),
        ([0.0, -1.0, 0.0], "y = -1".to_owned()),
        ([0.0, 1.0, 0.0], "y = 1".to_owned()),
        ([0.0, 0.0, 1.0], format!("near z = {near}")),
        ([0.0, 0.0, -1.0], format!("far z = {far}")),
    ];
    let label = |(at, text): ([f64; 3], String)| label_at(Point::from(at), &text, DVec2::ZERO);
    faces.into_iter().map(label).collect()
}

fn label_at(at: Point<World>, text: &str, offset: DVec2) -> Overlay {
    let (ink, height) = (palette::INK, 12.0);
    Overlay::Label(PointLabel { at, text: text.to_owned(), offset, ink, height, leader: false })
}
