//! Flags that change the light of a scene: shadows, the ground, surroundings, exposure and the tone curve.

use clap::ValueEnum;
use pipeline::scene::file::{
    AmbientOcclusionFile, EnvironmentFile, Finite, GroundFile, LightFile, SceneFile, ShadowsFile,
};
use pipeline::shade::ToneMapping;
use std::path::PathBuf;

/// What goes before what the scene says of its light.
#[derive(Clone, Debug, clap::Args)]
#[command(next_help_heading = "Light")]
pub(crate) struct LightArgs {
    /// Light from all around: studio (of strength 0.6, as bare models have it), sky, none, or a .hdr file with a picture of all
    /// directions
    #[arg(long, value_name = "studio|sky|none|FILE", value_parser = parse_environment)]
    environment: Option<EnvironmentArg>,
    /// The exposure in stops, such as 1 or -0.5: each doubles all light
    #[arg(long, value_name = "EV", allow_negative_numbers = true, value_parser = parse_exposure)]
    exposure: Option<Finite>,
    /// The curve that brings bright light into the range of a picture
    #[arg(long, value_name = "CURVE")]
    tone: Option<ToneArg>,
    /// Whether all suns and spots cast shadows; points cast none
    #[arg(long, value_name = "on|off")]
    shadows: Option<SwitchArg>,
    /// A level plane below the models on which only shadows are seen, or none
    #[arg(long)]
    ground: Option<GroundArg>,
    /// Darken corners, by what the picture shows in the way of light from all around
    #[arg(long)]
    ambient_occlusion: bool,
}

#[derive(Clone, Debug)]
enum EnvironmentArg {
    Studio,
    Sky,
    None,
    File(PathBuf),
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum ToneArg {
    /// Light beyond 1 is cut off
    None,
    /// Khronos PBR Neutral: keeps colours but for highlights
    Neutral,
    /// ACES as films have it
    Aces,
    /// AgX
    Agx,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum SwitchArg {
    On,
    Off,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum GroundArg {
    /// Nothing but shadows
    Shadow,
    /// No ground
    None,
}

impl LightArgs {
    pub(super) fn apply_to(&self, file: &mut SceneFile) {
        if let Some(environment) = &self.environment {
            file.environment = Some(environment.to_environment_file());
        }
        if let Some(exposure) = self.exposure {
            file.image.exposure_ev = Some(exposure);
        }
        if let Some(tone) = self.tone {
            file.image.tone_mapping = match tone {
                ToneArg::None => ToneMapping::None,
                ToneArg::Neutral => ToneMapping::Neutral,
                ToneArg::Aces => ToneMapping::Aces,
                ToneArg::Agx => ToneMapping::AgX,
            };
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

    /// The file of the surroundings, if it was named here: a person may read what they have named.
    pub(super) fn environment_file(&self) -> Option<PathBuf> {
        match &self.environment {
            Some(EnvironmentArg::File(path)) => Some(path.clone()),
            _ => None,
        }
    }
}

/// Switches the shadows of all lights; those that the scene has settings for keep them.
fn switch_shadows(file: &mut SceneFile, switch: SwitchArg) {
    let switched_shadows = |known: Option<ShadowsFile>| match (switch, known) {
        (SwitchArg::Off, _) => Some(ShadowsFile::Off),
        (SwitchArg::On, Some(on @ ShadowsFile::On { .. })) => Some(on),
        (SwitchArg::On, _) => Some(ShadowsFile::DEFAULT),
    };
    file.shadows = switched_shadows(file.shadows);
    for light in file.lights.iter_mut().flatten() {
        if let LightFile::Directional { shadows, .. } | LightFile::Spot { shadows, .. } = light {
            *shadows = shadows.and_then(|own| switched_shadows(Some(own)));
        }
    }
}

impl EnvironmentArg {
    fn to_environment_file(&self) -> EnvironmentFile {
        match self {
            Self::Studio => EnvironmentFile::STUDIO,
            Self::Sky => EnvironmentFile::SKY,
            Self::None => EnvironmentFile::Dark,
            Self::File(path) => EnvironmentFile::from_path(path.to_string_lossy().into_owned()),
        }
    }
}

/// Files are told from names by their ending; they are looked for in the current folder.
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
        _ => Err("possible are studio, sky, none and a .hdr file".to_owned()),
    }
}

fn parse_exposure(text: &str) -> Result<Finite, String> {
    let fault = || "expected a number of stops from -30 to 30, such as 1.5".to_owned();
    let stops: f64 = text.parse().map_err(|_| fault())?;
    Finite::new(stops).filter(|stops| stops.value().abs() <= 30.0).ok_or_else(fault)
}
