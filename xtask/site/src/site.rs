//! The site under construction: its pages, the locations of repository files in the site, and the
//! files that are yet to be copied.

use crate::files::{self, copy, folder_of, join, relative, write};
use crate::markdown::{Document, to_html};
use crate::{Outcome, template};
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// The groups in the menu, in order.
const GROUPS: [&str; 6] = ["Alberti", "Guides", "Reference", "Documents", "Crates", "Project"];

/// A page.
pub struct Page {
    /// Its group in the menu, or `None` if only other pages link to it.
    pub group: Option<&'static str>,
    /// Its content.
    pub document: Document,
}

/// The site.
pub struct Site {
    /// The repository folder.
    pub root: PathBuf,
    /// The output folder.
    pub out: PathBuf,
    /// The pages, by path in the site.
    pages: BTreeMap<String, Page>,
    /// The pages in the menu, in order.
    menu: Vec<String>,
    /// The locations of repository files in the site.
    places: BTreeMap<String, String>,
    /// Repository files that pages link to but that have not been added yet.
    pub wanted: BTreeSet<String>,
}

impl Site {
    /// Creates a site without pages.
    pub fn new(root: &Path, out: &Path) -> Self {
        Self {
            root: root.to_owned(),
            out: out.to_owned(),
            pages: BTreeMap::new(),
            menu: Vec::new(),
            places: BTreeMap::new(),
            wanted: BTreeSet::new(),
        }
    }

    /// Writes a text file.
    pub fn write_text(&self, path: &str, text: &str) -> Outcome {
        write(&self.out.join(path), text.as_bytes())
    }

    /// Sets the location of a repository file in the site.
    pub fn place(&mut self, source: &str, path: &str) {
        self.places.insert(source.to_owned(), path.to_owned());
    }

    /// Returns the location of a repository file, if it has one.
    pub fn place_of(&self, source: &str) -> Option<&str> {
        self.places.get(source).map(String::as_str)
    }

    /// Copies a repository file unless it has already been copied, and returns its location.
    pub fn copy_file(&mut self, source: &str) -> Result<String, String> {
        let place = format!("files/{source}");
        if self.place_of(source).is_none() {
            copy(&self.root.join(source), &self.out.join(&place))?;
            self.place(source, &place);
        }
        Ok(self.place_of(source).unwrap_or(&place).to_owned())
    }

    /// Adds a page and, if it has a group, appends it to the menu.
    pub fn add_page(&mut self, path: &str, group: Option<&'static str>, document: Document) {
        if group.is_some() {
            self.menu.push(path.to_owned());
        }
        self.pages.insert(path.to_owned(), Page { group, document });
    }

    /// Converts the Markdown of a repository file for a page.
    pub fn translate(
        &mut self,
        source: &str,
        page: &str,
        markdown: &str,
    ) -> Result<Document, String> {
        to_html(markdown, |target| self.target(source, page, target))
            .map_err(|error| format!("{source}: {error}"))
    }

    /// Returns the new target of a link in a document, relative to the document's page.
    fn target(&mut self, source: &str, page: &str, target: &str) -> Result<String, String> {
        if target.contains("://") || target.starts_with("mailto:") || target.starts_with('#') {
            return Ok(target.to_owned());
        }
        let (path, anchor) = target.split_once('#').map_or((target, ""), |(path, at)| (path, at));
        let path = join(folder_of(source), path)
            .ok_or_else(|| format!("`{target}` leaves the repository"))?;
        let path = match self.root.join(&path) {
            folder if folder.join("README.md").is_file() => format!("{path}/README.md"),
            file if file.exists() => path,
            _ => return Err(format!("`{target}` does not exist")),
        };
        let place = match self.place_of(&path) {
            Some(place) => place.to_owned(),
            None => {
                let place = crate::documents::place_for(&self.root, &path);
                self.wanted.insert(path.clone());
                self.place(&path, &place);
                place
            }
        };
        let anchor = if anchor.is_empty() { String::new() } else { format!("#{anchor}") };
        Ok(relative(page, &place) + &anchor)
    }

    /// Writes all pages.
    pub fn write_pages(&self) -> Outcome {
        for (path, page) in &self.pages {
            let menu = self.menu_html(path);
            self.write_text(path, &template::page_html(path, page, &menu))?;
        }
        Ok(())
    }

    /// Returns the menu for a page.
    fn menu_html(&self, current: &str) -> String {
        let mut html = String::new();
        for group in GROUPS {
            let members = self.menu.iter().filter(|path| self.pages[*path].group == Some(group));
            let item = |path: &String| {
                template::menu_item(current, path, &self.pages[path].document.title)
            };
            html += &format!(
                "<h2>{group}</h2>\n<ul>\n{}</ul>\n",
                members.map(item).collect::<String>()
            );
        }
        html
    }

    /// Returns the names in a repository folder.
    pub fn names_in(&self, folder: &str) -> Result<Vec<String>, String> {
        files::names_in(&self.root.join(folder))
    }

    /// Reads the text of a repository file.
    pub fn read_text(&self, path: &str) -> Result<String, String> {
        files::read_text(&self.root.join(path))
    }
}
