//! Lints for labels and captions: points outside the picture, and characters without a glyph.

use super::{Lint, Linter};
use crate::Scene;
use crate::origin::Origin;
use drawing::{LabelFault, Overlay, PointLabel, missing_glyph_warning};
use scene_file::PathStep::{Field, Index};

/// Returns the lints for text in the scene's main view and in its viewports, without duplicates.
pub(super) fn lint_text(adviser: &Linter<'_>) -> Vec<Lint> {
    let Linter { origin, file, scene, .. } = *adviser;
    let mut lints = lint_view(origin, scene);
    // The views of a stereo pair show the same labels.
    if file.stereo.is_none() {
        for (number, inset) in scene.insets.iter().enumerate() {
            lints.extend(lint_view(&origin.for_viewport(number), &inset.scene));
        }
    }
    let mut distinct: Vec<Lint> = Vec::new();
    for lint in lints {
        if !distinct.contains(&lint) {
            distinct.push(lint);
        }
    }
    distinct
}

/// Returns the lints for text in one view.
fn lint_view(origin: &Origin, scene: &Scene) -> Vec<Lint> {
    let mut lints = Vec::new();
    for (number, overlay) in scene.overlays.iter().enumerate() {
        let Overlay::Label(label) = overlay else { continue };
        lints.extend(lint_label(origin, scene, number, label));
        lints.extend(lint_glyphs(origin, &label.text, Some(number)));
    }
    lints.extend(scene.caption.iter().filter_map(|text| lint_glyphs(origin, text, None)));
    lints
}

/// Warns about a label whose point is outside the picture.
fn lint_label(origin: &Origin, scene: &Scene, number: usize, label: &PointLabel) -> Option<Lint> {
    let view_height = scene.image.view_size().y / f64::from(scene.image.height);
    let place = match label.fault(&scene.view_projection, view_height)? {
        LabelFault::BehindEye => "behind the eye",
        LabelFault::Outside => "outside the picture",
    };
    let message = format!("the label \"{}\" is not drawn: its point is {place}", label.text);
    let help = "move the point, or remove the label".to_owned();
    let at = [Field("overlays"), Index(number), Field("at")];
    Some(Lint { code: "label-not-visible", error: origin.error_at(&at, message, Some(help)) })
}

/// Warns about text with characters missing from the stroke font: the label with this number, or
/// the caption.
fn lint_glyphs(origin: &Origin, text: &str, label: Option<usize>) -> Option<Lint> {
    let message = missing_glyph_warning(text)?.to_string();
    let at = match label {
        Some(number) => vec![Field("overlays"), Index(number), Field("text")],
        None => vec![Field("caption")],
    };
    let help = "use letters of Latin alphabets, digits and common symbols".to_owned();
    Some(Lint { code: "missing-glyph", error: origin.error_at(&at, message, Some(help)) })
}
