//! Misprints of one step: a wrong sign, a negated row, or an exchange, undone at every place.
//!
//! A matrix with such a misprint often has a far-fetched reading, such as a mirrored window, a
//! camera that looks backward, or a negative factor. If one step gives a projection or a camera
//! without any of these, the step is more likely.

use super::matrix_reading::readings_of;
use super::rounded::Entries;
use super::suspicion::{Remedy, SLIP, matrix_of};
use super::{MatrixMeaning, MatrixReading, Misprint};
use alloc::vec::Vec;
use projection::{Convention, Window};

/// The costs of the steps. Signs go wrong most often in the rows of depth and w, and more entries can
/// be exchanged than negated.
const NEGATION: u32 = SLIP;
const WINDOW_NEGATION: u32 = SLIP + 3;
const ENTRY_EXCHANGE: u32 = SLIP + 2;
const WINDOW_EXCHANGE: u32 = SLIP + 5;
const LINE_EXCHANGE: u32 = SLIP + 5;

/// A misprint with the entries in which it is undone.
type Step = (Misprint, u32, Entries<4>);

/// Returns the remedies that take one step, unless the best reading needs none.
pub(crate) fn one_step_remedies(m: &Entries<4>, best: &MatrixReading) -> Vec<Remedy> {
    let is_sound_camera =
        is_sound(best) && matches!(best.meaning, MatrixMeaning::CameraPerspective { .. });
    if is_sound(best) && !is_sound_camera {
        return Vec::new();
    }
    let mut steps = negations(m);
    // A wrong sign in the last column moves the eye or the planes to places with many digits.
    if !is_sound_camera && !is_box(m) {
        steps.extend(entry_exchanges(m));
        steps.extend(line_exchanges(m));
    }
    let is_unnamed = !best.meaning.is_named();
    let remedy = |(misprint, cost, entries): Step| {
        let is_plausible = |reading: &MatrixReading| {
            let meaning = &reading.meaning;
            is_sound(reading) && (is_projection(meaning) || (is_unnamed && is_rigid(meaning)))
        };
        let found = readings_of(&entries).into_iter().find(is_plausible)?;
        let remedied = Some(matrix_of(&entries));
        Some(Remedy { misprint, cost: found.cost + cost, remedied })
    };
    steps.into_iter().filter_map(remedy).collect()
}

/// Returns whether a matrix is affine with a positive w. The depth row of a printed box is often
/// rounded to a few digits, which have far-fetched readings after an exchange.
fn is_box(m: &Entries<4>) -> bool {
    m[3][..3].iter().all(|entry| entry.is_zero()) && m[3][3].value > 0.0
}

fn is_projection(meaning: &MatrixMeaning) -> bool {
    matches!(
        meaning,
        MatrixMeaning::Perspective { .. }
            | MatrixMeaning::CameraPerspective { .. }
            | MatrixMeaning::Orthographic { .. }
            | MatrixMeaning::CameraOrthographic { .. }
            | MatrixMeaning::ChapterP { .. }
    )
}

fn is_rigid(meaning: &MatrixMeaning) -> bool {
    matches!(meaning, MatrixMeaning::Rotation { .. } | MatrixMeaning::Camera(_))
}

/// Returns whether a reading has none of the signs of a misprint: no name, a mirrored window, a
/// negative factor, reversed planes, or a camera at the origin that only looks backward.
fn is_sound(reading: &MatrixReading) -> bool {
    let positive = reading.factor > 0.0;
    let natural = |convention| positive || convention == Convention::CHAPTER;
    match reading.meaning {
        MatrixMeaning::Perspective { frustum, convention, .. } => {
            natural(convention) && is_ordered(frustum.window())
        }
        MatrixMeaning::CameraPerspective { frustum, convention, camera, .. } => {
            natural(convention) && is_ordered(frustum.window()) && !camera.is_turned_round()
        }
        MatrixMeaning::Orthographic { volume, .. } => {
            let w = volume.window();
            let is_screen = w.left() == 0.0 && w.top() == 0.0 && w.width() > 0.0;
            let near_is_usual = volume.near() >= 0.0 || volume.near() == -volume.far();
            let in_front = volume.near() < volume.far() && volume.far() > 0.0 && near_is_usual;
            positive && (is_ordered(w) || is_screen) && in_front
        }
        MatrixMeaning::Affine | MatrixMeaning::Projective | MatrixMeaning::ObliqueNear { .. } => {
            false
        }
        MatrixMeaning::ChapterP { .. } => true,
        _ => positive,
    }
}

fn is_ordered(w: Window) -> bool {
    w.width() > 0.0 && w.height() > 0.0
}

/// Undoes one wrong sign, or the wrong sign of a whole row.
fn negations(m: &Entries<4>) -> Vec<Step> {
    let mut steps = Vec::new();
    for row in 0..4 {
        let cost = if row < 2 { WINDOW_NEGATION } else { NEGATION };
        let used: Vec<usize> = (0..4).filter(|&column| !m[row][column].is_zero()).collect();
        for &column in &used {
            let mut undone = *m;
            undone[row][column] = -m[row][column];
            let is_last_row = row == 3 && used.len() == 1 && column == 2;
            let misprint = if is_last_row { Misprint::LastRowNegated } else { Misprint::WrongSign };
            steps.push((misprint, cost, undone));
        }
        if used.len() > 1 {
            let mut undone = *m;
            undone[row] = m[row].map(|entry| if entry.is_zero() { entry } else { -entry });
            let misprint = if row == 3 { Misprint::LastRowNegated } else { Misprint::RowNegated };
            steps.push((misprint, cost + 1, undone));
        }
    }
    steps
}

/// Undoes the exchange of two entries of a row or a column, or of two entries mirrored in the
/// diagonal.
fn entry_exchanges(m: &Entries<4>) -> Vec<Step> {
    let mut steps = Vec::new();
    for first in 0..16 {
        for second in first + 1..16 {
            let ([i, j], [k, l]) = ([first / 4, first % 4], [second / 4, second % 4]);
            let is_related = i == k || j == l || (i == l && j == k);
            if is_related && !m[i][j].equals(m[k][l]) {
                let mut undone = *m;
                (undone[i][j], undone[k][l]) = (m[k][l], m[i][j]);
                let cost = if k < 2 { WINDOW_EXCHANGE } else { ENTRY_EXCHANGE };
                steps.push((Misprint::EntriesExchanged, cost, undone));
            }
        }
    }
    steps
}

/// Undoes the exchange of two rows or two columns.
fn line_exchanges(m: &Entries<4>) -> Vec<Step> {
    let mut steps = Vec::new();
    for first in 0..4 {
        for second in first + 1..4 {
            let mut rows = *m;
            rows.swap(first, second);
            steps.push((Misprint::RowsExchanged, LINE_EXCHANGE, rows));
            let columns = m.map(|mut row| {
                row.swap(first, second);
                row
            });
            steps.push((Misprint::ColumnsExchanged, LINE_EXCHANGE, columns));
        }
    }
    steps
}
