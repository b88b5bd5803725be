//! Wrong answers that have a name.

use super::Exercise;
use super::answer_text::split_answer;
use super::entries::{Entries, transposed};
use super::expression::{Letters, evaluate};
use crate::words::{Words, words};

/// A wrong answer that is often given, and why it is wrong.
#[derive(Clone, Copy, Debug)]
pub struct Mistake {
    /// Its name, which stays the same between releases: `transposed`, `m18-sign`.
    pub id: &'static str,
    /// What was done, and what is to be done.
    pub sentence: Words,
    pub(super) wrong: Wrong,
}

/// How a wrong answer follows from the right one.
#[derive(Clone, Copy, Debug)]
pub(super) enum Wrong {
    /// Rows and columns are exchanged.
    Transposed,
    /// All signs are turned.
    Negated,
    /// Two letters are exchanged, by their positions in the list of letters.
    Exchanged(usize, usize),
    /// Some entries are others: row and column from 0, and what stands there.
    Places(&'static [(usize, usize, &'static str)]),
    /// It is written down as a whole.
    Answer(&'static str),
    /// It is computed from the letters.
    Computed(fn(&[f64]) -> Option<Entries>),
}

/// A wrong answer with its name.
pub(super) const fn mistake(
    id: &'static str,
    wrong: Wrong,
    en: &'static str,
    zh: &'static str,
) -> Mistake {
    Mistake { id, sentence: words(en, zh), wrong }
}

/// A matrix for row vectors.
pub(super) const TRANSPOSED: Mistake = mistake(
    "transposed",
    Wrong::Transposed,
    "rows and columns are exchanged: this matrix is for row vectors, and here points are columns",
    "行与列互换了：这是行向量用的矩阵，而这里的点是列向量",
);

impl Mistake {
    /// The wrong answer for these values of the letters; `None` where it has none.
    pub(super) fn entries(&self, exercise: &Exercise, values: &[f64]) -> Option<Entries> {
        let letters = Letters { names: exercise.letters, values };
        let right = || (exercise.answer)(values);
        match self.wrong {
            Wrong::Transposed => Some(transposed(&right()?)),
            Wrong::Negated => Some(
                right()?.into_iter().map(|row| row.into_iter().map(|x| -x).collect()).collect(),
            ),
            Wrong::Exchanged(a, b) => {
                let mut exchanged = values.to_vec();
                exchanged.swap(a, b);
                (exercise.answer)(&exchanged)
            }
            Wrong::Places(places) => {
                let mut entries = right()?;
                for (row, column, text) in places {
                    *entries.get_mut(*row)?.get_mut(*column)? = evaluate(text, letters).ok()?;
                }
                Some(entries)
            }
            Wrong::Answer(text) => {
                let rows = split_answer(text, exercise.shape).ok()?;
                let number = |entry: String| evaluate(&entry, letters).ok();
                rows.into_iter().map(|row| row.into_iter().map(number).collect()).collect()
            }
            Wrong::Computed(compute) => compute(values),
        }
    }
}
