//! `explain`: the viewing pipeline, told step by step for one point, segment, triangle or matrix.
//!
//! ```text
//!  subject ─► steps, each with its formula ─► items: matrices, coordinates, words ─► text, JSON, page
//! ```
//! Nothing is computed in a way of its own here: every number comes from the stage that a picture goes through.

mod chain;
mod conventions;
mod factors;
mod figures;
mod html;
mod json;
mod matrix;
mod node;
mod pixel;
mod place;
mod segment;
mod text;
mod triangle;

pub use chain::Chain;
pub use conventions::Conventions;
pub(crate) use factors::formula_of;
pub use json::{SCHEMA_NAME, SCHEMA_VERSION};
pub use matrix::explain_matrix;
pub use node::explain_node;
pub use pixel::explain_pixel;
pub use place::{Vertex, explain_chain, explain_place, explain_vertex};
pub use segment::explain_segment;
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
    pub value: Value,
}

/// What an item is.
#[derive(Clone, PartialEq, Debug)]
pub enum Value {
    /// A matrix for column vectors, row by row.
    Matrix([[f64; 4]; 4]),
    /// Coordinates, or another list of numbers.
    Numbers(Vec<f64>),
    /// A number.
    Number(f64),
    /// Words.
    Words(String),
}

impl Step {
    fn new(id: &'static str, title: impl Into<String>, formula: Option<&'static str>) -> Self {
        Self { id, title: title.into(), formula, items: Vec::new() }
    }

    fn with(
        mut self,
        id: impl Into<String>,
        name: impl Into<String>,
        value: impl Into<Value>,
    ) -> Self {
        self.add(id, name, value);
        self
    }

    fn add(&mut self, id: impl Into<String>, name: impl Into<String>, value: impl Into<Value>) {
        self.items.push(Item { id: id.into(), name: name.into(), value: value.into() });
    }
}

impl From<[[f64; 4]; 4]> for Value {
    fn from(rows: [[f64; 4]; 4]) -> Self {
        Self::Matrix(rows)
    }
}

impl<const N: usize> From<[f64; N]> for Value {
    fn from(numbers: [f64; N]) -> Self {
        Self::Numbers(numbers.to_vec())
    }
}

impl From<f64> for Value {
    fn from(number: f64) -> Self {
        Self::Number(number)
    }
}

impl From<String> for Value {
    fn from(words: String) -> Self {
        Self::Words(words)
    }
}

impl From<&str> for Value {
    fn from(words: &str) -> Self {
        Self::Words(words.to_owned())
    }
}
