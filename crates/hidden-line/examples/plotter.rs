//! Draws a custom mesh for a pen plotter, with hidden-line removal, as SVG on standard output.
//!
//! ```text
//! cargo run -p alberti-hidden-line --example plotter > house.svg
//! ```
//!
//! A plotter moves a pen along lines and cannot paint over lines that should not be visible, so
//! lines must end where faces hide them. Hidden parts go on a separate layer, for a second pen.

#![allow(clippy::print_stdout, reason = "examples write to standard output")]

use camera::{Camera, ViewProjection};
use hidden_line::{DrawOptions, EdgeSegment, Subject, draw};
use homog::{Affine, Point, Vector};
use model::{Mesh, Model, ModelInstance, Node, Primitive};
use projection::{Convention, Fov, Perspective};
use std::error::Error;
use std::sync::Arc;

/// The width and height of the drawing in pixels.
const SIZE: [u32; 2] = [800, 600];

/// The corners of a house and of a chimney that pierces its roof.
const POSITIONS: [[f32; 3]; 18] = [
    // The floor, the eaves and the ridge.
    [-2.0, 0.0, -1.5],
    [2.0, 0.0, -1.5],
    [2.0, 0.0, 1.5],
    [-2.0, 0.0, 1.5],
    [-2.0, 2.0, -1.5],
    [2.0, 2.0, -1.5],
    [2.0, 2.0, 1.5],
    [-2.0, 2.0, 1.5],
    [-2.0, 3.2, 0.0],
    [2.0, 3.2, 0.0],
    // The chimney: the lower corners, then the upper corners.
    [0.6, 2.0, 0.3],
    [1.1, 2.0, 0.3],
    [1.1, 2.0, 0.8],
    [0.6, 2.0, 0.8],
    [0.6, 3.6, 0.3],
    [1.1, 3.6, 0.3],
    [1.1, 3.6, 0.8],
    [0.6, 3.6, 0.8],
];

/// The triangles of the house and the chimney, as index triples.
const INDICES: [u32; 84] = [
    0, 1, 2, 0, 2, 3, // the floor
    0, 4, 5, 0, 5, 1, 3, 2, 6, 3, 6, 7, // the walls below the eaves
    0, 3, 7, 0, 7, 4, 4, 7, 8, 1, 5, 6, 1, 6, 2, 5, 9, 6, // the gables
    4, 8, 9, 4, 9, 5, 7, 6, 9, 7, 9, 8, // the roof
    10, 11, 12, 10, 12, 13, 14, 17, 16, 14, 16, 15, // the bottom and the top of the chimney
    10, 14, 15, 10, 15, 11, 11, 15, 16, 11, 16, 12, // the sides of the chimney
    12, 16, 17, 12, 17, 13, 13, 17, 14, 13, 14, 10,
];

/// Converts the arrays to a model with one object.
fn house() -> ModelInstance {
    let primitive = Primitive {
        positions: POSITIONS.to_vec(),
        indices: INDICES.to_vec(),
        ..Primitive::default()
    };
    let model = Model {
        meshes: vec![Mesh { primitives: vec![primitive], ..Mesh::default() }],
        nodes: vec![Node { mesh: Some(0), ..Node::default() }],
        roots: vec![0],
        ..Model::default()
    };
    ModelInstance { model: Arc::new(model), model_to_world: Affine::IDENTITY }
}

/// Returns the SVG path data for the lines of one pen.
fn path(segments: &[EdgeSegment], visible: bool) -> String {
    let of_pen = segments.iter().filter(|segment| segment.visible == visible);
    let line = |segment: &EdgeSegment| {
        let [from, to] = segment.ends;
        format!("M{:.3} {:.3}L{:.3} {:.3}", from.x, from.y, to.x, to.y)
    };
    of_pen.map(line).collect()
}

fn main() -> Result<(), Box<dyn Error>> {
    let [width, height] = SIZE;
    let eye = Point::new(6.0, 4.5, 7.0);
    let camera = Camera::look_at(eye, Point::new(0.0, 1.4, 0.0), Vector::Y)?;
    let aspect = f64::from(width) / f64::from(height);
    let lens = Perspective::new(Fov::vertical_degrees(35.0), aspect, 1.0, 50.0)?;
    let view_projection =
        ViewProjection { camera, view_to_clip: lens.view_to_clip(Convention::CHAPTER) };
    let subject = Subject {
        models: &[house()],
        view_projection,
        size: SIZE,
        caption_height: 0,
        sections: &[],
        uncut: &[],
    };
    let drawing = draw(&subject, &DrawOptions::hidden_edges_retained(), 2)?;
    let [visible, hidden] = [true, false].map(|visible| path(&drawing.segments, visible));
    println!(
        r#"<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" fill="none" stroke="black">
<path id="visible" d="{visible}"/>
<path id="hidden" stroke="gray" stroke-dasharray="4 3" d="{hidden}"/>
</svg>"#
    );
    Ok(())
}
