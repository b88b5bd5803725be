//! Homogeneous coordinates with typed spaces.
//!
//! A picture of a three-dimensional object is the result of a chain of maps. Each map has an input
//! space and an output space, and the compiler rejects a chain in which they do not match:
//!
//! ```text
//!  Model ─Affine─► World ─Affine─► View ─Projective─► Clip ─divide─► Ndc ─Affine─► Screen
//! ```
//!
//! | type | represents | under a translation |
//! | --- | --- | --- |
//! | [`Point`] | a position (x, y, z) | moves |
//! | [`Vector`] | a difference of positions | is unchanged |
//! | [`Normal`] | a direction perpendicular to a surface | is unchanged |
//! | [`HPoint`] | the position (x/w, y/w, z/w), or a direction if w = 0 | moves w times as far |
//! | [`Plane`], [`Ray`], [`Bounds`] | a x + b y + c z + d = 0; a half-line; a box | move |
//! | [`CoordinateFrame`] | an origin with three axes | moves |
//! | [`Affine`] | a map from points to points that preserves parallel lines | |
//! | [`Projective`] | a map from points to homogeneous points that preserves lines | |
//! | [`HPoint1`], [`HPoint2`], [`HLine2`], [`Homography`] | 1-D and 2-D counterparts | |
//!
//! ```
//! use homog::{Affine, Clip, Model, Point, Projective, Vector, View, World};
//!
//! let model_to_world = Affine::<Model, World>::rotation_y(90_f64.to_radians());
//! let world_to_view = Affine::<World, View>::translation(Vector::new(0.0, 0.0, -4.0));
//! // A lens: w becomes the distance in front of the eye, so the divide shrinks distant objects.
//! let view_to_clip = Projective::<View, Clip>::from_rows([
//!     [2.0, 0.0, 0.0, 0.0],
//!     [0.0, 2.0, 0.0, 0.0],
//!     [0.0, 0.0, 1.0, 2.0],
//!     [0.0, 0.0, -1.0, 0.0],
//! ]);
//! let model_to_clip = model_to_world.then(world_to_view).then_project(view_to_clip);
//!
//! // Not divided yet: clipping comes first.
//! let corner = model_to_clip.transform_point(Point::new(2.0, 1.0, 0.0));
//! assert_eq!(corner.w(), 6.0);
//! let seen = corner.divide().expect("6 in front of the eye");
//! assert!((seen.y() - 1.0 / 3.0).abs() < 1e-15);
//! ```
//!
//! The perspective divide is [`HPoint::divide`]. It returns an `Option`, so no division by zero
//! goes unnoticed. Coordinates that cannot be divided still have a meaning, which [`HPoint::kind`]
//! reports. For example, the point where railroad tracks meet is the image of a direction;
//! [`Projective::vanishing_point`] computes it.
//!
//! Mixing spaces does not compile:
//!
//! ```compile_fail
//! use homog::{Affine, Model, Point, View, World};
//! let world_to_view = Affine::<World, View>::IDENTITY;
//! let p = Point::<Model>::new(1.0, 2.0, 3.0);
//! let wrong = world_to_view.transform_point(p); // a model point instead of a world point
//! ```
//!
//! # Conventions
//!
//! - Points are columns, and matrices multiply them from the left: `v' = M v`. Chains are written
//!   with `then`, in the order in which a point passes through them. The names of [array
//!   constructors](Projective::from_rows) state whether they take rows or columns.
//! - Spaces are right-handed, angles are in radians, and numbers are f64. Sines and cosines come
//!   from `libm`, so results are bit-identical on every machine.
//! - Functions return `None` if there is no result, and an error that names the offending number if
//!   the input is invalid. Nothing panics, and finite input never gives NaN.
//! - Space tags cost nothing: a `Point<World>` is three numbers.
//!
//! # Features
//!
//! | feature | conversions to and from |
//! | --- | --- |
//! | none | arrays of `f64`, and of `f32` for vertex streams; bytemuck accepts both directly |
//! | `glam` | the glam version that this crate uses |
//! | `mint` | mint, and through it any version of glam, nalgebra, cgmath |
//! | `nalgebra` | nalgebra's points, vectors, matrices, `Isometry3`, `Perspective3` |
//! | `serde` | arrays of coordinates, and of matrix rows |
//!
//! Source: P. Shirley, S. Marschner and others, *Fundamentals of Computer Graphics*, chapter 8,
//! *Viewing*. Formula ids such as HO-2 refer to the project's list of formulas.
#![no_std]

mod affine;
mod arrays;
mod bounds;
mod classification;
mod clip_range;
mod coordinate_frame;
mod display;
mod elimination;
mod foreshortening;
mod homography;
mod hpoint;
mod hpoint1;
mod hpoint2;
mod hpoint_kind;
mod interop;
mod interpolate;
mod inversion;
mod matrix_display;
mod normal;
mod operators;
mod pixel_convention;
mod pixel_rect;
mod plane;
mod point;
mod projective;
mod ray;
mod remap;
mod space;
mod vector;

pub use affine::Affine;
pub use bounds::Bounds;
pub use classification::{Classification, KindReason, MapKind};
pub use clip_range::{ClipRange, ClipRangeError, NdcY};
pub use coordinate_frame::{CoordinateFrame, FrameError};
pub use foreshortening::{Foreshortening, SegmentCrossesEyePlane, perspective_weights};
pub use homography::Homography;
pub use hpoint::HPoint;
pub use hpoint_kind::HPointKind;
pub use hpoint1::HPoint1;
pub use hpoint2::{HLine2, HPoint2};
pub use interpolate::Interpolate;
pub use inversion::{Inversion, InversionError};
pub use matrix_display::MatrixDisplay;
pub use normal::Normal;
pub use pixel_convention::{PixelCenters, PixelConvention, YAxis};
pub use pixel_rect::PixelRect;
pub use plane::Plane;
pub use point::Point;
pub use projective::Projective;
pub use ray::{Ray, TriangleHit};
pub use remap::{RemapError, remap_interval};
pub use space::{Clip, Model, Ndc, Screen, Space, View, World};
pub use vector::Vector;

/// Runs the README examples.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
