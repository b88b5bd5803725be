//! Advice on wrong command lines: translates flags and values from other programs into their
//! counterparts here.
//!
//! clap compares words letter by letter, which finds misspellings but misleads otherwise:
//! `--resolution` does not resemble `--size`. Words from other programs are in the tables of
//! `foreign_words`, which are searched first.

mod correction;
mod foreign_words;
mod given_value;
mod unknown_flag;
mod wrong_value;

use super::args::Args;
use super::format::OutputFormat;
use super::help_groups;
use super::negative_numbers::called_command;
use clap::builder::StyledStr;
use clap::error::{ContextKind, ContextValue, ErrorKind};
use clap::{Command, CommandFactory as _, Error, FromArgMatches as _};
use correction::{Correction, corrected};
use foreign_words::foreign_words;

use files::visible_text;
use given_value::quoted;
use import::FileFormat;
use scene_file::closest_name;
use std::ffi::OsString;
use std::path::Path;
use unknown_flag::advise_on_flag;
use wrong_value::advise_on_value;

/// Parses the command line.
///
/// # Errors
/// Returns an error with advice if the command line is wrong.
pub(crate) fn parse_args(words: &[OsString]) -> Result<Args, Error> {
    let program = help_groups::group_commands(Args::command());
    let parsed = program.try_get_matches_from(words).and_then(|matches| {
        let args = Args::from_arg_matches(&matches);
        args.map_err(|error| error.format(&mut Args::command()))
    });
    match parsed {
        // Building the program takes most of a short command's time.
        Ok(args) if words.windows(2).any(|pair| is_bare_output(&pair[0], &pair[1])) => {
            advise_on_output(words, &built_program()).map_or(Ok(args), Err)
        }
        Ok(args) => Ok(args),
        Err(usage) => Err(advise(usage, words, &built_program())),
    }
}

/// Returns all commands with their flags.
fn built_program() -> Command {
    let mut program = Args::command();
    program.build();
    program
}

/// Whether a word is a picture and follows no flag.
fn is_bare_output(before: &OsString, word: &OsString) -> bool {
    let is_flag = |word: &OsString| word.to_string_lossy().starts_with('-');
    !is_flag(before) && !is_flag(word) && OutputFormat::is_known(Path::new(word))
}

/// Returns the error for an output without `-o`, as in `alberti render model.glb picture.png`.
fn advise_on_output(words: &[OsString], program: &Command) -> Option<Error> {
    let typed: Vec<String> = words.iter().map(|it| it.to_string_lossy().into_owned()).collect();
    let at = correction::forgotten_output(&typed, called_command(program, words))?;
    let unsupported = OutputFormat::from_path(Path::new(&typed[at])).err();
    let is_still = called_command(program, words).get_name() == "render";
    let message = match unsupported.filter(|_| is_still) {
        Some(error) => error.to_string(),
        None => {
            let output = visible_text(&typed[at]);
            let help = match corrected(words, program) {
                Some(Correction { line, .. }) => format!("run `{line}`"),
                None => format!("use `-o {output}`"),
            };
            format!("`{output}` is not a model; to write to it, {help}")
        }
    };
    Some(Error::raw(ErrorKind::UnknownArgument, message + "\n").with_cmd(program))
}

/// Adds a helpful tip to a clap error, or replaces the error.
///
/// `program` has all its flags declared; `words` is the command line.
fn advise(mut error: Error, words: &[OsString], program: &Command) -> Error {
    // `to pass '--zoom' as a value, use '-- --zoom'` is never what the user meant.
    error.remove(ContextKind::Suggested);
    let message = match error.kind() {
        ErrorKind::UnknownArgument => advise_on_flag(&error, words, program),
        ErrorKind::InvalidSubcommand => advise_on_command(&error, words, program),
        ErrorKind::TooManyValues => advise_on_switch(&error),
        ErrorKind::InvalidValue | ErrorKind::ValueValidation => {
            advise_on_value(&mut error, words, program)
        }
        ErrorKind::MissingRequiredArgument => {
            advise_on_input(&mut error);
            None
        }
        ErrorKind::ArgumentConflict => {
            advise_on_conflict(&mut error);
            None
        }
        _ => None,
    };
    // An earlier mistake is reported first.
    let is_first =
        context(&error, ContextKind::InvalidArg).is_some_and(|word| !word.starts_with('-'));
    if is_first && let Some(output) = advise_on_output(words, program) {
        return output;
    }
    let message = message.or_else(|| advise_on_help(&error, words, program));
    let correction = error.use_stderr().then(|| corrected(words, program)).flatten();
    match message {
        Some(message) => {
            let message = with_given_model(&message, words);
            let message = with_correction(message, correction);
            Error::raw(ErrorKind::UnknownArgument, message + "\n").with_cmd(program)
        }
        None => {
            add_correction(&mut error, correction);
            error
        }
    }
}

/// Returns the message with the corrected command line, in place of an example's or as a tip.
fn with_correction(message: String, correction: Option<Correction>) -> String {
    let Some(Correction { line, count }) = correction else { return message };
    let command = line.split(' ').take(2).collect::<Vec<_>>().join(" ");
    let example = message.split_once(&format!("run `{command} "));
    if let Some((before, (_, after))) =
        example.and_then(|(before, rest)| Some((before, rest.split_once('`')?)))
    {
        return format!("{before}run `{line}`{after}");
    }
    if count < 2 || message.contains("is not a command") {
        message
    } else {
        format!("{message}\n\n  tip: the whole command is `{line}`")
    }
}

/// Adds the corrected command line to an error with several mistakes, as a tip.
fn add_correction(error: &mut Error, correction: Option<Correction>) {
    let Some(Correction { line, count: 2.. }) = correction else { return };
    let mut tips = match error.remove(ContextKind::Suggested) {
        Some(ContextValue::StyledStrs(tips)) => tips,
        _ => Vec::new(),
    };
    tips.push(StyledStr::from(format!("the whole command is `{line}`")));
    error.insert(ContextKind::Suggested, ContextValue::StyledStrs(tips));
}

/// Returns the message with the user's model and picture instead of the example's.
fn with_given_model(message: &str, words: &[OsString]) -> String {
    let is_plain = |word: &&str| !word.starts_with('-') && visible_text(word) == **word;
    let mut words = words.iter().filter_map(|word| word.to_str()).filter(is_plain);
    let all = words.clone().filter(|word| FileFormat::from_extension(Path::new(word)).is_some());
    let mut models = all.clone();
    let model = models.next().filter(|_| models.next().is_none());
    let picture = words.rfind(|word| OutputFormat::from_path(Path::new(word)).is_ok());
    let names = [("model.glb", model), ("picture.png", picture)];
    let message = names.into_iter().fold(message.to_owned(), |message, (example, name)| {
        name.map_or(message.clone(), |name| message.replace(example, &quoted(name)))
    });
    let all = all.map(quoted).collect::<Vec<_>>().join(" ");
    let is_list = message.contains("batch models ") && all.contains(' ');
    if is_list { message.replace("batch models ", &format!("batch {all} ")) } else { message }
}

/// Returns advice on words that clap reads as `-h`, such as `-hide_banner`.
fn advise_on_help(error: &Error, words: &[OsString], program: &Command) -> Option<String> {
    let is_long = |word: &&str| {
        word.starts_with("-h")
            && word.len() > 3
            && word.chars().skip(1).all(|c| c.is_alphabetic() || c == '_')
    };
    let all: Vec<&str> = words.iter().filter_map(|word| word.to_str()).collect();
    let number = |pair: &&[&str]| pair[0] == "-h" && pair[1].parse::<u32>().is_ok();
    if error.kind() == ErrorKind::DisplayHelp
        && let Some(pair) = all.windows(2).find(number)
    {
        return Some(format!(
            "`-h` prints the help and does not accept `{}`; `--size 1920x1080` sets the size",
            pair[1]
        ));
    }
    let word = all.iter().copied().find(is_long)?;
    (error.kind() == ErrorKind::DisplayHelp).then(|| {
        let command = called_command(program, words);
        let texts: Vec<String> = words.iter().map(|it| it.to_string_lossy().into_owned()).collect();
        let help = unknown_flag::what_to_write(word, word, &texts, command);
        let name = full_name(command);
        let help = help.unwrap_or_else(|| format!("`{name} --help` lists its flags"));
        format!("`{word}` is not a flag of `{name}`; {help}")
    })
}

/// Returns the string in an error's context.
fn context(error: &Error, kind: ContextKind) -> Option<&str> {
    match error.get(kind) {
        Some(ContextValue::String(text)) => Some(text),
        _ => None,
    }
}

/// Returns advice on a value for a flag that accepts none, as in `--ambient-occlusion=true`.
fn advise_on_switch(error: &Error) -> Option<String> {
    let flag = context(error, ContextKind::InvalidArg)?;
    let value = context(error, ContextKind::InvalidValue)?;
    Some(format!("`{flag}` takes no value: omit `={value}`"))
}

/// Returns a name in the form used by the tables; single letters keep their case.
fn with_hyphens(word: &str) -> String {
    match word.chars().count() {
        1 => word.to_owned(),
        _ => word.to_ascii_lowercase().replace('_', "-"),
    }
}

/// Whether two names are too different for a misspelling: more than a third of the longer name's
/// letters are missing from the other name, in any position.
fn differs_widely(word: &str, name: &str) -> bool {
    let mut rest: Vec<char> = name.chars().collect();
    let shared = word.chars().filter(|letter| {
        let at = rest.iter().position(|other| other == letter);
        at.map(|at| rest.swap_remove(at)).is_some()
    });
    let longest = word.chars().count().max(name.chars().count());
    3 * shared.count() < 2 * longest
}

/// Whether a word is probably a misspelling of a name: similar, with the same first letter.
fn is_misspelling(word: &str, name: &str) -> bool {
    !differs_widely(word, name) && word.chars().next() == name.chars().next()
}

/// Returns the full name of a command, such as `alberti scene init`.
fn full_name(command: &Command) -> String {
    command.get_bin_name().unwrap_or(command.get_name()).to_owned()
}

/// Whether a command has a flag with this long name.
fn has_flag(command: &Command, name: &str) -> bool {
    command.get_arguments().any(|flag| flag.get_long() == Some(name))
}

/// Whether a flag of a command accepts a value.
fn takes_value(command: &Command, name: &str) -> bool {
    let flag = command.get_arguments().find(|flag| flag.get_long() == Some(name));
    flag.is_some_and(|flag| flag.get_action().takes_values())
}

/// Returns advice on a file, a folder or another program's command in place of a command.
fn advise_on_command(error: &Error, words: &[OsString], program: &Command) -> Option<String> {
    let word = context(error, ContextKind::InvalidSubcommand)?;
    let called = called_command(program, words);
    let command = if called.get_name() == "help" { program } else { called };
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
        let help = match closest_name(word, &names).filter(|name| is_misspelling(word, name)) {
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
    let typed: Vec<_> = words.iter().skip(1).map(|word| quoted(&word.to_string_lossy())).collect();
    Some(format!(
        "`{word}` is a file, not a command; to render it, run `{} render {}`",
        program.get_name(),
        typed.join(" ")
    ))
}

/// Adds advice on a missing input or output.
fn advise_on_input(error: &mut Error) {
    let Some(ContextValue::Strings(missing)) = error.get(ContextKind::InvalidArg) else { return };
    let lacks = |name: &str| missing.iter().any(|it| it.starts_with(name));
    let tip = if lacks("<INPUT>...") {
        Some("name a scene or a model, or `-` to read one from the standard input")
    } else if lacks("--output") && !lacks("<INPUT>") {
        Some("name the film, as in `-o film.gif`, or its frames, as in `-o 'frame_{frame:04}.png'`")
    } else {
        None
    };
    if let Some(tip) = tip {
        let tip = ContextValue::StyledStrs(vec![StyledStr::from(tip)]);
        error.insert(ContextKind::Suggested, tip);
    }
}

/// Adds advice on two conflicting flags.
fn advise_on_conflict(error: &mut Error) {
    let is_repeated = error.get(ContextKind::InvalidArg) == error.get(ContextKind::PriorArg);
    let tip = if is_repeated { "use it only once" } else { "keep one of them" };
    let tip = ContextValue::StyledStrs(vec![StyledStr::from(tip)]);
    error.insert(ContextKind::Suggested, tip);
}

#[cfg(test)]
mod tests {
    use super::given_value::accepted_value;
    use super::unknown_flag::foreign_flag;
    use super::*;

    /// Each piece of advice parses as printed, on a command that has the flag. No name in the table
    /// is a flag of that command.
    #[test]
    fn suggested_flags_are_accepted_by_their_commands() {
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
    fn every_suggested_value_exists() {
        let program = built_program();
        let render = program.find_subcommand("render").expect("render");
        for row in foreign_words("value") {
            let value = row.advice;
            let flag = render
                .get_arguments()
                .find(|known| known.get_long() == Some(row.owner))
                .expect("a flag");
            let values = flag.get_possible_values();
            assert!(accepted_value(row.owner, value, render).is_some(), "{value}");
            for word in row.words() {
                let is_value = values.iter().any(|known| known.get_name() == word);
                assert!(!is_value, "{word} is already a value");
            }
        }
    }

    /// The advice is valid: each command in backticks parses, and each flag belongs to a command.
    #[test]
    fn advice_on_habits_names_existing_commands_and_flags() {
        let program = built_program();
        let exists = |flag: &str| program.get_subcommands().any(|it| has_flag(it, flag));
        for row in foreign_words("habit") {
            let (only, help) = (row.owner, row.advice);
            let is_command = only == "alberti" || program.find_subcommand(only).is_some();
            assert!(only.is_empty() || is_command, "{only}");
            for word in row.words() {
                assert_eq!(with_hyphens(word), word, "names are looked up in this form");
            }
            for quoted in help.split('`').skip(1).step_by(2) {
                let command = quoted.split(" > ").next().unwrap_or(quoted);
                let words: Vec<&str> = command.split(' ').collect();
                // Flags such as `--version` print something and end the program.
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
