//! Converts Markdown to HTML. Headings have the same anchors as on GitHub, wide tables scroll
//! horizontally, comments in code are marked up, and the caller replaces link targets.

use pulldown_cmark::{CodeBlockKind, CowStr, Event, HeadingLevel, Options, Parser, Tag, TagEnd};
use std::collections::BTreeMap;

/// A document as HTML.
#[derive(Default, Debug)]
pub struct Document {
    /// The text of the first heading.
    pub title: String,
    /// The whole document.
    pub html: String,
    /// The second-level headings: anchor and text.
    pub sections: Vec<(String, String)>,
}

/// A part of a document: text, or a code block with its info string.
#[derive(PartialEq, Eq, Debug)]
pub enum Part {
    /// Markdown between code blocks.
    Text(String),
    /// A code block: its info string (the language and the rest of the fence line) and its text.
    Code(String, String),
}

fn options() -> Options {
    Options::ENABLE_TABLES | Options::ENABLE_STRIKETHROUGH
}

/// Converts a document. `link` maps the target of a link or an image to its new target.
pub fn to_html(
    markdown: &str,
    mut link: impl FnMut(&str) -> Result<String, String>,
) -> Result<Document, String> {
    let mut document = Document::default();
    let mut events = Vec::new();
    let mut anchors = Anchors::default();
    let mut parser = Parser::new_ext(markdown, options());
    while let Some(event) = parser.next() {
        match event {
            Event::Start(Tag::Heading { level, .. }) => {
                let inner = take_until(&mut parser, |end| matches!(end, TagEnd::Heading(_)));
                let heading = heading(level, inner, &mut anchors, &mut link)?;
                document.note_heading(level, &heading);
                events.push(Event::Html(heading.html.into()));
            }
            Event::Start(Tag::CodeBlock(kind)) => {
                let inner = take_until(&mut parser, |end| matches!(end, TagEnd::CodeBlock));
                let text: String = inner.iter().map(text_of).collect();
                let words = match &kind {
                    CodeBlockKind::Fenced(words) => words.as_ref(),
                    CodeBlockKind::Indented => "",
                };
                events.push(Event::Html(code_html(words, &text).into()));
            }
            Event::Start(Tag::Table(columns)) => {
                events.push(Event::Html("<div class=\"table\" tabindex=\"0\">".into()));
                events.push(Event::Start(Tag::Table(columns)));
            }
            Event::End(TagEnd::Table) => {
                events.push(Event::End(TagEnd::Table));
                events.push(Event::Html("</div>\n".into()));
            }
            other => events.push(with_target(other, &mut link)?),
        }
    }
    pulldown_cmark::html::push_html(&mut document.html, events.into_iter());
    Ok(document)
}

impl Document {
    fn note_heading(&mut self, level: HeadingLevel, heading: &Heading) {
        match level {
            HeadingLevel::H1 if self.title.is_empty() => self.title.clone_from(&heading.text),
            HeadingLevel::H2 => self.sections.push((heading.anchor.clone(), heading.text.clone())),
            _ => {}
        }
    }
}

/// Returns the events before an end tag, and consumes the end tag.
fn take_until<'a>(parser: &mut Parser<'a>, is_end: impl Fn(&TagEnd) -> bool) -> Vec<Event<'a>> {
    let ends = |event: &Event<'_>| matches!(event, Event::End(end) if is_end(end));
    parser.by_ref().take_while(|event| !ends(event)).collect()
}

/// Replaces the target of a link or image event using `link`.
fn with_target<'a>(
    event: Event<'a>,
    link: &mut impl FnMut(&str) -> Result<String, String>,
) -> Result<Event<'a>, String> {
    Ok(match event {
        Event::Start(Tag::Link { link_type, dest_url, title, id }) => {
            let dest_url = CowStr::from(link(&dest_url)?);
            Event::Start(Tag::Link { link_type, dest_url, title, id })
        }
        Event::Start(Tag::Image { link_type, dest_url, title, id }) => {
            let dest_url = CowStr::from(link(&dest_url)?);
            Event::Start(Tag::Image { link_type, dest_url, title, id })
        }
        other => other,
    })
}

fn text_of<'a>(event: &'a Event<'a>) -> &'a str {
    match event {
        Event::Text(text) | Event::Code(text) => text,
        Event::SoftBreak | Event::HardBreak => " ",
        _ => "",
    }
}

/// A heading with its anchor.
struct Heading {
    anchor: String,
    text: String,
    html: String,
}

fn heading<'a>(
    level: HeadingLevel,
    inner: Vec<Event<'a>>,
    anchors: &mut Anchors,
    link: &mut impl FnMut(&str) -> Result<String, String>,
) -> Result<Heading, String> {
    let text: String = inner.iter().map(text_of).collect();
    let anchor = anchors.anchor(&text);
    let inner: Vec<Event<'a>> =
        inner.into_iter().map(|event| with_target(event, link)).collect::<Result<_, _>>()?;
    let mut content = String::new();
    pulldown_cmark::html::push_html(&mut content, inner.into_iter());
    let html = format!("<{level} id=\"{anchor}\">{content}</{level}>\n");
    Ok(Heading { anchor, text, html })
}

/// The number of uses of each anchor. A repeated anchor gets a number.
#[derive(Default)]
struct Anchors(BTreeMap<String, usize>);

impl Anchors {
    fn anchor(&mut self, text: &str) -> String {
        let slug = slug(text);
        let count = self.0.entry(slug.clone()).or_default();
        *count += 1;
        if *count == 1 { slug } else { format!("{slug}-{}", *count - 1) }
    }
}

/// Returns the anchor of a heading, as on GitHub: letters, digits, `-` and `_` are kept, and spaces
/// become `-`.
pub fn slug(text: &str) -> String {
    let kept = text.to_lowercase();
    let kept = kept.chars().filter(|c| c.is_alphanumeric() || matches!(c, ' ' | '-' | '_'));
    kept.map(|c| if c == ' ' { '-' } else { c }).collect()
}

/// Formats code as an HTML code block, with the file name above it if `words` has one.
pub fn code_html(words: &str, text: &str) -> String {
    let mut words = words.split([' ', ',']);
    let language = words.next().unwrap_or_default();
    let file = words.next().filter(|word| word.contains('.'));
    let lines = text.lines().filter(|line| language != "rust" || !is_hidden_line(line));
    let code: Vec<String> = lines.map(|line| line_html(language, line)).collect();
    let name = file.map(|file| format!("<span class=\"file\">{}</span>", escape(file)));
    format!(
        "{}<pre class=\"{}\" tabindex=\"0\"><code>{}</code></pre>\n",
        name.unwrap_or_default(),
        escape(language),
        code.join("\n")
    )
}

/// Returns whether a line in an example is only for documentation tests, not for readers.
fn is_hidden_line(line: &str) -> bool {
    line == "#" || line.starts_with("# ")
}

/// Formats a line of code, with its comment in a separate element.
fn line_html(language: &str, line: &str) -> String {
    let mark = match language {
        "rust" | "ron" | "json" | "js" => "//",
        "sh" | "toml" | "python" | "yaml" => "# ",
        _ => return escape(line),
    };
    // Within strings, such as URLs and colors, the mark does not begin a comment.
    let begins = |at: &usize| *at == 0 || line[..*at].ends_with(' ') && quotes(&line[..*at]);
    match line.match_indices(mark).map(|(at, _)| at).find(begins) {
        Some(at) => format!("{}<i>{}</i>", escape(&line[..at]), escape(&line[at..])),
        None => escape(line),
    }
}

/// Returns whether all quotes are closed.
fn quotes(text: &str) -> bool {
    text.matches('"').count().is_multiple_of(2) && text.matches('\'').count().is_multiple_of(2)
}

/// Escapes text for HTML, including attributes.
pub fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

/// Splits a document at its fenced code blocks.
pub fn divide(markdown: &str) -> Vec<Part> {
    let mut parts = Vec::new();
    let mut from = 0;
    let mut open: Option<(String, String)> = None;
    for (event, range) in Parser::new_ext(markdown, options()).into_offset_iter() {
        match event {
            Event::Start(Tag::CodeBlock(CodeBlockKind::Fenced(words))) => {
                parts.push(Part::Text(markdown[from..range.start].to_owned()));
                open = Some((words.into_string(), String::new()));
                from = range.end;
            }
            Event::Text(text) => {
                if let Some((_, code)) = &mut open {
                    code.push_str(&text);
                }
            }
            Event::End(TagEnd::CodeBlock) => {
                parts.extend(open.take().map(|(words, code)| Part::Code(words, code)));
            }
            _ => {}
        }
    }
    parts.push(Part::Text(markdown[from..].to_owned()));
    parts
}

#[cfg(test)]
mod tests {
    use super::*;

    fn html(markdown: &str) -> Document {
        to_html(markdown, |target| Ok(format!("to/{target}"))).expect("every link has a target")
    }

    #[test]
    fn repeated_heading_anchors_get_numbers() {
        let document = html("# A `b` — c, d\n\n## Twice\n\n## Twice\n");
        assert_eq!(document.title, "A b — c, d");
        let anchors: Vec<&str> = document.sections.iter().map(|(at, _)| at.as_str()).collect();
        assert_eq!(anchors, ["twice", "twice-1"]);
        assert!(
            document.html.contains("<h1 id=\"a-b--c-d\">A <code>b</code>"),
            "{}",
            document.html
        );
    }

    #[test]
    fn the_caller_replaces_the_targets_of_links_and_images() {
        let html = html("[a](x.md) ![b](y.png)").html;
        assert!(html.contains("href=\"to/x.md\"") && html.contains("src=\"to/y.png\""), "{html}");
        assert!(to_html("[a](x)", |_| Err("no x".into())).is_err());
    }

    #[test]
    fn code_is_escaped_and_comments_are_marked_up() {
        assert_eq!(line_html("sh", "a <b> '# c' # d"), "a &lt;b&gt; '# c' <i># d</i>");
        assert_eq!(line_html("ron", "(\"http://x\") // y"), "(&quot;http://x&quot;) <i>// y</i>");
        assert!(!code_html("rust", "# hidden\nshown();").contains("hidden"));
        assert!(code_html("ron two.ron", "Scene()").starts_with("<span class=\"file\">two.ron<"));
    }

    #[test]
    fn documents_are_split_at_code_blocks() {
        let parts = divide("# A\n\n```sh\nx\n```\n\nb\n");
        let [Part::Text(before), Part::Code(words, code), Part::Text(after)] = &parts[..] else {
            panic!("{parts:?}")
        };
        assert_eq!((words.as_str(), code.as_str()), ("sh", "x\n"));
        assert!(before.contains("# A") && after.contains('b'));
    }
}
