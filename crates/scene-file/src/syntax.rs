//! Reads scene file syntax: splits RON text into tokens, and parses them into a tree in which every
//! node records its byte range.
//!
//! ```text
//!  text ─► tokens ─► tree of nodes ─► checked against the declarations of `scene_file::file`
//!             └────► groups of items with comments ─► formatted text
//! ```
//! The parser does not stop at an error: it reports the error, resynchronizes at the next comma or
//! bracket, and continues.

mod literal;
mod parser;
mod tokens;
mod tree;

pub(super) use literal::{parse_integer, parse_number, unescape_string};
pub(super) use parser::{SAMPLE_SCENE, SyntaxTree, parse_tree};
pub(super) use tokens::{Token, TokenKind, tokenize};
pub use tree::PathStep;
pub(super) use tree::{Group, Key, Node, NodeKind, SyntaxItem};
