//! Pictures of sRGB pixels with straight alpha and 8 or 16 bits per channel, and a PNG encoder.
//!
//! ```
//! use picture::Picture;
//!
//! let red = Picture { width: 2, height: 1, pixels: vec![[255_u8, 0, 0, 255]; 2] };
//! assert_eq!(red.pixel(1, 0), Some([255, 0, 0, 255]));
//! assert!(red.is_opaque() && red.to_png().starts_with(b"\x89PNG"));
//! ```
//!
//! | module | contents |
//! | --- | --- |
//! | `picture` | the picture, access to its pixels, and PNG output in memory or to a file |
//! | `channel` | bit depths, and compositing of drawings over pixels |
//! | `comparison` | the difference of two pictures, as numbers and as a picture |
//! | `hdr` | environment panoramas in Radiance format |
//! | `png_rows` | PNG as a stream, for pictures that do not fit in memory |
//! | `read_png` | reads a PNG file whose size is known |
//! | `terminal` | pictures as text: half blocks, ASCII art, and kitty's graphics protocol |

mod channel;
mod comparison;
mod hdr;
mod picture;
mod png_rows;
mod read_png;
pub mod terminal;

pub use channel::Channel;
pub use comparison::{PictureComparison, side_by_side};
pub use hdr::Panorama;
pub use picture::Picture;
pub use png_rows::{PngRows, encode_png};
pub use read_png::{ReadPngError, read_png};

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
