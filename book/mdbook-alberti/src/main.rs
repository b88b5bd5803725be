//! Builds the book: a preprocessor for mdBook, and the commands that `cargo xtask book` runs.
//!
//! ```text
//! mdbook-alberti                         the preprocessor: a book on stdin, a book on stdout
//! mdbook-alberti supports RENDERER       whether it serves a renderer: all
//! mdbook-alberti build --program FILE    both editions, or --language CODE; --partial: pages may be missing
//! mdbook-alberti pot FOLDER              templates of the catalogs, one for each page
//! mdbook-alberti update [PAGE…]          the catalogs with the messages of the pages as they are
//! mdbook-alberti check-po [PAGE…]        faults of the catalogs
//! mdbook-alberti coverage [--assert N]   how much of each page is translated
//! mdbook-alberti check                   links, sizes, ids and topics of what was built
//!
//!   --book DIR      the folder of book.toml [default: book]
//!   --source DIR    the folder of the pages [default: BOOK/src]
//!   --po DIR        the folder of the catalogs [default: BOOK/po]
//!   --project DIR   the folder in which the commands of the pages run [default: .]
//!   --out DIR       the folder of the editions [default: target/book]
//! ```

mod arguments;
mod catalogs;
mod checks;
mod command;
mod edition;
mod figure;
mod formula;
mod language;
mod marks;
mod page;
mod preprocessor;
mod print_page;
mod style;
mod topics;
mod translation;

use anyhow::{Result, anyhow, bail};
use arguments::Arguments;
use language::Language;
use mdbook_preprocessor::{Preprocessor as _, parse_input};
use preprocessor::Alberti;
use std::process::ExitCode;

fn main() -> ExitCode {
    let subscriber = tracing_subscriber::fmt().with_writer(std::io::stderr).without_time();
    subscriber.with_max_level(tracing_subscriber::filter::LevelFilter::WARN).init();
    match run() {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("mdbook-alberti: {error:#}");
            ExitCode::FAILURE
        }
    }
}

fn run() -> Result<()> {
    let words: Vec<String> = std::env::args().skip(1).collect();
    match words.first().map(String::as_str) {
        None => preprocess(),
        Some("supports") => Ok(()),
        Some("build") => build(&Arguments::parse(&words[1..])?),
        Some("pot") => catalogs::write_templates(&Arguments::parse(&words[1..])?),
        Some("update") => catalogs::update(&Arguments::parse(&words[1..])?),
        Some("check-po") => catalogs::check(&Arguments::parse(&words[1..])?),
        Some("coverage") => catalogs::coverage(&Arguments::parse(&words[1..])?),
        Some("check") => checks::check(&Arguments::parse(&words[1..])?),
        Some(other) => bail!(
            "unknown command `{other}`; expected build, pot, update, check-po, coverage or check"
        ),
    }
}

/// Implements mdBook's preprocessor protocol.
fn preprocess() -> Result<()> {
    let (context, book) = parse_input(std::io::stdin())?;
    let alberti = Alberti::by_place(&context);
    let book = alberti.run(&context, book)?;
    alberti.copy_to_sources(&context)?;
    serde_json::to_writer(std::io::stdout(), &book)?;
    Ok(())
}

fn build(arguments: &Arguments) -> Result<()> {
    let edition = arguments.edition()?;
    if edition.program.as_os_str().is_empty() {
        return Err(anyhow!("--program FILE is required: the program that draws the figures"));
    }
    let languages = match &arguments.language {
        Some(code) => vec![Language::parse(code).map_err(|error| anyhow!(error))?],
        None => Language::ALL.to_vec(),
    };
    for language in languages {
        edition.build(language)?;
        println!("{}", edition.out.join(language.code()).join("index.html").display());
    }
    Ok(())
}
