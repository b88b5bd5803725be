//! Words that people bring from f3d, Blender, ImageMagick, ffmpeg, three.js or stl-thumb.
//!
//! They are lines of `foreign_words.tsv`: the table, the words without hyphens at the front, what
//! they belong to (`-` for nothing), and what to write. Of several lines with a word the first
//! counts. Single letters keep their case.
//!
//! | table | belongs to |
//! | --- | --- |
//! | `flag` | the flag that the command must have; none if the advice names another command |
//! | `habit` | the only command for which it holds; none if it holds for all |
//! | `value` | the flag |
//! | `command` | the command before it |

/// The lines of the file.
const TABLES: &str = include_str!("foreign_words.tsv");

/// A line of a table.
#[derive(Clone, Copy, Debug)]
pub(super) struct ForeignWords {
    words: &'static str,
    /// What they belong to; empty for nothing.
    pub(super) owner: &'static str,
    /// What to write.
    pub(super) advice: &'static str,
}

impl ForeignWords {
    /// Whether this is one of the words.
    pub(super) fn has(&self, word: &str) -> bool {
        self.words().any(|known| known == word)
    }

    /// The words, one by one.
    pub(super) fn words(&self) -> impl Iterator<Item = &'static str> {
        self.words.split(' ')
    }
}

/// The lines of a table, in their order.
pub(super) fn foreign_words(table: &str) -> impl Iterator<Item = ForeignWords> {
    TABLES.lines().filter_map(move |line| {
        let mut cells = line.split('\t');
        let is_wanted = cells.next()? == table;
        let (words, owner, advice) = (cells.next()?, cells.next()?, cells.next()?);
        let owner = if owner == "-" { "" } else { owner };
        is_wanted.then_some(ForeignWords { words, owner, advice })
    })
}
