//! Punctual lights (KHR_lights_punctual) with validated parameters. Invalid lights are skipped with
//! a warning.
//!
//! The extension stores lights in the document root, and nodes refer to them. By default a light is
//! white, with intensity 1, infinite range, and cone angles 0 and π/4.

use crate::warnings::ImportWarnings;
use gltf::json::Root;
use model::{Diagnostic, LightKind, Node, PunctualLight};
use serde_json::{Map, Value};
use std::f32::consts::{FRAC_PI_2, FRAC_PI_4};

/// The extension's name, in the root and in nodes.
const EXTENSION: &str = "KHR_lights_punctual";

/// Reads all lights of a file and attaches them to nodes.
///
/// An invalid light remains in the list as a black light, so that the indices of other lights do
/// not change, but no node refers to it.
pub(super) fn import_lights(
    root: &Root,
    nodes: &mut [Node],
    warnings: &mut ImportWarnings,
) -> Vec<PunctualLight> {
    let extension =
        root.extensions.as_ref().and_then(|extensions| extensions.others.get(EXTENSION));
    let json = extension.and_then(|extension| extension.get("lights")).and_then(Value::as_array);
    let mut is_valid = Vec::new();
    let mut lights = Vec::new();
    for (at, json) in json.into_iter().flatten().enumerate() {
        let parsed = parse_light(json, &format!("/extensions/{EXTENSION}/lights/{at}"), warnings);
        is_valid.push(parsed.is_ok());
        lights.push(parsed.unwrap_or_else(|diagnostic| {
            warnings.downgrade(&diagnostic, "the light is skipped");
            PunctualLight {
                name: None,
                color: [0.0; 3],
                intensity: 0.0,
                kind: LightKind::Directional,
            }
        }));
    }
    attach_lights(root, nodes, &is_valid, warnings);
    lights
}

/// Sets the lights of nodes.
///
/// Nodes without the extension are not changed; an out-of-range index causes a warning.
fn attach_lights(
    root: &Root,
    nodes: &mut [Node],
    is_valid: &[bool],
    warnings: &mut ImportWarnings,
) {
    for (at, node) in nodes.iter_mut().enumerate() {
        let json = root.nodes.get(at).and_then(|json| json.extensions.as_ref());
        let Some(extension) = json.and_then(|extensions| extensions.others.get(EXTENSION)) else {
            continue;
        };
        let light = extension.get("light").and_then(Value::as_u64);
        let light = light.map_or(usize::MAX, |light| light as usize);
        if light < is_valid.len() {
            node.light = Some(light).filter(|&light| is_valid[light]);
        } else {
            let pointer = format!("/nodes/{at}/extensions/{EXTENSION}/light");
            let diagnostic = Diagnostic::unresolved_index(&pointer, "light", light, is_valid.len());
            warnings.downgrade(&diagnostic, "the reference is ignored");
        }
    }
}

/// Reads and checks a light. Numbers out of range are clamped with a warning.
///
/// # Errors
/// Fails if the light is not an object or its type is unknown; without a type, its numbers have no
/// meaning.
fn parse_light(
    json: &Value,
    pointer: &str,
    warnings: &mut ImportWarnings,
) -> Result<PunctualLight, Diagnostic> {
    let Some(json) = json.as_object() else {
        return Err(Diagnostic::invalid(pointer, "expected an object"));
    };
    let mut numbers = LightNumbers { json, pointer, warnings };
    let intensity = numbers.read_number("intensity", 1.0, [0.0, f32::MAX]);
    // Without `range`, the range is infinite.
    let range = numbers.read_number("range", f32::INFINITY, [f32::MIN_POSITIVE, f32::INFINITY]);
    let kind = match json.get("type").and_then(Value::as_str) {
        Some("directional") => LightKind::Directional,
        Some("point") => LightKind::Point { range },
        Some("spot") => {
            let none = Map::new();
            let cone = json.get("spot").and_then(Value::as_object);
            let pointer = &format!("{pointer}/spot");
            let mut numbers =
                LightNumbers { json: cone.unwrap_or(&none), pointer, warnings: numbers.warnings };
            let inner = numbers.read_number("innerConeAngle", 0.0, [0.0, FRAC_PI_2]);
            let outer = numbers.read_number("outerConeAngle", FRAC_PI_4, [0.0, FRAC_PI_2]);
            if inner >= outer {
                let message = "innerConeAngle is reduced to be less than outerConeAngle";
                numbers.warnings.push_warning(pointer, message);
            }
            LightKind::Spot { range, inner_cone_angle: inner, outer_cone_angle: outer }
        }
        _ => {
            let message = "the type must be directional, point or spot";
            return Err(Diagnostic::invalid(&format!("{pointer}/type"), message));
        }
    };
    let color = json.get("color").and_then(Value::as_array);
    let channel = |at: usize| color.and_then(|color| color.get(at)?.as_f64()).unwrap_or(1.0);
    let mut light = PunctualLight {
        name: json.get("name").and_then(Value::as_str).map(str::to_owned),
        color: [0, 1, 2].map(|at| (channel(at) as f32).clamp(0.0, 1.0)),
        intensity,
        kind,
    };
    light.order_cone_angles();
    Ok(light)
}

/// Reads the numbers in a JSON object.
///
/// It is used for the light itself and, with a separate pointer, for its `spot` object.
struct LightNumbers<'a, 'w> {
    json: &'a Map<String, Value>,
    /// JSON pointer to the object.
    pointer: &'a str,
    warnings: &'w mut ImportWarnings,
}

impl LightNumbers<'_, '_> {
    /// Reads a number and clamps it to bounds. Returns `default` if the member is absent.
    ///
    /// A member that is clamped, or not a number and replaced by the default, causes a warning.
    fn read_number(&mut self, member: &str, default: f32, [min, max]: [f32; 2]) -> f32 {
        let Some(value) = self.json.get(member) else { return default };
        let given = value.as_f64().map(|x| x as f32);
        match given {
            Some(given) if (min..=max).contains(&given) => given,
            _ => {
                let clamped = given.map_or(default, |given| given.clamp(min, max));
                let range = match (max < f32::MAX, min > 0.0) {
                    (true, _) => format!("in [{min}, {max}]"),
                    (false, true) => "greater than 0".to_owned(),
                    (false, false) => "that is at least 0".to_owned(),
                };
                let message = format!("{value} is not a number {range}; {clamped:?} is used");
                self.warnings.push_warning(&format!("{}/{member}", self.pointer), message);
                clamped
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    fn parsed(json: &Value) -> (Result<PunctualLight, String>, usize) {
        let mut warnings = ImportWarnings::default();
        let light =
            parse_light(json, "/l", &mut warnings).map_err(|diagnostic| diagnostic.location);
        (light, warnings.into_list().len())
    }

    #[test]
    fn defaults_match_the_extension() {
        let (sun, warnings) = parsed(&json!({"type": "directional", "name": "sun"}));
        let white = PunctualLight {
            name: Some("sun".to_owned()),
            color: [1.0; 3],
            intensity: 1.0,
            kind: LightKind::Directional,
        };
        assert_eq!((sun, warnings), (Ok(white), 0));
        let (spot, _) = parsed(&json!({"type": "spot", "spot": {}, "intensity": 5, "range": 2}));
        let kind =
            LightKind::Spot { range: 2.0, inner_cone_angle: 0.0, outer_cone_angle: FRAC_PI_4 };
        assert_eq!(spot.map(|spot| (spot.kind, spot.intensity)), Ok((kind, 5.0)));
        let (point, _) = parsed(&json!({"type": "point", "color": [0.5, 0, 1]}));
        let kind = LightKind::Point { range: f32::INFINITY };
        assert_eq!(point.map(|point| (point.kind, point.color)), Ok((kind, [0.5, 0.0, 1.0])));
    }

    #[test]
    fn invalid_values_are_corrected_or_skipped() {
        assert_eq!(parsed(&json!({"type": "laser"})).0, Err("/l/type".to_owned()));
        assert_eq!(parsed(&json!(7)).0, Err("/l".to_owned()));
        let (point, warnings) = parsed(&json!({"type": "point", "range": 0, "intensity": -1}));
        assert_eq!((point.unwrap().intensity, warnings), (0.0, 2));
        let angles = json!({"innerConeAngle": 1, "outerConeAngle": 0.5});
        let (spot, warnings) = parsed(&json!({"type": "spot", "spot": angles}));
        let LightKind::Spot { inner_cone_angle: inner, outer_cone_angle: outer, .. } =
            spot.unwrap().kind
        else {
            panic!("expected a spot light")
        };
        assert!(inner < outer && outer == 0.5 && warnings == 1, "{inner} {outer} {warnings}");
    }
}
