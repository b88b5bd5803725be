//! Reference sections for commands and flags, from clap's own definitions.

use super::{ReferenceEntry, ReferenceSection};
use clap::{Arg, Command};

/// Returns a section for each command, in help order.
///
/// The command must be built first: only then does clap add global flags and subcommand names
/// (`alberti scene init`).
pub(super) fn command_sections(program: Command) -> Vec<ReferenceSection> {
    let mut program = program.disable_help_subcommand(true);
    program.build();
    let mut sections = Vec::new();
    collect_sections(&program, &mut sections);
    sections
}

/// Appends the section of a command, then the sections of its subcommands.
fn collect_sections(command: &Command, sections: &mut Vec<ReferenceSection>) {
    let about = command.get_long_about().or(command.get_about());
    let arguments = command.get_arguments().filter(|arg| !arg.is_hide_set());
    sections.push(ReferenceSection {
        title: command.get_bin_name().unwrap_or(command.get_name()).to_owned(),
        about: about.map(ToString::to_string).unwrap_or_default(),
        entries: arguments.map(argument_entry).collect(),
    });
    for inner in command.get_subcommands().filter(|inner| !inner.is_hide_set()) {
        collect_sections(inner, sections);
    }
}

/// Returns the entry for a flag or positional argument, as clap parses it: names, value, default
/// and possible values.
///
/// Positional arguments have no flag and are listed by their value name. A switch has neither value
/// nor default, although clap stores `true` and `false` for it.
fn argument_entry(arg: &Arg) -> ReferenceEntry {
    let takes_value = arg.get_action().takes_values();
    let names = arg.get_value_names().filter(|_| takes_value).unwrap_or_default();
    let value = names.iter().map(|name| format!("<{name}>")).collect::<Vec<_>>().join(" ");
    let short = arg.get_short().map(|letter| format!("-{letter}"));
    let long = arg.get_long().map(|word| format!("--{word}"));
    let flags: Vec<String> = short.into_iter().chain(long).collect();
    let defaults = arg.get_default_values().iter().map(|value| value.to_string_lossy());
    let defaults = defaults.collect::<Vec<_>>().join(" ");
    let about = arg.get_long_help().or(arg.get_help()).map(ToString::to_string).unwrap_or_default();
    let default = if defaults.is_empty() || !takes_value {
        String::new()
    } else {
        format!(" [default: {defaults}]")
    };
    let mut words = if takes_value { arg.get_possible_values() } else { Vec::new() };
    words.retain(|word| !word.is_hide_set());
    // Possible values without help are listed in the flag's description.
    let silent = words.iter().all(|word| word.get_help().is_none());
    let choice = if silent && !words.is_empty() {
        let names: Vec<String> = words.drain(..).map(|word| word.get_name().to_owned()).collect();
        format!(": {}", names.join(", "))
    } else {
        String::new()
    };
    let word = |word: &clap::builder::PossibleValue| ReferenceEntry {
        term: word.get_name().to_owned(),
        about: word.get_help().map(ToString::to_string).unwrap_or_default(),
        ..ReferenceEntry::default()
    };
    ReferenceEntry {
        term: if flags.is_empty() { value.clone() } else { flags.join(", ") },
        value: if flags.is_empty() { String::new() } else { value },
        note: if arg.is_required_set() { "required".to_owned() } else { String::new() },
        about: format!("{about}{choice}{default}"),
        inner: words.iter().map(word).collect(),
    }
}
