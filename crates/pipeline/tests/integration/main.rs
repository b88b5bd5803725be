//! Tests of the public interface of `pipeline`, linked once.

mod analytic;
mod chapter;
mod dimensions;
mod floor;
mod furnace;
mod ground;
mod lenses;
mod loading;
mod occlusion;
mod picture;
mod pixels;
mod point_shadows;
mod renderer;
mod shadows;
mod views;
