//! Pictures of simulators with a fixed-function pipeline, such as MuJoCo, which display linear light
//! without a transfer function.

use crate::arrays::new_array;
use crate::rendering::read_picture;
use pyo3::prelude::*;
use shade::color::srgb_to_linear_table;

/// Puts a picture in front of another, and returns the linear light (height, width, 3) as bytes.
///
/// Both pictures are sRGB with straight alpha. Without a picture behind, the background is black.
#[pyfunction]
#[pyo3(signature = (front, behind = None))]
pub(crate) fn show_linear<'py>(
    py: Python<'py>,
    front: &Bound<'py, PyAny>,
    behind: Option<&Bound<'py, PyAny>>,
) -> PyResult<Bound<'py, PyAny>> {
    let front = read_picture(front)?;
    let behind = behind.map(read_picture).transpose()?;
    let light_of = srgb_to_linear_table();
    let byte_of: [u8; 256] = std::array::from_fn(|code| (255.0 * light_of[code] + 0.5) as u8);
    let mut bytes = Vec::with_capacity(3 * front.pixels.len());
    for (index, &[red, green, blue, alpha]) in front.pixels.iter().enumerate() {
        if alpha == 255 {
            bytes.extend([red, green, blue].map(|code| byte_of[usize::from(code)]));
            continue;
        }
        let back = behind.as_ref().and_then(|picture| picture.pixels.get(index));
        let [back_red, back_green, back_blue, back_alpha] = back.copied().unwrap_or_default();
        let share = f32::from(alpha) / 255.0;
        let back_share = (1.0 - share) * (f32::from(back_alpha) / 255.0);
        let mix = |code: u8, back: u8| {
            let light = light_of[usize::from(code)] * share;
            (255.0 * (light + light_of[usize::from(back)] * back_share) + 0.5) as u8
        };
        bytes.extend([mix(red, back_red), mix(green, back_green), mix(blue, back_blue)]);
    }
    new_array(py, bytes, &[front.height as usize, front.width as usize, 3])
}
