//! The flags of a picture: flags in its line of the job list override the flags of the command.
//!
//! ```text
//!  command: --size 64x64 --view front      line: {"input": "a.glb", "camera": "left"}
//!                        └──────┬──────────────────┘
//!                --size=64x64 --camera=left      (--camera excludes --view)
//! ```

use crate::load_options::LoadArgs;
use crate::scene_overrides::SceneOverrideArgs;
use batch::{FlagTable, flag_word, is_scene_name};
use clap::error::Error;
use clap::{ArgMatches, Args, Command, FromArgMatches};
use std::path::PathBuf;

/// The flags of one picture, parsed.
#[derive(Debug, Args)]
pub(super) struct RenderFlags {
    #[command(flatten)]
    pub(super) overrides: SceneOverrideArgs,
    #[command(flatten)]
    pub(super) load_options: LoadArgs,
}

impl RenderFlags {
    /// Parses arguments such as `--size=64x64`.
    ///
    /// # Errors
    /// Returns an error if a value is invalid or two flags conflict; the message comes from clap.
    pub(super) fn parse(words: &[String]) -> Result<Self, String> {
        let command = declaration().no_binary_name(true).color(clap::ColorChoice::Never);
        let parsed = command.try_get_matches_from(words);
        parsed.and_then(|matches| Self::from_arg_matches(&matches)).map_err(|error| {
            let text = error.render().to_string();
            let text = text.strip_prefix("error: ").unwrap_or(&text);
            let end = text.find("\n\nUsage").or_else(|| text.find("\n\nFor more"));
            text[..end.unwrap_or(text.len())].trim_end().replace("\n\n", "\n")
        })
    }
}

/// Returns the command that declares the flags.
fn declaration() -> Command {
    RenderFlags::augment_args(Command::new("batch").disable_help_flag(true))
}

/// The flags as passed to the command.
#[derive(Debug, Default)]
pub(super) struct GivenFlags {
    /// The name and value of each flag, in declaration order; a switch has no value.
    words: Vec<(String, Option<String>)>,
    /// The folders of `--allow-outside`, and the file of `--environment`.
    pub(super) allowed: Vec<PathBuf>,
}

impl Args for GivenFlags {
    fn augment_args(command: Command) -> Command {
        RenderFlags::augment_args(command)
    }

    fn augment_args_for_update(command: Command) -> Command {
        RenderFlags::augment_args_for_update(command)
    }
}

impl FromArgMatches for GivenFlags {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, Error> {
        let parsed = RenderFlags::from_arg_matches(matches)?;
        let allowed = parsed.overrides.import_options(&parsed.load_options).allow_outside;
        let mut words = Vec::new();
        for flag in declaration().get_arguments() {
            let id = flag.get_id().as_str();
            let is_given = matches.value_source(id) == Some(clap::parser::ValueSource::CommandLine);
            let Some(name) = flag.get_long().filter(|_| is_given) else { continue };
            if !flag.get_action().takes_values() {
                words.push((name.to_owned(), None));
                continue;
            }
            for value in matches.get_raw(id).into_iter().flatten() {
                let value = value.to_str().ok_or_else(|| {
                    let message = format!("the value of --{name} is not UTF-8\n");
                    Error::raw(clap::error::ErrorKind::InvalidUtf8, message)
                })?;
                words.push((name.to_owned(), Some(value.to_owned())));
            }
        }
        Ok(Self { words, allowed })
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), Error> {
        *self = Self::from_arg_matches(matches)?;
        Ok(())
    }
}

impl GivenFlags {
    /// Removes a scene file, as in `--scene lineup.ron`, from the flags and returns it; any other
    /// `--scene` value names a scene in the models.
    pub(super) fn take_scene_file(&mut self) -> Option<PathBuf> {
        let is_file = |(name, value): &(String, Option<String>)| {
            name == "scene" && value.as_deref().is_some_and(is_scene_name)
        };
        let at = self.words.iter().position(is_file)?;
        self.words.remove(at).1.map(PathBuf::from)
    }

    /// Returns the flags as arguments, for job keys and for workers.
    pub(super) fn to_words(&self) -> Vec<String> {
        self.words.iter().map(|(name, value)| flag_word(name, value.as_deref())).collect()
    }
}

/// Returns the table of all picture flags and their conflicts.
pub(super) fn flag_table() -> FlagTable {
    let mut command = declaration();
    command.build();
    let flags = command.get_arguments();
    let named = flags.filter_map(|flag| Some((flag.get_long()?.to_owned(), flag)));
    let mut table = FlagTable::default();
    for (name, flag) in named {
        table.add_flag(&name);
        for other in command.get_arg_conflicts_with(flag) {
            let Some(other) = other.get_long() else { continue };
            table.add_conflict(&name, other);
        }
    }
    table
}

#[cfg(test)]
mod tests {
    use super::*;

    fn words(list: &[&str]) -> Vec<String> {
        list.iter().map(|word| (*word).to_owned()).collect()
    }

    #[test]
    fn list_lines_override_flags_and_remove_conflicting_ones() {
        let table = flag_table();
        let base = words(&["--size=64x64", "--view=front", "--overlay=axes", "--overlay=grid"]);
        let merged = table.merge(&base, &words(&["--camera=left", "--overlay=horizon"]));
        assert_eq!(merged, ["--size=64x64", "--camera=left", "--overlay=horizon"]);
        assert!(RenderFlags::parse(&merged).is_ok(), "{merged:?}");
        assert_eq!(table.merge(&base, &[]), base);
        assert!(table.has_flag("max-file-bytes") && !table.has_flag("out-dir"));
    }

    #[test]
    fn invalid_values_are_reported_in_one_paragraph() {
        let fault = RenderFlags::parse(&words(&["--samples=3"])).expect_err("no such pattern");
        assert!(fault.starts_with("invalid value '3' for '--samples"), "{fault}");
        assert!(fault.contains("expected 1, 4, 8 or 16") && !fault.contains("Usage"), "{fault}");
        let fault = RenderFlags::parse(&words(&["--view=front", "--camera=a"])).expect_err("both");
        assert!(fault.contains("cannot be used with"), "{fault}");
    }
}
