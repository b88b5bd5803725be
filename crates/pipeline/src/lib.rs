//! The viewing pipeline from a glTF model to a picture.
//!
//! A picture takes three steps: a description, read from a scene file or with every default; a scene, in which models are loaded and
//! everything is decided; and the picture.
//!
//! ```no_run
//! use pipeline::{Origin, Scene, render};
//! let (origin, mut file) = Origin::bare_model("model.glb".as_ref()); // or Origin::read("scene.ron".as_ref())?
//! file.image.size = (256, 256);
//! let scene = Scene::resolve(&origin, &file, &Default::default())?;
//! let picture = render(&scene, 2)?; // two threads; their number does not change a bit of it
//! let middle: Option<[u8; 4]> = picture.pixel(128, 128); // sRGB, straight alpha
//! picture.write_png("thumb.png".as_ref())?;
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! | what is wanted | begin with | an example |
//! | --- | --- | --- |
//! | a picture in memory, or a PNG | [`render()`] | `examples/thumbnail.rs` |
//! | a line drawing as SVG, PDF or PNG | [`draw`], then [`drawing::Page::to_svg`] | `examples/isometric.rs` |
//! | many pictures of one scene | [`film::Film`] | `examples/turntable.rs` |
//! | depths, normals, names of each pixel | [`mod@render::passes`] | `examples/depth_map.rs` |
//! | picture after picture without allocation | [`Renderer`] | its documentation |
//! | every step of a point, a triangle, a pixel | [`explain`] | `examples/explain.rs` |
//! | what lessons show: projections, sweeps, depth curves | [`demonstration`] | its documentation |
//! | models from memory | [`import::load_bytes`], [`Scene::of_models`] | |
//! | what a scene file may say | [`scene::reference`] | |
//!
//! A picture that nobody waits for any more is stopped by a [`Cancel`]; a film stops when whoever takes its pictures returns an error.
//!
//! Nothing here prints, and nothing is global: scenes, renderers and pictures can go to any thread and live side by side. What is
//! wrong is a typed error that says what, where and what to do.

mod cancel;
pub mod demonstration;
pub mod explain;
pub mod render;
pub mod scene;
pub mod sequence;

pub use cancel::CancelToken;
pub use drawing;
pub use homog::PixelRect;
pub use model::{self, Timings, import};
pub use render::{
    BandedRenderer, MAX_IMAGE_SIDE, RenderError, Renderer, Textures, WritePngError, draw_lines,
    render, render_reported, render_timed,
};
pub use scene::options;
pub use scene::{Origin, ResolveError, Scene, SceneError, SceneErrors, SceneFile};
pub use shade::{self, AtomicFile, Channel, OutputError, Picture, PngRows, encode_png, write_file};

#[cfg(test)]
mod tests {
    /// That this compiles is the test.
    #[test]
    fn everything_can_go_to_another_thread() {
        fn assert_send_sync<T: Send + Sync + 'static>() {}
        assert_send_sync::<(
            crate::Origin,
            crate::SceneFile,
            crate::Scene,
            shade::Picture,
            model::Timings,
        )>();
        assert_send_sync::<(crate::Renderer, crate::sequence::Sequence, crate::explain::Explanation)>(
        );
        assert_send_sync::<(drawing::Page, drawing::LineDrawing, drawing::Sheet)>();
        assert_send_sync::<(
            crate::SceneError,
            crate::ResolveError,
            crate::RenderError,
            shade::OutputError,
        )>();
        assert_send_sync::<(model::import::ImportError, model::import::ImportOptions)>();
    }
}
