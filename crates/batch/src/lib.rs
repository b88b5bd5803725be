//! Batch rendering: many models and scenes, each rendered to its own picture.
//!
//! ```text
//!  folders, lists ─► stream of jobs ─► this shard ─► not done yet ─► workers ─► pictures, tars
//!                                                         ▲             │
//!                                     records of earlier runs ◄── report ◄── counts, metrics
//! ```
//!
//! A job is done if a report lists it with the same content and settings, and if its picture has
//! the recorded size. A run that was stopped or killed can therefore be resumed. A model that is
//! broken, hangs, crashes its worker or exhausts memory becomes one line in the report and does not
//! stop the others.
//!
//! Apart from the pictures, the output folder holds:
//!
//! - `reports/`: the reports of all runs, one JSON object per job;
//! - `report.jsonl`, the merged report, and `index.html`, the contact sheet: a run without shards
//!   writes both, as does [`merge_reports`].
//!
//! Picture names depend only on the inputs, and the assignment of jobs to shards only on the inputs
//! and the number of shards.
//!
//! | module | subject |
//! | --- | --- |
//! | `run` | a batch, from its options: [`run_jobs`], [`verify_jobs`], [`merge_reports`] |
//! | `inputs`, `job_list`, `list_line`, `job_stream` | the jobs, read on demand |
//! | `template`, `picture_name`, `flag_table` | picture names, flags in list lines |
//! | `key`, `content_digest`, `earlier_records` | jobs already done |
//! | `pool`, `worker_process`, `protocol`, `outcome` | workers, and how they end |
//! | `report`, `report_reader`, `merge`, `contact_sheet` | job results |
//! | `progress`, `metrics` | progress of a run |
//! | `shard`, `tar_output`, `verify` | jobs divided among machines; tar files; verification |

mod contact_sheet;
mod content_digest;
mod csv;
mod earlier_records;
mod error;
mod flag_table;
mod inputs;
mod job;
mod job_list;
mod job_stream;
mod key;
mod left_over;
mod list_line;
mod merge;
mod metrics;
mod outcome;
mod output_names;
mod picture_name;
mod pool;
mod progress;
mod protocol;
mod report;
mod report_reader;
mod run;
mod shard;
mod tar_format;
mod tar_output;
mod template;
#[cfg(test)]
mod test_records;
mod verify;
mod worker_process;

pub use content_digest::{ContentDigest, hexadecimal_sha256, to_hexadecimal};
pub use error::BatchError;
pub use flag_table::{FlagTable, flag_word, is_scene_name};
pub use merge::MergeCounts;
pub use metrics::RunCounts;
pub use picture_name::PictureName;
pub use progress::ProgressDisplay;
pub use protocol::{FramedAnswer, PictureRequest, PictureTarget, WorkAnswer, WorkRequest};
pub use run::{BatchOptions, RunEnd, ShardJobs, merge_reports, run_jobs, verify_jobs};
pub use shard::{Shard, parse_shard};
pub use template::NameTemplate;
pub use worker_process::WorkerProgram;

/// The examples of the README, compiled as documentation tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
