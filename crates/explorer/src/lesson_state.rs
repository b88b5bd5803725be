//! The page state as a query string: a lesson, its values, the pinned point and the orbits.

use crate::ExplorerError;
use crate::lesson::{Choice, Domain, Lesson, Parameter, ParameterValue, Values, VolumeStage};
use crate::lessons::LESSONS;
use crate::model_store::LoadedScene;
use crate::query::Query;
use crate::request::DEFAULT_SIZE;
use crate::words::{Language, sentence};
use import::percent_encode;

/// The version of the query keys.
const VERSION: &str = "1";

/// The initial azimuth and elevation of the `volume` pane, in degrees.
const VOLUME_ORBIT: [f64; 2] = [35.0, 25.0];

/// The styles available for lessons, as named in scene files.
pub(crate) const STYLES: [&str; 14] = [
    "Shaded",
    "Flat",
    "Unlit",
    "Gouraud",
    "Clay",
    "Matcap",
    "Normals",
    "Depth",
    "UvChecker",
    "Ids",
    "Toon",
    "XRay",
    "Wireframe",
    "Lines",
];

/// The state of the page.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct LessonState {
    pub(crate) lesson: &'static Lesson,
    /// A value for each parameter of the lesson.
    pub(crate) parameters: Vec<ParameterValue>,
    /// The pinned point; `None` for the lesson's default.
    pin: Option<[f64; 3]>,
    orbit: Option<[f64; 2]>,
    volume_orbit: Option<[f64; 2]>,
    pub(crate) style: Option<&'static str>,
    /// The name of the user's own model.
    pub(crate) model: Option<String>,
    pub(crate) language: Language,
}

impl PartialEq for &'static Lesson {
    fn eq(&self, other: &Self) -> bool {
        self.id == other.id
    }
}

impl LessonState {
    /// Reads the state from the keys of a query and removes them.
    ///
    /// # Errors
    /// Returns an error if the version is unsupported, if the lesson or style is unknown, or if a
    /// value is malformed or out of range.
    pub(crate) fn take_from(query: &mut Query) -> Result<Self, ExplorerError> {
        check_version(query.take("v"))?;
        let language = take_language(query)?;
        let lesson = find_lesson(query.take("lesson").as_deref())?;
        let take = |parameter: &Parameter| match query.take(parameter.key) {
            None => Ok(parameter.default_value()),
            Some(text) => parse_value(parameter, &text, language),
        };
        let parameters = lesson.parameters.iter().map(take).collect::<Result<_, _>>()?;
        let pin = take_numbers(query, "pin", 1e9)?;
        let orbit = take_numbers(query, "orbit", 1e6)?;
        let volume_orbit = take_numbers(query, "volume_orbit", 1e6)?;
        let style = query.take("style").map(|style| find_style(&style)).transpose()?;
        let model = query.take("model").filter(|name| !name.is_empty());
        Ok(Self { lesson, parameters, pin, orbit, volume_orbit, style, model, language })
    }

    /// Returns this state with default numbers and the same choices.
    pub(crate) fn with_defaults(&self) -> Self {
        let default = |(parameter, value): (&Parameter, &ParameterValue)| match *value {
            ParameterValue::Number(_) => parameter.default_value(),
            choice @ ParameterValue::Choice(_) => choice,
        };
        let parameters = self.lesson.parameters.iter().zip(&self.parameters).map(default).collect();
        Self { parameters, style: None, ..self.clone() }
    }

    /// Returns the pinned point in world space: the chosen point, or else the lesson's default,
    /// which is a corner for the user's own model.
    pub(crate) fn pin(&self, loaded: &LoadedScene) -> [f64; 3] {
        let of_lesson = || (self.lesson.point)(&self.values(DEFAULT_SIZE));
        let of_model = || {
            let is_own = self.lesson.models.is_empty();
            let first = loaded.models.triangles.counted.first().filter(|_| is_own);
            first.map(|[corner, ..]| (*corner).into())
        };
        self.pin.or_else(of_lesson).or_else(of_model).unwrap_or(self.lesson.pin)
    }

    /// Returns the azimuth and elevation of the `world` pane in degrees.
    pub(crate) fn orbit(&self) -> [f64; 2] {
        self.orbit.unwrap_or(self.lesson.orbit)
    }

    /// Returns the azimuth and elevation of the `volume` pane in degrees.
    pub(crate) fn volume_orbit(&self) -> [f64; 2] {
        self.volume_orbit.unwrap_or(VOLUME_ORBIT)
    }

    /// Returns the values from which the lesson's scene is built.
    pub(crate) fn values(&self, size: [u32; 2]) -> Values<'_> {
        let model = self.model.as_deref();
        Values { lesson: self.lesson, parameters: &self.parameters, size, model }
    }

    /// Whether triangles are divided by w before they are clipped.
    pub(crate) fn is_torn(&self) -> bool {
        (self.lesson.volume)(&self.values(DEFAULT_SIZE)) == VolumeStage::Torn
    }

    /// Returns the link to the state: `#v=1&lesson=…`, without keys that have default values.
    pub(crate) fn to_link(&self) -> String {
        let mut link = format!("#v={VERSION}&lesson={}", self.lesson.id);
        for (parameter, value) in self.lesson.parameters.iter().zip(&self.parameters) {
            if *value != parameter.default_value() {
                link += &format!("&{}={}", parameter.key, value_text(*value));
            }
        }
        let mut add_numbers = |key: &str, values: Option<&[f64]>| {
            let Some(values) = values else { return };
            let texts: Vec<String> = values.iter().map(f64::to_string).collect();
            link += &format!("&{key}={}", texts.join(","));
        };
        add_numbers("pin", self.pin.as_ref().map(|pin| &pin[..]));
        add_numbers("orbit", self.orbit.as_ref().map(|orbit| &orbit[..]));
        add_numbers("volume_orbit", self.volume_orbit.as_ref().map(|orbit| &orbit[..]));
        link += &self.style.map_or(String::new(), |style| format!("&style={style}"));
        let model = self.model.as_ref().map(|name| format!("&model={}", percent_encode(name)));
        link + &model.unwrap_or_default()
    }
}

/// Formats a value for links.
pub(crate) fn value_text(value: ParameterValue) -> String {
    match value {
        ParameterValue::Number(number) => number.to_string(),
        ParameterValue::Choice(choice) => choice.to_owned(),
    }
}

fn check_version(version: Option<String>) -> Result<(), ExplorerError> {
    match version {
        Some(version) if version != VERSION => {
            let message = format!("unsupported link version `{version}`");
            let help = format!(
                "this program supports version {VERSION}; open the link with a newer program"
            );
            Err(ExplorerError::new("other_version", message, help))
        }
        _ => Ok(()),
    }
}

fn take_language(query: &mut Query) -> Result<Language, ExplorerError> {
    match query.take("lang").as_deref() {
        None | Some("en") => Ok(Language::English),
        Some("zh") => Ok(Language::Chinese),
        Some(other) => {
            let message = format!("unknown language `{other}`");
            Err(ExplorerError::new("malformed_value", message, "use lang=en or lang=zh"))
        }
    }
}

fn find_lesson(id: Option<&str>) -> Result<&'static Lesson, ExplorerError> {
    let Some(id) = id else { return Ok(LESSONS[0]) };
    LESSONS.into_iter().find(|lesson| lesson.id == id).ok_or_else(|| {
        let ids: Vec<&str> = LESSONS.iter().map(|lesson| lesson.id).collect();
        let message = format!("unknown lesson `{id}`");
        ExplorerError::new("unknown_lesson", message, format!("use one of {}", ids.join(", ")))
    })
}

fn find_style(name: &str) -> Result<&'static str, ExplorerError> {
    STYLES.into_iter().find(|style| *style == name).ok_or_else(|| {
        let message = format!("unknown style `{name}`");
        ExplorerError::new("malformed_value", message, format!("use one of {}", STYLES.join(", ")))
    })
}

/// Returns the name of a style in flags: `XRay` becomes `x-ray`, and `UvChecker` becomes `uv`.
pub(crate) fn style_flag(style: &str) -> String {
    match style {
        "UvChecker" => "uv".to_owned(),
        "XRay" => "x-ray".to_owned(),
        other => other.to_ascii_lowercase(),
    }
}

/// Parses the value of a parameter.
fn parse_value(
    parameter: &Parameter,
    text: &str,
    language: Language,
) -> Result<ParameterValue, ExplorerError> {
    let Parameter { key, domain, label, .. } = parameter;
    match *domain {
        Domain::Number { min, max, .. } => {
            let help = format!("use a number from {min} to {max}");
            let number = finite_number(text).ok_or_else(|| {
                let message = format!("`{key}` is not a number: `{text}`");
                ExplorerError::new("malformed_value", message, help.as_str())
            })?;
            if (min..=max).contains(&number) {
                return Ok(ParameterValue::Number(number));
            }
            Err(ExplorerError::in_language(
                "value_out_of_range",
                language,
                sentence(
                    format!("`{key}` is out of range: {number}"),
                    format!("{}（`{key}`）不能是 {number}", label.zh),
                ),
                sentence(help, format!("请给出 {min} 到 {max} 之间的数")),
            ))
        }
        Domain::Choice(choices) => {
            let found = choices.iter().find(|choice| choice.value == text);
            let known = || choices.iter().map(|Choice { value, .. }| *value).collect::<Vec<_>>();
            found.map(|choice| ParameterValue::Choice(choice.value)).ok_or_else(|| {
                let message = format!("`{key}` cannot be `{text}`");
                let help = format!("use one of {}", known().join(", "));
                ExplorerError::new("malformed_value", message, help)
            })
        }
    }
}

/// Parses a finite number.
fn finite_number(text: &str) -> Option<f64> {
    let number = text.parse::<f64>().ok().filter(|number| number.is_finite());
    // −0 would make a second link to the same state.
    number.map(|number| number + 0.0)
}

/// Removes a key and parses its `N` numbers, whose magnitudes must not exceed `limit`.
fn take_numbers<const N: usize>(
    query: &mut Query,
    key: &str,
    limit: f64,
) -> Result<Option<[f64; N]>, ExplorerError> {
    let Some(text) = query.take(key) else { return Ok(None) };
    let numbers = text.split(',').map(|number| finite_number(number.trim()));
    let numbers = numbers.collect::<Option<Vec<f64>>>();
    let numbers = numbers.and_then(|numbers| <[f64; N]>::try_from(numbers).ok());
    let numbers = numbers.filter(|all| all.iter().all(|number| number.abs() <= limit));
    numbers.map(Some).ok_or_else(|| {
        let message = format!("`{key}` cannot be `{text}`");
        let help = format!("use {N} numbers from -{limit} to {limit}, separated by commas");
        ExplorerError::new("malformed_value", message, help)
    })
}
