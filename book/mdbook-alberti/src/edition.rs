//! Editions of the book: one per language, each built into a folder.

use crate::figure::copy_figures;
use crate::language::Language;
use crate::preprocessor::Alberti;
use crate::print_page;
use anyhow::{Context as _, Result, anyhow};
use mdbook_driver::MDBook;
use mdbook_driver::config::Config;
use mdbook_summary::{Summary, SummaryItem, parse_summary};
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex};

/// The sources, the program and the output folder of the editions.
pub struct Edition {
    /// The folder that contains `book.toml`.
    pub book: PathBuf,
    /// The folder that contains the pages.
    pub source: PathBuf,
    /// The folder that contains the catalogs.
    pub catalogs: PathBuf,
    /// The working directory of the commands in the pages.
    pub root: PathBuf,
    /// The path of the `alberti` program.
    pub program: PathBuf,
    /// The folder in which `en`, `zh` and the figure cache are created.
    pub out: PathBuf,
    /// Whether pages in the table of contents may be missing.
    pub is_partial: bool,
}

impl Edition {
    /// Reads the table of contents, without missing pages if the edition is partial.
    pub fn summary(&self) -> Result<Summary> {
        let own = self.source.join("SUMMARY.md");
        let path = if own.is_file() { own } else { self.book.join("src/SUMMARY.md") };
        let text = fs::read_to_string(&path).with_context(|| path.display().to_string())?;
        let mut summary = parse_summary(&text)?;
        if self.is_partial {
            let Summary { prefix_chapters, numbered_chapters, suffix_chapters, .. } = &mut summary;
            for list in [prefix_chapters, numbered_chapters, suffix_chapters] {
                list.retain(|item| self.has_page(item));
            }
        }
        Ok(summary)
    }

    /// Returns the names and titles of the pages, in order.
    pub fn pages(&self) -> Result<Vec<(String, String)>> {
        let summary = self.summary()?;
        let items =
            [&summary.prefix_chapters, &summary.numbered_chapters, &summary.suffix_chapters];
        let page = |item: &SummaryItem| match item {
            SummaryItem::Link(link) => {
                let path = link.location.as_ref()?.with_extension("");
                Some((path.to_string_lossy().into_owned(), link.name.clone()))
            }
            _ => None,
        };
        Ok(items.into_iter().flatten().filter_map(page).collect())
    }

    fn has_page(&self, item: &SummaryItem) -> bool {
        let SummaryItem::Link(link) = item else { return true };
        let Some(location) = &link.location else { return true };
        self.source.join(location).is_file()
    }

    /// Builds the book in the given language.
    pub fn build(&self, language: Language) -> Result<()> {
        let out = self.out.join(language.code());
        let config = self.config(language, &out)?;
        let mut book = MDBook::load_with_config_and_summary(&self.book, config, self.summary()?)?;
        let figures: Arc<Mutex<BTreeSet<PathBuf>>> = Arc::default();
        // This replaces the preprocessor command of the same name in `book.toml`.
        book.with_preprocessor(Alberti {
            program: self.program.clone(),
            root: self.root.clone(),
            cache: self.out.join("figures"),
            catalogs: self.catalogs.clone(),
            has_explorer: self.out.join("explorer/index.html").is_file(),
            figures: Arc::clone(&figures),
        });
        book.build()?;
        let figures: Vec<PathBuf> = match figures.lock() {
            Ok(figures) => figures.iter().cloned().collect(),
            Err(_) => return Err(anyhow!("a thread panicked")),
        };
        copy_figures(&figures, &out.join("figures")).map_err(|error| anyhow!(error))?;
        print_page::add_contents(&out, language)
    }

    fn config(&self, language: Language, out: &Path) -> Result<Config> {
        let mut config = Config::from_disk(self.book.join("book.toml"))?;
        let title =
            config.get::<String>(&format!("preprocessor.alberti.titles.{}", language.code()))?;
        if let Some(title) = title {
            config.book.title = Some(title);
        }
        config.book.language = Some(language.code().to_owned());
        config.book.src = absolute(&self.source)?;
        config.build.build_dir = absolute(out)?;
        Ok(config)
    }
}

/// Returns the absolute path of a folder, which is created if it is missing.
fn absolute(folder: &Path) -> Result<PathBuf> {
    fs::create_dir_all(folder)?;
    folder.canonicalize().with_context(|| folder.display().to_string())
}
