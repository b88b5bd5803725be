//! Batch jobs, with their inputs, outputs and flags.

use std::fmt;
use std::path::PathBuf;
use std::sync::Arc;

/// One picture to render.
///
/// Jobs of one [`JobGroup`] have the same input, which is loaded once for all of them.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(super) struct BatchJob {
    /// The model or scene.
    pub(super) input: PathBuf,
    /// The picture's path below the output folder, with `/` between its parts.
    pub(super) output: String,
    /// The scene in which the input replaces the model `{input}`.
    pub(super) scene: Option<PathBuf>,
    /// The flags of the job's line, such as `--size=64x64`, which override the command's.
    pub(super) flags: Vec<String>,
    /// The list line that describes the job.
    pub(super) line: Option<ListLine>,
    /// The error in the job's line, if any; the job then fails with this message before it starts.
    pub(super) fault: Option<String>,
}

/// The pictures for one input, which are rendered in the same shard by the same worker.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(super) struct JobGroup {
    /// The pictures, of which there is at least one.
    pub(super) jobs: Vec<BatchJob>,
    /// The size of the input in bytes, if the list specifies it.
    pub(super) bytes: Option<u64>,
}

/// A line of a list, printed in messages as `jobs.jsonl:17`.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(super) struct ListLine {
    /// The name of the list.
    pub(super) list: Arc<str>,
    /// The number of the line, from 1.
    pub(super) number: u64,
}

impl fmt::Display for ListLine {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}", self.list, self.number)
    }
}
