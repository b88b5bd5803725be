//! Rounds of runs. In each round, every call of a variant runs once with each program, the old one
//! first.

use super::models::BenchModel;
use super::patched_model::{Addition, Bounds, write_patched_model};
use super::run::{Figures, TimedProgram, find_gnu_time};
use super::show_progress;
use super::variants::{Group, Variant, batch_variant, model_variants};
use crate::program::capture_output;
use crate::skip::report_skip;
use crate::workspace::create_folder;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The model name of a measurement over all models.
pub const ALL_MODELS: &str = "all models";

/// Times in milliseconds below this are not compared, because the program prints only two decimals.
const LEAST_COMPARED: f64 = 0.1;

/// The rounds of a call by one program, or the reason why it refused the call.
pub type Series = Result<Vec<Figures>, String>;

/// The rounds of one program.
#[derive(Clone, PartialEq, Debug)]
pub struct ProgramRuns {
    /// With the feature.
    pub on: Series,
    /// Without the feature; `None` if there is nothing to compare with.
    pub off: Option<Series>,
}

/// The runs of one variant of a model by both programs.
#[derive(Clone, PartialEq, Debug)]
pub struct Measurement {
    /// The model, or `all models`.
    pub model: String,
    pub group: Group,
    /// The name of the variant.
    pub name: String,
    /// The figure to compare if only one is shown.
    pub figure: &'static str,
    pub old: ProgramRuns,
    pub new: ProgramRuns,
}

/// Returns the ratio of a figure in each round, skipping rounds in which it is missing or too
/// small.
pub fn pairwise_ratios(numerator: &Series, denominator: &Series, figure: &str) -> Vec<f64> {
    let (Ok(numerator), Ok(denominator)) = (numerator, denominator) else { return Vec::new() };
    let pairs = numerator.iter().zip(denominator).filter_map(|(above, below)| {
        let (above, below) = (figure_in(above, figure)?, figure_in(below, figure)?);
        (above.max(below) >= LEAST_COMPARED && below > 0.0).then(|| above / below)
    });
    pairs.collect()
}

/// Returns a figure from each round.
pub fn figures_named(series: &Series, figure: &str) -> Vec<f64> {
    let runs = series.as_deref().unwrap_or_default();
    runs.iter().filter_map(|figures| figure_in(figures, figure)).collect()
}

fn figure_in(figures: &Figures, figure: &str) -> Option<f64> {
    figures.iter().find(|(name, _)| name == figure).map(|(_, value)| *value)
}

/// Both programs, the old one first, and the number of runs.
#[derive(Debug)]
pub struct Measurer {
    programs: [TimedProgram; 2],
    /// The path of the new program.
    path: PathBuf,
    folder: PathBuf,
    runs: usize,
}

impl Measurer {
    /// Creates a measurer from the paths of the old and the new program. Pictures and changed
    /// models are written to `folder`.
    pub fn new(paths: [&Path; 2], folder: &Path, runs: usize) -> Self {
        let gnu_time = find_gnu_time();
        if gnu_time.is_none() {
            report_skip("CPU time and peak memory", "GNU time is not installed");
        }
        let programs = paths.map(|path| TimedProgram::new(path, folder, gnu_time.clone()));
        Self { programs, path: paths[1].to_owned(), folder: folder.to_owned(), runs }
    }

    /// Measures every variant of every model, and a batch of all models.
    pub fn measure_all(
        &self,
        models: &[BenchModel],
        frames: usize,
    ) -> Result<Vec<Measurement>, String> {
        create_folder(&self.folder)?;
        let mut measurements = Vec::new();
        for (index, model) in models.iter().enumerate() {
            show_progress("");
            let patch = |addition| self.patch_model(model, addition);
            let variants = model_variants(model, frames, &patch);
            for (at, variant) in variants.iter().enumerate() {
                let (model, name) = (&model.name, &variant.name);
                show_progress(&format!(
                    "model {} of {}, variant {} of {}: {model}, {name}",
                    index + 1,
                    models.len(),
                    at + 1,
                    variants.len()
                ));
                measurements.push(self.measure(model, variant));
            }
        }
        show_progress("all models: batch");
        measurements.push(self.measure(ALL_MODELS, &batch_variant(models)));
        Ok(measurements)
    }

    fn measure(&self, model: &str, variant: &Variant) -> Measurement {
        let calls: Vec<_> = variant.off.iter().chain([&variant.on]).collect();
        let turns = calls.iter().flat_map(|call| {
            self.programs.iter().map(|program| (program, program.adapt_call(call)))
        });
        let turns: Vec<(&TimedProgram, Vec<String>)> = turns.collect();
        let mut series: Vec<Series> = vec![Ok(Vec::new()); turns.len()];
        // Settings come first for each model, when the model's files may not be cached yet.
        let warm_up = usize::from(variant.group == Group::Settings);
        for round in 0..self.runs + warm_up {
            for ((program, arguments), series) in turns.iter().zip(&mut series) {
                let Ok(rounds) = series else { continue };
                match program.run(arguments) {
                    Ok(_) if round < warm_up => {}
                    Ok(figures) => rounds.push(figures),
                    Err(reason) => *series = Err(reason),
                }
            }
        }
        let mut series = series.into_iter();
        let mut take_pair =
            || (series.next().unwrap_or(Ok(vec![])), series.next().unwrap_or(Ok(vec![])));
        let off = variant.off.is_some().then(&mut take_pair);
        let (old, new) = take_pair();
        let (old_off, new_off) = off.unzip();
        Measurement {
            model: model.to_owned(),
            group: variant.group,
            name: variant.name.clone(),
            figure: variant.figure,
            old: ProgramRuns { on: old, off: old_off },
            new: ProgramRuns { on: new, off: new_off },
        }
    }

    fn patch_model(&self, model: &BenchModel, addition: Addition) -> Result<PathBuf, String> {
        let info =
            capture_output(Command::new(&self.path).args(["info", "--json"]).arg(&model.path))?;
        let folder = self.folder.join("models").join(&model.name);
        write_patched_model(&model.path, addition, &Bounds::from_info(&info)?, &folder)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn series(rounds: &[f64]) -> Series {
        Ok(rounds.iter().map(|ms| vec![("all".to_owned(), *ms)]).collect())
    }

    #[test]
    fn ratios_are_computed_within_a_round() {
        let (new, old) = (series(&[1.0, 4.0, 9.0]), series(&[2.0, 2.0]));
        assert_eq!(pairwise_ratios(&new, &old, "all"), [0.5, 2.0]);
        assert!(pairwise_ratios(&new, &old, "pixels").is_empty());
        assert!(pairwise_ratios(&new, &Err("refused".into()), "all").is_empty());
    }

    #[test]
    fn times_too_short_for_two_decimals_are_not_compared() {
        assert!(pairwise_ratios(&series(&[0.02]), &series(&[0.01]), "all").is_empty());
        assert!(pairwise_ratios(&series(&[3.0]), &series(&[0.0]), "all").is_empty());
        assert_eq!(pairwise_ratios(&series(&[3.0]), &series(&[0.05]), "all"), [3.0 / 0.05]);
    }
}
