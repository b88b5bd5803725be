//! Support for text formats: encodings, lines and tokens, and decimal numbers.
//!
//! ```text
//!  bytes ──decode_text──► UTF-8 ──TextScanner──► lines, tokens ──parse_f32──► numbers
//!                                                     └─ LineCounter ──► line 12, column 5
//! ```

mod decimal;
mod encoding;
mod scanner;

pub(super) use decimal::{parse_f32, parse_f64, parse_integer};
pub(super) use encoding::decode_text;
pub(super) use scanner::{LineCounter, TextScanner, Token};
