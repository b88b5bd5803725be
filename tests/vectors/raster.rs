//! Runners for coverage and interpolated values (RA-1, RA-2, IN-2).
//!
//! Coverage must agree sample by sample. Depth and weights are intentionally stored as f32, so they
//! are compared at f32 precision.

use crate::vectors::numbers::{assert_close, parse_number};
use homog::{PixelConvention, Point, Screen};
use raster::{Frame, Opacity, Samples, ScreenVertex};
use serde_json::Value;

pub const RUNNERS: &[(&str, crate::vectors::Runner)] =
    &[("raster_coverage", check_coverage), ("raster_attributes", check_attributes)];

/// The tolerance: a few units in the last place of f32, for values near 1.
const SINGLE_PRECISION_TOLERANCE: f64 = 4e-6;

fn check_coverage(input: &Value, out: &Value) -> Result<(), String> {
    let image = TestImage::from_input(input)?;
    let triangles = parse_array(&input["triangles"])?;
    let expected = parse_array(&out["pixels"])?;
    let mut hits = vec![0_usize; image.width as usize * image.height as usize];
    for (number, (triangle, expected)) in triangles.iter().zip(expected).enumerate() {
        let corners = parse_array(triangle)?;
        let corner = |k: usize| image.parse_vertex(&corners[k][0], &corners[k][1], 0.5, 1.0);
        let mut frame = image.new_frame()?;
        frame.add_triangle([corner(0)?, corner(1)?, corner(2)?], 0, Opacity::Opaque);
        let mut actual = Vec::new();
        for (at, id) in frame.visibility_buffer().ids.iter().enumerate() {
            if id.is_some() {
                hits[at] += 1;
                actual.push(image.pixel_at(at));
            }
        }
        actual.sort_unstable_by_key(|&[x, y]| (y, x));
        let expected: Vec<[i64; 2]> = parse_array(expected)?
            .iter()
            .map(|p| Some([p[0].as_i64()?, p[1].as_i64()?]))
            .collect::<Option<_>>()
            .ok_or("a pixel is not a pair of whole numbers")?;
        if actual != expected {
            return Err(format!("triangle {number} covers {actual:?}, not {expected:?}"));
        }
    }
    let covered = hits.iter().filter(|&&hits| hits > 0).count() as u64;
    if out["union_count"].as_u64().is_some_and(|union| union != covered) {
        return Err(format!(
            "together, the triangles cover {covered} pixels, expected {}",
            out["union_count"]
        ));
    }
    if out["disjoint"] == true && hits.iter().any(|&hits| hits > 1) {
        return Err("a pixel is covered twice".to_owned());
    }
    Ok(())
}

fn check_attributes(input: &Value, out: &Value) -> Result<(), String> {
    let image = TestImage::from_input(input)?;
    let vertices = parse_array(&input["vertices"])?;
    let vertex = |k: usize| {
        let v = &vertices[k];
        image.parse_vertex(&v["x"], &v["y"], parse_number(&v["z"])?, parse_number(&v["w"])?)
    };
    let mut frame = image.new_frame()?;
    frame.add_triangle([vertex(0)?, vertex(1)?, vertex(2)?], 0, Opacity::Opaque);
    let depth = frame.visibility_buffer().depth;
    let mut fragments = Vec::new();
    frame.for_each_fragment(|f| {
        fragments.push(CoveredFragment { x: f.x, y: f.y, weights: f.weights });
    });
    let pixels = parse_array(&out["pixels"])?;
    if pixels.len() != fragments.len() {
        return Err(format!("{} pixels are covered, expected {}", fragments.len(), pixels.len()));
    }
    for pixel in pixels {
        let place = [pixel["x"].as_i64(), pixel["y"].as_i64()];
        let at = |f: &CoveredFragment| (f.y * image.width + f.x) as usize;
        let fragment = fragments
            .iter()
            .find(|f| image.pixel_at(at(f)).map(Some) == place)
            .ok_or_else(|| format!("pixel {place:?} is not covered"))?;
        assert_close(
            "z",
            f64::from(depth[at(fragment)]),
            parse_number(&pixel["z"])?,
            SINGLE_PRECISION_TOLERANCE,
        )?;
        for (k, share) in parse_array(&pixel["bary_persp"])?.iter().enumerate() {
            assert_close(
                "share",
                f64::from(fragment.weights[k]),
                parse_number(share)?,
                SINGLE_PRECISION_TOLERANCE,
            )?;
        }
        for (k, expected) in parse_array(&pixel["attr"])?.iter().enumerate() {
            let value = |v: usize| parse_number(&vertices[v]["attr"][k]);
            let sum = [value(0)?, value(1)?, value(2)?];
            let ours: f64 = (0..3).map(|v| sum[v] * f64::from(fragment.weights[v])).sum();
            let size = sum.iter().fold(1.0, |size: f64, value| size.max(value.abs()));
            assert_close(
                "attribute",
                ours,
                parse_number(expected)?,
                SINGLE_PRECISION_TOLERANCE * size,
            )?;
        }
    }
    Ok(())
}

/// A fragment as recorded by the test surface.
struct CoveredFragment {
    x: u32,
    y: u32,
    weights: [f32; 3],
}

/// The size of a picture, and the convention for its pixel coordinates.
struct TestImage {
    width: u32,
    height: u32,
    convention: PixelConvention,
}

impl TestImage {
    fn from_input(input: &Value) -> Result<Self, String> {
        let side = |name: &str| {
            let side = input[name].as_u64().and_then(|side| u32::try_from(side).ok());
            side.ok_or_else(|| format!("`{name}` is not a number of pixels"))
        };
        let convention = match (input["y"].as_str(), input["centers"].as_str()) {
            (Some("up"), Some("integer")) => PixelConvention::CHAPTER,
            (Some("down"), Some("integer")) => PixelConvention::CHAPTER_Y_DOWN,
            (Some("down"), Some("half")) => PixelConvention::IMAGE,
            (Some("up"), Some("half")) => PixelConvention::OPENGL,
            other => return Err(format!("unknown convention {other:?}")),
        };
        Ok(Self { width: side("width")?, height: side("height")?, convention })
    }

    fn new_frame(&self) -> Result<Frame, String> {
        Frame::new(self.width, self.height, Samples::One).map_err(|error| error.to_string())
    }

    fn parse_vertex(
        &self,
        x: &Value,
        y: &Value,
        depth: f64,
        w: f64,
    ) -> Result<ScreenVertex, String> {
        let height = f64::from(self.height);
        let to_image = self.convention.convert_to(PixelConvention::IMAGE, height);
        let to_image = to_image.map_err(|error| error.to_string())?;
        let place = to_image.transform_point(Point::<Screen>::new(
            parse_number(x)?,
            parse_number(y)?,
            depth,
        ));
        ScreenVertex::snap(place, w).ok_or_else(|| format!("({x}, {y}) cannot be drawn"))
    }

    /// Returns the pixel's coordinates in the file's convention: its column, and its row from the
    /// top or from the bottom.
    fn pixel_at(&self, at: usize) -> [i64; 2] {
        let (width, height) = (i64::from(self.width), i64::from(self.height));
        let (x, y) = (at as i64 % width, at as i64 / width);
        let counts_up = matches!(self.convention.y, homog::YAxis::Up);
        [x, if counts_up { height - 1 - y } else { y }]
    }
}

fn parse_array(value: &Value) -> Result<&Vec<Value>, String> {
    value.as_array().ok_or_else(|| format!("{value} is not a list"))
}
