//! Corrects a whole command line, with all its mistakes, so that it can be copied.

use super::foreign_words::foreign_words;
use super::given_value::{SIDES, accepted_value, invalid_value, quoted};
use super::unknown_flag::{flag_advice, whole_word, with_value_apart};
use super::wrong_value::meant_value;
use super::{context, has_flag, takes_value};
use crate::format::OutputFormat;
use crate::negative_numbers::{called_command, join_negative_numbers};
use clap::error::{ContextKind, ErrorKind};
use clap::{Command, Error};
use files::visible_text;
use import::FileFormat;
use std::ffi::OsString;
use std::path::Path;

/// A command line without mistakes.
pub(super) struct Correction {
    /// The command line, quoted for a shell.
    pub(super) line: String,
    /// The number of mistakes that were corrected.
    pub(super) count: usize,
}

/// Corrects a command line; returns `None` if a mistake has no single remedy.
///
/// `program` has all its flags declared.
pub(super) fn corrected(words: &[OsString], program: &Command) -> Option<Correction> {
    let words = words.iter().map(|word| word.to_str());
    let mut words: Vec<String> = words.map(|word| Some(word?.to_owned())).collect::<Option<_>>()?;
    if words.iter().any(|word| visible_text(word) != **word || word.contains('\'')) {
        return None;
    }
    for count in 0..12 {
        let typed: Vec<OsString> = words.iter().map(OsString::from).collect();
        let joined = join_negative_numbers(typed.clone(), || program.clone());
        let parsed = program.clone().try_get_matches_from(&joined);
        let output = forgotten_output(&words, called_command(program, &typed));
        words = match (parsed, output) {
            (_, Some(at)) => replaced(&words, at..at + 1, &format!("-o {}", quoted(&words[at]))),
            (Err(error), None) => next_correction(&error, words, program)?,
            (Ok(_), None) if !is_plausible(&words) => return None,
            (Ok(_), None) => {
                let rest = words.iter().skip(1).map(|word| quoted(word));
                let line: Vec<String> =
                    [program.get_name().to_owned()].into_iter().chain(rest).collect();
                return Some(Correction { line: line.join(" "), count });
            }
        };
    }
    None
}

/// Whether a command line that parses will probably run, judging by its output and projection.
fn is_plausible(words: &[String]) -> bool {
    let after = |flags: [&str; 2]| {
        words.windows(2).find(|pair| flags.contains(&pair[0].as_str())).map(|pair| &*pair[1])
    };
    let is_parallel = after(["--projection", "--projection"]).is_some_and(|it| it != "perspective");
    let is_written =
        |name: &str| name.ends_with(".gif") || OutputFormat::from_path(Path::new(name)).is_ok();
    after(["-o", "--output"]).is_none_or(|name| is_written(name) && !name.contains(['#', '%']))
        && !(is_parallel && after(["--fov", "--fov"]).is_some())
}

/// Returns the place of an output that has no `-o`, as in `alberti render a.glb a.png`.
pub(super) fn forgotten_output(words: &[String], command: &Command) -> Option<usize> {
    let is_output_flag = |word: &String| word.starts_with("-o") || word.starts_with("--output");
    if !has_flag(command, "output") || words.iter().any(is_output_flag) {
        return None;
    }
    let is_file = |word: &str| FileFormat::from_extension(Path::new(word)).is_some();
    let input = words.iter().position(|word| is_file(word) || word.ends_with(".ron"))?;
    let is_output = |at: &usize| {
        let (before, word) = (&words[at - 1], Path::new(&words[*at]));
        let is_value = before.strip_prefix("--").is_some_and(|flag| takes_value(command, flag));
        let is_word = words[*at].starts_with(['-', '+']);
        !is_word && !is_value && OutputFormat::is_known(word) && !word.exists()
    };
    (input + 1..words.len()).rev().find(is_output)
}

/// Corrects the mistake in an error.
fn next_correction(error: &Error, words: Vec<String>, program: &Command) -> Option<Vec<String>> {
    let typed: Vec<OsString> = words.iter().map(OsString::from).collect();
    let command = called_command(program, &typed);
    match error.kind() {
        ErrorKind::InvalidSubcommand => {
            correct_command(context(error, ContextKind::InvalidSubcommand)?, &words)
        }
        ErrorKind::UnknownArgument => {
            let word = whole_word(context(error, ContextKind::InvalidArg)?, &typed);
            if command.get_name() == program.get_name() {
                let stem = word.split('=').next()?.strip_prefix("--")?;
                let is_known = has_flag(program.find_subcommand("render")?, stem);
                return is_known.then(|| replaced(&words, 1..1, "render"));
            }
            correct_flag(&word, words, command)
        }
        ErrorKind::InvalidValue | ErrorKind::ValueValidation => {
            let (flag, given) = invalid_value(error)?;
            let meant = meant_value(&flag, &given, &words, command)?;
            let at = words.iter().position(|word| {
                word.strip_prefix("--").is_some_and(|word| word.split('=').next() == Some(&flag))
            })?;
            let end = at + 1 + value_words(&words, at, &given);
            Some(replaced(&words, at..end, &format!("--{flag} {}", quoted(&meant))))
        }
        _ => None,
    }
}

/// Replaces another program's command, or inserts `render` before a file.
fn correct_command(word: &str, words: &[String]) -> Option<Vec<String>> {
    let at = words.iter().position(|it| it == word)?;
    let mut commands = foreign_words("command");
    let Some(row) = commands.find(|row| row.owner == "alberti" && row.has(word)) else {
        return Path::new(word).is_file().then(|| replaced(words, at..at, "render"));
    };
    let line = row.advice.split('`').find_map(|line| line.strip_prefix("alberti "))?;
    // The example's files and output are replaced by the given ones.
    let example: Vec<&str> = line.split(' ').collect();
    let name =
        example.first().filter(|name| ["render", "batch", "info", "check"].contains(name))?;
    let folder = example.windows(2).find(|pair| pair[0] == "--out-dir" || pair[0] == "--size");
    let flags = folder.map_or(String::new(), |pair| format!(" {}", pair.join(" ")));
    let mut corrected = replaced(words, at..=at, &format!("{name}{flags}"));
    if *name == "batch" {
        // A batch names its pictures itself.
        corrected.retain(|word| word.starts_with('-') || !OutputFormat::is_known(Path::new(word)));
    }
    Some(corrected)
}

/// Replaces a flag that the command does not have, and its value.
fn correct_flag(word: &str, words: Vec<String>, command: &Command) -> Option<Vec<String>> {
    let (word, words) = with_value_apart(word.to_owned(), words);
    let name = word.split('=').next().unwrap_or(&word);
    let at = words.iter().position(|it| it == name || it.starts_with(&format!("{name}=")))?;
    let stem = if name == "-o" { "output" } else { name.trim_start_matches('-') };
    let called = words.iter().position(|it| it == command.get_name());
    let is_ours = (name == "-o" || name.starts_with("--")) && has_flag(command, stem);
    if is_ours && called > Some(at) {
        let has_value = takes_value(command, stem) && !word.contains('=');
        let mut words = words;
        let flag: Vec<String> = words.drain(at..=at + usize::from(has_value)).collect();
        words.extend(flag);
        return Some(words);
    }
    let advice = flag_advice(name, &word, &words, command);
    let is_omitted = advice.contains("omit it");
    let starts = ["use `", "it needs two hyphens here: `", "did you mean `"];
    let remedy = starts.iter().find_map(|start| advice.split_once(start));
    let text = remedy.and_then(|(_, rest)| rest.split('`').next()).filter(|_| !is_omitted);
    let given = words.get(at + 1).filter(|_| !word.contains('=')).cloned().unwrap_or_default();
    if is_omitted {
        let is_value = Path::new(&given).extension().is_none();
        let count = if is_value { value_words(&words, at, &given) } else { 0 };
        return Some(replaced(&words, at..at + 1 + count, ""));
    }
    let text = text?;
    let flag = text.split([' ', '=']).next()?.trim_start_matches('-').to_owned();
    let is_spelling = advice.contains(starts[2]);
    let is_switch = ["true", "false", "on", "off", "yes", "no"].contains(&given.as_str());
    let is_taken = !is_spelling
        && (is_switch
            || given.parse::<f64>().is_ok()
            || accepted_value(&flag, &given, command).is_some_and(|it| text.contains(&it)));
    let count = if is_taken { value_words(&words, at, &given) } else { 0 };
    let value = word.split_once('=').filter(|_| is_spelling).map(|(_, value)| value);
    let text = value.map_or(text.to_owned(), |value| format!("{text}={value}"));
    let words = replaced(&words, at..at + 1 + count, &text);
    Some(without_repeated_flag(words, &flag))
}

/// Returns how many words after a flag are its value, such as 2 in `--size 64 48`.
fn value_words(words: &[String], at: usize, given: &str) -> usize {
    let after = words.get(at + 1..).unwrap_or_default();
    let is_number = |word: &&String| word.parse::<f64>().is_ok();
    if words[at].contains('=') || given.is_empty() || after.first().is_none_or(|it| it != given) {
        return 0;
    }
    let is_flag = given.starts_with('-') && given.parse::<f64>().is_err();
    let numbers = after.iter().take_while(|it| is_number(it) || ["x", "by"].contains(&it.as_str()));
    if is_flag { 0 } else { numbers.count().max(1) }
}

/// Replaces a range of words by the words of a text, in which values may be quoted.
fn replaced(words: &[String], range: impl std::ops::RangeBounds<usize>, text: &str) -> Vec<String> {
    let mut parts = text.split('\'').enumerate().flat_map(|(number, part)| match number % 2 {
        0 => part.split(' ').filter(|word| !word.is_empty()).map(str::to_owned).collect(),
        _ => vec![part.to_owned()],
    });
    let mut words = words.to_vec();
    words.splice(range, parts.by_ref().collect::<Vec<String>>());
    words
}

/// Removes a flag that another flag made superfluous: `--height` next to `--size`, which replaced
/// `--width`, and all but the last of flags with the same name.
fn without_repeated_flag(words: Vec<String>, flag: &str) -> Vec<String> {
    let name = format!("--{flag}");
    let is_side = |word: &str| flag == "size" && SIDES.as_flattened().contains(&word);
    let mut same = (0..words.len()).filter(|at| words[*at] == name);
    let repeated = same.next().filter(|_| same.next().is_some() && flag != "overlay");
    let side = words.iter().position(|word| is_side(word.split('=').next().unwrap_or(word)));
    let Some(at) = repeated.or(side) else { return words };
    let is_value = words.get(at + 1).is_some_and(|word| !word.starts_with("--"));
    let count = usize::from(is_value && !words[at].contains('='));
    replaced(&words, at..=at + count, "")
}
