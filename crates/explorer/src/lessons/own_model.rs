//! The lesson for the user's own model.

use crate::facts::Facts;
use crate::lesson::{Choice, Lesson, Source, choice, number};
use crate::lesson_scene::{framed, model_scene};
use crate::number_text::{count_triangles, decimals};
use crate::words::{Sentence, sentence, words};
use files::counted;
use scene_file::file::{EnvironmentFile, ProjectionFile, StyleFile};

/// The user's own model in any projection.
pub(super) static MODEL: Lesson = Lesson {
    id: "model",
    source: Source::Own,
    title: words("Your own model", "自己的模型"),
    statement: words(
        "View any model in any projection: everything that holds for the house also holds for your model.",
        "任何模型都可以用任何投影来看：对房子成立的，对它也成立。",
    ),
    models: &[],
    parameters: &[
        choice(
            "projection",
            words("projection", "投影"),
            &[
                Choice { value: "perspective", label: words("perspective", "透视投影") },
                Choice { value: "orthographic", label: words("orthographic", "正交投影") },
                Choice { value: "isometric", label: words("isometric", "正等测") },
                Choice { value: "cavalier", label: words("cavalier", "斜等测") },
                Choice { value: "cabinet", label: words("cabinet", "斜二测") },
                Choice {
                    value: "two-point", label: words("two-point perspective", "两点透视")
                },
            ],
        ),
        number("azimuth", words("azimuth", "方位角"), "°", [-180.0, 180.0], [1.0, 30.0]),
        number("elevation", words("elevation", "仰角"), "°", [-85.0, 85.0], [1.0, 20.0]),
        number(
            "fov",
            words("vertical field of view", "垂直视场角"),
            "°",
            [5.0, 120.0],
            [1.0, 35.0],
        ),
    ],
    pin: [0.0, 0.0, 0.0],
    describe: |values| {
        let [fov] = values.scene_numbers(["fov"]);
        let projection = match values.choice("projection") {
            "orthographic" => ProjectionFile::ORTHOGRAPHIC,
            "isometric" => ProjectionFile::Isometric,
            "cavalier" => ProjectionFile::cavalier(),
            "cabinet" => ProjectionFile::cabinet(),
            "two-point" => ProjectionFile::two_point(),
            _ => ProjectionFile::perspective(fov, None)?,
        };
        let angles = ["azimuth", "elevation"].map(|key| values.number(key));
        // A classical projection determines the viewing direction.
        let from = (!projection.is_classical()).then_some(angles);
        let mut scene =
            model_scene(values.model.unwrap_or_default(), framed(projection, 5.0, from)?)?;
        scene.style = StyleFile::Shaded;
        let strength = 0.5.try_into()?;
        scene.environment = Some(EnvironmentFile::Studio { strength, rotation_degrees: None });
        Ok(scene)
    },
    consequences: |_, facts| describe_model(facts),
    ..Lesson::USUAL
};

/// Describes the size and distance of the model.
pub(super) fn describe_model(facts: &Facts) -> Vec<Sentence> {
    let count = facts.triangles[0];
    let mut all = vec![sentence(
        format!("The model has {}.", count_triangles(count)),
        format!("模型有 {count} 个三角形。"),
    )];
    if facts.loaded.models.triangles.is_reduced() {
        let drawn = facts.loaded.models.triangles.drawn().len();
        all.push(sentence(
            format!(
                "The world and view volume panes show a simplified model with {}.",
                count_triangles(drawn)
            ),
            format!("世界窗格和视见体窗格用形状相同的 {drawn} 个三角形显示。"),
        ));
    }
    if let Some([near, far]) = facts.model_range {
        let [near, far] = [near, far].map(|distance| decimals(distance, 3));
        all.push(match near == far {
            true => sentence(
                format!("The model is {} in front of the camera.", counted(&near, "unit", "units")),
                format!("它在相机前方 {near} 处。"),
            ),
            false => sentence(
                format!("The model is {near} to {far} units in front of the camera."),
                format!("它在相机前方 {near} 到 {far} 处。"),
            ),
        });
    }
    all
}
