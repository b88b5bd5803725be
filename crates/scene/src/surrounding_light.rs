//! Resolution of the environment: radiance from all directions, prefiltered for shading.
//!
//! Prefiltering takes most of the time for a small scene, so the last few environments are cached
//! by content, across scenes and threads.

use super::Origin;
use model::ModelInstance;
use picture::Panorama;
use scene_file::PathStep::{self, Field};
use scene_file::SceneError;
use scene_file::file::{BackgroundFile, EnvironmentFile, Finite, SceneFile};
use shade::{Environment, PreethamSky, studio_radiance};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

/// The maximum length of an image file in bytes.
const MAX_FILE_BYTES: u64 = 256 << 20;
/// The maximum width in texels of an image that lights a scene.
const LIGHT_WIDTH: usize = 1024;
/// The maximum width in texels of an image that is also a sharp background.
const SEEN_WIDTH: usize = 4096;
/// The maximum number of environments in the cache.
const MAX_CACHED_ENVIRONMENTS: usize = 4;

/// Whether the models contain lights (KHR_lights_punctual).
pub(super) fn has_lights(models: &[ModelInstance]) -> bool {
    models.iter().any(|placed| placed.model.scene_lights().next().is_some())
}

/// Whether the default light applies: there is no scene file, and no light is specified.
pub(super) fn has_default_light(origin: &Origin, file: &SceneFile) -> bool {
    origin.text.is_empty() && file.lights.is_none()
}

/// Whether the scene may have an environment, before the style is considered.
pub(super) fn may_have_environment(origin: &Origin, file: &SceneFile) -> bool {
    match file.environment {
        Some(EnvironmentFile::Dark) => false,
        Some(_) => true,
        None => has_default_light(origin, file),
    }
}

/// Returns the environment that lights the scene in its style, if any.
///
/// A bare model is placed in the studio, because metals show only their surroundings. If it
/// contains lights, the studio is dimmed so that these remain visible.
pub(super) fn effective_environment(
    origin: &Origin,
    file: &SceneFile,
    models: &[ModelInstance],
) -> Option<EnvironmentFile> {
    let default = || {
        let studio = if has_lights(models) {
            EnvironmentFile::DIMMED_STUDIO
        } else {
            EnvironmentFile::STUDIO
        };
        has_default_light(origin, file).then_some(studio)
    };
    let environment = file.environment.clone().or_else(default);
    environment.filter(|environment| {
        file.style.shows_environment() && *environment != EnvironmentFile::Dark
    })
}

/// The key of an environment: its kind, all its numbers, and a hash of its file's bytes.
type EnvironmentKey = (u8, [u64; 4]);

/// The most recently created environments. Prefiltering an environment takes far longer than
/// finding it here.
static CACHE: Mutex<Vec<(EnvironmentKey, Arc<Environment>)>> = Mutex::new(Vec::new());

/// Returns the environment with this content, either from the cache or newly created.
fn cached_environment(key: EnvironmentKey, make: impl FnOnce() -> Environment) -> Arc<Environment> {
    let mut cache = CACHE.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some((_, known)) = cache.iter().find(|(known, _)| *known == key) {
        return Arc::clone(known);
    }
    let made = Arc::new(make());
    if cache.len() == MAX_CACHED_ENVIRONMENTS {
        cache.remove(0);
    }
    cache.push((key, Arc::clone(&made)));
    made
}

/// Resolves the environment of a scene, if it requests one. Files must be inside the scene's folder
/// or an allowed folder.
///
/// The default studio ignores automatic exposure, which is meant for other lights.
pub(super) fn resolve_environment(
    origin: &Origin,
    file: &SceneFile,
    models: &[ModelInstance],
    allowed: &[PathBuf],
    exposure_ev: f64,
) -> Result<Option<Arc<Environment>>, SceneError> {
    let Some(environment) = effective_environment(origin, file, models) else { return Ok(None) };
    let degrees = |angle: Option<Finite>| angle.map_or(0.0, Finite::value);
    Ok(Some(match &environment {
        EnvironmentFile::Dark => return Ok(None),
        EnvironmentFile::Studio { strength, rotation_degrees } => {
            let is_automatic = file.environment.is_none() && file.image.exposure_ev.is_none();
            let exposure = if is_automatic { libm::exp2(exposure_ev) } else { 1.0 };
            let strength = strength.value() / exposure;
            let turn = EnvironmentRotation::new(strength, degrees(*rotation_degrees));
            cached_environment(turn.cache_key(0, 0), || {
                Environment::from_source(move |way| turn.rotated_radiance(way, studio_radiance))
            })
        }
        EnvironmentFile::Sky { sun, strength } => {
            let sun = normalize_direction(sun.0).ok_or_else(|| {
                let at = [Field("environment"), Field("sun")];
                let help = Some(
                    "use a direction such as (1, 1, 1): to the right, above and in front"
                        .to_owned(),
                );
                origin.error_at(&at, "the direction to the sun must not be (0, 0, 0)", help)
            })?;
            let strength = strength.value() as f32;
            // Cache keys are bit patterns, because f32 is neither `Eq` nor `Ord`.
            let bits = sun.map(|c| u64::from(c.to_bits()));
            let key = (1, [bits[0], bits[1], bits[2], u64::from(strength.to_bits())]);
            let sky = PreethamSky::new(sun);
            cached_environment(key, || {
                Environment::from_source(move |way| sky.radiance(way).map(|c| c * strength))
            })
        }
        EnvironmentFile::Uniform { strength, color } => {
            let light = color.0.map(|c| (c * strength.value()).max(0.0) as f32);
            let bits = light.map(|c| u64::from(c.to_bits()));
            cached_environment((2, [bits[0], bits[1], bits[2], 0]), || {
                Environment::from_radiance(|_| light)
            })
        }
        EnvironmentFile::File { path, strength, rotation_degrees } => {
            let turn = EnvironmentRotation::new(strength.value(), degrees(*rotation_degrees));
            environment_from_file(origin, file, path, turn, allowed)?
        }
    }))
}

/// Returns the environment in an image file, at a finer resolution if the picture shows it.
fn environment_from_file(
    origin: &Origin,
    file: &SceneFile,
    path: &str,
    turn: EnvironmentRotation,
    allowed: &[PathBuf],
) -> Result<Arc<Environment>, SceneError> {
    let at = [Field("environment"), Field("path")];
    let bytes = read_image_bytes(origin, &at, path, allowed)?;
    let is_seen = matches!(
        file.image.background,
        Some(BackgroundFile::Environment { blur }) if blur.is_none_or(|blur| blur.value() == 0.0)
    );
    let (kind, most) = if is_seen { (4, SEEN_WIDTH) } else { (3, LIGHT_WIDTH) };
    let panorama = Panorama::decode_hdr(&bytes, most)
        .map_err(|problem| environment_error(origin, format!("{path}: {problem}"), None))?;
    Ok(cached_environment(turn.cache_key(kind, fnv1a_hash(&bytes)), || {
        let radiance = move |way| turn.rotated_radiance(way, |way| panorama.sample_direction(way));
        if is_seen {
            Environment::from_source(radiance)
        } else {
            Environment::from_radiance(radiance)
        }
    }))
}

/// Creates an error that points at the path of the environment file.
fn environment_error(origin: &Origin, message: String, help: Option<String>) -> SceneError {
    origin.error_at(&[Field("environment"), Field("path")], message, help)
}

/// Reads the file that the scene names in the field `at`. It must be inside the scene's folder or
/// an allowed folder, and must not be too long.
pub(super) fn read_image_bytes(
    origin: &Origin,
    at: &[PathStep<'_>],
    path: &str,
    allowed: &[PathBuf],
) -> Result<Vec<u8>, SceneError> {
    if !origin.allows_path(Path::new(path), allowed) {
        let help = "keep pictures below the scene's folder, or allow another folder with --allow-outside \
             DIR";
        let message = format!("the path \"{path}\" points outside the scene's folder");
        return Err(origin.error_at(at, message, Some(help.to_owned())));
    }
    let full = origin.folder.join(path);
    let unreadable = |cause: std::io::Error| {
        let help = "check the path; it is relative to the folder of the scene".to_owned();
        origin.error_at(at, format!("cannot read {path}: {cause}"), Some(help))
    };
    let about = std::fs::metadata(&full).map_err(unreadable)?;
    if !about.is_file() || about.len() > MAX_FILE_BYTES {
        let message = format!("{path} must be a file of at most {MAX_FILE_BYTES} bytes");
        return Err(origin.error_at(at, message, None));
    }
    std::fs::read(&full).map_err(unreadable)
}

/// A rotation about the y axis and a brightness factor.
struct EnvironmentRotation {
    strength: f32,
    degrees: f64,
    cosine: f32,
    sine: f32,
}

impl EnvironmentRotation {
    /// Creates a rotation about the y axis, in degrees, with a brightness factor.
    fn new(strength: f64, degrees: f64) -> Self {
        let angle = degrees.to_radians();
        let (sine, cosine) = (libm::sin(angle) as f32, libm::cos(angle) as f32);
        Self { strength: strength as f32, degrees, cosine, sine }
    }

    /// Returns the key of an environment with this rotation; `content` identifies its radiance.
    fn cache_key(&self, kind: u8, content: u64) -> EnvironmentKey {
        (kind, [content, self.degrees.to_bits(), u64::from(self.strength.to_bits()), 0])
    }

    /// Returns the radiance from a direction after the surroundings are rotated counterclockwise,
    /// as seen from above.
    fn rotated_radiance(&self, [x, y, z]: [f32; 3], of: impl Fn([f32; 3]) -> [f32; 3]) -> [f32; 3] {
        let before = [x * self.cosine - z * self.sine, y, x * self.sine + z * self.cosine];
        of(before).map(|c| c * self.strength)
    }
}

/// Returns the direction scaled to length 1, or `None` if it is 0 or too long to square.
fn normalize_direction(v: [f64; 3]) -> Option<[f32; 3]> {
    let length = (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt();
    (length > 0.0 && length.is_finite()).then(|| v.map(|c| (c / length) as f32))
}

/// Computes a hash that depends on every byte (Fowler, Noll and Vo).
fn fnv1a_hash(bytes: &[u8]) -> u64 {
    let mix = |sum: u64, byte: &u8| (sum ^ u64::from(*byte)).wrapping_mul(0x0000_0100_0000_01b3);
    bytes.iter().fold(0xcbf2_9ce4_8422_2325 ^ bytes.len() as u64, mix)
}
