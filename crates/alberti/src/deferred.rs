//! Deferred arguments: declares a command's flags only when that command is used.
//!
//! Building the flags of all commands at every start would take most of the time of a short
//! command.

use clap::{ArgMatches, Args, Command, Error, FromArgMatches, Id};

/// The arguments of a subcommand, declared only when it is parsed or its help is printed.
#[derive(Debug)]
pub(crate) struct Deferred<T>(pub(crate) T);

impl<T: Args> Args for Deferred<T> {
    fn augment_args(command: Command) -> Command {
        command.defer(declare_arguments::<T>)
    }

    fn augment_args_for_update(command: Command) -> Command {
        command.defer(declare_arguments::<T>)
    }
}

/// Adds the arguments to a command. Values are case-insensitive, as in `--view Front`.
///
/// The command keeps its description, which the type's description would otherwise replace.
/// Existing global flags are moved to the end.
fn declare_arguments<T: Args>(command: Command) -> Command {
    let about = command.get_about().cloned().unwrap_or_default();
    let long_about = command.get_long_about().cloned();
    let global: Vec<Id> = command.get_arguments().map(|flag| flag.get_id().clone()).collect();
    let mut command = T::augment_args(command).about(about).long_about(None);
    if let Some(long_about) = long_about {
        command = command.long_about(long_about);
    }
    for flag in global {
        command = command.mut_arg(flag, |flag| flag);
    }
    command.mut_args(|flag| {
        let takes_values = flag.get_action().takes_values();
        flag.ignore_case(takes_values)
    })
}

impl<T: FromArgMatches> FromArgMatches for Deferred<T> {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, Error> {
        T::from_arg_matches(matches).map(Self)
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), Error> {
        self.0.update_from_arg_matches(matches)
    }
}
