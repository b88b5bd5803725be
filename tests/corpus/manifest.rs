//! The list of files in a corpus: one row a file, columns separated by tabs, named in the first row.

use std::path::Path;

/// What the tests need of a row.
pub struct Row {
    /// The file, relative to the manifest.
    pub path: String,
    /// How many triangles the shown scene has, each counted as often as it is shown.
    pub scene_triangles: Option<usize>,
    /// The names of the errors that the Khronos validator finds in the file.
    pub validator_errors: Vec<String>,
}

impl Row {
    /// The first folder of the path: `models`, `validator-valid` or `bad`.
    pub fn group(&self) -> &str {
        self.path.split('/').next().unwrap_or("")
    }

    /// The name of the file alone.
    pub fn file_name(&self) -> &str {
        self.path.rsplit('/').next().unwrap_or("")
    }
}

/// Reads `MANIFEST.tsv`; every file it names must exist.
pub fn read_manifest(folder: &Path) -> Result<Vec<Row>, String> {
    let path = folder.join("MANIFEST.tsv");
    let text = std::fs::read_to_string(&path).map_err(|e| format!("{}: {e}", path.display()))?;
    let mut lines = text.lines();
    let columns: Vec<&str> = lines.next().unwrap_or("").split('\t').collect();
    let column = |name: &str| columns.iter().position(|column| *column == name);
    let Some(path_column) = column("path") else {
        return Err(format!("{}: there is no column `path`", path.display()));
    };
    let triangles_column = column("scene_triangles");
    let errors_column = column("validator_error_codes");
    let mut rows = Vec::new();
    for line in lines.filter(|line| !line.trim().is_empty()) {
        let cells: Vec<&str> = line.split('\t').collect();
        let cell = |at: usize| cells.get(at).copied().unwrap_or("");
        let file = cell(path_column).to_owned();
        if !folder.join(&file).is_file() {
            return Err(format!("{}: the file {file} does not exist", path.display()));
        }
        let scene_triangles = triangles_column.and_then(|at| cell(at).parse().ok());
        let errors = errors_column.map_or("", cell).split(',').filter(|code| !code.is_empty());
        let validator_errors = errors.map(ToOwned::to_owned).collect();
        rows.push(Row { path: file, scene_triangles, validator_errors });
    }
    Ok(rows)
}
