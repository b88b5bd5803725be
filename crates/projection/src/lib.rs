//! Every planar projection, with checked parameters.
#![no_std]

mod convention;
mod error;
mod fov;
mod frustum;
mod matrix;
mod orthographic;
mod perspective;
mod window;

pub use convention::{Convention, Handedness, NdcY};
pub use error::ProjectionError;
pub use fov::{Film, Fov, HalfSlopes, opening_angle_of};
pub use frustum::Frustum;
pub use orthographic::Orthographic;
pub use perspective::Perspective;
pub use window::Window;
