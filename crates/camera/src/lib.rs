//! Cameras that never yield NaN: look-at with typed failure, named views and exact framing.
//!
//! ```text
//!      v  up in the picture                      ● target
//!      │                                    ╱
//!      │                        gaze g ╱                 w = −g/‖g‖
//!      │                          ╱                      u = (t × w)/‖t × w‖     (CA-1)
//!     eye ───── u  right     ╱                           v = w × u
//!    ╱
//!   w  backwards                              world_to_view = rotation · translation   (CA-2)
//! ```
//!
//! A [`Camera`] is an eye and an orientation ([`Basis`]) in world space. View space is right-handed with the eye at the
//! origin, x right, y up and the camera looking along −z. Any unit of length, angles in radians. A camera knows no
//! lens: projections are a matter of their own.
//!
//! ```
//! use camera::{Camera, NamedView, Slopes, frame_perspective};
//! use homog::{Point, Vector};
//!
//! // A camera by hand …
//! let camera = Camera::look_at(Point::new(4.0, 3.0, 6.0), Point::ORIGIN, Vector::Y)?;
//! let ahead = camera.world_to_view().point(Point::ORIGIN);
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
#![no_std]

mod attitude;
mod basis;
mod error;
mod exact;
mod framing;
mod named;
mod orbit;
mod parallel;
mod points;
mod pose;
mod rays;
mod screen;
mod stereo;
mod window;

pub use attitude::Attitude;
pub use basis::Basis;
pub use error::{CameraError, FramingError};
pub use framing::{Fit, Framing, Slopes, frame_perspective};
pub use named::{NamedView, UnknownView};
pub use orbit::Orbit;
pub use parallel::{ParallelFraming, frame_oblique, frame_parallel};
pub use pose::Camera;
pub use rays::{PixelCenters, PixelGrid, Ray, Rays, VerticalAxis};
pub use screen::ScreenCorners;
pub use stereo::{CameraView, StereoPair, StereoRig, apex_moved};
pub use window::Window;
