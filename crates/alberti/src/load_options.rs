//! Model loading flags: leniency, allowed folders, limits on input size, and properties that a file
//! may lack (up axis, unit and crease angle).
//!
//! Models are not trusted: without limits, a file of a few kilobytes could demand terabytes of
//! memory. Every command that loads a model has these flags.

use super::explore::embedded::lesson_model;
use super::options::option_parser;
use import::{ImportOptions, Limits};
use model::{LengthUnit, UpAxis};
use scene_file::file::{CreaseAngle, SceneFile, StyleFile};
use std::path::PathBuf;

/// Flags for loading models; [`import_options`](Self::import_options) converts them to the
/// library's options.
#[derive(Debug, clap::Args)]
#[command(next_help_heading = "Input")]
pub(crate) struct LoadArgs {
    /// Skip broken, missing or unsupported parts, with a warning
    #[arg(long)]
    lenient: bool,
    /// Also allow files below this folder; repeatable
    ///
    /// By default, only files below the folders of the scene and the model are read.
    #[arg(long, value_name = "DIR")]
    allow_outside: Vec<PathBuf>,
    /// Axis that points up in the file [default: z for STL and 3MF, y for all others]
    #[arg(long, value_name = "AXIS", value_parser = option_parser::<UpAxis>(), allow_hyphen_values = true)]
    pub(crate) up: Option<UpAxis>,
    /// Length unit of the model, for sheets and dimensions [default: as declared in the file, else
    /// mm for STL and 3MF, m for all others]
    #[arg(long, value_parser = option_parser::<LengthUnit>())]
    pub(crate) unit: Option<LengthUnit>,
    /// Crease angle: the largest angle at which adjacent faces appear smooth [default: 30]
    ///
    /// It always affects the edges of line drawings, but shading only if the file has no normals.
    #[arg(long, value_name = "DEGREES", value_parser = parse_crease_angle)]
    pub(crate) crease: Option<f64>,
    #[command(flatten)]
    limits: LimitArgs,
}

/// Limits on the resources an input may use: a flag `--max-…` for each field of [`Limits`].
#[derive(Debug, clap::Args)]
#[command(next_help_heading = "Limits (numbers may end in k, M, G, Ki, Mi, Gi, and B for bytes)")]
struct LimitArgs {
    /// Size of one file in bytes [default: 512MiB]
    #[arg(long, value_name = "SIZE", value_parser = parse_byte_size)]
    max_file_bytes: Option<u64>,
    /// Total size of a model's files in bytes [default: 2GiB]
    #[arg(long, value_name = "SIZE", value_parser = parse_byte_size)]
    max_total_bytes: Option<u64>,
    /// Nesting depth of the JSON, up to 127 [default: 120]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..=127))]
    max_json_depth: Option<u64>,
    /// Number of values in the JSON; an object counts as ten [default: 16M]
    #[arg(long, value_name = "N", value_parser = parse_byte_size)]
    max_json_values: Option<u64>,
    /// Total size of a model's decoded arrays in bytes [default: 4GiB]
    #[arg(long, value_name = "SIZE", value_parser = parse_byte_size)]
    max_array_bytes: Option<u64>,
    /// Ratio of decoded arrays to file size [default: 64]
    #[arg(long, value_name = "N", value_parser = parse_byte_size)]
    max_array_growth: Option<u64>,
    /// Width and height of an image in texels [default: 16384]
    #[arg(long, value_name = "N", value_parser = parse_byte_size)]
    max_image_side: Option<u64>,
    /// Total number of texels in a model's images [default: 256Mi]
    #[arg(long, value_name = "N", value_parser = parse_byte_size)]
    max_image_texels: Option<u64>,
    /// Number of nodes [default: 1M]
    #[arg(long, value_name = "N", value_parser = parse_byte_size)]
    max_nodes: Option<u64>,
    /// Depth of the node tree [default: 1024]
    #[arg(long, value_name = "N", value_parser = parse_byte_size)]
    max_node_depth: Option<u64>,
    /// Number of points, lines and triangles in a model, counting every instance [default: 200M]
    #[arg(long, value_name = "N", value_parser = parse_byte_size)]
    max_scene_items: Option<u64>,
    /// Total size of the arrays and images of a scene's models in bytes [default: 4GiB]
    #[arg(long, value_name = "SIZE", value_parser = parse_byte_size)]
    max_scene_bytes: Option<u64>,
}

impl LoadArgs {
    /// Returns the options of the `import` crate for these flags.
    pub(crate) fn import_options(&self) -> ImportOptions {
        ImportOptions {
            limits: self.limits.to_limits(),
            allow_outside: self.allow_outside.clone(),
            lenient: self.lenient,
            up: self.up,
            length_unit: self.unit,
            crease_angle: self.crease,
            lesson_model: Some(lesson_model),
            ..ImportOptions::default()
        }
    }
}

impl LoadArgs {
    /// Applies the angle of `--crease` to the edges of a line drawing.
    ///
    /// With `draws_lines`, a line style replaces a surface style, because vector files show lines.
    pub(crate) fn apply_crease_to(&self, file: &mut SceneFile, draws_lines: bool) {
        let Some(angle) = self.crease else { return };
        if draws_lines && !matches!(file.style, StyleFile::Lines(_) | StyleFile::Wireframe) {
            file.style = StyleFile::lines_hidden_removed();
        }
        if let StyleFile::Lines(lines) = &mut file.style {
            lines.crease_degrees = CreaseAngle::new(angle);
        }
    }
}

impl LimitArgs {
    /// Returns the limits for the `import` crate: the flags' values, and defaults for the others.
    ///
    /// A number too large for its limit's type means that there is no limit.
    fn to_limits(&self) -> Limits {
        let defaults = Limits::default();
        let size = |flag: Option<u64>, usual: usize| {
            flag.map_or(usual, |number| usize::try_from(number).unwrap_or(usize::MAX))
        };
        let side = |number: u64| u32::try_from(number).unwrap_or(u32::MAX);
        Limits {
            file_bytes: self.max_file_bytes.unwrap_or(defaults.file_bytes),
            total_bytes: self.max_total_bytes.unwrap_or(defaults.total_bytes),
            json_depth: size(self.max_json_depth, defaults.json_depth),
            json_values: size(self.max_json_values, defaults.json_values),
            array_bytes: self.max_array_bytes.unwrap_or(defaults.array_bytes),
            array_growth: self.max_array_growth.unwrap_or(defaults.array_growth),
            image_side: self.max_image_side.map_or(defaults.image_side, side),
            image_texels: self.max_image_texels.unwrap_or(defaults.image_texels),
            nodes: size(self.max_nodes, defaults.nodes),
            node_depth: size(self.max_node_depth, defaults.node_depth),
            scene_items: self.max_scene_items.unwrap_or(defaults.scene_items),
            scene_bytes: self.max_scene_bytes.unwrap_or(defaults.scene_bytes),
        }
    }
}

/// Parses an angle from 0 to 180 degrees.
fn parse_crease_angle(text: &str) -> Result<f64, String> {
    let angle = text.parse().ok().filter(|angle| (0.0..=180.0).contains(angle));
    angle.ok_or_else(|| "expected an angle from 0 to 180 degrees".to_owned())
}

/// Parses a whole number with an optional decimal or binary unit: `512MiB`, `200M`, `1_000`.
///
/// ```text
/// 4096    64k = 64,000    64Ki = 65,536    512MiB    5 MB    1_000
/// ```
/// Units are case-insensitive, and the `B` is optional. Fractions are rejected: write `1500M`
/// instead of `1.5G`.
///
/// # Errors
/// Returns an error if the text is not such a number, or if the number exceeds 64 bits.
pub(crate) fn parse_byte_size(text: &str) -> Result<u64, String> {
    let fault = || "expected an integer such as 4096, 64k, 200M, 512MiB or 1GiB".to_owned();
    let start = text.find(|c: char| !c.is_ascii_digit() && c != '_').unwrap_or(text.len());
    let (digits, unit) = text.split_at(start);
    let number: u64 = digits.replace('_', "").parse().map_err(|_| fault())?;
    let unit = unit.trim_start().trim_end_matches(['B', 'b']).to_ascii_lowercase();
    let factor = match unit.as_str() {
        "" => 1,
        "k" => 1_000,
        "m" => 1_000_000,
        "g" => 1_000_000_000,
        "ki" => 1 << 10,
        "mi" => 1 << 20,
        "gi" => 1 << 30,
        _ => return Err(fault()),
    };
    number.checked_mul(factor).ok_or_else(|| format!("{text} is too large"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_with_units_are_parsed() {
        for (text, number) in [
            ("0", 0),
            ("1_000", 1_000),
            ("64k", 64_000),
            ("5 MB", 5_000_000),
            ("512MiB", 512 << 20),
            ("1GiB", 1 << 30),
            ("2Ki", 2_048),
        ] {
            assert_eq!(parse_byte_size(text), Ok(number), "{text}");
        }
        for wrong in [
            "",
            "k",
            "1.5G",
            "-1",
            "3 apples",
            "1TiB",
            "99999999999999999999",
            "18446744073709551615k",
        ] {
            assert!(parse_byte_size(wrong).is_err(), "{wrong}");
        }
    }
}
