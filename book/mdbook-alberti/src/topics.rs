//! The topics: their titles, the sections that cover them, and the table on the page `topics`.

use crate::language::Language;
use crate::marks::is_topic;
use crate::page::Page;
use std::collections::BTreeMap;
use std::fmt::Write as _;

/// The page that collects misprints. The topic table lists the sections of other pages first.
const MISPRINTS: &str = "printed-wrong";

/// Pages that mention topics without covering them.
const LISTS: [&str; 1] = ["topics"];

/// The topics in the order of the conformance table.
#[derive(Default)]
pub struct Topics {
    list: Vec<(String, String)>,
}

impl Topics {
    /// Parses the rows `| C1 | title | … |` of the conformance table.
    pub fn parse(table: &str) -> Self {
        let row = |line: &str| {
            let mut cells = line.strip_prefix('|')?.split('|').map(str::trim);
            let (id, title) = (cells.next()?, cells.next()?);
            is_topic(id).then(|| (id.to_owned(), title.to_owned()))
        };
        let mut list: Vec<(String, String)> = Vec::new();
        for (id, title) in table.lines().filter_map(row) {
            if !list.iter().any(|(other, _)| *other == id) {
                list.push((id, title));
            }
        }
        Self { list }
    }

    /// Returns the topics with translated titles.
    pub fn translated(&self, translate: impl Fn(&str) -> String) -> Self {
        let list = self.list.iter().map(|(id, title)| (id.clone(), translate(title))).collect();
        Self { list }
    }

    /// Returns all titles.
    pub fn titles(&self) -> impl Iterator<Item = &str> {
        self.list.iter().map(|(_, title)| title.as_str())
    }

    /// Returns all ids.
    pub fn ids(&self) -> impl Iterator<Item = &str> {
        self.list.iter().map(|(id, _)| id.as_str())
    }

    /// Returns the title of a topic.
    pub fn title(&self, id: &str) -> &str {
        self.list.iter().find(|(other, _)| other == id).map_or("", |(_, title)| title)
    }

    /// Renders the topic table as Markdown.
    pub fn table(&self, pages: &[Page], language: Language) -> String {
        let places = places(pages);
        let [id, topic, place] = language.texts().topics;
        let mut out = format!("| {id} | {topic} | {place} |\n| --- | --- | --- |\n");
        for (id, title) in &self.list {
            let links = places.get(id.as_str()).map_or(String::new(), |places| {
                let mut places = places.clone();
                places.sort_by_key(|(page, _)| page.name == MISPRINTS);
                let link = |(page, section): &(&Page, usize)| {
                    link(page, *section, id, language.texts().colon)
                };
                places.iter().map(link).collect::<Vec<_>>().join("<br>")
            });
            // Writing to a string cannot fail.
            let _ = writeln!(out, "| <a id=\"{id}\"></a>{id} | {title} | {links} |");
        }
        out
    }

    /// Returns the topics that no page marks.
    pub fn missing(&self, pages: &[Page]) -> Vec<&str> {
        let places = places(pages);
        let ids = self.list.iter().map(|(id, _)| id.as_str());
        ids.filter(|id| !places.contains_key(id)).collect()
    }
}

/// Finds the first mark of each topic on each page.
fn places(pages: &[Page]) -> BTreeMap<&str, Vec<(&Page, usize)>> {
    let mut places: BTreeMap<&str, Vec<(&Page, usize)>> = BTreeMap::new();
    for page in pages.iter().filter(|page| !LISTS.contains(&page.name.as_str())) {
        for span in page.english.spans.iter().filter(|span| is_topic(&span.code)) {
            let places = places.entry(&span.code).or_default();
            if !places.iter().any(|(other, _)| other.name == page.name) {
                places.push((page, span.section));
            }
        }
    }
    places
}

/// Returns a link to a topic's mark, labeled with the titles of the page and the section.
fn link(page: &Page, section: usize, id: &str, colon: &str) -> String {
    let heading = section.checked_sub(1).and_then(|at| page.marks.headings.get(at));
    let section = heading
        .filter(|heading| heading.level > 1)
        .map(|heading| format!("{colon}{}", heading.text.replace(['$', '|', '[', ']'], "").trim()));
    format!("[{}{}]({}.md#{id})", page.title, section.unwrap_or_default(), page.name)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::marks::Marks;

    #[test]
    fn the_table_lists_the_section_of_each_topic() {
        let topics = Topics::parse(
            "| id | topic |\n| --- | --- |\n| C1 | One | x |\n| M2 | Two | y |\n| C3 | Three |\n",
        );
        let text = "# T\n\n## Here\n\n`C1` and `C1`\n";
        let (english, marks) = (Marks::read(text), Marks::read(text));
        let page =
            Page { name: "p".into(), title: "Page".into(), english, text: text.into(), marks };
        let pages = [page];
        assert_eq!(topics.missing(&pages), ["M2", "C3"]);
        let table = topics.table(&pages, Language::English);
        assert!(table.contains("| <a id=\"C1\"></a>C1 | One | [Page: Here](p.md#C1) |"), "{table}");
    }
}
