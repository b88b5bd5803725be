//! Shards: a part of the jobs for each of several machines.

use std::str::FromStr as _;

/// Part `part` of `parts`, counted from 0.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) struct Shard {
    part: usize,
    parts: usize,
}

impl Shard {
    /// All jobs.
    pub(super) const WHOLE: Self = Self { part: 0, parts: 1 };

    pub(super) fn is_whole(self) -> bool {
        self.parts == 1
    }

    /// Whether the job with this number is in the shard: every `parts`-th is, so that large models, which often lie
    /// together, are shared out.
    pub(super) fn has(self, job: usize) -> bool {
        job % self.parts == self.part
    }

    /// The end of the report's name.
    pub(super) fn suffix(self) -> String {
        if self.is_whole() {
            String::new()
        } else {
            format!("-{}-of-{}", self.part + 1, self.parts)
        }
    }

    fn new(part: usize, parts: usize) -> Option<Self> {
        (part < parts).then_some(Self { part, parts })
    }
}

/// `I/N`, or `auto` for what the variables of an array job say.
pub(super) fn parse(text: &str) -> Result<Shard, String> {
    if text == "auto" {
        return of_variables(|name| std::env::var(name).ok().as_deref().and_then(number));
    }
    let fault = || "expected I/N with I from 1 to N, such as 2/8, or auto".to_owned();
    let (part, parts) = text.split_once('/').ok_or_else(fault)?;
    let (part, parts) = (number(part).ok_or_else(fault)?, number(parts).ok_or_else(fault)?);
    part.checked_sub(1).and_then(|part| Shard::new(part, parts)).ok_or_else(fault)
}

fn number(digits: &str) -> Option<usize> {
    usize::from_str(digits.trim()).ok()
}

/// The variables in which schedulers tell the number of a task: its own, the least (a name or a number) and how many
/// there are, or the greatest.
const SCHEDULERS: &[(&str, Least, Count)] = &[
    (
        "SLURM_ARRAY_TASK_ID",
        Least::Variable("SLURM_ARRAY_TASK_MIN"),
        Count::Variable("SLURM_ARRAY_TASK_COUNT"),
    ),
    ("AWS_BATCH_JOB_ARRAY_INDEX", Least::Is(0), Count::Variable("AWS_BATCH_JOB_ARRAY_SIZE")),
    ("CLOUD_RUN_TASK_INDEX", Least::Is(0), Count::Variable("CLOUD_RUN_TASK_COUNT")),
    ("BATCH_TASK_INDEX", Least::Is(0), Count::Variable("BATCH_TASK_COUNT")),
    ("SGE_TASK_ID", Least::Variable("SGE_TASK_FIRST"), Count::Last("SGE_TASK_LAST")),
    ("LSB_JOBINDEX", Least::Is(1), Count::Last("LSB_JOBINDEX_END")),
    ("BUILDKITE_PARALLEL_JOB", Least::Is(0), Count::Variable("BUILDKITE_PARALLEL_JOB_COUNT")),
    ("CI_NODE_INDEX", Least::Is(1), Count::Variable("CI_NODE_TOTAL")),
];

enum Least {
    Is(usize),
    Variable(&'static str),
}

enum Count {
    Variable(&'static str),
    Last(&'static str),
}

/// The shard of the first scheduler that speaks.
fn of_variables(variable: impl Fn(&str) -> Option<usize>) -> Result<Shard, String> {
    for (own, least, count) in SCHEDULERS {
        let Some(own) = variable(own) else { continue };
        let least = match least {
            Least::Is(least) => Some(*least),
            Least::Variable(name) => variable(name),
        };
        let least = least.unwrap_or(0);
        let parts = match count {
            Count::Variable(name) => variable(name),
            Count::Last(name) => variable(name).and_then(|last| (last + 1).checked_sub(least)),
        };
        if let Some(shard) = own.checked_sub(least).and_then(|part| Shard::new(part, parts?)) {
            return Ok(shard);
        }
    }
    let names: Vec<&str> = SCHEDULERS.iter().map(|(own, ..)| *own).collect();
    Err(format!(
        "no array job is known by its variables: {}, each with its count",
        names.join(", ")
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shards_are_counted_from_one_and_are_a_partition() {
        assert_eq!(parse("2/8"), Ok(Shard { part: 1, parts: 8 }));
        for wrong in ["", "2", "0/3", "4/3", "1/0", "-1/2", "a/b"] {
            assert!(parse(wrong).is_err(), "{wrong}");
        }
        for job in 0..20 {
            let of = (1..=3).filter(|part| parse(&format!("{part}/3")).is_ok_and(|s| s.has(job)));
            assert_eq!(of.count(), 1, "{job}");
        }
    }

    #[test]
    fn array_jobs_are_known_by_their_variables() {
        let known = |set: &'static [(&str, usize)]| {
            of_variables(move |name| {
                set.iter().find(|(known, _)| *known == name).map(|(_, value)| *value)
            })
        };
        let slurm = &[
            ("SLURM_ARRAY_TASK_ID", 5),
            ("SLURM_ARRAY_TASK_MIN", 1),
            ("SLURM_ARRAY_TASK_COUNT", 8),
        ];
        assert_eq!(known(slurm), Ok(Shard { part: 4, parts: 8 }));
        let engine = &[("SGE_TASK_ID", 3), ("SGE_TASK_FIRST", 1), ("SGE_TASK_LAST", 4)];
        assert_eq!(known(engine), Ok(Shard { part: 2, parts: 4 }));
        let aws = &[("AWS_BATCH_JOB_ARRAY_INDEX", 0), ("AWS_BATCH_JOB_ARRAY_SIZE", 2)];
        assert_eq!(known(aws), Ok(Shard { part: 0, parts: 2 }));
        assert!(known(&[("SLURM_ARRAY_TASK_ID", 5)]).is_err());
        assert!(known(&[]).is_err());
    }
}
