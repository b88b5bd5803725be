//! Cameras that never yield NaN: look-at with typed failure, named views and exact framing.
//!
//! ```text
//!              v  up in the picture
//!              │   ╱ view-up t
//!              │  ╱                          w = −g/‖g‖
//!              │ ╱                           u = (t × w)/‖t × w‖                   (CA-1)
//!  w ◄──────── eye ────────► gaze g          v = w × u
//!  backwards    ╲
//!                ╲                           world_to_view = rotation · translation (CA-2)
//!                 u  right
//! ```
//!
//! A [`Camera`] is an eye and an orientation ([`Basis`]) in world space. View space is right-handed
//! with the eye at the origin, x right, y up and the camera looking along −z. Any unit of length,
//! angles in radians. A camera knows no lens: projections are a matter of their own.
//!
//! ```
//! use camera::{Camera, NamedView, Slopes, frame_perspective};
//! use homog::{Point, Vector};
//!
//! // A camera by hand …
//! let camera = Camera::look_at(Point::new(4.0, 3.0, 6.0), Point::ORIGIN, Vector::Y)?;
//! let ahead = camera.world_to_view().transform_point(Point::ORIGIN);
//! assert!((ahead.z() + 61_f64.sqrt()).abs() < 1e-15);
//!
//! // … and one that finds its own place, with 5 per cent of the picture free on every side.
//! let tetrahedron = [[0.0, 0.0, 0.0], [1.0, 1.0, 0.0], [1.0, 0.0, 1.0], [0.0, 1.0, 1.0]];
//! let frame = Slopes::vertical_angle(35_f64.to_radians(), 16.0 / 9.0)?;
//! let view = NamedView::Isometric.basis();
//! let framing = frame_perspective(tetrahedron.map(Point::from), view, frame, 0.05)?;
//! assert!(framing.near > 0.0);
//! # Ok::<(), camera::FramingError>(())
//! ```
//!
//! | to say where a camera stands | take |
//! | --- | --- |
//! | eye and target, or eye and gaze | [`Camera::look_at`], [`Camera::look_to`] |
//! | the same if any view-up will do | [`Camera::look_at_or_fallback`] |
//! | front, top, isometric … by name | [`NamedView`] |
//! | so that all is in the picture | [`frame_perspective`], [`frame_parallel`], [`frame_oblique`] |
//! | round a target, or on a turntable | [`Orbit`] |
//! | yaw, pitch and roll | [`Orientation`] |
//! | a node of a scene | [`Camera::from_frame`] |
//! | by R and t, a pose or a quaternion, of OpenCV, OpenGL, COLMAP, PyTorch3D | [`Extrinsics`] |
//! | two eyes | [`StereoRig`], and [`apex_moved_view`] to see how not to |
//! | before a screen that stands in the world | [`ScreenCorners`] |
//!
//! # Conventions
//!
//! - Model and world: +y up, and things face +z, as in glTF. World and view space are right-handed.
//! - A [`ViewWindow`] is four numbers in view space and the distance of their plane; [`Slopes`] are
//!   those of the plane at distance 1. Give them to any projection.
//! - No constructor returns a camera with NaN in it. What cannot be done is a [`CameraError`] or a
//!   [`FramingError`] that names the values at fault and says what would do: a view-up along the
//!   gaze comes back with one that works.
//!
//! `cargo run -p alberti-camera --example photographer` shows the crate at work.
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
/// The types of points, maps and spaces, so that a program needs no second dependency.
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

/// The examples of the README, compiled and run as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
