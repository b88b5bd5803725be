//! Fields of the title block: their positions, names and contents.
//!
//! ```text
//!   without the fields of ISO 7200                 with them
//!   ┌─────────────┬─────────┬──────────────┐       ┌───────────────┬───────────┬───────────┐
//!   │ Author      │ Date    │ Number       │       │ Legal owner   │ Doc. type │ Number    │
//!   ├─────────────┴─────────┴──────────────┤       ├───────────┬───┴────────┬──┴───────────┤
//!   │ Title                                │       │ Created by│ Approved by│ Date of issue│
//!   ├───────┬───────┬───────┬───────┬──────┤       ├───────────┴────────────┴──────────────┤
//!   │ Scale │ Paper │ Unit  │ Proj. │ …    │       │ Title, with a second line below       │
//!   └───────┴───────┴───────┴───────┴──────┘       ├─────┬─────┬─────┬─────┬────┬────┬─────┤
//!                                                  │Scale│Paper│Unit │Proj.│Rev.│Lang│Sheet│
//!                                                  └─────┴─────┴─────┴─────┴────┴────┴─────┘
//! ```

use super::Sheet;
use super::title_block_language::{FieldName, TitleBlockLanguage};
use viewport::DrawingScale;

/// The text of a title block (ISO 7200).
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct TitleBlockText {
    /// The title of the drawing. If empty, the model names are used.
    pub title: String,
    /// The author.
    pub author: String,
    /// The date, as text.
    pub date: String,
    /// The drawing number.
    pub number: String,
    /// The second line of the title.
    pub supplementary_title: String,
    /// The legal owner, such as a company.
    pub owner: String,
    /// The type of the document, such as `Part drawing`.
    pub document_type: String,
    /// The person who approved the drawing.
    pub approved_by: String,
    /// The revision index, such as `B`.
    pub revision: String,
    /// The sheet number, from 1, and the number of sheets, or `None` if there is only one.
    pub sheet: Option<[u32; 2]>,
    /// The language of the field names.
    pub language: TitleBlockLanguage,
}

impl TitleBlockText {
    /// Whether any field is set that exists only in the larger block.
    pub(super) fn has_all_fields(&self) -> bool {
        let texts = [
            &self.supplementary_title,
            &self.owner,
            &self.document_type,
            &self.approved_by,
            &self.revision,
        ];
        texts.into_iter().any(|text| !text.is_empty())
    }

    /// Returns all field values, to check for characters missing from the font.
    pub(super) fn texts(&self) -> [&str; 9] {
        [
            &self.title,
            &self.author,
            &self.date,
            &self.number,
            &self.supplementary_title,
            &self.owner,
            &self.document_type,
            &self.approved_by,
            &self.revision,
        ]
    }

    /// Returns the sheet number and the sheet count, such as `2/5`, or an empty string if they are
    /// not set.
    pub(super) fn sheet_number(&self) -> String {
        self.sheet.map_or_else(String::new, |[number, count]| format!("{number}/{count}"))
    }
}

/// A field: its extent as fractions of the block, its name and its value.
pub(super) struct TitleBlockField {
    pub(super) x: [f64; 2],
    pub(super) y: [f64; 2],
    pub(super) field: FieldName,
    pub(super) name: &'static str,
    pub(super) value: String,
    /// A second line below the value; may be empty.
    pub(super) second_value: String,
}

/// The bottoms of the rows as fractions of the block's height, with three and with four rows.
const THREE_ROWS: [f64; 3] = [0.31, 0.69, 1.0];
const FOUR_ROWS: [f64; 4] = [10.0 / 48.0, 20.0 / 48.0, 38.0 / 48.0, 1.0];

/// Returns the fields in reading order.
///
/// Columns and rows are fractions of the block, so that they shrink with it on small paper.
pub(super) fn title_block_fields(
    sheet: &Sheet,
    title: &str,
    scale: Option<DrawingScale>,
) -> Vec<TitleBlockField> {
    let texts = &sheet.title_block;
    let is_large = texts.has_all_fields();
    let rows: &[f64] = if is_large { &FOUR_ROWS } else { &THREE_ROWS };
    let field = |row: usize, x: [f64; 2], field: FieldName, value: &str| TitleBlockField {
        x,
        y: [if row == 0 { 0.0 } else { rows[row - 1] }, rows[row]],
        field,
        name: texts.language.field_name(field),
        value: value.to_owned(),
        second_value: String::new(),
    };
    let scale = scale.map(|scale| scale.to_string()).unwrap_or_default();
    let unit = sheet.dimension_unit.symbol();
    let number = texts.sheet_number();
    if !is_large {
        // If there is no sheet number, the drawing number takes its space.
        let number_end = if number.is_empty() { 1.0 } else { 0.87 };
        let mut fields = vec![
            field(0, [0.0, 0.4], FieldName::Author, &texts.author),
            field(0, [0.4, 0.64], FieldName::Date, &texts.date),
            field(0, [0.64, number_end], FieldName::Number, &texts.number),
            field(1, [0.0, 1.0], FieldName::Title, title),
            field(2, [0.0, 0.17], FieldName::Scale, &scale),
            field(2, [0.17, 0.31], FieldName::Paper, &sheet.paper_name),
            field(2, [0.31, 0.52], FieldName::Unit, unit),
            field(2, [0.52, 0.74], FieldName::Projection, ""),
            field(2, [0.74, 1.0], FieldName::Program, "alberti"),
        ];
        if !number.is_empty() {
            fields.push(field(0, [number_end, 1.0], FieldName::Sheet, &number));
        }
        return fields;
    }
    let number = if number.is_empty() { "1/1" } else { &number };
    let second_value = texts.supplementary_title.clone();
    vec![
        field(0, [0.0, 0.4], FieldName::Owner, &texts.owner),
        field(0, [0.4, 0.68], FieldName::DocumentType, &texts.document_type),
        field(0, [0.68, 1.0], FieldName::DocumentNumber, &texts.number),
        field(1, [0.0, 0.36], FieldName::Creator, &texts.author),
        field(1, [0.36, 0.72], FieldName::ApprovedBy, &texts.approved_by),
        field(1, [0.72, 1.0], FieldName::DateOfIssue, &texts.date),
        TitleBlockField { second_value, ..field(2, [0.0, 1.0], FieldName::Title, title) },
        field(3, [0.0, 0.15], FieldName::Scale, &scale),
        field(3, [0.15, 0.28], FieldName::Paper, &sheet.paper_name),
        field(3, [0.28, 0.44], FieldName::Unit, unit),
        field(3, [0.44, 0.66], FieldName::Projection, ""),
        field(3, [0.66, 0.76], FieldName::Revision, &texts.revision),
        field(3, [0.76, 0.85], FieldName::Language, texts.language.code()),
        field(3, [0.85, 1.0], FieldName::Sheet, number),
    ]
}
