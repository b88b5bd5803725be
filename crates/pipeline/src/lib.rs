//! The viewing pipeline from a glTF model to a picture.

mod canvas;
mod color;
pub mod drawing;
pub mod explain;
pub mod film;
pub mod import;
pub mod model;
mod output;
mod picture;
pub mod render;
pub mod scene;
pub mod shade;
mod timings;

pub use output::{Draft, OutputError, PngRows, encode_png, write_file};
pub use picture::{Channel, Picture};
pub use render::{
    MAX_SIDE, Paint, PaintError, Region, RenderError, Renderer, Textures, draw, render,
    render_timed,
};
pub use scene::{Origin, ResolveError, Scene, SceneError, SceneFile};
pub use timings::Timings;
