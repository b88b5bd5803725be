//! Demonstrations: what lessons show of the viewing pipeline, computed by its stages.
//!
//! | what | begin with |
//! | --- | --- |
//! | one subject in every projection of the textbooks | [`compared`] |
//! | one parameter of camera or lens, step by step | [`Sweep`] |
//! | how distance becomes depth, and how finely (C48, C68) | [`DepthTable`] |
//! | why clipping comes before the divide (C36) | [`tear`] |
//!
//! Each gives [`Panels`](drawing::Panels) or a [`Page`](drawing::Page), to be written as SVG, PDF or PNG; panels go
//! into a web page as well. None depends on the number of threads.

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

use crate::render::RenderError;
use crate::scene::ResolveError;

/// Why there is no demonstration.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum DemonstrationError {
    /// The scene makes no sense with a projection.
    #[error(transparent)]
    Resolve(#[from] ResolveError),
    /// A panel cannot be drawn.
    #[error(transparent)]
    Render(#[from] RenderError),
    /// A camera cannot be had.
    #[error(transparent)]
    Camera(#[from] camera::CameraError),
    /// A projection cannot be had.
    #[error(transparent)]
    Projection(#[from] projection::ProjectionError),
    /// The parameter is none of this scene's projection.
    #[error("`{vary}` cannot be varied: {reason}")]
    UnsupportedParameter {
        /// The parameter.
        vary: SweepParameter,
        /// Why not, and what to do.
        reason: String,
    },
    /// A value makes no sense.
    #[error("`{vary}` cannot be {value}: {reason}")]
    InvalidValue {
        /// The parameter.
        vary: SweepParameter,
        /// Its value.
        value: String,
        /// Why not.
        reason: String,
    },
}
