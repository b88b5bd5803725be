//! Shards, which divide the jobs of a batch among several machines.
//!
//! Every machine runs the same command with a different shard, and shares only the inputs with the
//! others. Each machine goes through all jobs in the same order and takes the jobs that
//! [`ShardBalance`] assigns to its shard.
//!
//! ```text
//! alberti batch models --out-dir out --shard 2/8
//! alberti batch models --out-dir out --shard auto     (in an array job of Slurm, AWS, …)
//! alberti batch models --out-dir out --shard auto/8   (only the index is known: Kubernetes, PBS)
//! ```

use std::cmp::Reverse;
use std::collections::BinaryHeap;
use std::str::FromStr as _;

/// The maximum number of shards; no scheduler has larger array jobs.
const MAX_SHARDS: usize = 1_000_000;

/// One of `count` shards.
///
/// Always `index < count`.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Shard {
    /// The index of the shard, from 0.
    index: usize,
    /// The number of shards.
    count: usize,
}

impl Shard {
    /// The only shard of a run on one machine.
    pub const ALL_JOBS: Self = Self { index: 0, count: 1 };

    /// Returns whether there is only one shard.
    ///
    /// Only then can the run merge the reports: a shard does not know when the others are done.
    #[must_use]
    pub const fn has_all_jobs(self) -> bool {
        self.count == 1
    }

    /// Returns the shard in file names, counted from 1 as on the command line: `2-of-8`.
    ///
    /// Each shard has its own files, because appending to one file from several machines is not
    /// safe on network file systems.
    pub(super) fn file_name_part(self) -> String {
        format!("{}-of-{}", self.index + 1, self.count)
    }

    /// Creates a shard, if its index is valid.
    fn new(index: usize, count: usize) -> Option<Self> {
        (index < count && count <= MAX_SHARDS).then_some(Self { index, count })
    }
}

/// The jobs of one shard, balanced by the bytes of their inputs.
///
/// Each job is assigned to the shard with the fewest bytes so far; ties go to the first shard.
/// Large models are often neighbors in a folder, and one of them may be as large as a thousand
/// others. Each machine counts the jobs of all shards, so the shards need not communicate.
#[derive(Clone, Debug)]
pub(super) struct ShardBalance {
    /// The shard whose jobs are selected.
    shard: Shard,
    /// The bytes and the index of each shard, with the fewest bytes on top.
    loads: BinaryHeap<Reverse<(u64, usize)>>,
}

impl ShardBalance {
    /// Creates a balance in which all shards are empty.
    pub(super) fn new(shard: Shard) -> Self {
        Self { shard, loads: (0..shard.count).map(|index| Reverse((0, index))).collect() }
    }

    /// Assigns the next group of jobs, whose input has this many bytes; returns whether it belongs
    /// to this shard.
    ///
    /// An input of 0 bytes, such as a missing file, counts as 1 byte: otherwise one shard would get
    /// all such inputs.
    pub(super) fn takes_group(&mut self, bytes: u64) -> bool {
        let Some(mut least) = self.loads.peek_mut() else { return true };
        let Reverse((load, index)) = *least;
        *least = Reverse((load.saturating_add(bytes.max(1)), index));
        index == self.shard.index
    }
}

/// Parses `I/N`; `auto` and `auto/N` take the index from the environment.
///
/// # Errors
/// Returns an error if the text is not `I/N` with `1 <= I <= N`, if `auto` is used outside an array
/// job, or if the array job does not have `N` tasks.
pub fn parse_shard(text: &str) -> Result<Shard, String> {
    parse_shard_with(text, |name| std::env::var(name).ok().as_deref().and_then(parse_count))
}

/// Parses a shard like [`parse_shard`], with these environment variables.
fn parse_shard_with(text: &str, variable: impl Fn(&str) -> Option<usize>) -> Result<Shard, String> {
    let fault = || "expected I/N (I from 1 to N, as in 2/8), auto or auto/N".to_owned();
    if text == "auto" {
        return shard_of_task(variable, None);
    }
    let (part, parts) = text.split_once('/').ok_or_else(fault)?;
    let parts = parse_count(parts).filter(|count| (1..=MAX_SHARDS).contains(count));
    let parts = parts.ok_or_else(fault)?;
    if part == "auto" {
        return shard_of_task(variable, Some(parts));
    }
    let part = parse_count(part).ok_or_else(fault)?;
    part.checked_sub(1).and_then(|index| Shard::new(index, parts)).ok_or_else(fault)
}

/// Parses a non-negative integer.
///
/// Signs are rejected by the type, except a leading `+`, which Rust accepts.
fn parse_count(digits: &str) -> Option<usize> {
    usize::from_str(digits.trim()).ok()
}

/// The environment variables of a job scheduler.
struct Scheduler {
    /// The index of this task.
    index: &'static str,
    /// The index of the first task, because array job numbering may start anywhere.
    first: FirstIndex,
    /// The number of tasks.
    count: TaskCount,
    /// The difference between successive indices; 1 if no variable holds it.
    step: Option<&'static str>,
}

/// The index of the first task.
///
/// Schedulers that always count from the same number need no variable.
enum FirstIndex {
    /// The scheduler always counts from this index.
    Constant(usize),
    /// The variable holds the first index; 0 if it is not set.
    Variable(&'static str),
}

/// The source of the number of tasks.
enum TaskCount {
    /// The variable holds the number of tasks.
    Variable(&'static str),
    /// The variable holds the index of the last task; the count follows from the first index.
    Last(&'static str),
    /// The scheduler does not report the number, so `auto/N` must specify it.
    Unknown,
}

/// The known job schedulers.
///
/// The order is: Slurm, AWS Batch, Cloud Run jobs, Google Batch, Grid Engine, LSF, PBS, Buildkite,
/// GitLab CI, Kubernetes. Kubernetes comes last because other schedulers may run their tasks in it.
const SCHEDULERS: &[Scheduler] = &[
    Scheduler {
        index: "SLURM_ARRAY_TASK_ID",
        first: FirstIndex::Variable("SLURM_ARRAY_TASK_MIN"),
        count: TaskCount::Variable("SLURM_ARRAY_TASK_COUNT"),
        step: Some("SLURM_ARRAY_TASK_STEP"),
    },
    Scheduler {
        index: "AWS_BATCH_JOB_ARRAY_INDEX",
        first: FirstIndex::Constant(0),
        count: TaskCount::Variable("AWS_BATCH_JOB_ARRAY_SIZE"),
        step: None,
    },
    Scheduler {
        index: "CLOUD_RUN_TASK_INDEX",
        first: FirstIndex::Constant(0),
        count: TaskCount::Variable("CLOUD_RUN_TASK_COUNT"),
        step: None,
    },
    Scheduler {
        index: "BATCH_TASK_INDEX",
        first: FirstIndex::Constant(0),
        count: TaskCount::Variable("BATCH_TASK_COUNT"),
        step: None,
    },
    Scheduler {
        index: "SGE_TASK_ID",
        first: FirstIndex::Variable("SGE_TASK_FIRST"),
        count: TaskCount::Last("SGE_TASK_LAST"),
        step: Some("SGE_TASK_STEPSIZE"),
    },
    Scheduler {
        index: "LSB_JOBINDEX",
        first: FirstIndex::Constant(1),
        count: TaskCount::Last("LSB_JOBINDEX_END"),
        step: Some("LSB_JOBINDEX_STEP"),
    },
    Scheduler {
        index: "PBS_ARRAY_INDEX",
        first: FirstIndex::Constant(1),
        count: TaskCount::Unknown,
        step: None,
    },
    Scheduler {
        index: "BUILDKITE_PARALLEL_JOB",
        first: FirstIndex::Constant(0),
        count: TaskCount::Variable("BUILDKITE_PARALLEL_JOB_COUNT"),
        step: None,
    },
    Scheduler {
        index: "CI_NODE_INDEX",
        first: FirstIndex::Constant(1),
        count: TaskCount::Variable("CI_NODE_TOTAL"),
        step: None,
    },
    Scheduler {
        index: "JOB_COMPLETION_INDEX",
        first: FirstIndex::Constant(0),
        count: TaskCount::Unknown,
        step: None,
    },
];

impl Scheduler {
    /// Returns the index of this task, from 0, and the number of tasks if known.
    ///
    /// Returns `None` outside an array job, or if the index does not match the other variables.
    fn task(&self, variable: &impl Fn(&str) -> Option<usize>) -> Option<(usize, Option<usize>)> {
        let own = variable(self.index)?;
        let first = match self.first {
            FirstIndex::Constant(first) => first,
            FirstIndex::Variable(name) => variable(name).unwrap_or(0),
        };
        let step = self.step.and_then(variable).unwrap_or(1).max(1);
        let offset = own.checked_sub(first)?;
        let count = match self.count {
            TaskCount::Unknown => None,
            TaskCount::Variable(name) => Some(variable(name)?),
            TaskCount::Last(name) => Some(variable(name)?.checked_sub(first)? / step + 1),
        };
        let fits = offset % step == 0 && count.is_none_or(|count| offset / step < count);
        fits.then_some((offset / step, count))
    }
}

/// Returns the shard of the first scheduler whose variables are set.
///
/// `wanted` is the number of shards in `auto/N`. If the number of tasks is known, it must be the
/// same; otherwise, jobs of shards without a task would never be rendered.
fn shard_of_task(
    variable: impl Fn(&str) -> Option<usize>,
    wanted: Option<usize>,
) -> Result<Shard, String> {
    let mut known = SCHEDULERS.iter().filter_map(|scheduler| {
        scheduler.task(&variable).map(|(index, count)| (scheduler.index, index, count))
    });
    let Some((name, index, count)) = known.next() else {
        let names: Vec<&str> = SCHEDULERS.iter().map(|scheduler| scheduler.index).collect();
        return Err(format!(
            "no array job in the environment: none of {} is set together with its task count; use \
             --shard I/N",
            names.join(", ")
        ));
    };
    let count = match (wanted, count) {
        (Some(wanted), Some(count)) if wanted != count => {
            return Err(format!(
                "the array job has {}, not {wanted}; to run some of its tasks again, \
                 use --shard I/{wanted}",
                files::counted(count, "task", "tasks")
            ));
        }
        (None, None) => {
            return Err(format!(
                "{name} is set, but the number of tasks is not; use --shard auto/N"
            ));
        }
        (wanted, count) => wanted.or(count).unwrap_or(1),
    };
    Shard::new(index, count)
        .ok_or_else(|| format!("{name} selects task {}, but the shard count is {count}", index + 1))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Parses the shard `auto` or `auto/N` with these variables.
    fn shard_with(text: &str, set: &[(&str, usize)]) -> Result<Shard, String> {
        let value = |name: &str| set.iter().find(|(known, _)| *known == name).map(|(_, v)| *v);
        parse_shard_with(text, value)
    }

    #[test]
    fn shards_are_counted_from_one() {
        assert_eq!(parse_shard("2/8"), Ok(Shard { index: 1, count: 8 }));
        assert_eq!(Shard { index: 1, count: 8 }.file_name_part(), "2-of-8");
        for wrong in ["", "2", "0/3", "4/3", "1/0", "-1/2", "a/b", "1/1000001", "auto/0", "auto/"] {
            assert!(parse_shard(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn shards_partition_the_jobs_into_nearly_equal_bytes() {
        let count = 7;
        let mut shards: Vec<ShardBalance> =
            (0..count).map(|index| ShardBalance::new(Shard { index, count })).collect();
        let mut loads = vec![0_u64; count];
        let (mut state, mut largest) = (1_u64, 0);
        for _ in 0..1000 {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            // From 1 to 2^20, with small and large values equally likely.
            let bytes = 1_u64 << (state >> 59).min(20);
            largest = largest.max(bytes);
            let takers: Vec<usize> =
                (0..count).filter(|at| shards[*at].takes_group(bytes)).collect();
            assert_eq!(takers.len(), 1, "each job is in one shard");
            assert_eq!(
                loads[takers[0]],
                *loads.iter().min().unwrap(),
                "the shard with the fewest bytes takes it"
            );
            loads[takers[0]] += bytes;
        }
        let (least, most) = (loads.iter().min().unwrap(), loads.iter().max().unwrap());
        assert!(most - least <= largest, "{loads:?}");
    }

    #[test]
    fn empty_inputs_are_distributed_evenly() {
        let mut shard = ShardBalance::new(Shard { index: 1, count: 3 });
        let taken: Vec<bool> = (0..6).map(|_| shard.takes_group(0)).collect();
        assert_eq!(taken, [false, true, false, false, true, false]);
    }

    #[test]
    fn array_jobs_are_detected_by_their_variables() {
        let slurm = [
            ("SLURM_ARRAY_TASK_ID", 5),
            ("SLURM_ARRAY_TASK_MIN", 1),
            ("SLURM_ARRAY_TASK_COUNT", 8),
        ];
        assert_eq!(shard_with("auto", &slurm), Ok(Shard { index: 4, count: 8 }));
        let stepped = [&slurm[..], &[("SLURM_ARRAY_TASK_STEP", 2)]].concat();
        assert_eq!(shard_with("auto", &stepped), Ok(Shard { index: 2, count: 8 }));
        let engine = [("SGE_TASK_ID", 3), ("SGE_TASK_FIRST", 1), ("SGE_TASK_LAST", 4)];
        assert_eq!(shard_with("auto", &engine), Ok(Shard { index: 2, count: 4 }));
        let stepped = [&engine[..], &[("SGE_TASK_STEPSIZE", 2)]].concat();
        assert_eq!(shard_with("auto", &stepped), Ok(Shard { index: 1, count: 2 }));
        let aws = [("AWS_BATCH_JOB_ARRAY_INDEX", 0), ("AWS_BATCH_JOB_ARRAY_SIZE", 2)];
        assert_eq!(shard_with("auto", &aws), Ok(Shard { index: 0, count: 2 }));
        assert!(shard_with("auto", &[("SLURM_ARRAY_TASK_ID", 5)]).is_err());
        assert!(shard_with("auto", &[]).is_err_and(|fault| fault.contains("SLURM_ARRAY_TASK_ID")));
    }

    #[test]
    fn an_unknown_number_of_tasks_must_be_specified() {
        let kubernetes = [("JOB_COMPLETION_INDEX", 11)];
        assert_eq!(shard_with("auto/12", &kubernetes), Ok(Shard { index: 11, count: 12 }));
        assert!(shard_with("auto", &kubernetes).is_err_and(|fault| fault.contains("auto/N")));
        assert!(shard_with("auto/11", &kubernetes).is_err());
        let pbs = [("PBS_ARRAY_INDEX", 12)];
        assert_eq!(shard_with("auto/12", &pbs), Ok(Shard { index: 11, count: 12 }));
        assert!(shard_with("auto/12", &[("PBS_ARRAY_INDEX", 0)]).is_err());
        let cloud_run = [("CLOUD_RUN_TASK_INDEX", 1), ("CLOUD_RUN_TASK_COUNT", 2)];
        assert_eq!(shard_with("auto/2", &cloud_run), Ok(Shard { index: 1, count: 2 }));
        assert!(shard_with("auto/12", &cloud_run).is_err_and(|fault| fault.contains("2 tasks")));
    }
}
