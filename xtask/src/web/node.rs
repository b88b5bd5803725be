//! The engine's WebAssembly in Node: requests and their answers, without a browser.

use crate::Outcome;
use crate::program::{capture_output, run_command};
use crate::workspace::{create_folder, project_root, target_folder};
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// A request to the engine, and the name of its answer.
#[derive(Clone, Debug)]
pub struct Request {
    pub name: String,
    pub query: String,
}

/// Answers of the engine, by request name.
#[derive(Clone, Debug, Default)]
pub struct Answers {
    bytes: BTreeMap<String, Vec<u8>>,
}

impl Answers {
    /// Queries the module of a site, in Node, after adding some files to it.
    ///
    /// # Errors
    /// Node is missing, or the engine refuses a request.
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

    /// The bytes of an answer.
    ///
    /// # Errors
    /// There was no such request.
    pub fn bytes(&self, name: &str) -> Result<&[u8], String> {
        self.bytes.get(name).map(Vec::as_slice).ok_or_else(|| format!("`{name}` was not asked"))
    }
}

/// Packs the page of a site into one file next to it, `alberti.html`.
///
/// # Errors
/// Node is missing, or a part of the page is not where it was.
pub fn write_single_file(site: &Path) -> Outcome {
    let mut node = Command::new("node");
    node.arg(project_root().join("crates/web/single_file.mjs"));
    run_command(node.arg(site).arg(site.join("alberti.html")))
}

/// The size of a file after `gzip -9`, as hosts send it.
///
/// # Errors
/// Node or the file is missing.
pub fn gzip_size(path: &Path) -> Result<usize, String> {
    let script = "const {readFileSync: read} = require('node:fs'); \
        console.log(require('node:zlib').gzipSync(read(process.argv[1]), {level: 9}).length)";
    let text = capture_output(Command::new("node").args(["-e", script]).arg(path))?;
    text.trim().parse().map_err(|_| format!("Node gives no size of {}", path.display()))
}

/// The message that Node is missing, if it is.
pub fn missing_node() -> Option<String> {
    let has = |program: &str| Command::new(program).arg("--version").output().is_ok();
    let missing = ["node", "npm"].into_iter().find(|program| !has(program))?;
    Some(format!("there is no `{missing}`: install Node.js"))
}
