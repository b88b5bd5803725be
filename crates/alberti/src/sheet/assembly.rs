//! Flags for assemblies: parts list, balloons, exploded view, a sheet for each part.

use super::parts_list_json::parts_list_document;
use crate::options::option_parser;
use crate::page_output::has_extension;
use model::ModelInstance;
use scene_file::file::SheetFile;
use sheet::{ExplosionAxis, PartsList, Sheet};
use std::path::PathBuf;

/// Flags for the pages that show the models as an assembly of parts.
#[derive(Debug, clap::Args)]
pub(super) struct AssemblyArgs {
    /// Add a parts list that counts identical parts; with a file name, also write it as .csv or
    /// .json
    #[arg(
        long,
        value_name = "FILE",
        num_args = 0..=1,
        require_equals = true,
        value_parser = parse_list_file
    )]
    parts_list: Option<Option<PathBuf>>,
    /// Add a page that shows the assembly with the item numbers from the parts list
    #[arg(long)]
    balloons: bool,
    /// Draw the assembly page as an exploded view, with the path of each part
    #[arg(
        long,
        value_name = "AXIS",
        num_args = 0..=1,
        require_equals = true,
        value_parser = option_parser::<ExplosionAxis>()
    )]
    exploded: Option<Option<ExplosionAxis>>,
    /// Add a page with the principal views of each item in the parts list
    #[arg(long)]
    part_sheets: bool,
}

impl AssemblyArgs {
    /// Turns on the requested features; turns nothing off.
    pub(super) fn apply_to(&self, sheet: &mut SheetFile) {
        sheet.parts_list |= self.parts_list.is_some();
        sheet.balloons |= self.balloons;
        sheet.part_sheets |= self.part_sheets;
        if let Some(axis) = self.exploded {
            let exploded = sheet.exploded.get_or_insert_default();
            axis.into_iter().for_each(|axis| exploded.axis = axis);
        }
    }

    /// Returns the file name and content of the parts list, if a file was requested.
    pub(super) fn list_file(
        &self,
        sheet: &Sheet,
        models: &[ModelInstance],
    ) -> Option<(PathBuf, Vec<u8>)> {
        let path = self.parts_list.clone().flatten()?;
        let densities = &sheet.assembly.densities;
        let list = PartsList::new(models, densities, sheet.millimeters_per_unit);
        let text =
            if has_extension(&path, "json") { parts_list_document(&list) } else { list.to_csv() };
        Some((path, text.into_bytes()))
    }
}

/// Parses the name of a parts list, which ends in `.csv` or `.json`.
fn parse_list_file(text: &str) -> Result<PathBuf, String> {
    let path = PathBuf::from(text);
    if has_extension(&path, "csv") || has_extension(&path, "json") {
        Ok(path)
    } else {
        Err("expected a name that ends in .csv or .json".to_owned())
    }
}
