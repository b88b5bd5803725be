//! The public interface of a crate as text, extracted from rustdoc's pages.
//!
//! ```text
//! homog::PixelRect
//!     pub struct PixelRect {
//!         pub x: u32,
//!     }
//!     impl PixelRect
//!         pub const fn area(self) -> usize
//!     impl Clone for PixelRect
//! ```
//! Rustdoc can write this as JSON, but only with the nightly compiler. Its pages exist after every
//! documentation build. Automatic and blanket implementations are omitted, because they can be
//! derived from the rest.

use crate::workspace::read_text;
use std::path::Path;

/// Returns the listing of a crate, given the folder with its pages.
///
/// Pages of removed items remain in the folder, so only pages in the list of all items are read.
pub fn crate_listing(folder: &Path) -> Result<String, String> {
    let all = read_text(&folder.join("all.html"))?;
    let name = folder.file_name().unwrap_or_default().to_string_lossy();
    let mut items = Vec::new();
    for page in listed_pages(&all) {
        if let Some(item) = item_name(&name, page) {
            items.push((item, item_lines(&read_text(&folder.join(page))?)));
        }
    }
    items.sort();
    let text = |(name, lines): &(String, Vec<String>)| {
        let lines: String = lines.iter().map(|line| format!("    {line}\n")).collect();
        format!("{name}\n{lines}")
    };
    Ok(items.iter().map(text).collect())
}

/// Returns the pages that the list of all items links to, relative to its folder.
fn listed_pages(all: &str) -> impl Iterator<Item = &str> {
    let list = all.split_once("class=\"all-items\"").map_or("", |(_, list)| list);
    let links = list.split("href=\"").skip(1).filter_map(|rest| rest.split('"').next());
    links.filter(|link| {
        !link.starts_with("http") && !link.starts_with("..") && link.ends_with(".html")
    })
}

/// The file name prefixes of pages with a declaration.
const KINDS: [&str; 9] =
    ["struct", "enum", "union", "trait", "fn", "type", "constant", "static", "macro"];

/// Returns the path of a page's item, such as `homog::PixelRect`, or `None` for other pages.
fn item_name(name: &str, page: &str) -> Option<String> {
    let (modules, file) = page.rsplit_once('/').unwrap_or(("", page));
    let (kind, item) = file.strip_suffix(".html")?.split_once('.')?;
    let parts = std::iter::once(name).chain(modules.split('/')).chain([item]);
    let path: Vec<&str> = parts.filter(|part| !part.is_empty()).collect();
    KINDS.contains(&kind).then(|| path.join("::"))
}

/// Headings that end the relevant part: the text after them can be derived from the rest of the
/// page or belongs to another item.
const ENDS: [&str; 5] = [
    "id=\"synthetic-implementations\"",
    "id=\"blanket-implementations\"",
    "id=\"implementors\"",
    "id=\"foreign-impls\"",
    "id=\"deref-methods-",
];

/// Returns the declaration on a page, its methods, and the traits that the item implements.
fn item_lines(page: &str) -> Vec<String> {
    let declaration = element(page, "<pre class=\"rust item-decl\">", "</pre>");
    let mut lines: Vec<String> = declaration
        .map(|html| plain_text(html).lines().map(|line| line.trim_end().to_owned()).collect())
        .unwrap_or_default();
    lines.retain(|line| !line.trim().is_empty());
    let Some(at) =
        page.find("id=\"implementations\"").or(page.find("id=\"trait-implementations\""))
    else {
        return lines;
    };
    let rest = &page[at..];
    let end = ENDS.iter().filter_map(|end| rest.find(end)).min().unwrap_or(rest.len());
    let (own, traits) = match rest[..end].find("id=\"trait-implementations\"") {
        Some(at) => rest[..end].split_at(at),
        None => (&rest[..end], ""),
    };
    lines.extend(headers(own, true));
    let mut implemented = headers(traits, false);
    implemented.sort();
    lines.extend(implemented);
    lines
}

/// Returns the code headings in a part of a page: implementations and, if requested, their methods.
fn headers(html: &str, with_methods: bool) -> Vec<String> {
    let starts = html.match_indices("class=\"code-header\">");
    let header = |(at, start): (usize, &str)| {
        let level = html[..at].rfind("<h").map_or("", |tag| &html[tag..]);
        let is_method = level.starts_with("<h4");
        let code = &html[at + start.len()..];
        let code = &code[..code.find(if is_method { "</h4>" } else { "</h3>" })?];
        let text = plain_text(code).split_whitespace().collect::<Vec<_>>().join(" ");
        (with_methods || !is_method).then(|| if is_method { format!("    {text}") } else { text })
    };
    // These are derived and mean nothing to callers.
    starts.filter_map(header).filter(|text| !text.contains("StructuralPartialEq")).collect()
}

/// Returns the content of the first element that begins with `start`.
fn element<'a>(page: &'a str, start: &str, end: &str) -> Option<&'a str> {
    let rest = &page[page.find(start)? + start.len()..];
    Some(&rest[..rest.find(end)?])
}

/// Returns the text of an HTML fragment, without tags and without the labels of foldable parts.
fn plain_text(html: &str) -> String {
    let mut text = String::new();
    let mut rest = html;
    while let Some(at) = rest.find('<') {
        text += &rest[..at];
        rest = &rest[at..];
        let end = if rest.starts_with("<summary") { "</summary>" } else { ">" };
        if rest.starts_with("<br") || rest.starts_with("<div class=\"where\"") {
            text.push('\n');
        }
        rest = rest.find(end).map_or("", |at| &rest[at + end.len()..]);
    }
    text += rest;
    [
        ("&lt;", "<"),
        ("&gt;", ">"),
        ("&quot;", "\""),
        ("&#39;", "'"),
        ("&nbsp;", " "),
        ("\u{a0}", " "),
    ]
    .iter()
    .fold(text, |text, (code, sign)| text.replace(code, sign))
    .replace("&amp;", "&")
}

#[cfg(test)]
mod tests {
    use super::*;

    const PAGE: &str = "<h1>x</h1><pre class=\"rust item-decl\"><code>pub struct A&lt;'a&gt; {\n    \
        pub b: &amp;'a <a href=\"u8.html\">u8</a>,\n}</code></pre>\
        <h2 id=\"implementations\">Implementations</h2>\
        <h3 class=\"code-header\">impl A<wbr></h3><h4 class=\"code-header\">pub fn <a>c</a>(self)</h4>\
        <h2 id=\"trait-implementations\">T</h2><h3 class=\"code-header\">impl Clone for A</h3>\
        <h4 class=\"code-header\">fn clone(&amp;self) -&gt; Self</h4>\
        <h3 class=\"code-header\">impl StructuralPartialEq for A</h3>\
        <h2 id=\"synthetic-implementations\">S</h2><h3 class=\"code-header\">impl Send for A</h3>";

    #[test]
    fn a_page_is_reduced_to_declaration_methods_and_traits() {
        let expected = [
            "pub struct A<'a> {",
            "    pub b: &'a u8,",
            "}",
            "impl A",
            "    pub fn c(self)",
            "impl Clone for A",
        ];
        assert_eq!(item_lines(PAGE), expected);
    }

    #[test]
    fn item_names_are_derived_from_their_pages() {
        let name = |page: &str| item_name("homog", page);
        assert_eq!(name("ray/struct.Ray.html").as_deref(), Some("homog::ray::Ray"));
        assert_eq!(name("fn.remap.html").as_deref(), Some("homog::remap"));
        assert_eq!((name("index.html"), name("mod.x.html")), (None, None));
        let all = "<a href=\"a.html\"></a><ul class=\"all-items\"><li><a href=\"struct.B.html\">B</a>\
            <a href=\"https://x/y.html\">";
        assert_eq!(listed_pages(all).collect::<Vec<_>>(), ["struct.B.html"]);
    }
}
