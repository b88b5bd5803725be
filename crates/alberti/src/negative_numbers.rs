//! Negative numbers as values of flags: `--from -1`, `--section -.5,0,0`, `--scale -2`.
//!
//! A word that begins with a hyphen looks like a flag. After a flag that takes a value, such a word
//! is the value if a digit or point follows the hyphen, so that the flag itself can report an
//! invalid number. The two words are joined, as in `--from=-1`, before the command line is parsed.
//! Other words stay unchanged, such as a flag that follows another flag whose value was forgotten.

use clap::{Arg, ArgAction, Command};
use std::ffi::OsString;

/// Returns the words of a command line, with negative numbers joined to the preceding flags.
///
/// The commands are built only if needed, because this takes most of a short command's time.
pub(crate) fn join_negative_numbers(
    words: impl IntoIterator<Item = OsString>,
    program: impl FnOnce() -> Command,
) -> Vec<OsString> {
    let words: Vec<OsString> = words.into_iter().collect();
    if !words.iter().skip(1).any(is_negative_number) {
        return words;
    }
    let mut program = program();
    program.build();
    let command = called_command(&program, &words);
    let mut joined: Vec<OsString> = Vec::new();
    for word in words {
        let flag = joined.last_mut().filter(|last| {
            is_negative_number(&word)
                && last.to_str().is_some_and(|flag| takes_value(command, flag))
        });
        match flag {
            Some(flag) => {
                flag.push("=");
                flag.push(word);
            }
            None => joined.push(word),
        }
    }
    joined
}

/// Whether a word continues as a number after its hyphen: `-1`, `-.5`.
fn is_negative_number(word: &OsString) -> bool {
    let Some(digits) = word.to_str().and_then(|word| word.strip_prefix('-')) else { return false };
    digits.strip_prefix('.').unwrap_or(digits).starts_with(|c: char| c.is_ascii_digit())
}

/// Returns the innermost command that the words name.
pub(crate) fn called_command<'a>(program: &'a Command, words: &[OsString]) -> &'a Command {
    words.iter().skip(1).fold(program, |command, word| {
        let name = word.to_str().unwrap_or_default();
        command.find_subcommand(name).unwrap_or(command)
    })
}

/// Whether a word is a flag of the command that takes one value.
fn takes_value(command: &Command, word: &str) -> bool {
    let is_this = |flag: &Arg| {
        let long = flag.get_long().is_some_and(|name| word.strip_prefix("--") == Some(name));
        let short = word.strip_prefix('-').and_then(|rest| rest.parse().ok());
        let short = short.is_some() && flag.get_short() == short;
        (long || short) && matches!(flag.get_action(), ArgAction::Set | ArgAction::Append)
    };
    command.get_arguments().any(is_this)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::args::Args;
    use clap::CommandFactory as _;
    use clap::error::ErrorKind;

    fn join(words: &[&str]) -> Vec<OsString> {
        let words = words.iter().map(OsString::from);
        join_negative_numbers(words, Args::command)
    }

    /// Parses this command and all its subcommands with each of their flags and a negative number.
    fn check_flags(command: &Command, path: &[String], checked: &mut usize) {
        for flag in command.get_arguments() {
            let Some(long) = flag.get_long() else { continue };
            if !matches!(flag.get_action(), ArgAction::Set | ArgAction::Append) {
                continue;
            }
            for number in ["-1", "-.5", "-2x3", "-1,-2,3"] {
                let mut words = path.to_vec();
                words.extend([format!("--{long}"), number.to_owned()]);
                let words: Vec<&str> = words.iter().map(String::as_str).collect();
                let error = Args::command().try_get_matches_from(join(&words)).err();
                // The number reached the flag: the flag accepts or refuses it.
                let is_value = error.as_ref().is_none_or(|error| {
                    error.kind() != ErrorKind::UnknownArgument
                        && error.kind() != ErrorKind::InvalidSubcommand
                });
                assert!(is_value, "{words:?}: {error:?}");
                *checked += 1;
            }
        }
        for inner in command.get_subcommands().filter(|inner| inner.get_name() != "help") {
            let path = [path, &[inner.get_name().to_owned()]].concat();
            check_flags(inner, &path, checked);
        }
    }

    #[test]
    fn every_flag_with_a_value_accepts_negative_numbers() {
        let mut program = Args::command();
        program.build();
        let mut checked = 0;
        check_flags(&program, &["alberti".to_owned()], &mut checked);
        assert!(checked > 400, "{checked}");
    }

    #[test]
    fn numbers_after_other_words_stay_separate() {
        for words in [
            ["alberti", "matrix", "--json", "-1", "0"],
            ["alberti", "matrix", "1", "-.5", "0"],
            ["alberti", "render", "a.glb", "--scale", "--json"],
        ] {
            assert_eq!(join(&words), words.map(OsString::from));
        }
        let joined = join(&["alberti", "curve", "depth", "--near", "-.5", "--far", "3"]);
        let expected = ["alberti", "curve", "depth", "--near=-.5", "--far", "3"];
        assert_eq!(joined, expected.map(OsString::from));
    }
}
