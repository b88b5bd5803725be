//! Windows, viewports, grids and depth ranges (LI-1, WI-2, WI-3, VP-1 to VP-4, WV-1 to WV-4, DP-1).

use crate::Runner;
use crate::numbers::{
    TOLERANCE, close, close_all, close_matrix, count, field, judge, list, matrix, numbers, pairs,
    point, point4, text,
};
use glam::DMat3;
use homog::{Affine, Homography, Ndc, Point, Screen, View, remap};
use projection::chapter;
use serde_json::Value;
use viewport::{
    DepthRange, Grid, Limits, PixelCentres, PixelConvention, Rectangle, Viewport, ViewportError,
    WindowToViewport, YAxis,
};

/// One per file.
pub const RUNNERS: &[(&str, Runner)] =
    &[("interpolate", interpolate), ("window_viewport", window_viewport), ("viewport", viewports)];

fn interpolate(case: &Value, out: &Value) -> Result<(), String> {
    match text(case, "op")? {
        "remap" => {
            let (from, to) = (numbers(&case["from"])?, numbers(&case["to"])?);
            judge(remap(field(case, "x")?, from, to), out, |y| {
                close("y", y, field(out, "y")?, TOLERANCE)
            })
        }
        "window2" => {
            let corner = |name| numbers::<2>(&case[name]);
            let map = Homography::windowing(
                [corner("lo")?, corner("hi")?],
                [corner("to_lo")?, corner("to_hi")?],
            );
            judge(map, out, |map| {
                close_matrix3("matrix", map.raw(), &out["matrix"])?;
                let q = map.raw().transform_point2(corner("p")?.into());
                close_all("q", &q.to_array(), &numbers::<2>(&out["q"])?, TOLERANCE)
            })
        }
        "window3" => {
            let corner = |name| point(&case[name]);
            let from = [corner("lo")?, corner("hi")?].map(Point::<View>::from);
            let to = [corner("to_lo")?, corner("to_hi")?].map(Point::<Ndc>::from);
            judge(Affine::windowing(from, to), out, |map| {
                close_matrix("matrix", map.raw(), matrix(&out["matrix"])?, TOLERANCE)?;
                let q = map.point(corner("p")?.into());
                close_all("q", &<[f64; 3]>::from(q), &point(&out["q"])?, TOLERANCE)
            })
        }
        other => Err(format!("unknown op {other}")),
    }
}

/// A 3×3 matrix, a list of rows.
pub fn close_matrix3(name: &str, ours: DMat3, theirs: &Value) -> Result<(), String> {
    for (i, row) in list(theirs)?.iter().enumerate() {
        let row_name = format!("{name}[{i}]");
        close_all(&row_name, &ours.row(i).to_array(), &numbers::<3>(row)?, TOLERANCE)?;
    }
    Ok(())
}

fn window_viewport(case: &Value, out: &Value) -> Result<(), String> {
    match text(case, "op")? {
        "window_to_viewport" => window_to_viewport(case, out),
        "screen_to_ndc" => judge(whole_image(case)?, out, |view| {
            for (p, theirs) in pairs(&case["points"], &out["points"])? {
                let [x, y] = numbers(p)?;
                let ndc = view.screen_to_ndc().point(Point::new(x, y, 0.0));
                close_all("ndc", &[ndc.x(), ndc.y()], &numbers::<2>(theirs)?, TOLERANCE)?;
            }
            Ok(())
        }),
        "grid" => {
            let size = |name| count(case, name).map(|count| count as usize);
            judge(Grid::new(size("rows")?, size("cols")?), out, |grid| {
                for (index, theirs) in pairs(&case["index"], &out["xz"])? {
                    let [row, column] = numbers::<2>(index)?.map(|index| index as usize);
                    let xz = grid.xz(row, column).ok_or("the index is beyond the last")?;
                    close_all("xz", &xz, &numbers::<2>(theirs)?, TOLERANCE)?;
                }
                Ok(())
            })
        }
        "depth_flip" => depth(DepthRange::ZERO_ONE_FLIPPED, case, out),
        "depth_gl" => depth(DepthRange::ZERO_ONE, case, out),
        "inverse_z" => {
            let [x, y, z, w] = point4(&case["v"])?;
            let ours = [x, y, DepthRange::NEGATED.of(z), w];
            close_all("v", &ours, &point4(&out["v"])?, TOLERANCE)
        }
        other => Err(format!("unknown op {other}")),
    }
}

fn depth(range: DepthRange, case: &Value, out: &Value) -> Result<(), String> {
    let z = field(case, "z")?;
    close("z", range.of(z), field(out, "z")?, TOLERANCE)?;
    close("z undone", range.undo(range.of(z)), z, TOLERANCE)
}

/// The map from a window to a viewport, both as [xmin, xmax, ymin, ymax].
pub fn window_map(case: &Value) -> Result<Result<WindowToViewport, ViewportError>, String> {
    let limits = |name| {
        let [x0, x1, y0, y1] = numbers(&case[name])?;
        Ok::<_, String>(Limits { x: [x0, x1], y: [y0, y1] })
    };
    Ok(WindowToViewport::new(limits("window")?, limits("viewport")?))
}

fn window_to_viewport(case: &Value, out: &Value) -> Result<(), String> {
    judge(window_map(case)?, out, |map| {
        close_matrix3("matrix", map.homography().raw(), &out["matrix"])?;
        for (p, theirs) in pairs(&case["points"], &out["points"])? {
            let (p, theirs) = (numbers(p)?, numbers::<2>(theirs)?);
            close_all("by ratio", &map.by_ratio(p), &theirs, TOLERANCE)?;
            close_all("by chain", &map.by_chain(p), &theirs, TOLERANCE)?;
        }
        Ok(())
    })
}

/// The viewport on a whole image of `nx` by `ny` pixels; depth is kept unless the case says otherwise.
pub fn whole_image(case: &Value) -> Result<Result<Viewport, ViewportError>, String> {
    let y = match text(case, "y")? {
        "up" => YAxis::Up,
        "down" => YAxis::Down,
        other => return Err(format!("y is {other}")),
    };
    let centres = match text(case, "centers")? {
        "integer" => PixelCentres::Integer,
        "half" => PixelCentres::Half,
        other => return Err(format!("centers is {other}")),
    };
    let depth = match case["depth"].as_str() {
        None | Some("keep") => DepthRange::KEEP,
        Some("zero_one") => DepthRange::ZERO_ONE,
        Some("zero_one_flipped") => DepthRange::ZERO_ONE_FLIPPED,
        Some(other) => return Err(format!("depth is {other}")),
    };
    let image = Viewport::chapter(count(case, "nx")?, count(case, "ny")?);
    let convention = PixelConvention { y, centres };
    Ok(image.map(|image| image.with_convention(convention).with_depth(depth)))
}

fn viewports(case: &Value, out: &Value) -> Result<(), String> {
    match text(case, "op")? {
        "viewport" => judge(whole_image(case)?, out, |view| {
            close_matrix("matrix", view.ndc_to_screen().raw(), matrix(&out["matrix"])?, TOLERANCE)?;
            let inverse = view.screen_to_ndc().raw();
            close_matrix("inverse", inverse, matrix(&out["inverse"])?, TOLERANCE)?;
            maps(view, out)
        }),
        "viewport_rect" => judge(rectangle(case)?, out, |view| {
            close_matrix("matrix", view.ndc_to_screen().raw(), matrix(&out["matrix"])?, TOLERANCE)?;
            maps(view, out)
        }),
        "viewport_orth" => viewport_after_box(case, out),
        "to_half_down" => convert(PixelConvention::CHAPTER, PixelConvention::IMAGE, case, out),
        "from_half_down" => convert(PixelConvention::IMAGE, PixelConvention::CHAPTER, case, out),
        other => Err(format!("unknown op {other}")),
    }
}

fn maps(view: Viewport, out: &Value) -> Result<(), String> {
    for map in list(&out["maps"])? {
        let screen = view.ndc_to_screen().point(point(&map["ndc"])?.into());
        close_all("screen", &<[f64; 3]>::from(screen), &point(&map["screen"])?, TOLERANCE)?;
    }
    Ok(())
}

/// As glViewport and glDepthRange have it: half-integer centres, y up.
fn rectangle(case: &Value) -> Result<Result<Viewport, ViewportError>, String> {
    let number = |name| field(case, name);
    let area = Rectangle::new(number("x0")?, number("y0")?, number("width")?, number("height")?);
    let depth = DepthRange::new([-1.0, 1.0], [number("depth_near")?, number("depth_far")?]);
    Ok(area.and_then(|area| Ok(Viewport::new(area, PixelConvention::OPENGL, depth?))))
}

/// Exercise 2: the product of viewport and box, and the same map as one windowing.
pub fn viewport_after_box(case: &Value, out: &Value) -> Result<(), String> {
    let number = |name| field(case, name);
    let (l, r, b, t) = (number("l")?, number("r")?, number("b")?, number("t")?);
    let (n, f) = (number("n")?, number("f")?);
    let (nx, ny) = (count(case, "nx")?, count(case, "ny")?);
    let view = Viewport::chapter(nx, ny).map_err(|error| error.to_string())?;
    let theirs = matrix(&out["matrix"])?;
    let orth = chapter::m_orth(l, r, b, t, n, f).map_err(|error| error.to_string())?;
    let product = view.source_to_screen(orth.into());
    close_matrix("product", product.raw(), theirs, TOLERANCE)?;
    let (x, y) = (f64::from(nx) - 0.5, f64::from(ny) - 0.5);
    let from = [Point::<View>::new(l, b, f), Point::new(r, t, n)];
    let to = [Point::<Screen>::new(-0.5, -0.5, -1.0), Point::new(x, y, 1.0)];
    let direct = Affine::windowing(from, to).map_err(|error| error.to_string())?;
    close_matrix("windowing", direct.raw(), theirs, TOLERANCE)
}

fn convert(
    from: PixelConvention,
    to: PixelConvention,
    case: &Value,
    out: &Value,
) -> Result<(), String> {
    let [x, y] = numbers(&case["p"])?;
    judge(from.to(to, field(case, "ny")?), out, |map| {
        let p = map.point(Point::new(x, y, 0.0));
        close_all("p", &[p.x(), p.y()], &numbers::<2>(&out["p"])?, TOLERANCE)
    })
}
