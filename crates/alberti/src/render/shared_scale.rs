//! One scale for all `--views`: `--same-scale`.

use crate::CliError;
use crate::scene_overrides::SceneOverrideArgs;
use camera::NamedView;
use pipeline::{Origin, Scene};
use scene_file::SceneFile;
use scene_file::file::{EnvironmentFile, ViewportsScale};

/// Sets the scale of a scene's view to the smallest scale of all `--views`.
///
/// All views share the scene's models and are resolved without viewports, overlays and backgrounds,
/// which do not affect the scale.
///
/// # Errors
/// Returns an error if a view has a perspective projection, which has no uniform scale.
pub(super) fn share_scale(
    views: &[NamedView],
    origin: &Origin,
    file: &SceneFile,
    scene: &mut Scene,
) -> Result<(), CliError> {
    let mut shared = f64::INFINITY;
    for &view in views {
        let mut other = file.clone();
        (other.viewports, other.stereo, other.overlays) = (Vec::new(), None, Vec::new());
        other.viewports_scale = ViewportsScale::Individual;
        other.image.background = None;
        // Reading an environment takes time and does not affect the scale.
        if let Some(EnvironmentFile::File { .. }) = other.environment {
            other.environment = Some(EnvironmentFile::STUDIO);
        }
        SceneOverrideArgs::aim_from(&mut other.camera, view);
        let other = Scene::from_models(origin, &other, &scene.models)?;
        let scale = other.pixels_per_unit().ok_or_else(|| {
            CliError::Usage(
                "--same-scale needs a parallel projection\n  = help: set --projection to orthographic or another parallel projection"
                    .to_owned(),
            )
        })?;
        shared = shared.min(scale);
    }
    scene.set_pixels_per_unit(shared);
    Ok(())
}
