//! Writes output files completely or not at all, and prepares names and counts for messages.
//!
//! ```
//! use files::{visible_text, write_file};
//!
//! let path = std::env::temp_dir().join(format!("alberti-files-{}.txt", std::process::id()));
//! write_file(&path, b"whole")?;
//! assert_eq!(std::fs::read(&path).unwrap(), b"whole");
//! # std::fs::remove_file(&path).unwrap();
//! assert_eq!(visible_text("roof\u{1b}[2J"), "roof\\u{1b}[2J");
//! # Ok::<(), files::OutputError>(())
//! ```
//!
//! | module | subject |
//! | --- | --- |
//! | `atomic_file` | a temporary file next to its target, which it replaces when it is complete |
//! | `counted` | a count with the singular or plural of its noun |
//! | `partial_files` | temporary files: removed on signals, and if their process is dead |
//! | `visible_text` | characters that a terminal would obey, written as codes |

mod atomic_file;
mod counted;
mod partial_files;
mod visible_text;

pub use atomic_file::{AtomicFile, OutputError, write_file};
pub use counted::counted;
pub use partial_files::{
    create_partial_file, forget_partial_file, register_partial_file, remove_partial_files,
};
pub use visible_text::{is_terminal_control, visible_excerpt, visible_path, visible_text};

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
