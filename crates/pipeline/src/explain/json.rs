//! An explanation for programs. Numbers are exact: JSON's decimals lead back to the same f64.

use super::{Explanation, Item, Step, Value};
use serde_json::{Value as Json, json};

/// The name of the schema.
pub const SCHEMA_NAME: &str = "alberti-explain";
/// The version of the schema. New members may come in any release; it rises when one changes its meaning or goes.
pub const SCHEMA_VERSION: u32 = 1;

impl Explanation {
    /// The explanation as a JSON document: steps by their ids, and in each the items by theirs. What is not finite is `null`.
    #[must_use]
    pub fn to_json(&self) -> Json {
        json!({
            "schema": {"name": SCHEMA_NAME, "version": SCHEMA_VERSION},
            "subject": self.subject,
            "steps": self.steps.iter().map(step).collect::<Vec<_>>(),
            "verdict": self.verdict,
        })
    }
}

fn step(step: &Step) -> Json {
    json!({
        "id": step.id,
        "title": step.title,
        "formula": step.formula,
        "items": step.items.iter().map(item).collect::<Vec<_>>(),
    })
}

fn item(item: &Item) -> Json {
    let value = match &item.value {
        Value::Matrix(rows) => json!({"rows": rows}),
        Value::Numbers(numbers) => json!(numbers),
        Value::Number(number) => json!(number),
        Value::Words(words) => json!(words),
    };
    json!({"id": item.id, "name": item.name, "value": value})
}
