//! Requests: the state, what to return for it, and the size and format of pictures.

use crate::ExplorerError;
use crate::lesson_state::LessonState;
use crate::query::Query;
use scene_file::closest_name;

/// The default picture size. The lessons are designed for its aspect ratio.
pub(crate) const DEFAULT_SIZE: [u32; 2] = [640, 400];

/// The maximum side of a picture in pixels.
const MAX_SIDE: u32 = 8192;

/// The kind of answer.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub(crate) enum Question {
    Lessons,
    State,
    Picture,
    World,
    Volume,
    Depth,
    Drawing,
    Pick,
}

const QUESTIONS: [(&str, Question); 8] = [
    ("lessons", Question::Lessons),
    ("state", Question::State),
    ("picture", Question::Picture),
    ("world", Question::World),
    ("volume", Question::Volume),
    ("depth", Question::Depth),
    ("drawing", Question::Drawing),
    ("pick", Question::Pick),
];

/// The keys of requests and of all states.
const KEYS: [&str; 14] = [
    "what",
    "size",
    "samples",
    "rows",
    "format",
    "pixel",
    "v",
    "lesson",
    "pin",
    "orbit",
    "volume_orbit",
    "style",
    "model",
    "lang",
];

/// A request.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct Request {
    pub(crate) question: Question,
    pub(crate) state: LessonState,
    /// Width and height of the picture in pixels.
    pub(crate) size: [u32; 2],
    pub(crate) samples: u32,
    /// The first row of a band and the row after its last row.
    pub(crate) rows: Option<[u32; 2]>,
    pub(crate) is_png: bool,
    /// The column and row of a pixel.
    pub(crate) pixel: Option<[u32; 2]>,
}

impl Request {
    /// Parses a request.
    ///
    /// # Errors
    /// Returns an error if a key is unknown, a value is malformed, or a PNG band is requested.
    pub(crate) fn parse(text: &str) -> Result<Self, ExplorerError> {
        let mut query = Query::parse(text)?;
        let question = find_question(query.take("what").as_deref())?;
        let state = LessonState::take_from(&mut query)?;
        let size = take_pair(&mut query, "size", 'x')?.unwrap_or(DEFAULT_SIZE);
        if size.iter().any(|side| !(1..=MAX_SIDE).contains(side)) {
            let message = format!("invalid picture size {} x {}", size[0], size[1]);
            let help = format!("use sides from 1 to {MAX_SIDE} pixels");
            return Err(ExplorerError::new("malformed_value", message, help));
        }
        let samples = match query.take("samples").as_deref() {
            None | Some("4") => 4,
            Some("1") => 1,
            Some(other) => return Err(malformed("samples", other, "use samples=1 or samples=4")),
        };
        let is_png = match query.take("format").as_deref() {
            None | Some("rgba") => false,
            Some("png") => true,
            Some(other) => {
                return Err(malformed("format", other, "use format=rgba or format=png"));
            }
        };
        let rows = take_pair(&mut query, "rows", '-')?;
        check_rows(rows, size[1], is_png)?;
        let pixel = take_pair(&mut query, "pixel", ',')?;
        match query.first_key() {
            Some(key) => Err(unknown_key(key, &state)),
            None => Ok(Self { question, state, size, samples, rows, is_png, pixel }),
        }
    }
}

fn find_question(name: Option<&str>) -> Result<Question, ExplorerError> {
    let names = || QUESTIONS.map(|(name, _)| name).join(", ");
    let Some(name) = name else {
        let help = format!("set `what` to one of {}", names());
        return Err(ExplorerError::new("malformed_query", "missing key `what`", help));
    };
    let found = QUESTIONS.into_iter().find(|(known, _)| *known == name);
    found
        .map(|(_, question)| question)
        .ok_or_else(|| malformed("what", name, &format!("use one of {}", names())))
}

fn check_rows(rows: Option<[u32; 2]>, height: u32, is_png: bool) -> Result<(), ExplorerError> {
    let Some([from, to]) = rows else { return Ok(()) };
    let text = format!("{from}-{to}");
    if is_png {
        return Err(malformed("rows", &text, "remove `rows`, because a PNG contains all rows"));
    }
    if from < to && to <= height {
        return Ok(());
    }
    Err(malformed("rows", &text, &format!("use two increasing numbers from 0 to {height}")))
}

/// Removes a key and parses its two whole numbers.
fn take_pair(
    query: &mut Query,
    key: &str,
    separator: char,
) -> Result<Option<[u32; 2]>, ExplorerError> {
    let Some(text) = query.take(key) else { return Ok(None) };
    let pair =
        text.split_once(separator).and_then(|(a, b)| Some([a.parse().ok()?, b.parse().ok()?]));
    let help = format!("use two whole numbers such as {key}=0{separator}100");
    pair.map(Some).ok_or_else(|| malformed(key, &text, &help))
}

fn malformed(key: &str, value: &str, help: &str) -> ExplorerError {
    ExplorerError::new("malformed_value", format!("`{key}` cannot be `{value}`"), help)
}

/// Returns the error for an unknown key, and suggests a similar key.
fn unknown_key(key: &str, state: &LessonState) -> ExplorerError {
    let lesson = state.lesson;
    let own: Vec<&str> = lesson.parameters.iter().map(|parameter| parameter.key).collect();
    let help = match closest_name(key, &[&own, &KEYS[..]].concat()) {
        Some(similar) => format!("did you mean `{similar}`?"),
        None if own.is_empty() => format!("lesson `{}` has no parameters", lesson.id),
        None => format!("use a parameter of lesson `{}`: {}", lesson.id, own.join(", ")),
    };
    ExplorerError::new("unknown_key", format!("unknown key `{key}`"), help)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn error(text: &str) -> ExplorerError {
        Request::parse(text).expect_err(text)
    }

    #[test]
    fn a_misspelled_key_gets_a_suggestion() {
        for (wrong, right) in [("naer", "near"), ("Near", "near"), ("picel", "pixel")] {
            let error = error(&format!("what=picture&lesson=frustum&{wrong}=2"));
            let help = format!("did you mean `{right}`?");
            assert_eq!((error.code, error.help), ("unknown_key", help));
        }
        let error = error("what=picture&lesson=frustum&soup=2");
        assert!(error.help.starts_with("use a parameter of lesson `frustum`: "), "{}", error.help);
    }

    #[test]
    fn malformed_requests_are_reported() {
        for (text, code) in [
            ("", "malformed_query"),
            ("what=soup", "malformed_value"),
            ("what=state&v=2", "other_version"),
            ("what=state&lesson=x", "unknown_lesson"),
            ("what=state&lesson=frustum&near=NaN", "malformed_value"),
            ("what=state&lesson=frustum&near=1e300", "value_out_of_range"),
            ("what=state&lesson=frustum&apex=soup", "malformed_value"),
            ("what=state&pin=1,2", "malformed_value"),
            ("what=state&orbit=1,inf", "malformed_value"),
            ("what=state&style=Falt", "malformed_value"),
            ("what=picture&size=0x1", "malformed_value"),
            ("what=picture&size=99999x1", "malformed_value"),
            ("what=picture&samples=3", "malformed_value"),
            ("what=picture&size=8x8&rows=4-4", "malformed_value"),
            ("what=picture&size=8x8&rows=0-9", "malformed_value"),
            ("what=picture&rows=0-9&format=png", "malformed_value"),
            ("what=pick&pixel=1", "malformed_value"),
        ] {
            assert_eq!(error(text).code, code, "{text}");
        }
    }
}
