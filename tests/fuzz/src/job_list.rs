//! Job lists for `alberti batch`. Every picture's name and flags are parsed, but nothing is
//! rendered.

use std::fs;
use std::path::PathBuf;
use std::sync::LazyLock;

/// A folder with a model, and an empty folder of pictures.
static FOLDER: LazyLock<PathBuf> = LazyLock::new(|| {
    let folder = std::env::temp_dir().join(format!("alberti-fuzz-list-{}", std::process::id()));
    let made = fs::create_dir_all(folder.join("out"))
        .and_then(|()| fs::write(folder.join("a.obj"), "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"));
    assert!(made.is_ok(), "{}: {made:?}", folder.display());
    folder
});

/// Verifies a list, which `--verify` reads to its end. The list is CSV if the first byte is odd,
/// otherwise JSON lines.
pub fn list(bytes: &[u8]) {
    let Some((&kind, list)) = bytes.split_first() else { return };
    let name = ["jobs.jsonl", "jobs.csv"][usize::from(kind % 2)];
    let path = FOLDER.join(name);
    let written = fs::write(&path, list);
    assert!(written.is_ok(), "{}: {written:?}", path.display());
    let words = ["alberti", "batch", "--verify", "--list"].map(Into::into);
    let words = words.into_iter().chain([path.into(), "--out".into(), FOLDER.join("out").into()]);
    // No list is complete, because nothing was rendered.
    let code = alberti::run(words);
    assert!(code == 1 || code == 0 && !has_jobs(list), "`batch --verify` exited with {code}");
}

/// Returns whether a list contains more than white space and a header.
fn has_jobs(list: &[u8]) -> bool {
    list.split(|byte| *byte == b'\n').filter(|line| !line.trim_ascii().is_empty()).count() > 1
}
