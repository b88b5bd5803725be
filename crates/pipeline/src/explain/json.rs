//! An explanation for programs. Numbers are exact: JSON's decimals lead back to the same f64.

use super::{Explanation, Item, ItemValue, Step};
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
            "steps": self.steps.iter().map(step_json).collect::<Vec<_>>(),
            "verdict": self.verdict,
        })
    }
}

fn step_json(step: &Step) -> Json {
    json!({
        "id": step.id,
        "title": step.title,
        "formula": step.formula,
        "items": step.items.iter().map(item_json).collect::<Vec<_>>(),
    })
}

fn item_json(item: &Item) -> Json {
    let value = match &item.value {
        ItemValue::Matrix(rows) => json!({"rows": rows}),
        ItemValue::Numbers(numbers) => json!(numbers),
        ItemValue::Number(number) => json!(number),
        ItemValue::Text(words) => json!(words),
    };
    json!({"id": item.id, "name": item.name, "value": value})
}
