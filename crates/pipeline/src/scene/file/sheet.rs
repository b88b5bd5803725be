//! A sheet in a scene file: paper, arrangement, scale, and what the title block says.

use super::lines::HiddenFile;
use crate::scene::number::Positive;
use serde::Deserialize;

/// A sheet with views of the models.
#[derive(Clone, PartialEq, Debug, Deserialize)]
#[serde(rename = "Sheet", deny_unknown_fields, default)]
pub struct SheetFile {
    /// The paper. Default: A3.
    pub paper: PaperFile,
    /// How it lies. Default: A4 and A5 upright, all others lying.
    pub orientation: Option<OrientationFile>,
    /// Where the views lie. Default: first angle.
    pub angle: AngleFile,
    /// The scale, paper to thing, as in (1, 50). Default: the largest of the standard series that fits.
    pub scale: Option<(u32, u32)>,
    /// What a unit of the models is. Default: a metre, as glTF has it.
    pub unit: UnitFile,
    /// The view beside the front view. Default: from the left in first angle, from the right in third.
    pub side: Option<SideFile>,
    /// The fourth view. Default: isometric.
    pub axonometric: AxonometricFile,
    /// What becomes of hidden lines in the first three views. Default: dashed.
    pub hidden: HiddenFile,
    /// The width of wide lines in millimetres, a group of ISO 128. Default: as goes with the paper.
    pub width: Option<Positive>,
    /// Whether overall dimensions are drawn. Default: yes.
    pub dimensions: bool,
    /// What the sheet shows. Default: the names of the models.
    pub title: String,
    /// Who made it. Default: nobody is named.
    pub author: String,
    /// When, as it is to be written. Default: nothing is said.
    pub date: String,
    /// The number of the drawing. Default: none.
    pub number: String,
}

impl Default for SheetFile {
    fn default() -> Self {
        Self {
            paper: PaperFile::A3,
            orientation: None,
            angle: AngleFile::First,
            scale: None,
            unit: UnitFile::Metre,
            side: None,
            axonometric: AxonometricFile::Isometric,
            hidden: HiddenFile::Dashed,
            width: None,
            dimensions: true,
            title: String::new(),
            author: String::new(),
            date: String::new(),
            number: String::new(),
        }
    }
}

/// A size of paper.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Deserialize)]
#[serde(rename = "Paper")]
pub enum PaperFile {
    /// 841 × 1189 mm.
    A0,
    /// 594 × 841 mm.
    A1,
    /// 420 × 594 mm.
    A2,
    /// 297 × 420 mm.
    A3,
    /// 210 × 297 mm.
    A4,
    /// 148 × 210 mm.
    A5,
    /// 8½ × 11 inches.
    Letter,
    /// 11 × 17 inches.
    Tabloid,
}

/// How paper lies.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Deserialize)]
#[serde(rename = "Orientation")]
pub enum OrientationFile {
    /// Upright.
    Portrait,
    /// On its long side.
    Landscape,
}

/// Where views lie (ISO 5456-2).
#[derive(Clone, Copy, PartialEq, Eq, Debug, Deserialize)]
#[serde(rename = "Angle")]
pub enum AngleFile {
    /// The view from above lies below the front view.
    First,
    /// The view from above lies above the front view.
    Third,
}

/// What a unit of the models is.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Deserialize)]
#[serde(rename = "Unit")]
pub enum UnitFile {
    /// 1 m.
    Metre,
    /// 10 mm.
    Centimetre,
    /// 1 mm.
    Millimetre,
    /// 25.4 mm.
    Inch,
    /// 304.8 mm.
    Foot,
}

/// The view beside the front view.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Deserialize)]
#[serde(rename = "Side")]
pub enum SideFile {
    /// From the left.
    Left,
    /// From the right.
    Right,
}

/// The fourth view.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Deserialize)]
#[serde(rename = "Axonometric")]
pub enum AxonometricFile {
    /// There is none.
    None,
    /// All axes alike.
    Isometric,
    /// 7° and 42°.
    Dimetric,
    /// Each axis of its own.
    Trimetric,
    /// From the front, a little from the right and from above.
    ThreeQuarter,
}
