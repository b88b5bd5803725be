//! The description of a state as JSON.

use crate::ExplorerError;
use crate::depth_pane::depth_table_json;
use crate::facts::{Facts, PLANES};
use crate::lesson::ParameterValue;
use crate::lesson_state::style_flag;
use crate::model_store::LoadedScene;
use crate::number_text::count_triangles;
use crate::pane_scene::COLORS;
use crate::request::Request;
use crate::words::{Sentence, sentence};
use explain::{ApiConventions, TransformChain, explain_point, explain_transforms};
use homog::{Affine, Point, Screen};
use serde_json::{Map, Value as Json, json};

/// Returns the state as JSON: link, scene file, command, sentences, numbers, matrices and journey.
///
/// # Errors
/// Returns an error if the view has no pixels.
pub(crate) fn state_json(
    request: &Request,
    text: &str,
    loaded: &LoadedScene,
    facts: &Facts,
) -> Result<Json, ExplorerError> {
    let state = &request.state;
    let lesson = state.lesson;
    let values = state.values(request.size);
    let size = (facts.size[0], facts.size[1]);
    let chain =
        TransformChain::new(&facts.view_projection, size, lesson.conventions).map_err(|error| {
            ExplorerError::new("cannot_render", error.to_string(), "make the picture larger")
        })?;
    let mut consequences = (lesson.consequences)(&values, facts);
    consequences.extend(clipping_sentences(facts));
    let pin = Point::from(state.pin(loaded));
    let outcode = chain.clip_volume().outcode(chain.world_to_clip().transform_point(pin));
    let outside_of: Vec<String> = outcode.planes().map(|plane| plane.to_string()).collect();
    let parameters = lesson.parameters.iter().zip(&state.parameters);
    let parameters: Map<String, Json> = parameters
        .map(|(parameter, value)| (parameter.key.to_owned(), value_json(*value)))
        .collect();
    Ok(json!({
        "lesson": lesson.id,
        "parameters": parameters,
        "link": state.to_link(),
        "scene": (!state.is_torn()).then_some(text),
        "command": (!state.is_torn()).then(|| command(request, text)),
        "consequences": consequences.iter().map(Sentence::to_json).collect::<Vec<_>>(),
        "facts": facts.to_json(),
        "colors": COLORS.map(|(name, [r, g, b])| (name, format!("#{r:02x}{g:02x}{b:02x}"))).into_iter().collect::<std::collections::BTreeMap<_, _>>(),
        "conventions": lesson.conventions.name(),
        "matrix": explain_transforms(&chain).to_json(),
        "journey": journey_json(&chain, pin, loaded, lesson.conventions),
        "depth_table": lesson.panes.contains(&"depth").then(|| depth_table_json(facts, lesson.conventions)).flatten(),
        "pin": <[f64; 3]>::from(pin),
        "orbit": state.orbit(),
        "volume_orbit": state.volume_orbit(),
        "outcode": {
            "bits": format!("{:06b}", outcode.bits()),
            "is_inside": outcode.is_inside(),
            "outside_of": outside_of,
        },
    }))
}

fn value_json(value: ParameterValue) -> Json {
    match value {
        ParameterValue::Number(number) => number.into(),
        ParameterValue::Choice(choice) => choice.into(),
    }
}

/// Returns the command that renders the same picture when run in the folder with the models.
fn command(request: &Request, text: &str) -> String {
    let Request { state, size: [width, height], samples, .. } = request;
    match &state.model {
        Some(file) if state.lesson.draws_own_file() => {
            let style = state.style.map(|style| format!(" --style {}", style_flag(style)));
            let style = style.unwrap_or_default();
            let name = file.replace('\'', "'\\''");
            format!("alberti render '{name}' --size {width}x{height} --samples {samples}{style}\n")
        }
        _ => {
            format!("alberti render - -o {}.png <<'SCENE'\n{text}SCENE\n", state.lesson.id)
        }
    }
}

/// Explains a point and returns its coordinates in each space.
fn journey_json(
    chain: &TransformChain,
    pin: Point<homog::World>,
    loaded: &LoadedScene,
    conventions: ApiConventions,
) -> Json {
    let clip = chain.world_to_clip().transform_point(pin);
    let ndc = clip.divide();
    let screen =
        chain.project_to_screen(clip).map(|screen| in_picture(screen, loaded, conventions));
    // Without triangles, as in a point cloud, only the model's placement in the scene is known.
    let placed = || Some(loaded.scene.models.first()?.model_to_world);
    let mesh_to_world = loaded.models.triangles.mesh_to_world_at(pin).or_else(placed);
    let world_to_mesh = mesh_to_world.and_then(Affine::inverse);
    let model = world_to_mesh.map(|to_mesh| <[f64; 3]>::from(to_mesh.transform_point(pin)));
    let view = chain.world_to_view().transform_point(pin);
    let mut json = explain_point(chain, pin).to_json();
    json["spaces"] = json!([
        {"space": "model", "label": {"en": "model", "zh": "模型坐标"}, "value": model},
        {"space": "world", "label": {"en": "world", "zh": "世界坐标"}, "value": <[f64; 3]>::from(pin)},
        {"space": "view", "label": {"en": "view (camera)", "zh": "观察坐标"}, "value": <[f64; 3]>::from(view)},
        {"space": "clip", "label": {"en": "clip, before the divide by w", "zh": "裁剪坐标（透视除法之前）"}, "value": <[f64; 4]>::from(clip)},
        {"space": "ndc", "label": {"en": "NDC, after the divide", "zh": "规范化设备坐标（透视除法之后）"}, "value": ndc.map(<[f64; 3]>::from)},
        {"space": "screen", "label": {"en": "screen: pixel, pixel, depth", "zh": "屏幕坐标：像素与深度"}, "value": screen},
    ]);
    json
}

/// Converts screen coordinates of the first view to coordinates of the whole picture by adding the
/// viewport's offset.
fn in_picture(
    screen: Point<Screen>,
    loaded: &LoadedScene,
    conventions: ApiConventions,
) -> [f64; 3] {
    let [x, y, depth] = <[f64; 3]>::from(screen);
    let Some(inset) = loaded.scene.insets.get(loaded.first_view) else { return [x, y, depth] };
    let below = loaded.scene.image.height - inset.rect.y - inset.rect.height;
    let runs_up = matches!(conventions, ApiConventions::OpenGl | ApiConventions::Chapter);
    let corner = [inset.rect.x, if runs_up { below } else { inset.rect.y }].map(f64::from);
    [x + corner[0], y + corner[1], depth]
}

const PLANES_ZH: [&str; 6] = ["左", "右", "下", "上", "近", "远"];

/// Returns the verb for a number of triangles.
const fn is_or_are(count: usize) -> &'static str {
    if count == 1 { "is" } else { "are" }
}

/// Returns sentences about the parts outside the view volume.
fn clipping_sentences(facts: &Facts) -> Vec<Sentence> {
    let survey = facts.survey;
    let all = facts.triangles[1];
    let triangles = count_triangles(all);
    let mut sentences = Vec::new();
    for (at, (plane, plane_zh)) in PLANES.iter().zip(PLANES_ZH).enumerate() {
        let (clipped, outside) = (survey.clipped_by[at], survey.outside_of[at]);
        let (are, is_or_are) = (is_or_are(clipped), is_or_are(outside));
        match (clipped, outside) {
            (0, 0) => {}
            (clipped, 0) => sentences.push(sentence(
                format!("{clipped} of {triangles} {are} clipped by the {plane} plane."),
                format!("{all} 个三角形中有 {clipped} 个被{plane_zh}平面裁剪。"),
            )),
            (0, outside) => sentences.push(sentence(
                format!("{outside} of {triangles} {is_or_are} entirely outside the {plane} plane."),
                format!("{all} 个三角形中有 {outside} 个完全在{plane_zh}平面之外。"),
            )),
            (clipped, outside) => sentences.push(sentence(
                format!("{clipped} of {triangles} {are} clipped by the {plane} plane, and {outside} {is_or_are} entirely outside it."),
                format!("{all} 个三角形中有 {clipped} 个被{plane_zh}平面裁剪，{outside} 个完全在它之外。"),
            )),
        }
    }
    sentences.extend(overlap_sentence(facts));
    if survey.inside == all && all > 0 {
        sentences.push(sentence(
            "The whole model is inside the view volume, so nothing is clipped.",
            "整个模型都在视见体之内：没有任何裁剪。",
        ));
    }
    if survey.inside + survey.clipped == 0 && all > 0 {
        sentences.push(sentence(
            "No part of the model is inside the view volume, so the picture is empty.",
            "模型完全在视见体之外：图像是空的。",
        ));
    }
    sentences
}

/// Returns the total numbers of clipped and outside triangles if planes share some of them.
fn overlap_sentence(facts: &Facts) -> Option<Sentence> {
    let survey = facts.survey;
    let totals = [(survey.clipped, survey.clipped_by), (survey.outside, survey.outside_of)];
    let overlaps = totals.iter().any(|(total, by_plane)| by_plane.iter().sum::<usize>() > *total);
    let [(clipped, _), (outside, _)] = totals;
    overlaps.then(|| {
        sentence(
            format!(
                "Some triangles are counted under several planes: in total, {clipped} are clipped and {outside} are entirely outside."
            ),
            format!("有些三角形对几个平面都计数：总共有 {clipped} 个被裁剪，{outside} 个完全在外。"),
        )
    })
}
