//! Connections: one thread each, with limits on their number and on how long they may wait.
//!
//! A browser, or any other program on the machine, may open connections and send nothing, or send a
//! request and not read the answer. When there are too many connections, the one whose request has
//! been outstanding longest is closed. If all requests have arrived, the connection that has been
//! reading its answer longest is closed. A new connection that sends its request at once is thus
//! answered no matter how many others are silent or slow.

use super::CliError;
use super::request::{parse_request, read_head};
use super::response::Response;
use super::site::{Site, Visitor};
use std::collections::VecDeque;
use std::io::{ErrorKind, Read as _, Write as _};
use std::net::{Shutdown, TcpListener, TcpStream};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

/// Maximum number of simultaneous connections.
const MAX_CONNECTIONS: usize = 64;

/// Maximum total size in bytes of answers not yet read by clients: twice the largest picture.
const MAX_UNTAKEN_BYTES: usize = 512 << 20;

/// Time in which a response must be read, plus [`TIME_PER_MIB`] for each MiB.
const WRITE_TIME: Duration = Duration::from_secs(20);
const TIME_PER_MIB: Duration = Duration::from_secs(1);

/// Bytes written at a time; the deadline is checked between blocks.
const PIECE_BYTES: usize = 256 << 10;

/// Pause after the system refuses a connection or a thread, to avoid a busy loop.
const PAUSE: Duration = Duration::from_millis(50);

/// The connections of a server.
#[derive(Debug, Default)]
struct Connections {
    /// The number of open connections.
    count: usize,
    /// The number of connections so far, which becomes the number of the next connection.
    accepted: u64,
    /// Connections whose request has not arrived yet, oldest first.
    silent: VecDeque<Closable>,
    /// Connections whose response is being written, oldest first.
    taking: VecDeque<Closable>,
}

/// A connection that may be closed to admit another.
#[derive(Debug)]
struct Closable {
    number: u64,
    stream: TcpStream,
    /// Bytes of memory freed by closing the connection.
    bytes: usize,
}

/// A connection, which counts as open until it is dropped.
#[derive(Debug)]
struct Connection {
    number: u64,
    stream: TcpStream,
    all: Arc<Mutex<Connections>>,
}

/// Answers requests until the program ends.
///
/// # Errors
/// Never fails: the server runs until the program ends. All commands have the same return type.
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
        // If the thread cannot be started, the connection is dropped here, which closes it.
        if thread.spawn(move || connection.answer(port, &site)).is_err() {
            std::thread::sleep(PAUSE);
        }
    }
}

impl Connections {
    /// Closes the oldest idle or slow connection; returns false if no connection can be closed.
    ///
    /// Its thread wakes up and decrements the count.
    fn close_oldest(&mut self) -> bool {
        let oldest = self.silent.pop_front().or_else(|| self.taking.pop_front());
        oldest.is_some_and(|oldest| {
            // It may already be closed.
            let _ = oldest.stream.shutdown(Shutdown::Both);
            true
        })
    }

    /// Closes the connections that have been reading longest, until another answer fits.
    fn make_room_for(&mut self, bytes: usize) {
        let mut untaken: usize = self.taking.iter().map(|taking| taking.bytes).sum();
        while untaken + bytes > MAX_UNTAKEN_BYTES {
            let Some(oldest) = self.taking.pop_front() else { return };
            let _ = oldest.stream.shutdown(Shutdown::Both);
            untaken -= oldest.bytes;
        }
    }

    /// Removes a connection from the lists of connections that may be closed.
    fn keep_open(&mut self, number: u64) {
        self.silent.retain(|closable| closable.number != number);
        self.taking.retain(|closable| closable.number != number);
    }
}

impl Connection {
    /// Counts a connection; if there are too many, closes another or refuses this one.
    fn admit(stream: TcpStream, all: &Arc<Mutex<Connections>>) -> Option<Self> {
        let silent = stream.try_clone().ok()?;
        let mut connections = all.lock().unwrap_or_else(PoisonError::into_inner);
        if connections.count >= MAX_CONNECTIONS && !connections.close_oldest() {
            return None;
        }
        let number = connections.accepted;
        connections.accepted += 1;
        connections.count += 1;
        connections.silent.push_back(Closable { number, stream: silent, bytes: 0 });
        drop(connections);
        Some(Self { number, stream, all: Arc::clone(all) })
    }

    /// Reads the request and writes the response.
    fn answer(mut self, port: u16, site: &Site) {
        let head = read_head(&mut self.stream);
        self.lock().keep_open(self.number);
        let request = match head {
            Ok(head) => parse_request(&head, port),
            Err(Some(response)) => Err(response),
            Err(None) => return,
        };
        // The client may have disconnected.
        let _ = match request {
            Ok(request) => match site.respond(&request, &mut self) {
                Some(response) => self.write(&response, request.is_head),
                None => Ok(()),
            },
            Err(response) => self.write(&response, false),
        };
    }

    /// Writes a response, within a time limit that depends on its size.
    fn write(&mut self, response: &Response<'_>, is_head: bool) -> std::io::Result<()> {
        let body = if is_head { &[] } else { response.bytes() };
        let mebibytes = u32::try_from(body.len() >> 20).unwrap_or(u32::MAX);
        let deadline = Instant::now() + WRITE_TIME + TIME_PER_MIB * mebibytes;
        let stream = self.stream.try_clone()?;
        let bytes = response.owned_bytes();
        let mut connections = self.lock();
        connections.make_room_for(bytes);
        connections.taking.push_back(Closable { number: self.number, stream, bytes });
        drop(connections);
        self.write_until(deadline, response.head().as_bytes())?;
        self.write_until(deadline, body)
    }

    /// Writes bytes in blocks; a client that reads too slowly is an error.
    fn write_until(&mut self, deadline: Instant, mut bytes: &[u8]) -> std::io::Result<()> {
        while !bytes.is_empty() {
            let left = deadline.saturating_duration_since(Instant::now());
            if left.is_zero() {
                return Err(ErrorKind::TimedOut.into());
            }
            self.stream.set_write_timeout(Some(left))?;
            match self.stream.write(&bytes[..bytes.len().min(PIECE_BYTES)]) {
                Ok(0) => return Err(ErrorKind::WriteZero.into()),
                Ok(count) => bytes = &bytes[count..],
                Err(error) if error.kind() == ErrorKind::Interrupted => {}
                Err(error) => return Err(error),
            }
        }
        Ok(())
    }

    fn lock(&self) -> MutexGuard<'_, Connections> {
        self.all.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Visitor for Connection {
    /// Whether the client is still waiting: neither the connection nor its sending side is closed.
    fn is_there(&mut self) -> bool {
        if self.stream.set_nonblocking(true).is_err() {
            return false;
        }
        // Only one request is read per connection.
        let is_there = match self.stream.read(&mut [0; 2048]) {
            Ok(count) => count > 0,
            Err(error) => matches!(error.kind(), ErrorKind::WouldBlock | ErrorKind::Interrupted),
        };
        self.stream.set_nonblocking(false).is_ok() && is_there
    }
}

impl Drop for Connection {
    fn drop(&mut self) {
        let mut connections = self.lock();
        connections.keep_open(self.number);
        connections.count -= 1;
    }
}
