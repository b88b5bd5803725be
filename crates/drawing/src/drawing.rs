//! Drawings: the lines of a view, and the fill of faces under them.

use crate::Warning;
use crate::layout::Placement;
use glam::DVec2;
use hidden_line::{EdgeSegment, LineDrawing, Region};
use picture::Picture;

/// A line drawing with a fill under its lines, ready to become page layers.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Drawing {
    /// The width and height of the image in pixels.
    pub size: DVec2,
    /// The object names, from the nodes of the models.
    pub objects: Vec<String>,
    /// Visible segments, and hidden segments if the options retain them.
    pub segments: Vec<EdgeSegment>,
    /// The cut faces with their hatch lines, and the outlines if requested in the options.
    pub regions: Vec<Region>,
    /// The flat or gray fill under the lines: an image that covers the drawing, present if
    /// requested and if there are faces. The pixels of a gray fill are gray levels, not colors.
    pub face_fill: Option<Picture>,
    /// Warnings about the drawing, without duplicates.
    pub warnings: Vec<Warning>,
}

impl Drawing {
    /// Whether the drawing has no segments, no regions and no visible fill.
    pub fn is_empty(&self) -> bool {
        let is_clear = |fill: &Picture| fill.pixels.iter().all(|pixel| pixel[3] == 0);
        let has_fill = self.face_fill.as_ref().is_some_and(|fill| !is_clear(fill));
        self.segments.is_empty() && self.regions.is_empty() && !has_fill
    }
}

impl From<LineDrawing> for Drawing {
    /// Converts lines to a drawing without a fill, and adds a warning if the outlines would not be
    /// exact on a page.
    fn from(lines: LineDrawing) -> Self {
        let LineDrawing { size, objects, segments, regions, warnings } = lines;
        let is_traced = regions.iter().any(|region| Placement::PICTURE.traces_region(region));
        let mut warnings: Vec<Warning> = warnings.into_iter().map(Warning::Lines).collect();
        warnings.extend(is_traced.then_some(Warning::OutlinesTraced));
        warnings.sort_unstable();
        Self { size, objects, segments, regions, face_fill: None, warnings }
    }
}
