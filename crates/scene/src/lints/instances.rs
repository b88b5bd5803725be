//! Lint for instances at the same position, where one hides the others.

use super::{Lint, Linter};
use scene_file::PathStep::{Field, Index};
use scene_file::file::InstancesFile;

/// Warns about instances of a model with the same transform, as in a grid with a step of 0.
///
/// Sorting makes equal transforms neighbors, in O(n log n) for n instances.
pub(super) fn lint_coincident_instances(adviser: &Linter<'_>) -> Vec<Lint> {
    let mut first = 0;
    let mut advice = Vec::new();
    for (number, entry) in adviser.file.models.iter().enumerate() {
        let end = (first + entry.instance_count()).min(adviser.scene.models.len());
        let placed = &adviser.scene.models[first..end];
        first = end;
        let mut transforms: Vec<[u64; 16]> = placed
            .iter()
            // Adding 0 turns negative zeros into positive ones.
            .map(|one| {
                one.model_to_world.raw().to_cols_array().map(|entry| (entry + 0.0).to_bits())
            })
            .collect();
        let count = transforms.len();
        transforms.sort_unstable();
        transforms.dedup();
        if transforms.len() == count {
            continue;
        }
        let others = count - transforms.len();
        let message = format!("{others} of {count} instances coincide with another instance");
        let path = [Field("models"), Index(number), Field("instances"), Field("step")];
        let (path, help) = match &entry.instances {
            Some(InstancesFile::Grid { .. }) => {
                (&path[..], "set a nonzero `step` along each axis whose count is more than 1")
            }
            Some(InstancesFile::Circle { .. }) => {
                (&path[..3], "increase `radius`, and set `sweep_degrees` to less than a full turn")
            }
            _ => (&path[..3], "set a different `translation` for each, or remove the duplicates"),
        };
        let error = adviser.origin.error_at(path, message, Some(help.to_owned()));
        advice.push(Lint { code: "coincident-instances", error });
    }
    advice
}
