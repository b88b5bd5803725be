//! Tests of the public interface of `raster`, linked once.

mod coverage;
mod drawing;
mod frames;
mod front;
mod many_triangles;
