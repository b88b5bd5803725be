//! The parts that most lesson scenes share.

use crate::lessons::HOUSE;
use crate::number_text::scene_number;
use scene_file::SceneFile;
use scene_file::file::{
    BackgroundFile, CameraFile, Color, FromFile, InvalidNumber, LightFile, ModelFile,
    ProjectionFile, StyleFile, ViewFile,
};

/// The background color of lesson pictures.
const BACKGROUND: Color = Color([0xee, 0xf2, 0xf5]);

/// The scene of a lesson, or an error for a number that scenes do not allow.
pub(crate) type LessonScene = Result<SceneFile, InvalidNumber>;

/// Returns a scene with one model in the lessons' lighting.
pub(crate) fn model_scene(path: &str, camera: CameraFile) -> LessonScene {
    let mut scene = SceneFile::new([ModelFile::new(path)]);
    scene.camera = camera;
    let key_light = LightFile::directional([-1.0, -2.0, -1.5], 2.0)?;
    scene.lights = Some(vec![key_light, LightFile::ambient(0.9)?]);
    scene.style = StyleFile::Flat;
    scene.image.background = Some(BackgroundFile::Color(BACKGROUND));
    Ok(scene)
}

/// Returns a scene with the house as most lessons show it.
pub(crate) fn house_scene(projection: ProjectionFile) -> LessonScene {
    let camera = CameraFile::look_at([4.0, 3.0, 10.0], [0.0, 2.2, 0.0]);
    model_scene(HOUSE, camera.with_projection(projection))
}

/// Returns a camera that frames the model with a margin in percent. It looks from an azimuth and an
/// elevation in degrees or, for `None`, from the projection's default direction.
pub(crate) fn framed(
    projection: ProjectionFile,
    padding_percent: f64,
    from: Option<[f64; 2]>,
) -> Result<CameraFile, InvalidNumber> {
    let from = from.map(|angles| {
        let [(sa, ca), (se, ce)] = angles.map(|angle| libm::sincos(angle.to_radians()));
        FromFile::Direction([sa * ce, se, ca * ce].map(scene_number).into())
    });
    let view = ViewFile::Frame { from, padding_percent: padding_percent.try_into()? };
    Ok(CameraFile { view, ..CameraFile::default() }.with_projection(projection))
}

/// Returns the house as a line drawing on white, framed with a margin in percent.
pub(crate) fn line_drawing(projection: ProjectionFile, padding_percent: f64) -> LessonScene {
    let mut scene = model_scene(HOUSE, framed(projection, padding_percent, None)?)?;
    scene.style = StyleFile::lines_hidden_removed();
    scene.image.background = Some(BackgroundFile::Color(Color::WHITE));
    Ok(scene)
}
