//! Runners for windows, viewports, grids and depth ranges (LI-1, WI-2, WI-3, VP-1 to VP-4, WV-1 to
//! WV-4, DP-1).

use crate::vectors::Runner;
use crate::vectors::numbers::{
    TOLERANCE, assert_all_close, assert_close, assert_matrix_close, compare_outcome, count_field,
    number_field, parse_array, parse_matrix, parse_numbers, parse_point, parse_point4, text_field,
    zip_arrays,
};
use glam::DMat3;
use homog::{
    Affine, ClipRange, Homography, Ndc, PixelCenters, PixelConvention, Point, Screen, View, YAxis,
    remap_interval,
};
use projection::chapter;
use serde_json::Value;
use viewport::{
    DepthRange, Limits, PointGrid, Rectangle, Viewport, ViewportError, WindowToViewport,
};

/// The runners, one per file.
pub const RUNNERS: &[(&str, Runner)] = &[
    ("interpolate", check_interpolation),
    ("window_viewport", check_window_viewport),
    ("viewport", check_viewports),
];

fn check_interpolation(case: &Value, out: &Value) -> Result<(), String> {
    match text_field(case, "op")? {
        "remap" => {
            let (from, to) = (parse_numbers(&case["from"])?, parse_numbers(&case["to"])?);
            compare_outcome(remap_interval(number_field(case, "x")?, from, to), out, |y| {
                assert_close("y", y, number_field(out, "y")?, TOLERANCE)
            })
        }
        "window2" => {
            let corner = |name| parse_numbers::<2>(&case[name]);
            let map = Homography::windowing(
                [corner("lo")?, corner("hi")?],
                [corner("to_lo")?, corner("to_hi")?],
            );
            compare_outcome(map, out, |map| {
                assert_matrix3_close("matrix", map.raw(), &out["matrix"])?;
                let q = map.raw().transform_point2(corner("p")?.into());
                assert_all_close("q", &q.to_array(), &parse_numbers::<2>(&out["q"])?, TOLERANCE)
            })
        }
        "window3" => {
            let corner = |name| parse_point(&case[name]);
            let from = [corner("lo")?, corner("hi")?].map(Point::<View>::from);
            let to = [corner("to_lo")?, corner("to_hi")?].map(Point::<Ndc>::from);
            compare_outcome(Affine::windowing(from, to), out, |map| {
                assert_matrix_close("matrix", map.raw(), parse_matrix(&out["matrix"])?, TOLERANCE)?;
                let q = map.transform_point(corner("p")?.into());
                assert_all_close("q", &<[f64; 3]>::from(q), &parse_point(&out["q"])?, TOLERANCE)
            })
        }
        other => Err(format!("unknown op {other}")),
    }
}

/// Compares a 3×3 matrix with a list of rows.
pub fn assert_matrix3_close(name: &str, ours: DMat3, theirs: &Value) -> Result<(), String> {
    for (i, row) in parse_array(theirs)?.iter().enumerate() {
        let row_name = format!("{name}[{i}]");
        assert_all_close(&row_name, &ours.row(i).to_array(), &parse_numbers::<3>(row)?, TOLERANCE)?;
    }
    Ok(())
}

fn check_window_viewport(case: &Value, out: &Value) -> Result<(), String> {
    match text_field(case, "op")? {
        "window_to_viewport" => check_window_to_viewport(case, out),
        "screen_to_ndc" => compare_outcome(full_image_viewport(case)?, out, |view| {
            for (p, theirs) in zip_arrays(&case["points"], &out["points"])? {
                let [x, y] = parse_numbers(p)?;
                let ndc = view.screen_to_ndc().transform_point(Point::new(x, y, 0.0));
                assert_all_close(
                    "ndc",
                    &[ndc.x(), ndc.y()],
                    &parse_numbers::<2>(theirs)?,
                    TOLERANCE,
                )?;
            }
            Ok(())
        }),
        "grid" => {
            let size = |name| count_field(case, name).map(|count| count as usize);
            compare_outcome(PointGrid::new(size("rows")?, size("cols")?), out, |grid| {
                for (index, theirs) in zip_arrays(&case["index"], &out["xz"])? {
                    let [row, column] = parse_numbers::<2>(index)?.map(|index| index as usize);
                    let xz = grid.xz(row, column).ok_or("the index is out of range")?;
                    assert_all_close("xz", &xz, &parse_numbers::<2>(theirs)?, TOLERANCE)?;
                }
                Ok(())
            })
        }
        "depth_flip" => check_depth_range(DepthRange::ZERO_ONE_FLIPPED, case, out),
        "depth_gl" => check_depth_range(DepthRange::ZERO_ONE, case, out),
        "inverse_z" => {
            let [x, y, z, w] = parse_point4(&case["v"])?;
            let ours = [x, y, DepthRange::NEGATED.ndc_to_depth(z), w];
            assert_all_close("v", &ours, &parse_point4(&out["v"])?, TOLERANCE)
        }
        other => Err(format!("unknown op {other}")),
    }
}

fn check_depth_range(range: DepthRange, case: &Value, out: &Value) -> Result<(), String> {
    let z = number_field(case, "z")?;
    assert_close("z", range.ndc_to_depth(z), number_field(out, "z")?, TOLERANCE)?;
    assert_close("z undone", range.depth_to_ndc(range.ndc_to_depth(z)), z, TOLERANCE)
}

/// Returns the map from a window to a viewport, both as [xmin, xmax, ymin, ymax].
pub fn parse_window_map(case: &Value) -> Result<Result<WindowToViewport, ViewportError>, String> {
    let limits = |name| {
        let [x0, x1, y0, y1] = parse_numbers(&case[name])?;
        Ok::<_, String>(Limits { x: [x0, x1], y: [y0, y1] })
    };
    Ok(WindowToViewport::new(limits("window")?, limits("viewport")?))
}

fn check_window_to_viewport(case: &Value, out: &Value) -> Result<(), String> {
    compare_outcome(parse_window_map(case)?, out, |map| {
        assert_matrix3_close("matrix", map.homography().raw(), &out["matrix"])?;
        for (p, theirs) in zip_arrays(&case["points"], &out["points"])? {
            let (p, theirs) = (parse_numbers(p)?, parse_numbers::<2>(theirs)?);
            assert_all_close("by ratio", &map.map_by_ratio(p), &theirs, TOLERANCE)?;
            assert_all_close("by chain", &map.map_by_chain(p), &theirs, TOLERANCE)?;
        }
        Ok(())
    })
}

/// Returns the viewport on a whole image of `nx` by `ny` pixels. Depth is unchanged unless the case
/// specifies otherwise.
pub fn full_image_viewport(case: &Value) -> Result<Result<Viewport, ViewportError>, String> {
    let y = match text_field(case, "y")? {
        "up" => YAxis::Up,
        "down" => YAxis::Down,
        other => return Err(format!("unknown y direction {other}")),
    };
    let centres = match text_field(case, "centers")? {
        "integer" => PixelCenters::Integer,
        "half" => PixelCenters::Half,
        other => return Err(format!("unknown pixel centers {other}")),
    };
    let depth = match case["depth"].as_str() {
        None | Some("keep") => DepthRange::KEEP,
        Some("zero_one") => DepthRange::ZERO_ONE,
        Some("zero_one_flipped") => DepthRange::ZERO_ONE_FLIPPED,
        Some(other) => return Err(format!("unknown depth range {other}")),
    };
    let image = Viewport::chapter(count_field(case, "nx")?, count_field(case, "ny")?);
    let convention = PixelConvention { y, centers: centres };
    Ok(image.map(|image| image.with_convention(convention).with_depth(depth)))
}

fn check_viewports(case: &Value, out: &Value) -> Result<(), String> {
    match text_field(case, "op")? {
        "viewport" => compare_outcome(full_image_viewport(case)?, out, |view| {
            assert_matrix_close(
                "matrix",
                view.ndc_to_screen().raw(),
                parse_matrix(&out["matrix"])?,
                TOLERANCE,
            )?;
            let inverse = view.screen_to_ndc().raw();
            assert_matrix_close("inverse", inverse, parse_matrix(&out["inverse"])?, TOLERANCE)?;
            check_viewport_maps(view, out)
        }),
        "viewport_rect" => compare_outcome(parse_rectangle(case)?, out, |view| {
            assert_matrix_close(
                "matrix",
                view.ndc_to_screen().raw(),
                parse_matrix(&out["matrix"])?,
                TOLERANCE,
            )?;
            check_viewport_maps(view, out)
        }),
        "viewport_orth" => check_viewport_after_box(case, out),
        "to_half_down" => {
            check_conversion(PixelConvention::CHAPTER, PixelConvention::IMAGE, case, out)
        }
        "from_half_down" => {
            check_conversion(PixelConvention::IMAGE, PixelConvention::CHAPTER, case, out)
        }
        other => Err(format!("unknown op {other}")),
    }
}

fn check_viewport_maps(view: Viewport, out: &Value) -> Result<(), String> {
    for map in parse_array(&out["maps"])? {
        let screen = view.ndc_to_screen().transform_point(parse_point(&map["ndc"])?.into());
        assert_all_close(
            "screen",
            &<[f64; 3]>::from(screen),
            &parse_point(&map["screen"])?,
            TOLERANCE,
        )?;
    }
    Ok(())
}

/// Parses a viewport with the conventions of glViewport and glDepthRange: half-integer centers, y
/// up.
fn parse_rectangle(case: &Value) -> Result<Result<Viewport, ViewportError>, String> {
    let number = |name| number_field(case, name);
    let area = Rectangle::new(number("x0")?, number("y0")?, number("width")?, number("height")?);
    let depth = DepthRange::new([-1.0, 1.0], [number("depth_near")?, number("depth_far")?]);
    Ok(area.and_then(|area| {
        Ok(Viewport::new(area, PixelConvention::OPENGL, ClipRange::OPENGL, depth?))
    }))
}

/// Checks exercise 2: the product of viewport and box, and the same map as a single windowing.
pub fn check_viewport_after_box(case: &Value, out: &Value) -> Result<(), String> {
    let number = |name| number_field(case, name);
    let (l, r, b, t) = (number("l")?, number("r")?, number("b")?, number("t")?);
    let (n, f) = (number("n")?, number("f")?);
    let (nx, ny) = (count_field(case, "nx")?, count_field(case, "ny")?);
    let view = Viewport::chapter(nx, ny).map_err(|error| error.to_string())?;
    let theirs = parse_matrix(&out["matrix"])?;
    let orth = chapter::m_orth(l, r, b, t, n, f).map_err(|error| error.to_string())?;
    let product = view.source_to_screen(orth.into());
    assert_matrix_close("product", product.raw(), theirs, TOLERANCE)?;
    let (x, y) = (f64::from(nx) - 0.5, f64::from(ny) - 0.5);
    let from = [Point::<View>::new(l, b, f), Point::new(r, t, n)];
    let to = [Point::<Screen>::new(-0.5, -0.5, -1.0), Point::new(x, y, 1.0)];
    let direct = Affine::windowing(from, to).map_err(|error| error.to_string())?;
    assert_matrix_close("windowing", direct.raw(), theirs, TOLERANCE)
}

fn check_conversion(
    from: PixelConvention,
    to: PixelConvention,
    case: &Value,
    out: &Value,
) -> Result<(), String> {
    let [x, y] = parse_numbers(&case["p"])?;
    compare_outcome(from.convert_to(to, number_field(case, "ny")?), out, |map| {
        let p = map.transform_point(Point::new(x, y, 0.0));
        assert_all_close("p", &[p.x(), p.y()], &parse_numbers::<2>(&out["p"])?, TOLERANCE)
    })
}
