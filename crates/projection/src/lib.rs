//! Every planar projection of the textbooks and graphics APIs, with checked parameters.
//!
//! ```text
//!                window on the near plane
//!                 ┌─────┐╲                                     y
//!        y        │ r,t │  ╲                              +1 ┌───┼───┐
//!        │    ╱   │     │    ╲ far       view_to_clip        │   │   │   near z = +1
//!   eye  ●────────┼─────┼─────► gaze   ───────────────►    ──┼───┼───┼── x
//!       ╱ ╲   ╲   │     │    ╱         divide by w           │   │   │   far  z = −1
//!      z    x     │ l,b │  ╱                              −1 └───┼───┘
//!                 └─────┘╱                                  −1      +1
//! ```
//!
//! Describe a projection once, with familiar parameters, and it is checked once. Every builder
//! returns a `Result` whose error names the parameter, its value and the allowed range. The result
//! can be written as a matrix in any [`Convention`], has a closed-form inverse, and never contains
//! NaN or infinities.
//!
//! ```
//! use homog::Point;
//! use projection::{Convention, Fov, Perspective};
//!
//! let lens = Perspective::new(Fov::vertical_degrees(90.0), 16.0 / 9.0, 0.5, 100.0)?;
//! let view_to_clip = lens.view_to_clip(Convention::CHAPTER);
//!
//! // At twice the distance, the image is half as large.
//! let image = |z: f64| view_to_clip.transform_point(Point::new(0.0, 1.0, z));
//! let height = |z: f64| image(z).divide().map(Point::y);
//! let (near, far) = (height(-2.0).expect("in front"), height(-4.0).expect("in front"));
//! assert!((near - 0.5).abs() < 1e-15 && (far - 0.25).abs() < 1e-15);
//!
//! let wrong = Perspective::new(Fov::Vertical(45.0), 16.0 / 9.0, 0.5, 100.0);
//! assert_eq!(
//!     wrong.expect_err("45 radians").to_string(),
//!     "`vertical field of view` is 45; it must be between 0 and π radians, exclusive",
//! );
//! # Ok::<(), projection::ProjectionError>(())
//! ```
//!
//! | to get | use |
//! | --- | --- |
//! | a camera's perspective, by angle or focal length | [`Perspective`], [`Fov`] |
//! | an off-center perspective: stereo, walls, headsets | [`Frustum`], [`FourAngles`] |
//! | a box without foreshortening | [`Orthographic`] |
//! | part of a picture | `view_offset` on the three above, with a [`ViewOffset`] |
//! | lens shift, antialiasing | `shifted`, `jittered` on the same three, with a [`Jitter`] |
//! | a calibrated camera, by its matrix K | [`Intrinsics`] |
//! | a mirror's or portal's near plane | [`oblique_near_plane`] |
//! | front, top and side views | [`PrincipalView`] |
//! | isometric, dimetric, trimetric | [`Axonometric`] |
//! | cavalier, cabinet; military | [`Oblique`]; [`Planometric`] |
//! | one-, two-, three-point perspective | [`NPoint`], [`ConstructedPerspective`] |
//! | a classical projection as a renderable matrix | [`Classical`] |
//! | any center and any plane | [`Projector`] |
//! | P, M_orth, M_per of the textbook (Shirley and Marschner, ch. 8) | [`chapter`] |
//! | glFrustum, gluPerspective, D3DX functions by name | [`api`] |
//! | the lesson's createFrustum | [`ApexMovedFrustum`] |
//! | the points where parallel lines meet | [`vanishing_point`], [`principal_vanishing_points`] |
//! | the resolution of a depth buffer | [`DepthCurve`] |
//! | corners, planes and eye of the view volume | [`ViewVolume`] |
//! | the parameters of a matrix in a known convention | [`decompose()`], [`readings`] |
//! | the classification tree | [`ProjectionClass`] |
//!
//! View space is right-handed unless the convention specifies otherwise: x right, y up, looking
//! along −z. Vectors are columns, angles are in radians, and numbers are f64. The example `gallery`
//! draws a house in every projection. For matrices in unknown conventions, use the `recognition`
//! crate.
#![no_std]

extern crate alloc;

pub mod api;
pub mod chapter;

mod apex_moved;
mod axonometric;
mod classical;
mod construction;
mod convention;
mod decompose;
mod depth_curve;
mod error;
mod fov;
mod frustum;
mod intrinsics;
mod matrix;
mod multiview;
mod normalize;
mod npoint;
mod oblique;
mod oblique_near;
mod orthographic;
mod perspective;
mod placement;
mod projection_class;
mod projector;
mod vanishing;
mod view_volume;
mod window;
mod window_changes;

pub use apex_moved::{ApexMovedFrustum, ApexMovedSteps};
pub use axonometric::{Axonometric, AxonometricKind};
pub use classical::Classical;
pub use construction::ConstructedPerspective;
pub use convention::{Convention, Handedness};
pub use decompose::{DecomposeError, Decomposed, Decomposition, decompose, readings};
pub use depth_curve::{DepthCurve, DepthFormat, third_row};
pub use error::ProjectionError;
pub use fov::{Fov, HalfSlopes, SensorSize, opening_angle_of};
pub use frustum::Frustum;
/// The types of points, maps and spaces, re-exported so that users need no second dependency.
pub use homog;
pub use intrinsics::Intrinsics;
pub use multiview::{PrincipalPlane, PrincipalView, SheetAngle};
pub use normalize::{FrustumFactors, ParallelFactors};
pub use npoint::NPoint;
pub use oblique::{Oblique, ObliqueKind, Planometric};
pub use oblique_near::oblique_near_plane;
pub use orthographic::Orthographic;
pub use perspective::Perspective;
pub use projection_class::ProjectionClass;
pub use projector::Projector;
pub use vanishing::{
    PointPerspective, PrincipalVanishingPoints, VanishingPoint, principal_vanishing_points,
    vanishing_point,
};
pub use view_volume::ViewVolume;
pub use window::Window;
pub use window_changes::{FourAngles, Jitter, ViewOffset};

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
