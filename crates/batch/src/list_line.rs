//! The members of a list line: the input, the pictures, and flags by name.

use super::job::{BatchJob, JobGroup, ListLine};
use super::picture_name::{NameSource, PictureName, check_picture_name, normal_parts};
use crate::flag_table::{FlagTable, flag_word, is_scene_name};
use files::visible_text;
use scene_file::closest_name;
use serde_json::{Map, Value};
use std::path::{Path, PathBuf};

/// The members that are not flags.
const OWN_MEMBERS: [&str; 5] = ["input", "output", "scene", "bytes", "pictures"];

/// The context shared by the lines of a list.
pub(super) struct ListContext {
    /// The folder that inputs and scenes are relative to.
    pub(super) folder: PathBuf,
    /// The scene from `--scene`.
    pub(super) scene: Option<PathBuf>,
    /// The template from `--name`.
    pub(super) picture_name: Option<PictureName>,
    /// The flags that a line may set.
    pub(super) flags: FlagTable,
}

impl ListContext {
    /// Checks that a member is known.
    ///
    /// # Errors
    /// Returns an error if it is unknown; the message suggests the name that was probably meant.
    pub(super) fn check_member(&self, name: &str) -> Result<(), String> {
        if OWN_MEMBERS.contains(&name) || self.flags.has_flag(name) {
            return Ok(());
        }
        let wanted = name.trim_start_matches('-').replace('_', "-");
        let known: Vec<&str> = OWN_MEMBERS.into_iter().chain(self.flags.names()).collect();
        let help = closest_name(&wanted, &known).map_or_else(
            || "use input, output, scene, bytes, pictures or a picture flag".to_owned(),
            |best| format!("did you mean `{best}`?"),
        );
        let name = visible_text(name);
        Err(format!("unknown member `{name}`\n  = help: {help}"))
    }
}

/// Reads the jobs of one line.
#[derive(Clone, Copy)]
pub(super) struct LineReader<'a> {
    pub(super) context: &'a ListContext,
    pub(super) line: &'a ListLine,
}

impl LineReader<'_> {
    /// Returns the jobs of a line.
    ///
    /// # Errors
    /// Returns an error if a member is unknown, missing or of the wrong type.
    pub(super) fn read_group(&self, members: &Map<String, Value>) -> Result<JobGroup, String> {
        let given = text_member(members, "input")?;
        let given = given.ok_or("missing member `input`")?;
        if given.is_empty() {
            return Err("the member `input` is empty".to_owned());
        }
        let bytes = match members.get("bytes") {
            None | Some(Value::Null) => None,
            Some(value) => Some(value.as_u64().ok_or("`bytes` must be a whole number")?),
        };
        let flags = self.flags_of(members)?;
        let pictures = match members.get("pictures") {
            None | Some(Value::Null) => {
                let one = self.read_job(Path::new(given), members, flags, 0)?;
                return Ok(JobGroup { jobs: vec![one], bytes });
            }
            Some(Value::Array(pictures)) if !pictures.is_empty() => pictures,
            Some(_) => return Err("`pictures` must be a nonempty list of pictures".to_owned()),
        };
        if members.contains_key("output") {
            return Err("`output` conflicts with `pictures`; set it for each picture".to_owned());
        }
        let mut jobs: Vec<BatchJob> = Vec::new();
        for (at, picture) in pictures.iter().enumerate() {
            let job = self.read_picture(Path::new(given), members, picture, &flags, at + 1);
            let job = job.map_err(|what| format!("pictures[{at}]: {what}"))?;
            if jobs.iter().any(|other| other.output == job.output) {
                return Err(format!("two of the `pictures` have the same output {}", job.output));
            }
            jobs.push(job);
        }
        Ok(JobGroup { jobs, bytes })
    }

    /// Returns the job for one of several pictures; the picture's members override the line's.
    fn read_picture(
        &self,
        given: &Path,
        line: &Map<String, Value>,
        picture: &Value,
        flags: &[String],
        number: usize,
    ) -> Result<BatchJob, String> {
        let own =
            picture.as_object().ok_or("a picture must be an object such as {\"view\": \"top\"}")?;
        for member in ["input", "bytes", "pictures"] {
            if own.contains_key(member) {
                return Err(format!("`{member}` belongs to the line, not to a picture"));
            }
        }
        let flags = self.context.flags.merge(flags, &self.flags_of(own)?);
        let mut members = own.clone();
        if let Some(scene) = line.get("scene").filter(|_| !own.contains_key("scene")) {
            members.insert("scene".to_owned(), scene.clone());
        }
        self.read_job(given, &members, flags, number)
    }

    /// Returns a job with these flags. `number` is the picture's number within its line, or 0 for a
    /// line without `pictures`.
    fn read_job(
        &self,
        given: &Path,
        members: &Map<String, Value>,
        flags: Vec<String>,
        number: usize,
    ) -> Result<BatchJob, String> {
        let output = match (text_member(members, "output")?, &self.context.picture_name) {
            (Some(output), _) => {
                check_picture_name(output)?;
                normal_parts(Path::new(output))
            }
            (None, template) => {
                let usual = PictureName::of_line(number > 0);
                let line = usize::try_from(self.line.number).unwrap_or(usize::MAX);
                let source = NameSource { input: given, line, picture: number.max(1) };
                let name = template.as_ref().unwrap_or(&usual).name_picture(source);
                check_picture_name(&name)?;
                name
            }
        };
        let scene = members.get("scene").and_then(Value::as_str).filter(|name| is_scene_name(name));
        let scene = scene.map(|name| self.context.folder.join(name));
        Ok(BatchJob {
            input: named_file(self.context.folder.join(given)),
            output,
            scene: scene.or_else(|| self.context.scene.clone()),
            flags,
            line: Some(self.line.clone()),
            fault: None,
        })
    }

    /// Returns the flags among the members, sorted by name.
    fn flags_of(&self, members: &Map<String, Value>) -> Result<Vec<String>, String> {
        let mut words = Vec::new();
        for (name, value) in members {
            self.context.check_member(name)?;
            let is_scene_file =
                name == "scene" && value.as_str().is_none_or(is_scene_name) && !value.is_number();
            if is_scene_file || (OWN_MEMBERS.contains(&name.as_str()) && name != "scene") {
                continue;
            }
            push_flag(name, value, &mut words)
                .map_err(|what| format!("the member `{name}` {what}"))?;
        }
        Ok(words)
    }
}

/// Returns a path that always names a file, because `-` would mean the standard input.
fn named_file(path: PathBuf) -> PathBuf {
    if path.as_os_str() == "-" { Path::new(".").join(path) } else { path }
}

/// Returns a string member, or `None` if it is absent.
fn text_member<'a>(members: &'a Map<String, Value>, name: &str) -> Result<Option<&'a str>, String> {
    match members.get(name) {
        None | Some(Value::Null) => Ok(None),
        Some(Value::String(text)) => Ok(Some(text)),
        Some(_) => Err(format!("`{name}` must be a string")),
    }
}

/// Adds a flag with the value of a member.
///
/// `true` adds the flag without a value; `false` and `null` add nothing. A list of numbers becomes
/// one comma-separated value; any other list repeats the flag.
fn push_flag(name: &str, value: &Value, words: &mut Vec<String>) -> Result<(), String> {
    match value {
        Value::Null | Value::Bool(false) => {}
        Value::Bool(true) => words.push(flag_word(name, None)),
        Value::Number(number) => words.push(flag_word(name, Some(&number.to_string()))),
        Value::String(text) => words.push(flag_word(name, Some(text))),
        Value::Array(values) if values.iter().all(Value::is_number) && !values.is_empty() => {
            let numbers: Vec<String> = values.iter().map(ToString::to_string).collect();
            words.push(flag_word(name, Some(&numbers.join(","))));
        }
        Value::Array(values) => {
            for value in values {
                push_flag(name, value, words)?;
            }
        }
        Value::Object(_) => return Err("must not be an object".to_owned()),
    }
    Ok(())
}
