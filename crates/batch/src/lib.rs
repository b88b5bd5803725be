//! Batches of pictures: many models and scenes, each rendered to a picture of its own.
//!
//! ```text
//!  folders, lists ─► stream of jobs ─► this shard ─► not done yet ─► workers ─► pictures, tars
//!                                                         ▲             │
//!                                     records of earlier runs ◄── report ◄── counts, metrics
//! ```
//! A job is done if a report has it with the same content and settings and its picture has the
//! recorded size. A run that was stopped or killed therefore resumes where it was. A model that is
//! broken, hangs, crashes or takes all memory is one line of the report and does not stop the
//! others.
//!
//! The output folder holds, besides the pictures:
//!
//! - `reports/`: the reports of all runs, one JSON object per job;
//! - `report.jsonl`: the reports merged, and `index.html`, the contact sheet, both written by a run
//!   without shards and by [`merge_reports`].
//!
//! Names of pictures and the shards of jobs depend on the inputs alone, so that neither threads nor
//! shards change them.
//!
//! | module | subject |
//! | --- | --- |
//! | `run` | a batch from its options: [`run_jobs`], [`verify_jobs`], [`merge_reports`] |
//! | `inputs`, `job_list`, `list_line`, `job_stream` | the jobs, read as they are needed |
//! | `template`, `picture_name`, `flag_table` | names of pictures, flags of lines |
//! | `key`, `content_digest`, `earlier_records` | what is done already |
//! | `pool`, `worker_process`, `protocol`, `outcome` | workers, and how they end |
//! | `report`, `report_reader`, `merge`, `contact_sheet` | what came of the jobs |
//! | `progress`, `metrics` | how far a run is |
//! | `shard`, `tar_output`, `verify` | jobs divided between machines; tar files; verification |

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
