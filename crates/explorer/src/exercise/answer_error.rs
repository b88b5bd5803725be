//! Errors for answers that cannot be parsed.

use crate::words::{Sentence, sentence};
use std::error::Error;
use std::fmt;

/// The reason why an answer cannot be compared: it is not a list of numbers and formulas, or its
/// size is wrong.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct AnswerError {
    /// The problem and a remedy, without a final period.
    pub message: Sentence,
}

impl AnswerError {
    pub(super) fn new(en: impl Into<String>, zh: impl Into<String>) -> Self {
        Self { message: sentence(en, zh) }
    }

    /// Reports a part of an entry that is not allowed there.
    pub(super) fn unexpected(found: &str, entry: &str) -> Self {
        Self::new(
            format!("unexpected `{found}` in `{entry}`"),
            format!("`{entry}` 中的 `{found}` 无法理解"),
        )
    }

    /// Reports an entry that ends too early.
    pub(super) fn incomplete(entry: &str) -> Self {
        Self::new(format!("`{entry}` is incomplete"), format!("`{entry}` 不完整"))
    }

    /// Reports a name that is not a symbol of the exercise.
    pub(super) fn unknown_name(name: &str, letters: &[&str]) -> Self {
        let known = letters.join(", ");
        let (en, zh) = if known.is_empty() {
            ("the answer may contain only numbers".to_owned(), "答案只含数字".to_owned())
        } else {
            (format!("the symbols are {known}"), format!("可用的字母是 {known}"))
        };
        Self::new(
            format!("`{name}` is not a symbol of this exercise; {en}"),
            format!("`{name}` 不是本题的字母；{zh}"),
        )
    }

    /// Reports two symbols of which one is written as the subscript of the other.
    pub(super) fn subscript(written: &str, product: &str) -> Self {
        Self::new(
            format!("`{written}` has a subscript; if it is a product, write `{product}`"),
            format!("`{written}` 是下标写法：若表示乘积，请写成 `{product}`"),
        )
    }

    /// Reports a function whose argument is not in parentheses.
    pub(super) fn missing_brackets(name: &str, argument: &str) -> Self {
        let argument = if argument.is_empty() { "…" } else { argument };
        Self::new(
            format!("`{name}` needs parentheses: write `{name}({argument})`"),
            format!("`{name}` 需要括号：请写成 `{name}({argument})`"),
        )
    }

    /// Reports an entry such as `1/n f`, where `f` may multiply the quotient or the divisor.
    pub(super) fn ambiguous_quotient(entry: &str) -> Self {
        Self::new(
            format!("`{entry}` is ambiguous: write `a/(b*c)` or `a/b*c`"),
            format!("`{entry}` 有两种读法：请写成 `a/(b*c)` 或 `a/b*c`"),
        )
    }
}

impl fmt::Display for AnswerError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message.en)
    }
}

impl Error for AnswerError {}
