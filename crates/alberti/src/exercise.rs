//! `alberti exercise`: exercises on viewing, with answers checked and mistakes named.
//!
//! Prints the exercises of `explorer::exercise` in English or Chinese; JSON contains both.

use super::reference::wrap_paragraphs;
use super::{CliError, print_stdout};
use clap::ValueEnum;
use explorer::exercise::{Exercise, Verdict, exercises, find_exercise};
use explorer::{Language, Sentence, Words};
use serde_json::{Value as Json, json};
use std::process::ExitCode;

/// The version of the JSON document.
const VERSION: u32 = 1;

/// The examples in the help.
const EXAMPLES: &str = "\
Examples:
  alberti exercise                                the list
  alberti exercise 3                              a question
  alberti exercise 3 --hint                       how to begin
  alberti exercise 3 --answer 'A=1; B=0'          incorrect: the divide is missing …

Exits with 0 if the answer is correct, and with 1 if it is incorrect.";

/// Arguments of `alberti exercise`.
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct ExerciseArgs {
    /// Number of the exercise [default: list all]
    number: Option<u32>,
    /// Check an answer
    ///
    /// Separate the rows of a matrix with `;`, and numbers with spaces or commas. Fractions such as
    /// 7/3, the symbols of the exercise, + - * / ^ ( ), sqrt, sin, cos, tan, cot, atan, abs, pi and
    /// degrees such as 30° are allowed. Name several values as in x=a+b; y=-a*b.
    #[arg(long, value_name = "ANSWER", allow_hyphen_values = true, requires = "number")]
    answer: Option<String>,
    /// Print the hints
    #[arg(long, requires = "number", conflicts_with = "answer")]
    hint: bool,
    /// Print JSON, with all text in both languages
    #[arg(long)]
    json: bool,
    /// Language of the text [default: from LC_ALL, LC_MESSAGES or LANG]
    #[arg(long, value_name = "LANGUAGE")]
    language: Option<TextLanguage>,
}

/// The value of `--language`.
#[derive(Clone, Copy, Debug, ValueEnum)]
enum TextLanguage {
    /// English
    En,
    /// Chinese
    Zh,
}

impl From<TextLanguage> for Language {
    fn from(language: TextLanguage) -> Self {
        match language {
            TextLanguage::En => Self::English,
            TextLanguage::Zh => Self::Chinese,
        }
    }
}

/// Prints the exercises, one of them, its hints, or the verdict on an answer; the exit code is 1 if
/// the answer is wrong.
///
/// # Errors
/// Returns an error if there is no such exercise, or the answer cannot be parsed.
pub(crate) fn run(args: &ExerciseArgs) -> Result<ExitCode, CliError> {
    let language = args.language.map_or_else(language_of_environment, Language::from);
    let chosen = args.number.map(|number| numbered_exercise(number, language)).transpose()?;
    let shown = chosen.as_ref().map_or(exercises(), std::slice::from_ref);
    let verdict = match (chosen, &args.answer) {
        (Some(exercise), Some(answer)) => Some(
            exercise
                .check(answer)
                .map_err(|error| CliError::Usage(error.message.text(language).to_owned()))?,
        ),
        _ => None,
    };
    let text = if args.json {
        format!("{:#}\n", document(shown, verdict.as_ref()))
    } else if let Some(verdict) = &verdict {
        format!("{}\n", verdict.sentence().text(language))
    } else {
        match chosen {
            None => format_list(language),
            Some(exercise) if args.hint => format_hints(exercise, language),
            Some(exercise) => format_question(exercise, language),
        }
    };
    print_stdout(text.as_bytes())?;
    let is_wrong = verdict.is_some_and(|verdict| !verdict.is_right());
    Ok(if is_wrong { ExitCode::FAILURE } else { ExitCode::SUCCESS })
}

/// Returns Chinese if the environment selects it; the first variable that is set counts.
fn language_of_environment() -> Language {
    let values = ["LC_ALL", "LC_MESSAGES", "LANG"].into_iter().filter_map(std::env::var_os);
    let first = values.into_iter().find(|value| !value.is_empty());
    match first {
        Some(value) if value.to_string_lossy().starts_with("zh") => Language::Chinese,
        _ => Language::English,
    }
}

fn numbered_exercise(number: u32, language: Language) -> Result<&'static Exercise, CliError> {
    find_exercise(number).ok_or_else(|| {
        let count = exercises().len();
        CliError::Usage(match language {
            Language::English => format!(
                "there is no exercise {number}\n  = help: use 1 to {count}; `alberti exercise` lists them"
            ),
            Language::Chinese => format!(
                "没有习题 {number}\n  = help: 习题编号为 1 到 {count}；`alberti exercise` 列出全部习题"
            ),
        })
    })
}

fn format_list(language: Language) -> String {
    let line = |exercise: &&Exercise| {
        format!("{:>2}  {}\n", exercise.number, exercise.title.text(language))
    };
    exercises().iter().map(line).collect()
}

fn format_question(exercise: &Exercise, language: Language) -> String {
    let Exercise { number, title, question, .. } = exercise;
    let (title, form) = (title.text(language), exercise.form());
    let form = form.text(language);
    let mut page = String::new();
    match language {
        Language::English => {
            page += &format!("Exercise {number}: {title}\n\n");
            wrap_paragraphs(&mut page, question.text(language), 0);
            page.push('\n');
            wrap_paragraphs(&mut page, &format!("Answer: {form}."), 0);
            page += &format!("Check:  alberti exercise {number} --answer \"…\"\n");
            page += &format!("Hints:  alberti exercise {number} --hint\n");
        }
        Language::Chinese => {
            page += &format!("习题 {number}：{title}\n\n{}\n\n", question.text(language));
            page += &format!("答案：{form}。\n");
            page += &format!("检查：alberti exercise {number} --answer \"…\"\n");
            page += &format!("提示：alberti exercise {number} --hint\n");
        }
    }
    page
}

fn format_hints(exercise: &Exercise, language: Language) -> String {
    let mut page = String::new();
    for (number, hint) in (1..).zip(exercise.hints) {
        let hint = format!("{number}. {}", hint.text(language));
        match language {
            Language::English => wrap_paragraphs(&mut page, &hint, 0),
            Language::Chinese => page += &format!("{hint}\n"),
        }
    }
    page
}

/// Returns the `--json` document: exercises, and the verdict if there is an answer to check.
fn document(shown: &[&Exercise], verdict: Option<&Verdict>) -> Json {
    json!({
        "schema": {"name": "alberti-exercise", "version": VERSION},
        "exercises": shown.iter().map(|exercise| exercise_json(exercise)).collect::<Vec<_>>(),
        "verdict": verdict.map(verdict_json),
    })
}

fn exercise_json(exercise: &Exercise) -> Json {
    json!({
        "number": exercise.number,
        "title": words_json(exercise.title),
        "question": words_json(exercise.question),
        "form": sentence_json(&exercise.form()),
        "letters": exercise.letters,
        "hints": exercise.hints.iter().copied().map(words_json).collect::<Vec<_>>(),
    })
}

fn verdict_json(verdict: &Verdict) -> Json {
    let (kind, mistake) = match verdict {
        Verdict::Right => ("right", None),
        Verdict::Mistaken(mistake) => ("mistake", Some(mistake.id)),
        Verdict::Rounded => ("rounded", None),
        Verdict::Different { .. } => ("different", None),
    };
    let (mut differences, mut letters) = (Vec::new(), json!({}));
    if let Verdict::Different { differences: found, letters: at, .. } = verdict {
        differences.extend(found.iter().map(|difference| {
            json!({
                "row": difference.row + 1,
                "column": difference.column + 1,
                "name": sentence_json(&difference.name),
                "value": difference.value,
            })
        }));
        for (name, value) in at {
            letters[*name] = json!(value);
        }
    }
    json!({
        "kind": kind,
        "mistake": mistake,
        "sentence": sentence_json(&verdict.sentence()),
        "differences": differences,
        "letters": letters,
    })
}

fn words_json(words: Words) -> Json {
    json!({"en": words.en, "zh": words.zh})
}

fn sentence_json(sentence: &Sentence) -> Json {
    json!({"en": sentence.en, "zh": sentence.zh})
}
