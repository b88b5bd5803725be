//! `cargo xtask simulate-farm`: simulates how long `alberti batch` takes on many cores.
//!
//! ```text
//!  picture times ─► shards ─► nodes of 16 cores, some of which fail ─► time, pictures per second
//! ```
//! The times come from a measured run or from a named report. Shards wait for a free node in order,
//! as in an array job. If a node fails, its shard returns to the queue after the scheduler's
//! timeouts. Every run uses the same random numbers and therefore prints the same tables, which
//! `docs/batch.md` contains.

mod picture_times;

use crate::Outcome;
use crate::workspace::read_text;
use picture_times::PictureTimes;
use std::cmp::Reverse;
use std::collections::{BinaryHeap, VecDeque};
use std::path::Path;

/// Milliseconds, the unit of all times. They are integers, because integer sums do not depend on
/// the order of summation.
type Milliseconds = u64;

/// The cores per node.
const CORES: usize = 16;
/// The time from the submission of a shard to its first picture: starting the job and the program,
/// and reading the list.
const START: Milliseconds = 2_000;
/// The time from the failure of a node to the restart of its shard, with Slurm's defaults: 300 s
/// until the node counts as down, and 120 s until a job restarts.
const LOSS: Milliseconds = 420_000;
/// The number of file system calls that read a picture's model, as counted with strace. The model
/// is looked up, opened and closed three times: to compute its key, to load it and to check it.
const REQUESTS_TO_READ: u64 = 9;
/// The number of file system calls that write a file, such as create, sync, close and rename.
const REQUESTS_TO_WRITE: u64 = 6;
/// Pictures per tar file.
const TAR: u64 = 1_000;

/// A render farm and its work.
#[derive(Clone, Copy)]
struct Farm {
    nodes: usize,
    shards: usize,
    pictures: usize,
    /// The time of a picture, as a multiple of the measured time.
    slowness: f64,
    /// The mean time between failures of a node, in hours; 0 means that nodes do not fail.
    hours_to_death: u64,
    /// Whether a shard resumes after a failure instead of starting over.
    continues: bool,
}

/// The default farm; each table varies some of its values.
const FARM: Farm = Farm {
    nodes: 64,
    shards: 256,
    pictures: 10_000_000,
    slowness: 1.0,
    hours_to_death: 0,
    continues: true,
};

/// Prints the tables, computed from the times in a report or from the measured times.
pub fn run_simulation(arguments: &[String]) -> Outcome {
    let times = match arguments {
        [] => PictureTimes::measured(),
        [report] => PictureTimes::from_report(&read_text(Path::new(report))?)?,
        _ => return Err("the only argument is a report of `alberti batch`".to_owned()),
    };
    println!("{}", tables(&times));
    Ok(())
}

/// Returns the three tables as Markdown.
fn tables(times: &PictureTimes) -> String {
    let rate = 1000.0 / times.mean();
    format!(
        "One core renders {rate:.0} pictures per second\n\n{}\n{}\n{}",
        scaling_table(times),
        death_table(times),
        request_table(rate)
    )
}

/// Returns a table of the time by node count and shard count.
fn scaling_table(times: &PictureTimes) -> String {
    let mut text = "| nodes | cores | shards | time | pictures per second | cores in use |\n\
                    | ---: | ---: | ---: | ---: | ---: | ---: |\n"
        .to_owned();
    for (nodes, shards) in [(1, 1), (4, 16), (16, 64), (64, 64), (64, 256), (64, 1024), (64, 4096)]
    {
        let time = Farm { nodes, shards, ..FARM }.run(times);
        let work = FARM.pictures as f64 * times.mean();
        let share = work / (time as f64 * (nodes * CORES) as f64) * 100.0;
        let rate = FARM.pictures as u64 * 1000 / time.max(1);
        let (cores, time) = (nodes * CORES, time / 1000);
        text += &format!("| {nodes} | {cores} | {shards} | {time} s | {rate} | {share:.0} % |\n");
    }
    text
}

/// Returns a table of the cost of node failures.
fn death_table(times: &PictureTimes) -> String {
    let mut text = "| each node fails every | time | time if shards start over |\n\
                    | ---: | ---: | ---: |\n"
        .to_owned();
    for hours in [0, 100, 10, 2] {
        let farm = Farm { hours_to_death: hours, slowness: 20.0, ..FARM };
        let minutes = |farm: Farm| farm.run(times) / 60_000;
        let (time, anew) = (minutes(farm), minutes(Farm { continues: false, ..farm }));
        let name = if hours == 0 { "never".to_owned() } else { format!("{hours} h") };
        text += &format!("| {name} | {time} min | {anew} min |\n");
    }
    text
}

/// Returns a table of file system requests per second.
fn request_table(rate: f64) -> String {
    let mut text =
        "| cores | one file per picture | `--tar 1000` |\n| ---: | ---: | ---: |\n".to_owned();
    for cores in [16, 64, 256, 1024] {
        let pictures = (rate * f64::from(cores)) as u64;
        let files = pictures * (REQUESTS_TO_READ + REQUESTS_TO_WRITE);
        let tar = pictures * REQUESTS_TO_READ + pictures * REQUESTS_TO_WRITE / TAR;
        text += &format!("| {cores} | {files} | {tar} |\n");
    }
    text
}

impl Farm {
    /// Returns the time until the last picture is rendered.
    fn run(&self, times: &PictureTimes) -> Milliseconds {
        let mut random = Random(1);
        let mut waiting: VecDeque<Milliseconds> = self.shard_times(times, &mut random).into();
        // The times at which nodes become free, and at which shards return to the queue with their
        // remaining work, earliest first.
        let mut free: BinaryHeap<Reverse<Milliseconds>> =
            (0..self.nodes).map(|_| Reverse(0)).collect();
        let mut back: BinaryHeap<Reverse<(Milliseconds, Milliseconds)>> = BinaryHeap::new();
        let mut end = 0;
        while let Some(Reverse(now)) = free.pop() {
            let is_back = back.peek().is_some_and(|Reverse((at, _))| *at <= now);
            let shard = if is_back || waiting.is_empty() {
                back.pop().map(|Reverse(shard)| shard)
            } else {
                waiting.pop_front().map(|left| (0, left))
            };
            let Some((since, left)) = shard else { break };
            let start = now.max(since);
            let (death, stop) = (start + self.time_to_death(&mut random), start + START + left);
            if death < stop {
                let drawn = if self.continues { death.saturating_sub(start + START) } else { 0 };
                back.push(Reverse((death + LOSS, left - drawn)));
                // The node is repaired or replaced.
                free.push(Reverse(death + LOSS));
            } else {
                end = end.max(stop);
                free.push(Reverse(stop));
            }
        }
        end
    }

    /// Returns the time for which each shard occupies a node. An upper bound is used: the work
    /// divided by the number of cores, plus the longest picture (Graham 1969).
    fn shard_times(&self, times: &PictureTimes, random: &mut Random) -> Vec<Milliseconds> {
        let mut shards = vec![(0.0_f64, 0.0_f64); self.shards];
        for picture in 0..self.pictures {
            let time = times.time_at(random.next_fraction()) * self.slowness;
            // Pictures are assigned in turn. The program assigns them by file size, which balances
            // the shards better.
            let (sum, longest) = &mut shards[picture % self.shards];
            *sum += time;
            *longest = longest.max(time);
        }
        let cores = CORES as f64;
        let time = |(sum, longest): (f64, f64)| sum / cores + longest * (1.0 - 1.0 / cores);
        shards.into_iter().map(|shard| time(shard) as Milliseconds).collect()
    }

    /// Returns the time until a node fails, which is exponentially distributed.
    fn time_to_death(&self, random: &mut Random) -> Milliseconds {
        if self.hours_to_death == 0 {
            // Longer than any run, but small enough to add without overflow.
            return Milliseconds::MAX / 4;
        }
        let mean = self.hours_to_death as f64 * 3_600_000.0;
        (-libm::log(1.0 - random.next_fraction()) * mean) as Milliseconds
    }
}

/// A random number generator: SplitMix64.
struct Random(u64);

impl Random {
    /// Returns a number that is at least 0 and less than 1.
    fn next_fraction(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut bits = self.0;
        bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((bits ^ (bits >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn constant(time: f64) -> PictureTimes {
        PictureTimes::of(&[time]).expect("times")
    }

    #[test]
    fn equal_pictures_take_the_expected_time() {
        let farm = Farm { nodes: 10, shards: 40, pictures: 64_000, ..FARM };
        // Four shards per node, each with 100 pictures per core at 48 ms, plus the longest picture.
        assert_eq!(farm.run(&constant(48.0)), 4 * (START + 100 * 48 + 45));
        let uneven = Farm { shards: 11, ..farm };
        assert!(uneven.run(&constant(48.0)) >= 2 * (START + 363 * 48), "a node has two shards");
    }

    #[test]
    fn failures_cost_timeouts_and_more_if_shards_start_over() {
        let times = constant(100.0);
        let farm = |hours| Farm {
            nodes: 4,
            shards: 8,
            pictures: 8_000_000,
            hours_to_death: hours,
            ..FARM
        };
        let (never, often) = (farm(0).run(&times), farm(1).run(&times));
        let anew = Farm { continues: false, ..farm(1) }.run(&times);
        // Two shards occupy a node for seven hours. A node fails every hour and then waits for
        // seven minutes.
        assert!(never < often && often < never * 3 / 2, "{never} {often}");
        assert!(anew > often * 2, "{often} {anew}");
    }

    #[test]
    fn the_page_contains_the_tables() {
        let page =
            read_text(&crate::workspace::project_root().join("docs/batch.md")).expect("the page");
        for line in tables(&PictureTimes::measured()).lines().filter(|line| !line.is_empty()) {
            assert!(page.contains(line), "docs/batch.md lacks: {line}");
        }
    }
}
