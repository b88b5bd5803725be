//! Reads a 4×4 matrix: tries every reader and lists the reading with the fewest digits first.

use crate::rounded::{Entries, Rounded, coarser_measures, measure_entries};
use crate::{
    MatrixMeaning, Suspicion, SuspicionStrength, affine, classical, parallel, perspective, pixels,
    placed, rigid, suspicion, viewport,
};
use alloc::vec::Vec;

/// The cost of a matrix of unknown meaning.
pub(crate) const UNNAMED: u32 = 1000;

/// Readings whose costs differ by at most this amount are equally likely.
pub(crate) const EQUAL: u32 = 3;

/// The saving in cost required to assume a coarser precision than the most precise entry has.
pub(crate) const COARSER: u32 = 8;

/// One meaning of a matrix.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct MatrixReading {
    /// The meaning with its parameters, after removing the factor.
    pub meaning: MatrixMeaning,
    /// The common factor of all entries; a multiple of a matrix is the same map. The factor is
    /// negative if w is negative in front of the eye, as in the textbook's M_per (PE-3; Shirley and
    /// Marschner, ch. 8).
    pub factor: f64,
    /// Twice the number of digits of the parameters, with a penalty for rare conventions and
    /// mirrored windows. A reading with a lower cost is more likely.
    pub cost: u32,
}

/// All possible meanings of a matrix.
#[derive(Clone, PartialEq, Debug)]
#[non_exhaustive]
pub struct Recognition {
    /// The meanings, most likely first; never empty.
    pub readings: Vec<MatrixReading>,
    /// The misprints that explain the entries at least as well, most likely first.
    pub suspicions: Vec<Suspicion>,
}

impl Recognition {
    /// Returns the most likely reading.
    #[must_use]
    pub fn first(&self) -> MatrixReading {
        self.readings.first().copied().unwrap_or(MatrixReading {
            meaning: MatrixMeaning::Projective,
            factor: 1.0,
            cost: UNNAMED,
        })
    }

    /// Returns the other readings that are as likely as the first.
    pub fn equal_readings(&self) -> impl Iterator<Item = &MatrixReading> {
        let most = self.first().cost + EQUAL;
        self.readings.iter().skip(1).filter(move |reading| reading.cost <= most)
    }

    /// Returns the misprint, if it explains the matrix clearly better than any other reading.
    #[must_use]
    pub fn misprint(&self) -> Option<&Suspicion> {
        self.suspicions.iter().find(|found| found.strength == SuspicionStrength::Likely)
    }
}

/// Recognizes a 4×4 matrix for column vectors, specified by its rows.
///
/// If an entry is not finite, or if its magnitude is nonzero and outside 1e-40 to 1e40, the only
/// reading is an unnamed map.
///
/// Entries may be rounded. Their precision, such as a number of decimals or f32, is estimated from
/// the entries themselves, and parameters get the fewest digits that reproduce the rounded matrix.
///
/// ```
/// use projection::Convention;
/// use recognition::{MatrixMeaning, recognize};
/// // gluPerspective(60°, 16/9, 0.1, 100), printed with four decimals.
/// let rows = [
///     [0.9743, 0.0, 0.0, 0.0],
///     [0.0, 1.7321, 0.0, 0.0],
///     [0.0, 0.0, -1.002, -0.2002],
///     [0.0, 0.0, -1.0, 0.0],
/// ];
/// let MatrixMeaning::Perspective { frustum, lens, convention } = recognize(rows).first().meaning
/// else {
///     panic!("not a perspective projection")
/// };
/// assert_eq!(convention, Convention::OPENGL);
/// assert_eq!((lens.fov_y_degrees, frustum.near(), frustum.far()), (60.0, 0.1, 100.0));
/// ```
#[must_use]
pub fn recognize(rows: [[f64; 4]; 4]) -> Recognition {
    let mut entries = measure_entries(rows);
    let mut cost = least_cost(&entries);
    // One entry with more digits than the others does not make the others exact.
    for coarser in coarser_measures(rows) {
        let found = least_cost(&coarser);
        if found + COARSER <= cost {
            (entries, cost) = (coarser, found);
        }
    }
    let readings = readings_of(&entries);
    let suspicions = suspicion::suspicions_of(&entries, &readings);
    Recognition { readings, suspicions }
}

/// Returns the cost of the most likely reading, including readings for row vectors.
pub(crate) fn least_cost(entries: &Entries<4>) -> u32 {
    let cost = |entries| readings_of(entries).first().map_or(UNNAMED, |first| first.cost);
    cost(entries).min(cost(&transpose(entries)) + suspicion::SLIP)
}

/// Swaps rows and columns.
pub(crate) fn transpose(entries: &Entries<4>) -> Entries<4> {
    [0, 1, 2, 3].map(|i| [0, 1, 2, 3].map(|j| entries[j][i]))
}

/// Returns all readings, most likely first.
pub(crate) fn readings_of(entries: &Entries<4>) -> Vec<MatrixReading> {
    let mut found = Vec::new();
    let moderate = entries.as_flattened().iter().all(|entry| is_moderate(entry.value));
    if moderate {
        let readers: [fn(&Entries<4>, &mut Vec<MatrixReading>); 13] = [
            affine::read_affine,
            rigid::read_rigid,
            viewport::read_viewport,
            viewport::read_intrinsics,
            classical::read_classical,
            perspective::read_p,
            perspective::read_p_inverse,
            perspective::read_frusta,
            perspective::read_inverse_frusta,
            parallel::read_boxes,
            placed::read_placed_box,
            placed::read_placed_perspective,
            pixels::read_perspective_to_pixels,
        ];
        for reader in readers {
            reader(entries, &mut found);
        }
    }
    if moderate && found.is_empty() {
        placed::read_oblique_near(entries, &mut found);
    }
    found.retain(|reading| reading.factor.is_finite() && reading.factor != 0.0);
    found.push(unnamed_reading(entries));
    // The sort is stable, so at equal cost, the result of the earlier reader is first.
    found.sort_by_key(|reading| reading.cost);
    found
}

/// Returns whether products and quotients of a few such numbers neither overflow nor vanish.
pub(crate) fn is_moderate(entry: f64) -> bool {
    entry == 0.0 || (1e-40..1e40).contains(&entry.abs())
}

/// Returns an unnamed affine or projective map.
fn unnamed_reading(entries: &Entries<4>) -> MatrixReading {
    let affine = (0..3).all(|j| entries[3][j].is_zero()) && !entries[3][3].is_zero();
    let (meaning, cost) = if affine {
        (MatrixMeaning::Affine, UNNAMED - 1)
    } else {
        (MatrixMeaning::Projective, UNNAMED)
    };
    MatrixReading { meaning, factor: 1.0, cost }
}

/// Returns the cost of a common factor: 0 for a factor of 1. A negative factor is less likely.
pub(crate) fn factor_cost(factor: Rounded) -> u32 {
    let sign = if factor.value < 0.0 { 2 } else { 0 };
    if factor.is(1.0) { 0 } else { 2 + sign + 2 * factor.digits() }
}
