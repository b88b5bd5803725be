//! The subject of a demonstration: a scene or a bare model, and how it is drawn.

use super::CliError;
use super::args::{OverlayArg, StyleArg};
use super::load_options::LoadArgs;
use super::model_state::ModelStateArgs;
use super::render::open_input;
use super::scene_overrides::parse_size;
use super::section::SectionArgs;
use pipeline::Origin;
use pipeline::scene::SceneFile;
use pipeline::scene::file::OverlayFile;
use std::path::PathBuf;

/// What is shown in every picture of a page.
#[derive(Debug, clap::Args)]
pub(super) struct PanelSubjectArgs {
    /// A scene (.ron) or a model (.gltf, .glb); `-` reads one from the standard input
    pub(super) input: PathBuf,
    /// Width and height of each picture in pixels, 96 to the inch, up to 4096 each
    #[arg(long, value_name = "WxH", value_parser = parse_panel, default_value = "320x240")]
    size: (u32, u32),
    /// How surfaces are drawn; styles that show surfaces paste pictures into the page
    #[arg(long, default_value = "lines")]
    style: StyleArg,
    /// What is drawn over the pictures to explain them; may be given several times
    #[arg(long, value_name = "WHAT", value_delimiter = ',')]
    overlay: Vec<OverlayArg>,
    #[command(flatten)]
    section: SectionArgs,
    #[command(flatten)]
    model_state: ModelStateArgs,
    /// Threads to use; the page does not depend on it [default: as many as there are cores]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=256))]
    pub(super) threads: Option<u16>,
    #[command(flatten)]
    pub(super) load_options: LoadArgs,
}

/// The most pixels of a side of one of many pictures on a page.
const MAX_PANEL_SIDE: u32 = 4096;

fn parse_panel(text: &str) -> Result<(u32, u32), String> {
    let size = parse_size(text)?;
    let fits = size.0.max(size.1) <= MAX_PANEL_SIDE;
    fits.then_some(size)
        .ok_or_else(|| format!("a picture on a page has up to {MAX_PANEL_SIDE} pixels a side"))
}

impl PanelSubjectArgs {
    /// The scene's file as the flags want it.
    pub(super) fn open_scene(&self) -> Result<(Origin, SceneFile), CliError> {
        let (origin, mut file) = open_input(&self.input, &self.load_options.import_options())?;
        file.image.size = self.size;
        file.style = self.style.into();
        file.models.iter_mut().for_each(|model| self.model_state.apply_to(model));
        self.section.append_to(&mut file);
        file.overlays.extend(self.overlay.iter().copied().map(OverlayFile::from));
        Ok((origin, file))
    }
}
