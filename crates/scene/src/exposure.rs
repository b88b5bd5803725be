//! Automatic exposure for models that come with lights.
//!
//! KHR_lights_punctual is photometric: a sun may have 3 lux, as in a viewer, or 100,000, as
//! outdoors. Without a scene file, nothing defines how bright the picture should be.

use super::Origin;
use super::surrounding_light::{has_default_light, has_lights};
use model::{ModelInstance, world_points};
use scene_file::file::SceneFile;
use shade::Light;
use std::f32::consts::PI;

/// The radiance of matte white above which automatic exposure darkens the picture. The tone curve
/// maps this radiance to less than 1.
const MAX_WHITE: f32 = 1.5;
/// One vertex in this many may be brighter.
const BRIGHTER_SHARE: usize = 10;

/// Returns the exposure of a scene in stops, from the file if it is set there. Otherwise it is 0,
/// or less if a bare model's own lights are too bright.
///
/// The brightness is the total illuminance of all lights, unshadowed and at normal incidence, that
/// nine in ten vertices do not exceed.
pub(super) fn resolve_exposure(
    origin: &Origin,
    file: &SceneFile,
    models: &[ModelInstance],
    lights: &[Light],
) -> f64 {
    if let Some(exposure) = file.image.exposure_ev {
        return exposure.value();
    }
    if !has_default_light(origin, file) || !has_lights(models) {
        return 0.0;
    }
    let at = |point: [f32; 3]| lights.iter().map(|light| illuminance(light, point)).sum::<f32>();
    let mut levels: Vec<f32> = world_points(models)
        .into_iter()
        .map(|point| at(point.raw().as_vec3().to_array()))
        .collect();
    levels.sort_unstable_by(f32::total_cmp);
    let level = levels.len().checked_sub(1 + levels.len() / BRIGHTER_SHARE);
    let white = level.map_or(0.0, |index| levels[index]) / PI;
    let is_too_bright = white > MAX_WHITE && white.is_finite();
    if is_too_bright { libm::log2(f64::from(MAX_WHITE / white)) } else { 0.0 }
}

/// Returns the illuminance of a surface that faces a light, in lux: the largest of its channels.
fn illuminance(light: &Light, point: [f32; 3]) -> f32 {
    let brightest = |color: [f32; 3]| color.into_iter().fold(0.0, f32::max);
    let (from, candela, range) = match *light {
        Light::Sun { lux, .. } | Light::Ambient { lux } | Light::Legacy { lux, .. } => {
            return brightest(lux);
        }
        Light::Point { position, candela, range, .. }
        | Light::Spot { position, candela, range, .. } => (position, candela, range),
    };
    let square: f32 = (0..3).map(|k| (point[k] - from[k]) * (point[k] - from[k])).sum();
    if square > range * range { 0.0 } else { brightest(candela) / square.max(1e-6) }
}
