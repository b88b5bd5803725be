//! The languages of the book, and the labels that the tool adds to pages.

/// A language of the book.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Language {
    /// English, the source language.
    English,
    /// Chinese in simplified characters.
    Chinese,
}

/// The tool's labels in one language.
pub struct Texts {
    /// The text of the link below a figure.
    pub explore: &'static str,
    /// The text of the links from other editions to this one.
    pub name: &'static str,
    /// The heading above the table of contents of the printed book.
    pub contents: &'static str,
    /// The column headings of the topic table.
    pub topics: [&'static str; 3],
    /// The separator between a page title and a section title, also used in tooltips.
    pub colon: &'static str,
    /// The word "topic" in this language, used in the tooltips of topic marks.
    pub topic: &'static str,
    /// The label of the links to other editions.
    pub languages: &'static str,
}

impl Language {
    /// All languages.
    pub const ALL: [Self; 2] = [Self::English, Self::Chinese];

    /// Returns the language with the given code, `en` or `zh`.
    pub fn parse(code: &str) -> Result<Self, String> {
        let mut all = Self::ALL.into_iter();
        all.find(|language| language.code() == code)
            .ok_or(format!("unknown language `{code}`; expected en or zh"))
    }

    /// Returns the language code, for paths and attributes.
    pub fn code(self) -> &'static str {
        match self {
            Self::English => "en",
            Self::Chinese => "zh",
        }
    }

    /// Returns the tool's labels in this language.
    pub fn texts(self) -> Texts {
        match self {
            Self::English => Texts {
                explore: "Change it in the explorer",
                name: "English",
                contents: "Contents",
                topics: ["id", "topic", "where"],
                colon: ": ",
                topic: "Topic",
                languages: "Languages",
            },
            Self::Chinese => Texts {
                explore: "在交互演示中打开",
                name: "中文",
                contents: "目录",
                topics: ["编号", "主题", "位置"],
                colon: "：",
                topic: "主题",
                languages: "语言",
            },
        }
    }
}
