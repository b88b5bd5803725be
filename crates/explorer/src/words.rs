//! Text in English and Chinese.

use serde_json::{Value as Json, json};

/// Fixed text in both languages.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Words {
    /// The text in English.
    pub en: &'static str,
    /// The text in Chinese, in simplified characters.
    pub zh: &'static str,
}

/// Creates fixed text in both languages.
pub(crate) const fn words(en: &'static str, zh: &'static str) -> Words {
    Words { en, zh }
}

impl Words {
    /// Returns the text in a language.
    #[must_use]
    pub const fn text(self, language: Language) -> &'static str {
        match language {
            Language::English => self.en,
            Language::Chinese => self.zh,
        }
    }

    pub(crate) fn to_json(self) -> Json {
        json!({"en": self.en, "zh": self.zh})
    }
}

/// A sentence with numbers, in both languages.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Sentence {
    /// The sentence in English.
    pub en: String,
    /// The sentence in Chinese, in simplified characters.
    pub zh: String,
}

/// Creates a sentence in both languages.
pub(crate) fn sentence(en: impl Into<String>, zh: impl Into<String>) -> Sentence {
    Sentence { en: en.into(), zh: zh.into() }
}

impl Sentence {
    /// Returns the sentence in a language.
    #[must_use]
    pub fn text(&self, language: Language) -> &str {
        match language {
            Language::English => &self.en,
            Language::Chinese => &self.zh,
        }
    }

    pub(crate) fn to_json(&self) -> Json {
        json!({"en": self.en, "zh": self.zh})
    }
}

/// The language of text that is returned in a single language.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum Language {
    /// English.
    #[default]
    English,
    /// Chinese, in simplified characters.
    Chinese,
}
