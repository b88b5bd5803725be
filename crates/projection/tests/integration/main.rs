//! Tests of the public interface of `projection`, linked once.

mod items;
mod laws;
