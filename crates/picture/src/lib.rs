//! Pictures: sRGB pixels with straight alpha, 8 or 16 bits per channel, and a PNG encoder.
//!
//! ```
//! use picture::Picture;
//!
//! let red = Picture { width: 2, height: 1, pixels: vec![[255_u8, 0, 0, 255]; 2] };
//! assert_eq!(red.pixel(1, 0), Some([255, 0, 0, 255]));
//! assert!(red.is_opaque() && red.to_png().starts_with(b"\x89PNG"));
//! ```
//!
//! | module | subject |
//! | --- | --- |
//! | `picture` | the picture, its pixels by position, PNG in memory and in a file |
//! | `channel` | the bit depths, and drawings composited over pixels |
//! | `hdr` | panoramas in Radiance format, for environments |
//! | `png_rows` | PNG as a stream, for pictures larger than memory |

mod channel;
mod hdr;
mod picture;
mod png_rows;

pub use channel::Channel;
pub use hdr::Panorama;
pub use picture::Picture;
pub use png_rows::{PngRows, encode_png};

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
