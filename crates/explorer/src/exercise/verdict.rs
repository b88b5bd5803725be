//! Verdicts on answers.

use super::answer_text::AnswerShape;
use super::mistake::Mistake;
use crate::number_text::decimals;
use crate::words::{Sentence, sentence};

/// The verdict on an answer.
#[derive(Clone, Debug)]
pub enum Verdict {
    /// The answer is correct.
    Right,
    /// The answer matches a known mistake.
    Mistaken(&'static Mistake),
    /// The answer is correct to about three digits.
    Rounded,
    /// Some entries are wrong.
    Different {
        /// The entries that differ.
        differences: Vec<Difference>,
        /// The total number of entries.
        count: usize,
        /// Values of the symbols for which the answer differs.
        letters: Vec<(&'static str, f64)>,
    },
}

/// A wrong entry.
#[derive(Clone, PartialEq, Debug)]
pub struct Difference {
    /// The index of the row or part, from 0.
    pub row: usize,
    /// The position in the row, from 0.
    pub column: usize,
    /// The name of the entry.
    pub name: Sentence,
    /// The answer's value for the entry, at the verdict's values of the symbols.
    pub value: f64,
    /// Whether only the sign is wrong.
    pub is_negated: bool,
}

/// Returns the Chinese name of a named entry. Symbols are not translated.
pub(super) fn chinese_name(name: &'static str) -> &'static str {
    match name {
        "pixels" => "像素数",
        "outcode" => "区域码",
        letters => letters,
    }
}

/// Returns the name of an entry, or its position if it has no name.
pub(super) fn entry_name(shape: AnswerShape, row: usize, column: usize) -> Sentence {
    let (i, j) = (row + 1, column + 1);
    match shape {
        AnswerShape::Matrix(..) => {
            sentence(format!("row {i}, column {j}"), format!("第 {i} 行第 {j} 列"))
        }
        AnswerShape::Parts(parts) => {
            let name = parts.get(row).and_then(|names| names.get(column)).unwrap_or(&"");
            match parts.len() {
                1 => sentence(*name, chinese_name(name)),
                _ => sentence(format!("{name} of part {i}"), format!("第 {i} 部分的 {name}")),
            }
        }
    }
}

impl Verdict {
    /// Whether the answer is correct.
    #[must_use]
    pub const fn is_right(&self) -> bool {
        matches!(self, Self::Right)
    }

    /// Returns the verdict as a sentence without a final period.
    #[must_use]
    pub fn sentence(&self) -> Sentence {
        match self {
            Self::Right => sentence("correct", "正确"),
            Self::Mistaken(mistake) => {
                let words = mistake.sentence;
                sentence(format!("incorrect: {}", words.en), format!("不对：{}", words.zh))
            }
            Self::Rounded => sentence(
                "incorrect: this is rounded; enter a fraction, a root, or at least ten digits",
                "不对：舍入过多：请写成分数、根式，或至少十位数字",
            ),
            Self::Different { differences, count, letters } => {
                different(differences, *count, letters)
            }
        }
    }
}

/// Returns the sentence about an answer with some wrong entries.
fn different(differences: &[Difference], count: usize, letters: &[(&str, f64)]) -> Sentence {
    let said: Vec<Sentence> = differences.iter().map(Difference::to_sentence).collect();
    let list =
        |text: fn(&Sentence) -> &str, comma| said.iter().map(text).collect::<Vec<_>>().join(comma);
    let (mut en, mut zh) = (list(|said| &said.en, "; "), list(|said| &said.zh, "；"));
    let at = |comma| {
        let letter = |(name, value): &(&str, f64)| format!("{name} = {}", decimals(*value, 6));
        letters.iter().map(letter).collect::<Vec<_>>().join(comma)
    };
    if !letters.is_empty() {
        en = format!("for {}, {en}", at(", "));
        zh = format!("取 {} 时，{zh}", at("，"));
    }
    let wrong = differences.len();
    let place = if wrong > 1 { format!(" in {wrong} of {count} entries") } else { String::new() };
    if wrong > 1 {
        zh = format!("{count} 个元素中错了 {wrong} 个：{zh}");
    }
    sentence(format!("incorrect{place}: {en}"), format!("不对：{zh}"))
}

impl Difference {
    fn to_sentence(&self) -> Sentence {
        let value = decimals(self.value, 6);
        let Sentence { en, zh } = &self.name;
        let (mut en, mut zh) = (
            format!("your value for {en} is {value}"),
            format!("你的{}等于 {value}", between_han(zh)),
        );
        if self.is_negated {
            en += " (only the sign is wrong)";
            zh += "，只有符号不对";
        }
        sentence(en, zh)
    }
}

/// Returns a name for use in a Chinese sentence, with spaces where it begins or ends in ASCII.
fn between_han(name: &str) -> String {
    let blank = |c: Option<char>| if c.is_some_and(|c| c.is_ascii()) { " " } else { "" };
    format!("{}{name}{}", blank(name.chars().next()), blank(name.chars().next_back()))
}
