//! Line drawings in a scene file: which lines, how hidden ones show, how wide.

use crate::scene::number::{Crease, Percent, Positive, Spacing};
use serde::Deserialize;

/// A line drawing.
#[derive(Clone, PartialEq, Debug, Deserialize)]
#[serde(rename = "Lines", deny_unknown_fields, default)]
pub struct LinesFile {
    /// Which lines are drawn. Default: `Features`.
    pub shown: EdgeSelectionFile,
    /// What becomes of hidden lines. Default: `Removed`.
    pub hidden: HiddenFile,
    /// Faces that meet at more than this angle have an edge between them. Default: 30.
    pub crease_degrees: Crease,
    /// How much of its contrast the farthest line loses. Default: 0.
    pub depth_cue_percent: Percent,
    /// How wide lines are. Default: 1.25 pixels.
    pub width: WidthFile,
    /// The colour of the lines, `#rgb` or `#rrggbb`. Default: dark on light, light on dark.
    pub color: Option<String>,
    /// How lines end. Default: `Round`.
    pub cap: CapFile,
    /// How lines turn corners. Default: `Round`.
    pub join: JoinFile,
    /// The distance between the lines of hatching, in millimetres of the paper, from 0.1 to 1000: on the cut faces of
    /// `sections`, and the closest on faces with `tone: Hatching`. Default: 2.
    pub hatch_mm: Spacing,
    /// What is on the faces under the lines. Default: `Blank`.
    pub tone: FaceFillFile,
}

impl Default for LinesFile {
    fn default() -> Self {
        Self {
            shown: EdgeSelectionFile::Features,
            hidden: HiddenFile::Removed,
            crease_degrees: Crease::USUAL,
            depth_cue_percent: Percent::ZERO,
            width: WidthFile::Px(Positive::known(1.25)),
            color: None,
            cap: CapFile::Round,
            join: JoinFile::Round,
            hatch_mm: Spacing::USUAL,
            tone: FaceFillFile::Blank,
        }
    }
}

/// Which lines are drawn.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Deserialize)]
#[serde(rename = "Shown")]
pub enum EdgeSelectionFile {
    /// The sides of all triangles.
    Facets,
    /// Outlines, borders, creases, and where bodies cross.
    Features,
    /// Features, and where one smooth surface goes over into another.
    Tangents,
    /// Outlines and borders.
    Silhouette,
}

/// What becomes of hidden lines.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Deserialize)]
#[serde(rename = "Hidden")]
pub enum HiddenFile {
    /// They are left out.
    Removed,
    /// They are dashed.
    Dashed,
    /// They are drawn like the others.
    Drawn,
}

/// How wide lines are.
#[derive(Clone, Copy, PartialEq, Debug, Deserialize)]
#[serde(rename = "Width")]
pub enum WidthFile {
    /// So many pixels, of which an inch of paper has 96.
    Px(Positive),
    /// So many millimetres.
    Mm(Positive),
    /// A group of ISO 128 by the width of its wide lines in millimetres: 0.25, 0.35, 0.5, 0.7, 1, 1.4 or 2. Narrow lines are half as
    /// wide.
    Iso(Positive),
}

impl WidthFile {
    /// 0.5 mm and 0.25 mm.
    pub const DEFAULT_ISO: Self = Self::Iso(Positive::known(0.5));
}

/// What is on the faces under the lines.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, Deserialize)]
#[serde(rename = "Tone")]
pub enum FaceFillFile {
    /// Nothing: the paper.
    #[default]
    Blank,
    /// Each face in one tone of its own colour, as light from above the viewer's left shoulder has it. A picture of 300 dots to
    /// the inch under the lines.
    Flat,
    /// Lines, the closer the darker the face would be in that light. They are as exact as the edges.
    Hatching,
}

/// How lines end.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Deserialize)]
#[serde(rename = "Cap")]
pub enum CapFile {
    /// At the end.
    Butt,
    /// With a half disc.
    Round,
    /// Half a width beyond the end.
    Square,
}

/// How lines turn corners.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Deserialize)]
#[serde(rename = "Join")]
pub enum JoinFile {
    /// In a point.
    Miter,
    /// With a disc.
    Round,
    /// The corner cut off.
    Bevel,
}
