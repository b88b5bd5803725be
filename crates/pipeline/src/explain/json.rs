//! An explanation as JSON, for programs. Numbers are exact: the decimals parse to the same f64.
//!
//! ```json
//! {"schema": {"name": "alberti-explain", "version": 1}, "subject": "…", "verdict": "…",
//!  "steps": [{"id": "camera", "title": "…", "formula": "CA-1, CA-2",
//!             "items": [{"id": "eye", "name": "eye", "value": [4, 3, 6]}]}]}
//! ```

use super::{Explanation, Item, ItemValue, Step};
use serde_json::{Value as Json, json};

/// The name of the schema.
pub const SCHEMA_NAME: &str = "alberti-explain";
/// The version of the schema. It rises when a member changes its meaning or is removed; new members
/// may come in any release.
pub const SCHEMA_VERSION: u32 = 1;

impl Explanation {
    /// Formats the explanation as a JSON document: a list of steps, each with a list of items.
    /// Numbers that are not finite become `null`.
    #[must_use]
    pub fn to_json(&self) -> Json {
        json!({
            "schema": {"name": SCHEMA_NAME, "version": SCHEMA_VERSION},
            "subject": self.subject,
            "steps": self.steps.iter().map(step_json).collect::<Vec<_>>(),
            "verdict": self.verdict,
        })
    }
}

/// One step with its items.
fn step_json(step: &Step) -> Json {
    json!({
        "id": step.id,
        "title": step.title,
        "formula": step.formula,
        "items": step.items.iter().map(item_json).collect::<Vec<_>>(),
    })
}

/// One item; a matrix as an object with its rows.
fn item_json(item: &Item) -> Json {
    let value = match &item.value {
        ItemValue::Matrix(rows) => json!({"rows": rows}),
        ItemValue::Numbers(numbers) => json!(numbers),
        ItemValue::Number(number) => json!(number),
        ItemValue::Text(words) => json!(words),
    };
    json!({"id": item.id, "name": item.name, "value": value})
}
