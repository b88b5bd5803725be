//! Every planar projection, with checked parameters.
#![no_std]

mod apex_moved;
pub mod api;
mod axonometric;
pub mod chapter;
mod convention;
mod depth;
mod error;
mod fov;
mod frustum;
mod lens;
mod matrix;
mod multiview;
mod oblique_near;
mod orthographic;
mod perspective;
mod projector;
mod vanishing;
mod volume;
mod window;

pub use apex_moved::{ApexMovedFrustum, ApexMovedSteps};
pub use axonometric::{Axonometric, AxonometricKind};
pub use convention::{Convention, Handedness, NdcY};
pub use depth::{DepthCurve, DepthFormat, third_row};
pub use error::ProjectionError;
pub use fov::{Film, Fov, HalfSlopes, opening_angle_of};
pub use frustum::Frustum;
pub use lens::{FourAngles, Jitter, Tile};
pub use multiview::{PrincipalPlane, PrincipalView, SheetAngle};
pub use oblique_near::oblique_near_plane;
pub use orthographic::Orthographic;
pub use perspective::Perspective;
pub use projector::Projector;
pub use vanishing::{
    PointPerspective, PrincipalVanishingPoints, VanishingPoint, principal_vanishing_points,
    vanishing_point,
};
pub use volume::ViewVolume;
pub use window::Window;
