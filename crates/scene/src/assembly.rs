//! Resolves the assembly pages of a sheet: exploded view, balloons, parts list and masses.

use super::Origin;
use model::ModelInstance;
use scene_file::PathStep::{Field, Index};
use scene_file::file::SheetFile;
use scene_file::{SceneError, suggest_name};
use sheet::{AssemblyPages, ExplosionSettings, PartDensity, PartsList};

/// Resolves the pages of a sheet that show models as an assembly.
///
/// # Errors
/// Returns an error if a density names a part or material that does not exist.
pub(super) fn resolve_assembly(
    origin: &Origin,
    file: &SheetFile,
    models: &[ModelInstance],
) -> Result<AssemblyPages, SceneError> {
    check_density_names(origin, file, models)?;
    let density = |density: &scene_file::file::DensityFile| PartDensity {
        of: density.of.clone(),
        grams_per_cubic_centimeter: density.density.value(),
    };
    Ok(AssemblyPages {
        parts_list: file.parts_list,
        balloons: file.balloons,
        explosion: file.exploded.as_ref().map(|exploded| ExplosionSettings {
            axis: exploded.axis,
            distance: exploded.distance.map(scene_file::file::NonNegative::value),
        }),
        part_sheets: file.part_sheets,
        densities: file.densities.iter().map(density).collect(),
    })
}

/// Checks that every name with a density is in the parts list.
fn check_density_names(
    origin: &Origin,
    file: &SheetFile,
    models: &[ModelInstance],
) -> Result<(), SceneError> {
    // Without models, a scene file is checked only for mistakes that do not depend on them.
    if models.is_empty() || file.densities.iter().all(|density| density.of == "*") {
        return Ok(());
    }
    // Neither the densities nor the unit affect the names, so the list is made without them.
    let list = PartsList::new(models, &[], 1.0);
    let mut names: Vec<&str> = Vec::new();
    for item in &list.items {
        names.push(&item.name);
        // A density may apply to a part or to a material; a part without a material has an empty
        // name.
        names.extend(Some(item.material.as_str()).filter(|material| !material.is_empty()));
    }
    names.sort_unstable();
    names.dedup();
    for (at, density) in file.densities.iter().enumerate() {
        if density.of != "*" && names.binary_search(&density.of.as_str()).is_err() {
            let path = [Field("sheet"), Field("densities"), Index(at), Field("of")];
            let message = format!("there is no part or material named `{}`", density.of);
            let help = suggest_name(&density.of, &names);
            return Err(origin.error_at(&path, message, help));
        }
    }
    Ok(())
}
