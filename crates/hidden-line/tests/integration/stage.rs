//! Test scenes made of boxes and strips, and comparison of drawings with expected segments.

use camera::Camera;
use camera::ViewProjection;
use hidden_line::{DrawOptions, EdgeClass, EdgeSegment, LineDrawing, Subject, draw};
use homog::{Affine, Clip, Plane, Point, Projective, Vector, View, World};
use model::ModelInstance;
use model::{Mesh, Model, Node, Primitive, Topology};
use projection::{Convention, Oblique, Orthographic};
use std::sync::Arc;

pub const IMAGE_SIDE: u32 = 800;

/// Returns a model with one object for each primitive.
pub fn build_model(primitives: Vec<Primitive>) -> Model {
    let node = |mesh| Node { mesh: Some(mesh), ..Node::default() };
    Model {
        nodes: (0..primitives.len()).map(node).collect(),
        roots: (0..primitives.len()).collect(),
        meshes: primitives
            .into_iter()
            .map(|primitive| Mesh { primitives: vec![primitive], ..Mesh::default() })
            .collect(),
        ..Model::default()
    }
}

/// A scene that owns the data that a [`Subject`] borrows.
pub struct TestScene {
    pub models: Vec<ModelInstance>,
    pub view_projection: ViewProjection,
    pub sections: Vec<Plane<World>>,
    pub uncut: Vec<u32>,
}

impl TestScene {
    pub fn drawing_subject(&self) -> Subject<'_> {
        Subject {
            models: &self.models,
            view_projection: self.view_projection,
            size: [IMAGE_SIDE; 2],
            caption_height: 0,
            sections: &self.sections,
            uncut: &self.uncut,
        }
    }
}

pub fn drawing_scene(model: Model, view_projection: ViewProjection) -> TestScene {
    let instance =
        ModelInstance { model: Arc::new(model), model_to_world: Affine::scale(1.0, 1.0, 1.0) };
    TestScene { models: vec![instance], view_projection, sections: Vec::new(), uncut: Vec::new() }
}

/// Returns a view along −z from the origin.
pub fn view_projection(view_to_clip: Projective<View, Clip>) -> ViewProjection {
    let camera = Camera::look_to(Point::ORIGIN, -Vector::Z, Vector::Y).unwrap();
    ViewProjection { camera, view_to_clip }
}

/// Returns the projection through a window from −4 to 4, with depths from −8 to 8.
pub fn window_projection() -> Projective<View, Clip> {
    let window = Orthographic::new(-4.0, 4.0, -4.0, 4.0, -8.0, 8.0).unwrap();
    window.view_to_clip(Convention::CHAPTER)
}

/// Returns an oblique view from the front, the right and above: X = x − z/2, Y = y − z/2.
pub fn oblique_view() -> ViewProjection {
    let oblique = Oblique::by_direction(Vector::new(-0.5, -0.5, -1.0), 0.0).unwrap();
    view_projection(oblique.depth_preserving().then_project(window_projection()))
}

pub fn triangle_mesh(positions: &[[f32; 3]], indices: &[u32]) -> Primitive {
    Primitive { positions: positions.to_vec(), indices: indices.to_vec(), ..Primitive::default() }
}

pub fn line_mesh(positions: &[[f32; 3]]) -> Primitive {
    let indices = (0..positions.len() as u32).collect();
    let topology = Topology::Lines;
    Primitive { positions: positions.to_vec(), indices, topology, ..Primitive::default() }
}

/// Returns a quadrilateral, split along the diagonal from its first corner.
pub fn quad_mesh(corners: [[f32; 3]; 4]) -> Primitive {
    triangle_mesh(&corners, &[0, 1, 2, 0, 2, 3])
}

/// Returns a box. Faces do not share vertices, as is common in files.
pub fn cuboid_mesh(min: [f32; 3], max: [f32; 3]) -> Primitive {
    let corner = |n: usize| [0, 1, 2].map(|axis| if n >> axis & 1 == 0 { min } else { max }[axis]);
    let faces =
        [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let positions: Vec<[f32; 3]> = faces.as_flattened().iter().map(|&n| corner(n)).collect();
    let indices: Vec<u32> = (0..6).flat_map(|f| [0, 1, 2, 0, 2, 3].map(|k| 4 * f + k)).collect();
    triangle_mesh(&positions, &indices)
}

/// The ends of a segment, in picture units.
pub type Segment = [[f64; 2]; 2];

/// Returns the drawing with hidden segments retained, and asserts that two threads give the same
/// result.
pub fn draw_scene_lines(scene: &TestScene) -> LineDrawing {
    let drawing = draw(&scene.drawing_subject(), &DrawOptions::hidden_edges_retained(), 1).unwrap();
    assert_eq!(
        drawing,
        draw(&scene.drawing_subject(), &DrawOptions::hidden_edges_retained(), 2).unwrap()
    );
    drawing
}

/// Returns the lines selected by a predicate, as segments in picture units.
pub fn segments_where(
    drawing: &LineDrawing,
    choose: impl Fn(&EdgeSegment) -> bool,
) -> Vec<Segment> {
    let unit = |at: glam::DVec2| [(at.x - 400.0) / 100.0, (400.0 - at.y) / 100.0];
    drawing.segments.iter().filter(|line| choose(line)).map(|line| line.ends.map(unit)).collect()
}

pub fn is_visible_class(class: EdgeClass) -> impl Fn(&EdgeSegment) -> bool {
    move |line| line.visible && line.class == class
}

/// Asserts that the lines are on the expected segments and cover them exactly once.
#[track_caller]
pub fn assert_segments_cover(lines: &[Segment], expected: &[Segment]) {
    const NEAR: f64 = 1e-9;
    let length = |[a, b]: Segment| glam::DVec2::from(a).distance(b.into());
    let mut filled = vec![0.0; expected.len()];
    for &line in lines {
        let carries = |segment: &Segment| {
            line.iter().all(|p| {
                let gone = length([segment[0], *p]) + length([*p, segment[1]]);
                gone - length(*segment) < NEAR
            })
        };
        let at = expected.iter().position(carries);
        filled[at.unwrap_or_else(|| panic!("{line:?} is unexpected: {lines:?}"))] += length(line);
    }
    for (segment, filled) in expected.iter().zip(filled) {
        let segment_total = length(*segment);
        assert!(
            (filled - segment_total).abs() < NEAR,
            "{segment:?} is covered by a length of {filled}, not {segment_total}"
        );
    }
}
