//! `alberti info --json`: the contents of a model as JSON.
//!
//! Objects are in file order, with indices from 0. Lengths are in units of the model, angles in
//! radians and times in seconds; colors are linear. Absent values are `null` or empty lists. New
//! members may be added in any release; [`VERSION`] increases when a member is removed or changes
//! its meaning.
//!
//! ```json
//! {
//!   "schema": {"name": "alberti-info", "version": 1},
//!   "file": "fox.glb", "name": "fox.glb",
//!   "shown": {"scene": 0, "variant": null, "animation": null, "time": null, "meshes": 1},
//!   "counts": {"primitives": 1, "vertices": 1728, "triangles": 576, "lines": 0, "points": 0},
//!   "scenes": [], "nodes": [], "meshes": [], "materials": [], "textures": [], "images": []
//! }
//! ```
//! (Shortened: `shown` also contains bounds and counts; lists of cameras, lights, skins,
//! animations, variants, extensions and warnings follow.)

use super::materials::{images_json, materials_json, textures_json};
use super::scenes::{cameras_json, lights_json, meshes_json, nodes_json, scenes_json};
use crate::args::InfoArgs;
use crate::model_state::ModelStateArgs;
use homog::Bounds;
use import::{ExtensionUse, extension_use};
use model::{
    Animation, AnimationChannel, AnimationTarget, Interpolation, Model, NodeProperty, Primitive,
    Skin, Topology, UvTransform, UvTransformPart,
};
use scene_file::file::Finite;
use serde_json::{Value, json};

/// The version of the JSON schema.
const VERSION: u32 = 1;

/// Returns the document as text, with a final newline.
///
/// `shown` describes the drawn scene in its pose, counting instances; the top-level `counts`
/// describes the file. `animation` and `time` are `null` unless a flag has posed the model.
pub(super) fn info_document(args: &InfoArgs, model: &Model) -> String {
    let ModelStateArgs { animation, time, .. } = &args.model_state;
    let posed = animation.is_some() || time.is_some();
    let value = json!({
        "schema": {"name": "alberti-info", "version": VERSION},
        "file": args.file.to_string_lossy(),
        "name": model.name,
        "unit": model.length_unit.symbol(),
        "up": model.up_axis.letter(),
        "shown": {
            "scene": model.active_scene,
            "variant": model.active_variant,
            "animation": posed.then(|| chosen_animation_index(args, model)),
            "time": posed.then(|| time.map_or(0.0, Finite::value)),
            "bounds": bounds_json(model.bounds()),
            "counts": counts_json(model.scene_primitives().map(|(_, primitive)| primitive)),
            "meshes": model.mesh_instances().count(),
        },
        "counts": counts_json(model.meshes.iter().flat_map(|mesh| &mesh.primitives)),
        "scenes": scenes_json(model),
        "nodes": nodes_json(model),
        "meshes": meshes_json(model),
        "materials": materials_json(model),
        "textures": textures_json(model),
        "images": images_json(model),
        "cameras": cameras_json(model),
        "lights": lights_json(model),
        "skins": model.skins.iter().map(skin_json).collect::<Vec<_>>(),
        "animations": model.animations.iter().map(|of| animation_json(model, of)).collect::<Vec<_>>(),
        "variants": model.variants,
        "scalar_attributes": model.scalar_attributes,
        "extensions": extensions_json(model),
        "warnings": warnings_json(model),
    });
    format!("{value:#}\n")
}

/// Returns the index of the animation that poses the model.
///
/// `None` cannot occur for a loaded model, because an invalid choice has already ended the command.
fn chosen_animation_index(args: &InfoArgs, model: &Model) -> Option<usize> {
    scene::select_animation(model, args.model_state.animation.as_ref()).ok()
}

/// Returns an `f32` as the shortest decimal number that rounds to it: 0.8, not 0.800000011920929.
///
/// glTF stores factors as 32-bit floats; widened to 64 bits, they would show digits that are not in
/// the file. NaN and infinities become `null`, because JSON has no such numbers.
pub(super) fn shortest_number(x: f32) -> Value {
    x.to_string().parse::<f64>().map_or(Value::Null, Value::from)
}

/// Returns several numbers, each as [`shortest_number`] returns it.
pub(super) fn shortest_numbers(numbers: &[f32]) -> Vec<Value> {
    numbers.iter().copied().map(shortest_number).collect()
}

/// Returns bounds as two points, or `null`.
///
/// Coordinates are 64-bit, because the bounds are computed in that precision.
pub(super) fn bounds_json<S: homog::Space>(of: Option<Bounds<S>>) -> Value {
    of.map_or(Value::Null, |bounds| {
        let [min, max] = [bounds.min(), bounds.max()].map(<[f64; 3]>::from);
        json!({"min": min, "max": max})
    })
}

/// Returns the totals over these primitives: vertices, triangles, lines and points.
///
/// `items` is indexed by an item's vertex count minus one: points, lines, triangles.
pub(super) fn counts_json<'a>(primitives: impl Iterator<Item = &'a Primitive>) -> Value {
    let (mut parts, mut vertices, mut items) = (0_usize, 0_usize, [0_usize; 3]);
    for primitive in primitives {
        parts += 1;
        vertices += primitive.positions.len();
        items[primitive.topology.vertices_per_item() - 1] += primitive.item_count();
    }
    let [points, lines, triangles] = items;
    json!({
        "primitives": parts,
        "vertices": vertices,
        "triangles": triangles,
        "lines": lines,
        "points": points,
    })
}

/// Returns the name of a topology, in the plural.
pub(super) fn topology_name(of: Topology) -> &'static str {
    match of {
        Topology::Points => "points",
        Topology::Lines => "lines",
        Topology::Triangles => "triangles",
    }
}

/// Returns a skin as a list of joints.
fn skin_json(skin: &Skin) -> Value {
    json!({"joints": skin.joints})
}

/// Returns an animation: its name, duration and channels.
///
/// `duration` is the time of the last keyframe in any channel.
fn animation_json(model: &Model, animation: &Animation) -> Value {
    json!({
        "name": animation.name,
        "duration": animation.duration_seconds,
        "channels": animation.channels.iter().map(|of| channel_json(model, of)).collect::<Vec<_>>(),
    })
}

/// Returns a channel: its target, interpolation, number of keyframes, and start and end times.
///
/// Spherical interpolation of rotations is `LINEAR` in glTF, so both have that name. `start` and
/// `end` are `null` for a channel without keyframes.
fn channel_json(model: &Model, AnimationChannel { target, curve }: &AnimationChannel) -> Value {
    json!({
        "target": target_pointer(model, *target),
        "interpolation": match curve.interpolation {
            Interpolation::Step => "STEP",
            Interpolation::Linear | Interpolation::Spherical => "LINEAR",
            Interpolation::CubicSpline => "CUBICSPLINE",
        },
        "keys": curve.times.len(),
        "start": curve.times.first().copied().map(shortest_number),
        "end": curve.times.last().copied().map(shortest_number),
    })
}

/// Returns the property that an animation channel changes, as a JSON pointer into the file.
///
/// The form follows KHR_animation_pointer, even for channels of core glTF:
///
/// ```text
/// /nodes/3/rotation
/// /meshes/0/weights/2
/// /materials/1/…/extensions/KHR_texture_transform/offset
/// ```
fn target_pointer(model: &Model, target: AnimationTarget) -> String {
    match target {
        AnimationTarget::Node { node, property } => {
            let property = match property {
                NodeProperty::Translation => "translation",
                NodeProperty::Rotation => "rotation",
                NodeProperty::Scale => "scale",
                NodeProperty::Weights => "weights",
            };
            format!("/nodes/{node}/{property}")
        }
        AnimationTarget::NodeMorphWeight { node, target } => {
            format!("/nodes/{node}/weights/{target}")
        }
        AnimationTarget::MeshMorphWeights { mesh, target: None } => {
            format!("/meshes/{mesh}/weights")
        }
        AnimationTarget::MeshMorphWeights { mesh, target: Some(at) } => {
            format!("/meshes/{mesh}/weights/{at}")
        }
        AnimationTarget::ObjectProperty { property: field, index: of } => field.json_pointer(of),
        AnimationTarget::TextureTransform { transform, part } => {
            let UvTransform { material, slot, .. } = model.uv_transforms[transform];
            let part = match part {
                UvTransformPart::Offset => "offset",
                UvTransformPart::Rotation => "rotation",
                UvTransformPart::Scale => "scale",
            };
            let path = slot.json_path();
            format!("/materials/{material}/{path}/extensions/KHR_texture_transform/{part}")
        }
    }
}

/// Returns the extensions of the file, sorted, with the level of support for each.
///
/// `extensionsRequired` should be a subset of `extensionsUsed`, but not all files comply, so both
/// lists are merged. `note` explains any status other than full support.
fn extensions_json(model: &Model) -> Value {
    let mut names: Vec<&String> =
        model.extensions_used.iter().chain(&model.extensions_required).collect();
    names.sort();
    names.dedup();
    let describe = |name: &&String| {
        let (status, note) = match extension_use(name) {
            ExtensionUse::Drawn => ("drawn", None),
            ExtensionUse::Harmless => ("harmless", None),
            ExtensionUse::Partly(how) => ("drawn in part", Some(how)),
            ExtensionUse::Without(what) => ("not drawn", Some(what)),
            ExtensionUse::Refused(why) => ("not read", Some(why)),
            ExtensionUse::Unknown => ("unknown", None),
        };
        let required = model.extensions_required.contains(name);
        json!({"name": name, "required": required, "status": status, "note": note})
    };
    names.iter().map(describe).collect()
}

/// Returns the importer's warnings.
///
/// `check` reports more, because it examines the whole file, not only the parts that are read.
fn warnings_json(model: &Model) -> Value {
    let describe = |warning: &model::Diagnostic| json!({"pointer": warning.location, "message": warning.message});
    model.warnings.iter().map(describe).collect()
}
