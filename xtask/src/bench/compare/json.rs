//! The report as JSON: the machine and every figure of every run.

use super::machine::Machine;
use super::measurement::{Measurement, ProgramRuns, Series};
use super::run::Figures;
use serde_json::{Map, Value, json};

/// Returns the document. Times are in milliseconds and memory in MiB. A series is a list of rounds,
/// or an object with the reason why the program refused the call.
pub fn to_json(machine: &Machine, measurements: &[Measurement]) -> Value {
    let rows: Vec<Value> = measurements.iter().map(measurement_json).collect();
    json!({
        "machine": machine.to_json(),
        "units": { "times": "ms", "peak memory": "MiB" },
        "measurements": rows,
    })
}

fn measurement_json(measurement: &Measurement) -> Value {
    let Measurement { model, group, name, figure, old, new } = measurement;
    json!({
        "model": model, "group": group.title(), "variant": name, "compared": figure,
        "old": program_json(old), "new": program_json(new),
    })
}

fn program_json(runs: &ProgramRuns) -> Value {
    json!({ "on": series_json(&runs.on), "off": runs.off.as_ref().map(series_json) })
}

fn series_json(series: &Series) -> Value {
    match series {
        Ok(rounds) => rounds.iter().map(figures_json).collect(),
        Err(reason) => json!({ "refused": reason }),
    }
}

fn figures_json(figures: &Figures) -> Value {
    let entries = figures.iter().map(|(name, value)| (name.clone(), json!(value)));
    Value::Object(entries.collect::<Map<String, Value>>())
}

#[cfg(test)]
mod tests {
    use super::super::machine::tests::machine;
    use super::super::summary::tests::sample;
    use super::*;

    #[test]
    fn all_rounds_and_reasons_are_included() {
        let json = to_json(&machine(), &sample());
        let rows = &json["measurements"];
        assert_eq!(rows[0]["new"]["on"][1]["pixels"], 3.0);
        assert_eq!(rows[0]["new"]["off"], Value::Null);
        assert_eq!(rows[1]["old"]["off"][0]["drawing"], 2.0);
        assert_eq!(rows[2]["old"]["on"]["refused"], "error: no such style");
        assert_eq!(json["machine"]["cores"], 4);
    }
}
