//! Homogeneous coordinates with typed spaces.
//!
//! A [`Point`] is a place, a [`Vector`] a difference of places, a [`Normal`] a direction perpendicular to a surface, an
//! [`HPoint`] four numbers that stand for a place or a direction up to a factor. Each belongs to one of six
//! [spaces](Space), and the maps between them, [`Affine`] and [`Projective`], know both ends:
//!
//! ```text
//!  Model ──Affine──► World ──Affine──► View ──Projective──► Clip ──divide──► Ndc ──Affine──► Screen
//! ```
//!
//! ```
//! use homog::{Affine, Clip, Model, Point, Projective, Vector, View, World};
//! # let view_to_clip = Projective::<View, Clip>::from_raw(glam::DMat4::IDENTITY);
//! let model_to_world = Affine::<Model, World>::rotation_y(0.5);
//! let world_to_view = Affine::<World, View>::translation(Vector::new(0.0, 0.0, -5.0));
//! let model_to_clip = model_to_world.then(world_to_view).then_project(view_to_clip);
//! let corner = model_to_clip.point(Point::new(1.0, 1.0, 1.0)); // an HPoint<Clip>, not divided yet
//! # let _ = corner.divide();
//! ```
//!
//! Column vectors throughout, angles in radians, f64. Mixing spaces does not compile:
//!
//! ```compile_fail
//! use homog::{Affine, Model, Point, View, World};
//! let world_to_view = Affine::<World, View>::IDENTITY;
//! let p = Point::<Model>::new(1.0, 2.0, 3.0);
//! let wrong = world_to_view.point(p); // a model point where a world point is due
//! ```
#![no_std]

mod affine;
mod bounds;
mod display;
mod hpoint;
mod normal;
mod plane;
mod point;
mod projective;
mod space;
mod vector;

pub use affine::Affine;
pub use bounds::Bounds;
pub use hpoint::HPoint;
pub use normal::Normal;
pub use plane::Plane;
pub use point::Point;
pub use projective::Projective;
pub use space::{Clip, Model, Ndc, Screen, Space, View, World};
pub use vector::Vector;
