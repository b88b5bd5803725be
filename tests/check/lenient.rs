//! What a lenient reader makes of broken files: everything that others load, and more.

use crate::manifest::Row;
use model::codes;
use model::import::{ImportOptions, load};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;

/// What stops even a lenient reader: that nothing can be made of the file at all.
const UNREADABLE: [&str; 2] = [codes::NOT_GLTF, codes::UNSUPPORTED_VERSION];

/// Loads the broken files strictly and leniently, and prints how many load; gives what is wrong.
pub fn check_lenient_loading(folder: &Path, rows: &[Row]) -> Vec<String> {
    let (mut failures, mut counts) = (Vec::new(), [0; 3]);
    for row in rows.iter().filter(|row| row.group() == "bad") {
        let path = folder.join(&row.path);
        let read = |lenient| load(&path, &ImportOptions { lenient, ..ImportOptions::default() });
        let both = catch_unwind(AssertUnwindSafe(|| (read(false), read(true))));
        counts[0] += 1;
        let problem = match both {
            Err(_) => Some("panic".to_owned()),
            Ok((Ok(_), Err(error))) => Some(format!("only strictly it loads: {error}")),
            Ok((Err(error), Ok(model))) if model.warnings.is_empty() => {
                Some(format!("leniently nothing is told of {error}"))
            }
            Ok((_, Err(error))) if !UNREADABLE.contains(&error.diagnostic.code) => {
                Some(format!("not even leniently it loads: {error}"))
            }
            Ok((strict, lenient)) => {
                counts[1] += usize::from(strict.is_ok());
                counts[2] += usize::from(lenient.is_ok());
                None
            }
        };
        failures.extend(problem.map(|problem| format!("{}: {problem}", row.path)));
    }
    let [all, strict, lenient] = counts;
    println!("bad: of {all} files {strict} load strictly and {lenient} leniently");
    failures
}
