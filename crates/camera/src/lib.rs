//! Cameras that never yield NaN: look-at with typed errors, named views and exact framing.
//!
//! ```text
//!              v  up in the picture
//!              │   ╱ view-up t
//!              │  ╱                          w = −g/‖g‖
//!              │ ╱                           u = (t × w)/‖t × w‖                   (CA-1)
//!  w ◄──────── eye ────────► gaze g          v = w × u
//!  backward     ╲
//!                ╲                           world_to_view = rotation · translation (CA-2)
//!                 u  right
//! ```
//!
//! A [`Camera`] is an eye and an orientation ([`Basis`]) in world space. View space is
//! right-handed, with the eye at the origin, x right, y up and the camera looking along −z. Lengths
//! are in any unit and angles in radians. A camera has no lens: projections are separate.
//!
//! ```
//! use camera::{Camera, NamedView, Slopes, frame_perspective};
//! use homog::{Point, Vector};
//!
//! // A camera placed by the user …
//! let camera = Camera::look_at(Point::new(4.0, 3.0, 6.0), Point::ORIGIN, Vector::Y)?;
//! let ahead = camera.world_to_view().transform_point(Point::ORIGIN);
//! assert!((ahead.z() + 61_f64.sqrt()).abs() < 1e-15);
//!
//! // … and one placed automatically, with 5% of the picture free on every side.
//! let tetrahedron = [[0.0, 0.0, 0.0], [1.0, 1.0, 0.0], [1.0, 0.0, 1.0], [0.0, 1.0, 1.0]];
//! let frame = Slopes::vertical_angle(35_f64.to_radians(), 16.0 / 9.0)?;
//! let view = NamedView::Isometric.basis();
//! let framing = frame_perspective(tetrahedron.map(Point::from), view, frame, 0.05)?;
//! assert!(framing.near > 0.0);
//! # Ok::<(), camera::FramingError>(())
//! ```
//!
//! | to specify a camera by | use |
//! | --- | --- |
//! | eye and target, or eye and gaze | [`Camera::look_at`], [`Camera::look_to`] |
//! | the same, accepting any view-up | [`Camera::look_at_or_fallback`] |
//! | a name: front, top, isometric and so on | [`NamedView`] |
//! | points to fit in the picture | [`frame_perspective`], [`frame_parallel`], [`frame_oblique`] |
//! | an orbit around a target, or a turntable | [`Orbit`] |
//! | yaw, pitch and roll | [`Orientation`] |
//! | a node of a scene | [`Camera::from_frame`] |
//! | R and t, a pose or a quaternion from OpenCV, OpenGL, COLMAP, PyTorch3D | [`Extrinsics`] |
//! | a stereo pair | [`StereoRig`], and [`apex_moved_view`] for a common mistake |
//! | an eye in front of a physical screen | [`ScreenCorners`] |
//!
//! # Conventions
//!
//! - Model and world: +y up, and models face +z, as in glTF. World and view space are right-handed.
//! - A [`ViewWindow`] is four numbers in view space and the distance of their plane; [`Slopes`] is
//!   the same window on the plane at distance 1. Pass them to any projection.
//! - No constructor returns a camera that contains NaN. Errors are a [`CameraError`] or a
//!   [`FramingError`] with the offending values and a remedy. For example, if the view-up is
//!   parallel to the gaze, the error suggests a view-up that works.
//!
//! `cargo run -p alberti-camera --example photographer` demonstrates the crate.
//!
//! Sources: P. Shirley, S. Marschner and others, *Fundamentals of Computer Graphics*, chapter 8,
//! *Viewing* (CA-1 to CA-3); R. Kooima, *Generalized Perspective Projection*, 2008, for screens.
#![no_std]

mod basis;
mod camera;
mod error;
mod exact_cross;
mod extrinsics;
mod framing;
mod named_view;
mod orbit;
mod orientation;
mod parallel_framing;
mod point_coordinates;
mod screen_corners;
mod stereo;
mod view_projection;
mod view_transform;
mod window;

pub use basis::Basis;
pub use camera::Camera;
pub use error::{CameraError, FramingError};
pub use extrinsics::{CameraAxes, Extrinsics};
pub use framing::{Framing, FramingConstraint, Slopes, frame_perspective};
/// The types of points, maps and spaces, re-exported so that users need no second dependency.
pub use homog;
pub use named_view::{NamedView, UnknownView};
pub use orbit::Orbit;
pub use orientation::Orientation;
pub use parallel_framing::{ParallelFraming, frame_oblique, frame_parallel};
pub use screen_corners::ScreenCorners;
pub use stereo::{CameraView, StereoPair, StereoRig, apex_moved_view};
pub use view_projection::ViewProjection;

pub use view_transform::ViewTransform;
pub use window::ViewWindow;

/// Runs the README examples as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
