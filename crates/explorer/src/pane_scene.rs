//! Scenes of the panes next to the main picture, with view volumes, labels, and triangles colored
//! by the effect of clipping.

use crate::ExplorerError;
use crate::triangle_survey::Containment;
use camera::{Basis, Camera, ViewProjection, frame_parallel};
use drawing::{Overlay, PointLabel};
use glam::DVec2;
use homog::{Affine, Point, World};
use model::{Material, Mesh, Model, ModelInstance, Node, Primitive, Topology};
use page::palette;
use pipeline::{Origin, Scene};
use projection::{Convention, Orthographic};
use scene_file::SceneFile;
use scene_file::file::{BackgroundFile, Color, LightFile, ProjectionFile, StyleFile};
use shade::color::srgb_to_linear_table;
use std::path::PathBuf;
use std::sync::Arc;

/// The sRGB colors of inside, clipped and outside triangles, and of the line of sight.
pub(crate) const COLORS: [(&str, [u8; 3]); 4] = [
    ("inside", [122, 166, 218]),
    ("clipped", [230, 159, 0]),
    ("outside", [190, 186, 180]),
    ("sight", [200, 30, 90]),
];

/// The index of the line-of-sight color.
const SIGHT: usize = 3;

/// The margin around the framed points, as a fraction of the picture's side.
const PADDING: f64 = 0.07;

/// The view of a pane.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Observer {
    /// The azimuth and elevation in degrees.
    pub(crate) orbit: [f64; 2],
    pub(crate) size: [u32; 2],
    pub(crate) samples: u32,
}

/// The geometry of a pane.
#[derive(Debug, Default)]
pub(crate) struct PaneGeometry {
    /// The inside, clipped and outside triangles.
    triangles: [Vec<[[f32; 3]; 3]>; 3],
    /// The endpoints of the lines, by color.
    lines: [Vec<[[f32; 3]; 2]>; 4],
}

impl PaneGeometry {
    /// Adds a triangle.
    pub(crate) fn add_triangle(&mut self, containment: Containment, corners: [[f64; 3]; 3]) {
        self.triangles[containment as usize].push(corners.map(to_f32));
    }

    /// Adds the line of sight.
    pub(crate) fn add_sight(&mut self, ends: [[f64; 3]; 2]) {
        self.lines[SIGHT].push(ends.map(to_f32));
    }

    /// Adds the edges of a triangle.
    pub(crate) fn add_edges(&mut self, containment: Containment, [a, b, c]: [[f64; 3]; 3]) {
        let edges = [[a, b], [b, c], [c, a]].map(|ends| ends.map(to_f32));
        self.lines[containment as usize].extend(edges);
    }

    /// Returns the scene, framed around points.
    ///
    /// # Errors
    /// Returns an error if there are no points, or if a point is not finite.
    pub(crate) fn into_scene(
        self,
        observer: Observer,
        framed: Vec<Point<World>>,
    ) -> Result<Scene, ExplorerError> {
        let mut file = SceneFile::from_model_path("triangles".to_owned());
        file.camera.projection = Some(ProjectionFile::ORTHOGRAPHIC);
        let key_light = LightFile::directional([-1.0, -2.0, -1.5], 1.6)?;
        file.lights = Some(vec![key_light, LightFile::ambient(1.0)?]);
        file.style = StyleFile::Flat;
        file.image.background = Some(BackgroundFile::Color(Color::WHITE));
        file.image.size = observer.size.into();
        file.image.samples = observer.samples;
        let origin = Origin::from_text("pane", "", PathBuf::new());
        let instance = self.into_model(&framed);
        let mut scene = Scene::from_models(&origin, &file, &[instance])?;
        scene.view_projection = observer_view(observer, framed)?;
        Ok(scene)
    }

    /// Returns the model. If there are no triangles, it has a degenerate triangle, so that the
    /// overlays have an object to enclose.
    fn into_model(self, framed: &[Point<World>]) -> ModelInstance {
        let groups = self.triangles.iter().enumerate();
        let mut primitives: Vec<Primitive> = groups
            .filter(|(_, triangles)| !triangles.is_empty())
            .map(|(at, all)| primitive(at, Topology::Triangles, all.as_flattened()))
            .collect();
        if primitives.is_empty() {
            let point = framed.first().map_or([0.0; 3], |point| to_f32((*point).into()));
            primitives.push(primitive(0, Topology::Triangles, &[point; 3]));
        }
        let lines = self.lines.iter().enumerate().filter(|(_, lines)| !lines.is_empty());
        let first = COLORS.len();
        primitives.extend(
            lines.map(|(at, all)| primitive(first + at, Topology::Lines, all.as_flattened())),
        );
        let model = Model {
            name: "triangles".to_owned(),
            meshes: vec![Mesh { primitives, ..Mesh::default() }],
            materials: [false, true]
                .map(|unlit| COLORS.map(|(name, color)| material(name, color, unlit)))
                .concat(),
            nodes: vec![Node { mesh: Some(0), ..Node::default() }],
            roots: vec![0],
            ..Model::default()
        };
        ModelInstance { model: Arc::new(model), model_to_world: Affine::IDENTITY }
    }
}

fn to_f32(point: [f64; 3]) -> [f32; 3] {
    point.map(|c| c as f32)
}

fn primitive(material: usize, topology: Topology, positions: &[[f32; 3]]) -> Primitive {
    Primitive {
        topology,
        indices: (0..positions.len() as u32).collect(),
        positions: positions.to_vec(),
        material: Some(material),
        ..Primitive::default()
    }
}

/// Returns a material. Surfaces are lit, but lines are not.
fn material(name: &str, color: [u8; 3], unlit: bool) -> Material {
    let [r, g, b] = color.map(|code| srgb_to_linear_table()[usize::from(code)]);
    Material {
        name: Some(name.to_owned()),
        base_color: [r, g, b, 1.0],
        metallic: 0.0,
        double_sided: true,
        unlit,
        ..Material::default()
    }
}

/// Returns a parallel view of points, with a depth range that leaves space for other objects.
fn observer_view(
    observer: Observer,
    points: Vec<Point<World>>,
) -> Result<ViewProjection, ExplorerError> {
    let invalid = |message: String| ExplorerError::new("invalid_scene", message, "reset the view");
    let [azimuth, elevation] = observer.orbit.map(f64::to_radians);
    let basis = Basis::from_azimuth_elevation(azimuth, elevation)
        .map_err(|error| invalid(error.to_string()))?;
    let aspect = f64::from(observer.size[0]) / f64::from(observer.size[1]);
    let framed = frame_parallel(points, basis, aspect, PADDING)
        .map_err(|error| invalid(error.to_string()))?;
    let room = 4.0 * (framed.far - framed.near + framed.top - framed.bottom);
    let [near, far] = [framed.near - room, framed.far + room];
    let camera::ParallelFraming { left, right, bottom, top, camera, .. } = framed;
    let volume = Orthographic::new(left, right, bottom, top, near, far)
        .map_err(|error| invalid(error.to_string()))?;
    Ok(ViewProjection { camera, view_to_clip: volume.view_to_clip(Convention::CHAPTER) })
}

/// Returns a camera at the origin that looks along −z.
pub(crate) fn camera_at_origin() -> Result<Camera, ExplorerError> {
    Camera::new(Point::ORIGIN, Basis::WORLD)
        .map_err(|error| ExplorerError::new("invalid_scene", error.to_string(), "reset the view"))
}

/// Returns a text label offset from a point by `[x, y]` pixels.
pub(crate) fn label_at(at: Point<World>, text: &str, [x, y]: [f64; 2]) -> Overlay {
    let (ink, height) = (palette::INK, 12.0);
    let offset = DVec2::new(x, y);
    Overlay::Label(PointLabel { at, text: text.to_owned(), offset, ink, height, leader: false })
}

/// Returns a named point, with the name at the end of a short line.
pub(crate) fn named_point(at: Point<World>, text: &str) -> Overlay {
    let (_, ink) = COLORS[SIGHT];
    let (offset, height) = (DVec2::new(14.0, -14.0), 12.0);
    Overlay::Label(PointLabel { at, text: text.to_owned(), offset, ink, height, leader: true })
}
