//! `alberti info --json`: everything about a model that a script may want to know.
//!
//! Things are in the order of the file and numbered from 0, as flags and other things name them. Lengths are in the model's
//! units, angles in radians, times in seconds, colours linear. What is not there is `null` or an empty list. New members
//! may come in any release; [`VERSION`] rises when one changes its meaning or goes.

use super::materials::{images, materials, textures};
use super::scenes::{cameras, lights, meshes, nodes, scenes};
use crate::args::InfoArgs;
use crate::model_state::ModelStateArgs;
use homog::Bounds;
use model::import::{ExtensionUse, extension_use};
use model::{
    Animation, AnimationChannel, AnimationTarget, Interpolation, Model, NodeProperty, Primitive,
    Skin, Topology, UvTransform, UvTransformPart,
};
use pipeline::scene::file::Finite;
use serde_json::{Value, json};

/// The version of the schema.
const VERSION: u32 = 1;

/// The whole document, with a newline.
pub(super) fn document(args: &InfoArgs, model: &Model) -> String {
    let ModelStateArgs { animation, time, .. } = &args.model_state;
    let posed = animation.is_some() || time.is_some();
    let value = json!({
        "schema": {"name": "alberti-info", "version": VERSION},
        "file": args.file.to_string_lossy(),
        "name": model.name,
        "shown": {
            "scene": model.active_scene,
            "variant": model.active_variant,
            "animation": posed.then(|| chosen(args, model)),
            "time": posed.then(|| time.map_or(0.0, Finite::value)),
            "bounds": bounds(model.bounds()),
            "counts": counts(model.scene_primitives().map(|(_, primitive)| primitive)),
            "meshes": model.mesh_instances().count(),
        },
        "counts": counts(model.meshes.iter().flat_map(|mesh| &mesh.primitives)),
        "scenes": scenes(model),
        "nodes": nodes(model),
        "meshes": meshes(model),
        "materials": materials(model),
        "textures": textures(model),
        "images": images(model),
        "cameras": cameras(model),
        "lights": lights(model),
        "skins": model.skins.iter().map(skin).collect::<Vec<_>>(),
        "animations": model.animations.iter().map(|of| animation_of(model, of)).collect::<Vec<_>>(),
        "variants": model.variants,
        "extensions": extensions(model),
        "warnings": warnings(model),
    });
    format!("{value:#}\n")
}

/// The number of the animation that poses the model.
fn chosen(args: &InfoArgs, model: &Model) -> Option<usize> {
    pipeline::scene::select_animation(model, args.model_state.animation.as_ref()).ok()
}

/// A single number as short as it can be written: 0.8 and not 0.800000011920929.
pub(super) fn short(x: f32) -> Value {
    x.to_string().parse::<f64>().map_or(Value::Null, Value::from)
}

pub(super) fn shorts(numbers: &[f32]) -> Vec<Value> {
    numbers.iter().copied().map(short).collect()
}

pub(super) fn bounds<S: homog::Space>(of: Option<Bounds<S>>) -> Value {
    of.map_or(Value::Null, |bounds| {
        let [min, max] = [bounds.min(), bounds.max()].map(<[f64; 3]>::from);
        json!({"min": min, "max": max})
    })
}

/// What some primitives have in all.
pub(super) fn counts<'a>(primitives: impl Iterator<Item = &'a Primitive>) -> Value {
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

pub(super) fn topology(of: Topology) -> &'static str {
    match of {
        Topology::Points => "points",
        Topology::Lines => "lines",
        Topology::Triangles => "triangles",
    }
}

fn skin(skin: &Skin) -> Value {
    json!({"joints": skin.joints})
}

fn animation_of(model: &Model, animation: &Animation) -> Value {
    json!({
        "name": animation.name,
        "duration": animation.duration_seconds,
        "channels": animation.channels.iter().map(|of| channel(model, of)).collect::<Vec<_>>(),
    })
}

fn channel(model: &Model, AnimationChannel { target, curve }: &AnimationChannel) -> Value {
    json!({
        "target": channel_target(model, *target),
        "interpolation": match curve.interpolation {
            Interpolation::Step => "STEP",
            Interpolation::Linear | Interpolation::Spherical => "LINEAR",
            Interpolation::CubicSpline => "CUBICSPLINE",
        },
        "keys": curve.times.len(),
        "start": curve.times.first().copied().map(short),
        "end": curve.times.last().copied().map(short),
    })
}

/// What a channel changes, as a JSON pointer into the file.
fn channel_target(model: &Model, target: AnimationTarget) -> String {
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

fn extensions(model: &Model) -> Value {
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

fn warnings(model: &Model) -> Value {
    let describe = |warning: &model::Diagnostic| json!({"pointer": warning.location, "message": warning.message});
    model.warnings.iter().map(describe).collect()
}
