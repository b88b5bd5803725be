//! Flags for passes, and the files they go to.

use super::CliError;
use clap::ValueEnum;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use pipeline::render::passes::{Pass, PassBuffer, PassEncoding};
use pipeline::scene::file::SceneFile;
use pipeline::{AtomicFile, OutputError};
use std::io::Write;
use std::path::{Path, PathBuf};

/// Which passes are written, and how.
#[derive(Clone, Debug, clap::Args)]
#[command(next_help_heading = "Passes")]
pub(crate) struct PassArgs {
    /// Write what is nearest at each pixel's centre besides its colour, beside the picture as NAME.PASS.png: depth along the view axis and
    /// distance from the eye in scene units, normal (world) and view-normal, position (world), uv, barycentric weights, id of the triangle
    /// and numbers of model, node, mesh and material (from 1; 0 is nothing), overdraw (fragments), coverage (share of the samples)
    #[arg(long, value_name = "PASS,…", value_delimiter = ',', value_parser = pass())]
    passes: Vec<Pass>,
    /// How passes are written
    #[arg(long, value_name = "FORMAT", requires = "passes")]
    passes_as: Option<EncodingArg>,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum EncodingArg {
    /// PNG of 16 bits; its text chunk Description says what the codes mean
    Png,
    /// Raw numbers for NumPy: f32, or u32 for whole numbers; nothing is infinitely far away
    Npy,
}

impl PassArgs {
    /// What the flags say goes before what the scene says.
    pub(crate) fn apply_to(&self, file: &mut SceneFile) {
        if !self.passes.is_empty() {
            file.passes.write.clone_from(&self.passes);
        }
        if let Some(encoding) = self.passes_as {
            file.passes.encoding = match encoding {
                EncodingArg::Png => PassEncoding::Png,
                EncodingArg::Npy => PassEncoding::Npy,
            };
        }
    }
}

/// The files of passes beside a picture, not yet in their places.
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

/// The name of a file that belongs to another: `picture.depth.png` for `picture.png`.
pub(super) fn sibling_path(output: &Path, what: &str, ending: &str) -> PathBuf {
    let mut name = output.file_stem().unwrap_or_default().to_owned();
    name.push(format!(".{what}.{ending}"));
    output.with_file_name(name)
}

fn pass() -> impl TypedValueParser<Value = Pass> {
    PossibleValuesParser::new(Pass::ALL.map(Pass::name)).try_map(|name| {
        let found = Pass::ALL.into_iter().find(|pass| pass.name() == name);
        found.ok_or_else(|| format!("there is no pass `{name}`"))
    })
}
