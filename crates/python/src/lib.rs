//! The extension module of the Python package `alberti`: the part that calls the Rust crates.
//! Signatures, documentation and types are in the Python sources, which pass their keyword
//! arguments as dictionaries. Every function here validates them and reports an invalid argument by
//! name.
//! | topic | file |
//! | --- | --- |
//! | models and scenes, from files and from memory | `loading.rs`, `subject.rs` |
//! | cameras, points and pixels | `camera_options.rs`, `native_camera.rs`, `pixel_rays.rs` |
//! | contents and poses of models | `model_contents.rs` |
//! | meshes as arrays | `mesh_arrays.rs`, `mesh_colors.rs`, `mesh_material.rs` |
//! | pictures and passes | `scene_options.rs`, `rendering.rs` |
//! | MuJoCo's light | `legacy_lights.rs`, `phong_display.rs` |
//! | line drawings; explanations | `drawing_result.rs`; `explanation.rs` |
//! | arguments: dictionaries, arrays | `keywords.rs`, `arrays.rs` |
//! | threads, Ctrl+C, panics; exceptions | `detached.rs`, `failure.rs` |

mod arrays;
mod camera_options;
mod detached;
mod drawing_result;
mod explanation;
mod failure;
mod keywords;
mod legacy_lights;
mod loading;
mod mesh_arrays;
mod mesh_colors;
mod mesh_material;
mod model_contents;
mod native_camera;
mod phong_display;
mod pixel_rays;
mod rendering;
mod scene_options;
mod subject;

use pyo3::prelude::*;

/// Runs the program `alberti` with these arguments, the first of which is its name, and returns its
/// exit code. `program` is the command that restarts it.
#[pyfunction]
fn run_program(
    py: Python<'_>,
    program: Vec<std::ffi::OsString>,
    arguments: Vec<std::ffi::OsString>,
) -> u8 {
    py.detach(|| alberti::run_within(program, arguments))
}

/// Registers the functions and classes for the Python sources.
#[pymodule]
mod _native {
    use pyo3::prelude::*;

    /// Adds the version of the package.
    #[pymodule_init]
    fn init(module: &Bound<'_, PyModule>) -> PyResult<()> {
        module.add("__version__", env!("CARGO_PKG_VERSION"))
    }

    #[pymodule_export]
    use super::drawing_result::{NativeDrawing, draw};
    #[pymodule_export]
    use super::explanation::explain;
    #[pymodule_export]
    use super::loading::{compose, compose_array, load_model, load_scene, move_models};
    #[pymodule_export]
    use super::mesh_arrays::build_model;
    #[pymodule_export]
    use super::model_contents::{animations, mesh_arrays, pose, variants};
    #[pymodule_export]
    use super::native_camera::{NativeCamera, camera_from_ron, make_camera};
    #[pymodule_export]
    use super::phong_display::show_linear;
    #[pymodule_export]
    use super::rendering::{encode_gray_png, encode_png, over_white, render, render_many};
    #[pymodule_export]
    use super::run_program;
    #[pymodule_export]
    use super::subject::Subject;
}
