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
//! | module | contents |
//! | --- | --- |
//! | `atomic_file` | temporary files that replace their targets when complete |
//! | `counted` | counts with singular or plural nouns |
//! | `partial_files` | removal of temporary files, on signals and after their process has died |
//! | `visible_text` | names in which terminal control characters are written as codes |

mod atomic_file;
mod counted;
mod partial_files;
mod visible_text;

pub use atomic_file::{AtomicFile, OutputError, write_file};
pub use counted::{counted, listed};
pub use partial_files::{
    create_partial_file, forget_partial_file, register_partial_file, remove_partial_files,
};
pub use visible_text::{is_terminal_control, visible_excerpt, visible_path, visible_text};

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
