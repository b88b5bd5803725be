//! The engine of the explorer page as a JavaScript class.
//!
//! This crate contains only bindings; results and messages come from the crate `explorer`. `cargo
//! xtask web` compiles it to WebAssembly and generates the JavaScript for it.

use explorer::ExplorerError;
use wasm_bindgen::prelude::{JsValue, wasm_bindgen};

/// An explorer and the files added to it.
#[wasm_bindgen]
#[derive(Debug, Default)]
pub struct Explorer(explorer::Explorer);

#[wasm_bindgen]
impl Explorer {
    /// Creates an explorer without files.
    #[wasm_bindgen(constructor)]
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds a file from which models can be loaded, or replaces the file of that name.
    ///
    /// # Errors
    /// Throws `{code, message, help}` if the name points outside the folder of files.
    pub fn add_file(&mut self, name: &str, bytes: Vec<u8>) -> Result<(), JsValue> {
        self.0.add_file(name, bytes).map_err(|error| error_object(&error))
    }

    /// Answers a request (a query string) with an object `{content_type, bytes}`.
    ///
    /// # Errors
    /// Throws `{code, message, help}` if the request cannot be answered.
    pub fn answer(&mut self, query: &str) -> Result<JsValue, JsValue> {
        let answer = self.0.answer(query).map_err(|error| error_object(&error))?;
        let object = Object::new();
        set_text(&object, "content_type", answer.content_type);
        set_bytes(&object, "bytes", answer.bytes);
        Ok(object.into())
    }
}

fn error_object(error: &ExplorerError) -> JsValue {
    let object = Object::new();
    for (name, text) in [("code", error.code), ("message", &error.message), ("help", &error.help)] {
        set_text(&object, name, text);
    }
    object.into()
}

/// Plain JavaScript objects, which the worker can send to the page.
#[wasm_bindgen]
extern "C" {
    type Object;

    #[wasm_bindgen(constructor)]
    fn new() -> Object;

    #[wasm_bindgen(js_namespace = Reflect, js_name = set)]
    fn set_text(object: &Object, name: &str, value: &str) -> bool;

    /// Copies the bytes into a JavaScript array.
    #[wasm_bindgen(js_namespace = Reflect, js_name = set)]
    fn set_bytes(object: &Object, name: &str, value: Vec<u8>) -> bool;
}
