//! The languages of the book, and the few words that the tool itself writes.

/// A language of the book.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Language {
    /// The source.
    English,
    /// 中文, simplified characters.
    Chinese,
}

/// Words of the tool in one language.
pub struct Texts {
    /// Link below a figure.
    pub explore: &'static str,
    /// Link to this language from the others.
    pub name: &'static str,
    /// Heading of the table of contents of the printed book.
    pub contents: &'static str,
    /// Columns of the table of topics.
    pub topics: [&'static str; 3],
    /// Between a page and its section.
    pub colon: &'static str,
    /// The word for a topic in the tooltip of its mark.
    pub topic: &'static str,
    /// The label of the links to other languages.
    pub languages: &'static str,
}

impl Language {
    /// All of them.
    pub const ALL: [Self; 2] = [Self::English, Self::Chinese];

    /// The language of a code: `en`, `zh`.
    pub fn parse(code: &str) -> Result<Self, String> {
        let mut all = Self::ALL.into_iter();
        all.find(|language| language.code() == code).ok_or(format!("no language `{code}`: en, zh"))
    }

    /// Its code, in paths and attributes.
    pub fn code(self) -> &'static str {
        match self {
            Self::English => "en",
            Self::Chinese => "zh",
        }
    }

    /// The words that the tool writes in it.
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
