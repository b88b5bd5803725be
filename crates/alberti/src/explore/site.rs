//! The site that is served: the page, the models, the formulas, and the explorer's answers.

use super::companions::ModelFiles;
use super::embedded::{content_type, embedded_files};
use super::lane::{Lane, Unanswered};
use super::request::Request;
use super::response::Response;
use super::token::strip_token;
use crate::CliError;
use explain::formulas::find_formula;
use explorer::{Explorer, ExplorerError};
use import::percent_encode;
use scene_file::is_scene_file;
use serde_json::json;
use std::collections::BTreeMap;
use std::path::Path;

/// The page itself, which is also served for an empty path.
const INDEX: &str = "index.html";

/// Everything that can be requested.
pub(super) struct Site {
    /// All files by their URL paths: the page, the lesson models, the user's model.
    files: BTreeMap<String, Vec<u8>>,
    /// The first part of every path.
    token: String,
    /// Answers requests for numbers and text, which take little time.
    small: Lane,
    /// Answers requests for pictures and drawings.
    large: Lane,
}

/// The sender of a request.
pub(super) trait Visitor {
    /// Whether the client is still waiting for the answer.
    fn is_there(&mut self) -> bool;
}

impl Site {
    /// Reads the model named on the command line and checks that it can be shown.
    ///
    /// # Errors
    /// Returns an error if the model cannot be read or shown.
    pub(super) fn prepare(model: Option<&Path>, token: String) -> Result<Self, CliError> {
        let mut files = embedded_files();
        let mut explorer = Explorer::new();
        for (path, bytes) in files.iter().filter(|(path, _)| path.starts_with("models/")) {
            explorer.add_file(path, bytes.clone()).map_err(as_cli_error)?;
        }
        let given = model.map_or_else(|| Ok(ModelFiles::default()), ModelFiles::read)?;
        for (name, bytes) in &given.files {
            explorer.add_file(name, bytes.clone()).map_err(as_cli_error)?;
        }
        let mut open = String::new();
        if model.is_some() {
            let lesson = if is_scene_file(Path::new(&given.name)) { "scene" } else { "model" };
            open = format!("v=1&lesson={lesson}&model={}", percent_encode(&given.name));
            explorer.answer(&format!("{open}&what=state")).map_err(as_cli_error)?;
        }
        let names: Vec<&String> = given.files.keys().collect();
        let has_engine = files.contains_key("web_bg.wasm");
        let said = json!({"native": true, "wasm": has_engine, "files": names, "open": open});
        if let Some(page) = files.get_mut(INDEX) {
            *page = with_server_info(&String::from_utf8_lossy(page), &said.to_string()).into();
        }
        files.extend(given.files.into_iter().map(|(name, bytes)| (format!("files/{name}"), bytes)));
        let (small, large) = (start_lane(explorer.sibling())?, start_lane(explorer)?);
        Ok(Self { files, token, small, large })
    }

    /// Returns the response to a request, or `None` if the client has given up.
    pub(super) fn respond(
        &self,
        request: &Request,
        visitor: &mut impl Visitor,
    ) -> Option<Response<'_>> {
        let Some(path) = strip_token(&request.path, &self.token) else {
            let text =
                "Open the full address that `alberti explore` printed; it contains a secret.";
            return Some(Response::text(403, text));
        };
        let path = if path.is_empty() { INDEX } else { path };
        if path == "compute" {
            return self.compute(&request.query, visitor);
        }
        if let Some(formula) = path.strip_prefix("reference/").and_then(find_formula) {
            return Some(Response::ok(content_type(INDEX), formula.to_html().into_bytes()));
        }
        Some(match self.files.get(path) {
            Some(bytes) => Response::ok(content_type(path), bytes.as_slice()),
            None => Response::text(404, "File not found."),
        })
    }

    /// Returns the explorer's answer to a query.
    ///
    /// An explorer error is an answer like any other, with a separate content type. It does not
    /// change the status, because browsers log every response with a status other than 200, and a
    /// value that cannot be drawn is not an error in the page.
    fn compute(&self, query: &str, visitor: &mut impl Visitor) -> Option<Response<'_>> {
        let lane = if draws(query) { &self.large } else { &self.small };
        Some(match lane.ask(query, || visitor.is_there()) {
            Ok(Ok(answer)) => Response::ok(answer.content_type, answer.bytes),
            Ok(Err(ExplorerError { code, message, help })) => {
                let error = json!({ "code": code, "message": message, "help": help });
                Response::ok("application/problem+json", error.to_string().into_bytes())
            }
            Err(Unanswered::Busy) => Response::text(503, "Too many requests; try again later."),
            Err(Unanswered::Failed) => Response::text(500, "The computation failed."),
            Err(Unanswered::Abandoned) => return None,
        })
    }
}

/// Whether a query requests pixels or lines.
fn draws(query: &str) -> bool {
    let asked = query.split('&').find_map(|pair| pair.strip_prefix("what="));
    !matches!(asked, None | Some("lessons" | "state" | "depth" | "pick"))
}

fn start_lane(explorer: Explorer) -> Result<Lane, CliError> {
    Lane::start(explorer).map_err(|error| {
        CliError::Usage(format!(
            "cannot start a thread: {error}\n  = help: close other programs, or raise the process \
             limit"
        ))
    })
}

fn as_cli_error(error: ExplorerError) -> CliError {
    let ExplorerError { message, help, .. } = error;
    CliError::Usage(format!("{message}\n  = help: {help}"))
}

/// Returns the page with information about the server in an attribute.
fn with_server_info(page: &str, said: &str) -> String {
    let said = said.replace('&', "&amp;").replace('"', "&quot;").replace('<', "&lt;");
    let place = r#"name="explorer-server" content=""#;
    page.replacen(&format!("{place}\""), &format!("{place}{said}\""), 1)
}
