//! Rules for scenes: each has a golden, a caption and a row in `scenes/README.md`, and there are no
//! other goldens or rows.

use super::Violation;
use crate::workspace::{list_files, list_scenes, project_root, read_text};
use std::collections::BTreeSet;
use std::path::Path;

/// Finds scenes without a golden, a caption or a row, and goldens or rows without a scene.
pub fn goldens_and_table() -> Result<Vec<Violation>, String> {
    let mut names = BTreeSet::new();
    let mut faults = Vec::new();
    for scene in list_scenes()? {
        if scene.scene_caption()?.is_empty() {
            faults.push(Violation::new(
                format!("scenes/{}.ron", scene.name),
                "begin the scene with a comment that explains what the picture shows and why",
            ));
        }
        names.insert(scene.name);
    }
    let goldens = list_files(&project_root().join("tests/goldens"), "png")?;
    let goldens = goldens.iter().filter_map(|path| golden_name(path)).collect();
    let table = read_text(&project_root().join("scenes/README.md"))?;
    faults.extend(unmatched_names(&names, &goldens, &table_rows(&table)));
    Ok(faults)
}

/// Returns the scene that a golden belongs to, or `None` for pictures left over from a failed
/// comparison.
fn golden_name(path: &Path) -> Option<String> {
    let name = path.file_stem()?.to_str()?;
    (!name.ends_with(".actual") && !name.ends_with(".diff")).then(|| name.to_owned())
}

/// Returns the scenes that the table lists: its rows begin with a link to a `.ron` file.
fn table_rows(table: &str) -> BTreeSet<String> {
    let linked = |line: &str| {
        Some(line.strip_prefix("| [")?.split_once("](")?.1.split_once(".ron)")?.0.to_owned())
    };
    table.lines().filter_map(linked).collect()
}

fn unmatched_names(
    scenes: &BTreeSet<String>,
    goldens: &BTreeSet<String>,
    rows: &BTreeSet<String>,
) -> Vec<Violation> {
    let scene = |name: &String| format!("scenes/{name}.ron");
    let mut faults = Vec::new();
    for name in scenes.difference(goldens) {
        faults.push(Violation::new(
            scene(name),
            format!("no golden: look at the picture, then run `cargo xtask golden --bless {name}`"),
        ));
    }
    for name in goldens.difference(scenes) {
        faults
            .push(Violation::new(format!("tests/goldens/{name}.png"), "this golden has no scene"));
    }
    for name in scenes.difference(rows) {
        faults.push(Violation::new(scene(name), "not in the table of scenes/README.md"));
    }
    for name in rows.difference(scenes) {
        faults.push(Violation::new(
            "scenes/README.md",
            format!("the table lists `{name}`, which is not a scene"),
        ));
    }
    faults
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scenes_goldens_and_rows_must_match() {
        let set =
            |names: &[&str]| names.iter().map(|name| (*name).to_owned()).collect::<BTreeSet<_>>();
        assert_eq!(unmatched_names(&set(&["a"]), &set(&["a"]), &set(&["a"])), []);
        assert_eq!(
            unmatched_names(&set(&["a", "b"]), &set(&["b", "c"]), &set(&["a", "d"])).len(),
            4
        );
    }

    #[test]
    fn rows_and_goldens_are_identified_by_name() {
        let table = "| scene | shows |\n| --- | --- |\n| [teapot](teapot.ron) | a pot |\n";
        assert_eq!(table_rows(table).into_iter().collect::<Vec<_>>(), ["teapot"]);
        assert_eq!(golden_name(Path::new("x/a.png")).as_deref(), Some("a"));
        assert_eq!(golden_name(Path::new("x/a.actual.png")), None);
    }
}
