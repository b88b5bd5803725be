//! The rows of the table, and the verdicts on their matrices.

use super::formulas::Rows;
use super::{right_matrices, wrong_matrices};
use projection::{Convention, PrincipalPlane};
use recognition::{MatrixMeaning, Misprint, Recognition, SuspicionStrength, recognize};

/// The expected meaning of a matrix, from its source.
#[derive(Clone, Debug)]
pub(crate) enum Expected {
    /// Convention, window (left, right, bottom, top), near, far.
    Frustum(Convention, [f64; 4], f64, f64),
    /// Convention, vertical field of view in degrees, aspect ratio, near, far.
    Lens(Convention, f64, f64, f64, f64),
    InverseLens(Convention, f64, f64, f64, f64),
    Moved([f64; 4], f64, f64),
    Box(Convention, [f64; 4], f64, f64),
    /// Convention, length and φ in degrees, window (left, right, bottom, top), near, far.
    Prism(Convention, [f64; 2], [f64; 4], f64, f64),
    /// Length, φ in degrees, plane; whether depth is preserved.
    Oblique(f64, f64, f64, bool),
    /// Eye and gaze.
    Camera([f64; 3], [f64; 3]),
    /// Eye, convention, vertical field of view, near, far.
    CameraLens([f64; 3], Convention, f64, f64, f64),
    P(f64, f64),
    PInverse(f64, f64),
    /// Rectangle (x, y, width, height), whether y points down, whether pixel centers are integers.
    Viewport([f64; 4], bool, bool),
    Intrinsics([f64; 4]),
    Translation([f64; 3]),
    Scale([f64; 3]),
    Windowing([f64; 3], [f64; 3]),
    Reflection([f64; 3], f64),
    /// Axis and angle.
    Rotation([f64; 3], f64),
    Shear([[f64; 3]; 3]),
    /// Translation and scale.
    Model([f64; 3], [f64; 3]),
    Plane(PrincipalPlane),
    Isometric,
    NPoint([f64; 3], bool),
}

/// A matrix of the table.
pub(crate) struct Row {
    pub(crate) name: &'static str,
    pub(crate) matrix: Rows,
    /// The expected report on the matrix.
    pub(crate) verdict: Verdict,
    /// The tolerance of the parameters, relative to their size or to 1, whichever is larger.
    pub(crate) tolerance: f64,
}

/// The expected report.
pub(crate) enum Verdict {
    /// The first reading and the common factor.
    Reading(Expected, f64),
    /// The misprint that is suspected.
    Slip(Misprint),
    /// The first reading and a misprint with the same numbers; both must be reported.
    Both(Expected, Misprint),
}

fn near(a: f64, b: f64, tolerance: f64) -> bool {
    a == b || (a - b).abs() <= tolerance * b.abs().max(1.0)
}

fn all_near<const N: usize>(a: [f64; N], b: [f64; N], tolerance: f64) -> bool {
    a.into_iter().zip(b).all(|(a, b)| near(a, b, tolerance))
}

fn edges(w: projection::Window) -> [f64; 4] {
    [w.left(), w.right(), w.bottom(), w.top()]
}

/// Whether the meaning has the expected parameters.
pub(crate) fn is_expected(meaning: &MatrixMeaning, expected: &Expected, tolerance: f64) -> bool {
    let same = |a: f64, b: f64| near(a, b, tolerance);
    let depth = |a: (f64, f64), n: f64, f: f64| same(a.0 / n, 1.0) && same(n / a.1, n / f);
    match (*meaning, expected.clone()) {
        (MatrixMeaning::Perspective { frustum, convention, .. }, Expected::Frustum(c, w, n, f)) => {
            let window = all_near(edges(frustum.window()), w, tolerance);
            c == convention && window && depth((frustum.near(), frustum.far()), n, f)
        }
        (
            MatrixMeaning::Perspective { frustum, lens, convention },
            Expected::Lens(c, fovy, aspect, n, f),
        )
        | (
            MatrixMeaning::InversePerspective { frustum, lens, convention },
            Expected::InverseLens(c, fovy, aspect, n, f),
        ) => {
            let angles = same(lens.fov_y_degrees, fovy) && same(lens.aspect, aspect);
            c == convention && angles && depth((frustum.near(), frustum.far()), n, f)
        }
        (MatrixMeaning::ApexMoved { frustum, convention }, Expected::Moved(w, n, f)) => {
            let window = all_near(edges(frustum.window()), w, tolerance);
            let planes = depth((frustum.near(), frustum.far()), n, f);
            convention == Convention::OPENGL && window && planes
        }
        (MatrixMeaning::Orthographic { volume, convention }, Expected::Box(c, w, n, f)) => {
            let window = all_near(edges(volume.window()), w, tolerance);
            c == convention && window && same(volume.near(), n) && same(volume.far(), f)
        }
        (
            MatrixMeaning::CameraPerspective { camera, frustum, lens, convention },
            Expected::CameraLens(eye, c, fovy, n, f),
        ) => {
            let placed = all_near(camera.eye, eye, tolerance) && same(lens.fov_y_degrees, fovy);
            c == convention && placed && depth((frustum.near(), frustum.far()), n, f)
        }
        (found, expected) => is_expected_transform(&found, expected, tolerance),
    }
}

fn is_expected_transform(found: &MatrixMeaning, expected: Expected, tolerance: f64) -> bool {
    let same = |a: f64, b: f64| near(a, b, tolerance);
    match (*found, expected) {
        (MatrixMeaning::ObliqueOntoPlane { projection }, Expected::Oblique(l, phi, z, false))
        | (MatrixMeaning::ObliqueShear { projection }, Expected::Oblique(l, phi, z, true)) => {
            let angle = projection.phi().to_degrees();
            same(projection.length(), l) && same(angle, phi) && same(projection.plane_z(), z)
        }
        (
            MatrixMeaning::ObliqueVolume { projection, volume, convention },
            Expected::Prism(c, [length, phi], w, n, f),
        ) => {
            let angle = projection.phi().to_degrees();
            let slant = same(projection.length(), length) && same(angle, phi);
            let planes = same(volume.near(), n) && same(volume.far(), f);
            c == convention && slant && all_near(edges(volume.window()), w, tolerance) && planes
        }
        (MatrixMeaning::Camera(camera), Expected::Camera(eye, gaze)) => {
            all_near(camera.eye, eye, tolerance) && all_near(camera.gaze, gaze, tolerance)
        }
        (MatrixMeaning::ChapterP { n, f }, Expected::P(a, b))
        | (MatrixMeaning::ChapterPInverse { n, f }, Expected::PInverse(a, b)) => {
            same(n, a) && same(f, b)
        }
        (MatrixMeaning::Viewport(v), Expected::Viewport(area, y_down, integer)) => {
            [v.x, v.y, v.width, v.height] == area
                && (v.y_down, v.integer_centers) == (y_down, integer)
        }
        (MatrixMeaning::Intrinsics(k), Expected::Intrinsics(expected)) => {
            all_near([k.fx, k.fy, k.cx, k.cy], expected, tolerance) && k.skew == 0.0
        }
        (MatrixMeaning::Translation { by: found }, Expected::Translation(expected))
        | (MatrixMeaning::Scale { factors: found }, Expected::Scale(expected)) => {
            all_near(found, expected, tolerance)
        }
        (MatrixMeaning::Windowing { scale, offset }, Expected::Windowing(s, o)) => {
            all_near(scale, s, tolerance) && all_near(offset, o, tolerance)
        }
        (MatrixMeaning::Reflection { normal, distance }, Expected::Reflection(n, d)) => {
            all_near(normal, n, tolerance) && same(distance, d)
        }
        (MatrixMeaning::Rotation { axis, angle_degrees, .. }, Expected::Rotation(a, angle)) => {
            all_near(axis, a, tolerance) && same(angle_degrees, angle)
        }
        (MatrixMeaning::Shear { linear, .. }, Expected::Shear(expected)) => {
            (0..3).all(|i| all_near(linear[i], expected[i], tolerance))
        }
        (MatrixMeaning::ModelTransform { translation, scale, .. }, Expected::Model(t, s)) => {
            all_near(translation, t, tolerance) && all_near(scale, s, tolerance)
        }
        (MatrixMeaning::PrincipalView { plane }, Expected::Plane(expected)) => plane == expected,
        (MatrixMeaning::AxonometricOntoPlane { projection }, Expected::Isometric) => {
            projection.foreshortening().iter().all(|&ratio| same(ratio, libm::sqrt(2.0 / 3.0)))
        }
        (MatrixMeaning::NPoint { projection, onto_plane }, Expected::NPoint(terms, flat)) => {
            onto_plane == flat && all_near(projection.bottom_row(), terms, tolerance)
        }
        _ => false,
    }
}

fn recognized(rows: Rows) -> Recognition {
    recognize(rows)
}

/// Returns the report on a matrix that is not recognized as expected; otherwise returns `None`.
fn complaint(row: &Row) -> Option<String> {
    let found = recognized(row.matrix);
    let first = found.first();
    let told = |misprint| found.suspicions.iter().any(|s| s.misprint == misprint);
    let right = match &row.verdict {
        Verdict::Reading(expected, factor) => {
            let factor = near(first.factor, *factor, row.tolerance);
            is_expected(&first.meaning, expected, row.tolerance) && factor
        }
        Verdict::Slip(misprint) => {
            found.misprint().is_some_and(|suspicion| suspicion.misprint == *misprint)
        }
        Verdict::Both(expected, misprint) => {
            is_expected(&first.meaning, expected, row.tolerance) && told(*misprint)
        }
    };
    let found = || {
        let slips: Vec<_> = found.suspicions.iter().map(|s| (s.misprint, s.strength)).collect();
        format!("{}: {:?} × {}, {slips:?}", row.name, first.meaning, first.factor)
    };
    (!right).then(found)
}

#[test]
fn of_120_matrices_at_least_118_are_recognized() {
    let rows: Vec<Row> = right_matrices::rows().into_iter().chain(wrong_matrices::rows()).collect();
    assert_eq!(rows.len(), 120);
    let complaints: Vec<String> = rows.iter().filter_map(complaint).collect();
    let list = complaints.join("\n");
    println!("{} of {} matrices are recognized\n{list}", rows.len() - complaints.len(), rows.len());
    assert!(complaints.len() <= 2, "{} matrices are not recognized:\n{list}", complaints.len());
}

#[test]
fn no_correct_matrix_is_reported_as_a_misprint() {
    for row in right_matrices::rows() {
        let found = recognized(row.matrix);
        let called: Vec<Misprint> = found
            .suspicions
            .iter()
            .filter(|suspicion| suspicion.strength == SuspicionStrength::Likely)
            .map(|suspicion| suspicion.misprint)
            .collect();
        assert_eq!(called, [], "{}: {:?}", row.name, found.first());
    }
}

#[test]
fn row_names_are_unique() {
    let mut names: Vec<&str> = right_matrices::rows().iter().map(|row| row.name).collect();
    names.extend(wrong_matrices::rows().iter().map(|row| row.name));
    names.sort_unstable();
    let count = names.len();
    names.dedup();
    assert_eq!(names.len(), count);
}
