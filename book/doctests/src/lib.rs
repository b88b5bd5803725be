//! The Rust code of the book's pages as doctests, with one module per page.
//!
//! `cargo xtask test book` runs them. `build.rs` generates the modules.

#[cfg(doctest)]
mod book_pages {
    include!(concat!(env!("OUT_DIR"), "/pages.rs"));
}
