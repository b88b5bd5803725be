//! Page files: one for each page, all written or none.
//!
//! ```text
//!   out.svg          out.svg for one page; out-1.svg, out-2.svg … for several
//!   out_{page}.svg   out_1.svg, out_2.svg …
//! ```

use crate::CliError;
use crate::format::OutputFormat;
use batch::NameTemplate;
use pipeline::AtomicFile;
use sheet::SheetPage;
use std::io::Write;
use std::path::{Path, PathBuf};

/// Names for the page files.
pub(super) struct PageNames {
    output: PathBuf,
    /// The value of `{stem}`.
    stem: String,
    template: Option<NameTemplate>,
}

impl PageNames {
    /// Parses the file names from an output path.
    ///
    /// # Errors
    /// Returns an error if a field is unknown, or if the name of a PDF has `{page}`.
    pub(super) fn parse(
        input: &Path,
        output: &Path,
        format: OutputFormat,
    ) -> Result<Self, CliError> {
        let name = output.to_string_lossy();
        // In a name without `{page}`, braces stay unchanged.
        let is_template = name.contains("{page");
        if is_template && format == OutputFormat::Pdf {
            let help = "\n  = help: remove {page}; a PDF holds all pages";
            return Err(CliError::Usage(format!("the output {name} is a single file{help}")));
        }
        let parse = || NameTemplate::parse(&name, &["stem"], &["page"]).map_err(CliError::Usage);
        let template = if is_template { Some(parse()?) } else { None };
        let stem = input.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        Ok(Self { output: output.to_owned(), stem, template })
    }

    /// Returns the name of a page, counted from 1, out of `count`.
    fn name(&self, page: usize, count: usize) -> PathBuf {
        if let Some(template) = &self.template {
            return template.expand_fields(|_| self.stem.clone(), |_| page);
        }
        if count == 1 {
            return self.output.clone();
        }
        let digits = count.to_string().len();
        let mut name = self.output.file_stem().unwrap_or_default().to_owned();
        name.push(format!("-{page:0digits$}."));
        name.push(self.output.extension().unwrap_or_default());
        self.output.with_file_name(name)
    }

    /// Returns the file name and content for each page.
    ///
    /// # Errors
    /// Returns the same errors as `encode`.
    pub(super) fn files(
        &self,
        pages: &[SheetPage],
        encode: impl Fn(&SheetPage) -> Result<Vec<u8>, CliError>,
    ) -> Result<Vec<(PathBuf, Vec<u8>)>, CliError> {
        let numbered = pages.iter().zip(1..);
        numbered.map(|(page, number)| Ok((self.name(number, pages.len()), encode(page)?))).collect()
    }
}

/// Writes files. None appears under its final name until all have been written.
///
/// # Errors
/// Returns an error if a file cannot be written; existing files are then unchanged.
pub(super) fn write_all(files: &[(PathBuf, Vec<u8>)]) -> Result<(), CliError> {
    let mut written = Vec::new();
    for (path, bytes) in files {
        let mut file = AtomicFile::create(path)?;
        let fault = |cause| pipeline::OutputError { path: path.clone(), cause };
        file.write_all(bytes).map_err(fault)?;
        written.push(file);
    }
    written.into_iter().try_for_each(|file| Ok(file.finish()?))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(output: &str, count: usize) -> Vec<String> {
        let names =
            PageNames::parse(Path::new("in/part.glb"), Path::new(output), OutputFormat::Svg);
        let names = names.unwrap_or_else(|error| panic!("{error}"));
        (1..=count).map(|n| names.name(n, count).to_string_lossy().into_owned()).collect()
    }

    #[test]
    fn several_pages_are_numbered() {
        assert_eq!(names("a/out.svg", 1), ["a/out.svg"]);
        assert_eq!(names("a/out.svg", 3), ["a/out-1.svg", "a/out-2.svg", "a/out-3.svg"]);
        assert_eq!(names("out.v2.svg", 12)[8..10], ["out.v2-09.svg", "out.v2-10.svg"]);
        assert_eq!(names("{stem}_{page:02}.svg", 2), ["part_01.svg", "part_02.svg"]);
        assert_eq!(names("{x}.svg", 1), ["{x}.svg"]);
        let pdf = PageNames::parse(Path::new("a"), Path::new("{page}.pdf"), OutputFormat::Pdf);
        assert!(pdf.is_err());
    }
}
