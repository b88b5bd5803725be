//! Every planar projection, with checked parameters.
#![no_std]

pub mod api;
pub mod chapter;

mod apex_moved;
mod axonometric;
mod classical;
mod construction;
mod convention;
mod decompose;
mod depth;
mod doctor;
mod error;
mod fov;
mod frustum;
mod lens;
mod matrix;
mod multiview;
mod normalise;
mod npoint;
mod oblique;
mod oblique_near;
mod orthographic;
mod perspective;
mod placed;
mod projector;
mod tree;
mod vanishing;
mod volume;
mod window;

pub use apex_moved::{ApexMovedFrustum, ApexMovedSteps};
pub use axonometric::{Axonometric, AxonometricKind};
pub use classical::Classical;
pub use construction::ConstructedPerspective;
pub use convention::{Convention, Handedness, NdcY};
pub use decompose::{DecomposeError, Decomposed, Decomposition, decompose, readings};
pub use depth::{DepthCurve, DepthFormat, third_row};
pub use doctor::{Misprint, Symptom, Wanted, misprint_of, symptoms};
pub use error::ProjectionError;
pub use fov::{Film, Fov, HalfSlopes, opening_angle_of};
pub use frustum::Frustum;
pub use lens::{FourAngles, Jitter, Tile};
pub use multiview::{PrincipalPlane, PrincipalView, SheetAngle};
pub use normalise::{FrustumFactors, ParallelFactors};
pub use npoint::NPoint;
pub use oblique::{Oblique, ObliqueKind, Planometric};
pub use oblique_near::oblique_near_plane;
pub use orthographic::Orthographic;
pub use perspective::Perspective;
pub use projector::Projector;
pub use tree::ProjectionClass;
pub use vanishing::{
    PointPerspective, PrincipalVanishingPoints, VanishingPoint, principal_vanishing_points,
    vanishing_point,
};
pub use volume::ViewVolume;
pub use window::Window;
