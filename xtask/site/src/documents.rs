//! Converts the repository's documents to pages: first the documents in the menu, then everything
//! they link to.

use crate::Outcome;
use crate::files::names_in;
use crate::markdown::{Document, code_html, escape};
use crate::site::Site;
use std::path::Path;

/// Documents that come first in the menu, under special names.
const FIRST: [(&str, &str, &str); 4] = [
    ("README.md", "Alberti", "Start"),
    ("docs/faq.md", "Alberti", "Questions"),
    ("docs/benchmarks.md", "Alberti", "Benchmarks"),
    ("CHANGELOG.md", "Alberti", "Changes"),
];

/// Documents that other modules convert to pages.
const ELSEWHERE: [&str; 1] = ["scenes/README.md"];

/// Adds the documents that have an entry in the menu. Guides are added elsewhere.
pub fn add_documents(site: &mut Site) -> Outcome {
    let mut listed: Vec<(String, &'static str)> = Vec::new();
    for (path, group, _) in FIRST {
        if site.root.join(path).is_file() {
            listed.push((path.to_owned(), group));
        }
    }
    let is_new = |path: &String| !FIRST.iter().any(|(first, ..)| path == first);
    let documents = |site: &Site, folder: &str| -> Result<Vec<String>, String> {
        let names = site.names_in(folder)?.into_iter().filter(|name| name.ends_with(".md"));
        let prefix = if folder.is_empty() { String::new() } else { format!("{folder}/") };
        Ok(names.map(|name| format!("{prefix}{name}")).filter(is_new).collect())
    };
    listed.extend(documents(site, "docs")?.into_iter().map(|path| (path, "Documents")));
    listed.extend(documents(site, "")?.into_iter().map(|path| (path, "Project")));
    for name in site.names_in("crates")? {
        let path = format!("crates/{name}/README.md");
        if site.root.join(&path).is_file() {
            listed.push((path, "Crates"));
        }
    }
    // All locations must be known before the first link is resolved.
    for (path, _) in &listed {
        let place = place_for(&site.root, path);
        site.place(path, &place);
    }
    for path in crate::guides::guide_paths(site)? {
        let place = place_for(&site.root, &path);
        site.place(&path, &place);
    }
    site.place(ELSEWHERE[0], crate::gallery::PAGE);
    listed.into_iter().try_for_each(|(path, group)| add_document(site, &path, Some(group)))
}

/// Adds the page of a document.
fn add_document(site: &mut Site, path: &str, group: Option<&'static str>) -> Outcome {
    let page = place_for(&site.root, path);
    let text = site.read_text(path)?;
    let mut document = site.translate(path, &page, &text)?;
    if let Some((_, _, title)) = FIRST.iter().find(|(first, ..)| *first == path) {
        (*title).clone_into(&mut document.title);
    } else if let Some(name) = crate_name(path) {
        // Use folder names as titles, because two READMEs have the same title.
        name.clone_into(&mut document.title);
    }
    site.add_page(&page, group, document);
    Ok(())
}

/// Returns the folder of the crate that a document describes.
fn crate_name(path: &str) -> Option<&str> {
    path.strip_prefix("crates/")?.strip_suffix("/README.md")
}

/// Adds everything that the pages link to, directly or indirectly.
pub fn add_linked_files(site: &mut Site) -> Outcome {
    while let Some(path) = site.wanted.pop_first() {
        let full = site.root.join(&path);
        if is_document(&path) {
            add_document(site, &path, None)?;
        } else if full.is_dir() {
            add_folder(site, &path)?;
        } else if is_shown_as_text(&path) {
            let text = site.read_text(&path)?;
            let language = path.rsplit_once('.').map_or("", |(_, ending)| ending);
            let language = if language == "rs" { "source" } else { language };
            add_source(site, &path, &code_html(language, &text));
        } else {
            crate::files::copy(&full, &site.out.join(place_for(&site.root, &path)))?;
        }
    }
    Ok(())
}

/// Adds a page that lists the contents of a folder.
fn add_folder(site: &mut Site, path: &str) -> Outcome {
    let names = names_in(&site.root.join(path))?;
    let items: String =
        names.iter().map(|name| format!("<li><code>{}</code></li>\n", escape(name))).collect();
    add_source(site, path, &format!("<ul>\n{items}</ul>\n"));
    Ok(())
}

fn add_source(site: &mut Site, path: &str, content: &str) {
    let title = escape(path);
    let html = format!("<h1>{title}</h1>\n{content}");
    let page = place_for(&site.root, path);
    site.add_page(&page, None, Document { title: path.to_owned(), html, ..Document::default() });
}

/// Returns the location in the site of a file or folder of the repository.
pub fn place_for(root: &Path, path: &str) -> String {
    match path {
        "README.md" => "index.html".into(),
        _ if is_document(path) => format!("{}.html", path.trim_end_matches(".md")),
        _ if root.join(path).is_dir() => format!("source/{path}/index.html"),
        _ if is_shown_as_text(path) => format!("source/{path}.html"),
        _ => format!("files/{path}"),
    }
}

/// Returns whether a file is a document of the site. Book pages are not: they contain markup that
/// only the book's own tool understands, so they are shown as plain text.
fn is_document(path: &str) -> bool {
    path.ends_with(".md") && !path.starts_with("book/src/")
}

/// Returns whether a file is shown on a page. Other files are copied unchanged.
fn is_shown_as_text(path: &str) -> bool {
    if path.starts_with("book/src/") {
        return true;
    }
    let name = path.rsplit('/').next().unwrap_or(path);
    let ending = name.rsplit_once('.').map_or("", |(_, ending)| ending);
    ["rs", "ron", "toml", "txt", "py", "mjs", "yml", "sh", "ipynb", ""].contains(&ending)
}
