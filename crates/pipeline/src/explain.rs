//! `explain`: the viewing pipeline, told step by step for one point, segment, triangle or matrix.
//!
//! ```text
//!  subject ─► steps, each with its formula ─► items: matrices, coordinates, words ─► text, JSON, page
//! ```
//! Nothing is computed in a way of its own here: every number comes from the stage that a picture goes through.

mod conventions;
mod diagrams;
mod html;
mod json;
mod matrix;
mod node;
mod pixel;
mod plain_text;
mod point;
mod projection_factors;
mod segment;
mod transform_chain;
mod triangle;

pub use conventions::ApiConventions;
pub use json::{SCHEMA_NAME, SCHEMA_VERSION};
pub use matrix::explain_matrix;
pub use node::explain_node;
pub use pixel::explain_pixel;
pub use point::{VertexRef, explain_point, explain_transforms, explain_vertex};
pub(crate) use projection_factors::formula_ids;
pub use segment::explain_segment;
pub use transform_chain::TransformChain;
pub use triangle::explain_triangle;

/// What happens to a subject, step by step.
#[derive(Clone, PartialEq, Debug)]
pub struct Explanation {
    /// What is explained.
    pub subject: String,
    /// The steps in the order of the pipeline.
    pub steps: Vec<Step>,
    /// What comes out, in a sentence.
    pub verdict: String,
}

/// A step of the pipeline.
#[derive(Clone, PartialEq, Debug)]
pub struct Step {
    /// A name for programs.
    pub id: &'static str,
    /// What is done.
    pub title: String,
    /// The formulas, by their ids in the chapter.
    pub formula: Option<&'static str>,
    /// What there is to see.
    pub items: Vec<Item>,
}

/// Something with a name and a value.
#[derive(Clone, PartialEq, Debug)]
pub struct Item {
    /// A name for programs.
    pub id: String,
    /// A name for people.
    pub name: String,
    /// The value.
    pub value: ItemValue,
}

/// What an item is.
#[derive(Clone, PartialEq, Debug)]
pub enum ItemValue {
    /// A matrix for column vectors, row by row.
    Matrix([[f64; 4]; 4]),
    /// Coordinates, or another list of numbers.
    Numbers(Vec<f64>),
    /// A number.
    Number(f64),
    /// Words.
    Text(String),
}

impl Step {
    fn new(id: &'static str, title: impl Into<String>, formula: Option<&'static str>) -> Self {
        Self { id, title: title.into(), formula, items: Vec::new() }
    }

    fn with_item(
        mut self,
        id: impl Into<String>,
        name: impl Into<String>,
        value: impl Into<ItemValue>,
    ) -> Self {
        self.add_item(id, name, value);
        self
    }

    fn add_item(
        &mut self,
        id: impl Into<String>,
        name: impl Into<String>,
        value: impl Into<ItemValue>,
    ) {
        self.items.push(Item { id: id.into(), name: name.into(), value: value.into() });
    }
}

impl From<[[f64; 4]; 4]> for ItemValue {
    fn from(rows: [[f64; 4]; 4]) -> Self {
        Self::Matrix(rows)
    }
}

impl<const N: usize> From<[f64; N]> for ItemValue {
    fn from(numbers: [f64; N]) -> Self {
        Self::Numbers(numbers.to_vec())
    }
}

impl From<f64> for ItemValue {
    fn from(number: f64) -> Self {
        Self::Number(number)
    }
}

impl From<String> for ItemValue {
    fn from(words: String) -> Self {
        Self::Text(words)
    }
}

impl From<&str> for ItemValue {
    fn from(words: &str) -> Self {
        Self::Text(words.to_owned())
    }
}
