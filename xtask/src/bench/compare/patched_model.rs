//! Copies of a model with an added material extension or light, to measure features that no flag
//! enables.
//!
//! The model is changed, not a scene file, because scene fields have been renamed over time,
//! whereas programs of all commits read glTF.

use scene_models::glb::encode_glb;
use serde_json::{Value, json};
use std::path::{Component, Path, PathBuf};

/// An addition to a model.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Addition {
    /// Makes all materials transmissive.
    Transmission,
    /// Gives all materials a thin film.
    Iridescence,
    /// Replaces the model's lights with a directional light.
    Sun,
    /// Replaces the model's lights with a spot light that lights the whole model.
    Spot,
}

impl Addition {
    /// Returns its name, for file names.
    fn name(self) -> &'static str {
        match self {
            Self::Transmission => "transmission",
            Self::Iridescence => "iridescence",
            Self::Sun => "sun",
            Self::Spot => "spot",
        }
    }

    /// Changes the JSON of a model with these bounds.
    fn apply(self, model: &mut Value, bounds: &Bounds) -> Result<(), String> {
        match self {
            Self::Transmission => {
                let value = json!({ "transmissionFactor": 1 });
                extend_materials(model, "KHR_materials_transmission", &value)
            }
            Self::Iridescence => {
                let value = json!({ "iridescenceFactor": 1, "iridescenceThicknessMaximum": 400 });
                extend_materials(model, "KHR_materials_iridescence", &value)
            }
            Self::Sun => replace_lights(model, &json!({ "type": "directional" }), bounds),
            Self::Spot => {
                // 3 lux at the model's center.
                let distance = bounds.light_distance();
                let cone = json!({ "innerConeAngle": 0.3, "outerConeAngle": 0.5 });
                let light = json!({
                    "type": "spot", "intensity": 3.0 * distance * distance, "spot": cone
                });
                replace_lights(model, &light, bounds)
            }
        }
    }
}

/// The bounding box of a model in world space.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Bounds {
    min: [f64; 3],
    max: [f64; 3],
}

impl Bounds {
    /// Parses the bounds that `alberti info --json` prints.
    pub fn from_info(info: &str) -> Result<Self, String> {
        let info: Value = serde_json::from_str(info).map_err(|error| format!("info: {error}"))?;
        let corner = |name: &str| {
            let corner = info["shown"]["bounds"][name].as_array()?;
            let numbers: Option<Vec<f64>> = corner.iter().map(Value::as_f64).collect();
            numbers?.try_into().ok()
        };
        match (corner("min"), corner("max")) {
            (Some(min), Some(max)) => Ok(Self { min, max }),
            _ => Err("the model has no bounds".into()),
        }
    }

    /// Returns a distance from the center at which a cone with a half-angle of 0.5 rad contains the
    /// whole box: 2.5 radii.
    fn light_distance(&self) -> f64 {
        let diagonal: f64 = (0..3).map(|i| self.max[i] - self.min[i]).map(|d| d * d).sum();
        1.25 * diagonal.sqrt()
    }
}

/// Writes the changed model and the files it refers to into `folder`, and returns its path.
pub fn write_patched_model(
    path: &Path,
    addition: Addition,
    bounds: &Bounds,
    folder: &Path,
) -> Result<PathBuf, String> {
    let bytes = std::fs::read(path).map_err(|error| format!("{}: {error}", path.display()))?;
    let (mut model, binary) = decode_model(&bytes)?;
    addition.apply(&mut model, bounds)?;
    crate::workspace::create_folder(folder)?;
    for uri in external_files(&model)? {
        let source = path.parent().unwrap_or(Path::new(".")).join(&uri);
        let copy = folder.join(&uri);
        crate::workspace::create_folder(copy.parent().unwrap_or(folder))?;
        std::fs::copy(&source, &copy).map_err(|error| format!("{}: {error}", source.display()))?;
    }
    let json = model.to_string().into_bytes();
    let (extension, bytes) = match binary {
        Some(binary) => ("glb", encode_glb(&json, binary)),
        None => ("gltf", json),
    };
    let target = folder.join(format!("{}.{extension}", addition.name()));
    std::fs::write(&target, bytes).map_err(|error| format!("{}: {error}", target.display()))?;
    Ok(target)
}

/// Splits a file into its JSON and, if it is a GLB, its binary chunk.
fn decode_model(bytes: &[u8]) -> Result<(Value, Option<&[u8]>), String> {
    let parse = |json| serde_json::from_slice(json).map_err(|error| format!("its JSON: {error}"));
    if !bytes.starts_with(b"glTF") {
        return Ok((parse(bytes)?, None));
    }
    let chunk = |at: usize| {
        let length = bytes.get(at..at + 4)?.try_into().ok().map(u32::from_le_bytes)? as usize;
        bytes.get(at + 8..(at + 8).checked_add(length)?)
    };
    let json = chunk(12).ok_or("the GLB is truncated")?;
    Ok((parse(json)?, Some(chunk(20 + json.len()).unwrap_or_default())))
}

/// Returns the files next to the model that it refers to.
fn external_files(model: &Value) -> Result<Vec<PathBuf>, String> {
    let entries = ["buffers", "images"].into_iter().filter_map(|name| model[name].as_array());
    let uris = entries.flatten().filter_map(|entry| entry["uri"].as_str());
    let path = |uri: &str| {
        let path = PathBuf::from(uri);
        let inside = path.components().all(|part| matches!(part, Component::Normal(_)));
        if inside { Ok(path) } else { Err(format!("it refers to `{uri}`")) }
    };
    uris.filter(|uri| !uri.starts_with("data:")).map(path).collect()
}

fn extend_materials(model: &mut Value, extension: &str, value: &Value) -> Result<(), String> {
    let materials = model["materials"].as_array_mut().filter(|materials| !materials.is_empty());
    for material in materials.ok_or("it has no materials")? {
        material["extensions"][extension] = value.clone();
    }
    declare_extension(model, extension)
}

fn replace_lights(model: &mut Value, light: &Value, bounds: &Bounds) -> Result<(), String> {
    const LIGHTS: &str = "KHR_lights_punctual";
    let nodes = model["nodes"].as_array_mut().ok_or("it has no nodes")?;
    for node in nodes.iter_mut() {
        if let Some(extensions) = node.get_mut("extensions").and_then(Value::as_object_mut) {
            extensions.remove(LIGHTS);
        }
    }
    let index = nodes.len();
    // In front of and above the model, at 45°: a rotation of −45° about x points the light's −z
    // axis at it.
    let (distance, half) = (bounds.light_distance(), std::f64::consts::FRAC_1_SQRT_2);
    let center: [f64; 3] = std::array::from_fn(|i| (bounds.min[i] + bounds.max[i]) / 2.0);
    nodes.push(json!({
        "translation": [center[0], center[1] + half * distance, center[2] + half * distance],
        "rotation": [-0.382_683_432, 0, 0, 0.923_879_533],
        "extensions": { LIGHTS: { "light": 0 } },
    }));
    let scene = model["scene"].as_u64().unwrap_or(0) as usize;
    let roots = model["scenes"].get_mut(scene).ok_or("it has no scene")?;
    roots["nodes"].as_array_mut().ok_or("its scene is empty")?.push(index.into());
    model["extensions"][LIGHTS] = json!({ "lights": [light] });
    declare_extension(model, LIGHTS)
}

fn declare_extension(model: &mut Value, extension: &str) -> Result<(), String> {
    let used = &mut model["extensionsUsed"];
    if used.is_null() {
        *used = json!([]);
    }
    let used = used.as_array_mut().ok_or("its extensionsUsed is not a list")?;
    if !used.iter().any(|name| name == extension) {
        used.push(extension.into());
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    const BOUNDS: Bounds = Bounds { min: [-1.0; 3], max: [1.0; 3] };

    fn sample() -> Value {
        json!({
            "scenes": [{ "nodes": [0] }],
            "nodes": [{ "mesh": 0, "extensions": { "KHR_lights_punctual": { "light": 3 } } }],
            "materials": [{}, { "extensions": { "KHR_materials_ior": {} } }],
            "extensionsUsed": ["KHR_materials_ior"],
        })
    }

    #[test]
    fn materials_get_the_extension_and_keep_existing_ones() {
        let mut model = sample();
        Addition::Iridescence.apply(&mut model, &BOUNDS).unwrap();
        Addition::Iridescence.apply(&mut model, &BOUNDS).unwrap();
        let film = |i: usize| &model["materials"][i]["extensions"]["KHR_materials_iridescence"];
        assert_eq!(film(0)["iridescenceFactor"], 1);
        assert_eq!(film(1)["iridescenceFactor"], 1);
        assert!(model["materials"][1]["extensions"]["KHR_materials_ior"].is_object());
        assert_eq!(
            model["extensionsUsed"],
            json!(["KHR_materials_ior", "KHR_materials_iridescence"])
        );
        assert!(Addition::Transmission.apply(&mut json!({}), &BOUNDS).is_err());
    }

    #[test]
    fn a_light_replaces_the_others_and_shines_at_the_center() {
        let mut model = sample();
        Addition::Spot.apply(&mut model, &BOUNDS).unwrap();
        assert_eq!(model["scenes"][0]["nodes"], json!([0, 1]));
        assert_eq!(model["nodes"][0]["extensions"], json!({}));
        let place = &model["nodes"][1]["translation"];
        let [x, y, z] = [0, 1, 2].map(|i| place[i].as_f64().unwrap());
        assert_eq!(x, 0.0);
        assert_eq!(y, z);
        // The sphere around the box has radius √3, and the sine of 0.5 rad is 0.479.
        assert!((y * y + z * z).sqrt() * 0.479 > 3_f64.sqrt());
    }

    #[test]
    fn glb_and_gltf_files_are_decoded() {
        let glb = encode_glb(br#"{"asset":{}}"#, b"12345678");
        let (json, binary) = decode_model(&glb).unwrap();
        assert_eq!((json, binary), (json!({"asset": {}}), Some(&b"12345678"[..])));
        assert_eq!(decode_model(b"{}").unwrap(), (json!({}), None));
        assert!(decode_model(&glb[..18]).is_err());
    }

    #[test]
    fn only_files_below_the_model_are_copied() {
        let model = |uri: &str| json!({ "images": [{ "uri": uri }, { "bufferView": 0 }] });
        assert_eq!(external_files(&model("a/b.png")).unwrap(), [PathBuf::from("a/b.png")]);
        assert!(external_files(&model("data:image/png;base64,")).unwrap().is_empty());
        assert!(external_files(&model("../b.png")).is_err());
    }

    #[test]
    fn bounds_are_read_from_info() {
        let info = r#"{"shown": {"bounds": {"min": [-1, -1, -1], "max": [1, 1, 1]}}}"#;
        assert_eq!(Bounds::from_info(info).unwrap(), BOUNDS);
        assert!(Bounds::from_info(r#"{"shown": {"bounds": null}}"#).is_err());
    }
}
