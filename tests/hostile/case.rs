//! Cases: a malicious file and its expected outcome.

use crate::hostile::promises;
use alberti_tests::gltf::Document;
use gltf_check::check_bytes;
use import::{ImportError, ImportOptions, load, load_bytes};
use model::{Diagnostic, Model};
use std::path::Path;

/// A malicious file and its expected outcome.
pub struct Case {
    pub name: String,
    /// The file name, which determines the format if the content does not.
    pub file_name: &'static str,
    pub file: Vec<u8>,
    pub options: ImportOptions,
    pub expected: Expected,
}

/// The expected outcome of a file. In every case, loading must return, and the model must keep its
/// promises.
pub enum Expected {
    /// Either a model or an error.
    Anything,
    /// A model.
    Loads,
    /// A model without any warning.
    LoadsClean,
    /// A model with a warning.
    Warned,
    /// A model with exactly this warning: the pointer, a space and the message.
    Warns(String),
    /// An error.
    Refused,
    /// Exactly this error, after the file name.
    Says(String),
}

impl Case {
    pub fn new(name: impl Into<String>, file: Vec<u8>, expected: Expected) -> Self {
        let (name, file_name) = (name.into(), "model.gltf");
        Self { name, file_name, file, options: ImportOptions::default(), expected }
    }

    pub fn from_document(name: impl Into<String>, document: &Document, expected: Expected) -> Self {
        Self::new(name, document.to_glb(), expected)
    }

    /// Writes the file into a folder, loads it, and compares.
    pub fn check_file(&self, folder: &Path) -> Result<(), String> {
        let path = folder.join(self.file_name);
        std::fs::write(&path, &self.file).map_err(|error| error.to_string())?;
        check_path(&path, &self.options, &self.expected)
    }

    /// Checks the file and loads it from memory, strictly and leniently. The report must say
    /// whether it loads and, if not, why.
    pub fn check_bytes(&self) -> Result<(), String> {
        let fault =
            load_bytes(self.file_name, &self.file, &self.options).err().map(|e| *e.diagnostic);
        let loads = fault.is_none();
        self.check_report(fault.as_ref())?;
        self.load_leniently(loads)
    }

    /// Compares the report on the file with the `fault` that loading found.
    fn check_report(&self, fault: Option<&Diagnostic>) -> Result<(), String> {
        let report = check_bytes(self.file_name, &self.file, &self.options);
        if report.load_error.as_ref() != fault {
            return Err(format!(
                "loading reports {fault:?}, but the report has {:?}",
                report.load_error
            ));
        }
        if fault.is_some() && report.errors == 0 {
            return Err("it is rejected, but there is no error in the report".to_owned());
        }
        let all = report.errors + report.warnings + report.notes;
        let is_whole = report.diagnostics.len() + report.omitted_count() == all;
        let is_short = report.diagnostics.len() < 2_000;
        let is_sorted = report.diagnostics.is_sorted_by_key(|problem| problem.severity);
        if is_whole && is_short && is_sorted {
            return Ok(());
        }
        Err(format!("{} of {all} problems are listed", report.diagnostics.len()))
    }

    /// Loads the file leniently, which must succeed if it `loads` strictly. The resulting model
    /// must keep every promise.
    fn load_leniently(&self, loads: bool) -> Result<(), String> {
        let options = ImportOptions { lenient: true, ..self.options.clone() };
        match load_bytes(self.file_name, &self.file, &options) {
            Ok(model) => promises::check_model(&model),
            Err(error) if loads => {
                Err(format!("it loads strictly but not leniently: {}", error.diagnostic))
            }
            Err(_) => Ok(()),
        }
    }
}

/// Loads a file and compares the result with the expectation.
pub fn check_path(path: &Path, options: &ImportOptions, expected: &Expected) -> Result<(), String> {
    check_load_result(&load(path, options), expected)
}

/// Compares the result for a file with the expectation.
pub fn check_load_result(
    loaded: &Result<Model, ImportError>,
    expected: &Expected,
) -> Result<(), String> {
    if let Ok(model) = loaded {
        promises::check_model(model)?;
    }
    let said = loaded.as_ref().err().map(|error| error.diagnostic.sentence());
    match (expected, loaded, said) {
        (Expected::Anything, ..) | (Expected::Loads, Ok(_), _) | (Expected::Refused, Err(_), _) => {
            Ok(())
        }
        (Expected::Warned, Ok(model), _) if !model.warnings.is_empty() => Ok(()),
        (Expected::Warned, Ok(_), _) => Err("there is no warning".to_owned()),
        (Expected::LoadsClean, Ok(model), _) if model.warnings.is_empty() => Ok(()),
        (Expected::LoadsClean, Ok(model), _) => Err(format!("warnings: {:?}", model.warnings)),
        (Expected::Warns(text), Ok(model), _) => {
            let warnings = model.warnings.iter().map(|w| format!("{} {}", w.location, w.message));
            let warnings: Vec<String> = warnings.collect();
            if warnings.contains(text) { Ok(()) } else { Err(format!("warnings: {warnings:#?}")) }
        }
        (Expected::Says(text), Err(_), Some(said)) if *text == said => Ok(()),
        (_, Err(_), Some(said)) => Err(format!("refused: {said}")),
        _ => Err("it was loaded".to_owned()),
    }
}
