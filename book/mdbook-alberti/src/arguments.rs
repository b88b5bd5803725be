//! The command line.

use crate::edition::Edition;
use anyhow::{Result, anyhow, bail};
use std::path::PathBuf;

/// The parsed command line.
#[derive(Default)]
pub struct Arguments {
    book: Option<PathBuf>,
    source: Option<PathBuf>,
    catalogs: Option<PathBuf>,
    project: Option<PathBuf>,
    out: Option<PathBuf>,
    program: Option<PathBuf>,
    is_partial: bool,
    /// The only language to build, if specified.
    pub language: Option<String>,
    /// The minimum coverage of the translations, in percent.
    pub least: Option<f64>,
    /// Positional arguments.
    pub names: Vec<String>,
}

impl Arguments {
    /// Parses the arguments that follow the command name.
    pub fn parse(words: &[String]) -> Result<Self> {
        let mut out = Self::default();
        let mut words = words.iter();
        while let Some(word) = words.next() {
            let mut value = || words.next().ok_or(anyhow!("`{word}` needs a value"));
            match word.as_str() {
                "--book" => out.book = Some(value()?.into()),
                "--source" => out.source = Some(value()?.into()),
                "--po" => out.catalogs = Some(value()?.into()),
                "--project" => out.project = Some(value()?.into()),
                "--out" => out.out = Some(value()?.into()),
                "--program" => out.program = Some(value()?.into()),
                "--language" => out.language = Some(value()?.clone()),
                "--assert" => out.least = Some(value()?.parse()?),
                "--partial" => out.is_partial = true,
                flag if flag.starts_with('-') => bail!("unknown flag `{flag}`"),
                name => out.names.push(name.to_owned()),
            }
        }
        Ok(out)
    }

    /// Returns the folders and the program that the arguments specify, or the defaults.
    pub fn edition(&self) -> Result<Edition> {
        let book = self.book.clone().unwrap_or("book".into());
        let root = self.project.clone().unwrap_or(".".into());
        Ok(Edition {
            source: self.source.clone().unwrap_or_else(|| book.join("src")),
            catalogs: self.catalogs.clone().unwrap_or_else(|| book.join("po")),
            book,
            root: root.canonicalize().map_err(|error| anyhow!("{}: {error}", root.display()))?,
            program: self
                .program
                .clone()
                .or(std::env::var_os("ALBERTI").map(PathBuf::from))
                .unwrap_or_default(),
            out: self.out.clone().unwrap_or("target/book".into()),
            is_partial: self.is_partial,
        })
    }
}
