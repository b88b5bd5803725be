//! Factors a projection matrix into shear, scale and depth mapping, with formula ids.
//!
//! ```text
//!  perspective = depth · scale · shear   (frustum centered, sides to 45°, depth to clip space)
//!  oblique     = fit · shear             (shear the projectors, then fit the box to the canonical volume)
//! ```

use super::Step;
use super::chapter_matrices::ChapterMatrices;
use super::conventions::ApiConventions;
use super::plain_text::format_number;
use homog::{Clip, Projective, View};
use projection::{Classical, Decomposed, decompose};

/// Adds the kind of a projection, and its factors in the order in which they apply to a point.
///
/// The product of the factors equals the projection matrix up to rounding. A projection that cannot
/// be decomposed adds nothing. A projection without a textbook factorization adds only its kind.
///
/// The shear of a frustum moves the center of the window onto the axis, x' = x + z (l + r)/(2n);
/// for a symmetric frustum it is the identity. The shear of an oblique projection makes its
/// projectors parallel to the axis.
pub(super) fn add_projection_factors(
    step: &mut Step,
    view_to_clip: Projective<View, Clip>,
    conventions: ApiConventions,
) {
    let volume = conventions.canonical_volume();
    let Ok(decomposition) = decompose(view_to_clip, volume) else { return };
    step.formula = formula_ids_of_kind(&decomposition.kind, conventions);
    step.add_item("kind", "it is", describe_projection(&decomposition.kind));
    let on_the_page =
        conventions.is_textbook().then(|| ChapterMatrices::from_projection(view_to_clip));
    if let Some(matrices) = on_the_page.flatten() {
        step.formula = Some(matrices.formula());
        matrices.add_factors(step);
        return;
    }
    match decomposition.kind {
        Decomposed::Frustum(frustum) => {
            let factors = frustum.factors(volume);
            step.add_item(
                "shear",
                "shear, the center line onto the line of sight",
                factors.shear.rows(),
            );
            step.add_item("scale", "scale, sides to x, y = ±distance", factors.scale.rows());
            step.add_item("depth", "depth, and w = distance", factors.depth.rows());
        }
        Decomposed::Classical { projection: Classical::Oblique(oblique), volume: prism } => {
            let factors = oblique.factors(prism, volume);
            step.add_item(
                "shear",
                "shear: projectors perpendicular to the picture",
                factors.shear.rows(),
            );
            step.add_item("fit", "fit, the box to the canonical volume", factors.fit.rows());
        }
        _ => {}
    }
}

/// Describes a projection with its parameters in words.
///
/// Window and depth are in view space units, depth as positive distances from the eye. A placed
/// projection has a camera transform multiplied into it.
fn describe_projection(kind: &Decomposed) -> String {
    let window = |w: projection::Window| {
        let [l, r, b, t] = [w.left(), w.right(), w.bottom(), w.top()].map(format_number);
        format!("left {l}, right {r}, bottom {b}, top {t}")
    };
    let depth = |near, far| format!("near {}, far {}", format_number(near), format_number(far));
    match kind {
        Decomposed::Frustum(f) => {
            format!("perspective: {}, {}", window(f.window()), depth(f.near(), f.far()))
        }
        Decomposed::ApexMoved(_) => "perspective with its apex moved (LW-1)".to_owned(),
        Decomposed::PlacedFrustum { frustum: f, .. } => {
            let lens = format!("{}, {}", window(f.window()), depth(f.near(), f.far()));
            format!("a camera and a perspective projection in one: {lens}")
        }
        Decomposed::ObliqueNear { .. } => "perspective with an oblique near plane".to_owned(),
        Decomposed::Orthographic(o) => {
            format!("orthographic: {}, {}", window(o.window()), depth(o.near(), o.far()))
        }
        Decomposed::Classical { projection, .. } => projection.class().name().to_owned(),
        Decomposed::PlacedOrthographic { volume: o, .. } => {
            let volume = format!("{}, {}", window(o.window()), depth(o.near(), o.far()));
            format!("a camera and an orthographic box in one: {volume}")
        }
        Decomposed::NPoint(perspective) => {
            let class = Classical::NPoint(*perspective).class();
            format!("{}, without a view volume", class.name())
        }
        Decomposed::Flat { projection, .. } => {
            let name = projection.map_or("projection", |p| p.class().name());
            format!("{name} onto a plane: depth is lost")
        }
    }
}

/// Returns the formula ids of a projection in the chapter's conventions, which the pipeline uses.
///
/// For example `PE-1, PE-3, VV-2`, or `None` for a matrix that is not recognized.
#[must_use]
pub fn formula_ids(view_to_clip: Projective<View, Clip>) -> Option<&'static str> {
    let decomposition = decompose(view_to_clip, ApiConventions::Alberti.canonical_volume()).ok()?;
    formula_ids_of_kind(&decomposition.kind, ApiConventions::Alberti)
}

/// Returns the formula ids for a kind of projection in these conventions.
///
/// Perspective and orthographic matrices have separate formulas for the volumes of graphics APIs
/// (GL-1, GL-3); the classical projections have the same formulas in all of them.
fn formula_ids_of_kind(kind: &Decomposed, conventions: ApiConventions) -> Option<&'static str> {
    let chapter = conventions == ApiConventions::Alberti || conventions.is_textbook();
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
