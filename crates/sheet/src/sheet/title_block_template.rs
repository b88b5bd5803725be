//! Custom title blocks: SVG files whose text contains fields, such as `{title}`.
//!
//! ```text
//!   <svg width="180mm" height="30mm" viewBox="0 0 180 30">
//!     <rect x="0" y="0" width="180" height="30" stroke-width="0.5"/>
//!     <path d="M0 12 H180 M60 12 V30"/>
//!     <text x="2" y="9" font-size="5">{title}</text>
//!     <text x="62" y="20" font-size="3.5" textLength="60">{author}, {date}</text>
//!   </svg>
//! ```
//!
//! Lines, rectangles, polylines, polygons, paths of straight lines, text and groups are supported.
//! A unit of the view box is always a millimeter; `width` and `height` are ignored. Any other
//! visible element is reported as an error with its position, so that no part of a block is
//! silently lost.

mod layers;
mod markup;
mod path_data;

use super::Sheet;
use super::title_block_fields::TitleBlockText;
use core::fmt;
use glam::DVec2;
use markup::{Element, Event, MarkupReader};
use page::TextAlign;
use path_data::{parse_numbers, parse_path};

/// The default of `stroke-width`, in millimeters.
const DEFAULT_LINE_WIDTH: f64 = 0.35;

/// The default of `font-size`, in millimeters.
const DEFAULT_TEXT_HEIGHT: f64 = 3.5;

/// The maximum file size in bytes.
const MAX_LENGTH: usize = 1 << 20;

/// The maximum side of a block in millimeters.
const MAX_SIDE: f64 = 1000.0;

/// A title block read from an SVG file.
///
/// ```
/// use sheet::TitleBlockTemplate;
///
/// let svg = r#"<svg viewBox="0 0 90 20"><rect width="90" height="20"/>
///     <text x="2" y="8">{title}, {scale}</text></svg>"#;
/// assert_eq!(TitleBlockTemplate::parse(svg)?.size(), [90.0, 20.0]);
/// let error = TitleBlockTemplate::parse("<svg viewBox='0 0 9 9'><circle r='2'/></svg>");
/// assert_eq!(error.unwrap_err().to_string(), "line 1, column 24: `circle` is not supported; \
///     use line, rect, polyline, polygon, path, text or g");
/// # Ok::<(), sheet::TemplateError>(())
/// ```
#[derive(Clone, PartialEq, Debug)]
pub struct TitleBlockTemplate {
    size: DVec2,
    pub(super) lines: Vec<TemplateLine>,
    pub(super) texts: Vec<TemplateText>,
}

/// A polyline of a template, in millimeters from the template's upper left corner.
#[derive(Clone, PartialEq, Debug)]
pub(super) struct TemplateLine {
    pub(super) points: Vec<DVec2>,
    pub(super) closed: bool,
    pub(super) width: f64,
}

/// Text in a template.
#[derive(Clone, PartialEq, Debug)]
pub(super) struct TemplateText {
    parts: Vec<TextPart>,
    pub(super) anchor: DVec2,
    pub(super) height: f64,
    pub(super) align: TextAlign,
    /// The maximum width, in millimeters, to which wider text is reduced.
    pub(super) most_width: Option<f64>,
}

/// A piece of text or a field.
#[derive(Clone, PartialEq, Debug)]
enum TextPart {
    Fixed(String),
    Field(TemplateField),
}

/// The fields and their names.
const FIELDS: [(&str, TemplateField); 16] = [
    ("title", TemplateField::Title),
    ("supplementary_title", TemplateField::SupplementaryTitle),
    ("owner", TemplateField::Owner),
    ("document_type", TemplateField::DocumentType),
    ("author", TemplateField::Author),
    ("approved_by", TemplateField::ApprovedBy),
    ("date", TemplateField::Date),
    ("number", TemplateField::Number),
    ("revision", TemplateField::Revision),
    ("sheet", TemplateField::Sheet),
    ("sheets", TemplateField::Sheets),
    ("language", TemplateField::Language),
    ("scale", TemplateField::Scale),
    ("paper", TemplateField::Paper),
    ("unit", TemplateField::Unit),
    ("projection", TemplateField::Projection),
];

/// A field of a template.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum TemplateField {
    Title,
    SupplementaryTitle,
    Owner,
    DocumentType,
    Author,
    ApprovedBy,
    Date,
    Number,
    Revision,
    Sheet,
    Sheets,
    Language,
    Scale,
    Paper,
    Unit,
    /// The projection symbol, which replaces text.
    Projection,
}

/// The sheet's title block text, and the values of the fields that are not in it.
#[derive(Clone, Copy, Debug)]
pub(super) struct FieldValues<'a> {
    pub(super) texts: &'a TitleBlockText,
    pub(super) title: &'a str,
    pub(super) scale: &'a str,
    pub(super) paper: &'a str,
    pub(super) unit: &'a str,
}

/// An error in a template.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
#[error("line {line}, column {column}: {message}")]
pub struct TemplateError {
    /// The line, from 1.
    pub line: usize,
    /// The column in characters, from 1.
    pub column: usize,
    /// A description of the error, with a remedy.
    pub message: String,
}

impl TemplateError {
    /// Creates an error at a byte position in the source.
    fn at(source: &str, byte: usize, message: impl Into<String>) -> Self {
        let before = source.get(..byte).unwrap_or(source);
        let line_start = before.rfind('\n').map_or(0, |newline| newline + 1);
        let column = before[line_start..].chars().count() + 1;
        Self { line: before.matches('\n').count() + 1, column, message: message.into() }
    }
}

impl TitleBlockTemplate {
    /// Parses a template from the text of an SVG file.
    ///
    /// # Errors
    /// Returns an error if the text is not an SVG file, or if it contains unsupported shapes,
    /// unknown fields, transforms or styles.
    pub fn parse(svg: &str) -> Result<Self, TemplateError> {
        // Limiting the size also limits the time and memory of everything below.
        if svg.len() > MAX_LENGTH {
            let message = format!("a title block can have at most {MAX_LENGTH} bytes");
            return Err(TemplateError::at(svg, 0, message));
        }
        let mut reader = MarkupReader::new(svg);
        let root = match reader.next()? {
            Some(Event::Start(root)) if root.name == "svg" => root,
            _ => {
                return Err(TemplateError::at(
                    svg,
                    0,
                    "a title block must be an SVG file: <svg …>",
                ));
            }
        };
        let size = view_box_size(svg, &root)?;
        let mut template = Self { size, lines: Vec::new(), texts: Vec::new() };
        // The open text element, with its start tag and its text so far.
        let mut text: Option<(Element<'_>, String)> = None;
        while let Some(event) = reader.next()? {
            match (event, &mut text) {
                (Event::Start(element), Some(_)) => {
                    let message = format!("`{}` cannot be inside a text element", element.name);
                    return Err(TemplateError::at(svg, element.at, message));
                }
                (Event::Start(element), None) if element.name == "text" => {
                    text = Some((element, String::new()));
                }
                (Event::Start(element), None) => template.add_shape(svg, &element)?,
                (Event::Text(part), Some((_, so_far))) => so_far.push_str(&part),
                (Event::Text(_), None) => {}
                // Only text elements have content, so other end tags need no action.
                (Event::End(name), _) => {
                    if let Some((element, content)) = text.take_if(|_| name == "text") {
                        template.add_text(svg, &element, content.trim())?;
                    }
                }
            }
        }
        Ok(template)
    }

    /// Returns the width and height in millimeters.
    #[must_use]
    pub const fn size(&self) -> [f64; 2] {
        [self.size.x, self.size.y]
    }

    /// Adds the lines of a shape. Returns an error for an unsupported element.
    fn add_shape(&mut self, svg: &str, element: &Element<'_>) -> Result<(), TemplateError> {
        let number = |name| element.number(svg, name, 0.0);
        let point = |x, y| Ok::<_, TemplateError>(DVec2::new(number(x)?, number(y)?));
        let lines = match element.name {
            // A group has no effect, because `check_attributes` rejects transforms.
            "g" => Vec::new(),
            "line" => vec![(vec![point("x1", "y1")?, point("x2", "y2")?], false)],
            "rect" => {
                let (low, size) = (point("x", "y")?, point("width", "height")?);
                let high = low + size;
                let corners = [low, DVec2::new(high.x, low.y), high, DVec2::new(low.x, high.y)];
                vec![(corners.into(), true)]
            }
            "polyline" | "polygon" => {
                let numbers = parse_numbers(svg, element.attribute("points"))?;
                let (pairs, _) = numbers.as_chunks::<2>();
                let points = pairs.iter().copied().map(DVec2::from).collect();
                vec![(points, element.name == "polygon")]
            }
            "path" => parse_path(svg, element.attribute("d"))?,
            other => {
                let message = format!(
                    "`{other}` is not supported; use line, rect, polyline, polygon, path, text \
                     or g"
                );
                return Err(TemplateError::at(svg, element.at, message));
            }
        };
        element.check_attributes(svg)?;
        let width = element.size(svg, "stroke-width", DEFAULT_LINE_WIDTH)?;
        let of_width = |(points, closed)| TemplateLine { points, closed, width };
        self.lines.extend(lines.into_iter().map(of_width));
        Ok(())
    }

    /// Adds text with its fields.
    fn add_text(
        &mut self,
        svg: &str,
        element: &Element<'_>,
        content: &str,
    ) -> Result<(), TemplateError> {
        element.check_attributes(svg)?;
        let parts =
            text_parts(content).map_err(|message| TemplateError::at(svg, element.at, message))?;
        let anchor = DVec2::new(element.number(svg, "x", 0.0)?, element.number(svg, "y", 0.0)?);
        let height = element.size(svg, "font-size", DEFAULT_TEXT_HEIGHT)?;
        let align = match element.attribute("text-anchor").map_or("start", |(value, _)| value) {
            "start" => TextAlign::Start,
            "middle" => TextAlign::Middle,
            "end" => TextAlign::End,
            other => {
                let message = format!("`{other}` is not a text-anchor; use start, middle or end");
                return Err(TemplateError::at(svg, element.at, message));
            }
        };
        let width = element.number(svg, "textLength", 0.0)?;
        let most_width = (width > 0.0).then_some(width);
        // The height of capitals is about seven tenths of the font size.
        let height = height * CAPITALS;
        self.texts.push(TemplateText { parts, anchor, height, align, most_width });
        Ok(())
    }
}

/// The height of capitals as a fraction of `font-size`.
const CAPITALS: f64 = 0.7;

impl TemplateText {
    /// Returns the text with its fields filled in.
    pub(super) fn content(&self, values: &FieldValues<'_>) -> String {
        let part = |part: &TextPart| match part {
            TextPart::Fixed(text) => text.clone(),
            TextPart::Field(field) => values.text(*field),
        };
        self.parts.iter().map(part).collect()
    }

    /// Whether this is the projection symbol instead of text.
    pub(super) fn is_symbol(&self) -> bool {
        self.parts == [TextPart::Field(TemplateField::Projection)]
    }
}

impl Sheet {
    /// Returns the field values for the sheet's template.
    pub(super) fn field_values<'a>(&'a self, title: &'a str, scale: &'a str) -> FieldValues<'a> {
        let (texts, paper) = (&self.title_block, self.paper_name.as_str());
        FieldValues { texts, title, scale, paper, unit: self.dimension_unit.symbol() }
    }
}

impl FieldValues<'_> {
    /// Returns the text of a field.
    fn text(&self, field: TemplateField) -> String {
        let texts = self.texts;
        let part = |at: usize| texts.sheet.map_or_else(|| "1".to_owned(), |of| of[at].to_string());
        match field {
            TemplateField::Title => self.title.to_owned(),
            TemplateField::SupplementaryTitle => texts.supplementary_title.clone(),
            TemplateField::Owner => texts.owner.clone(),
            TemplateField::DocumentType => texts.document_type.clone(),
            TemplateField::Author => texts.author.clone(),
            TemplateField::ApprovedBy => texts.approved_by.clone(),
            TemplateField::Date => texts.date.clone(),
            TemplateField::Number => texts.number.clone(),
            TemplateField::Revision => texts.revision.clone(),
            TemplateField::Sheet => part(0),
            TemplateField::Sheets => part(1),
            TemplateField::Language => texts.language.code().to_owned(),
            TemplateField::Scale => self.scale.to_owned(),
            TemplateField::Paper => self.paper.to_owned(),
            TemplateField::Unit => self.unit.to_owned(),
            TemplateField::Projection => String::new(),
        }
    }
}

/// Splits text into parts. `{name}` is a field, and `{{` is a brace.
fn text_parts(content: &str) -> Result<Vec<TextPart>, String> {
    let (mut parts, mut rest) = (Vec::new(), content);
    while let Some((before, after)) = rest.split_once('{') {
        if !before.is_empty() {
            parts.push(TextPart::Fixed(before.to_owned()));
        }
        if let Some(after) = after.strip_prefix('{') {
            parts.push(TextPart::Fixed("{".to_owned()));
            rest = after;
            continue;
        }
        let (name, after) =
            after.split_once('}').ok_or("`{` without `}`; write `{{` for a brace")?;
        let found = FIELDS.iter().find(|(known, _)| *known == name.trim());
        let (_, field) = found.ok_or_else(|| {
            let names: Vec<&str> = FIELDS.iter().map(|(name, _)| *name).collect();
            format!("there is no field `{name}`: the fields are {}", names.join(", "))
        })?;
        parts.push(TextPart::Field(*field));
        rest = after;
    }
    if !rest.is_empty() {
        parts.push(TextPart::Fixed(rest.to_owned()));
    }
    let is_symbol = |part: &TextPart| *part == TextPart::Field(TemplateField::Projection);
    if parts.len() > 1 && parts.iter().any(is_symbol) {
        return Err("{projection} is a symbol and needs a separate text element".to_owned());
    }
    Ok(parts)
}

/// Returns the size in millimeters from the view box, which must begin at 0, 0.
fn view_box_size(svg: &str, root: &Element<'_>) -> Result<DVec2, TemplateError> {
    let fault = |message: &str| TemplateError::at(svg, root.at, message);
    let numbers = parse_numbers(svg, root.attribute("viewBox"))?;
    let [x, y, width, height] = numbers[..] else {
        return Err(fault(
            "the view box needs four numbers in millimeters, such as viewBox=\"0 0 180 30\"",
        ));
    };
    if [x, y] != [0.0, 0.0] {
        return Err(fault("the view box must begin at 0 0"));
    }
    let is_size = |side: f64| (1.0..=MAX_SIDE).contains(&side);
    if !(is_size(width) && is_size(height)) {
        return Err(fault("the sides of the view box must be from 1 to 1000 millimeters"));
    }
    Ok(DVec2::new(width, height))
}

impl fmt::Display for TemplateField {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let name = FIELDS.iter().find(|(_, field)| field == self).map_or("", |(name, _)| name);
        f.write_str(name)
    }
}

#[cfg(test)]
mod tests;
