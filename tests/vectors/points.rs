//! Homogeneous points and maps (HO-1 to HO-5), and segments under perspective (IN-1, IN-2).

use crate::Runner;
use crate::numbers::{
    TOLERANCE, close, close_all, field, judge, list, matrix, numbers, point, point4, text,
};
use glam::DMat3;
use homog::{Clip, Foreshortening, HPoint, Hom2, Homography, Point, Projective, Vector, World};
use serde_json::Value;

/// One per file.
pub const RUNNERS: &[(&str, Runner)] = &[("homogenize", homogenize), ("interp_ft", interp_ft)];

/// Computed coordinates may be off by a few units in the last place.
const EQUIVALENT: f64 = 1e-12;

fn homogenize(case: &Value, out: &Value) -> Result<(), String> {
    match text(case, "op")? {
        "homogenize" => judge(divided(hpoint(&case["v"])?), out, |p| same_point(p, out)),
        "from_point" => same_h(Point::from(point(&case["v"])?).into(), &out["v"]),
        "from_vector" => same_h(Vector::from(point(&case["v"])?).into(), &out["v"]),
        "classify" => same_name(hpoint(&case["v"])?.meaning().name(), text(out, "class")?),
        "equivalent" => {
            let ours = hpoint(&case["a"])?.equivalent(hpoint(&case["b"])?, EQUIVALENT);
            judge(ours.ok_or("a point is no point"), out, |ours| {
                same_name(&ours.to_string(), &out["equivalent"].to_string())
            })
        }
        "apply" => {
            let image = map(&case["m"])?.hpoint(hpoint(&case["v"])?);
            same_h(image, &out["v"])?;
            if out.get("point").is_some() { same_point(divided(image)?, out) } else { Ok(()) }
        }
        "project2d" => project2d(case, out),
        "project3d" => {
            let image = map(&case["m"])?.point(point(&case["p"])?.into());
            judge(divided(image), out, |p| same_point(p, out).and(same_h(image, &out["h"])))
        }
        "project3d_h" => {
            let image = map(&case["m"])?.hpoint(hpoint(&case["v"])?);
            judge(divided(image), out, |p| same_point(p, out))
        }
        other => Err(format!("unknown op {other}")),
    }
}

fn hpoint(value: &Value) -> Result<HPoint<World>, String> {
    point4(value).map(HPoint::from)
}

fn map(value: &Value) -> Result<Projective<World, World>, String> {
    matrix(value).map(Projective::from_raw)
}

fn divided(point: HPoint<World>) -> Result<Point<World>, String> {
    point.divide().ok_or_else(|| format!("{point:?} does not divide"))
}

fn same_point(ours: Point<World>, out: &Value) -> Result<(), String> {
    close_all("point", &<[f64; 3]>::from(ours), &point(&out["point"])?, TOLERANCE)
}

fn same_h(ours: HPoint<World>, theirs: &Value) -> Result<(), String> {
    close_all("homogeneous point", &<[f64; 4]>::from(ours), &point4(theirs)?, TOLERANCE)
}

fn same_name(ours: &str, theirs: &str) -> Result<(), String> {
    if ours == theirs { Ok(()) } else { Err(format!("is {ours}, not {theirs}")) }
}

fn project2d(case: &Value, out: &Value) -> Result<(), String> {
    let rows: Vec<[f64; 3]> = list(&case["m"])?.iter().map(numbers).collect::<Result<_, _>>()?;
    let rows: [[f64; 3]; 3] = rows.try_into().map_err(|_| "not three rows")?;
    let map = Homography::from_raw(DMat3::from_cols_array_2d(&rows).transpose());
    let [x, y] = numbers(&case["p"])?;
    let image = map.apply(Hom2::place(x, y));
    judge(image.divide().ok_or("h is 0"), out, |place| {
        close_all("point", &place, &numbers::<2>(&out["point"])?, TOLERANCE)?;
        close_all("h", &image.raw().to_array(), &numbers::<3>(&out["h"])?, TOLERANCE)
    })
}

fn interp_ft(case: &Value, out: &Value) -> Result<(), String> {
    match text(case, "op")? {
        "f" => judge(by_ends(case)?, out, |f| {
            let t = field(case, "t")?;
            let derivative = f.derivative(t).ok_or("has no derivative")?;
            close("f", f.image(t).ok_or("has no image")?, field(out, "f")?, TOLERANCE)?;
            close("derivative", derivative, field(out, "derivative")?, TOLERANCE)
        }),
        "f_inverse" => judge(by_ends(case)?, out, |f| {
            let t = f.source(field(case, "s")?).ok_or("has no source")?;
            close("t", t, field(out, "t")?, TOLERANCE)
        }),
        "segment" => segment(case, out),
        other => Err(format!("unknown op {other}")),
    }
}

fn by_ends(case: &Value) -> Result<Result<Foreshortening, homog::SegmentTorn>, String> {
    Ok(Foreshortening::new(field(case, "w_r")?, field(case, "w_R")?))
}

fn segment(case: &Value, out: &Value) -> Result<(), String> {
    let [r, q]: [HPoint<Clip>; 2] = [point4(&case["r"])?.into(), point4(&case["R"])?.into()];
    let (t, s) = (field(case, "t")?, field(case, "s")?);
    judge(Foreshortening::between(r, q), out, |f| {
        let fraction = f.image(t).ok_or("has no image")?;
        close("f", fraction, field(out, "f")?, TOLERANCE)?;
        let (start, end) = (r.divide().ok_or("r has w = 0")?, q.divide().ok_or("R has w = 0")?);
        let theirs = point(&out["image_point"])?;
        let direct = r.lerp(q, t).divide().ok_or("the point has w = 0")?;
        close_all("image of the point", &<[f64; 3]>::from(direct), &theirs, TOLERANCE)?;
        let between = start.lerp(end, fraction);
        close_all("point of the image", &<[f64; 3]>::from(between), &theirs, TOLERANCE)?;
        let attribute = f.attribute(s, field(case, "a0")?, field(case, "a1")?);
        let theirs = field(out, "attribute_at_s")?;
        close("attribute_at_s", attribute.ok_or("has no attribute")?, theirs, TOLERANCE)
    })
}
