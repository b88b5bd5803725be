//! Shards: the jobs of a batch divided between several machines.
//!
//! Every machine runs the same command with a shard of its own and needs nothing from the others
//! but a common view of the inputs: each finds all jobs, sorts them, and takes its part.
//!
//! ```text
//! alberti batch models --out-dir out --shard 2/8
//! alberti batch models --out-dir out --shard auto     (in an array job of Slurm, AWS, …)
//! ```

use std::str::FromStr as _;

/// One of `count` shards.
///
/// Always `index < count`.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) struct Shard {
    /// The index of the shard, from 0.
    index: usize,
    /// The number of shards.
    count: usize,
}

impl Shard {
    /// The only shard of a run on one machine.
    pub(super) const ALL_JOBS: Self = Self { index: 0, count: 1 };

    /// Whether there is only one shard.
    ///
    /// Only then can the run write the contact sheet: a shard does not know the results of the
    /// others.
    pub(super) fn has_all_jobs(self) -> bool {
        self.count == 1
    }

    /// Whether a job is in the shard. Jobs are dealt out round-robin, because large models are
    /// often neighbors in a folder.
    pub(super) fn has_job(self, job: usize) -> bool {
        job % self.count == self.index
    }

    /// The suffix of the report's file name.
    ///
    /// Shards are counted from 1 here, as on the command line: `-2-of-8`. Each has its own report,
    /// because appending from several machines to one file is not safe on network file systems.
    pub(super) fn file_suffix(self) -> String {
        if self.has_all_jobs() {
            String::new()
        } else {
            format!("-{}-of-{}", self.index + 1, self.count)
        }
    }

    /// A shard, if its index is valid.
    fn new(part: usize, parts: usize) -> Option<Self> {
        (part < parts).then_some(Self { index: part, count: parts })
    }
}

/// Gives the groups of jobs to shards, in the order of the jobs.
pub(super) struct ShardBalance {
    /// The shard that is run here.
    shard: Shard,
    /// The number of groups so far.
    groups: usize,
}

impl ShardBalance {
    /// A balance without any jobs yet.
    pub(super) const fn new(shard: Shard) -> Self {
        Self { shard, groups: 0 }
    }

    /// Whether the next group, of so many bytes, is one of this shard.
    pub(super) fn takes_group(&mut self, _bytes: u64) -> bool {
        self.groups += 1;
        self.shard.has_job(self.groups - 1)
    }
}

/// Parses `I/N`, or takes both from the environment for `auto`.
///
/// # Errors
/// If the text is not `I/N` with `1 <= I <= N`, or `auto` is used outside of an array job.
pub(super) fn parse_shard(text: &str) -> Result<Shard, String> {
    if text == "auto" {
        return from_variables(|name| std::env::var(name).ok().as_deref().and_then(parse_count));
    }
    let fault = || "expected I/N with I from 1 to N, such as 2/8, or auto".to_owned();
    let (part, parts) = text.split_once('/').ok_or_else(fault)?;
    let (part, parts) =
        (parse_count(part).ok_or_else(fault)?, parse_count(parts).ok_or_else(fault)?);
    part.checked_sub(1).and_then(|part| Shard::new(part, parts)).ok_or_else(fault)
}

/// Parses a non-negative integer.
///
/// Signs are rejected by the type, except a leading `+`, which Rust accepts.
fn parse_count(digits: &str) -> Option<usize> {
    usize::from_str(digits.trim()).ok()
}

/// The environment variables of job schedulers: index of the task, first index, and task count.
///
/// Slurm, AWS Batch, Cloud Run jobs, Google Batch, Grid Engine, LSF, Buildkite, and GitLab CI, in
/// this order. The first index is given separately, because array jobs may be numbered from any
/// index. Steps other than 1 leave gaps in the indices and are not supported.
const SCHEDULERS: &[(&str, FirstIndex, TaskCount)] = &[
    (
        "SLURM_ARRAY_TASK_ID",
        FirstIndex::Variable("SLURM_ARRAY_TASK_MIN"),
        TaskCount::Variable("SLURM_ARRAY_TASK_COUNT"),
    ),
    (
        "AWS_BATCH_JOB_ARRAY_INDEX",
        FirstIndex::Constant(0),
        TaskCount::Variable("AWS_BATCH_JOB_ARRAY_SIZE"),
    ),
    ("CLOUD_RUN_TASK_INDEX", FirstIndex::Constant(0), TaskCount::Variable("CLOUD_RUN_TASK_COUNT")),
    ("BATCH_TASK_INDEX", FirstIndex::Constant(0), TaskCount::Variable("BATCH_TASK_COUNT")),
    ("SGE_TASK_ID", FirstIndex::Variable("SGE_TASK_FIRST"), TaskCount::Last("SGE_TASK_LAST")),
    ("LSB_JOBINDEX", FirstIndex::Constant(1), TaskCount::Last("LSB_JOBINDEX_END")),
    (
        "BUILDKITE_PARALLEL_JOB",
        FirstIndex::Constant(0),
        TaskCount::Variable("BUILDKITE_PARALLEL_JOB_COUNT"),
    ),
    ("CI_NODE_INDEX", FirstIndex::Constant(1), TaskCount::Variable("CI_NODE_TOTAL")),
];

/// The index of the first task.
///
/// Schedulers that always count from the same number need no variable.
enum FirstIndex {
    /// The scheduler always counts from this index.
    Constant(usize),
    /// The variable holds the first index; 0 if it is not set.
    Variable(&'static str),
}

/// The number of tasks, or the index of the last one.
enum TaskCount {
    /// The variable holds the number of tasks.
    Variable(&'static str),
    /// The variable holds the index of the last task; the count follows from the first index.
    Last(&'static str),
}

/// The shard of the first scheduler whose variables are set.
fn from_variables(variable: impl Fn(&str) -> Option<usize>) -> Result<Shard, String> {
    for (own, least, count) in SCHEDULERS {
        let Some(own) = variable(own) else { continue };
        let least = match least {
            FirstIndex::Constant(least) => Some(*least),
            FirstIndex::Variable(name) => variable(name),
        };
        let least = least.unwrap_or(0);
        let parts = match count {
            TaskCount::Variable(name) => variable(name),
            TaskCount::Last(name) => variable(name).and_then(|last| (last + 1).checked_sub(least)),
        };
        if let Some(shard) = own.checked_sub(least).and_then(|part| Shard::new(part, parts?)) {
            return Ok(shard);
        }
    }
    let names: Vec<&str> = SCHEDULERS.iter().map(|(own, ..)| *own).collect();
    Err(format!(
        "no array job found in the environment: none of {} is set together with its count",
        names.join(", ")
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shards_are_counted_from_one_and_are_a_partition() {
        assert_eq!(parse_shard("2/8"), Ok(Shard { index: 1, count: 8 }));
        for wrong in ["", "2", "0/3", "4/3", "1/0", "-1/2", "a/b"] {
            assert!(parse_shard(wrong).is_err(), "{wrong}");
        }
        for job in 0..20 {
            let of = (1..=3)
                .filter(|part| parse_shard(&format!("{part}/3")).is_ok_and(|s| s.has_job(job)));
            assert_eq!(of.count(), 1, "{job}");
        }
    }

    #[test]
    fn array_jobs_are_known_by_their_variables() {
        let known = |set: &'static [(&str, usize)]| {
            from_variables(move |name| {
                set.iter().find(|(known, _)| *known == name).map(|(_, value)| *value)
            })
        };
        let slurm = &[
            ("SLURM_ARRAY_TASK_ID", 5),
            ("SLURM_ARRAY_TASK_MIN", 1),
            ("SLURM_ARRAY_TASK_COUNT", 8),
        ];
        assert_eq!(known(slurm), Ok(Shard { index: 4, count: 8 }));
        let engine = &[("SGE_TASK_ID", 3), ("SGE_TASK_FIRST", 1), ("SGE_TASK_LAST", 4)];
        assert_eq!(known(engine), Ok(Shard { index: 2, count: 4 }));
        let aws = &[("AWS_BATCH_JOB_ARRAY_INDEX", 0), ("AWS_BATCH_JOB_ARRAY_SIZE", 2)];
        assert_eq!(known(aws), Ok(Shard { index: 0, count: 2 }));
        assert!(known(&[("SLURM_ARRAY_TASK_ID", 5)]).is_err());
        assert!(known(&[]).is_err());
    }
}
