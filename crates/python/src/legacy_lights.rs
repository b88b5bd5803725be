//! Spot lights of OpenGL's fixed pipeline, which scene files do not have; see [`Light::Legacy`].

use crate::arrays;
use crate::failure::Failure;
use crate::keywords::Keywords;
use pyo3::prelude::*;
use shade::{Light, Shadow};

/// The number of columns of the array: position, axis, lux and falloff (3 each), exponent, cosine
/// of the cutoff, texels along the shadow map or 0, and angle of the light in radians.
const COLUMNS: usize = 16;

/// Reads the rows of the option `legacy_lights`.
///
/// # Errors
/// Returns an error if the shape is different or a number is not finite.
pub(crate) fn read_legacy_lights(options: &Keywords<'_, '_>) -> PyResult<Vec<Light>> {
    let Some(value) = options.value("legacy_lights")? else { return Ok(Vec::new()) };
    let rows = arrays::finite_rows::<COLUMNS>("legacy_lights", &value, "L")?;
    let is_unit = |axis: [f32; 3]| (axis.map(|c| c * c).iter().sum::<f32>() - 1.0).abs() < 1e-3;
    let read = |row: &[f32; COLUMNS]| {
        let triple = |at: usize| [row[at], row[at + 1], row[at + 2]];
        let [exponent, cutoff, texels, softness] = [row[12], row[13], row[14], row[15]];
        let shadow = Shadow { resolution: texels as u32, softness };
        is_unit(triple(3)).then(|| Light::Legacy {
            position: triple(0),
            axis: triple(3),
            lux: triple(6),
            falloff: triple(9),
            exponent,
            cutoff,
            shadow: (64..=8192).contains(&shadow.resolution).then_some(shadow),
        })
    };
    let lights: Option<Vec<Light>> = rows.iter().map(read).collect();
    let wrong = || Failure::argument("legacy_lights", "an axis is not a unit vector");
    Ok(lights.ok_or_else(wrong)?)
}
