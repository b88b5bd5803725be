//! What is said about an answer.

use super::answer_text::AnswerShape;
use super::mistake::Mistake;
use crate::number_text::decimals;
use crate::words::{Sentence, sentence};

/// What an answer is.
#[derive(Clone, Debug)]
pub enum Verdict {
    /// It is right.
    Right,
    /// It is a wrong answer that has a name.
    Mistaken(&'static Mistake),
    /// It is right to three digits or so.
    Rounded,
    /// It is wrong, in these entries.
    Different {
        /// Where it differs.
        differences: Vec<Difference>,
        /// The number of all entries.
        count: usize,
        /// Values of the letters for which it differs.
        letters: Vec<(&'static str, f64)>,
    },
}

/// An entry that is wrong.
#[derive(Clone, PartialEq, Debug)]
pub struct Difference {
    /// Its row, or its part, from 0.
    pub row: usize,
    /// Its place in the row, from 0.
    pub column: usize,
    /// What it is called.
    pub name: Sentence,
    /// What it is, for the letters of the verdict.
    pub value: f64,
    /// Whether only its sign is wrong.
    pub is_negated: bool,
}

/// What an entry is called: by its name, or by its place.
pub(super) fn entry_name(shape: AnswerShape, row: usize, column: usize) -> Sentence {
    let (i, j) = (row + 1, column + 1);
    match shape {
        AnswerShape::Matrix(..) => {
            sentence(format!("row {i}, column {j}"), format!("第 {i} 行第 {j} 列"))
        }
        AnswerShape::Parts(parts) => {
            let name = parts.get(row).and_then(|names| names.get(column)).unwrap_or(&"");
            match parts.len() {
                1 => sentence(*name, *name),
                _ => sentence(format!("{name} of part {i}"), format!("第 {i} 部分的 {name}")),
            }
        }
    }
}

impl Verdict {
    /// Whether the answer is right.
    #[must_use]
    pub const fn is_right(&self) -> bool {
        matches!(self, Self::Right)
    }

    /// The verdict in a sentence, without a full stop.
    #[must_use]
    pub fn sentence(&self) -> Sentence {
        match self {
            Self::Right => sentence("right", "正确"),
            Self::Mistaken(mistake) => {
                let words = mistake.sentence;
                sentence(format!("wrong: {}", words.en), format!("错误：{}", words.zh))
            }
            Self::Rounded => sentence(
                "rounded: give a fraction, a root, or at least ten digits",
                "舍入过多：请写成分数、根式，或至少十位数字",
            ),
            Self::Different { differences, count, letters } => {
                let said = |difference: &Difference| difference.to_sentence();
                let said: Vec<Sentence> = differences.iter().map(said).collect();
                let list = |text: fn(&Sentence) -> &str, comma| {
                    said.iter().map(text).collect::<Vec<_>>().join(comma)
                };
                let at = letters
                    .iter()
                    .map(|(name, value)| format!("{name} = {}", decimals(*value, 6)))
                    .collect::<Vec<_>>()
                    .join(", ");
                let wrong = differences.len();
                let (en, zh) = (list(|said| &said.en, "; "), list(|said| &said.zh, "；"));
                let entries = if *count == 1 { "entry" } else { "entries" };
                let is = if wrong == 1 { "is" } else { "are" };
                let (en_at, zh_at) = if at.is_empty() {
                    (String::new(), String::new())
                } else {
                    (format!(" for {at}"), format!("取 {at} 时，"))
                };
                sentence(
                    format!("wrong: {wrong} of {count} {entries} {is} not right{en_at}: {en}"),
                    format!("错误：{zh_at}{count} 个元素中有 {wrong} 个不对：{zh}"),
                )
            }
        }
    }
}

impl Difference {
    fn to_sentence(&self) -> Sentence {
        let value = decimals(self.value, 6);
        let Sentence { en, zh } = &self.name;
        if self.is_negated {
            return sentence(
                format!("{en} is {value}, only its sign is wrong"),
                format!("{zh} 为 {value}，只有符号不对"),
            );
        }
        sentence(format!("{en} is {value}"), format!("{zh} 为 {value}"))
    }
}
