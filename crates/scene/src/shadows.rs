//! Resolution of shadow settings: the size of the shadow map and the softness of its shadows.

use super::Origin;
use scene_file::PathStep::{self, Field};
use scene_file::SceneError;
use scene_file::file::ShadowsFile;
use shade::Shadow;

/// The default number of texels along a shadow map's longer side.
const DEFAULT_MAP_SIZE: u32 = 2048;
/// The default softness: the apparent diameter of the sun from Earth, in degrees.
const DEFAULT_SOFTNESS_DEGREES: f64 = 0.53;

/// Resolves the shadow settings at `path`.
pub(super) fn resolve_shadow(
    origin: &Origin,
    file: Option<&ShadowsFile>,
    path: &[PathStep<'_>],
) -> Result<Option<Shadow>, SceneError> {
    let Some(&ShadowsFile::On { size, softness_degrees }) = file else { return Ok(None) };
    let size = size.unwrap_or(DEFAULT_MAP_SIZE);
    if !(64..=8192).contains(&size) {
        let message = format!("invalid shadow map size: {size} texels per side");
        let path: Vec<PathStep<'_>> = path.iter().copied().chain([Field("size")]).collect();
        let help = Some("use 64 to 8192, such as 2048".to_owned());
        return Err(origin.error_at(&path, message, help));
    }
    let degrees =
        softness_degrees.map_or(DEFAULT_SOFTNESS_DEGREES, scene_file::file::Softness::value);
    Ok(Some(Shadow { resolution: size, softness: degrees.to_radians() as f32 }))
}
