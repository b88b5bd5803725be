//! Worker processes as the coordinator sees them: requests, answers, and the end of the process.

use super::protocol::{FramedAnswer, WorkAnswer, WorkRequest};
use crate::BatchError;
use std::io::{BufRead as _, BufReader, Read, Write as _};
use std::process::{Child, ChildStderr, ChildStdin, ChildStdout, Command, ExitStatus, Stdio};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::JoinHandle;
use std::time::Duration;

/// The number of bytes kept from the end of a worker's standard error stream.
const MAX_ERROR_BYTES: usize = 2_048;

/// The maximum size of a picture that is sent through the pipe.
const MAX_PICTURE_BYTES: u64 = 1 << 32;

/// A function that creates the command to which the hidden subcommand `batch-worker` is added.
pub type WorkerProgram<'a> = &'a (dyn Fn() -> std::io::Result<Command> + Sync);

/// A running worker.
pub(super) struct WorkerProcess {
    child: Child,
    requests: ChildStdin,
    answers: Receiver<(WorkAnswer, Vec<u8>)>,
    /// The end of the worker's standard error output, read by `error_reader`.
    error_text: Arc<Mutex<Vec<u8>>>,
    error_reader: Option<JoinHandle<()>>,
    /// The number of answers so far.
    answer_count: u64,
}

/// The reason why a worker did not answer.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(super) enum WorkerEnd {
    /// It exceeded its time limit and was killed.
    TimedOut,
    /// A signal from the worker itself or from another process ended it.
    Signal(i32),
    /// It exited with this code.
    Exit(Option<i32>),
}

impl WorkerProcess {
    /// Starts a worker: this program with the hidden command `batch-worker`.
    ///
    /// The worker ends with the thread that starts it, so this thread must outlive it.
    ///
    /// # Errors
    /// Returns an error if the system cannot start another process.
    pub(super) fn start(
        program: WorkerProgram<'_>,
        memory: Option<u64>,
    ) -> Result<Self, BatchError> {
        let fault = |cause| BatchError::Unusable(format!("cannot start a batch worker: {cause}"));
        let mut command = program().map_err(fault)?;
        // The last output of a worker goes to the report, where a backtrace is useless.
        command.arg("batch-worker").env("RUST_BACKTRACE", "0");
        if let Some(memory) = memory {
            command.arg(format!("--memory={memory}"));
        }
        let pipes = command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
        let mut child = spawn_worker(pipes).map_err(fault)?;
        let missing = || fault(std::io::ErrorKind::BrokenPipe.into());
        let requests = child.stdin.take().ok_or_else(missing)?;
        let stdout = child.stdout.take().ok_or_else(missing)?;
        let stderr = child.stderr.take().ok_or_else(missing)?;
        let (sender, answers) = channel();
        start_thread(move || read_answers(stdout, &sender)).map_err(fault)?;
        let error_text = Arc::new(Mutex::new(Vec::new()));
        let text = Arc::clone(&error_text);
        let error_reader =
            Some(start_thread(move || keep_error_text(stderr, &text)).map_err(fault)?);
        Ok(Self { child, requests, answers, error_text, error_reader, answer_count: 0 })
    }

    /// Returns whether the worker has not answered any request yet, so that no earlier job can have
    /// corrupted it.
    pub(super) const fn is_fresh(&self) -> bool {
        self.answer_count == 0
    }

    /// Sends a request. If the worker has ended, its answer will be missing, which is detected
    /// later.
    ///
    /// # Errors
    /// Returns an error if the request cannot be serialized.
    pub(super) fn send(&mut self, request: &WorkRequest) -> Result<(), BatchError> {
        self.error_text.lock().unwrap_or_else(PoisonError::into_inner).clear();
        let mut line = serde_json::to_vec(request).map_err(|error| {
            BatchError::Unusable(format!("cannot serialize the request: {error}"))
        })?;
        line.push(b'\n');
        let _ = self.requests.write_all(&line);
        Ok(())
    }

    /// Returns the next answer and the picture that follows it.
    ///
    /// # Errors
    /// Returns an error if the worker has ended, or if it does not answer in time and is killed.
    pub(super) fn next_answer(
        &mut self,
        limit: Option<Duration>,
    ) -> Result<(WorkAnswer, Vec<u8>), WorkerEnd> {
        let received = match limit {
            Some(limit) => self.answers.recv_timeout(limit),
            None => self.answers.recv().map_err(|_| RecvTimeoutError::Disconnected),
        };
        match received {
            Ok(answer) => {
                self.answer_count += 1;
                Ok(answer)
            }
            Err(RecvTimeoutError::Timeout) => {
                let _ = self.child.kill();
                let _ = self.child.wait();
                Err(WorkerEnd::TimedOut)
            }
            Err(RecvTimeoutError::Disconnected) => Err(match self.child.wait() {
                Ok(status) => end_of(status),
                Err(_) => WorkerEnd::Exit(None),
            }),
        }
    }

    /// Ends the worker if it is still running; returns the end of its standard error output about
    /// the last request.
    pub(super) fn into_error_text(mut self) -> String {
        let _ = self.child.kill();
        let _ = self.child.wait();
        // The stream ends with the worker.
        let _ = self.error_reader.take().map(JoinHandle::join);
        let text = self.error_text.lock().unwrap_or_else(PoisonError::into_inner);
        String::from_utf8_lossy(&text).trim().to_owned()
    }
}

impl Drop for WorkerProcess {
    fn drop(&mut self) {
        // An idle worker has nothing to clean up, and a busy one is no longer needed.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// Starts a worker; tries again if the system is temporarily out of processes.
fn spawn_worker(command: &mut Command) -> std::io::Result<Child> {
    let mut pause = Duration::from_millis(50);
    loop {
        match command.spawn() {
            Err(error)
                if error.kind() == std::io::ErrorKind::WouldBlock
                    && pause < Duration::from_secs(4) =>
            {
                std::thread::sleep(pause);
                pause *= 2;
            }
            spawned => return spawned,
        }
    }
}

/// Starts a thread that waits for a pipe.
fn start_thread(work: impl FnOnce() + Send + 'static) -> std::io::Result<JoinHandle<()>> {
    std::thread::Builder::new().name("batch pipe".to_owned()).spawn(work)
}

/// Forwards the answers of a worker until it ends or sends invalid output.
fn read_answers(stdout: ChildStdout, sender: &Sender<(WorkAnswer, Vec<u8>)>) {
    let mut stdout = BufReader::new(stdout);
    let mut line = String::new();
    while stdout.read_line(&mut line).is_ok_and(|length| length > 0) {
        let Ok(framed) = serde_json::from_str::<FramedAnswer>(&line) else { break };
        let mut picture = Vec::new();
        if framed.follows > 0 {
            let length = framed.follows.min(MAX_PICTURE_BYTES);
            let read = stdout.by_ref().take(length).read_to_end(&mut picture);
            if read.ok().is_none_or(|read| read as u64 != framed.follows) {
                break;
            }
        }
        if sender.send((framed.answer, picture)).is_err() {
            break;
        }
        line.clear();
    }
}

/// Stores the last bytes of a standard error stream.
fn keep_error_text(mut stderr: ChildStderr, text: &Mutex<Vec<u8>>) {
    let mut buffer = [0; 1_024];
    while let Ok(length @ 1..) = stderr.read(&mut buffer) {
        let mut text = text.lock().unwrap_or_else(PoisonError::into_inner);
        text.extend(buffer.iter().take(length));
        let surplus = text.len().saturating_sub(MAX_ERROR_BYTES);
        text.drain(..surplus);
    }
}

/// Converts the exit status of a worker to the reason why it ended.
#[cfg(unix)]
fn end_of(status: ExitStatus) -> WorkerEnd {
    use std::os::unix::process::ExitStatusExt as _;
    status.signal().map_or(WorkerEnd::Exit(status.code()), WorkerEnd::Signal)
}

/// Converts the exit status of a worker to the reason why it ended.
#[cfg(not(unix))]
fn end_of(status: ExitStatus) -> WorkerEnd {
    WorkerEnd::Exit(status.code())
}
