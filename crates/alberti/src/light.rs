//! Lighting flags: environment, exposure, tone mapping, shadows, ground, ambient occlusion.
//!
//! They change the parsed scene file, not the resolved scene, so that a flag and the corresponding
//! field have the same meaning and the same checks.

use super::CliError;
use super::options::option_parser;
use clap::ValueEnum;
use pipeline::Origin;
use pipeline::shade::ToneMapping;
use scene_file::file::{
    AmbientOcclusionFile, EnvironmentFile, Finite, GroundFile, LightFile, NonNegative, SceneFile,
    ShadowsFile, Triple,
};
use std::path::PathBuf;

/// Flags that replace the scene's lighting.
#[derive(Clone, Debug, clap::Args)]
#[command(next_help_heading = "Light")]
pub(crate) struct LightArgs {
    /// Environment light: studio, sky, none, or a .hdr file
    ///
    /// `studio` has strength 0.45, as it does for models without a scene file. A .hdr file contains
    /// an equirectangular map in Radiance format.
    #[arg(long, value_name = "studio|sky|none|FILE", value_parser = parse_environment)]
    environment: Option<EnvironmentArg>,
    /// Rotate the environment by this angle, counterclockwise as seen from above
    #[arg(long, value_name = "DEGREES", allow_hyphen_values = true, value_parser = parse_rotation)]
    environment_rotation: Option<Finite>,
    /// Multiply the intensity of all lights, but not of the environment, by a factor from 0 to 1000
    ///
    /// --exposure changes all light, including the environment.
    #[arg(long, value_name = "FACTOR", value_parser = parse_light_intensity)]
    light_intensity: Option<NonNegative>,
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
    /// Soft boxes, also used for a bare model without lights.
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
    /// Shadow catcher: invisible except for the shadows on it, all of which fit in the picture
    Shadow,
    /// The same, but only the models are framed, so shadows may extend beyond the picture
    CroppedShadow,
    /// No ground
    None,
}

impl LightArgs {
    /// Replaces the lighting of a scene with the settings from the flags.
    ///
    /// Fields without a flag keep the scene's values. `--ambient-occlusion` keeps the scene's
    /// radius, if it has one.
    ///
    /// # Errors
    /// Returns an error if the environment's file is missing, or if no environment can be rotated.
    pub(super) fn apply_to(&self, origin: &Origin, file: &mut SceneFile) -> Result<(), CliError> {
        if let Some(environment) = &self.environment {
            environment.check_file()?;
            file.environment = Some(environment.to_environment_file());
        }
        if let Some(angle) = self.environment_rotation {
            // A model without a scene file is lit by the studio.
            if file.environment.is_none() && origin.text.is_empty() {
                file.environment = Some(EnvironmentFile::STUDIO);
            }
            turn_environment(&mut file.environment, angle.value())?;
        }
        if let Some(factor) = self.light_intensity {
            file.light_intensity = factor;
        }
        if let Some(exposure) = self.exposure {
            file.image.exposure_ev = Some(exposure);
        }
        if let Some(curve) = self.tone_mapping {
            file.image.tone_mapping = Some(curve);
        }
        match self.ground {
            Some(GroundArg::Shadow) => file.ground = Some(GroundFile::DEFAULT),
            Some(GroundArg::CroppedShadow) => {
                file.ground = Some(GroundFile::Shadow { height: None, framed: false });
            }
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
        Ok(())
    }

    /// Returns the flags in use that change the light on surfaces. If the environment is visible
    /// behind the models, flags that change its appearance are omitted.
    pub(super) fn light_flags(&self, shows_environment: bool) -> Vec<&'static str> {
        let lights = self.environment.as_ref().is_some_and(EnvironmentArg::is_light);
        let flags = [
            ("--environment", lights && !shows_environment),
            ("--environment-rotation", self.environment_rotation.is_some() && !shows_environment),
            ("--light-intensity", self.light_intensity.is_some()),
            ("--exposure", self.exposure.is_some() && !shows_environment),
            ("--tone-mapping", self.tone_mapping.is_some() && !shows_environment),
        ];
        given_flags(&flags)
    }

    /// Returns the flags in use that darken surfaces. If there is a ground plane, `--shadows` is
    /// omitted, because shadows are visible on the ground.
    pub(super) fn shadow_flags(&self, has_ground: bool) -> Vec<&'static str> {
        let shadows = matches!(self.shadows, Some(SwitchArg::On)) && !has_ground;
        given_flags(&[("--shadows", shadows), ("--ambient-occlusion", self.ambient_occlusion)])
    }

    /// Returns the ground flag, if it is in use.
    pub(super) fn ground_flags(&self) -> Vec<&'static str> {
        given_flags(&[("--ground", matches!(self.ground, Some(GroundArg::Shadow)))])
    }

    /// Returns the path of the environment map if the flag names a file; any folder is allowed.
    ///
    /// A path in a scene file may be untrusted, so it is confined to the scene's folder. A path on
    /// the command line comes from the user, who may read any file.
    pub(super) fn environment_file(&self) -> Option<PathBuf> {
        match &self.environment {
            Some(EnvironmentArg::File(path)) => Some(path.clone()),
            _ => None,
        }
    }
}

/// Returns the flags that are in use.
fn given_flags(flags: &[(&'static str, bool)]) -> Vec<&'static str> {
    flags.iter().filter(|(_, is_given)| *is_given).map(|(name, _)| *name).collect()
}

/// Rotates an environment about the y axis, counterclockwise as seen from above.
///
/// The rotation does not affect a uniform environment.
///
/// # Errors
/// Returns an error if the scene has no environment.
fn turn_environment(file: &mut Option<EnvironmentFile>, degrees: f64) -> Result<(), CliError> {
    match file {
        Some(
            EnvironmentFile::Studio { rotation_degrees, .. }
            | EnvironmentFile::File { rotation_degrees, .. },
        ) => {
            let before = rotation_degrees.map_or(0.0, Finite::value);
            *rotation_degrees = Finite::new(before + degrees);
        }
        Some(EnvironmentFile::Sky { sun: Triple([x, _, z]), .. }) => {
            let (sin, cos) = (libm::sin(degrees.to_radians()), libm::cos(degrees.to_radians()));
            (*x, *z) = (*x * cos + *z * sin, *z * cos - *x * sin);
        }
        Some(EnvironmentFile::Uniform { .. }) => {}
        None | Some(EnvironmentFile::Dark) => {
            return Err(CliError::Usage(
                "--environment-rotation has no environment to rotate\n  = help: add --environment studio, --environment sky or --environment FILE.hdr"
                    .to_owned(),
            ));
        }
    }
    Ok(())
}

/// Enables or disables the shadows of all lights, and keeps the parameters that the scene sets.
///
/// `off` disables them for the scene and for every light that overrides the scene's setting. `on`
/// keeps the parameters of lights that have shadows, and sets the defaults for other lights. Lights
/// that only inherit the setting keep inheriting it.
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
    /// Whether the environment emits light.
    const fn is_light(&self) -> bool {
        !matches!(self, Self::None)
    }

    /// Checks that the file of an environment exists.
    fn check_file(&self) -> Result<(), CliError> {
        match self {
            Self::File(path) if !path.is_file() => {
                let folder = std::env::current_dir().unwrap_or_default();
                let name = path.strip_prefix(folder).unwrap_or(path).display();
                let message = if path.exists() {
                    format!("--environment {name}: not a file; specify a .hdr file")
                } else {
                    format!("--environment {name}: the file does not exist; check the name")
                };
                Err(CliError::Usage(message))
            }
            _ => Ok(()),
        }
    }

    /// Returns the environment as a field of a scene.
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
/// the current one. A preset takes precedence over a file with that name; `./sky.hdr` is always a
/// file.
///
/// # Errors
/// Returns an error if the text is neither a preset nor the name of a `.hdr` file.
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

/// Parses an angle in degrees.
fn parse_rotation(text: &str) -> Result<Finite, String> {
    let angle = text.parse().ok().and_then(Finite::new);
    angle.ok_or_else(|| "expected an angle in degrees, such as 90".to_owned())
}

/// Parses a factor from 0 to 1000.
fn parse_light_intensity(text: &str) -> Result<NonNegative, String> {
    let factor = text.parse().ok().filter(|factor| (0.0..=1000.0).contains(factor));
    factor
        .and_then(NonNegative::new)
        .ok_or_else(|| "expected a factor from 0 to 1000, such as 2 or 0.5".to_owned())
}

/// Parses a number of stops from −30 to 30.
///
/// Thirty stops are a factor of about 10⁹, which is more than any scene needs and fits in `f32`.
fn parse_exposure(text: &str) -> Result<Finite, String> {
    let fault = || "expected a number of stops from -30 to 30, such as 1.5".to_owned();
    let stops: f64 = text.parse().map_err(|_| fault())?;
    Finite::new(stops).filter(|stops| stops.value().abs() <= 30.0).ok_or_else(fault)
}
