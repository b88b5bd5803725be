//! An explanation as data: a list of steps, each with a formula and items.

/// The stages that a subject passes through, and the result.
///
/// All values are plain data: the three writers (text, JSON, HTML) read the same structure and
/// compute nothing, so the outputs cannot disagree.
#[derive(Clone, PartialEq, Debug)]
pub struct Explanation {
    /// The subject in words.
    pub subject: String,
    /// The steps in pipeline order.
    pub steps: Vec<Step>,
    /// The result in a sentence.
    pub verdict: String,
}

/// One stage of the pipeline.
///
/// In a chain without points, the steps contain the transforms but no coordinates.
#[derive(Clone, PartialEq, Debug)]
pub struct Step {
    /// A stable identifier for programs, such as `camera` or `clip`; it is also the anchor of the
    /// step in the HTML page. Unique within an explanation except for repeated findings
    /// (`other_fragment`, `other_misprint`).
    pub id: &'static str,
    /// A heading for people.
    pub title: String,
    /// The ids of the step's formulas, such as `PE-1, VV-2`.
    pub formula: Option<&'static str>,
    /// The inputs and results of the step.
    pub items: Vec<ExplanationEntry>,
}

/// A named value of a step.
#[derive(Clone, PartialEq, Debug)]
pub struct ExplanationEntry {
    /// A stable identifier for programs, unique within its step. For one of several points, it ends
    /// with the point's label: `clip_a`, `ndc_start`.
    pub id: String,
    /// A label for people.
    pub name: String,
    /// The value.
    pub value: ItemValue,
}

/// The value of an item.
///
/// Numbers stay f64 until they are written: JSON prints all digits, text and HTML round to seven.
#[derive(Clone, PartialEq, Debug)]
pub enum ItemValue {
    /// A matrix for column vectors, by rows.
    Matrix([[f64; 4]; 4]),
    /// A matrix of the plane for column vectors, by rows.
    PlanarMatrix([[f64; 3]; 3]),
    /// Coordinates, or another list of numbers: three for a Cartesian point, four for a homogeneous
    /// point (x, y, z, w).
    Numbers(Vec<f64>),
    /// A number.
    Number(f64),
    /// Text.
    Text(String),
}

impl Step {
    /// Creates a step without items.
    pub(super) fn new(
        id: &'static str,
        title: impl Into<String>,
        formula: Option<&'static str>,
    ) -> Self {
        Self { id, title: title.into(), formula, items: Vec::new() }
    }

    /// Returns the step with one more item, for chained calls.
    pub(super) fn with_item(
        mut self,
        id: impl Into<String>,
        name: impl Into<String>,
        value: impl Into<ItemValue>,
    ) -> Self {
        self.add_item(id, name, value);
        self
    }

    /// Appends an item in place, for loops over points.
    pub(super) fn add_item(
        &mut self,
        id: impl Into<String>,
        name: impl Into<String>,
        value: impl Into<ItemValue>,
    ) {
        self.items.push(ExplanationEntry { id: id.into(), name: name.into(), value: value.into() });
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
