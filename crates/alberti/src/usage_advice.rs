//! Advice on wrong command lines: flags and values of other programs lead to those of this one.
//!
//! clap compares the letters of words, which finds misspellings and otherwise misleads:
//! `--resolution` is not like `--size`. What people bring from other programs is in the tables of
//! `foreign_words`, and is looked up first.

mod foreign_words;
mod given_value;

use super::args::Args;
use super::help_groups;
use super::negative_numbers::called_command;
use clap::builder::StyledStr;
use clap::error::{ContextKind, ContextValue, ErrorKind};
use clap::{Command, CommandFactory as _, Error, FromArgMatches as _};
use foreign_words::foreign_words;
use given_value::{
    Given, accepted_value, foreign_value, invalid_value, quoted, similar_color, value_of,
    with_given_value,
};
use scene_file::closest_name;
use std::ffi::OsString;
use std::path::Path;

/// Parses the command line.
///
/// # Errors
/// What is wrong with it, with advice.
pub(crate) fn parse_args(words: &[OsString]) -> Result<Args, Error> {
    let program = help_groups::group_commands(Args::command());
    let parsed = program.try_get_matches_from(words).and_then(|matches| {
        let args = Args::from_arg_matches(&matches);
        args.map_err(|error| error.format(&mut Args::command()))
    });
    parsed.map_err(|usage| {
        let mut program = Args::command();
        program.build();
        advise(usage, words, &program)
    })
}

/// The error of clap with a tip that helps, or an error in its place.
///
/// `program` has all its flags declared; `words` are those of the command line.
fn advise(mut error: Error, words: &[OsString], program: &Command) -> Error {
    // `to pass '--zoom' as a value, use '-- --zoom'` is never what was meant.
    error.remove(ContextKind::Suggested);
    let message = match error.kind() {
        ErrorKind::UnknownArgument => advise_on_flag(&error, words, program),
        ErrorKind::InvalidSubcommand => advise_on_command(&error, words, program),
        ErrorKind::TooManyValues => advise_on_switch(&error),
        ErrorKind::InvalidValue | ErrorKind::ValueValidation => {
            advise_on_value(&mut error, words, program)
        }
        ErrorKind::ArgumentConflict => {
            advise_on_conflict(&mut error);
            None
        }
        _ => None,
    };
    match message {
        Some(message) => Error::raw(error.kind(), message + "\n").with_cmd(program),
        None => error,
    }
}

/// The string of a context of an error.
fn context(error: &Error, kind: ContextKind) -> Option<&str> {
    match error.get(kind) {
        Some(ContextValue::String(text)) => Some(text),
        _ => None,
    }
}

/// What to write in place of a flag that does not exist.
fn advise_on_flag(error: &Error, words: &[OsString], program: &Command) -> Option<String> {
    let command = called_command(program, words);
    let word = whole_word(context(error, ContextKind::InvalidArg)?, words);
    let words: Vec<String> = words.iter().map(|it| it.to_string_lossy().into_owned()).collect();
    let name = word.split('=').next().unwrap_or(&word).to_owned();
    let stem = name.trim_start_matches('-');
    let before_command = command.get_name() == program.get_name();
    if let Some(advice) = before_command.then(|| advise_on_no_window(&name, &words)).flatten() {
        return Some(advice);
    }
    let is_ours = has_flag(command, stem);
    let help = if !name.starts_with("--") && is_ours {
        let value = value_of(&word, &words).filter(|_| takes_value(command, stem));
        let meant = value.as_ref().and_then(|value| accepted_value(stem, value, command));
        let text = meant.as_ref().map_or(String::new(), |meant| format!(" {}", quoted(meant)));
        if meant == value || meant.is_none() {
            return Some(format!("`{name}` needs two hyphens here: `--{stem}{text}`"));
        }
        Some(format!("use `--{stem}{text}`"))
    } else if let Some(format) = chosen_format(stem, &words, command) {
        Some(format!("use `--format {format}`"))
    } else if let Some(help) = foreign_habit(stem, command) {
        Some(help.to_owned())
    } else {
        foreign_flag(stem, command).map(|advice| {
            match with_given_value(advice, &word, &words, command) {
                _ if advice.starts_with("alberti ") => format!("run `{advice}`"),
                Given::Nothing => format!("use `{advice}`"),
                Given::Fits(advice) => format!("use `{advice}`"),
                Given::FitsNot(flag) => format!("the flag here is `{flag}`, as in `{advice}`"),
            }
        })
    };
    if let Some(help) = help {
        let command = full_name(command);
        return Some(format!("`{name}` is not a flag of `{command}`; {help}"));
    }
    if let Some(advice) = before_command.then(|| advise_before_command(&name, program)).flatten() {
        return Some(advice);
    }
    if !name.starts_with('-') && Path::new(&name).extension().is_some() {
        let command = full_name(command);
        return Some(format!(
            "`{command}` reads one file, and `{name}` is a second one; for several files use a loop: `for f in *.glb; do {command} \"$f\"; done`"
        ));
    }
    if let Some(advice) = advise_on_detached_value(&words, command) {
        return Some(advice);
    }
    let names: Vec<&str> = command.get_arguments().filter_map(|flag| flag.get_long()).collect();
    let similar = closest_name(stem, &names).filter(|similar| !differs_widely(stem, similar));
    let command = full_name(command);
    let help = match similar {
        Some(similar) => format!("did you mean `--{similar}`?"),
        None => format!("`{command} --help` lists its flags"),
    };
    Some(format!("`{name}` is not a flag of `{command}`; {help}"))
}

/// What to do about a flag that takes no value and has one, as in `--ambient-occlusion=true`.
fn advise_on_switch(error: &Error) -> Option<String> {
    let flag = context(error, ContextKind::InvalidArg)?;
    let value = context(error, ContextKind::InvalidValue)?;
    Some(format!("`{flag}` takes no value: leave out `={value}`"))
}

/// The format that `-f svg` chooses in other programs, unless it is the number of a frame.
fn chosen_format(stem: &str, words: &[String], command: &Command) -> Option<String> {
    let value = value_of("-f", words).filter(|_| stem == "f" && has_flag(command, "format"))?;
    accepted_value("format", &value, command)
}

/// What to do about Blender's `-b` or `--background` before a file: it draws without a window.
fn advise_on_no_window(name: &str, words: &[String]) -> Option<String> {
    let file = value_of(name, words).filter(|value| Path::new(value).extension().is_some())?;
    if !matches!(name, "-b" | "--background") {
        return None;
    }
    let help = if file.to_ascii_lowercase().ends_with(".blend") {
        "export the .blend file as .glb and run `alberti render model.glb`".to_owned()
    } else {
        format!("run `alberti render {}`", quoted(&file))
    };
    let color = match name {
        "-b" => "",
        _ => ", whose `--background` is the color behind the model",
    };
    Some(format!("nothing opens a window here, so leave `{name}` out: {help}{color}"))
}

/// What to do about a flag before any command.
fn advise_before_command(name: &str, program: &Command) -> Option<String> {
    let stem = if name == "-o" { "output" } else { name.strip_prefix("--")? };
    has_flag(program.find_subcommand("render")?, stem).then(|| {
        format!(
            "`{name}` is not a flag of `alberti` itself; flags come after the command, as in `alberti render model.glb {name} …`"
        )
    })
}

/// The word that was typed: of `-resize` the parser tells `-r` alone.
fn whole_word(told: &str, words: &[OsString]) -> String {
    let is_long = |word: &&str| {
        !word.starts_with("--")
            && word.starts_with(told)
            && word[1..].chars().all(|c| c.is_alphanumeric() || ":_-".contains(c))
    };
    let typed = (told.chars().count() == 2 && !told.starts_with("--"))
        .then(|| words.iter().filter_map(|word| word.to_str()).find(is_long));
    typed.flatten().unwrap_or(told).to_owned()
}

/// What to do about a flag of another program that has no counterpart, or several.
fn foreign_habit(word: &str, command: &Command) -> Option<&'static str> {
    let word = with_hyphens(word);
    let holds = |owner: &str| owner.is_empty() || owner == command.get_name();
    foreign_words("habit").find(|row| holds(row.owner) && row.has(&word)).map(|row| row.advice)
}

/// A name as the tables have it: single letters keep their case.
fn with_hyphens(word: &str) -> String {
    match word.chars().count() {
        1 => word.to_owned(),
        _ => word.to_ascii_lowercase().replace('_', "-"),
    }
}

/// Whether two names are too different for one to be a misspelling of the other: more than a third
/// of the letters of the longer one are missing in the other, wherever they stand.
fn differs_widely(word: &str, name: &str) -> bool {
    let mut rest: Vec<char> = name.chars().collect();
    let shared = word.chars().filter(|letter| {
        let at = rest.iter().position(|other| other == letter);
        at.map(|at| rest.swap_remove(at)).is_some()
    });
    let longest = word.chars().count().max(name.chars().count());
    3 * shared.count() < 2 * longest
}

/// The name of a command with those before it, such as `alberti scene init`.
fn full_name(command: &Command) -> String {
    command.get_bin_name().unwrap_or(command.get_name()).to_owned()
}

/// Whether a command has a flag of this long name.
fn has_flag(command: &Command, name: &str) -> bool {
    command.get_arguments().any(|flag| flag.get_long() == Some(name))
}

/// Whether a flag of a command takes a value.
fn takes_value(command: &Command, name: &str) -> bool {
    let flag = command.get_arguments().find(|flag| flag.get_long() == Some(name));
    flag.is_some_and(|flag| flag.get_action().takes_values())
}

/// What to write for a flag of another program.
fn foreign_flag(word: &str, command: &Command) -> Option<&'static str> {
    let word = with_hyphens(word);
    // What draws has a style.
    let is_known = |flag: &str| has_flag(command, if flag.is_empty() { "style" } else { flag });
    foreign_words("flag").find(|row| is_known(row.owner) && row.has(&word)).map(|row| row.advice)
}

/// What to write for a value that was given apart from a flag that wants an equals sign, as in
/// `--turntable 180`.
fn advise_on_detached_value(words: &[String], command: &Command) -> Option<String> {
    words.windows(2).find_map(|pair| {
        let [flag, value] = pair else { return None };
        let name = flag.strip_prefix("--")?;
        let wants_equals =
            |known: &clap::Arg| known.get_long() == Some(name) && known.is_require_equals_set();
        value.parse::<f64>().ok()?;
        command.get_arguments().any(wants_equals).then(|| {
            format!("the value of `{flag}` comes after an equals sign: write `{flag}={value}`")
        })
    })
}

/// What to do with a file, a folder or another program's command in the place of a command.
fn advise_on_command(error: &Error, words: &[OsString], program: &Command) -> Option<String> {
    let word = context(error, ContextKind::InvalidSubcommand)?;
    let command = match called_command(program, words) {
        help if help.get_name() == "help" => program,
        command => command,
    };
    let mut commands = foreign_words("command");
    let meant = commands.find(|row| row.owner == command.get_name() && row.has(word));
    if let Some(advice) = meant.map(|row| row.advice) {
        return Some(format!("`{word}` is not a command of `{}`; {advice}", full_name(command)));
    }
    let path = Path::new(word);
    if !path.exists() && path.extension().is_none() {
        let shown = command.get_subcommands().filter(|command| !command.is_hide_set());
        let names: Vec<&str> = shown.map(Command::get_name).collect();
        let command = full_name(command);
        let help = match closest_name(word, &names).filter(|name| !differs_widely(word, name)) {
            Some(name) => format!("did you mean `{name}`?"),
            None => format!("`{command} --help` lists the commands"),
        };
        return Some(format!("`{word}` is not a command of `{command}`; {help}"));
    }
    if path.is_dir() {
        return Some(format!(
            "`{word}` is a folder, not a command; to render the models in it, run `{} batch {word} --out-dir pictures`",
            program.get_name()
        ));
    }
    Some(format!(
        "`{word}` is a file, not a command; to render it, run `{} render {word}`",
        program.get_name()
    ))
}

/// Puts the value that another program's one means in the place of clap's tip; says more where a
/// flag of this name has another meaning.
fn advise_on_value(error: &mut Error, words: &[OsString], program: &Command) -> Option<String> {
    let (flag, given) = invalid_value(error)?;
    if flag == "color" && given.contains([',', '#']) {
        return Some(format!(
            "`--color` says when messages are colored (auto, always or never), and does not accept \
             {given}; the colors of a model come from its file, and `--style clay` ignores them"
        ));
    }
    if flag == "background" && given.is_empty() {
        return Some(
            "`--background` is the color behind the model, such as `--background white` or \
             `--background transparent`; nothing opens a window here"
                .to_owned(),
        );
    }
    let command = called_command(program, words);
    if flag == "view" && given.contains(',') && has_flag(command, "views") {
        return Some(format!(
            "`--view` takes one direction; `--views {given}` draws a picture from each"
        ));
    }
    if let Some(expected) = expected_number(error) {
        return Some(format!("invalid value '{given}' for '--{flag}': {expected}"));
    }
    if let Some(help) = other_file_help(&flag, &given) {
        return Some(format!("invalid value '{given}' for '--{flag}': {help}"));
    }
    let meant = foreign_value(&flag, &given).or_else(|| accepted_value(&flag, &given, command));
    if let Some(meant) = meant.or_else(|| similar_color(&flag, &given)) {
        error.remove(ContextKind::SuggestedValue);
        let tip = StyledStr::from(format!("write `--{flag} {}`", quoted(&meant)));
        error.insert(ContextKind::Suggested, ContextValue::StyledStrs(vec![tip]));
    } else if context(error, ContextKind::SuggestedValue)
        .is_some_and(|similar| differs_widely(&given, similar))
    {
        error.remove(ContextKind::SuggestedValue);
    }
    None
}

/// What to do with a file that a flag does not take, but that could be made into one.
fn other_file_help(flag: &str, given: &str) -> Option<String> {
    let path = Path::new(given);
    let ending = path.extension()?.to_str()?.to_ascii_lowercase();
    let is_picture = ["exr", "png", "jpg", "jpeg", "webp", "hdr"].contains(&ending.as_str());
    match flag {
        "environment" if is_picture => {
            let hdr = path.with_extension("hdr");
            let hdr = quoted(&hdr.to_string_lossy());
            let given = quoted(given);
            Some(format!(
                "environments are read from .hdr files; convert it, for example with ImageMagick: \
                 `magick {given} {hdr}`"
            ))
        }
        "background" if is_picture => Some(format!(
            "expected a color; a scene file puts a picture behind the model, as in \
             `image: (background: Picture(path: \"{given}\"))`"
        )),
        _ => None,
    }
}

/// The numbers that a flag takes, where clap gives them in the notation of Rust: `0 is not in
/// 1..=100000`.
fn expected_number(error: &Error) -> Option<String> {
    let reason = std::error::Error::source(error)?.to_string();
    if let Some((_, range)) = reason.split_once(" is not in ") {
        let (least, most) = range.split_once("..=")?;
        return Some(format!("expected a whole number from {least} to {most}"));
    }
    let is_whole = ["invalid digit", "number too large", "number too small"];
    let text = if reason.starts_with(is_whole[0]) {
        "expected a whole number, without a unit"
    } else {
        "the number is out of range"
    };
    is_whole.iter().any(|start| reason.starts_with(start)).then(|| text.to_owned())
}

/// Says what to do about two flags that exclude each other.
fn advise_on_conflict(error: &mut Error) {
    let is_repeated = error.get(ContextKind::InvalidArg) == error.get(ContextKind::PriorArg);
    let tip = if is_repeated { "give it once" } else { "keep one of them" };
    let tip = ContextValue::StyledStrs(vec![StyledStr::from(tip)]);
    error.insert(ContextKind::Suggested, tip);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::args::Args;

    /// All commands with their flags.
    fn built_program() -> Command {
        let mut program = Args::command();
        program.build();
        program
    }

    /// Each piece of advice parses as it is printed, on a command that has the flag; no name in the
    /// table is a flag that the command has.
    #[test]
    fn advice_is_accepted_by_the_commands_that_get_it() {
        let program = built_program();
        for row in foreign_words("flag") {
            let advice = row.advice;
            let flag = if row.owner.is_empty() { "style" } else { row.owner };
            let with_flag = program.get_subcommands().filter(|command| has_flag(command, flag));
            let mut count = 0;
            for command in with_flag.filter(|command| !command.is_hide_set()) {
                for word in row.words() {
                    let is_own = has_flag(command, word);
                    assert!(!is_own || foreign_flag(word, command).is_some(), "{word}");
                }
                count += 1;
            }
            assert!(count > 0, "no command has --{flag}, for {advice}");
            if !advice.starts_with("alberti")
                && has_flag(program.find_subcommand("render").expect("render"), flag)
            {
                let words = format!("alberti render a.glb {}", advice.replace('\'', ""));
                let parsed = Args::command().try_get_matches_from(words.split(' '));
                assert!(parsed.is_ok(), "{advice}: {:?}", parsed.err());
            }
        }
    }

    #[test]
    fn every_value_of_the_table_exists() {
        let program = built_program();
        let render = program.find_subcommand("render").expect("render");
        for row in foreign_words("value") {
            let value = row.advice;
            let flag = render
                .get_arguments()
                .find(|known| known.get_long() == Some(row.owner))
                .expect("a flag");
            let names: Vec<String> = flag
                .get_possible_values()
                .iter()
                .map(|known| known.get_name().to_owned())
                .collect();
            assert!(accepted_value(row.owner, value, render).is_some(), "{value}");
            for word in row.words() {
                assert!(!names.iter().any(|name| name == word), "{word} is a value itself");
            }
        }
    }

    /// What habits are answered with exists: each command between backquotes parses, and each flag
    /// is one of a command.
    #[test]
    fn what_habits_lead_to_exists() {
        let program = built_program();
        let exists = |flag: &str| program.get_subcommands().any(|it| has_flag(it, flag));
        for row in foreign_words("habit") {
            let (only, help) = (row.owner, row.advice);
            assert!(only.is_empty() || program.find_subcommand(only).is_some(), "{only}");
            for word in row.words() {
                assert_eq!(with_hyphens(word), word, "names are looked up in this form");
            }
            for quoted in help.split('`').skip(1).step_by(2) {
                let command = quoted.split(" > ").next().unwrap_or(quoted);
                let words: Vec<&str> = command.split(' ').collect();
                // Flags of the program itself end it with what they print.
                if words.iter().any(|word| ["--help", "--version"].contains(word)) {
                    continue;
                }
                let names = words.iter().filter_map(|word| word.split('=').next());
                let flags = names.filter_map(|word| word.strip_prefix("--"));
                let unknown: Vec<&str> = flags.filter(|flag| !exists(flag)).collect();
                assert!(unknown.is_empty(), "{unknown:?} in {help}");
                if words[0] == "alberti" {
                    let parsed = Args::command().try_get_matches_from(&words);
                    assert!(parsed.is_ok(), "{quoted}: {:?}", parsed.err());
                }
            }
        }
    }
}
