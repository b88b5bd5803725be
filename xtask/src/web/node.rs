//! Runs the engine's WebAssembly in Node, to send it requests without a browser.

use crate::Outcome;
use crate::program::{capture_output, run_command};
use crate::workspace::{create_folder, project_root, target_folder};
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// A request to the engine, and the name of its response.
#[derive(Clone, Debug)]
pub struct Request {
    pub name: String,
    pub query: String,
}

/// Responses from the engine, by request name.
#[derive(Clone, Debug, Default)]
pub struct Answers {
    bytes: BTreeMap<String, Vec<u8>>,
}

impl Answers {
    /// Sends requests to the module of a site, in Node, after adding some files to it.
    ///
    /// # Errors
    /// Fails if Node is missing or the engine rejects a request.
    pub fn ask(
        site: &Path,
        files: &[(String, PathBuf)],
        requests: &[Request],
    ) -> Result<Self, String> {
        let out = target_folder().join("web-build/answers");
        create_folder(&out)?;
        let mut node = Command::new("node");
        node.arg(project_root().join("tests/web/answers.mjs")).arg(site).arg(&out);
        for (name, path) in files {
            node.arg(format!("--file={name}={}", path.display()));
        }
        node.args(requests.iter().map(|request| format!("{}?{}", request.name, request.query)));
        run_command(&mut node)?;
        let read = |request: &Request| {
            let path = out.join(&request.name);
            let bytes = fs::read(&path).map_err(|error| format!("{}: {error}", path.display()))?;
            Ok((request.name.clone(), bytes))
        };
        let bytes = requests.iter().map(read).collect::<Result<_, String>>()?;
        Ok(Self { bytes })
    }

    /// Returns the bytes of a response.
    ///
    /// # Errors
    /// Fails if there was no such request.
    pub fn bytes(&self, name: &str) -> Result<&[u8], String> {
        self.bytes.get(name).map(Vec::as_slice).ok_or_else(|| format!("`{name}` was not requested"))
    }
}

/// Packs the page of a site into one file next to it, `alberti.html`.
///
/// # Errors
/// Fails if Node is missing or a part of the page is not in its expected place.
pub fn write_single_file(site: &Path) -> Outcome {
    let mut node = Command::new("node");
    node.arg(project_root().join("crates/web/single_file.mjs"));
    run_command(node.arg(site).arg(site.join("alberti.html")))
}

/// Returns the size of a file after `gzip -9`, which is how hosts compress it.
///
/// # Errors
/// Fails if Node or the file is missing.
pub fn gzip_size(path: &Path) -> Result<usize, String> {
    let script = "const {readFileSync: read} = require('node:fs'); \
        console.log(require('node:zlib').gzipSync(read(process.argv[1]), {level: 9}).length)";
    let text = capture_output(Command::new("node").args(["-e", script]).arg(path))?;
    text.trim().parse().map_err(|_| format!("Node does not report a size for {}", path.display()))
}

/// Returns a message if Node or npm is missing.
pub fn missing_node() -> Option<String> {
    let has = |program: &str| Command::new(program).arg("--version").output().is_ok();
    let missing = ["node", "npm"].into_iter().find(|program| !has(program))?;
    Some(format!("`{missing}` is missing: install Node.js"))
}
