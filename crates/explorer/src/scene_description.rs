//! The scene file of a state, as a person would write it.

use crate::lessons::HOUSE;
use crate::number_text::scene_tuple;

/// The parts of a scene file that differ between lessons.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub(crate) struct SceneDescription {
    /// The models: `Model(path: "…")`.
    pub(crate) models: Vec<String>,
    /// The camera's position and direction; empty for the default.
    pub(crate) view: String,
    /// The projection; empty for the default.
    pub(crate) projection: String,
    /// The style; empty for `Flat`.
    pub(crate) style: String,
    pub(crate) overlays: Vec<String>,
    pub(crate) viewports: Vec<String>,
    /// The first viewport that shows the model.
    pub(crate) first_view: usize,
    /// Further fields, each in a line.
    pub(crate) fields: Vec<String>,
    /// The color behind everything; empty for that of the lessons.
    pub(crate) background: &'static str,
    /// The scene file that is drawn as it is, and nothing of the above counts; empty for none.
    pub(crate) file: String,
    /// A remark for readers of the scene; empty for none.
    pub(crate) comment: &'static str,
}

/// The color behind the models of lessons.
const BACKGROUND: &str = "#eef2f5";

impl SceneDescription {
    /// One model, seen by a camera.
    pub(crate) fn new(model: &str, view: String, projection: String) -> Self {
        Self { models: vec![model_entry(model)], view, projection, ..Self::default() }
    }

    /// The house as a line drawing, by a classical projection that finds its own window.
    pub(crate) fn line_drawing(projection: String, padding: u32) -> Self {
        let view = format!("Frame(padding_percent: {padding})");
        let (style, background) = ("Lines()".to_owned(), "#ffffff");
        Self { style, background, ..Self::new(HOUSE, view, projection) }
    }

    /// The text of the scene file, for a picture of this size with so many samples.
    pub(crate) fn to_text(&self, title: &str, size: [u32; 2], samples: u32) -> String {
        let mut text = format!("// {title}{}\nScene(\n", self.comment);
        text += &list("models", &self.models);
        let view = field("view", &self.view, 8);
        let projection = field("projection", &self.projection, 8);
        if !(view.is_empty() && projection.is_empty()) {
            text += &format!("    camera: Camera(\n{view}{projection}    ),\n");
        }
        text += "    lights: [Directional(direction: (-1, -2, -1.5), intensity: 2), ";
        text += "Ambient(intensity: 0.9)],\n";
        text += &field("style", if self.style.is_empty() { "Flat" } else { &self.style }, 4);
        text += &list("overlays", &self.overlays);
        text += &list("viewports", &self.viewports);
        for line in &self.fields {
            text += &format!("    {line},\n");
        }
        let size = scene_tuple(&size.map(f64::from));
        let background = if self.background.is_empty() { BACKGROUND } else { self.background };
        // Four samples are the default of scene files.
        let samples = if samples == 4 { String::new() } else { format!(", samples: {samples}") };
        text += &format!(
            "    image: Image(size: {size}, background: Color(\"{background}\"){samples}),\n"
        );
        text + ")\n"
    }
}

/// A model of a scene file.
pub(crate) fn model_entry(path: &str) -> String {
    format!("Model(path: {})", quoted(path))
}

/// A string of a scene file.
pub(crate) fn quoted(text: &str) -> String {
    format!("\"{}\"", text.replace('\\', "\\\\").replace('"', "\\\""))
}

/// A camera that looks from one point to another.
pub(crate) fn look_at(eye: [f64; 3], target: [f64; 3]) -> String {
    format!("LookAt(eye: {}, target: {})", scene_tuple(&eye), scene_tuple(&target))
}

fn field(name: &str, value: &str, indent: usize) -> String {
    match value {
        "" => String::new(),
        value => format!("{:indent$}{name}: {value},\n", ""),
    }
}

fn list(name: &str, values: &[String]) -> String {
    match values {
        [] => String::new(),
        [value] if value.len() < 80 && !value.contains('\n') => format!("    {name}: [{value}],\n"),
        values => {
            let lines: String = values.iter().map(|value| format!("        {value},\n")).collect();
            format!("    {name}: [\n{lines}    ],\n")
        }
    }
}
