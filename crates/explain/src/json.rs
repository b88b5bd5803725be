//! An explanation as JSON, for programs. Numbers are exact: the decimals parse to the same f64.
//!
//! ```json
//! {"schema": {"name": "alberti-explain", "version": 1}, "subject": "…",
//!  "introduction": "…", "verdict": "…",
//!  "steps": [{"id": "camera", "title": "…", "formula": "CA-1, CA-2",
//!             "items": [{"id": "eye", "name": "eye", "value": [4, 3, 6]}]}]}
//! ```

use super::{Explanation, ExplanationEntry, ItemValue, Step};
use serde_json::{Value as Json, json};

/// The name of the schema.
///
/// Consumers check it first, because the program also writes other JSON documents.
pub const SCHEMA_NAME: &str = "alberti-explain";
/// The version of the schema. It increases when a member changes its meaning or is removed; new
/// members may be added in any release.
pub const SCHEMA_VERSION: u32 = 1;

impl Explanation {
    /// Formats the explanation as a JSON document: a list of steps, each with a list of items.
    /// Numbers that are not finite become `null`.
    ///
    /// Decimals are the shortest that parse to the same f64, so programs can recompute each step
    /// bit for bit. Matrices are `{"rows": [[…], …]}` for column vectors.
    #[must_use]
    pub fn to_json(&self) -> Json {
        json!({
            "schema": {"name": SCHEMA_NAME, "version": SCHEMA_VERSION},
            "subject": self.subject,
            "introduction": self.introduction(),
            "steps": self.steps.iter().map(step_json).collect::<Vec<_>>(),
            "verdict": self.verdict,
        })
    }
}

/// Formats a step with its items.
///
/// A step without a formula has `"formula": null`, not a missing member.
fn step_json(step: &Step) -> Json {
    json!({
        "id": step.id,
        "title": step.title,
        "formula": step.formula,
        "items": step.items.iter().map(item_json).collect::<Vec<_>>(),
    })
}

/// Formats an item. A matrix becomes an object with its rows.
///
/// The object lets programs tell a matrix from a list of coordinates without counting numbers.
fn item_json(item: &ExplanationEntry) -> Json {
    let value = match &item.value {
        ItemValue::Matrix(rows) => json!({"rows": rows}),
        ItemValue::PlanarMatrix(rows) => json!({"rows": rows}),
        ItemValue::Numbers(numbers) => json!(numbers),
        ItemValue::Number(number) => json!(number),
        ItemValue::Text(words) => json!(words),
    };
    json!({"id": item.id, "name": item.name, "value": value})
}
