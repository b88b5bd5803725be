//! Replaces the marks in a page with the HTML that they represent.

use crate::command::{Job, Kind};
use crate::figure::{Figure, FigureMark, escape_attribute};
use crate::formula::Formulas;
use crate::language::Language;
use crate::marks::{CodeSpan, Fence, Marks, inline_formula, is_topic, parse};
use crate::topics::Topics;
use pulldown_cmark::{Event, html};
use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;
use std::path::PathBuf;

/// The output file of each command in the book, or an error message.
pub type Answers = BTreeMap<Job, Result<PathBuf, String>>;

/// A page of an edition.
pub struct Page {
    /// The file name without `.md`.
    pub name: String,
    /// The title in the table of contents.
    pub title: String,
    /// The marks of the English source.
    pub english: Marks,
    /// The text in the edition's language.
    pub text: String,
    /// The marks of `text`.
    pub marks: Marks,
}

/// A renderer of pages, with the data that all pages share.
pub struct Renderer<'a> {
    /// The edition's language.
    pub language: Language,
    /// The formula converter.
    pub formulas: &'a Formulas,
    /// The outputs of the commands.
    pub answers: &'a Answers,
    /// The topics, with titles in the edition's language.
    pub topics: &'a Topics,
    /// The topic table as Markdown.
    pub topics_table: &'a str,
    /// Whether the explorer's page is published with the book.
    pub has_explorer: bool,
}

/// A range of a text and its replacement.
type Edit = (Range<usize>, String);

/// Returns the command of a block, if any.
pub fn block_job(fence: &Fence, language: Language) -> Option<Result<Job, String>> {
    match fence.kind() {
        "alberti" => Some(FigureMark::parse(fence).map(|mark| mark.job)),
        "explain" => Some(Job::parse(&fence.body, Kind::Text).map(|job| {
            // The output of other commands does not depend on the language.
            let is_bilingual = job.words.first().is_some_and(|word| word == "exercise");
            let is_chinese = is_bilingual && language == Language::Chinese;
            Job { kind: if is_chinese { Kind::ChineseText } else { Kind::Text }, ..job }
        })),
        _ => None,
    }
}

impl Renderer<'_> {
    /// Renders a page to Markdown for mdBook, or returns all errors with line numbers in the
    /// English source.
    pub fn render(&self, page: &Page) -> Result<String, Vec<String>> {
        let mut faults = Vec::new();
        let mut edits = Vec::new();
        self.edit_headings(page, &mut edits, &mut faults);
        if page.marks.fences.len() != page.english.fences.len() {
            faults.push(format!("{}.md: the translation adds or loses fenced blocks", page.name));
        }
        let mut done: Vec<Range<usize>> = Vec::new();
        for (fence, source) in page.marks.fences.iter().zip(&page.english.fences) {
            match self.block(fence) {
                Ok(None) => {}
                Ok(Some(html)) => {
                    let end = fence.caption.as_ref().filter(|_| fence.kind() == "alberti");
                    let range = fence.range.start..end.map_or(fence.range.end, |it| it.range.end);
                    done.push(range.clone());
                    let is_followed = !page.text[range.end..].starts_with("\n\n");
                    edits.push((range, if is_followed { html + "\n" } else { html }));
                }
                Err(fault) => faults.push(format!("{}.md:{}: {fault}", page.name, source.line)),
            }
        }
        let is_outside = |span: &&CodeSpan| !done.iter().any(|it| it.contains(&span.range.start));
        let mut seen = BTreeSet::new();
        for span in page.marks.spans.iter().filter(is_outside) {
            match self.span(&span.code, &mut seen) {
                Ok(html) => edits.extend(html.map(|html| (span.range.clone(), html))),
                Err(fault) => {
                    faults.push(format!("{}.md:{}: {fault}", page.name, self.line(page, span)))
                }
            }
        }
        if faults.is_empty() {
            Ok(self.editions(&page.name) + &apply(&page.text, edits))
        } else {
            Err(faults)
        }
    }

    /// Returns the line number of a code span in the English source, or `in the translation`.
    fn line(&self, page: &Page, span: &CodeSpan) -> String {
        let mut same = page.english.spans.iter().filter(|other| other.code == span.code);
        same.next().map_or("in the translation".into(), |other| other.line.to_string())
    }

    /// Gives headings the ids of the English headings, so that links work in every language.
    fn edit_headings(&self, page: &Page, edits: &mut Vec<Edit>, faults: &mut Vec<String>) {
        if page.marks.headings.len() != page.english.headings.len() {
            faults.push(format!("{}.md: the translation adds or loses headings", page.name));
        }
        let ids = page.english.heading_ids();
        for (heading, id) in page.marks.headings.iter().zip(ids) {
            if heading.id.is_none() {
                let end = heading.range.start + page.text[heading.range.clone()].trim_end().len();
                edits.push((end..end, format!(" {{#{id}}}")));
            }
        }
    }

    /// Renders a fenced block, or returns `None` if it is ordinary code.
    fn block(&self, fence: &Fence) -> Result<Option<String>, String> {
        match fence.kind() {
            "alberti" => self.figure(fence).map(Some),
            "explain" => self.numbers(fence).map(Some),
            "formula" => {
                let id = Some(fence.arguments()).filter(|id| !id.is_empty());
                self.formulas.block(&fence.body, id).map(Some)
            }
            "topics" => Ok(Some(self.topics_table.to_owned())),
            _ => Ok(None),
        }
    }

    fn figure(&self, fence: &Fence) -> Result<String, String> {
        let mark = FigureMark::parse(fence)?;
        let path = self.answer(&mark.job)?;
        let caption = fence.caption.as_ref().map_or("", |caption| caption.text.as_str());
        let figure = Figure {
            path: &path,
            caption: &self.inline_html(caption)?,
            alt: &plain_text(caption),
            explore: mark.explore.as_deref().filter(|_| self.has_explorer),
            language: self.language,
        };
        figure.to_html()
    }

    /// Renders a command and its output.
    fn numbers(&self, fence: &Fence) -> Result<String, String> {
        let job = block_job(fence, self.language).ok_or("no command")??;
        let path = self.answer(&job)?;
        let text = std::fs::read_to_string(&path)
            .map_err(|error| format!("{}: {error}", path.display()))?;
        let command = escape_attribute(fence.body.trim());
        let shown = format!(
            "<span class=\"command\">$ {command}</span>\n{}",
            escape_attribute(text.trim_end())
        );
        // Line breaks are written as character references, so the block stays on one line of
        // Markdown, even in a list.
        let shown = shown.replace('\n', "&#10;");
        Ok(format!(
            "<pre class=\"explain\"><code class=\"language-text nohighlight\">{shown}</code></pre>"
        ))
    }

    fn answer(&self, job: &Job) -> Result<PathBuf, String> {
        match self.answers.get(job) {
            Some(Ok(path)) => Ok(path.clone()),
            Some(Err(fault)) => Err(format!("`alberti {}`: {fault}", job.words.join(" "))),
            None => Err("the command did not run".into()),
        }
    }

    /// Renders a code span if it is a mark. A topic's first mark on a page is an anchor.
    fn span(&self, code: &str, seen: &mut BTreeSet<String>) -> Result<Option<String>, String> {
        if let Some(latex) = inline_formula(code) {
            return self.formulas.inline(latex).map(Some);
        }
        if !is_topic(code) {
            return Ok(None);
        }
        let anchor =
            if seen.insert(code.to_owned()) { format!(" id=\"{code}\"") } else { String::new() };
        let title = escape_attribute(&plain_text(self.topics.title(code)));
        let (word, colon) = (self.language.texts().topic, self.language.texts().colon);
        Ok(Some(format!(
            "<a class=\"topic\"{anchor} href=\"topics.html#{code}\" title=\"{word} {code}{colon}{title}\">{code}</a>"
        )))
    }

    /// Renders a line of Markdown, including marks, as HTML.
    fn inline_html(&self, markdown: &str) -> Result<String, String> {
        let mut edits = Vec::new();
        for span in Marks::read(markdown).spans {
            // Anchors are placed in the text, not in captions.
            let mut seen = BTreeSet::from([span.code.clone()]);
            edits.extend(self.span(&span.code, &mut seen)?.map(|html| (span.range, html)));
        }
        let text = apply(markdown, edits);
        let mut out = String::new();
        html::push_html(&mut out, parse(&text));
        let out = out.trim();
        Ok(out.strip_prefix("<p>").and_then(|it| it.strip_suffix("</p>")).unwrap_or(out).to_owned())
    }

    /// Renders the links to the same page in the other languages.
    fn editions(&self, page: &str) -> String {
        let others = Language::ALL.into_iter().filter(|language| *language != self.language);
        let links: String = others
            .map(|other| {
                let (code, name) = (other.code(), other.texts().name);
                format!("<a href=\"../{code}/{page}.html\" lang=\"{code}\" hreflang=\"{code}\" rel=\"alternate\">{name}</a>")
            })
            .collect();
        let label = self.language.texts().languages;
        format!("<nav class=\"editions\" aria-label=\"{label}\">{links}</nav>\n\n")
    }
}

/// Applies replacements to a text.
fn apply(text: &str, mut edits: Vec<Edit>) -> String {
    edits.sort_by_key(|(range, _)| (range.start, range.end));
    let mut out = String::new();
    let mut at = 0;
    for (range, replacement) in edits {
        out.push_str(&text[at..range.start]);
        out.push_str(&replacement);
        at = range.end;
    }
    out + &text[at..]
}

/// Strips markup, topic marks and the dollar signs of formulas from Markdown.
pub fn plain_text(markdown: &str) -> String {
    let text = parse(markdown).filter_map(|event| match event {
        Event::Text(text) => Some(text.to_string()),
        Event::Code(code) if is_topic(&code) => None,
        Event::Code(code) => Some(inline_formula(&code).unwrap_or(&code).to_owned()),
        Event::SoftBreak => Some(" ".to_owned()),
        _ => None,
    });
    text.collect::<String>().trim().to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_order_of_edits_does_not_matter() {
        assert_eq!(apply("abcd", vec![(3..3, "X".into()), (0..1, "Y".into())]), "YbcXd");
    }

    #[test]
    fn alternative_text_has_no_markup() {
        assert_eq!(plain_text("A *b* `$x'$` `C4`."), "A b x' .");
    }
}
