//! Words and sentences, in English and in Chinese.

use serde_json::{Value as Json, json};

/// A fixed text in both languages.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) struct Words {
    pub(crate) en: &'static str,
    pub(crate) zh: &'static str,
}

/// A fixed text in both languages.
pub(crate) const fn words(en: &'static str, zh: &'static str) -> Words {
    Words { en, zh }
}

impl Words {
    pub(crate) fn to_json(self) -> Json {
        json!({"en": self.en, "zh": self.zh})
    }
}

/// A sentence with numbers in it, in both languages.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) struct Sentence {
    pub(crate) en: String,
    pub(crate) zh: String,
}

/// A sentence in both languages.
pub(crate) fn sentence(en: impl Into<String>, zh: impl Into<String>) -> Sentence {
    Sentence { en: en.into(), zh: zh.into() }
}

impl Sentence {
    pub(crate) fn to_json(&self) -> Json {
        json!({"en": self.en, "zh": self.zh})
    }
}

/// The language of texts that are said in one only.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub(crate) enum Language {
    #[default]
    English,
    Chinese,
}
