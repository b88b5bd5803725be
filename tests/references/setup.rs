//! The setup of a reference picture: its JSON, converted to a scene file.

use serde_json::Value;
use std::path::Path;

/// The camera, lights and model of a reference picture.
pub struct Setup {
    json: Value,
    /// The path of the model, relative to the assets folder.
    pub model: String,
}

impl Setup {
    /// Reads `NAME.json`.
    pub fn read_json(path: &Path) -> Result<Self, String> {
        let with_path = |error: String| format!("{}: {error}", path.display());
        let text = std::fs::read_to_string(path).map_err(|error| with_path(error.to_string()))?;
        let json: Value = serde_json::from_str(&text).map_err(|e| with_path(e.to_string()))?;
        let model = json["model"].as_str().ok_or_else(|| with_path("missing model".to_owned()))?;
        Ok(Self { model: model.to_owned(), json })
    }

    /// Returns the scene file, with one sample per pixel and only the reference's sun and ambient
    /// light.
    pub fn scene_source(&self, model: &Path) -> Result<String, String> {
        let json = &self.json;
        let (camera, lights) = (&json["camera"], &json["lights"]);
        let number = |value: &Value| value.as_f64().ok_or(format!("{value} is not a number"));
        let list = |value: &Value| {
            let all: Result<Vec<String>, String> = value
                .as_array()
                .ok_or(format!("{value} is not a list"))?
                .iter()
                .map(|entry| Ok(number(entry)?.to_string()))
                .collect();
            all.map(|all| all.join(", "))
        };
        let background: Vec<String> = json["background_srgb"]
            .as_array()
            .ok_or("missing background")?
            .iter()
            .map(|code| format!("{:02x}", code.as_u64().unwrap_or(0)))
            .collect();
        let pose = match (json["time"].as_f64(), json["clip"].as_u64()) {
            (Some(time), clip) => {
                format!(", animation: Index({}), time: {time}", clip.unwrap_or(0))
            }
            (None, _) => String::new(),
        };
        Ok(format!(
            "Scene(models: [Model(path: {model:?}{pose})],
    camera: Camera(view: LookAt(eye: ({}), target: ({}), up: ({})),
        projection: Perspective(fov_y_degrees: {}, near: {}, far: {})),
    lights: [Directional(direction: ({}), intensity: {}), Ambient(intensity: {})],
    image: Image(size: ({}), background: Color(\"#{}\"), samples: 1, max_anisotropy: 1))",
            list(&camera["eye"])?,
            list(&camera["target"])?,
            list(&camera["up"])?,
            number(&camera["fov_y_degrees"])?,
            number(&camera["near"])?,
            number(&camera["far"])?,
            list(&lights["sun_direction_of_travel"])?,
            number(&lights["sun_illuminance"])?,
            number(&lights["ambient_irradiance"])?,
            list(&json["size"])?,
            background.concat(),
        ))
    }
}
