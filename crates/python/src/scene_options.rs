//! Picture and drawing options: the parts of a scene description that a call overrides.

use crate::failure::{Failure, Fallible};
use crate::keywords::{Keywords, not_a, plain_name};
use crate::native_camera::NativeCamera;
use crate::subject::Subject;
use pipeline::SceneFile;
use pyo3::prelude::*;
use scene::fixed_key_light;
use scene_file::file::{BackgroundFile, Color, EnvironmentFile, Finite, StyleFile};

/// Applies the options of a call to the description of a subject's scene.
///
/// # Errors
/// Returns an error if an option is invalid.
pub(crate) fn apply_options(subject: &Subject, options: &Keywords<'_, '_>) -> PyResult<SceneFile> {
    let mut file = subject.file.clone();
    if let Some(camera) = options.value("camera")? {
        let camera = camera.cast::<NativeCamera>()?.get();
        file.camera = camera.file.clone();
        file.image.size = camera.size.unwrap_or(file.image.size);
    }
    if let Some(size) = options.size("size")? {
        file.image.size = size;
    }
    if let Some(name) = options.text("style")? {
        file.style = style_by_name(&name)?;
    }
    if let Some(value) = options.value("background")? {
        file.image.background = Some(read_background(&value)?);
    }
    apply_light_options(subject, options, &mut file)?;
    if let Some(samples) = options.count("samples")? {
        if ![1, 4, 8, 16].contains(&samples) {
            let message = format!("is {samples}, expected 1, 4, 8 or 16");
            return Err(Failure::argument("samples", message).into());
        }
        file.image.samples = samples as u32;
    }
    Ok(file)
}

/// Finds a style by name.
fn style_by_name(name: &str) -> Fallible<StyleFile> {
    let wanted = plain_name(name);
    let known = StyleFile::NAMED.into_iter().find(|(known, _)| plain_name(known) == wanted);
    known.map(|(_, make)| make()).ok_or_else(|| {
        let names = StyleFile::NAMED.map(|(name, _)| name).join(", ");
        Failure::argument("style", format!("is {name:?}, expected one of {names}"))
    })
}

/// Applies the options for lights, environment, shadows, ground and exposure. Python passes
/// structured values as JSON in the form of scene files.
fn apply_light_options(
    subject: &Subject,
    options: &Keywords<'_, '_>,
    file: &mut SceneFile,
) -> PyResult<()> {
    if let Some(lights) = options.value("lights")? {
        if let Ok(name) = lights.extract::<String>() {
            apply_named_light(subject, &name, file)?;
        } else {
            let texts: Vec<String> = lights.extract()?;
            let read = |(index, text): (usize, &String)| {
                let light = serde_json::from_str(text);
                light.map_err(|error| wrong_json(&format!("lights[{index}]"), &error))
            };
            file.lights = Some(texts.iter().enumerate().map(read).collect::<Fallible<_>>()?);
        }
    }
    if let Some(text) = options.text("environment")? {
        let environment = serde_json::from_str(&text);
        file.environment = Some(environment.map_err(|error| wrong_json("environment", &error))?);
    }
    if let Some(text) = options.text("shadows")? {
        let shadows = serde_json::from_str(&text);
        file.shadows = Some(shadows.map_err(|error| wrong_json("shadows", &error))?);
    }
    if let Some(text) = options.text("ground")? {
        let ground = serde_json::from_str(&text);
        file.ground = Some(ground.map_err(|error| wrong_json("ground", &error))?);
    }
    if let Some(stops) = options.number("exposure")? {
        file.image.exposure_ev = Finite::new(stops);
    }
    if let Some(curve) = options.named("tone_mapping")? {
        file.image.tone_mapping = Some(curve);
    }
    Ok(())
}

/// Applies the name of a lighting: `camera` is the default, and `world` keeps the default key light
/// in place when the camera moves.
fn apply_named_light(subject: &Subject, name: &str, file: &mut SceneFile) -> Fallible<()> {
    match name {
        "camera" => Ok(()),
        "world" => {
            let has_lights =
                subject.models.iter().any(|placed| placed.model.scene_lights().next().is_some());
            // Lights of the file or of the models do not move with the camera.
            if file.lights.is_none() && !has_lights {
                file.lights = Some(vec![fixed_key_light()]);
                file.environment.get_or_insert(EnvironmentFile::STUDIO);
            }
            Ok(())
        }
        _ => {
            let message =
                format!("is {name:?}, expected \"camera\", \"world\" or a list of lights");
            Err(Failure::argument("lights", message))
        }
    }
}

/// Returns the error for a part of a scene file in JSON, without its position in the text.
fn wrong_json(argument: &str, error: &serde_json::Error) -> Failure {
    let message = error.to_string();
    let end = message.rfind(" at line ").unwrap_or(message.len());
    Failure::argument(argument, &message[..end])
}

/// Reads a background: transparent, the name of a color, or three channels as bytes.
fn read_background(value: &Bound<'_, PyAny>) -> PyResult<BackgroundFile> {
    let wanted = "transparent, #rrggbb, the name of a color, or (r, g, b) from 0 to 255";
    let Ok(text) = value.extract::<String>() else {
        let channels = value.extract::<[u8; 3]>();
        let channels = channels.map_err(|_| PyErr::from(not_a("background", value, wanted)))?;
        return Ok(BackgroundFile::Color(Color(channels)));
    };
    if text.eq_ignore_ascii_case("transparent") {
        return Ok(BackgroundFile::Transparent);
    }
    let color = Color::parse(&text).map(BackgroundFile::Color);
    color.ok_or_else(|| not_a("background", value, wanted).into())
}
