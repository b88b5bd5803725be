//! Plans all pictures for one `render` call before any work starts.
//!
//! Every output name is known up front, so that two pictures with the same name are rejected before
//! the first is written.

use super::missing_input_help;
use crate::CliError;
use crate::args::RenderArgs;
use crate::format::{OutputFormat, refuse_blender_path};
use crate::scene_overrides::SceneOverrideArgs;
use batch::NameTemplate;
use clap::ValueEnum;
use files::visible_path;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// The text fields of an output name template.
///
/// All except `stem` have the value of a flag, or `default` if the flag is not set. Their values
/// are the same for all pictures in a call, except `view` with `--views`.
const WORD_FIELDS: [&str; 6] = ["stem", "camera", "view", "style", "projection", "variant"];
/// The number fields of an output name template.
///
/// `frame` restarts at 0 for each input; `index` does not.
const NUMBER_FIELDS: [&str; 2] = ["index", "frame"];

/// One picture to render.
///
/// It owns its overrides: `--views` makes one task per view, and the tasks share all other flags.
#[derive(Debug)]
pub(crate) struct RenderTask {
    /// The scene or model; `-` for the standard input.
    pub(crate) input: PathBuf,
    /// The scene overrides of this picture.
    pub(crate) overrides: SceneOverrideArgs,
    /// The format of the file.
    pub(crate) format: OutputFormat,
    /// The file; `None` for the standard output.
    pub(crate) output: Option<PathBuf>,
}

/// Plans all pictures, ordered by input, then by view.
///
/// # Errors
/// Returns an error if an input is missing, or if an output name is invalid or not unique.
pub(super) fn plan_tasks(args: &RenderArgs) -> Result<Vec<RenderTask>, CliError> {
    refuse_words_as_input(&args.inputs)?;
    let looks = overrides_per_view(args);
    let count = args.inputs.len() * looks.len();
    let to_stdout = args.output.as_deref() == Some(Path::new("-"));
    if to_stdout && count > 1 {
        return Err(CliError::Usage(format!(
            "cannot write {count} pictures to the standard output\n  = help: use a template, as in -o '{{stem}}.png'"
        )));
    }
    args.output.as_deref().map_or(Ok(()), refuse_blender_path)?;
    let template = output_template(args)?;
    let mut jobs = Vec::new();
    for input in &args.inputs {
        for (frame, look) in looks.iter().enumerate() {
            let output = template.expand_fields(
                |name| template_word(name, input, look),
                |name| {
                    if name == "frame" { frame } else { jobs.len() }
                },
            );
            let format = match (args.format, to_stdout) {
                (Some(format), _) => format,
                (None, true) => OutputFormat::Png,
                (None, false) => OutputFormat::from_path(&output)?,
            };
            let output = (!to_stdout).then_some(output);
            jobs.push(RenderTask { input: input.clone(), overrides: look.clone(), format, output });
        }
    }
    check_distinct_outputs(&jobs)?;
    Ok(jobs)
}

/// Rejects a nonexistent input, such as `+antialias` or a flag after `--`, if there are several
/// inputs. Without this check, the error could be that two pictures have the same name.
fn refuse_words_as_input(inputs: &[PathBuf]) -> Result<(), CliError> {
    let is_word = |path: &&PathBuf| path.as_os_str() != "-" && !path.exists();
    let Some(word) = inputs.iter().find(is_word).filter(|_| inputs.len() > 1) else {
        return Ok(());
    };
    let name = visible_path(word);
    let help = match word.to_string_lossy().chars().next() {
        Some('-') => {
            "everything after `--` is taken as a model; remove `--` and everything after it"
                .to_owned()
        }
        Some('+') => format!(
            "{name} is taken as a model; a flag begins with `--`, or with `-` and one letter"
        ),
        _ => missing_input_help(word).unwrap_or_else(|| "check the name".to_owned()),
    };
    Err(CliError::Usage(format!("{name}: the file does not exist\n  = help: {help}")))
}

/// Returns the overrides for each picture of an input: one for each of `--views`.
fn overrides_per_view(args: &RenderArgs) -> Vec<SceneOverrideArgs> {
    if args.views.is_empty() {
        return vec![args.overrides.clone()];
    }
    let from = |&view| {
        let mut look = args.overrides.clone();
        look.view = Some(view);
        look
    };
    args.views.iter().map(from).collect()
}

/// Returns the template for the output name: from `--output`, or the default.
///
/// The default names the view only if there are several, so that `--view front` and `--views front`
/// write the same file.
fn output_template(args: &RenderArgs) -> Result<NameTemplate, CliError> {
    let ending = args.format.unwrap_or(OutputFormat::Png).extension();
    let usual = if args.views.len() > 1 {
        format!("{{stem}}_{{view}}.{ending}")
    } else {
        format!("{{stem}}.{ending}")
    };
    let given = args.output.as_ref().map(|output| output.to_string_lossy().into_owned());
    NameTemplate::parse(&given.unwrap_or(usual), &WORD_FIELDS, &NUMBER_FIELDS)
        .map_err(CliError::Usage)
}

/// Returns the value of a text field of the template, or `default` if no flag sets it.
///
/// A flag's value is its name on the command line.
///
/// Camera and variant names come from models and may contain any character; the template replaces
/// characters that file names cannot contain.
fn template_word(name: &str, input: &Path, look: &SceneOverrideArgs) -> String {
    let choice = |choice: &Option<scene_file::file::Choice>| {
        choice.as_ref().map(|choice| match choice {
            scene_file::file::Choice::Index(at) => at.to_string(),
            scene_file::file::Choice::Name(name) => name.clone(),
        })
    };
    let flag = |value: Option<clap::builder::PossibleValue>| {
        value.map(|value| value.get_name().to_owned())
    };
    let word = match name {
        "stem" if input.as_os_str() == "-" => Some("stdin".to_owned()),
        "stem" => input.file_stem().map(|stem| stem.to_string_lossy().into_owned()),
        "camera" => look.camera.clone(),
        "view" => look.view.map(|view| view.name().to_owned()),
        "style" => flag(look.style.and_then(|style| style.to_possible_value())),
        "projection" => flag(look.projection.and_then(|projection| projection.to_possible_value())),
        "variant" => choice(&look.model_state.variant),
        _ => None,
    };
    word.unwrap_or_else(|| "default".to_owned())
}

/// Checks that no two pictures have the same file name.
///
/// Paths are compared as written: `a.png` and `./a.png` count as different. Two names are equal,
/// for example, if a scene and a model have the same stem.
fn check_distinct_outputs(jobs: &[RenderTask]) -> Result<(), CliError> {
    let mut taken: BTreeMap<&Path, &RenderTask> = BTreeMap::new();
    for job in jobs {
        let Some(output) = job.output.as_deref() else { continue };
        if let Some(first) = taken.insert(output, job) {
            let is_view = first.input == job.input && first.overrides.view != job.overrides.view;
            let [first, second] = [first, job].map(|job| visible_path(&job.input));
            let field = if is_view { "{view}" } else { "{index}" };
            let template = output.with_file_name(format!("{{stem}}_{field}.png"));
            let other = if is_view {
                ""
            } else {
                "; to draw several models in one picture, list them in a scene file"
            };
            let (output, template) = (visible_path(output), visible_path(template));
            return Err(CliError::Usage(format!(
                "the pictures of {first} and {second} would both be written to {output}\n  = help: use a template, as in -o '{template}'{other}"
            )));
        }
    }
    Ok(())
}
