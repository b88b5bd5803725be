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
    let mut bytes = Vec::with_capacity(3 * front.pixels.len());
    for (index, pixel) in front.pixels.iter().enumerate() {
        let back = behind.as_ref().and_then(|picture| picture.pixels.get(index));
        let light = |pixel: &[u8; 4], channel: usize| {
            light_of[usize::from(pixel[channel])] * (f32::from(pixel[3]) / 255.0)
        };
        let passing = 1.0 - f32::from(pixel[3]) / 255.0;
        for channel in 0..3 {
            let back = back.map_or(0.0, |back| light(back, channel));
            let sum = light(pixel, channel) + passing * back;
            bytes.push((255.0 * sum + 0.5) as u8);
        }
    }
    new_array(py, bytes, &[front.height as usize, front.width as usize, 3])
}
