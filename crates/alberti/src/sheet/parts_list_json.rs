//! `alberti sheet --parts-list=FILE.json`: the parts list as JSON.
//!
//! New members may be added in any release; [`VERSION`] increases when a member is removed or its
//! meaning changes.
//!
//! ```json
//! {
//!   "schema": {"name": "alberti-parts-list", "version": 1},
//!   "items": [
//!     {"item": 5, "quantity": 4, "name": "bolt", "material": "steel", "mass_grams": 0.141,
//!      "parts": [{"model": 0, "node": 5, "path": ["bolt 1"]}]}
//!   ]
//! }
//! ```
//! (Shortened: each of the four bolts has an entry with its place in the scene graph.)

use serde_json::{Value, json};
use sheet::{PartPlace, PartsList, PartsListItem};

/// The version of the JSON schema.
const VERSION: u32 = 1;

/// Returns the document as text, with a final newline.
pub(super) fn parts_list_document(list: &PartsList) -> String {
    let value = json!({
        "schema": {"name": "alberti-parts-list", "version": VERSION},
        "items": list.items.iter().map(item_json).collect::<Vec<Value>>(),
    });
    format!("{value:#}\n")
}

/// Returns an item; masses are rounded to the same number of decimal places as in the CSV file.
fn item_json(item: &PartsListItem) -> Value {
    json!({
        "item": item.number,
        "quantity": item.quantity,
        "name": item.name,
        "material": item.material,
        "mass_grams": item.mass.map(|grams| libm::round(grams * 1000.0) / 1000.0),
        "parts": item.places.iter().map(place_json).collect::<Vec<Value>>(),
    })
}

/// Returns the place of a part in the scene graph of its model.
fn place_json(place: &PartPlace) -> Value {
    json!({"model": place.model, "node": place.node, "path": place.path})
}
