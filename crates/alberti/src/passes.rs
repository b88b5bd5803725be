//! Render passes: their flags and output files.
//!
//! A pass holds data for compositing, masks or machine learning. With `--passes depth,normal`, the
//! files `fox.depth.png` and `fox.normal.png` are written next to `fox.png`.

use super::CliError;
use super::options::option_parser;
use pipeline::render::passes::PassBuffer;
use pipeline::{AtomicFile, OutputError};
use scene_file::file::SceneFile;
use scene_file::{Pass, PassEncoding};
use std::io::Write;
use std::path::{Path, PathBuf};

/// The render passes to write, and their format.
#[derive(Clone, Debug, clap::Args)]
pub(crate) struct PassArgs {
    /// Render passes to write next to the picture, as NAME.PASS.png (or .npy, .exr)
    ///
    /// Each holds one property of the nearest surface at the center of each pixel. The depth (along
    /// the view axis) and the distance from the eye are in scene units. The normal and the position
    /// are in world space, the view-normal in view space. The others are uv, barycentric
    /// coordinates, and the ids of the triangle, model, object (mesh instance), node, mesh and
    /// material, counted from 1 through the whole scene; 0 is the background. In addition, overdraw
    /// counts the fragments of the pixel, and coverage is the fraction of its samples covered.
    #[arg(help_heading = "Output", long, value_name = "PASS,…", value_delimiter = ',', value_parser = option_parser::<Pass>())]
    passes: Vec<Pass>,
    /// File format of the passes
    #[arg(
        help_heading = "Output",
        long,
        value_name = "FORMAT",
        value_parser = option_parser::<PassEncoding>(),
        requires = "passes"
    )]
    pass_format: Option<PassEncoding>,
}

impl PassArgs {
    /// Replaces the passes of the scene with those from the flags.
    ///
    /// `--passes` replaces the scene's list, so that one pass can be written without the others.
    pub(crate) fn apply_to(&self, file: &mut SceneFile) {
        if !self.passes.is_empty() {
            file.passes.write.clone_from(&self.passes);
        }
        if let Some(encoding) = self.pass_format {
            file.passes.encoding = encoding;
        }
    }
}

/// Writes passes to temporary files next to a picture; the caller renames the complete files.
///
/// # Errors
/// Returns an error if a file cannot be written; the files created so far are then removed.
pub(super) fn create_pass_files(
    output: &Path,
    buffers: &[PassBuffer],
    encoding: PassEncoding,
) -> Result<Vec<(PathBuf, AtomicFile)>, CliError> {
    let draft = |buffer: &PassBuffer| {
        let path = sibling_path(output, buffer.pass.name(), encoding.file_extension());
        let mut draft = AtomicFile::create(&path)?;
        let fault = |cause| OutputError { path: path.clone(), cause };
        draft.write_all(&buffer.encode_file(encoding)).map_err(fault)?;
        Ok((path, draft))
    };
    buffers.iter().map(draft).collect()
}

/// Returns the path of a file that accompanies a picture: `picture.depth.png` for `picture.png`.
///
/// The extension of the output is dropped: for `fox.svg`, the depth pass is `fox.depth.png`.
pub(super) fn sibling_path(output: &Path, what: &str, ending: &str) -> PathBuf {
    let mut name = output.file_stem().unwrap_or_default().to_owned();
    name.push(format!(".{what}.{ending}"));
    output.with_file_name(name)
}
