//! Resolution of lights: units, directions and shadows of the lights in a scene file, and the
//! default key light.

use super::Origin;
use super::diagnostics::Diagnostics;
use super::shadows::resolve_shadow;
use super::surrounding_light::effective_environment;
use camera::{NamedView, ViewProjection};
use files::counted;
use homog::{Point, Vector, World};
use model::LightKind;
use model::ModelInstance;
use scene_file::PathStep::{self, Field, Index};
use scene_file::SceneError;
use scene_file::file::{
    EnvironmentFile, Finite, LightColor, LightFile, NonNegative, Positive, SceneFile, ShadowsFile,
    Triple,
};
use shade::{Light, Shadow};

/// The illuminance of the default key light, in lux, if the only other light is ambient.
const KEY_LUX: f32 = 2.5;
/// The illuminance of that ambient light, in lux.
const AMBIENT_LUX: f32 = 0.7;
/// The illuminance of the default key light in an environment, in lux. Matte white that faces it
/// has the linear value 1.45 / π = 0.46, and at most 0.95 together with the studio of bare models.
const KEY_LIGHT_IN_ENVIRONMENT: NonNegative = NonNegative::KEY_LIGHT;
/// The elevation of the default key light above the horizon, in degrees.
const KEY_ELEVATION: f64 = 50.0;
/// The angle from the view to the default key light, seen from above, in degrees to the left.
const KEY_AZIMUTH: f64 = 55.0;

/// The maximum number of texels in all directional and spot shadow maps together: 0.8 GB.
const MAX_SHADOW_TEXELS: u64 = 1 << 26;
/// The minimum number of texels along the side of a shadow map.
const LEAST_SHADOW_SIDE: u32 = 64;

/// Resolves the scene's shadows. A ground that shows only shadows turns them on by default.
pub(super) fn resolve_scene_shadow(
    origin: &Origin,
    file: &SceneFile,
) -> Result<Option<Shadow>, SceneError> {
    let of_ground = file.ground.map(|_| ShadowsFile::DEFAULT);
    resolve_shadow(origin, file.shadows.or(of_ground).as_ref(), &[Field("shadows")])
}

/// Returns the lights described in the file, with `None` in place of `FromModels`.
pub(super) fn resolve_described_lights(
    origin: &Origin,
    file: &SceneFile,
    shadow: Option<Shadow>,
    faults: &mut Diagnostics,
) -> Option<Vec<Option<Light>>> {
    let numbered = file.lights.iter().flatten().enumerate();
    let lights: Vec<_> = numbered
        .map(|(number, light)| resolve_light(origin, number, light, shadow, faults))
        .collect();
    lights.into_iter().collect()
}

/// Returns the lights of a scene: the lights in the file or in the models, or a default key light
/// if nothing else lights the models or brings out their shape.
///
/// Only light that the style shows counts: clay receives the environment, but line drawings do not.
pub(super) fn resolve_lights(
    origin: &Origin,
    file: &SceneFile,
    described: &[Option<Light>],
    models: &[ModelInstance],
    view_projection: &ViewProjection,
    shadow: Option<Shadow>,
) -> Result<Vec<Light>, SceneError> {
    // An empty list means no lights, so the default light does not apply.
    if file.lights.is_some() {
        let lights = described.iter().flat_map(|light| match light {
            Some(light) => vec![*light],
            None => collect_model_lights(models, shadow),
        });
        return limit_shadow_maps(origin, file, lights.collect());
    }
    let theirs = collect_model_lights(models, shadow);
    if !theirs.is_empty() {
        return limit_shadow_maps(origin, file, theirs);
    }
    let key_light = |lux| default_key_light(view_projection, lux, shadow);
    Ok(match effective_environment(origin, file, models) {
        None => vec![key_light(KEY_LUX), Light::Ambient { lux: [AMBIENT_LUX; 3] }],
        // A bare model has the same light with and without shadows.
        Some(EnvironmentFile::Studio { .. }) if origin.text.is_empty() => {
            vec![key_light(KEY_LIGHT_IN_ENVIRONMENT.value() as f32)]
        }
        // Shadows are requested, so something must cast them.
        Some(_) if shadow.is_some() => vec![key_light(KEY_LIGHT_IN_ENVIRONMENT.value() as f32)],
        Some(_) => Vec::new(),
    })
}

/// Limits all directional and spot shadow maps together to [`MAX_SHADOW_TEXELS`]. Renderers limit
/// the maps of point lights.
///
/// Maps without an explicit size become smaller.
///
/// # Errors
/// Returns an error if the sizes that the scene sets exceed this limit.
fn limit_shadow_maps(
    origin: &Origin,
    file: &SceneFile,
    mut lights: Vec<Light>,
) -> Result<Vec<Light>, SceneError> {
    let mut shadows: Vec<&mut Shadow> = lights.iter_mut().filter_map(mapped_shadow).collect();
    let texels: u64 = shadows.iter().map(|shadow| u64::from(shadow.resolution).pow(2)).sum();
    if texels <= MAX_SHADOW_TEXELS {
        return Ok(lights);
    }
    let count = shadows.len();
    let side = libm::sqrt(MAX_SHADOW_TEXELS as f64 / count as f64) as u32;
    // Sizes in the file are rejected rather than silently reduced.
    if let Some(path) = chosen_size_path(file) {
        let lights = counted(count, "light", "lights");
        let message = format!(
            "the shadow maps of {lights} have {texels} texels in total; at most \
             {MAX_SHADOW_TEXELS} are allowed"
        );
        let help = format!("use `size: {}` for each", side.max(LEAST_SHADOW_SIDE));
        return Err(origin.error_at(&path, message, Some(help)));
    }
    for shadow in &mut shadows {
        shadow.resolution = shadow.resolution.min(side.max(LEAST_SHADOW_SIDE));
    }
    Ok(lights)
}

/// Returns the shadow of a light that uses a single shadow map.
const fn mapped_shadow(light: &mut Light) -> Option<&mut Shadow> {
    match light {
        Light::Sun { shadow, .. } | Light::Spot { shadow, .. } | Light::Legacy { shadow, .. } => {
            shadow.as_mut()
        }
        Light::Point { .. } | Light::Ambient { .. } => None,
    }
}

/// Returns the path of a shadow map size that the scene sets, for one light or for all lights.
fn chosen_size_path(file: &SceneFile) -> Option<Vec<PathStep<'static>>> {
    let is_chosen =
        |shadows: &ShadowsFile| matches!(shadows, ShadowsFile::On { size: Some(_), .. });
    let of_light = |light: &LightFile| match light {
        LightFile::Directional { shadows, .. } | LightFile::Spot { shadows, .. } => {
            shadows.as_ref().is_some_and(is_chosen)
        }
        _ => false,
    };
    let lights = file.lights.as_deref().unwrap_or_default();
    if let Some(index) = lights.iter().position(of_light) {
        return Some(vec![Field("lights"), Index(index), Field("shadows")]);
    }
    file.shadows.as_ref().is_some_and(is_chosen).then(|| vec![Field("shadows")])
}

/// Returns the lights in the models' files, in world space (KHR_lights_punctual).
///
/// Lights shine along −z of their node. Scales do not change intensities (lux, candela), as the
/// extension requires. A node whose transform collapses its z axis has no direction and is skipped.
fn collect_model_lights(models: &[ModelInstance], shadow: Option<Shadow>) -> Vec<Light> {
    let mut lights = Vec::new();
    for placed in models {
        for (instance, light) in placed.model.scene_lights() {
            let to_world = instance.node_to_model.then(placed.model_to_world);
            let position = to_world.transform_point(Point::ORIGIN).raw().as_vec3().to_array();
            let Some(axis) = to_world.transform_vector(-Vector::Z).normalized() else { continue };
            let axis = axis.raw().as_vec3().to_array();
            let strength = light.color.map(|channel| channel * light.intensity);
            lights.push(match light.kind {
                LightKind::Directional => {
                    Light::Sun { to_light: axis.map(|c| -c), lux: strength, shadow }
                }
                LightKind::Point { range } => {
                    Light::Point { position, candela: strength, range, shadow }
                }
                LightKind::Spot { range, inner_cone_angle: inner, outer_cone_angle: outer } => {
                    let cosines = [inner, outer].map(libm::cosf);
                    Light::Spot { position, axis, candela: strength, range, cosines, shadow }
                }
            });
        }
    }
    lights
}

/// Returns a directional light high above the ground and to the left of the view, so that visible
/// sides differ in brightness and shadows fall to the right, where they are visible.
///
/// The light follows the up direction of the world, y, rather than the camera's, so that a camera
/// that looks down does not move the light below the horizon.
fn default_key_light(view_projection: &ViewProjection, lux: f32, shadow: Option<Shadow>) -> Light {
    let camera = view_projection.camera;
    let level = |axis: Vector<World>| {
        let level = axis - Vector::Y * axis.dot(Vector::Y);
        (level.length() > 1e-3).then(|| level.normalized()).flatten()
    };
    // Toward the viewer along the ground; from straight above, toward the bottom of the picture.
    let front = level(camera.w()).or_else(|| level(-camera.v())).unwrap_or(Vector::Z);
    let to_light = direction_to_key_light(front).raw().as_vec3().to_array();
    Light::Sun { to_light, lux: [lux; 3], shadow }
}

/// Returns the direction to the key light for a viewer in the direction `front`, which is level.
fn direction_to_key_light(front: Vector<World>) -> Vector<World> {
    let left = front.cross(Vector::Y);
    let [azimuth, elevation] = [KEY_AZIMUTH, KEY_ELEVATION].map(f64::to_radians);
    let along_ground = front * libm::cos(azimuth) + left * libm::sin(azimuth);
    along_ground * libm::cos(elevation) + Vector::Y * libm::sin(elevation)
}

/// Returns the key light of a bare model in the three-quarter view as a light of the scene file,
/// which does not move with the camera.
///
/// Use it with [`EnvironmentFile::STUDIO`] to light views from different directions alike.
#[must_use]
pub fn fixed_key_light() -> LightFile {
    let front = NamedView::ThreeQuarter.from_direction();
    let front = (front - Vector::Y * front.dot(Vector::Y)).normalized().unwrap_or(Vector::Z);
    LightFile::Directional {
        direction: Triple((-direction_to_key_light(front)).raw().to_array()),
        intensity: KEY_LIGHT_IN_ENVIRONMENT,
        color: LightColor::WHITE,
        shadows: None,
    }
}

/// Resolves a light from the file, with the scene's shadows unless it sets its own; returns
/// `Some(None)` for `FromModels`.
///
/// Intensities are in lux for directional and ambient lights, and in candela for point and spot
/// lights; the color scales them. Numbers are converted to f32, the precision of shading. It is an
/// error if the direction is 0, or the cone or the shadow settings are invalid.
fn resolve_light(
    origin: &Origin,
    index: usize,
    light: &LightFile,
    shadow: Option<Shadow>,
    faults: &mut Diagnostics,
) -> Option<Option<Light>> {
    let range = |range: Option<Positive>| range.map_or(f32::INFINITY, |range| range.value() as f32);
    let single = |point: [f64; 3]| point.map(|c| c as f32);
    let own_shadow = |own| resolve_light_shadow(origin, index, own, shadow);
    Some(Some(match *light {
        LightFile::FromModels => return Some(None),
        LightFile::Directional { direction, intensity, color, shadows } => {
            // Both are resolved before either `?`, so that mistakes in both are reported.
            let direction = faults.take(resolve_direction(origin, index, direction));
            let shadow = faults.take(own_shadow(shadows));
            Light::Sun {
                to_light: (-direction?).raw().as_vec3().to_array(),
                lux: scale_color(color, intensity),
                shadow: shadow?,
            }
        }
        LightFile::Spot { position, direction, intensity, color, shadows, .. } => {
            let axis = faults.take(resolve_direction(origin, index, direction));
            let cosines = faults.take(resolve_cone(origin, index, light));
            let shadow = faults.take(own_shadow(shadows));
            Light::Spot {
                position: single(position.0),
                axis: axis?.raw().as_vec3().to_array(),
                candela: scale_color(color, intensity),
                range: range(light.range()),
                cosines: cosines?,
                shadow: shadow?,
            }
        }
        LightFile::Point { position, intensity, color, shadows, .. } => Light::Point {
            position: single(position.0),
            candela: scale_color(color, intensity),
            range: range(light.range()),
            shadow: faults.take(own_shadow(shadows))?,
        },
        LightFile::Ambient { intensity, color } => {
            Light::Ambient { lux: scale_color(color, intensity) }
        }
    }))
}

/// Returns the direction in which a light travels, from the light to the scene, as a unit vector in
/// world space.
///
/// # Errors
/// Returns an error if it is (0, 0, 0).
fn resolve_direction(
    origin: &Origin,
    index: usize,
    direction: Triple,
) -> Result<Vector<World>, SceneError> {
    Vector::<World>::from(direction.0).normalized().ok_or_else(|| {
        let path = [Field("lights"), Index(index), Field("direction")];
        let help =
            "use a direction such as (-1, -2, -1): from the right, above and the front".to_owned();
        origin.error_at(&path, "the direction of the light must not be (0, 0, 0)", Some(help))
    })
}

/// Returns the cosines of a spot light's inner and outer cone angles, by default 0° and 45°.
///
/// Intensity falls off from the inner to the outer angle. These are half angles, as in
/// KHR_lights_punctual.
///
/// # Errors
/// Returns an error unless 0° ≤ inner < outer ≤ 90°.
fn resolve_cone(origin: &Origin, index: usize, light: &LightFile) -> Result<[f32; 2], SceneError> {
    let (inner, outer) = match *light {
        LightFile::Spot { inner_cone_degrees, outer_cone_degrees, .. } => {
            (inner_cone_degrees, outer_cone_degrees)
        }
        _ => (None, None),
    };
    let inner = inner.map_or(0.0, Finite::value);
    let outer = outer.map_or(45.0, Finite::value);
    if inner >= 0.0 && inner < outer && outer <= 90.0 {
        return Ok([inner, outer].map(|angle| libm::cos(angle.to_radians()) as f32));
    }
    let path = [Field("lights"), Index(index), Field("outer_cone_degrees")];
    let message = format!("invalid spot falloff from {inner} to {outer} degrees");
    let help = "choose 0 <= inner_cone_degrees < outer_cone_degrees <= 90".to_owned();
    Err(origin.error_at(&path, message, Some(help)))
}

/// Returns the shadows of a light: its own, or the scene's.
fn resolve_light_shadow(
    origin: &Origin,
    index: usize,
    own: Option<ShadowsFile>,
    of_scene: Option<Shadow>,
) -> Result<Option<Shadow>, SceneError> {
    let path = [Field("lights"), Index(index), Field("shadows")];
    own.map_or(Ok(of_scene), |own| resolve_shadow(origin, Some(&own), &path))
}

/// Multiplies the intensity of all lights.
pub(super) fn scale_lights(lights: &mut [Light], factor: NonNegative) {
    let factor = factor.value() as f32;
    for light in lights {
        let (Light::Sun { lux: intensity, .. }
        | Light::Ambient { lux: intensity }
        | Light::Point { candela: intensity, .. }
        | Light::Spot { candela: intensity, .. }
        | Light::Legacy { lux: intensity, .. }) = light;
        *intensity = intensity.map(|channel| channel * factor);
    }
}

/// Returns a color multiplied by an intensity, in the unit of the intensity.
fn scale_color(color: LightColor, intensity: NonNegative) -> [f32; 3] {
    color.0.map(|channel| (channel * intensity.value()) as f32)
}
