//! The `ron` options for scenes.

use ron::Options;
use ron::extensions::Extensions;

/// Returns the `ron` options for reading and writing scene files: the extensions `implicit_some`,
/// `unwrap_newtypes` and `unwrap_variant_newtypes`, so that no file has to begin with an attribute.
///
/// With these options, any `ron` function reads scenes and their parts:
///
/// ```
/// use scene_file::file::{ModelFile, SceneFile};
///
/// let options = scene_file::scene_ron_options();
/// let model: ModelFile = options.from_str("(path: \"duck.glb\", scale: 2)")?;
/// let scene = SceneFile { models: vec![model], ..SceneFile::default() };
/// let text = options.to_string(&scene)?;
/// assert_eq!(text, "(models:[(path:\"duck.glb\",scale:2)])");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[must_use]
pub fn scene_ron_options() -> Options {
    Options::default()
        .with_default_extension(Extensions::IMPLICIT_SOME)
        .with_default_extension(Extensions::UNWRAP_NEWTYPES)
        .with_default_extension(Extensions::UNWRAP_VARIANT_NEWTYPES)
}
