//! Runners for homogeneous points and maps (HO-1 to HO-5), and segments under perspective (IN-1,
//! IN-2).

use crate::vectors::Runner;
use crate::vectors::numbers::{
    TOLERANCE, assert_all_close, assert_close, compare_outcome, number_field, parse_array,
    parse_matrix, parse_numbers, parse_point, parse_point4, text_field,
};
use glam::DMat3;
use homog::{Clip, Foreshortening, HPoint, HPoint2, Homography, Point, Projective, Vector, World};
use serde_json::Value;

/// The runners, one per file.
pub const RUNNERS: &[(&str, Runner)] =
    &[("homogenize", check_homogenize), ("interp_ft", check_interp_ft)];

/// The tolerance for computed coordinates: a few units in the last place.
const EQUIVALENCE_TOLERANCE: f64 = 1e-12;

fn check_homogenize(case: &Value, out: &Value) -> Result<(), String> {
    match text_field(case, "op")? {
        "homogenize" => {
            compare_outcome(divide_point(parse_hpoint(&case["v"])?), out, |p| compare_point(p, out))
        }
        "from_point" => {
            compare_homogeneous(Point::from(parse_point(&case["v"])?).into(), &out["v"])
        }
        "from_vector" => {
            compare_homogeneous(Vector::from(parse_point(&case["v"])?).into(), &out["v"])
        }
        "classify" => {
            compare_kind(parse_hpoint(&case["v"])?.kind().name(), text_field(out, "class")?)
        }
        "equivalent" => {
            let ours = parse_hpoint(&case["a"])?
                .equivalent(parse_hpoint(&case["b"])?, EQUIVALENCE_TOLERANCE);
            compare_outcome(ours.ok_or("invalid point"), out, |ours| {
                compare_kind(&ours.to_string(), &out["equivalent"].to_string())
            })
        }
        "apply" => {
            let image = parse_map(&case["m"])?.transform_hpoint(parse_hpoint(&case["v"])?);
            compare_homogeneous(image, &out["v"])?;
            if out.get("point").is_some() {
                compare_point(divide_point(image)?, out)
            } else {
                Ok(())
            }
        }
        "project2d" => check_project2d(case, out),
        "project3d" => {
            let image = parse_map(&case["m"])?.transform_point(parse_point(&case["p"])?.into());
            compare_outcome(divide_point(image), out, |p| {
                compare_point(p, out).and(compare_homogeneous(image, &out["h"]))
            })
        }
        "project3d_h" => {
            let image = parse_map(&case["m"])?.transform_hpoint(parse_hpoint(&case["v"])?);
            compare_outcome(divide_point(image), out, |p| compare_point(p, out))
        }
        other => Err(format!("unknown op {other}")),
    }
}

fn parse_hpoint(value: &Value) -> Result<HPoint<World>, String> {
    parse_point4(value).map(HPoint::from)
}

fn parse_map(value: &Value) -> Result<Projective<World, World>, String> {
    parse_matrix(value).map(Projective::from_raw)
}

fn divide_point(point: HPoint<World>) -> Result<Point<World>, String> {
    point.divide().ok_or_else(|| format!("{point:?} cannot be divided by w"))
}

fn compare_point(ours: Point<World>, out: &Value) -> Result<(), String> {
    assert_all_close("point", &<[f64; 3]>::from(ours), &parse_point(&out["point"])?, TOLERANCE)
}

fn compare_homogeneous(ours: HPoint<World>, theirs: &Value) -> Result<(), String> {
    assert_all_close(
        "homogeneous point",
        &<[f64; 4]>::from(ours),
        &parse_point4(theirs)?,
        TOLERANCE,
    )
}

fn compare_kind(ours: &str, theirs: &str) -> Result<(), String> {
    if ours == theirs { Ok(()) } else { Err(format!("is {ours}, not {theirs}")) }
}

fn check_project2d(case: &Value, out: &Value) -> Result<(), String> {
    let rows: Vec<[f64; 3]> =
        parse_array(&case["m"])?.iter().map(parse_numbers).collect::<Result<_, _>>()?;
    let rows: [[f64; 3]; 3] = rows.try_into().map_err(|_| "not three rows")?;
    let map = Homography::from_raw(DMat3::from_cols_array_2d(&rows).transpose());
    let [x, y] = parse_numbers(&case["p"])?;
    let image = map.transform_point(HPoint2::from_xy(x, y));
    compare_outcome(image.divide().ok_or("h is 0"), out, |place| {
        assert_all_close("point", &place, &parse_numbers::<2>(&out["point"])?, TOLERANCE)?;
        assert_all_close("h", &image.raw().to_array(), &parse_numbers::<3>(&out["h"])?, TOLERANCE)
    })
}

fn check_interp_ft(case: &Value, out: &Value) -> Result<(), String> {
    match text_field(case, "op")? {
        "f" => compare_outcome(foreshortening_from_ends(case)?, out, |f| {
            let t = number_field(case, "t")?;
            let derivative = f.derivative(t).ok_or("has no derivative")?;
            assert_close(
                "f",
                f.image_parameter(t).ok_or("has no image")?,
                number_field(out, "f")?,
                TOLERANCE,
            )?;
            assert_close("derivative", derivative, number_field(out, "derivative")?, TOLERANCE)
        }),
        "f_inverse" => compare_outcome(foreshortening_from_ends(case)?, out, |f| {
            let t = f.source_parameter(number_field(case, "s")?).ok_or("has no source")?;
            assert_close("t", t, number_field(out, "t")?, TOLERANCE)
        }),
        "segment" => check_segment(case, out),
        other => Err(format!("unknown op {other}")),
    }
}

fn foreshortening_from_ends(
    case: &Value,
) -> Result<Result<Foreshortening, homog::SegmentCrossesEyePlane>, String> {
    Ok(Foreshortening::new(number_field(case, "w_r")?, number_field(case, "w_R")?))
}

fn check_segment(case: &Value, out: &Value) -> Result<(), String> {
    let [r, q]: [HPoint<Clip>; 2] =
        [parse_point4(&case["r"])?.into(), parse_point4(&case["R"])?.into()];
    let (t, s) = (number_field(case, "t")?, number_field(case, "s")?);
    compare_outcome(Foreshortening::from_endpoints(r, q), out, |f| {
        let fraction = f.image_parameter(t).ok_or("has no image")?;
        assert_close("f", fraction, number_field(out, "f")?, TOLERANCE)?;
        let (start, end) = (r.divide().ok_or("r has w = 0")?, q.divide().ok_or("R has w = 0")?);
        let theirs = parse_point(&out["image_point"])?;
        let direct = r.lerp(q, t).divide().ok_or("the point has w = 0")?;
        assert_all_close("image of the point", &<[f64; 3]>::from(direct), &theirs, TOLERANCE)?;
        let between = start.lerp(end, fraction);
        assert_all_close("point of the image", &<[f64; 3]>::from(between), &theirs, TOLERANCE)?;
        let attribute =
            f.interpolate_attribute(s, number_field(case, "a0")?, number_field(case, "a1")?);
        let theirs = number_field(out, "attribute_at_s")?;
        assert_close("attribute_at_s", attribute.ok_or("has no attribute")?, theirs, TOLERANCE)
    })
}
