//! Runners for segments and triangles against the canonical volumes (CL-1 to CL-3).

use crate::vectors::Runner;
use crate::vectors::numbers::{
    TOLERANCE, assert_all_close, assert_close, count_field, number_field, parse_array,
    parse_numbers, parse_point4, text_field,
};
use clip::{ClipVertex, PlaneIndex, Volume, clip_segment, clip_triangle};
use homog::{Clip, HPoint};
use serde_json::Value;

/// The runners, one per file.
pub const RUNNERS: &[(&str, Runner)] =
    &[("clip_segment", check_segment), ("clip_polygon", check_polygon)];

fn parse_volume(case: &Value) -> Result<Volume, String> {
    match text_field(case, "volume")? {
        "neg_one_one" => Ok(Volume::OPENGL),
        "zero_one" => Ok(Volume::ZERO_ONE),
        other => Err(format!("unknown volume {other}")),
    }
}

fn check_segment(case: &Value, out: &Value) -> Result<(), String> {
    let [p, q]: [HPoint<Clip>; 2] =
        [parse_point4(&case["p"])?.into(), parse_point4(&case["q"])?.into()];
    let volume = parse_volume(case)?;
    let clipped = clip_segment(p, q, &volume);
    if out.get("error").is_some() {
        return clipped.map_or(Ok(()), |left| Err(format!("must be rejected, but gives {left:?}")));
    }
    for (name, end) in [("outcode_p", p), ("outcode_q", q)] {
        let (ours, theirs) = (volume.outcode(end).bits(), count_field(out, name)?);
        if u32::from(ours) != theirs {
            return Err(format!("{name} is {ours}, not {theirs}"));
        }
    }
    let kind = text_field(out, "kind")?;
    let Some(left) = clipped else {
        return if kind == "empty" { Ok(()) } else { Err(format!("is empty, not a {kind}")) };
    };
    if kind == "empty" {
        return Err(format!("must be empty, but gives {left:?}"));
    }
    assert_close("t0", left.t0, number_field(out, "t0")?, TOLERANCE)?;
    assert_close("t1", left.t1, number_field(out, "t1")?, TOLERANCE)?;
    assert_all_close("p", &<[f64; 4]>::from(left.start), &parse_point4(&out["p"])?, TOLERANCE)?;
    assert_all_close("q", &<[f64; 4]>::from(left.end), &parse_point4(&out["q"])?, TOLERANCE)?;
    assert_all_close(
        "p_ndc",
        &divide_point(left.start)?,
        &parse_numbers::<3>(&out["p_ndc"])?,
        TOLERANCE,
    )?;
    assert_all_close(
        "q_ndc",
        &divide_point(left.end)?,
        &parse_numbers::<3>(&out["q_ndc"])?,
        TOLERANCE,
    )?;
    compare_plane("enter_plane", left.enter, &out["enter_plane"])?;
    compare_plane("exit_plane", left.exit, &out["exit_plane"])
}

fn compare_plane(name: &str, ours: Option<PlaneIndex>, theirs: &Value) -> Result<(), String> {
    let number = ours.map(|plane| plane.index() as u64);
    if number == theirs.as_u64() {
        Ok(())
    } else {
        Err(format!("{name} is {ours:?}, not {theirs}"))
    }
}

fn divide_point(point: HPoint<Clip>) -> Result<[f64; 3], String> {
    point.divide().map(Into::into).ok_or_else(|| format!("{point:?} cannot be divided by w"))
}

fn check_polygon(case: &Value, out: &Value) -> Result<(), String> {
    let corners: Vec<[f64; 4]> =
        parse_array(&case["triangle"])?.iter().map(parse_point4).collect::<Result<_, _>>()?;
    let corners: [[f64; 4]; 3] = corners.try_into().map_err(|_| "not three corners")?;
    let polygon = clip_triangle(corners.map(HPoint::from), &parse_volume(case)?);
    let vertices = polygon.vertices();
    if out.get("error").is_some() {
        return if polygon.is_empty() { Ok(()) } else { Err("must be rejected".into()) };
    }
    let count = parse_array(&out["vertices"])?.len();
    if vertices.len() != count {
        return Err(format!("has {} vertices, not {count}: {vertices:?}", vertices.len()));
    }
    if count == 0 {
        return Ok(());
    }
    // Any rotation is accepted; the differences for the best rotation are reported.
    let fits = (0..count).map(|shift| compare_rings(vertices, shift, out));
    fits.reduce(Result::or).unwrap_or(Ok(()))?;
    let fraction = area_fraction(vertices);
    assert_close(
        "fraction_of_triangle",
        fraction,
        number_field(out, "fraction_of_triangle")?,
        TOLERANCE,
    )?;
    assert_close("ndc_area", ndc_area(vertices)?, number_field(out, "ndc_area")?, TOLERANCE)
}

fn compare_rings(vertices: &[ClipVertex], shift: usize, out: &Value) -> Result<(), String> {
    for i in 0..vertices.len() {
        let ours = &vertices[(i + shift) % vertices.len()];
        let name = |what: &str| format!("{what} of vertex {i}");
        let point = <[f64; 4]>::from(ours.point);
        assert_all_close(&name("place"), &point, &parse_point4(&out["vertices"][i])?, TOLERANCE)?;
        assert_all_close(
            &name("bary"),
            &ours.weights,
            &parse_numbers::<3>(&out["bary"][i])?,
            TOLERANCE,
        )?;
        assert_all_close(
            &name("ndc"),
            &divide_point(ours.point)?,
            &parse_numbers::<3>(&out["ndc"][i])?,
            TOLERANCE,
        )?;
    }
    Ok(())
}

/// Returns the area in weight space, where the whole triangle has area 1.
fn area_fraction(vertices: &[ClipVertex]) -> f64 {
    polygon_area(&vertices.iter().map(|v| [v.weights[1], v.weights[2]]).collect::<Vec<_>>()) * 2.0
}

fn ndc_area(vertices: &[ClipVertex]) -> Result<f64, String> {
    let places = vertices.iter().map(|v| divide_point(v.point).map(|[x, y, _]| [x, y]));
    Ok(polygon_area(&places.collect::<Result<Vec<_>, _>>()?))
}

/// Returns the signed area of a polygon, counter-clockwise positive.
fn polygon_area(ring: &[[f64; 2]]) -> f64 {
    let ends = ring.iter().cycle().skip(1);
    ring.iter().zip(ends).map(|(a, b)| (a[0] * b[1] - a[1] * b[0]) / 2.0).sum()
}
