//! Words that users know from f3d, Blender, ImageMagick, ffmpeg, three.js or stl-thumb.
//!
//! Each line of `foreign_words.tsv` names a table and contains words without leading hyphens, their
//! owner (`-` for none), and the text to write instead. If a word is on several lines, the first
//! line counts. Single letters keep their case.
//!
//! | table | owner |
//! | --- | --- |
//! | `flag` | the flag that the command must have; none if the advice names another command |
//! | `habit` | the only command to which the line applies; none if it applies to all |
//! | `value` | the flag |
//! | `command` | the preceding command |

/// The content of `foreign_words.tsv`.
const TABLES: &str = include_str!("foreign_words.tsv");

/// A line of a table.
#[derive(Clone, Copy, Debug)]
pub(super) struct ForeignWords {
    words: &'static str,
    /// The owner of the words; empty for none.
    pub(super) owner: &'static str,
    /// The text to write instead.
    pub(super) advice: &'static str,
}

impl ForeignWords {
    /// Whether this is one of the words.
    pub(super) fn has(&self, word: &str) -> bool {
        self.words().any(|known| known == word)
    }

    /// Iterates over the words.
    pub(super) fn words(&self) -> impl Iterator<Item = &'static str> {
        self.words.split(' ')
    }
}

/// Iterates over the lines of a table, in order.
pub(super) fn foreign_words(table: &str) -> impl Iterator<Item = ForeignWords> {
    TABLES.lines().filter_map(move |line| {
        let mut cells = line.split('\t');
        let is_wanted = cells.next()? == table;
        let (words, owner, advice) = (cells.next()?, cells.next()?, cells.next()?);
        let owner = if owner == "-" { "" } else { owner };
        is_wanted.then_some(ForeignWords { words, owner, advice })
    })
}
