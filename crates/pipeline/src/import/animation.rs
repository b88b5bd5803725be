//! Animations: what can be said of them without playing them.

use super::accessor::Source;
use super::error::Fault;
use super::warnings::Warnings;
use crate::model::AnimationSummary;
use gltf::json::accessor::{ComponentType, Type};

/// Summaries of all animations of a file.
pub(super) fn summaries(
    source: &Source<'_>,
    warnings: &mut Warnings,
) -> Result<Vec<AnimationSummary>, Fault> {
    let mut summaries = Vec::with_capacity(source.root.animations.len());
    for (at, json) in source.root.animations.iter().enumerate() {
        let mut duration_seconds = 0.0f64;
        for (sampler, json) in json.samplers.iter().enumerate() {
            let pointer = format!("/animations/{at}/samplers/{sampler}/input");
            match last_time(source, json.input.value(), &pointer) {
                Ok(time) => duration_seconds = duration_seconds.max(time),
                Err(fault) if fault.is_soft() => {
                    warnings.soft(&fault, "the animation's duration does not count it");
                }
                Err(fault) => return Err(fault),
            }
        }
        let channels = json.channels.len();
        summaries.push(AnimationSummary { name: json.name.clone(), channels, duration_seconds });
    }
    Ok(summaries)
}

/// The last key frame of a sampler. The times themselves are read: `max` is only what the file claims.
fn last_time(source: &Source<'_>, accessor: usize, pointer: &str) -> Result<f64, Fault> {
    let elements = source.elements(accessor, pointer)?;
    if (elements.shape, elements.component) != (Type::Scalar, ComponentType::F32) {
        return Err(Fault::invalid(pointer, "the times must be SCALAR of floats"));
    }
    let times = source.floats::<1>(&elements)?;
    let finite = times.iter().map(|&[time]| f64::from(time)).filter(|time| time.is_finite());
    Ok(finite.fold(0.0, f64::max))
}
