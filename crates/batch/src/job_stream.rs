//! The stream of this shard's jobs: first the jobs from inputs and folders, then the jobs from a
//! list.

use super::flag_table::FlagTable;
use super::inputs::find_jobs;
use super::job::JobGroup;
use super::job_list::JobList;
use super::picture_name::PictureName;
use super::shard::{Shard, ShardBalance};
use crate::BatchError;
use std::path::{Path, PathBuf};

/// The sources of a run's jobs.
pub(super) struct JobSource<'a> {
    /// Files, folders and lists of names.
    pub(super) inputs: &'a [PathBuf],
    /// The job list from `--list`.
    pub(super) list: Option<&'a Path>,
    /// The scene from `--scene`.
    pub(super) scene: Option<&'a Path>,
    /// The template from `--name`.
    pub(super) picture_name: Option<&'a PictureName>,
    /// The flags that list lines may set.
    pub(super) flags: &'a FlagTable,
}

/// The groups of jobs of one shard, in order.
///
/// A list is read line by line, so memory use does not grow with its length.
pub(super) struct JobStream {
    /// The jobs of the remaining inputs.
    inputs: std::vec::IntoIter<JobGroup>,
    input_count: usize,
    /// The list, which follows the inputs.
    list: Option<JobList>,
    /// The shard; `None` for all jobs.
    balance: Option<ShardBalance>,
    /// The last measured input, and its size.
    measured: Option<(PathBuf, u64)>,
}

impl JobStream {
    /// Finds the inputs and opens the list.
    ///
    /// # Errors
    /// Returns an error if a folder or the list cannot be read.
    pub(super) fn open(source: &JobSource<'_>, shard: Shard) -> Result<Self, BatchError> {
        let (scene, name) = (source.scene, source.picture_name);
        let inputs = find_jobs(source.inputs, scene, name)?;
        let open = |path: &Path| {
            JobList::open(path, scene.map(Path::to_owned), name.cloned(), source.flags)
        };
        let balance = (!shard.has_all_jobs()).then(|| ShardBalance::new(shard));
        Ok(Self {
            input_count: inputs.len(),
            inputs: inputs.into_iter(),
            list: source.list.map(open).transpose()?,
            balance,
            measured: None,
        })
    }

    /// Returns the fraction of the inputs or the list read so far, or `None` for a list of unknown
    /// length.
    pub(super) fn fraction(&self) -> Option<f64> {
        if let Some(list) = &self.list {
            return list.fraction();
        }
        let (left, all) = (self.inputs.len(), self.input_count);
        Some(if all == 0 { 1.0 } else { (all - left) as f64 / all as f64 })
    }

    /// Returns the size of a group's input, for balancing the shards, or 0 if it does not exist.
    fn measure(&mut self, group: &JobGroup) -> u64 {
        let Some(job) = group.jobs.first() else { return 0 };
        if let Some(bytes) = group.bytes {
            return bytes;
        }
        if let Some((_, bytes)) = self.measured.as_ref().filter(|(path, _)| *path == job.input) {
            return *bytes;
        }
        let bytes = job.input.metadata().map_or(0, |file| file.len());
        self.measured = Some((job.input.clone(), bytes));
        bytes
    }

    /// Returns whether a group belongs to this shard.
    fn takes_group(&mut self, group: &JobGroup) -> bool {
        if self.balance.is_none() {
            return true;
        }
        let bytes = self.measure(group);
        self.balance.as_mut().is_none_or(|balance| balance.takes_group(bytes))
    }
}

impl Iterator for JobStream {
    type Item = Result<JobGroup, BatchError>;

    fn next(&mut self) -> Option<Self::Item> {
        loop {
            let next = self.inputs.next().map(Ok);
            match next.or_else(|| self.list.as_mut()?.next())? {
                Ok(group) if self.takes_group(&group) => return Some(Ok(group)),
                Ok(_) => {}
                Err(error) => return Some(Err(error)),
            }
        }
    }
}
