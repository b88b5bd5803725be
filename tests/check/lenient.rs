//! Checks lenient import of broken files: it loads every file that strict import loads, and further
//! files with a warning.

use alberti_tests::harness::Tally;
use alberti_tests::manifest::Row;
use import::{ImportOptions, load};
use model::codes;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;

/// Errors that even lenient import returns, because the file is not glTF 2.0.
const UNREADABLE: [&str; 2] = [codes::NOT_GLTF, codes::UNSUPPORTED_VERSION];

/// Loads the broken files strictly and leniently, and prints how many load.
pub fn check_lenient_loading(folder: &Path, rows: &[Row], tally: &mut Tally) {
    let [mut total, mut strictly, mut leniently] = [0; 3];
    for row in rows.iter().filter(|row| row.group() == "bad") {
        let path = folder.join(&row.path);
        let load = |lenient| load(&path, &ImportOptions { lenient, ..ImportOptions::default() });
        total += 1;
        match catch_unwind(AssertUnwindSafe(|| (load(false), load(true)))) {
            Err(_) => tally.fail(&row.path, "panic"),
            Ok((Ok(_), Err(error))) => {
                tally.fail(&row.path, &format!("loads strictly but not leniently: {error}"));
            }
            Ok((Err(error), Ok(model))) if model.warnings.is_empty() => {
                tally.fail(&row.path, &format!("loads leniently without a warning about {error}"));
            }
            Ok((_, Err(error))) if !UNREADABLE.contains(&error.diagnostic.code) => {
                tally.fail(&row.path, &format!("does not load leniently: {error}"));
            }
            Ok((strict, lenient)) => {
                strictly += usize::from(strict.is_ok());
                leniently += usize::from(lenient.is_ok());
            }
        }
    }
    println!("bad: {strictly} of {total} files load strictly, {leniently} leniently");
}
