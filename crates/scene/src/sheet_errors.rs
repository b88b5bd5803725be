//! Errors in a scene's sheet, found before drawing, such as views larger than the paper.

use super::assembly::resolve_assembly;
use super::diagnostics::Diagnostics;
use super::section::resolve_sections;
use super::sheet::{SheetContent, resolve_sheet};
use super::sheet_scale::SCALE_PATH;
use super::sheet_views::sheet_view_error;
use super::style::resolve_style;
use super::uncut::resolve_uncut;
use super::{Origin, Style};
use model::ModelInstance;
use scene_file::PathStep::{self, Field};
use scene_file::file::SheetFile;
use scene_file::{SceneError, SceneFile};
use sheet::SheetError;
use std::path::PathBuf;

/// Reports the mistakes in a scene's sheet; without models, only mistakes that do not depend on
/// them. Mistakes in sections and style are found elsewhere.
pub(super) fn check_sheet(
    origin: &Origin,
    file: &SceneFile,
    models: Option<&[ModelInstance]>,
    allowed: &[PathBuf],
    faults: &mut Diagnostics,
) {
    let Some(sheet) = &file.sheet else { return };
    let sections = resolve_sections(origin, &file.sections, &mut Diagnostics::default());
    let sections = sections.filter(|_| models.is_some()).unwrap_or_default();
    let models = models.unwrap_or_default();
    let uncut = resolve_uncut(origin, &file.sections, models).unwrap_or_default();
    let style = match resolve_style(origin, file) {
        Ok(Style::Lines(style)) if !models.is_empty() => Some(style),
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
    // Resolve the sheet without content first, to find mistakes that do not depend on models. Try
    // the layout only if there are no such mistakes.
    let nothing = SheetContent { models: &[], sections: &[], uncut: &[], style: None, ..content };
    if faults.take(resolve_sheet(origin, sheet, nothing)).is_some() && !models.is_empty() {
        layout_error(origin, sheet, content).into_iter().for_each(|error| faults.report(error));
    }
}

/// Returns the error for a sheet whose views are larger than its paper, or that names parts missing
/// from the models. Returns `None` if the description of the sheet is invalid.
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
        // Models with nothing to draw are a camera error.
        _ => return None,
    };
    let message = error.to_string();
    // The suggested fix is the last part of the message.
    let (message, help) = match message.rsplit_once("; ") {
        Some((message, help)) => (message.to_owned(), Some(help.to_owned())),
        None => (message, None),
    };
    Some(origin.error_at(place, message, help))
}
