//! Segments and triangles against the canonical volumes (CL-1 to CL-3).

use crate::Runner;
use crate::numbers::{TOLERANCE, close, close_all, count, field, list, numbers, point4, text};
use clip::{ClipVertex, PlaneIndex, Volume, clip_segment, clip_triangle};
use homog::{Clip, HPoint};
use serde_json::Value;

/// One per file.
pub const RUNNERS: &[(&str, Runner)] = &[("clip_segment", segment), ("clip_polygon", polygon)];

fn volume(case: &Value) -> Result<Volume, String> {
    match text(case, "volume")? {
        "neg_one_one" => Ok(Volume::OPENGL),
        "zero_one" => Ok(Volume::ZERO_ONE),
        other => Err(format!("unknown volume {other}")),
    }
}

fn segment(case: &Value, out: &Value) -> Result<(), String> {
    let [p, q]: [HPoint<Clip>; 2] = [point4(&case["p"])?.into(), point4(&case["q"])?.into()];
    let volume = volume(case)?;
    let clipped = clip_segment(p, q, &volume);
    if out.get("error").is_some() {
        return clipped.map_or(Ok(()), |left| Err(format!("must be refused, gives {left:?}")));
    }
    for (name, end) in [("outcode_p", p), ("outcode_q", q)] {
        let (ours, theirs) = (volume.outcode(end).bits(), count(out, name)?);
        if u32::from(ours) != theirs {
            return Err(format!("{name} is {ours}, not {theirs}"));
        }
    }
    let kind = text(out, "kind")?;
    let Some(left) = clipped else {
        return if kind == "empty" { Ok(()) } else { Err(format!("is empty, not a {kind}")) };
    };
    if kind == "empty" {
        return Err(format!("must be empty, gives {left:?}"));
    }
    close("t0", left.t0, field(out, "t0")?, TOLERANCE)?;
    close("t1", left.t1, field(out, "t1")?, TOLERANCE)?;
    close_all("p", &<[f64; 4]>::from(left.start), &point4(&out["p"])?, TOLERANCE)?;
    close_all("q", &<[f64; 4]>::from(left.end), &point4(&out["q"])?, TOLERANCE)?;
    close_all("p_ndc", &divided(left.start)?, &numbers::<3>(&out["p_ndc"])?, TOLERANCE)?;
    close_all("q_ndc", &divided(left.end)?, &numbers::<3>(&out["q_ndc"])?, TOLERANCE)?;
    same_plane("enter_plane", left.enter, &out["enter_plane"])?;
    same_plane("exit_plane", left.exit, &out["exit_plane"])
}

fn same_plane(name: &str, ours: Option<PlaneIndex>, theirs: &Value) -> Result<(), String> {
    let number = ours.map(|plane| plane.index() as u64);
    if number == theirs.as_u64() {
        Ok(())
    } else {
        Err(format!("{name} is {ours:?}, not {theirs}"))
    }
}

fn divided(point: HPoint<Clip>) -> Result<[f64; 3], String> {
    point.divide().map(Into::into).ok_or_else(|| format!("{point:?} does not divide"))
}

fn polygon(case: &Value, out: &Value) -> Result<(), String> {
    let corners: Vec<[f64; 4]> =
        list(&case["triangle"])?.iter().map(point4).collect::<Result<_, _>>()?;
    let corners: [[f64; 4]; 3] = corners.try_into().map_err(|_| "not three corners")?;
    let polygon = clip_triangle(corners.map(HPoint::from), &volume(case)?);
    let vertices = polygon.vertices();
    if out.get("error").is_some() {
        return if polygon.is_empty() { Ok(()) } else { Err("must be refused".into()) };
    }
    let count = list(&out["vertices"])?.len();
    if vertices.len() != count {
        return Err(format!("has {} vertices, not {count}: {vertices:?}", vertices.len()));
    }
    if count == 0 {
        return Ok(());
    }
    // Any rotation will do; the differences of the best one are told.
    let fits = (0..count).map(|shift| same_ring(vertices, shift, out));
    fits.reduce(Result::or).unwrap_or(Ok(()))?;
    let fraction = fraction(vertices);
    close("fraction_of_triangle", fraction, field(out, "fraction_of_triangle")?, TOLERANCE)?;
    close("ndc_area", ndc_area(vertices)?, field(out, "ndc_area")?, TOLERANCE)
}

fn same_ring(vertices: &[ClipVertex], shift: usize, out: &Value) -> Result<(), String> {
    for i in 0..vertices.len() {
        let ours = &vertices[(i + shift) % vertices.len()];
        let name = |what: &str| format!("{what} of vertex {i}");
        let point = <[f64; 4]>::from(ours.point);
        close_all(&name("place"), &point, &point4(&out["vertices"][i])?, TOLERANCE)?;
        close_all(&name("bary"), &ours.weights, &numbers::<3>(&out["bary"][i])?, TOLERANCE)?;
        close_all(&name("ndc"), &divided(ours.point)?, &numbers::<3>(&out["ndc"][i])?, TOLERANCE)?;
    }
    Ok(())
}

/// The area in the space of weights, the whole triangle being 1.
fn fraction(vertices: &[ClipVertex]) -> f64 {
    area(&vertices.iter().map(|v| [v.weights[1], v.weights[2]]).collect::<Vec<_>>()) * 2.0
}

fn ndc_area(vertices: &[ClipVertex]) -> Result<f64, String> {
    let places = vertices.iter().map(|v| divided(v.point).map(|[x, y, _]| [x, y]));
    Ok(area(&places.collect::<Result<Vec<_>, _>>()?))
}

/// The signed area of a polygon, counter-clockwise positive.
fn area(ring: &[[f64; 2]]) -> f64 {
    let ends = ring.iter().cycle().skip(1);
    ring.iter().zip(ends).map(|(a, b)| (a[0] * b[1] - a[1] * b[0]) / 2.0).sum()
}
