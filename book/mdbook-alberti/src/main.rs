//! Builds the book: a preprocessor for mdBook, and the commands that `cargo xtask book` runs.
//!
//! ```text
//! mdbook-alberti                         run as a preprocessor: reads a book from stdin, writes it to stdout
//! mdbook-alberti supports RENDERER       exit successfully: every renderer is supported
//! mdbook-alberti build --program FILE    build both editions, or only --language CODE; --partial allows missing pages
//! mdbook-alberti pot FOLDER              write catalog templates, one for each page
//! mdbook-alberti update [PAGE…]          update the catalogs to match the current pages
//! mdbook-alberti check-po [PAGE…]        list errors in the catalogs
//! mdbook-alberti coverage [--assert N]   print the translated percentage of each page
//! mdbook-alberti check                   check links, sizes, ids and topics of the built editions
//!
//!   --book DIR      the folder that contains book.toml [default: book]
//!   --source DIR    the folder that contains the pages [default: BOOK/src]
//!   --po DIR        the folder that contains the catalogs [default: BOOK/po]
//!   --project DIR   the working directory of the commands in the pages [default: .]
//!   --out DIR       the output folder for the editions [default: target/book]
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
        return Err(anyhow!("--program FILE is required; FILE must be the `alberti` program"));
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
