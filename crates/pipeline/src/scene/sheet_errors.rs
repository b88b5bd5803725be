//! Errors of a scene's sheet, before it is drawn: values out of range, views larger than the paper.

use super::assembly::resolve_assembly;
use super::file::SheetFile;
use super::section::resolve_sections;
use super::sheet::{SCALE_PATH, SheetContent, resolve_sheet};
use super::sheet_views::sheet_view_error;
use super::style::resolve_style;
use super::syntax::PathStep::{self, Field};
use super::uncut::resolve_uncut;
use super::{Origin, SceneError, SceneFile, Style};
use model::ModelInstance;
use sheet::SheetError;
use std::path::PathBuf;

/// The error of a sheet that can be found without the models.
pub(super) fn sheet_description_error(
    origin: &Origin,
    file: &SceneFile,
    allowed: &[PathBuf],
) -> Option<SceneError> {
    let nothing = SheetContent {
        models: &[],
        sections: &[],
        uncut: &[],
        style: None,
        overlays: &[],
        allowed_folders: allowed,
    };
    resolve_sheet(origin, file.sheet.as_ref()?, nothing).err()
}

/// The error of a sheet that does not hold its views; mistakes in sections and style are found
/// elsewhere.
pub(super) fn sheet_error(
    origin: &Origin,
    file: &SceneFile,
    models: &[ModelInstance],
    allowed: &[PathBuf],
) -> Option<SceneError> {
    let sections = resolve_sections(origin, &file.sections).unwrap_or_default();
    let uncut = resolve_uncut(origin, &file.sections, models).unwrap_or_default();
    let style = match resolve_style(origin, &file.style) {
        Ok(Style::Lines(style)) => Some(style),
        _ => None,
    };
    let content = SheetContent {
        models,
        sections: &sections,
        uncut: &uncut,
        style,
        overlays: &[],
        allowed_folders: allowed,
    };
    layout_error(origin, file.sheet.as_ref()?, content)
}

/// The error of a sheet whose views are larger than its paper, or that names parts which the models
/// do not have; `None` without one, or if it is wrong in itself.
fn layout_error(
    origin: &Origin,
    file: &SheetFile,
    content: SheetContent<'_>,
) -> Option<SceneError> {
    if let Err(error) = resolve_assembly(origin, file, content.models) {
        return Some(error);
    }
    let sheet = resolve_sheet(origin, file, content).ok()?;
    let error = sheet.check_layout(content.models, content.sections).err()?;
    if let Some(error) = sheet_view_error(origin, &error) {
        return Some(error);
    }
    let place: &[PathStep<'_>] = match (&error, file.scale) {
        (SheetError::TooLarge { .. }, Some(_)) => &SCALE_PATH,
        (SheetError::TooLarge { .. }, None) => &[Field("sheet")],
        // Models without anything to draw are an error of the camera.
        _ => return None,
    };
    let message = error.to_string();
    // The remedy is the last part of the message.
    let (message, help) = match message.rsplit_once("; ") {
        Some((message, help)) => (message.to_owned(), Some(help.to_owned())),
        None => (message, None),
    };
    Some(origin.error_at(place, message, help))
}
