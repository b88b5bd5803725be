//! Resolution of overlays: the view volumes of other cameras, and labels at points in the world.

use super::view_projection::resolve_view_projection;
use super::{ImageSpec, Origin};
use drawing::{Overlay, PointLabel};
use glam::DVec2;
use model::ModelInstance;
use page::palette::ink_on_paper;
use scene_file::PathStep::{Field, Index};
use scene_file::SceneError;
use scene_file::file::{Finite, OverlayFile, Positive};
use shade::color::SrgbEncoder;

/// The offset of labels without a leader line, in pixels: up and to the right.
const OFFSET: DVec2 = DVec2::new(5.0, -5.0);
/// The offset of labels with a leader line.
const LEADER_OFFSET: DVec2 = DVec2::new(24.0, -24.0);

/// Resolves the overlays, with the view-projection of each camera whose view volume is drawn.
///
/// # Errors
/// Returns an error if such a camera is invalid, or a label has no text.
pub(super) fn resolve_overlays(
    origin: &Origin,
    overlays: &[OverlayFile],
    models: &[ModelInstance],
    image: ImageSpec,
) -> Result<Vec<Overlay>, SceneError> {
    let resolve = |(number, overlay): (usize, &OverlayFile)| {
        Ok(match overlay {
            OverlayFile::Axes { length } => Overlay::Axes(length.map(Positive::value)),
            OverlayFile::Grid { step } => Overlay::Grid(step.map(Positive::value)),
            OverlayFile::Horizon => Overlay::Horizon,
            OverlayFile::Edges => Overlay::Edges,
            OverlayFile::VanishingPoints => Overlay::VanishingPoints,
            OverlayFile::Volume(camera) => {
                // The caption is outside the camera's view.
                let image = image.without_caption();
                Overlay::Volume(resolve_view_projection(origin, camera, models, image)?.into())
            }
            OverlayFile::Label { text, .. } if text.trim().is_empty() => {
                let at = [Field("overlays"), Index(number), Field("text")];
                let help = "write text such as \"A\", or remove the label".to_owned();
                return Err(origin.error_at(&at, "the label has no text", Some(help)));
            }
            OverlayFile::Label { at, text, offset, color, size, leader } => {
                let usual = if *leader { LEADER_OFFSET } else { OFFSET };
                let offset = offset.map(|(x, y)| DVec2::from([x, y].map(Finite::value)));
                Overlay::Label(PointLabel {
                    at: at.0.into(),
                    text: text.clone(),
                    offset: offset.unwrap_or(usual),
                    ink: color.map_or_else(|| contrasting_ink(image.background), |color| color.0),
                    height: size.value(),
                    leader: *leader,
                })
            }
        })
    };
    overlays.iter().enumerate().map(resolve).collect()
}

/// Returns dark or light ink that is readable on the background.
fn contrasting_ink(background: [f32; 4]) -> page::Ink {
    let [r, g, b, alpha] = SrgbEncoder::shared().encode_pixel(background);
    ink_on_paper((alpha == 255).then_some([r, g, b]))
}
