//! `alberti-site`: writes the repository's documentation as static pages.
//!
//! ```text
//!  README, docs/*.md, crates ──► documents ─┐
//!  docs/guide/*.md ──► guides: run commands ├─► template ──► pages ──► links: checked
//!  scenes/*.ron ──► gallery: rendered       │
//!  alberti reference ──► reference ─────────┘
//! ```
//!
//! `cargo xtask docs` runs it. The pages need no scripts and load nothing from other hosts. The
//! program fails if a command in a guide fails or prints unexpected output, if a scene cannot be
//! rendered, or if a link is broken.
#![allow(clippy::print_stdout, clippy::print_stderr, reason = "a program prints")]
#![allow(unreachable_pub, reason = "in a program, `pub` means used by another file")]

mod documents;
mod files;
mod gallery;
mod guides;
mod links;
mod markdown;
mod program;
mod reference;
mod site;
mod template;

use program::Program;
use site::Site;
use std::path::PathBuf;
use std::process::ExitCode;

/// The result of an operation: nothing, or an error message.
type Outcome = Result<(), String>;

const USAGE: &str = "alberti-site ROOT PROGRAM OUT\n\
    Writes the documentation of the repository ROOT, with pictures from PROGRAM, to the folder OUT.";

fn main() -> ExitCode {
    let arguments: Vec<PathBuf> = std::env::args_os().skip(1).map(PathBuf::from).collect();
    let [root, program, out] = &arguments[..] else {
        eprintln!("{USAGE}");
        return ExitCode::from(2);
    };
    let built = Program::at(program).and_then(|program| build_site(Site::new(root, out), &program));
    match built {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("{message}");
            ExitCode::FAILURE
        }
    }
}

/// Writes all pages into an empty folder and checks their links.
fn build_site(mut site: Site, program: &Program) -> Outcome {
    files::empty_folder(&site.out)?;
    site.write_text("style.css", template::STYLE)?;
    let scenes = gallery::render_scenes(&site, program)?;
    documents::add_documents(&mut site)?;
    gallery::add_gallery(&mut site, &scenes)?;
    reference::add_reference(&mut site, program)?;
    guides::run_guides(&mut site, program)?;
    documents::add_linked_files(&mut site)?;
    site.write_pages()?;
    let report = links::check_links(&site.out)?;
    println!("{}: {}", site.out.join("index.html").display(), report);
    Ok(())
}
