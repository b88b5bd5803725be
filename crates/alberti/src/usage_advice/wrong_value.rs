//! Advice on values that a flag does not accept.

use super::foreign_words::foreign_words;
use super::given_value::{
    accepted_value, following_numbers, foreign_value, invalid_value, quoted, similar_color,
};
use super::{context, differs_widely, has_flag};
use crate::format::OutputFormat;
use crate::negative_numbers::called_command;
use clap::builder::StyledStr;
use clap::error::{ContextKind, ContextValue};
use clap::{Command, Error};
use std::ffi::OsString;
use std::path::Path;

/// Replaces clap's tip with the equivalent of another program's value, and explains a flag that has
/// another meaning in other programs.
pub(super) fn advise_on_value(
    error: &mut Error,
    words: &[OsString],
    program: &Command,
) -> Option<String> {
    let (flag, given) = invalid_value(error)?;
    if let Some(advice) = other_meaning(&flag, &given) {
        return Some(advice);
    }
    if given.is_empty() {
        add_example(error, &flag);
        return None;
    }
    let command = called_command(program, words);
    if let Some((azimuth, elevation)) = given.split_once(',').filter(|_| flag == "view")
        && let (Ok(azimuth), Ok(elevation)) = (azimuth.parse::<f64>(), elevation.parse::<f64>())
    {
        return Some(format!(
            "`--view` takes the name of a direction; for angles, use `--azimuth {azimuth} --elevation {elevation}`"
        ));
    }
    let are_views = || accepted_value("views", &given, command).is_some();
    if flag == "view" && given.contains(',') && has_flag(command, "views") && are_views() {
        return Some(format!(
            "`--view` takes one direction; `--views {given}` renders a picture from each"
        ));
    }
    let texts: Vec<String> = words.iter().map(|it| it.to_string_lossy().into_owned()).collect();
    let meant = meant_value(&flag, &given, &texts, command);
    if let Some(expected) = expected_number(error, &given) {
        let tip = meant.map_or(String::new(), |meant| format!("; write `--{flag} {meant}`"));
        return Some(format!("invalid value '{given}' for '--{flag}': {expected}{tip}"));
    }
    let is_other =
        || unwritten_format_help(&flag, &given).or_else(|| other_file_help(&flag, &given));
    if let Some(help) = is_other() {
        return Some(format!("invalid value '{given}' for '--{flag}': {help}"));
    }
    let tip = match meant.or_else(|| similar_color(&flag, &given)) {
        Some(meant) => Some(format!("write `--{flag} {}`", quoted(&meant))),
        None if flag == "view"
            && context(error, ContextKind::SuggestedValue)
                .is_none_or(|similar| differs_widely(&given, similar)) =>
        {
            Some("for other directions, use angles, as in `--azimuth 45 --elevation 20`".to_owned())
        }
        None => None,
    };
    if let Some(tip) = tip {
        error.remove(ContextKind::SuggestedValue);
        let tip = ContextValue::StyledStrs(vec![StyledStr::from(tip)]);
        error.insert(ContextKind::Suggested, tip);
    } else if context(error, ContextKind::SuggestedValue)
        .is_some_and(|similar| differs_widely(&given, similar))
    {
        error.remove(ContextKind::SuggestedValue);
    }
    None
}

/// Adds an example to the error for a flag without its value.
fn add_example(error: &mut Error, flag: &str) {
    if let Some(row) = foreign_words("flag").find(|row| row.owner == flag) {
        let example = row.advice.split(" --").next().unwrap_or(row.advice);
        let tip = ContextValue::StyledStrs(vec![StyledStr::from(format!("as in `{example}`"))]);
        error.insert(ContextKind::Suggested, tip);
    }
}

/// Returns the value that was probably meant.
pub(super) fn meant_value(
    flag: &str,
    given: &str,
    words: &[String],
    command: &Command,
) -> Option<String> {
    let apart = following_numbers(&format!("--{flag}"), flag, words, command);
    let accepted = || foreign_value(flag, given).or_else(|| accepted_value(flag, given, command));
    apart.or_else(accepted)
}

/// Returns advice on a kind of value that a flag with this name accepts in other programs.
fn other_meaning(flag: &str, given: &str) -> Option<String> {
    if flag == "color" {
        return Some(format!(
            "`--color` sets when messages are colored (auto, always or never), and does not accept \
             {given}; a model's colors come from its file, and a scene file can replace them, as \
             in `materials: [(base_color: \"red\")]`"
        ));
    }
    if flag == "background" && given.is_empty() {
        return Some(
            "`--background` sets the color behind the model and needs a value, such as \
             `--background white` or `--background '#ff8800'`; quote colors that begin with `#`, \
             which starts a comment in a shell"
                .to_owned(),
        );
    }
    let hex = given.strip_prefix('#').filter(|hex| hex.chars().all(|c| c.is_ascii_hexdigit()));
    if let Some(hex) = hex.filter(|hex| flag == "background" && matches!(hex.len(), 4 | 8)) {
        let color = &hex[..hex.len() / 4 * 3];
        return Some(format!(
            "invalid value '{given}' for '--background': a background color has no alpha; write \
             `--background '#{color}'` or `--background transparent`"
        ));
    }
    if flag == "background" && given.starts_with("rgba(") {
        return Some(format!(
            "invalid value '{given}' for '--background': a background color has no alpha; write a \
             color such as `--background '#ff8800'`, or `--background transparent`"
        ));
    }
    if let Some(percent) = given.strip_suffix('%').filter(|_| flag == "size") {
        let factor = percent.parse::<f64>().ok()? / 100.0;
        return Some(format!(
            "invalid value '{given}' for '--size': `--scale {factor}` scales the width and height"
        ));
    }
    if flag == "up" && given.starts_with('-') {
        return Some(format!(
            "invalid value '{given}' for '--up': the axis that points up is x, y or z; to turn a \
             model over, use `rotation_degrees` in a scene file"
        ));
    }
    None
}

/// Returns advice on a format in which pictures cannot be written.
fn unwritten_format_help(flag: &str, given: &str) -> Option<String> {
    let ending = given.to_ascii_lowercase().replace(['_', '-'], "").replace("openexr", "exr");
    let path = format!("picture.{ending}");
    let error = OutputFormat::from_path(Path::new(&path)).err().filter(|_| flag == "format")?;
    let message = error.to_string();
    let (message, help) = message.strip_prefix(&format!("{path}: "))?.split_once("\n  = help: ")?;
    Some(format!("{message}; {help}"))
}

/// Returns advice on a file that a flag does not accept, but that can be converted.
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
                "environments are read from .hdr files; convert the image, for example with ImageMagick: \
                 `magick {given} {hdr}`"
            ))
        }
        "background" if is_picture => Some(format!(
            "expected a color; a scene file can put a picture behind the model, as in \
             `image: (background: Picture(path: \"{given}\"))`"
        )),
        _ => None,
    }
}

/// Returns the numbers that a flag accepts, if clap reports them as in `0 is not in 1..=100000`.
fn expected_number(error: &Error, given: &str) -> Option<String> {
    let reason = std::error::Error::source(error)?.to_string();
    if let Some((_, range)) = reason.split_once(" is not in ") {
        let (least, most) = range.split_once("..=")?;
        return Some(format!("expected a whole number from {least} to {most}"));
    }
    let is_whole = ["invalid digit", "number too large", "number too small"];
    let text = if reason.starts_with(is_whole[0]) {
        let has_unit = given.ends_with(|c: char| c.is_alphabetic() || c == '%');
        if has_unit { "expected a whole number, without a unit" } else { "expected a whole number" }
    } else {
        "the number is out of range"
    };
    is_whole.iter().any(|start| reason.starts_with(start)).then(|| text.to_owned())
}
