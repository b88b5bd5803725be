//! Flags that change what a scene says of its picture: the size, the camera, the style, the state of the models.

use super::args::{OverlayArg, ProjectionArg, StyleArg};
use super::light::LightArgs;
use super::load_options::LoadArgs;
use super::model_state::ModelStateArgs;
use super::section::SectionArgs;
use camera::NamedView;
use projection::PrincipalView;
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use model::import::ImportOptions;
use pipeline::scene::file::{
    BackgroundFile, CameraChoice, CameraFile, Color, DEFAULT_PADDING, OverlayFile,
    ProjectionFile, SceneFile, StyleFile, ViewFile,
};

/// What goes before what the scene says; a bare model is a scene that says nothing.
#[derive(Clone, Debug, clap::Args)]
pub(crate) struct SceneOverrideArgs {
    /// Width and height in pixels, such as 1920x1080
    #[arg(long, value_name = "WxH", value_parser = parse_size)]
    pub(crate) size: Option<(u32, u32)>,
    /// Multiply width and height, those of the scene or of --size, by a number up to 64
    #[arg(long, value_name = "N", value_parser = parse_factor)]
    pub(crate) scale: Option<f64>,
    /// How surfaces are drawn
    #[arg(long)]
    pub(crate) style: Option<StyleArg>,
    /// A camera of the model, by name or by number from 0
    #[arg(long, value_name = "NAME|INDEX", conflicts_with = "view")]
    pub(crate) camera: Option<String>,
    #[command(flatten)]
    pub(crate) model_state: ModelStateArgs,
    /// Frame everything from this side
    #[arg(long, value_parser = named_view())]
    pub(crate) view: Option<NamedView>,
    /// The projection
    #[arg(long)]
    pub(crate) projection: Option<ProjectionArg>,
    /// What is drawn over the picture to explain it; may be given several times
    #[arg(long, value_name = "WHAT", value_delimiter = ',')]
    pub(crate) overlay: Vec<OverlayArg>,
    #[command(flatten)]
    pub(crate) section: SectionArgs,
    /// What is seen where no model is: transparent, or a colour such as #f4f1ea
    #[arg(long, value_name = "COLOR", value_parser = parse_background)]
    pub(crate) background: Option<BackgroundFile>,
    /// Coverage samples per pixel: 1, 4, 8 or 16
    #[arg(long, value_name = "N", value_parser = parse_samples)]
    pub(crate) samples: Option<u32>,
    /// Places that textures are read at along the longer side of what a pixel covers of them: 1 to 8
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=8))]
    pub(crate) anisotropy: Option<u32>,
    #[command(flatten)]
    pub(crate) light: LightArgs,
}

impl SceneOverrideArgs {
    /// What the flags say goes before what the scene says.
    pub(crate) fn apply_to(&self, file: &mut SceneFile) {
        if let Some(size) = self.size {
            file.image.size = size;
        }
        if let Some(factor) = self.scale {
            let (width, height) = file.image.size;
            let side = |side: u32| libm::round(f64::from(side) * factor).max(1.0) as u32;
            file.image.size = (side(width), side(height));
        }
        if let Some(samples) = self.samples {
            file.image.samples = samples;
        }
        if let Some(anisotropy) = self.anisotropy {
            file.image.max_anisotropy = anisotropy;
        }
        if let Some(background) = &self.background {
            file.image.background.clone_from(background);
        }
        if let Some(style) = self.style {
            file.style = style.into();
        }
        self.section.append_to(file);
        file.overlays.extend(self.overlay.iter().copied().map(OverlayFile::from));
        file.models.iter_mut().for_each(|model| self.model_state.apply_to(model));
        self.light.apply_to(file);
        self.apply_to_camera(&mut file.camera);
    }

    /// How models are loaded by these flags too: a file that they name may be read wherever it is.
    pub(crate) fn import_options(&self, load: &LoadArgs) -> ImportOptions {
        let mut options = load.import_options();
        options.allow_outside.extend(self.light.environment_file());
        options
    }

    fn apply_to_camera(&self, file: &mut CameraFile) {
        if let Some(camera) = &self.camera {
            let by_name = || CameraChoice::Name(camera.clone());
            let choice = camera.parse().map_or_else(|_| by_name(), CameraChoice::Index);
            file.view = ViewFile::FromModel(choice);
        }
        if let Some(view) = self.view {
            let padding_percent = match &file.view {
                ViewFile::Frame { padding_percent, .. } => *padding_percent,
                _ => DEFAULT_PADDING,
            };
            file.view = ViewFile::Frame { from: Some(view.into()), padding_percent };
        }
        if let Some(projection) = self.projection {
            file.projection = Some(projection.into());
        }
    }
}

impl From<StyleArg> for StyleFile {
    fn from(style: StyleArg) -> Self {
        match style {
            StyleArg::Shaded => Self::Shaded,
            StyleArg::Flat => Self::Flat,
            StyleArg::Gouraud => Self::Gouraud,
            StyleArg::Clay => Self::Clay,
            StyleArg::Matcap => Self::Matcap,
            StyleArg::Normals => Self::Normals,
            StyleArg::Depth => Self::Depth,
            StyleArg::Uv => Self::UvChecker,
            StyleArg::Ids => Self::Ids,
            StyleArg::Toon => Self::Toon,
            StyleArg::XRay => Self::XRay,
            StyleArg::Wireframe => Self::Wireframe,
            StyleArg::DepthCued => Self::lines_depth_cued(),
            StyleArg::Lines => Self::lines_hidden_removed(),
            StyleArg::Dashed => Self::lines_hidden_dashed(),
            StyleArg::Silhouette => Self::lines_silhouette(),
            StyleArg::Technical => Self::lines_technical(),
        }
    }
}

impl From<ProjectionArg> for ProjectionFile {
    fn from(projection: ProjectionArg) -> Self {
        match projection {
            ProjectionArg::Perspective => Self::PERSPECTIVE,
            ProjectionArg::Orthographic => Self::ORTHOGRAPHIC,
            ProjectionArg::Multiview => Self::Multiview(PrincipalView::Front),
            ProjectionArg::Isometric => Self::Isometric,
            ProjectionArg::Dimetric => Self::Dimetric,
            ProjectionArg::Trimetric => Self::Trimetric,
            ProjectionArg::Cavalier => Self::cavalier(),
            ProjectionArg::Cabinet => Self::cabinet(),
            ProjectionArg::Military => Self::military(),
            ProjectionArg::OnePoint => Self::one_point(),
            ProjectionArg::TwoPoint => Self::two_point(),
            ProjectionArg::ThreePoint => Self::three_point(),
        }
    }
}

impl From<OverlayArg> for OverlayFile {
    fn from(overlay: OverlayArg) -> Self {
        match overlay {
            OverlayArg::Axes => Self::Axes { length: None },
            OverlayArg::Grid => Self::Grid { step: None },
            OverlayArg::Horizon => Self::Horizon,
            OverlayArg::VanishingPoints => Self::VanishingPoints,
            OverlayArg::Edges => Self::Edges,
        }
    }
}

/// The views of the `camera` crate by their names.
pub(super) fn named_view() -> impl TypedValueParser<Value = NamedView> {
    let value = |view: NamedView| match view {
        NamedView::Isometric => PossibleValue::new(view.name()).alias("iso"),
        _ => PossibleValue::new(view.name()),
    };
    PossibleValuesParser::new(NamedView::ALL.map(value)).try_map(|name| name.parse::<NamedView>())
}

fn parse_factor(text: &str) -> Result<f64, String> {
    let factor = text.parse().ok().filter(|factor: &f64| *factor > 0.0 && *factor <= 64.0);
    factor.ok_or_else(|| "expected a number greater than 0, up to 64, such as 2 or 0.5".to_owned())
}

/// `transparent`, or a colour.
fn parse_background(text: &str) -> Result<BackgroundFile, String> {
    if text.eq_ignore_ascii_case("transparent") {
        return Ok(BackgroundFile::Transparent);
    }
    let color = Color::parse(text).map(BackgroundFile::Color);
    color.ok_or_else(|| "expected transparent, or a color such as #f4f1ea or white".to_owned())
}

fn parse_samples(text: &str) -> Result<u32, String> {
    let samples = text.parse().ok().filter(|samples| [1, 4, 8, 16].contains(samples));
    samples.ok_or_else(|| "possible are 1, 4, 8 and 16".to_owned())
}

pub(super) fn parse_size(text: &str) -> Result<(u32, u32), String> {
    let fault = || {
        format!(
            "expected WIDTHxHEIGHT, such as 1920x1080, each from 1 to {}",
            pipeline::MAX_IMAGE_SIDE
        )
    };
    let (width, height) = text.split_once(['x', 'X']).ok_or_else(fault)?;
    let side = |digits: &str| {
        let side: u32 = digits.parse().map_err(|_| fault())?;
        (1..=pipeline::MAX_IMAGE_SIDE).contains(&side).then_some(side).ok_or_else(fault)
    };
    Ok((side(width)?, side(height)?))
}
