//! Picture and drawing options: the parts of a scene description that a call overrides.

use crate::failure::{Failure, Fallible};
use crate::keywords::{Keywords, plain_name};
use crate::native_camera::NativeCamera;
use crate::subject::Subject;
use pipeline::SceneFile;
use pyo3::prelude::*;
use scene_file::file::{BackgroundFile, Color, StyleFile};

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
    if let Some(text) = options.text("background")? {
        file.image.background = Some(background_by_name(&text)?);
    }
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

/// Reads a background: transparent, or a color.
fn background_by_name(text: &str) -> Fallible<BackgroundFile> {
    if text.eq_ignore_ascii_case("transparent") {
        return Ok(BackgroundFile::Transparent);
    }
    let color = Color::parse(text).map(BackgroundFile::Color);
    color.ok_or_else(|| {
        let message = format!("is {text:?}, expected transparent, #rrggbb or the name of a color");
        Failure::argument("background", message)
    })
}
