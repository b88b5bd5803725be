//! Flags for the subject of a panel page: the scene or model, and how it is drawn.

use super::CliError;
use super::args::{OverlayArg, StyleArg};
use super::load_options::LoadArgs;
use super::model_state::ModelStateArgs;
use super::render::open_input;
use super::scene_overrides::parse_image_size;
use super::section::SectionArgs;
use pipeline::Origin;
use scene_file::SceneFile;
use scene_file::file::{OverlayFile, ViewportsScale};
use std::path::PathBuf;

/// The subject that every panel of `compare-projections` and `sweep` shows.
#[derive(Debug, clap::Args)]
pub(super) struct PanelSubjectArgs {
    /// Scene (.ron) or model (.gltf, .glb, .stl, .obj, .ply, .3mf); `-` is the standard input
    pub(super) input: PathBuf,
    /// Width and height of each panel in pixels (96 per inch), up to 4096 each
    #[arg(long, value_name = "WxH", value_parser = parse_panel_size, default_value = "320x240")]
    size: (u32, u32),
    /// Render style; styles other than line drawings embed raster images in the page
    #[arg(long, default_value = "lines")]
    style: StyleArg,
    /// Guides drawn over the panels; repeatable
    #[arg(long, value_name = "WHAT", value_delimiter = ',')]
    overlay: Vec<OverlayArg>,
    #[command(flatten)]
    section: SectionArgs,
    #[command(flatten)]
    model_state: ModelStateArgs,
    /// Number of threads; does not change the page [default: one per core]
    #[arg(long, value_name = "N", value_parser = crate::options::parse_thread_count)]
    pub(super) threads: Option<u16>,
    #[command(flatten)]
    pub(super) load_options: LoadArgs,
}

/// The largest width and height of a panel in pixels.
///
/// A page may have dozens of panels, so the limit is far below a picture's.
const MAX_PANEL_SIDE: u32 = 4096;

/// Parses `WIDTHxHEIGHT` with both at most [`MAX_PANEL_SIDE`].
fn parse_panel_size(text: &str) -> Result<(u32, u32), String> {
    let size = parse_image_size(text)?;
    let fits = size.0.max(size.1) <= MAX_PANEL_SIDE;
    fits.then_some(size)
        .ok_or_else(|| format!("a panel can be at most {MAX_PANEL_SIDE} pixels wide and high"))
}

impl PanelSubjectArgs {
    /// Opens the scene file, or creates one for a bare model, and applies the flags to it.
    ///
    /// The scene is not resolved, because each panel changes its camera first. Size and style
    /// always replace the scene's, because panels have their own defaults. Viewports, a stereo pair
    /// and a caption are omitted, because panels show one camera and have titles.
    pub(super) fn open_scene(&self) -> Result<(Origin, SceneFile), CliError> {
        let (origin, mut file) = open_input(&self.input, &self.load_options.import_options())?;
        (file.viewports, file.stereo, file.caption) = (Vec::new(), None, None);
        file.viewports_scale = ViewportsScale::Individual;
        file.image.size = self.size;
        file.style = self.style.into();
        file.models.iter_mut().for_each(|model| self.model_state.apply_to(model));
        self.section.append_to(&mut file);
        file.overlays.extend(self.overlay.iter().copied().map(OverlayFile::from));
        Ok((origin, file))
    }
}
