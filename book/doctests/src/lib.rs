//! The Rust code of the book's pages as doctests: a module for each page, by its name.
//!
//! `cargo xtask test book` runs them. Formulas, figures and outputs are blocks in other languages, which rustdoc passes over.

#[cfg(doctest)]
mod book_pages {
    include!(concat!(env!("OUT_DIR"), "/pages.rs"));
}
