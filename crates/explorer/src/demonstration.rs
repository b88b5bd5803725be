//! Demonstrations of the viewing pipeline for lessons, computed by the stages of the pipeline.
//!
//! | subject | start with |
//! | --- | --- |
//! | one subject in every projection of the textbooks | [`projection_panels`] |
//! | one camera or lens parameter, varied in steps | [`Sweep`] |
//! | depth and depth resolution against distance (C48, C68) | [`DepthTable`] |
//! | wrap-around at w = 0: why clipping comes before the divide (C36) | [`wraparound_panels`] |
//!
//! Each returns [`Panels`](drawing::Panels) or a [`Page`](drawing::Page), which can be written as
//! SVG, PDF or PNG. Panels can also be written as an HTML page. The number of threads does not
//! change the results.

mod depth_chart;
mod depth_table;
mod number_format;
mod projection_family;
mod sweep;
#[cfg(test)]
mod test_scene;
mod wraparound;

pub use depth_table::{DepthRow, DepthTable};
pub use projection_family::{NamedProjection, projection_panels};
pub use sweep::{Sweep, SweepParameter};
pub use wraparound::wraparound_panels;

use pipeline::render::RenderError;
use scene::ResolveError;

/// The reason why a demonstration cannot be computed.
///
/// Each variant contains the error from the stage that failed, or the parameter and the reason, so
/// that the message can suggest a remedy.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum DemonstrationError {
    /// The scene cannot be resolved with this projection.
    #[error(transparent)]
    Resolve(#[from] ResolveError),
    /// A panel cannot be drawn.
    #[error(transparent)]
    Render(#[from] RenderError),
    /// A camera is invalid.
    #[error(transparent)]
    Camera(#[from] camera::CameraError),
    /// A projection is invalid.
    #[error(transparent)]
    Projection(#[from] projection::ProjectionError),
    /// The scene's projection does not have this parameter.
    #[error("`{vary}` cannot be varied: {reason}")]
    UnsupportedParameter {
        /// The parameter.
        vary: SweepParameter,
        /// The reason and the remedy.
        reason: String,
    },
    /// A value is outside the parameter's range.
    #[error("`{vary}` cannot be {value}: {reason}")]
    InvalidValue {
        /// The parameter.
        vary: SweepParameter,
        /// The value.
        value: String,
        /// The range.
        reason: String,
    },
}
