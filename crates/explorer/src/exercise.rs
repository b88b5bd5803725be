//! Exercises on viewing. Answers are checked, and common mistakes are recognized.
//!
//! ```text
//! answer ─► answer_text: entries ─► expression: numbers, for several values of the letters
//!                                     └─► entries: right, a known mistake, or wrong in some places
//! ```
//! Exercises 1 to 11 come from the textbook's chapter; 12 to 24 were written for this project. The
//! crates compute the correct answers. Formulas are compared by value, so every notation is
//! accepted.
//!
//! ```
//! use explorer::Language;
//! use explorer::exercise::find_exercise;
//! let exercise = find_exercise(3).expect("the third row of P");
//! assert!(exercise.check("A = n + f; B = -n f")?.is_right());
//! let verdict = exercise.check("A = n + f; B = n f")?;
//! assert!(verdict.sentence().text(Language::English).starts_with("incorrect: the sign of B"));
//! # Ok::<(), explorer::exercise::AnswerError>(())
//! ```

mod answer_error;
mod answer_list;
mod answer_text;
mod entries;
mod expression;
mod mistake;
mod questions;
mod verdict;

pub use answer_error::AnswerError;
pub use mistake::Mistake;
pub use verdict::{Difference, Verdict};

use crate::words::{Sentence, Words, sentence};
use answer_text::{AnswerShape, split_answer};
use entries::{EXACT, Entries, Multiples, ROUNDED, differing_places, is_negated, same_shape};
use expression::{Letters, evaluate};

/// An exercise.
#[derive(Debug)]
pub struct Exercise {
    /// The number, from 1.
    pub number: u32,
    /// The title.
    pub title: Words,
    /// The complete question.
    pub question: Words,
    /// Hints, from vague to specific.
    pub hints: &'static [Words],
    /// The symbols that the answer may contain.
    pub letters: &'static [&'static str],
    /// The known mistakes.
    pub mistakes: &'static [Mistake],
    shape: AnswerShape,
    multiples: Multiples,
    /// Sample values of the symbols; an answer is compared for each sample.
    samples: &'static [&'static [f64]],
    /// Computes the correct answer for values of the symbols; `None` if no answer exists.
    answer: fn(&[f64]) -> Option<Entries>,
}

/// Returns all exercises, ordered by number.
#[must_use]
pub fn exercises() -> &'static [&'static Exercise] {
    &questions::EXERCISES
}

/// Finds an exercise by its number.
#[must_use]
pub fn find_exercise(number: u32) -> Option<&'static Exercise> {
    exercises().iter().copied().find(|exercise| exercise.number == number)
}

/// A single sample without values, for exercises without symbols.
const NUMBERS: &[&[f64]] = &[&[]];

impl Exercise {
    /// Returns the form of an answer, without a final period.
    #[must_use]
    pub fn form(&self) -> Sentence {
        let (mut en, mut zh) = match self.shape {
            AnswerShape::Matrix(rows, columns) => (
                format!("a {rows} × {columns} matrix, its rows separated by `;`"),
                format!("{rows} × {columns} 矩阵，各行用 `;` 分隔"),
            ),
            AnswerShape::Parts(parts) => {
                let list = |name: fn(&'static str) -> &'static str| {
                    let names = |names: &&[&'static str]| {
                        names.iter().copied().map(name).collect::<Vec<_>>().join(", ")
                    };
                    parts.iter().map(names).collect::<Vec<_>>().join("; ")
                };
                (format!("`{}`", list(|name| name)), format!("`{}`", list(verdict::chinese_name)))
            }
        };
        if self.letters.is_empty() {
            en += ", with numbers such as `2/3` or `sqrt(2)`";
            zh += "，用 `2/3` 或 `sqrt(2)` 这样的数";
        } else {
            let letters = self.letters.join(", ");
            en += &format!(", in terms of {letters}");
            zh += &format!("，可用字母 {letters}");
        }
        match self.multiples {
            Multiples::None => {}
            Multiples::All => {
                en += "; any multiple is correct";
                zh += "；任意倍数都对";
            }
            Multiples::Positive => {
                en += "; any positive multiple is correct";
                zh += "；任意正倍数都对";
            }
        }
        sentence(en, zh)
    }

    /// Compares an answer with the correct answer and with common mistakes.
    ///
    /// Numbers may differ by up to 1e-9 of an entry's value.
    ///
    /// # Errors
    /// Returns an error if the text contains other symbols or has the wrong number of entries.
    pub fn check(&'static self, answer: &str) -> Result<Verdict, AnswerError> {
        let rows = split_answer(answer, self.shape)?;
        if let Some(mistake) = self.mistakes.iter().find(|mistake| mistake.is_written_in(&rows)) {
            return Ok(Verdict::Mistaken(mistake));
        }
        let given: Vec<Entries> = self.evaluate_rows(&rows)?;
        let right: Vec<Entries> =
            self.samples.iter().filter_map(|values| (self.answer)(values)).collect();
        if self.all_equal(&given, &right, EXACT) {
            return Ok(Verdict::Right);
        }
        let named = self.mistakes.iter().find(|mistake| {
            (0..mistake.variants()).any(|variant| {
                let wrong = |values: &&[f64]| mistake.entries(variant, self, values);
                let wrong: Vec<Entries> = self.samples.iter().filter_map(wrong).collect();
                self.all_equal(&given, &wrong, EXACT)
            })
        });
        if let Some(mistake) = named {
            return Ok(Verdict::Mistaken(mistake));
        }
        self.check_shape(&rows, answer)?;
        if self.all_equal(&given, &right, ROUNDED) {
            return Ok(Verdict::Rounded);
        }
        Ok(self.differences(&given, &right))
    }

    /// Returns the values of an answer for each sample of the symbols.
    fn evaluate_rows(&self, rows: &[Vec<String>]) -> Result<Vec<Entries>, AnswerError> {
        let evaluate_sample = |values: &&[f64]| {
            let letters = Letters { names: self.letters, values };
            let row =
                |row: &Vec<String>| row.iter().map(|entry| evaluate(entry, letters)).collect();
            rows.iter().map(row).collect()
        };
        self.samples.iter().map(evaluate_sample).collect()
    }

    /// Whether an answer equals another in every sample.
    fn all_equal(&self, given: &[Entries], other: &[Entries], tolerance: f64) -> bool {
        given.len() == other.len()
            && given.iter().zip(other).all(|(given, other)| {
                same_shape(given, other)
                    && differing_places(given, other, self.multiples, tolerance).is_empty()
            })
    }

    fn check_shape(&self, rows: &[Vec<String>], answer: &str) -> Result<(), AnswerError> {
        let (found, expected) =
            (rows.iter().map(Vec::len).collect::<Vec<_>>(), self.shape.row_lengths());
        if found == expected {
            return Ok(());
        }
        let form = self.form();
        let count = |lengths: &[usize]| {
            lengths.iter().map(ToString::to_string).collect::<Vec<_>>().join(" + ")
        };
        let blanks = self.product_between_blanks(rows, answer);
        let (en, zh) = blanks.map_or_else(Default::default, |product| {
            (
                format!(
                    "; spaces separate entries, so write `{product}` or put commas between entries"
                ),
                format!("；空格用来分隔元素：请写成 `{product}`，或在元素之间用逗号"),
            )
        });
        let (found, expected) = (count(&found), count(&expected));
        let entries = if found == "1" { "entry" } else { "entries" };
        Err(AnswerError::new(
            format!(
                "the answer has {found} {entries} instead of {expected}: enter {}{en}",
                form.en
            ),
            format!("答案有 {found} 个元素，应有 {expected} 个：请给出 {}{zh}", form.zh),
        ))
    }

    /// Returns a product such as `l*nx` if an answer without commas has too many entries in a row
    /// because it was written as `l nx`.
    fn product_between_blanks(&self, rows: &[Vec<String>], answer: &str) -> Option<String> {
        if answer.contains([',', '，', '、']) {
            return None;
        }
        let belongs = |c: char| c.is_alphanumeric() || c == '_';
        let too_long = |(row, length): &(&Vec<String>, usize)| row.len() > *length;
        let lengths = self.shape.row_lengths();
        let (row, _) = rows.iter().zip(lengths).find(too_long)?;
        let written = row.windows(2).find_map(|pair| {
            let left = pair[0].rsplit(|c| !belongs(c)).next()?;
            let right = pair[1].split(|c| !belongs(c)).next()?;
            let is_letter = |word: &str| word.starts_with(char::is_alphabetic);
            (is_letter(left) && is_letter(right)).then(|| format!("{left}*{right}"))
        });
        match self.letters {
            [first, second, ..] => Some(written.unwrap_or_else(|| format!("{first}*{second}"))),
            _ => None,
        }
    }

    /// Returns the entries that differ, in the first sample where any entry differs.
    fn differences(&self, given: &[Entries], right: &[Entries]) -> Verdict {
        let places = |(given, right): (&Entries, &Entries)| {
            differing_places(given, right, self.multiples, EXACT)
        };
        let samples = given.iter().zip(right).zip(self.samples);
        let found = samples.map(|(pair, values)| (pair, values, places(pair)));
        let Some(((given, right), values, found)) =
            found.into_iter().find(|(.., at)| !at.is_empty())
        else {
            return Verdict::Rounded;
        };
        let difference = |(row, column): (usize, usize)| Difference {
            row,
            column,
            name: verdict::entry_name(self.shape, row, column),
            value: given[row][column],
            is_negated: self.multiples == Multiples::None
                && is_negated(given[row][column], right[row][column]),
        };
        Verdict::Different {
            differences: found.into_iter().map(difference).collect(),
            count: right.iter().map(Vec::len).sum(),
            letters: self.letters.iter().copied().zip(values.iter().copied()).collect(),
        }
    }
}
