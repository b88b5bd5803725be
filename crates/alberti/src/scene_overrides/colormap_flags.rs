//! Flags that show numbers as colors: scalar vertex attributes, and depth.

use crate::number_list::parse_numbers;
use crate::options::option_parser;
use model::Colormap;
use pipeline::Scene;
use scene::Style;
use scene_file::file::{Finite, ScalarsFile, SceneFile};

/// The colors of scalars and depths; each flag overrides the scene file for all models.
#[derive(Clone, Debug, Default, clap::Args)]
pub(crate) struct ColormapArgs {
    /// Color the model by this scalar vertex attribute: a custom glTF attribute such as
    /// `_TEMPERATURE`, or a PLY property such as `quality`
    ///
    /// The leading underscore may be omitted. `alberti info` lists the attributes. The colors
    /// replace the materials; values that are not finite are gray.
    #[arg(help_heading = "Picture", long, value_name = "NAME")]
    scalars: Option<String>,
    /// Colors for --scalars and --style depth [default: viridis for --scalars, else grayscale]
    #[arg(help_heading = "Picture", long, value_parser = option_parser::<Colormap>())]
    colormap: Option<Colormap>,
    /// Values for the first and the last color of --scalars [default: the model's minimum and
    /// maximum]
    #[arg(
        help_heading = "Picture",
        long,
        value_name = "MIN,MAX",
        value_parser = parse_scalar_range,
        allow_hyphen_values = true
    )]
    scalar_range: Option<ScalarRange>,
}

/// The values that are mapped to the first and the last color.
#[derive(Clone, Copy, Debug)]
struct ScalarRange {
    min: Finite,
    max: Finite,
}

impl ColormapArgs {
    /// Replaces the depth colors and the colors of all models in a scene.
    ///
    /// Each attribute has its own range of values, so `--scalars` discards the scene's range.
    pub(crate) fn apply_to(&self, file: &mut SceneFile) {
        file.depth_colormap = self.colormap.or(file.depth_colormap);
        for model in &mut file.models {
            let flag = self.scalars.as_ref().map(|attribute| ScalarsFile {
                attribute: attribute.clone(),
                colormap: model.scalars.as_ref().map(|file| file.colormap).unwrap_or_default(),
                range: None,
            });
            let Some(mut scalars) = flag.or_else(|| model.scalars.take()) else { continue };
            scalars.colormap = self.colormap.unwrap_or(scalars.colormap);
            scalars.range = self.scalar_range.map(|range| (range.min, range.max)).or(scalars.range);
            model.scalars = Some(scalars);
        }
    }

    /// Returns the warnings about flags that have no effect in a picture of a scene. `draws_lines`
    /// is true for a line drawing; `style` is the name of the picture's style.
    pub(crate) fn find_unused(&self, scene: &Scene, draws_lines: bool, style: &str) -> Vec<String> {
        let has_scalars =
            scene.models.iter().any(|placed| placed.model.active_scalar_attribute.is_some());
        let is_depth = |style: Style| matches!(style, Style::Depth(_));
        let insets = || scene.insets.iter().map(|inset| inset.scene.style);
        let shows_depth = !draws_lines && is_depth(scene.style) || insets().any(is_depth);
        let shows_colors =
            !draws_lines && shows_vertex_colors(scene.style) || insets().any(shows_vertex_colors);
        let mut warnings = Vec::new();
        if self.scalars.is_some() && !shows_colors {
            let shown = match draws_lines {
                true => "a line drawing".to_owned(),
                false => format!("the `{style}` style"),
            };
            warnings
                .push(format!("--scalars does nothing here: {shown} does not show vertex colors"));
        }
        if self.colormap.is_some() && !has_scalars && !shows_depth {
            let use_of = "it needs --scalars or --style depth";
            warnings.push(format!("--colormap does nothing here: {use_of}"));
        }
        if self.scalar_range.is_some() && !has_scalars {
            warnings.push("--scalar-range does nothing here: it needs --scalars".to_owned());
        }
        warnings
    }
}

/// Whether surfaces of a style show their vertex colors.
const fn shows_vertex_colors(style: Style) -> bool {
    matches!(style, Style::Shaded | Style::Flat | Style::Unlit | Style::Gouraud | Style::Toon)
}

/// Parses `MIN,MAX`.
///
/// # Errors
/// Returns an error if the text is not two finite numbers, or if the first exceeds the second.
fn parse_scalar_range(text: &str) -> Result<ScalarRange, String> {
    let [min, max] = parse_numbers(text)?;
    if min > max {
        return Err("expected MIN,MAX with the smaller value first, such as 0,100".to_owned());
    }
    let finite = |value| Finite::new(value).ok_or_else(|| "expected finite numbers".to_owned());
    Ok(ScalarRange { min: finite(min)?, max: finite(max)? })
}
