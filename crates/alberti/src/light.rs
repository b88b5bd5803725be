//! Flags about light: environment, exposure, tone mapping, shadows, ground, ambient occlusion.
//!
//! They change the parsed scene file, not the resolved scene, so that a flag and the field of the
//! scene file have one meaning and one set of checks.

use super::options::option_parser;
use clap::ValueEnum;
use pipeline::scene::file::{
    AmbientOcclusionFile, EnvironmentFile, Finite, GroundFile, LightFile, SceneFile, ShadowsFile,
};
use pipeline::shade::ToneMapping;
use std::path::PathBuf;

/// Flags that replace the light of the scene.
#[derive(Clone, Debug, clap::Args)]
#[command(next_help_heading = "Light")]
pub(crate) struct LightArgs {
    /// Environment light: studio, sky, none, or a .hdr file
    ///
    /// `studio` has strength 0.45, as for models without a scene file. A .hdr file is an
    /// equirectangular Radiance map.
    #[arg(long, value_name = "studio|sky|none|FILE", value_parser = parse_environment)]
    environment: Option<EnvironmentArg>,
    /// Exposure in stops, such as 1 or -0.5; each stop doubles the light
    #[arg(long, value_name = "EV", allow_hyphen_values = true, value_parser = parse_exposure)]
    exposure: Option<Finite>,
    /// Tone mapping: the curve that compresses bright light into the range of a picture
    #[arg(long, value_name = "CURVE", value_parser = option_parser::<ToneMapping>())]
    tone_mapping: Option<ToneMapping>,
    /// Enable or disable the shadows of all directional, point and spot lights
    #[arg(long, value_name = "on|off")]
    shadows: Option<SwitchArg>,
    /// Ground plane below the models
    #[arg(long)]
    ground: Option<GroundArg>,
    /// Enable screen-space ambient occlusion
    #[arg(long)]
    ambient_occlusion: bool,
}

/// The value of `--environment`.
#[derive(Clone, Debug)]
enum EnvironmentArg {
    /// Soft boxes, also the light of a bare model without lights.
    Studio,
    /// A clear sky over gray ground, without the sun itself.
    Sky,
    /// No environment light; the lights of the scene remain.
    None,
    /// An equirectangular `.hdr` file, as an absolute path.
    File(PathBuf),
}

/// The value of `--shadows`.
#[derive(Clone, Copy, Debug, ValueEnum)]
enum SwitchArg {
    On,
    Off,
}

/// The value of `--ground`.
#[derive(Clone, Copy, Debug, ValueEnum)]
enum GroundArg {
    /// Shadow catcher: invisible except for the shadows on it
    Shadow,
    /// No ground
    None,
}

impl LightArgs {
    /// Replaces the light of a scene by the flags that were given.
    ///
    /// Fields without a flag stay as the scene has them. `--ambient-occlusion` keeps the radius of
    /// a scene that has one.
    pub(super) fn apply_to(&self, file: &mut SceneFile) {
        if let Some(environment) = &self.environment {
            file.environment = Some(environment.to_environment_file());
        }
        if let Some(exposure) = self.exposure {
            file.image.exposure_ev = Some(exposure);
        }
        if let Some(curve) = self.tone_mapping {
            file.image.tone_mapping = Some(curve);
        }
        match self.ground {
            Some(GroundArg::Shadow) => file.ground = Some(GroundFile::DEFAULT),
            Some(GroundArg::None) => file.ground = None,
            None => {}
        }
        if self.ambient_occlusion {
            let usual = AmbientOcclusionFile { radius: None };
            file.ambient_occlusion = Some(file.ambient_occlusion.unwrap_or(usual));
        }
        if let Some(shadows) = self.shadows {
            switch_shadows(file, shadows);
        }
    }

    /// The environment map, if a file was given: it may be read wherever it is.
    ///
    /// A path in a scene file may come from elsewhere and is confined to the scene's folder; a
    /// path on the command line comes from the user, who may read any file.
    pub(super) fn environment_file(&self) -> Option<PathBuf> {
        match &self.environment {
            Some(EnvironmentArg::File(path)) => Some(path.clone()),
            _ => None,
        }
    }
}

/// Enables or disables the shadows of all lights; settings of the scene are kept.
///
/// `off` disables them for the scene and for every light that overrides the scene. `on` keeps the
/// parameters of lights that have shadows, and gives default ones to others. Lights that only
/// inherit the setting keep inheriting it.
fn switch_shadows(file: &mut SceneFile, switch: SwitchArg) {
    let switched_shadows = |known: Option<ShadowsFile>| match (switch, known) {
        (SwitchArg::Off, _) => Some(ShadowsFile::Off),
        (SwitchArg::On, Some(on @ ShadowsFile::On { .. })) => Some(on),
        (SwitchArg::On, _) => Some(ShadowsFile::DEFAULT),
    };
    file.shadows = switched_shadows(file.shadows);
    for light in file.lights.iter_mut().flatten() {
        if let LightFile::Directional { shadows, .. }
        | LightFile::Point { shadows, .. }
        | LightFile::Spot { shadows, .. } = light
        {
            *shadows = shadows.and_then(|own| switched_shadows(Some(own)));
        }
    }
}

impl EnvironmentArg {
    /// The environment as a field of a scene.
    fn to_environment_file(&self) -> EnvironmentFile {
        match self {
            Self::Studio => EnvironmentFile::STUDIO,
            Self::Sky => EnvironmentFile::SKY,
            Self::None => EnvironmentFile::Dark,
            Self::File(path) => EnvironmentFile::from_path(path.to_string_lossy().into_owned()),
        }
    }
}

/// Parses a preset, or the path of a `.hdr` file relative to the current folder.
///
/// The path is made absolute, because paths in a scene are relative to the scene's folder, not to
/// the current one. A preset takes precedence over a file of that name; `./sky.hdr` is always a
/// file.
///
/// # Errors
/// If the text is neither a preset nor the name of a `.hdr` file.
fn parse_environment(text: &str) -> Result<EnvironmentArg, String> {
    let path = PathBuf::from(text);
    match text {
        "studio" => Ok(EnvironmentArg::Studio),
        "sky" => Ok(EnvironmentArg::Sky),
        "none" => Ok(EnvironmentArg::None),
        _ if path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("hdr")) => {
            let full = std::path::absolute(&path).map_err(|error| error.to_string())?;
            Ok(EnvironmentArg::File(full))
        }
        _ => Err("expected studio, sky, none or a .hdr file".to_owned()),
    }
}

/// Parses a number of stops from −30 to 30.
///
/// Thirty stops are a factor of about 10⁹, more than any scene needs and less than would overflow
/// 32-bit floats.
fn parse_exposure(text: &str) -> Result<Finite, String> {
    let fault = || "expected a number of stops from -30 to 30, such as 1.5".to_owned();
    let stops: f64 = text.parse().map_err(|_| fault())?;
    Finite::new(stops).filter(|stops| stops.value().abs() <= 30.0).ok_or_else(fault)
}
