//! Common mistakes in answers.

use super::Exercise;
use super::answer_text::split_answer;
use super::entries::{Entries, transposed};
use super::expression::{Letters, evaluate};
use crate::words::{Words, words};

/// A common wrong answer and an explanation.
#[derive(Clone, Copy, Debug)]
pub struct Mistake {
    /// The identifier, such as `transposed` or `m18-sign`, which does not change between releases.
    pub id: &'static str,
    /// The mistake and a remedy.
    pub sentence: Words,
    pub(super) wrong: Wrong,
}

/// The way in which a wrong answer differs from the correct answer.
#[derive(Clone, Copy, Debug)]
pub(super) enum Wrong {
    /// Rows and columns are swapped.
    Transposed,
    /// All signs are flipped.
    Negated,
    /// Two symbols, identified by their positions in the list of symbols, are swapped.
    Exchanged(usize, usize),
    /// Some entries are replaced: the row and column, from 0, and the wrong entry.
    Places(&'static [(usize, usize, &'static str)]),
    /// The whole wrong answer.
    Answer(&'static str),
    /// One of several whole wrong answers.
    AnyOf(&'static [&'static str]),
    /// The answer contains any of these strings, such as `f_n` printed for f n.
    Written(&'static [&'static str]),
    /// The wrong answer is computed from the symbols.
    Computed(fn(&[f64]) -> Option<Entries>),
}

/// Creates a named mistake.
pub(super) const fn mistake(
    id: &'static str,
    wrong: Wrong,
    en: &'static str,
    zh: &'static str,
) -> Mistake {
    Mistake { id, sentence: words(en, zh), wrong }
}

/// The mistake of writing a matrix for row vectors.
pub(super) const TRANSPOSED: Mistake = mistake(
    "transposed",
    Wrong::Transposed,
    "rows and columns are swapped: this matrix is for row vectors, but points are column vectors here",
    "行与列互换了：这是行向量用的矩阵，而这里的点是列向量",
);

impl Mistake {
    /// Whether the answer contains symbols that indicate this mistake.
    pub(super) fn is_written_in(&self, rows: &[Vec<String>]) -> bool {
        let Wrong::Written(all) = self.wrong else { return false };
        let belongs = |c: char| c.is_alphanumeric() || c == '_';
        let mut written = rows.iter().flatten().flat_map(|entry| entry.split(|c| !belongs(c)));
        written.any(|word| all.contains(&word.trim_start_matches(|c: char| c.is_ascii_digit())))
    }

    /// Returns the number of wrong answers for this mistake.
    pub(super) const fn variants(&self) -> usize {
        match self.wrong {
            Wrong::AnyOf(answers) => answers.len(),
            Wrong::Written(_) => 0,
            _ => 1,
        }
    }

    /// Returns a wrong answer for these values of the symbols, or `None` if there is none.
    pub(super) fn entries(
        &self,
        variant: usize,
        exercise: &Exercise,
        values: &[f64],
    ) -> Option<Entries> {
        let letters = Letters { names: exercise.letters, values };
        let right = || (exercise.answer)(values);
        let evaluate_answer = |text: &str| {
            let rows = split_answer(text, exercise.shape).ok()?;
            let number = |entry: String| evaluate(&entry, letters).ok();
            rows.into_iter().map(|row| row.into_iter().map(number).collect()).collect()
        };
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
            Wrong::Answer(text) => evaluate_answer(text),
            Wrong::AnyOf(texts) => evaluate_answer(texts.get(variant)?),
            Wrong::Written(_) => None,
            Wrong::Computed(compute) => compute(values),
        }
    }
}
