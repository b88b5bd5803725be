//! The manifest of a corpus: a table of model files with their expected properties.
//!
//! `MANIFEST.tsv` has one row per file. Columns are separated by tabs and named in the first row.
//! Only `path` is required; columns that [`Row`] does not have are ignored.

use std::path::Path;

/// A file in a corpus.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Row {
    /// Column `path`: the file, relative to the manifest, with forward slashes.
    pub path: String,
    /// Column `scene_triangles`: the triangles of the default scene, counted once per instance.
    pub scene_triangles: Option<usize>,
    /// Column `validator_error_codes`: the codes of the errors that the Khronos glTF validator
    /// reports, separated by commas.
    pub validator_errors: Vec<String>,
    /// Column `expected`: the required outcome of rendering the file. It is `drawn`, `blank` (a
    /// picture of one color), or part of the reason for its rejection.
    pub expected: Option<String>,
}

impl Row {
    /// Returns the first folder of the path, such as `models` or `bad`.
    #[must_use]
    pub fn group(&self) -> &str {
        self.path.split('/').next().unwrap_or("")
    }

    /// Returns the file name without its folders.
    #[must_use]
    pub fn file_name(&self) -> &str {
        self.path.rsplit('/').next().unwrap_or("")
    }
}

/// Reads the manifest of a folder.
///
/// # Errors
/// Returns an error if the manifest cannot be read, has no column `path`, or names a missing file.
pub fn read_manifest(folder: &Path) -> Result<Vec<Row>, String> {
    let path = folder.join("MANIFEST.tsv");
    let text = std::fs::read_to_string(&path).map_err(|e| format!("{}: {e}", path.display()))?;
    let rows = parse_manifest(&text).map_err(|error| format!("{}: {error}", path.display()))?;
    match rows.iter().find(|row| !folder.join(&row.path).is_file()) {
        Some(row) => Err(format!("{}: missing file: {}", path.display(), row.path)),
        None => Ok(rows),
    }
}

fn parse_manifest(text: &str) -> Result<Vec<Row>, String> {
    let mut lines = text.lines();
    let columns: Vec<&str> = lines.next().unwrap_or("").split('\t').collect();
    let column = |name: &str| columns.iter().position(|column| *column == name);
    let path_column = column("path").ok_or("the column `path` is missing")?;
    let [triangles_column, errors_column, expected_column] =
        ["scene_triangles", "validator_error_codes", "expected"].map(column);
    let parse_row = |line: &str| {
        let cells: Vec<&str> = line.split('\t').collect();
        let cell = |at: usize| cells.get(at).copied().unwrap_or("");
        let optional = |at: Option<usize>| at.map_or("", cell);
        let errors = optional(errors_column).split(',').filter(|code| !code.is_empty());
        let expected = optional(expected_column);
        Row {
            path: cell(path_column).to_owned(),
            scene_triangles: optional(triangles_column).parse().ok(),
            validator_errors: errors.map(ToOwned::to_owned).collect(),
            expected: (!expected.is_empty()).then(|| expected.to_owned()),
        }
    };
    Ok(lines.filter(|line| !line.trim().is_empty()).map(parse_row).collect())
}

/// Returns the text of a manifest with all columns of [`Row`].
#[must_use]
pub fn format_manifest(rows: &[Row]) -> String {
    let mut text = "path\tscene_triangles\tvalidator_error_codes\texpected\n".to_owned();
    for row in rows {
        let triangles = row.scene_triangles.map(|count| count.to_string()).unwrap_or_default();
        let errors = row.validator_errors.join(",");
        let expected = row.expected.as_deref().unwrap_or("");
        text += &format!("{}\t{triangles}\t{errors}\t{expected}\n", row.path);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_manifest_survives_a_round_trip() {
        let rows = vec![
            Row {
                path: "bad/a.gltf".to_owned(),
                validator_errors: vec!["TYPE_MISMATCH".to_owned(), "INVALID_JSON".to_owned()],
                expected: Some("not JSON".to_owned()),
                ..Row::default()
            },
            Row {
                path: "models/b c/b.glb".to_owned(),
                scene_triangles: Some(12),
                ..Row::default()
            },
        ];
        assert_eq!(parse_manifest(&format_manifest(&rows)).as_deref(), Ok(rows.as_slice()));
        assert_eq!((rows[1].group(), rows[1].file_name()), ("models", "b.glb"));
    }

    #[test]
    fn columns_are_found_by_name_and_only_the_path_is_required() {
        let rows = parse_manifest("note\tpath\nx\ta.glb\n").unwrap();
        assert_eq!(rows, [Row { path: "a.glb".to_owned(), ..Row::default() }]);
        assert!(parse_manifest("file\na.glb\n").is_err());
    }
}
