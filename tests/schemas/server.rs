//! The explorer's answers, as sent by its server.

use crate::schemas::documents::Document;
use serde_json::Value;
use std::io::{BufRead as _, BufReader, Read as _, Write as _};
use std::net::TcpStream;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::Duration;

/// A server that is stopped on drop.
struct Server {
    child: Child,
    port: u16,
    /// The secret at the start of paths.
    token: String,
}

impl Server {
    fn start(program: &Path) -> Result<Self, String> {
        let mut command = Command::new(program);
        let mut child = command
            .args(["explore", "--native"])
            .stdout(Stdio::piped())
            .spawn()
            .map_err(|error| error.to_string())?;
        let mut line = String::new();
        if let Some(output) = &mut child.stdout {
            BufReader::new(output).read_line(&mut line).map_err(|error| error.to_string())?;
        }
        let mut parts = line.split(':').nth(2).unwrap_or_default().split('/');
        let port = parts.next().and_then(|port| port.parse().ok()).unwrap_or_default();
        let token = parts.next().unwrap_or_default().to_owned();
        let server = Self { child, port, token };
        if server.port == 0 { Err(format!("missing address: {line:?}")) } else { Ok(server) }
    }

    /// Returns the JSON of the answer to a query.
    fn ask(&self, query: &str) -> Result<Value, String> {
        let answer = self.send(query).map_err(|error| format!("{query}: {error}"))?;
        let body = answer.split_once("\r\n\r\n").map_or("", |(_, body)| body);
        serde_json::from_str(body).map_err(|error| format!("{query}: {error}: {body:.200}"))
    }

    fn send(&self, query: &str) -> std::io::Result<String> {
        let mut stream = TcpStream::connect(("127.0.0.1", self.port))?;
        stream.set_read_timeout(Some(Duration::from_secs(60)))?;
        let host = format!("127.0.0.1:{}", self.port);
        let path = format!("/{}/compute?{query}", self.token);
        write!(stream, "GET {path} HTTP/1.1\r\nHost: {host}\r\n\r\n")?;
        let mut answer = String::new();
        stream.read_to_string(&mut answer)?;
        Ok(answer)
    }
}

impl Drop for Server {
    fn drop(&mut self) {
        // The server may already have exited.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// Returns the list of lessons, the state and a picked pixel of each lesson, and several errors.
pub fn explorer_documents(program: &Path) -> Result<Vec<Document>, String> {
    let server = Server::start(program)?;
    let document = |schema, query: &str| {
        let json = server.ask(query)?;
        Ok::<_, String>(Document { schema, case: format!("explore {query}"), json })
    };
    let lessons = document("explore-lessons", "what=lessons")?;
    let ids: Vec<String> = lessons.json["lessons"]
        .as_array()
        .into_iter()
        .flatten()
        .filter(|lesson| lesson["models"].as_array().is_some_and(|models| !models.is_empty()))
        .filter_map(|lesson| Some(lesson["id"].as_str()?.to_owned()))
        .collect();
    let mut documents = vec![lessons];
    for id in &ids {
        documents.push(document("explore-state", &format!("what=state&lesson={id}"))?);
        let pick = format!("what=pick&pixel=40,30&size=96x60&samples=1&lesson={id}");
        documents.push(document("explore-pick", &pick)?);
    }
    for query in ["what=state&naer=2", "what=pick&lesson=frustum", "what=state&lesson=model", "v=9"]
    {
        documents.push(document("explore-error", query)?);
    }
    Ok(documents)
}
