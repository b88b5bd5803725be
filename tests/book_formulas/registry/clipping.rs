//! Registry entries for half-spaces, segments, polygons and interpolation (CL-1 to CL-4, IN-1,
//! IN-2).

use super::Entry;
use super::inputs::{Answer, Inputs, give};
use clip::{PlaneIndex, Volume, clip_segment, clip_triangle};
use homog::{Clip, Foreshortening, HPoint, perspective_weights};
use std::error::Error;

const IN_TRIANGLE: &str = "\\lambda_0 \\lambda_1 \\lambda_2 a_0 a_1 a_2 w_0 w_1 w_2";

pub const ENTRIES: &[Entry] = &[
    Entry::new("CL-1", "x y z w", |v| {
        let [x, y, z, w] = v.numbers()?;
        distances(&Volume::OPENGL, PlaneIndex::BOX, HPoint::new(x, y, z, w))
    }),
    Entry::new("CL-1.x", "x w", |v| along_x(v, [PlaneIndex::LEFT, PlaneIndex::RIGHT])),
    Entry::new("CL-2.t", "a b", |v| segment_parameter(v.numbers()?)),
    Entry::new("CL-3.t", "d_a d_b", |v| give(polygon_parameter(v)?)),
    Entry::new("CL-4", "k x w", |v| {
        let [k, x, w] = v.numbers()?;
        let volume = Volume::OPENGL.with_guard_band(k, k)?;
        distances(&volume, [PlaneIndex::LEFT, PlaneIndex::RIGHT], HPoint::new(x, 0.0, 0.0, w))
    }),
    Entry::new("IN-1", "t w_r w_R", |v| {
        let [t, start, end] = v.numbers()?;
        give(Foreshortening::new(start, end)?.image_parameter(t).ok_or("no image")?)
    }),
    Entry::new("IN-1.inverse", "s w_r w_R", |v| {
        let [s, start, end] = v.numbers()?;
        give(Foreshortening::new(start, end)?.source_parameter(s).ok_or("no source")?)
    }),
    Entry::new("IN-1.derivative", "t w_r w_R", |v| {
        let [t, start, end] = v.numbers()?;
        give(Foreshortening::new(start, end)?.derivative(t).ok_or("no derivative")?)
    }),
    Entry::new("IN-2", "s a_0 a_1 w_0 w_1", |v| {
        let [s, a_0, a_1, w_0, w_1] = v.numbers()?;
        let segment = Foreshortening::new(w_0, w_1)?;
        give(segment.interpolate_attribute(s, a_0, a_1).ok_or("no value")?)
    }),
    Entry::new("IN-2.triangle", IN_TRIANGLE, triangle_attribute),
];

/// Returns the values of planes at a point: a number for one plane, a column for several.
fn distances<const N: usize>(
    volume: &Volume,
    planes: [PlaneIndex; N],
    point: HPoint<Clip>,
) -> Answer {
    let values = planes.map(|index| volume.plane(index).map(|plane| plane.evaluate(point)));
    let values = values.into_iter().collect::<Option<Vec<f64>>>().ok_or("the plane is missing")?;
    Ok(crate::book_formulas::value::Value::column(&values))
}

fn along_x<const N: usize>(v: &Inputs<'_>, planes: [PlaneIndex; N]) -> Answer {
    let [x, w] = v.numbers()?;
    distances(&Volume::OPENGL, planes, HPoint::new(x, 0.0, 0.0, w))
}

/// Clips a segment in clip space whose endpoints have these values at the left plane, up to a
/// common factor, and are inside the other planes.
fn segment_parameter([a, b]: [f64; 2]) -> Answer {
    let largest = a.abs().max(b.abs());
    let end = |value: f64| HPoint::new(value / largest - 1.0, 0.0, 0.0, 1.0);
    let cut = clip_segment(end(a), end(b), &Volume::OPENGL).ok_or("the segment is clipped away")?;
    match (a < 0.0, b < 0.0) {
        (true, false) => give(cut.t0),
        (false, true) => give(cut.t1),
        _ => Err("exactly one of a and b must be negative".into()),
    }
}

/// Clips a triangle whose edge from the first to the second vertex crosses the left plane.
fn polygon_parameter(v: &Inputs<'_>) -> Result<f64, Box<dyn Error>> {
    let [inside, outside] = v.these::<2>("d_a d_b")?;
    if inside < 0.0 || outside >= 0.0 {
        return Err("d_a ≥ 0 > d_b must hold".into());
    }
    let largest = inside.abs().max(outside.abs());
    let vertex = |value: f64, y: f64| HPoint::new(value / largest - 1.0, y, 0.0, 1.0);
    let triangle = [vertex(inside, 0.0), vertex(outside, 0.0), vertex(inside, 0.5)];
    let polygon = clip_triangle(triangle, &Volume::OPENGL);
    let mut cuts = polygon.vertices().iter().map(|vertex| vertex.weights);
    let cut = cuts.find(|weights| weights[2] == 0.0 && weights[1] > 0.0);
    Ok(cut.ok_or("the edge is not clipped")?[1])
}

fn triangle_attribute(v: &Inputs<'_>) -> Answer {
    let weights =
        perspective_weights(v.these("\\lambda_0 \\lambda_1 \\lambda_2")?, v.these("w_0 w_1 w_2")?);
    let attributes = v.these::<3>("a_0 a_1 a_2")?;
    let weights = weights.ok_or("no weights")?;
    give(weights.iter().zip(attributes).map(|(weight, value)| weight * value).sum::<f64>())
}
