//! The factors of a projection by their names: what shears, what scales, what maps the depth.

use super::Step;
use super::conventions::Conventions;
use super::matrix::words;
use homog::{Clip, Projective, View};
use projection::{Classical, Decomposed, decompose};

/// Adds what the projection is, and its factors in the order in which a point passes them.
pub(super) fn describe(
    step: &mut Step,
    view_to_clip: Projective<View, Clip>,
    conventions: Conventions,
) {
    let volume = conventions.volume();
    let Ok(found) = decompose(view_to_clip.raw(), volume) else { return };
    step.formula = formula(&found.kind, conventions);
    step.add("kind", "it is", words(&found.kind));
    match found.kind {
        Decomposed::Frustum(frustum) => {
            let factors = frustum.factors(volume);
            step.add(
                "shear",
                "shear, the centre line onto the line of sight",
                factors.shear.rows(),
            );
            step.add("scale", "scale, sides to x, y = ±distance", factors.scale.rows());
            step.add("depth", "depth, and w = distance", factors.depth.rows());
        }
        Decomposed::Classical { projection: Classical::Oblique(oblique), volume: prism } => {
            let factors = oblique.factors(prism, volume);
            step.add("shear", "shear, the projectors upright", factors.shear.rows());
            step.add("fit", "fit, the box to the canonical volume", factors.fit.rows());
        }
        _ => {}
    }
}

/// The formulas behind a projection of the pipeline's, as the chapter numbers them.
pub(crate) fn formula_of(view_to_clip: Projective<View, Clip>) -> Option<&'static str> {
    let found = decompose(view_to_clip.raw(), Conventions::Alberti.volume()).ok()?;
    formula(&found.kind, Conventions::Alberti)
}

/// The formulas behind a projection in these conventions.
fn formula(kind: &Decomposed, conventions: Conventions) -> Option<&'static str> {
    let chapter = matches!(conventions, Conventions::Alberti | Conventions::Chapter);
    match kind {
        Decomposed::Frustum(_) if chapter => Some("PE-1, PE-3, VV-2"),
        Decomposed::Frustum(_) => Some("GL-1, VV-2"),
        Decomposed::Orthographic(_) if chapter => Some("OR-1"),
        Decomposed::Orthographic(_) => Some("GL-3"),
        Decomposed::Classical {
            projection: Classical::Oblique(_) | Classical::Planometric(_),
            ..
        } => Some("OB-1, VV-1"),
        Decomposed::Classical { projection: Classical::Axonometric(_), .. } => Some("AX-1"),
        Decomposed::Classical { projection: Classical::Multiview(_), .. } => {
            Some("MV-1, MV-2, MV-3")
        }
        Decomposed::NPoint(_) | Decomposed::Classical { .. } => Some("VN-1"),
        _ => None,
    }
}
