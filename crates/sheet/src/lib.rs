//! Drawing sheets of models: orthographic views to scale, with dimensions and a title block, and
//! assemblies with parts lists.
//!
//! ```text
//!   models ─► views ─► layout on the paper ─► dimensions, marks ─► pages
//! ```
//!
//!  module | technique |
//!  --- | --- |
//!  `sheet` | first-angle or third-angle views, title block, dimensions |
//!  `warning` | warnings about content missing from a sheet |
//!  `assembly` | parts grouped by content, masses by the divergence theorem, exploded views |

mod assembly;
mod sheet;
mod warning;

pub use assembly::{
    AssemblyPages, ExplosionAxis, ExplosionSettings, PartDensity, PartPlace, PartsList,
    PartsListItem, explode_models,
};
pub use sheet::{
    DecimalMark, Dimension, DimensionSide, DimensionUnit, LengthDirection, Measure, NumberFormat,
    ScaleLimit, Sheet, SheetError, SheetFill, SheetFrame, TemplateError, TitleBlockLanguage,
    TitleBlockTemplate, TitleBlockText, ViewPlace, ViewRequest, ViewSide,
};
pub use warning::{AssemblyWarning, DimensionFault, SheetLabelFault, SheetWarning};

/// A page of a sheet with its warnings.
pub type SheetPage = page::Page<SheetWarning>;

/// The README example, compiled as a documentation test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
