//! Runners for hidden intervals of edges (HL-1).

use crate::vectors::Runner;
use crate::vectors::numbers::{parse_array, parse_number, parse_numbers, zip_arrays};
use camera::Camera;
use camera::ViewProjection;
use hidden_line::{Occluders, Projector, Tolerance};
use homog::{ClipRange, Point, Vector, World};
use projection::{Convention, Frustum, Orthographic};
use serde_json::Value;
use viewport::Viewport;

/// The runners, one per file.
pub const RUNNERS: &[(&str, Runner)] = &[("hidden_lines", check_hidden_lines)];

/// The tolerance of t, from the README of the vectors.
const TOLERANCE: f64 = 1e-9;

fn check_hidden_lines(input: &Value, out: &Value) -> Result<(), String> {
    let sight = Projector::new(
        &parse_view_projection(input)?,
        &Viewport::image_for(IMAGE_SIDE, IMAGE_SIDE, ClipRange::CHAPTER)
            .map_err(|e| e.to_string())?,
    );
    let triangles: Vec<[Point<World>; 3]> = parse_array(&input["triangles"])?
        .iter()
        .map(|triangle| {
            let [a, b, c, d, e, f, g, h, i] = parse_numbers::<9>(triangle)?;
            Ok([[a, b, c], [d, e, f], [g, h, i]].map(Point::from))
        })
        .collect::<Result<_, String>>()?;
    let tolerance = Tolerance { screen: 1e-4, world: 1e-10, min_part: 1e-7, crack: 1e-4 };
    let obstacles = Occluders::new(triangles, sight, tolerance);
    for (number, (edge, visible)) in zip_arrays(&input["edges"], &out["visible"])?.enumerate() {
        let [a, b, c, d, e, f] = parse_numbers::<6>(edge)?;
        let parts = obstacles.edge_parts([[a, b, c], [d, e, f]].map(Point::from));
        if out["fragile"][number] == true {
            continue;
        }
        let judge = |name: &str, ours: &[[f64; 2]], theirs: &Value| {
            compare_intervals(ours, theirs).map_err(|why| format!("edge {number}: {name} {why}"))
        };
        judge("visible", &parts.visible, visible)?;
        judge("hidden", &parts.hidden, &out["hidden"][number])?;
    }
    Ok(())
}

/// The side length of the picture in pixels, the unit of tolerances.
const IMAGE_SIDE: u32 = 1 << 20;

/// Half the window at distance 1. It is large because, unlike the drawing, the vectors do not clip
/// edges at the sides of the picture.
const HALF_WINDOW: f64 = 4096.0;

fn parse_view_projection(input: &Value) -> Result<ViewProjection, String> {
    let up = |gaze: Vector<World>| {
        if gaze.x() == 0.0 && gaze.z() == 0.0 { Vector::Z } else { Vector::Y }
    };
    let view_projection = if let Some(direction) = input.get("direction") {
        let gaze: Vector<World> = parse_numbers::<3>(direction)?.into();
        let camera = Camera::look_to(Point::ORIGIN, gaze, up(gaze)).map_err(|e| e.to_string())?;
        let window = Orthographic::new(
            -HALF_WINDOW,
            HALF_WINDOW,
            -HALF_WINDOW,
            HALF_WINDOW,
            -HALF_WINDOW,
            HALF_WINDOW,
        );
        let window = window.map_err(|e| e.to_string())?;
        ViewProjection { camera, view_to_clip: window.view_to_clip(Convention::CHAPTER) }
    } else {
        let eye: Point<World> = parse_numbers::<3>(&input["eye"])?.into();
        let gaze = match input.get("gaze") {
            Some(gaze) => parse_numbers::<3>(gaze)?.into(),
            None => Point::ORIGIN - eye,
        };
        let near = input.get("near").map_or(Ok(1.0 / 64.0), parse_number)?;
        let side = near * HALF_WINDOW;
        let camera = Camera::look_to(eye, gaze, up(gaze)).map_err(|e| e.to_string())?;
        let frustum = Frustum::new(-side, side, -side, side, near, 1024.0);
        let frustum = frustum.map_err(|e| e.to_string())?;
        ViewProjection { camera, view_to_clip: frustum.view_to_clip(Convention::CHAPTER) }
    };
    Ok(view_projection)
}

fn compare_intervals(ours: &[[f64; 2]], theirs: &Value) -> Result<(), String> {
    let theirs =
        parse_array(theirs)?.iter().map(parse_numbers::<2>).collect::<Result<Vec<_>, _>>()?;
    let close = |(a, b): (&[f64; 2], &[f64; 2])| (0..2).all(|i| (a[i] - b[i]).abs() <= TOLERANCE);
    if ours.len() == theirs.len() && ours.iter().zip(&theirs).all(close) {
        return Ok(());
    }
    Err(format!("is {ours:?}, not {theirs:?}"))
}
