//! The marks of a page: fenced blocks, code spans and headings, with their positions in the text.

use pulldown_cmark::{CodeBlockKind, Event, Options, Parser, Tag, TagEnd};
use std::ops::Range;

/// A fenced code block with its caption, if any.
#[derive(Debug)]
pub struct Fence {
    /// The position in the text.
    pub range: Range<usize>,
    /// The line number of the opening fence, counted from 1.
    pub line: usize,
    /// The info string after the opening fence.
    pub info: String,
    /// The text between the fences.
    pub body: String,
    /// The paragraph after the block, if it is emphasized as a whole.
    pub caption: Option<Caption>,
}

impl Fence {
    /// Returns the first word of the info string.
    pub fn kind(&self) -> &str {
        self.info.split([' ', ',']).next().unwrap_or_default()
    }

    /// Returns the info string without its first word.
    pub fn arguments(&self) -> &str {
        self.info[self.kind().len()..].trim()
    }
}

/// A paragraph that is emphasized as a whole.
#[derive(Debug)]
pub struct Caption {
    /// The position of the paragraph in the text.
    pub range: Range<usize>,
    /// The Markdown without the emphasis.
    pub text: String,
}

/// A code span.
#[derive(Debug)]
pub struct CodeSpan {
    /// The position in the text, including the backticks.
    pub range: Range<usize>,
    /// The line number, counted from 1.
    pub line: usize,
    /// The text between the backticks.
    pub code: String,
    /// The number of headings that begin before the span.
    pub section: usize,
}

/// A heading.
#[derive(Debug)]
pub struct Heading {
    /// The position in the text.
    pub range: Range<usize>,
    /// The level: 1 for the page title.
    pub level: usize,
    /// The text without markup and topic marks.
    pub text: String,
    /// The id that the source specifies, if any.
    pub id: Option<String>,
}

/// All marks of a page.
#[derive(Default, Debug)]
pub struct Marks {
    /// The fenced blocks, in order.
    pub fences: Vec<Fence>,
    /// The code spans, in order.
    pub spans: Vec<CodeSpan>,
    /// The headings, in order.
    pub headings: Vec<Heading>,
}

/// Returns whether a code span is a topic id, such as `C14`, `M12` or `M11b`.
pub fn is_topic(code: &str) -> bool {
    let Some((letter, number)) = code.split_at_checked(1) else { return false };
    let digits = number.trim_end_matches(['b', 'c']);
    let value: u32 = match digits.parse() {
        Ok(value) if value > 0 && !digits.starts_with(['0', '+']) => value,
        _ => return false,
    };
    match letter {
        "C" => value <= 104 && digits == number,
        "M" => value <= 28 && number.len() - digits.len() <= 1,
        _ => false,
    }
}

/// Returns the LaTeX of a code span if the span begins and ends with a dollar sign.
pub fn inline_formula(code: &str) -> Option<&str> {
    let inner = code.strip_prefix('$')?.strip_suffix('$')?;
    (!inner.is_empty()).then_some(inner)
}

/// Creates a parser with the extensions that mdBook enables for the book.
pub fn parse(text: &str) -> Parser<'_> {
    let options = Options::ENABLE_TABLES
        | Options::ENABLE_FOOTNOTES
        | Options::ENABLE_STRIKETHROUGH
        | Options::ENABLE_TASKLISTS
        | Options::ENABLE_HEADING_ATTRIBUTES
        | Options::ENABLE_DEFINITION_LIST;
    Parser::new_ext(text, options)
}

impl Marks {
    /// Finds the marks in a text.
    pub fn read(text: &str) -> Self {
        let events: Vec<(Event<'_>, Range<usize>)> = parse(text).into_offset_iter().collect();
        let lines = LineNumbers::of(text);
        let mut marks = Self::default();
        let mut heading: Option<Heading> = None;
        for (at, (event, range)) in events.iter().enumerate() {
            match event {
                Event::Start(Tag::CodeBlock(CodeBlockKind::Fenced(info))) => {
                    marks.fences.push(read_fence(text, &events, at, info, &lines));
                }
                Event::Start(Tag::Heading { level, id, .. }) => {
                    heading = Some(Heading {
                        range: range.clone(),
                        level: *level as usize,
                        text: String::new(),
                        id: id.as_ref().map(ToString::to_string),
                    });
                }
                Event::End(TagEnd::Heading(_)) => marks.headings.extend(heading.take()),
                Event::Code(code) => {
                    if let Some(heading) = heading.as_mut().filter(|_| !is_topic(code)) {
                        heading.text.push_str(code);
                    }
                    marks.spans.push(CodeSpan {
                        range: range.clone(),
                        line: lines.line(range.start),
                        code: code.to_string(),
                        section: marks.headings.len() + usize::from(heading.is_some()),
                    });
                }
                Event::Text(words) => {
                    if let Some(heading) = &mut heading {
                        heading.text.push_str(words);
                    }
                }
                _ => {}
            }
        }
        marks
    }

    /// Returns the ids of the headings: the id in the source, if any, otherwise the id that mdBook
    /// derives from the text.
    pub fn heading_ids(&self) -> Vec<String> {
        let mut used: Vec<String> = Vec::new();
        for heading in &self.headings {
            let wanted = heading.id.clone().unwrap_or_else(|| slug(&heading.text));
            let mut id = wanted.clone();
            let mut count = 0;
            while used.contains(&id) {
                count += 1;
                id = format!("{wanted}-{count}");
            }
            used.push(id);
        }
        used
    }
}

/// Derives the id of a heading from its text.
fn slug(text: &str) -> String {
    let letters = text.trim().to_lowercase();
    let kept = letters.chars().filter_map(|letter| match letter {
        letter if letter.is_alphanumeric() || letter == '_' || letter == '-' => Some(letter),
        letter if letter.is_whitespace() => Some('-'),
        _ => None,
    });
    kept.collect()
}

fn read_fence(
    text: &str,
    events: &[(Event<'_>, Range<usize>)],
    at: usize,
    info: &str,
    lines: &LineNumbers,
) -> Fence {
    let range = events[at].1.clone();
    let inside = events[at + 1..].iter().take_while(|(event, _)| matches!(event, Event::Text(_)));
    let body: String = inside
        .clone()
        .map(|(event, _)| if let Event::Text(words) = event { words } else { "" })
        .collect();
    let next = at + 1 + inside.count() + 1;
    Fence {
        line: lines.line(range.start),
        range,
        info: info.to_owned(),
        body,
        caption: events.get(next..).and_then(|rest| read_caption(text, rest)),
    }
}

/// Returns the paragraph at the start of `events` if it is emphasized as a whole.
fn read_caption(text: &str, events: &[(Event<'_>, Range<usize>)]) -> Option<Caption> {
    let [(Event::Start(Tag::Paragraph), paragraph), (Event::Start(Tag::Emphasis), emphasis), ..] =
        events
    else {
        return None;
    };
    let end = events.iter().position(|(event, _)| *event == Event::End(TagEnd::Paragraph))?;
    let is_all = events[end - 1] == (Event::End(TagEnd::Emphasis), emphasis.clone());
    let inner = text.get(emphasis.start + 1..emphasis.end.checked_sub(1)?)?;
    is_all.then(|| Caption { range: paragraph.clone(), text: inner.to_owned() })
}

/// Maps byte offsets to line numbers.
struct LineNumbers(Vec<usize>);

impl LineNumbers {
    fn of(text: &str) -> Self {
        Self(text.match_indices('\n').map(|(at, _)| at).collect())
    }

    fn line(&self, offset: usize) -> usize {
        self.0.partition_point(|&end| end < offset) + 1
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn topic_ids_are_recognized() {
        for id in ["C1", "C104", "M1", "M28", "M11b", "M14c"] {
            assert!(is_topic(id), "{id}");
        }
        for id in ["C0", "C105", "M29", "C11b", "M11bc", "C", "CA-1", "c4", "C+4", "C04", "é1"] {
            assert!(!is_topic(id), "{id}");
        }
    }

    #[test]
    fn blocks_captions_headings_and_spans_are_found() {
        let text = "# Title `C4`\n\n```alberti format=png\nalberti render\n```\n\n*A *b* `$x$`.*\n\n## A `$z$` b\n\n\
            ```text\nx\n```\n\n*half* of it\n";
        let marks = Marks::read(text);
        let [figure, plain] = &marks.fences[..] else { panic!("{marks:?}") };
        assert_eq!((figure.kind(), figure.arguments(), figure.line), ("alberti", "format=png", 3));
        assert_eq!(figure.body, "alberti render\n");
        assert_eq!(figure.caption.as_ref().unwrap().text, "A *b* `$x$`.");
        assert!(plain.caption.is_none());
        assert_eq!(marks.heading_ids(), ["title", "a-z-b"]);
        let spans: Vec<(&str, usize)> =
            marks.spans.iter().map(|span| (span.code.as_str(), span.section)).collect();
        assert_eq!(spans, [("C4", 1), ("$x$", 1), ("$z$", 2)]);
    }

    #[test]
    fn repeated_headings_get_numbered_ids() {
        assert_eq!(Marks::read("# A\n\n## B\n\n## B\n").heading_ids(), ["a", "b", "b-1"]);
    }
}
