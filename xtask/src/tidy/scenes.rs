//! Every scene has its golden, a caption, and a row in the table of `scenes/README.md`; and nothing
//! else has.

use super::Fault;
use crate::workspace::{files, read, root, scenes};
use std::collections::BTreeSet;
use std::path::Path;

pub fn goldens_and_table() -> Result<Vec<Fault>, String> {
    let mut names = BTreeSet::new();
    let mut faults = Vec::new();
    for scene in scenes()? {
        if scene.caption()?.is_empty() {
            faults.push(Fault::new(
                format!("scenes/{}.ron", scene.name),
                "open the scene with a comment: what the picture shows and why",
            ));
        }
        names.insert(scene.name);
    }
    let goldens = files(&root().join("tests/goldens"), "png")?;
    let goldens = goldens.iter().filter_map(|path| name_of_golden(path)).collect();
    let table = read(&root().join("scenes/README.md"))?;
    faults.extend(unmatched(&names, &goldens, &rows(&table)));
    Ok(faults)
}

/// The scene that a picture is the golden of; none for what a failed comparison leaves behind.
fn name_of_golden(path: &Path) -> Option<String> {
    let name = path.file_stem()?.to_str()?;
    (!name.ends_with(".actual") && !name.ends_with(".diff")).then(|| name.to_owned())
}

/// The scenes that the table lists: rows that begin with a link to a `.ron` file.
fn rows(table: &str) -> BTreeSet<String> {
    let linked = |line: &str| {
        Some(line.strip_prefix("| [")?.split_once("](")?.1.split_once(".ron)")?.0.to_owned())
    };
    table.lines().filter_map(linked).collect()
}

fn unmatched(
    scenes: &BTreeSet<String>,
    goldens: &BTreeSet<String>,
    rows: &BTreeSet<String>,
) -> Vec<Fault> {
    let scene = |name: &String| format!("scenes/{name}.ron");
    let mut faults = Vec::new();
    for name in scenes.difference(goldens) {
        faults.push(Fault::new(
            scene(name),
            format!("no golden: look at the picture, then `cargo xtask golden --bless {name}`"),
        ));
    }
    for name in goldens.difference(scenes) {
        faults.push(Fault::new(format!("tests/goldens/{name}.png"), "the golden of no scene"));
    }
    for name in scenes.difference(rows) {
        faults.push(Fault::new(scene(name), "not in the table of scenes/README.md"));
    }
    for name in rows.difference(scenes) {
        faults.push(Fault::new(
            "scenes/README.md",
            format!("the table has `{name}`, which is no scene"),
        ));
    }
    faults
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scenes_goldens_and_rows_must_be_the_same() {
        let set =
            |names: &[&str]| names.iter().map(|name| (*name).to_owned()).collect::<BTreeSet<_>>();
        assert_eq!(unmatched(&set(&["a"]), &set(&["a"]), &set(&["a"])), []);
        assert_eq!(unmatched(&set(&["a", "b"]), &set(&["b", "c"]), &set(&["a", "d"])).len(), 4);
    }

    #[test]
    fn rows_and_goldens_are_read_by_name() {
        let table = "| scene | shows |\n| --- | --- |\n| [teapot](teapot.ron) | a pot |\n";
        assert_eq!(rows(table).into_iter().collect::<Vec<_>>(), ["teapot"]);
        assert_eq!(name_of_golden(Path::new("x/a.png")).as_deref(), Some("a"));
        assert_eq!(name_of_golden(Path::new("x/a.actual.png")), None);
    }
}
