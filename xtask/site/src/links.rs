//! Checks the pages: every link must lead to a file of the site and to an existing anchor, nothing
//! may be loaded from another host, and there must be no scripts.

use crate::files::{folder_of, join, names_in, read_text};
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

/// The result of checking a site.
#[derive(Debug)]
pub struct LinkReport {
    pages: usize,
    links: usize,
    others: usize,
}

impl std::fmt::Display for LinkReport {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { pages, links, others } = self;
        write!(
            f,
            "{pages} pages, {links} links checked, {others} links to other sites not followed"
        )
    }
}

/// Checks all pages below a folder.
pub fn check_links(folder: &Path) -> Result<LinkReport, String> {
    let mut files = BTreeSet::new();
    list_files(folder, "", &mut files)?;
    let mut texts = BTreeMap::new();
    for path in files.iter().filter(|path| path.ends_with(".html")) {
        texts.insert(path.clone(), read_text(&folder.join(path))?);
    }
    let anchors: BTreeMap<&String, BTreeSet<&str>> =
        texts.iter().map(|(path, text)| (path, values(text, " id=\"").collect())).collect();
    let mut report = LinkReport { pages: texts.len(), links: 0, others: 0 };
    let mut faults = Vec::new();
    for (page, text) in &texts {
        faults.extend(foreign_parts(page, text));
        faults.extend(repeated_anchors(page, text));
        for target in values(text, " href=\"").chain(values(text, " src=\"")) {
            if target.contains("://") || target.starts_with("mailto:") {
                report.others += 1;
                continue;
            }
            report.links += 1;
            let (path, anchor) = target.split_once('#').unwrap_or((target, ""));
            let path =
                if path.is_empty() { Some(page.clone()) } else { join(folder_of(page), path) };
            let path = path.unwrap_or_default();
            let has_anchor = || anchors.get(&path).is_some_and(|known| known.contains(anchor));
            if !files.contains(&path) || !anchor.is_empty() && !has_anchor() {
                faults.push(format!("{page}: `{target}` does not exist"));
            }
        }
    }
    if faults.is_empty() { Ok(report) } else { Err(faults.join("\n")) }
}

/// Returns the values of an attribute in all tags. Every `<` begins a tag, because it is escaped in
/// text.
fn values<'a>(text: &'a str, start: &'a str) -> impl Iterator<Item = &'a str> {
    let tags = text.split('<').skip(1).filter_map(|rest| rest.split('>').next());
    tags.filter_map(move |tag| tag.split_once(start)?.1.split('"').next())
}

/// Finds scripts, and pictures and styles from other hosts.
fn foreign_parts(page: &str, text: &str) -> Vec<String> {
    let mut faults = Vec::new();
    if text.contains("<script") {
        faults.push(format!("{page}: contains a script, which is not allowed"));
    }
    let tags = text.split('<').filter(|tag| tag.starts_with("img ") || tag.starts_with("link "));
    let foreign = tags.filter(|tag| tag.contains("\"http") || tag.contains("\"//"));
    faults.extend(foreign.map(|tag| format!("{page}: loaded from another host: <{tag}")));
    faults
}

/// Finds duplicate anchors on a page.
fn repeated_anchors(page: &str, text: &str) -> Vec<String> {
    let mut seen = BTreeSet::new();
    let twice = values(text, " id=\"").filter(|anchor| !seen.insert(*anchor));
    twice.map(|anchor| format!("{page}: `#{anchor}` occurs twice")).collect()
}

fn list_files(root: &Path, below: &str, found: &mut BTreeSet<String>) -> Result<(), String> {
    for name in names_in(&root.join(below))? {
        let path = if below.is_empty() { name } else { format!("{below}/{name}") };
        if root.join(&path).is_dir() {
            list_files(root, &path, found)?;
        } else {
            found.insert(path);
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scripts_and_pictures_from_other_hosts_are_found() {
        let faults = |text: &str| {
            foreign_parts("a.html", text).len() + repeated_anchors("a.html", text).len()
        };
        assert_eq!(faults("<a href=\"https://example.org\">x</a> <img src=\"b.png\">"), 0);
        assert_eq!(faults("<img src=\"https://example.org/b.png\">"), 1);
        assert_eq!(faults("<script>x</script>"), 1);
        assert_eq!(faults("<p id=\"a\"><p id=\"a\">"), 1);
    }

    #[test]
    fn links_lead_to_files_and_anchors() {
        let folder = std::env::temp_dir().join(format!("alberti-links-{}", std::process::id()));
        let write = |text: &str| crate::files::write(&folder.join("b/a.html"), text.as_bytes());
        let check = |text: &str| write(text).and_then(|()| check_links(&folder)).is_ok();
        let found = [
            "<p id=\"x\"><a href=\"#x\">",
            "<a href=\"../b/a.html\">",
            "<a href=\"https://a.org\">",
        ];
        let lost = ["<a href=\"#x\">", "<a href=\"c.html\">", "<a href=\"../../a.html\">"];
        let right = found.iter().all(|text| check(text)) && !lost.iter().any(|text| check(text));
        std::fs::remove_dir_all(&folder).expect("the test folder");
        assert!(right);
    }
}
