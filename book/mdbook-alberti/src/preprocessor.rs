//! The mdBook preprocessor: translates the pages, runs their commands, renders their marks.

use crate::command::{Job, Runner};
use crate::figure::copy_figures;
use crate::formula::Formulas;
use crate::language::Language;
use crate::marks::Marks;
use crate::page::{Answers, Page, Renderer, block_job};
use crate::topics::Topics;
use crate::translation::{read_catalog, translate_line, translate_page};
use anyhow::{Result, anyhow};
use mdbook_preprocessor::book::{Book, BookItem, Chapter};
use mdbook_preprocessor::{Preprocessor, PreprocessorContext};
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex};

/// The preprocessor.
pub struct Alberti {
    /// The path of the program.
    pub program: PathBuf,
    /// The project folder, in which commands run.
    pub root: PathBuf,
    /// The figure cache.
    pub cache: PathBuf,
    /// The folder of the catalogs `LANGUAGE/PAGE.po`.
    pub catalogs: PathBuf,
    /// Whether the explorer's page will be published with the book.
    pub has_explorer: bool,
    /// The figures of all pages, to be copied later.
    pub figures: Arc<Mutex<BTreeSet<PathBuf>>>,
}

impl Alberti {
    /// Creates the preprocessor for plain mdBook, with the default folders and the program that the
    /// environment variable `ALBERTI` specifies, if any.
    pub fn by_place(context: &PreprocessorContext) -> Self {
        let root = context.root.parent().unwrap_or(Path::new(".")).to_owned();
        Self {
            program: std::env::var_os("ALBERTI")
                .map_or_else(|| root.join("target/release/alberti"), PathBuf::from),
            cache: root.join("target/book/figures"),
            catalogs: context.root.join("po"),
            has_explorer: false,
            figures: Arc::default(),
            root,
        }
    }

    /// Copies the figures to the source folder, from which mdBook copies them to its output.
    pub fn copy_to_sources(&self, context: &PreprocessorContext) -> Result<()> {
        let folder = context.root.join(&context.config.book.src).join("figures");
        let figures = self.figures.lock().map_err(|_| anyhow!("a thread panicked"))?;
        copy_figures(&figures.iter().cloned().collect::<Vec<_>>(), &folder)
            .map_err(|error| anyhow!(error))
    }

    fn render_book(&self, language: Language, book: &mut Book) -> Result<(), Vec<String>> {
        let one = |fault: String| vec![fault];
        let folder = self.catalogs.join(language.code());
        let titles = read_catalog(&folder.join("SUMMARY.po")).map_err(one)?;
        let mut pages = Vec::new();
        let mut faults = Vec::new();
        for_each_chapter(book, &mut |chapter| {
            if language != Language::English {
                chapter.name = translate_line(&chapter.name, &titles);
            }
            match read_page(chapter, language, &folder) {
                Ok(page) => pages.push(page),
                Err(fault) => faults.push(fault),
            }
        });
        if !faults.is_empty() {
            return Err(faults);
        }
        let answers = self.run_commands(&pages, language)?;
        let topics = self.topics(language, &folder).map_err(one)?;
        let renderer = Renderer {
            language,
            formulas: &Formulas::new().map_err(one)?,
            answers: &answers,
            topics_table: &topics.table(&pages, language),
            topics: &topics,
            has_explorer: self.has_explorer,
        };
        let mut rendered = BTreeMap::new();
        for page in &pages {
            match renderer.render(page) {
                Ok(text) => drop(rendered.insert(page.name.clone(), text)),
                Err(found) => faults.extend(found),
            }
        }
        for_each_chapter(book, &mut |chapter| {
            chapter.content = rendered.remove(&page_name(chapter)).unwrap_or_default();
        });
        if faults.is_empty() { Ok(()) } else { Err(faults) }
    }

    /// Runs each command in the pages once.
    fn run_commands(&self, pages: &[Page], language: Language) -> Result<Answers, Vec<String>> {
        let fences = pages.iter().flat_map(|page| &page.marks.fences);
        // Invalid commands are reported with line numbers when their pages are rendered.
        let jobs: BTreeSet<Job> =
            fences.filter_map(|fence| block_job(fence, language)?.ok()).collect();
        let jobs: Vec<Job> = jobs.into_iter().collect();
        if jobs.is_empty() {
            return Ok(Answers::new());
        }
        let runner =
            Runner::new(&self.program, &self.root, &self.cache).map_err(|error| vec![error])?;
        let answers = runner.run_all(&jobs);
        if let Ok(mut figures) = self.figures.lock() {
            let files = answers.iter().flatten();
            figures.extend(
                files.filter(|path| path.extension().is_none_or(|it| it != "txt")).cloned(),
            );
        }
        Ok(jobs.into_iter().zip(answers).collect())
    }

    /// Returns the topics, with titles in the given language.
    fn topics(&self, language: Language, folder: &Path) -> Result<Topics, String> {
        let path = self.root.join("tests/CONFORMANCE.md");
        let table = std::fs::read_to_string(&path)
            .map_err(|error| format!("{}: {error}", path.display()))?;
        let topics = Topics::parse(&table);
        if language == Language::English {
            return Ok(topics);
        }
        let catalog = read_catalog(&folder.join("topics.po"))?;
        Ok(topics.translated(|title| translate_line(title, &catalog)))
    }
}

impl Preprocessor for Alberti {
    fn name(&self) -> &str {
        "alberti"
    }

    fn run(&self, context: &PreprocessorContext, mut book: Book) -> Result<Book> {
        let code = context.config.book.language.as_deref().unwrap_or("en");
        let language = Language::parse(code).map_err(|error| anyhow!(error))?;
        match self.render_book(language, &mut book) {
            Ok(()) => Ok(book),
            Err(faults) => Err(anyhow!(
                "{} errors in the pages ({code})\n  {}",
                faults.len(),
                faults.join("\n  ")
            )),
        }
    }
}

fn read_page(chapter: &Chapter, language: Language, folder: &Path) -> Result<Page, String> {
    let name = page_name(chapter);
    let text = if language == Language::English {
        chapter.content.clone()
    } else {
        let catalog = read_catalog(&folder.join(format!("{name}.po")))?;
        translate_page(&chapter.content, &catalog).map_err(|error| format!("{name}.md: {error}"))?
    };
    Ok(Page {
        title: chapter.name.clone(),
        english: Marks::read(&chapter.content),
        marks: Marks::read(&text),
        text,
        name,
    })
}

/// Returns the file name of a chapter without its extension.
fn page_name(chapter: &Chapter) -> String {
    let path = chapter.path.as_deref().unwrap_or(Path::new(""));
    path.with_extension("").to_string_lossy().into_owned()
}

fn for_each_chapter(book: &mut Book, act: &mut dyn FnMut(&mut Chapter)) {
    book.for_each_mut(|item| {
        if let BookItem::Chapter(chapter) = item {
            act(chapter);
        }
    });
}
