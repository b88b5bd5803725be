//! Connections: a thread for each, few at once, and none that can wait for long.
//!
//! A browser, or anything else on the machine, may open connections and send nothing. When there
//! are too many, the one that has waited longest for its request is closed: a new one that sends its
//! request at once is answered however many are silent.

use super::CliError;
use super::request::{parse_request, read_head};
use super::site::Site;
use std::collections::VecDeque;
use std::net::{Shutdown, TcpListener, TcpStream};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

/// Connections at once.
const MAX_CONNECTIONS: usize = 64;

/// Time in which a piece of a response must have been taken.
const WRITE_TIME: Duration = Duration::from_secs(30);

/// Pause after the system refuses a connection or a thread, so that it is not asked in a loop.
const PAUSE: Duration = Duration::from_millis(50);

/// The connections of a server.
#[derive(Debug, Default)]
struct Connections {
    /// How many there are.
    count: usize,
    /// How many there have been: the next one's number.
    accepted: u64,
    /// Those whose request has not come yet, the oldest first.
    waiting: VecDeque<(u64, TcpStream)>,
}

/// A connection, counted as long as it lives.
#[derive(Debug)]
struct Connection {
    number: u64,
    stream: TcpStream,
    all: Arc<Mutex<Connections>>,
}

/// Answers requests for as long as the program runs.
///
/// # Errors
/// None: a server ends with its program. The type is that of all commands.
pub(super) fn serve(listener: &TcpListener, port: u16, site: Site) -> Result<(), CliError> {
    let site = Arc::new(site);
    let all = Arc::new(Mutex::new(Connections::default()));
    loop {
        let Ok((stream, _)) = listener.accept() else {
            std::thread::sleep(PAUSE);
            continue;
        };
        let Some(connection) = Connection::admit(stream, &all) else { continue };
        let site = Arc::clone(&site);
        let thread = std::thread::Builder::new();
        // A connection without a thread is dropped here, and closed.
        if thread.spawn(move || connection.answer(port, &site)).is_err() {
            std::thread::sleep(PAUSE);
        }
    }
}

impl Connection {
    /// Counts a connection; closes the oldest silent one, or this one, if there are too many.
    fn admit(stream: TcpStream, all: &Arc<Mutex<Connections>>) -> Option<Self> {
        let waiting = stream.try_clone().ok()?;
        let mut connections = all.lock().unwrap_or_else(PoisonError::into_inner);
        if connections.count >= MAX_CONNECTIONS {
            // Its thread wakes up, and takes it off the count.
            let (_, oldest) = connections.waiting.pop_front()?;
            let _ = oldest.shutdown(Shutdown::Both);
        }
        let number = connections.accepted;
        connections.accepted += 1;
        connections.count += 1;
        connections.waiting.push_back((number, waiting));
        drop(connections);
        Some(Self { number, stream, all: Arc::clone(all) })
    }

    /// Reads the request and writes the response.
    fn answer(mut self, port: u16, site: &Site) {
        let head = read_head(&mut self.stream);
        self.stop_waiting();
        let request = match head {
            Ok(head) => parse_request(&head, port),
            Err(Some(response)) => Err(response),
            Err(None) => return,
        };
        if self.stream.set_write_timeout(Some(WRITE_TIME)).is_err() {
            return;
        }
        // A client that has gone takes nothing.
        let _ = match request {
            Ok(request) => {
                let response = site.respond(&request);
                response.write_to(&mut self.stream, request.is_head)
            }
            Err(response) => response.write_to(&mut self.stream, false),
        };
    }

    /// Takes the connection off the list of those that may be closed.
    fn stop_waiting(&self) {
        let mut connections = self.all.lock().unwrap_or_else(PoisonError::into_inner);
        connections.waiting.retain(|(number, _)| *number != self.number);
    }
}

impl Drop for Connection {
    fn drop(&mut self) {
        self.stop_waiting();
        let mut connections = self.all.lock().unwrap_or_else(PoisonError::into_inner);
        connections.count -= 1;
    }
}
