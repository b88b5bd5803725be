//! Lints for sheets: views without room, sections that no view shows, and missing glyphs.

use super::{Lint, Linter};
use crate::sheet::{SheetContent, resolve_sheet};
use drawing::Warning;
use scene_file::PathStep::Field;
use sheet::SheetWarning;
use std::path::PathBuf;

/// Returns the warnings that `alberti sheet` would print about the layout of the scene's sheet,
/// whose title block is in the scene's folder or an allowed folder.
pub(super) fn lint_sheet(adviser: &Linter<'_>, allowed_folders: &[PathBuf]) -> Vec<Lint> {
    let Linter { origin, file, scene, .. } = *adviser;
    let Some(sheet_file) = &file.sheet else { return Vec::new() };
    let content = SheetContent { allowed_folders, ..SheetContent::from_scene(scene) };
    // Errors are reported by the resolution of the scene, not by lints.
    let sheet = resolve_sheet(origin, sheet_file, content).ok();
    let warnings = sheet.and_then(|sheet| sheet.check_layout(&scene.models, &scene.sections).ok());
    let to_lint = |warning: SheetWarning| {
        let (code, help) = match &warning {
            SheetWarning::ViewLeftOut { .. } => ("sheet-view-missing", "or remove the view"),
            SheetWarning::SectionOblique { .. } => {
                ("section-oblique", "turn the section, or view it with `alberti render`")
            }
            SheetWarning::Drawing(Warning::GlyphsMissing { .. }) => {
                ("missing-glyph", "use letters of Latin alphabets, digits and common symbols")
            }
            SheetWarning::OverlayNotOnSheets { .. } => {
                ("overlay-not-on-sheet", "`alberti render` draws it in pictures")
            }
            // Planes that miss the models are reported at their own fields.
            _ => return None,
        };
        let error = origin.error_at(&[Field("sheet")], warning.to_string(), Some(help.to_owned()));
        Some(Lint { code, error })
    };
    warnings.into_iter().flatten().filter_map(to_lint).collect()
}
