//! Tests of the public interface of `scene`, linked into one program.

mod dimensions;
mod lenses;
mod loading;
mod views;
