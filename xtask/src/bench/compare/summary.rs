//! The summary: the ratios of each variant, measured on one model or pooled over all models.

use super::measurement::{
    ALL_MODELS, Measurement, ProgramRuns, Series, figures_named, pairwise_ratios,
};
use super::run::PEAK_MEMORY;
use super::spread::Spread;
use super::variants::Group;

/// The measurements of a variant, on one model or on all models.
#[derive(Clone, Debug)]
pub struct VariantSummary<'a> {
    pub group: Group,
    pub name: &'a str,
    figure: &'static str,
    measurements: Vec<&'a Measurement>,
}

impl VariantSummary<'_> {
    /// Returns whether the variant has a counterpart, such as the picture without the feature.
    pub fn is_compared(&self) -> bool {
        self.measurements.iter().any(|measurement| measurement.new.off.is_some())
    }

    /// Returns the new/old ratio of a figure.
    pub fn new_over_old_of(&self, figure: &str) -> Option<Spread> {
        self.spread(|m| pairwise_ratios(&m.new.on, &m.old.on, figure))
    }

    /// Returns the new/old ratio of the variant's main figure.
    pub fn new_over_old(&self) -> Option<Spread> {
        self.new_over_old_of(self.figure)
    }

    /// Returns the new/old ratio of the peak memory.
    pub fn memory_ratio(&self) -> Option<Spread> {
        self.new_over_old_of(PEAK_MEMORY)
    }

    /// Returns the on/off ratio of the main figure in the old program.
    pub fn old_on_over_off(&self) -> Option<Spread> {
        self.spread(|measurement| self.on_over_off(&measurement.old))
    }

    /// Returns the on/off ratio of the main figure in the new program.
    pub fn new_on_over_off(&self) -> Option<Spread> {
        self.spread(|measurement| self.on_over_off(&measurement.new))
    }

    /// Returns a figure of the old and of the new program.
    pub fn figure_pair(&self, figure: &str) -> [Option<Spread>; 2] {
        [
            self.spread(|measurement| figures_named(&measurement.old.on, figure)),
            self.spread(|measurement| figures_named(&measurement.new.on, figure)),
        ]
    }

    /// Returns all figure names, in the order in which the programs print them.
    pub fn figure_names(&self) -> Vec<&str> {
        let mut names: Vec<&str> = Vec::new();
        let series = self.measurements.iter().flat_map(|m| [&m.new.on, &m.old.on]);
        for figures in series.flatten().flatten() {
            let mut after = None;
            for (name, _) in figures {
                match names.iter().position(|known| known == name) {
                    Some(at) => after = Some(at),
                    None => {
                        let at = after.map_or(0, |at| at + 1);
                        names.insert(at, name);
                        after = Some(at);
                    }
                }
            }
        }
        names
    }

    fn on_over_off(&self, runs: &ProgramRuns) -> Vec<f64> {
        let off = runs.off.as_ref();
        off.map(|off| pairwise_ratios(&runs.on, off, self.figure)).unwrap_or_default()
    }

    fn spread(&self, figures: impl Fn(&Measurement) -> Vec<f64>) -> Option<Spread> {
        Spread::from_figures(self.measurements.iter().flat_map(|m| figures(m)).collect())
    }
}

/// Returns the individual model names, in the order in which they were measured.
pub fn model_names(measurements: &[Measurement]) -> Vec<&str> {
    let mut names: Vec<&str> = Vec::new();
    for Measurement { model, .. } in measurements {
        if model != ALL_MODELS && !names.contains(&model.as_str()) {
            names.push(model);
        }
    }
    names
}

/// Summarizes the variants of a model, or of all models if `model` is `None`.
pub fn summarize<'a>(
    measurements: &'a [Measurement],
    model: Option<&str>,
) -> Vec<VariantSummary<'a>> {
    let mut summaries: Vec<VariantSummary<'a>> = Vec::new();
    let chosen = measurements.iter().filter(|m| model.is_none_or(|model| m.model == model));
    for measurement in chosen {
        let Measurement { group, name, figure, .. } = measurement;
        let known = summaries.iter_mut().find(|known| (known.group, known.name) == (*group, name));
        match known {
            Some(known) => known.measurements.push(measurement),
            None => summaries.push(VariantSummary {
                group: *group,
                name,
                figure,
                measurements: vec![measurement],
            }),
        }
    }
    summaries
}

/// Lists the refused calls, each with program, model, variant and reason. If a variant is refused
/// for the same reason with several models, only the first model is listed.
pub fn refusals(measurements: &[Measurement]) -> Vec<String> {
    let mut seen: Vec<(&str, &str, &str)> = Vec::new();
    let mut lines = Vec::new();
    for measurement in measurements {
        for (program, runs) in [("old", &measurement.old), ("new", &measurement.new)] {
            let series: Vec<&Series> = [&runs.on].into_iter().chain(&runs.off).collect();
            for reason in series.into_iter().filter_map(|series| series.as_ref().err()) {
                let key = (program, measurement.name.as_str(), reason.as_str());
                if !seen.contains(&key) {
                    seen.push(key);
                    lines.push(format!(
                        "{program}: {}, {}: {reason}",
                        measurement.model, measurement.name
                    ));
                }
            }
        }
    }
    lines
}

#[cfg(test)]
pub mod tests {
    use super::*;

    /// Returns sample measurements of two models: a setting, and a style with two rounds that the
    /// old program refuses for one model.
    pub fn sample() -> Vec<Measurement> {
        let series = |all: [f64; 2]| -> Series {
            let figures = |ms: f64| {
                vec![
                    ("pixels".into(), ms),
                    ("drawing".into(), ms),
                    ("peak memory".into(), 10.0 * ms),
                ]
            };
            Ok(all.into_iter().map(figures).collect())
        };
        let runs = |on: Series, off: Option<Series>| ProgramRuns { on, off };
        let setting = |model: &str, old, new| Measurement {
            model: model.into(),
            group: Group::Settings,
            name: "1 sample".into(),
            figure: "drawing",
            old: runs(series(old), None),
            new: runs(series(new), None),
        };
        let style = |name: &str, old| Measurement {
            model: "a".into(),
            group: Group::Styles,
            name: name.into(),
            figure: "drawing",
            old: runs(old, Some(series([2.0, 2.0]))),
            new: runs(series([4.0, 4.0]), Some(series([2.0, 1.0]))),
        };
        vec![
            setting("a", [2.0, 2.0], [1.0, 3.0]),
            style("clay", series([4.0, 8.0])),
            style("<toon>", Err("error: no such style".into())),
            setting("b", [1.0, 1.0], [2.0, 2.0]),
        ]
    }

    #[test]
    fn ratios_of_all_models_are_pooled() {
        let sample = sample();
        let of_a = &summarize(&sample, Some("a"))[0];
        let of_all = &summarize(&sample, None)[0];
        assert_eq!(of_a.new_over_old(), Some(Spread { min: 0.5, median: 1.0, max: 1.5 }));
        assert_eq!(of_all.new_over_old(), Some(Spread { min: 0.5, median: 1.75, max: 2.0 }));
        assert_eq!(of_all.memory_ratio(), of_all.new_over_old());
        assert_eq!(of_all.figure_names(), ["pixels", "drawing", "peak memory"]);
        assert_eq!(model_names(&sample), ["a", "b"]);
    }

    #[test]
    fn features_are_compared_within_each_program() {
        let sample = sample();
        let summaries = summarize(&sample, Some("a"));
        let clay = &summaries[1];
        assert_eq!(clay.old_on_over_off(), Some(Spread { min: 2.0, median: 3.0, max: 4.0 }));
        assert_eq!(clay.new_on_over_off(), Some(Spread { min: 2.0, median: 3.0, max: 4.0 }));
        assert_eq!(clay.new_over_old(), Some(Spread { min: 0.5, median: 0.75, max: 1.0 }));
    }

    #[test]
    fn refused_variants_have_a_reason_instead_of_a_ratio() {
        let sample = sample();
        let summaries = summarize(&sample, Some("a"));
        let toon = &summaries[2];
        assert_eq!((toon.new_over_old(), toon.old_on_over_off()), (None, None));
        assert!(toon.new_on_over_off().is_some());
        assert_eq!(refusals(&sample), ["old: a, <toon>: error: no such style"]);
    }
}
