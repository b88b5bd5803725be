//! Explanation of a 4 × 4 matrix: its kind, the projections it may be in known conventions, and
//! known misprints it resembles.
//!
//! The same sixteen numbers can be several projections, each in another convention: OpenGL's and
//! the textbook's differ by the sign of z. All readings are listed, the simplest first. Misprints
//! are those of the chapter and of widespread tutorials, such as a transposed matrix or a sign lost
//! in the third row.

use super::conventions::volume_name;
use super::plain_text::format_number;
use super::{Explanation, Step};
use homog::{Clip, HPointKind, Projective, View};
use projection::{Convention, Decomposed, Symptom, readings, symptoms};

/// Explains a matrix for column vectors.
///
/// # Errors
/// If an entry is not a finite number.
///
/// The matrix is read as a map from view to clip space, M p with p a column. Entries of the
/// transposed matrix (row vectors, or column-major storage read by rows) are recognized as a
/// misprint and shown corrected.
pub fn explain_matrix(rows: [[f64; 4]; 4]) -> Result<Explanation, String> {
    if let Some(at) = rows.as_flattened().iter().position(|entry| !entry.is_finite()) {
        let (row, column) = (at / 4 + 1, at % 4 + 1);
        return Err(format!("the entry in row {row}, column {column} is not a finite number"));
    }
    let map = Projective::<View, Clip>::from_rows(rows);
    let matrix = map.raw();
    let read: Vec<_> = readings(matrix).collect();
    let misprints: Vec<Symptom> = symptoms(matrix).collect();
    let mut steps = vec![kind_step(rows, map)];
    steps.extend(affine_step(map));
    steps.push(vanishing_points_step(map));
    steps.push(readings_step(&read));
    steps.extend(misprints.iter().enumerate().map(|(at, slip)| misprint_step(at, slip)));
    let verdict = matrix_verdict(map, &read, &misprints);
    Ok(Explanation { subject: "A matrix for column vectors".to_owned(), steps, verdict })
}

/// A projection that the matrix is, with the convention in which it is one.
///
/// The decomposition holds the parameters and the common factor: a projective map does not change
/// when it is multiplied by a number other than 0.
type ProjectionReading = (Convention, projection::Decomposition);

/// The kind of map: affine, projective, its rank and determinant.
///
/// A rank below 4 loses a dimension, as a projection onto a plane does; the sign of the determinant
/// says whether orientation changes, as it does between handednesses.
fn kind_step(rows: [[f64; 4]; 4], map: Projective<View, Clip>) -> Step {
    let found = map.classify();
    Step::new("kind", "What kind of map it is", Some("HO-3"))
        .with_item("matrix", "matrix", rows)
        .with_item("kind", "kind", found.to_string())
        .with_item("rank", "rank", found.rank as f64)
        .with_item("determinant", "determinant", map.raw().determinant())
}

/// The parts of an affine map: translation, scale of each axis, shear, handedness.
///
/// Only for matrices whose last row is a multiple of (0, 0, 0, 1). With the columns a₁, a₂, a₃ of
/// the upper left 3 × 3:
///
/// ```text
///  scales      |a₁|, |a₂|, |a₃|
///  shear       |aᵢ · aⱼ| > 1e-9 |aᵢ| |aⱼ| for some pair
///  handedness  sign of (a₁ × a₂) · a₃
/// ```
/// The tolerance is relative to the lengths, so that scales of 1e-6 do not hide a shear.
fn affine_step(map: Projective<View, Clip>) -> Option<Step> {
    let matrix = map.to_affine()?.raw();
    let axes = [matrix.x_axis, matrix.y_axis, matrix.z_axis].map(glam::DVec4::truncate);
    let lengths = axes.map(glam::DVec3::length);
    let slant = |a: usize, b: usize| axes[a].dot(axes[b]).abs() > 1e-9 * lengths[a] * lengths[b];
    let angles = if slant(0, 1) || slant(1, 2) || slant(2, 0) {
        "the axes do not stay at right angles: there is a shear"
    } else {
        "the axes stay at right angles: a rotation and scales"
    };
    let determinant = axes[0].cross(axes[1]).dot(axes[2]);
    let handedness = match determinant {
        turn if turn > 0.0 => "kept",
        turn if turn < 0.0 => "exchanged, as in a mirror",
        _ => "lost: the image is flat",
    };
    let step = Step::new("affine", "Its parts", Some("HO-4, HO-5"))
        .with_item("translation", "translation", matrix.w_axis.truncate().to_array())
        .with_item("scales", "lengths of the axes", lengths)
        .with_item("angles", "angles", angles)
        .with_item("handedness", "handedness", handedness);
    Some(step)
}

/// The vanishing points of the three axes.
///
/// The vanishing point of a direction d is M (d, 0): the columns of the matrix. Finite columns
/// belong to one-, two- and three-point perspective (VN-1); 1e-12 is the relative tolerance on w.
fn vanishing_points_step(map: Projective<View, Clip>) -> Step {
    let points = map.principal_vanishing_points(1e-12);
    let words = |meaning: HPointKind<Clip>| match meaning {
        HPointKind::Finite(point) => {
            let [x, y, z] = <[f64; 3]>::from(point).map(format_number);
            format!("vanishes at ({x}, {y}, {z})")
        }
        HPointKind::AtInfinity(_) => "stays parallel".to_owned(),
        HPointKind::Invalid => "is lost".to_owned(),
    };
    let step = Step::new("vanishing_points", "Where lines along the axes meet", Some("VN-1"));
    ["x", "y", "z"]
        .into_iter()
        .zip(points)
        .fold(step, |step, (axis, point)| step.with_item(axis, axis, words(point)))
}

/// The projections that the matrix may be.
///
/// One item for each reading, labeled with its convention. A common factor other than 1 is printed:
/// it does not move any point, but it scales w, which some programs use as a distance.
fn readings_step(read: &[ProjectionReading]) -> Step {
    let step =
        Step::new("readings", "Which projection it is, in whose convention", Some("GL-1, PE-2"));
    if read.is_empty() {
        return step.with_item("none", "none", "no known projection, in no known convention");
    }
    (0..).zip(read).fold(step, |step, (at, (convention, found)): (usize, _)| {
        let factor = match found.factor {
            1.0 => String::new(),
            factor => format!(", all times {}", format_number(factor)),
        };
        step.with_item(
            at.to_string(),
            volume_name(*convention),
            describe_projection(&found.kind) + &factor,
        )
    })
}

/// A projection with its parameters in words.
///
/// Window and depth are in the units of view space, depth as positive distances from the eye. A
/// placed projection is one that has a camera transform multiplied into it.
pub(super) fn describe_projection(kind: &Decomposed) -> String {
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
            format!("a camera and a perspective in one: {lens}")
        }
        Decomposed::ObliqueNear { .. } => "perspective with an inclined near plane".to_owned(),
        Decomposed::Orthographic(o) => {
            format!("orthographic: {}, {}", window(o.window()), depth(o.near(), o.far()))
        }
        Decomposed::Classical { projection, .. } => projection.class().name().to_owned(),
        Decomposed::PlacedOrthographic { volume: o, .. } => {
            let volume = format!("{}, {}", window(o.window()), depth(o.near(), o.far()));
            format!("a camera and an orthographic box in one: {volume}")
        }
        Decomposed::NPoint(perspective) => {
            let class = projection::Classical::NPoint(*perspective).class();
            format!("{}, without a view volume", class.name())
        }
        Decomposed::Flat { projection, .. } => {
            let name = projection.map_or("projection", |p| p.class().name());
            format!("{name} onto a plane: depth is lost")
        }
    }
}

/// A known misprint that the matrix resembles, with the correction.
///
/// The corrected matrix is shown only where the sixteen entries determine it. The first misprint
/// has the id `misprint`, further ones `other_misprint`.
fn misprint_step(at: usize, slip: &Symptom) -> Step {
    let known = slip.misprint.id().unwrap_or("not numbered");
    let title = format!("It looks like a known misprint ({known})");
    let step = Step::new(if at == 0 { "misprint" } else { "other_misprint" }, title, None)
        .with_item("finding", "finding", slip.misprint.description())
        .with_item("remedy", "remedy", slip.misprint.remedy());
    match slip.remedied {
        Some(remedied) => {
            step.with_item("remedied", "then", Projective::<View, Clip>::from_raw(remedied).rows())
        }
        None => step,
    }
}

/// The result in a sentence: the first reading, and the first misprint.
///
/// The readings come simplest first, so the first one is the likeliest intention.
fn matrix_verdict(
    map: Projective<View, Clip>,
    read: &[ProjectionReading],
    slips: &[Symptom],
) -> String {
    let what = match read.first() {
        Some((convention, found)) => {
            format!(
                "In the convention of {}: {}.",
                volume_name(*convention),
                describe_projection(&found.kind)
            )
        }
        None => format!("It is {}, and no projection that has a name.", map.classify()),
    };
    match slips.first() {
        Some(slip) => {
            format!("{what} But it looks like a misprint: {}.", slip.misprint.description())
        }
        None => what,
    }
}
