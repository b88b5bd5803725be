//! From the lights that a scene file asks for to those that drawing needs.

use super::file::{Finite, LightFile, SceneFile, ShadowsFile};
use super::number::Positive;
use super::shadows::resolve_shadow;
use super::source_span::PathStep::{Field, Index};
use super::{Origin, SceneError};
use camera::ViewProjection;
use homog::{Point, Vector, World};
use model::LightKind;
use model::ModelInstance;
use shade::{Light, Shadow};

pub(super) fn resolve_lights(
    origin: &Origin,
    file: &SceneFile,
    models: &[ModelInstance],
    view_projection: &ViewProjection,
) -> Result<Vec<Light>, SceneError> {
    // Ground that only shows shadows is there for the sake of shadows.
    let of_ground = file.ground.map(|_| ShadowsFile::DEFAULT);
    let asked = file.shadows.or(of_ground);
    let shadow = resolve_shadow(origin, asked.as_ref(), &[Field("shadows")])?;
    let Some(lights) = &file.lights else {
        let theirs = collect_model_lights(models, shadow);
        let is_dark = file.effective_environment(origin, models).is_none();
        return Ok(match (theirs.is_empty(), is_dark) {
            (true, true) => default_lights(view_projection, shadow),
            // Shadows were asked for, and somebody must cast them.
            (true, false) if shadow.is_some() => {
                vec![default_key_light(view_projection, 1.5, shadow)]
            }
            _ => theirs,
        });
    };
    let mut resolved = Vec::new();
    for (number, light) in lights.iter().enumerate() {
        match resolve_light(origin, number, light, shadow)? {
            Some(light) => resolved.push(light),
            None => resolved.extend(collect_model_lights(models, shadow)),
        }
    }
    Ok(resolved)
}

/// The lights that the models' files have, in the world (KHR_lights_punctual). Scales do not make them brighter.
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
                LightKind::Point { range } => Light::Point { position, candela: strength, range },
                LightKind::Spot { range, inner_cone_angle: inner, outer_cone_angle: outer } => {
                    let cosines = [inner, outer].map(libm::cosf);
                    Light::Spot { position, axis, candela: strength, range, cosines, shadow }
                }
            });
        }
    }
    lights
}

/// A key light from above the viewer's left shoulder, so that shape reads from every side, and a quarter as much ambient.
fn default_lights(view_projection: &ViewProjection, shadow: Option<Shadow>) -> Vec<Light> {
    vec![default_key_light(view_projection, 2.5, shadow), Light::Ambient { lux: [0.7; 3] }]
}

fn default_key_light(view_projection: &ViewProjection, lux: f32, shadow: Option<Shadow>) -> Light {
    let camera = view_projection.camera;
    let towards = camera.u() * -0.45 + camera.v() * 0.65 + camera.w();
    let towards = towards.normalized().unwrap_or(camera.w());
    Light::Sun { to_light: towards.raw().as_vec3().to_array(), lux: [lux; 3], shadow }
}

/// A light of the file, with the scene's shadows where it says nothing of its own; `None` for those of the models.
pub(super) fn resolve_light(
    origin: &Origin,
    number: usize,
    light: &LightFile,
    shadow: Option<Shadow>,
) -> Result<Option<Light>, SceneError> {
    let range = |range: Option<Positive>| range.map_or(f32::INFINITY, |range| range.value() as f32);
    let direction_of = |direction: [f64; 3], whose: &str| {
        Vector::<World>::from(direction).normalized().ok_or_else(|| {
            let at = [Field("lights"), Index(number), Field("direction")];
            let help = Some("such as (-1, -2, -1): from the right, above and before".to_owned());
            origin.error_at(
                &at,
                format!("the {whose}'s direction is (0, 0, 0), which is none"),
                help,
            )
        })
    };
    let own = |file: Option<ShadowsFile>| {
        let at = [Field("lights"), Index(number), Field("shadows")];
        file.map_or(Ok(shadow), |file| resolve_shadow(origin, Some(&file), &at))
    };
    let times = |strength: f64, color: [f64; 3]| color.map(|channel| (channel * strength) as f32);
    Ok(Some(match *light {
        LightFile::FromModels => return Ok(None),
        LightFile::Sun { direction, lux, color, shadows } => {
            let towards = -direction_of(direction.0, "sun")?;
            let towards = towards.raw().as_vec3().to_array();
            Light::Sun {
                to_light: towards,
                lux: times(lux.value(), color.0),
                shadow: own(shadows)?,
            }
        }
        LightFile::Spot {
            position,
            direction,
            candela,
            inner_degrees,
            outer_degrees,
            range: end,
            color,
            shadows,
        } => {
            let axis = direction_of(direction.0, "spot")?.raw().as_vec3().to_array();
            let inner = inner_degrees.map_or(0.0, Finite::value);
            let outer = outer_degrees.map_or(45.0, Finite::value);
            if !(inner >= 0.0 && inner < outer && outer <= 90.0) {
                let at = [Field("lights"), Index(number), Field("outer_degrees")];
                let message =
                    format!("a spot cannot be full up to {inner} degrees and end at {outer}");
                let help = Some("0 <= inner_degrees < outer_degrees <= 90".to_owned());
                return Err(origin.error_at(&at, message, help));
            }
            let cosines = [inner, outer].map(|angle| libm::cos(angle.to_radians()) as f32);
            let position = position.0.map(|c| c as f32);
            let candela = times(candela.value(), color.0);
            let shadow = own(shadows)?;
            Light::Spot { position, axis, candela, range: range(end), cosines, shadow }
        }
        LightFile::Point { position, candela, range: end, color } => Light::Point {
            position: position.0.map(|c| c as f32),
            candela: times(candela.value(), color.0),
            range: range(end),
        },
        LightFile::Ambient { lux, color } => Light::Ambient { lux: times(lux.value(), color.0) },
    }))
}
