//! Converts mesh colors and textures: sRGB bytes and fractions become linear colors, and arrays and
//! files become images.

use crate::arrays::{self, Numbers};
use crate::failure::Failure;
use crate::keywords::Keywords;
use import::{Limits, decode_image};
use model::Image;
use pyo3::prelude::*;
use pyo3::types::PyBytes;

/// Reads linear colors of the vertices or faces, given the `counts` of both.
pub(crate) fn read_colors(
    mesh: &Keywords<'_, '_>,
    counts: [usize; 2],
) -> PyResult<[Option<Vec<[f32; 4]>>; 2]> {
    let Some(value) = mesh.value("colors")? else { return Ok([None, None]) };
    let (shape, colors) = linear_colors("colors", &value)?;
    let [vertices, faces] = counts;
    match shape[..] {
        [rows, 3 | 4] if rows == vertices => Ok([Some(colors), None]),
        [rows, 3 | 4] if rows == faces => Ok([None, Some(colors)]),
        _ => {
            let wanted =
                format!("({vertices}, 3 or 4) for vertices or ({faces}, 3 or 4) for faces");
            Err(arrays::wrong_shape("colors", &shape, &wanted).into())
        }
    }
}

/// Converts sRGB colors, as bytes or fractions, to linear colors with alpha; also returns their
/// shape.
pub(crate) fn linear_colors(
    name: &str,
    value: &Bound<'_, PyAny>,
) -> PyResult<(Vec<usize>, Vec<[f32; 4]>)> {
    let kind: String =
        arrays::as_array(name, value)?.getattr("dtype")?.getattr("kind")?.extract()?;
    let most = if kind == "f" { 1.0 } else { 255.0 };
    let Numbers { shape, values } = arrays::real_array::<f64>(name, value, "float64")?;
    if let Some(at) = values.iter().position(|channel| !(0.0..=most).contains(channel)) {
        let element = format!("{name}.flat[{at}]");
        let message = format!("is {}, expected a number from 0 to {most}", values[at]);
        return Err(Failure::argument(element, message).into());
    }
    let channels = shape.last().copied().unwrap_or(0);
    if !(3..=4).contains(&channels) {
        return Err(arrays::wrong_shape(name, &shape, "(…, 3) or (…, 4)").into());
    }
    let to_linear = |color: &[f64]| {
        let [r, g, b] = [0, 1, 2].map(|at: usize| linear_channel(color[at], most));
        [r, g, b, color.get(3).map_or(1.0, |alpha| (alpha / most) as f32)]
    };
    Ok((shape, values.chunks_exact(channels).map(to_linear).collect()))
}

/// Decodes an sRGB channel: bytes with the table, fractions with the formula.
fn linear_channel(channel: f64, most: f64) -> f32 {
    if most == 1.0 {
        return linear_fraction(channel);
    }
    shade::color::srgb_to_linear_table()[channel as usize]
}

/// Decodes an sRGB-encoded value to linear light; both are in [0, 1].
fn linear_fraction(encoded: f64) -> f32 {
    shade::color::srgb_to_linear(encoded) as f32
}

/// Reads a texture: an array of bytes, or the content of an image file.
pub(crate) fn read_texture(value: &Bound<'_, PyAny>, limits: &Limits) -> PyResult<Image> {
    if let Ok(bytes) = value.cast::<PyBytes>() {
        let image = decode_image(bytes.as_bytes(), limits.image_texels);
        return Ok(image.map_err(|message| Failure::argument("texture", message))?);
    }
    let Numbers { shape, values } = arrays::byte_array("texture", value)?;
    let (height, width, channels) = match shape[..] {
        [height, width] => (height, width, 1),
        [height, width, channels @ (1 | 3 | 4)] => (height, width, channels),
        _ => return Err(arrays::wrong_shape("texture", &shape, "(height, width, 3 or 4)").into()),
    };
    let side = limits.image_side as usize;
    if height == 0 || width == 0 || height.max(width) > side {
        let message = format!("has {width} x {height} texels, expected sides from 1 to {side}");
        return Err(Failure::argument("texture", message).into());
    }
    if width as u64 * height as u64 > limits.image_texels {
        let most = limits.image_texels;
        let message = format!("has {width} x {height} texels, more than the limit of {most}");
        return Err(Failure::argument("texture", message).into());
    }
    let texel = |channels: &[u8]| match *channels {
        [gray] => [gray, gray, gray, 255],
        [r, g, b] => [r, g, b, 255],
        [r, g, b, a, ..] => [r, g, b, a],
        _ => [0, 0, 0, 255],
    };
    let rgba = values.chunks_exact(channels).map(texel).collect();
    Ok(Image { width: width as u32, height: height as u32, rgba })
}
