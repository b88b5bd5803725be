//! Flags that override scene fields: size, camera, style, overlays, model state.
//!
//! They are applied to the parsed scene file before it is resolved, so that a flag and a field have
//! the same meaning and the same errors. A bare model is a scene in which every field has its
//! default.
//!
//! ```text
//!  scene file ─► flags replace or extend its fields ─► Scene::resolve ─► scene
//! ```
//! A flag that is not set changes nothing. Lists (`--section`, `--overlay`) are appended to the
//! scene's lists; everything else is replaced.

mod colormap_flags;

use super::CliError;
use super::args::{OverlayArg, ProjectionArg, StyleArg};
use super::calibrated_camera::CalibratedCameraArgs;
use super::light::LightArgs;
use super::load_options::LoadArgs;
use super::model_state::ModelStateArgs;
use super::render::open_input;
use super::section::SectionArgs;
use super::viewpoint::ViewpointArgs;
use camera::NamedView;
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use colormap_flags::ColormapArgs;
use import::ImportOptions;
use pipeline::{Origin, Scene};
use projection::PrincipalView;
use scene::ResolveOptions;
use scene_file::file::{
    BackgroundFile, CameraChoice, CameraFile, Color, DEFAULT_PADDING, NonNegative, OverlayFile,
    PointSize, ProjectionFile, SceneFile, StyleFile, ViewFile,
};
use std::path::Path;

/// Flags that replace fields of the scene.
#[derive(Clone, Debug, clap::Args)]
pub(crate) struct SceneOverrideArgs {
    /// Width and height of the picture in pixels, such as 1920x1080
    #[arg(help_heading = "Picture", long, value_name = "WxH", value_parser = parse_image_size)]
    pub(crate) size: Option<(u32, u32)>,
    /// Multiply width and height by this factor, up to 64
    #[arg(help_heading = "Picture", long, value_name = "N", value_parser = parse_scale_factor)]
    pub(crate) scale: Option<f64>,
    /// Render style
    #[arg(help_heading = "Picture", long)]
    pub(crate) style: Option<StyleArg>,
    #[command(flatten)]
    pub(crate) colormap: ColormapArgs,
    /// Camera of the model, by name or index
    #[arg(help_heading = "Camera", long, value_name = "NAME|INDEX", conflicts_with = "view")]
    pub(crate) camera: Option<String>,
    #[command(flatten)]
    pub(crate) model_state: ModelStateArgs,
    /// Frame all models from this direction
    #[arg(help_heading = "Camera", long, value_parser = named_view_parser())]
    pub(crate) view: Option<NamedView>,
    /// Projection of the camera
    #[arg(help_heading = "Camera", long)]
    pub(crate) projection: Option<ProjectionArg>,
    #[command(flatten)]
    pub(crate) viewpoint: ViewpointArgs,
    #[command(flatten)]
    pub(crate) calibrated: CalibratedCameraArgs,
    /// Draw lines exactly and completely, even if many surfaces make this slow
    #[arg(help_heading = "Lines", long)]
    pub(crate) no_line_limits: bool,
    /// Guides drawn over the picture; repeatable
    #[arg(help_heading = "Picture", long, value_name = "WHAT", value_delimiter = ',')]
    pub(crate) overlay: Vec<OverlayArg>,
    #[command(flatten)]
    pub(crate) section: SectionArgs,
    /// Background: transparent, environment, or a color such as #f4f1ea
    #[arg(help_heading = "Picture", long, value_name = "COLOR", value_parser = parse_background)]
    pub(crate) background: Option<BackgroundFile>,
    /// Samples per pixel for anti-aliasing: 1, 4, 8 or 16
    #[arg(help_heading = "Picture", long, value_name = "N", value_parser = parse_samples)]
    pub(crate) samples: Option<u32>,
    /// Maximum anisotropy of texture filtering, 1 to 8
    ///
    /// Up to this many trilinear samples are taken along the longer axis of a pixel's footprint.
    #[arg(help_heading = "Picture", long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=8))]
    pub(crate) max_anisotropy: Option<u32>,
    /// Size of a model's points in pixels, from 1 to 256 [default: 3]
    #[arg(help_heading = "Picture", long, value_name = "N", value_parser = parse_point_size)]
    pub(crate) point_size: Option<PointSize>,
    #[command(flatten)]
    pub(crate) light: LightArgs,
}

impl SceneOverrideArgs {
    /// Replaces the fields of a scene with the values of the flags.
    ///
    /// The order matters in one case: `--scale` multiplies the size from `--size`, if both are set.
    /// A size is at least one pixel; a size that is too large is rejected when the scene is
    /// resolved.
    ///
    /// # Errors
    /// Returns an error if a flag does not fit the scene, such as `--fov` in a parallel view.
    pub(crate) fn apply_to(&self, origin: &Origin, file: &mut SceneFile) -> Result<(), CliError> {
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
        if let Some(anisotropy) = self.max_anisotropy {
            file.image.max_anisotropy = anisotropy;
        }
        if let Some(size) = self.point_size {
            file.image.point_size = size;
        }
        if self.background.is_some() {
            file.image.background.clone_from(&self.background);
        }
        self.section.append_to(file);
        if let Some(style) = self.style {
            let is_cut = !file.sections.is_empty();
            let chosen = StyleFile::from(style).with_fitting_lines(file.image.size);
            file.style = match style {
                StyleArg::Technical | StyleArg::Blueprint if is_cut => {
                    chosen.without_hidden_lines()
                }
                _ => chosen,
            };
        }
        file.overlays.extend(self.overlay.iter().copied().map(OverlayFile::from));
        self.model_state.apply_to_scene(file);
        self.colormap.apply_to(file);
        self.light.apply_to(origin, file)?;
        self.apply_to_camera(&mut file.camera)
    }

    /// Moves the camera of the resolved scene to its position on the camera path at `--time`,
    /// unless another flag chooses the view.
    ///
    /// # Errors
    /// Returns an error if the keyframes are invalid, or if there is no view at that time.
    pub(crate) fn place_camera(
        &self,
        origin: &Origin,
        file: &SceneFile,
        scene: &mut Scene,
    ) -> Result<(), CliError> {
        let is_placed = self.viewpoint.places_camera() || self.calibrated.places_camera();
        if self.view.is_some() || self.camera.is_some() || is_placed {
            return Ok(());
        }
        self.model_state.place_camera(origin, file, scene)
    }

    /// Returns the import options, with permission to read the files that these flags name.
    ///
    /// Only `--environment` names a file. The file becomes an allowed path; its folder does not.
    pub(crate) fn import_options(&self, load: &LoadArgs) -> ImportOptions {
        let mut options = load.import_options();
        options.allow_outside.extend(self.light.environment_file());
        options
    }

    /// Opens a scene or a model, applies the flags to it, and resolves it.
    ///
    /// The scene file is returned too, for commands that resolve it again or query it.
    ///
    /// # Errors
    /// Returns an error if the input, or a file that it refers to, cannot be read or is invalid.
    pub(crate) fn open_scene(
        &self,
        input: &Path,
        load_options: &LoadArgs,
    ) -> Result<(Origin, SceneFile, Scene), CliError> {
        let import = self.import_options(load_options);
        let (origin, mut file) = open_input(input, &import)?;
        self.apply_to(&origin, &mut file)?;
        load_options.apply_crease_to(&mut file, false);
        let mut scene = Scene::resolve(&origin, &file, &self.resolve_options(import))?;
        self.place_camera(&origin, &file, &mut scene)?;
        Ok((origin, file, scene))
    }

    /// Returns the options for resolving scenes: a size on the command line may be any valid size.
    pub(crate) const fn resolve_options(&self, import: ImportOptions) -> ResolveOptions {
        ResolveOptions {
            import,
            allow_large_picture: self.size.is_some(),
            unlimited_lines: self.no_line_limits,
        }
    }

    /// Frames the models from a direction, keeping the padding of a scene that already frames them.
    pub(crate) fn aim_from(file: &mut CameraFile, view: NamedView) {
        let padding_percent = frame_padding(file);
        file.view = ViewFile::Frame { from: Some(view.into()), padding_percent };
    }

    /// Replaces the scene's view and projection with those from the flags.
    ///
    /// `--view` keeps the padding of a scene that frames its models.
    ///
    /// `--camera` interprets a whole number as an index and anything else as a name. `--view`
    /// replaces the view of the scene, even one with a fixed eye and target, but not its
    /// projection.
    fn apply_to_camera(&self, file: &mut CameraFile) -> Result<(), CliError> {
        if let Some(camera) = &self.camera {
            let by_name = || CameraChoice::Name(camera.clone());
            let choice = camera.parse().map_or_else(|_| by_name(), CameraChoice::Index);
            file.view = ViewFile::FromModel(choice);
        }
        if let Some(view) = self.view {
            Self::aim_from(file, view);
        }
        if let Some(projection) = self.projection {
            file.projection = Some(projection.into());
        }
        self.calibrated.apply_to(file);
        self.viewpoint.apply_to(file)
    }
}

/// Returns the padding of a camera that frames its models, or the default.
pub(super) const fn frame_padding(file: &CameraFile) -> NonNegative {
    match &file.view {
        ViewFile::Frame { padding_percent, .. } => *padding_percent,
        _ => DEFAULT_PADDING,
    }
}

/// Line drawing styles have parameters in scene files; flags use the defaults.
impl From<StyleArg> for StyleFile {
    fn from(style: StyleArg) -> Self {
        match style {
            StyleArg::Shaded => Self::Shaded,
            StyleArg::Flat => Self::Flat,
            StyleArg::Unlit => Self::Unlit,
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
            StyleArg::Outline => Self::lines_outline(),
            StyleArg::Technical => Self::lines_technical(),
            StyleArg::Patent => Self::lines_patent(),
            StyleArg::Blueprint => Self::lines_blueprint(),
            StyleArg::Sketch => Self::lines_sketch(),
        }
    }
}

/// Projections have default parameters here, such as the field of view; scene files can set them.
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

/// Parses a view's name in the `camera` crate; `iso` is short for `isometric`.
///
/// Help, completions and errors list the names; an alias is accepted, but not listed.
pub(super) fn named_view_parser() -> impl TypedValueParser<Value = NamedView> {
    let value = |view: NamedView| match view {
        NamedView::Isometric => PossibleValue::new(view.name()).alias("iso"),
        _ => PossibleValue::new(view.name()),
    };
    PossibleValuesParser::new(NamedView::ALL.map(value)).try_map(|name| name.parse::<NamedView>())
}

/// Parses a point size.
fn parse_point_size(text: &str) -> Result<PointSize, String> {
    let size = text.parse().ok().and_then(PointSize::new);
    size.ok_or_else(|| "expected a number of pixels from 1 to 256, such as 5".to_owned())
}

/// Parses a factor above 0, up to 64.
fn parse_scale_factor(text: &str) -> Result<f64, String> {
    let factor = text.parse().ok().filter(|factor: &f64| *factor > 0.0 && *factor <= 64.0);
    factor.ok_or_else(|| "expected a number greater than 0, up to 64, such as 2 or 0.5".to_owned())
}

/// Parses `transparent`, `environment`, or a color as in scene files: `#rgb`, `#rrggbb` or a CSS name.
///
/// Color names are case-insensitive, as in CSS.
fn parse_background(text: &str) -> Result<BackgroundFile, String> {
    if text.eq_ignore_ascii_case("transparent") {
        return Ok(BackgroundFile::Transparent);
    }
    if text.eq_ignore_ascii_case("environment") {
        return Ok(BackgroundFile::Environment { blur: None });
    }
    let color = Color::parse(text).map(BackgroundFile::Color);
    // A shell treats a word that begins with # as a comment.
    let with_hash = format!("#{text}");
    color.ok_or_else(|| match Color::parse(&with_hash) {
        Some(_) => format!("write '{with_hash}', with the quotation marks"),
        None => {
            "expected transparent, environment, or a color such as '#f4f1ea' or white".to_owned()
        }
    })
}

/// Parses a number of samples for which the rasterizer has a pattern.
///
/// # Errors
/// Returns an error for any other number, such as 2.
fn parse_samples(text: &str) -> Result<u32, String> {
    let samples = text.parse().ok().filter(|samples| [1, 4, 8, 16].contains(samples));
    samples.ok_or_else(|| "expected 1, 4, 8 or 16".to_owned())
}

/// Parses `WIDTHxHEIGHT`, each from 1 to [`scene::MAX_IMAGE_SIDE`].
///
/// ```text
/// 1920x1080    512X512    1x1
/// ```
pub(super) fn parse_image_size(text: &str) -> Result<(u32, u32), String> {
    let fault = || {
        format!(
            "expected WIDTHxHEIGHT, such as 1920x1080, each from 1 to {}",
            scene::MAX_IMAGE_SIDE
        )
    };
    let (width, height) = text.split_once(['x', 'X']).ok_or_else(fault)?;
    let side = |digits: &str| {
        let side: u32 = digits.parse().map_err(|_| fault())?;
        (1..=scene::MAX_IMAGE_SIDE).contains(&side).then_some(side).ok_or_else(fault)
    };
    Ok((side(width)?, side(height)?))
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::ValueEnum as _;

    /// Other programs in the workspace use the flag's names for styles.
    #[test]
    fn flag_styles_match_the_library() {
        let names = StyleArg::value_variants().iter().map(|style| {
            let name = style.to_possible_value().expect("a name").get_name().to_owned();
            (name, StyleFile::from(*style))
        });
        let known = StyleFile::NAMED.map(|(name, make)| (name.to_owned(), make()));
        assert_eq!(names.collect::<Vec<_>>(), known);
    }
}
