//! Recognition of matrices: the projection, camera, viewport or transform that sixteen or nine
//! numbers represent, its parameters, and any known misprint that explains the numbers better.
//!
//! ```text
//!   entries ─► precision ─► every reader ─► readings with a cost ─► sorted ─► suspicions
//!              (decimals,    (one file        2 per digit of a                (misprints that
//!               f32, f64)     each)           parameter, plus a                explain the entries
//!                                             penalty for rare matrices         better)
//! ```
//!
//! A matrix's numbers do not determine its meaning: the OpenGL matrix of (N, F) is the
//! zero-to-one matrix of (2FN/(F+N), F). However, people choose numbers with few digits, windows
//! with left < right and bottom < top, and 0 < near < far. The reading that needs the fewest digits
//! is therefore listed first, and common conventions precede rare conventions (minimum description
//! length, Rissanen 1978). A matrix is reported as a misprint only if it has no such reading, or if
//! its reading as a misprint needs clearly fewer digits.
//!
//! ```
//! use projection::{Convention, Fov, Perspective};
//! use recognition::{MatrixMeaning, recognize};
//!
//! let lens = Perspective::new(Fov::vertical_degrees(60.0), 1.5, 0.1, 100.0)?;
//! let matrix = lens.view_to_clip(Convention::VULKAN);
//! let meaning = recognize(matrix.rows()).first().meaning;
//! let MatrixMeaning::Perspective { lens, convention, .. } = meaning else {
//!     panic!("not a perspective projection")
//! };
//! assert_eq!((lens.fov_y_degrees, convention), (60.0, Convention::VULKAN));
//!
//! // The transpose is the matrix for row vectors.
//! let slip = recognize(homog::Projective::<homog::View, homog::Clip>::from_row_major(matrix.to_column_major()).rows()).misprint().map(|found| found.misprint);
//! assert_eq!(slip, Some(recognition::Misprint::Transposed));
//! # Ok::<(), projection::ProjectionError>(())
//! ```
//!
//! | result | function |
//! | --- | --- |
//! | the meaning of a 4×4 matrix, or its misprint | [`recognize`] |
//! | the meaning of a 3×3 matrix | [`recognize_planar`] |
//! | the error in a matrix for a known projection | [`misprint_of`] |
//! | a matrix's numbers, from text or source code | [`parse_matrix`] |
//! | a matrix as source code or LaTeX | [`CodeLanguage::format_matrix`] |
//! | the parameters of a matrix in a known convention | [`projection::decompose()`] |
//!
//! All matrices are for column vectors, in f64. The example `doctor` identifies a given matrix.
#![no_std]

extern crate alloc;

mod affine;
mod classical;
mod convention_list;
mod matrix_code;
mod matrix_reading;
mod matrix_text;
mod meaning;
mod misprint;
mod one_step;
mod parallel;
mod perspective;
mod pixels;
mod placed;
mod planar;
mod rigid;
mod rounded;
mod suspicion;
mod viewport;

pub use matrix_code::CodeLanguage;
pub use matrix_reading::{MatrixReading, Recognition, recognize};
pub use matrix_text::{GivenMatrix, MatrixTextError, ParsedMatrix, parse_matrix, parse_number};
pub use meaning::{Lens, MatrixMeaning};
pub use misprint::{IntendedProjection, Misprint, misprint_of};
pub use planar::{PlanarMatrix, PlanarReading, recognize_planar};
pub use rigid::{CameraReading, ViewAxes};
pub use suspicion::{Suspicion, SuspicionStrength};
pub use viewport::{IntrinsicsReading, ViewportReading};

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
