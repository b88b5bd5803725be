//! Lessons: statements, parameters, and the scenes built from the parameters.

use crate::facts::Facts;
use crate::lesson_scene::LessonScene;
use crate::lessons::{ALL_PANES, HOUSE};
use crate::number_text::scene_number;
use crate::words::{Sentence, Words, words};
use explain::ApiConventions;
use scene_file::SceneFile;

/// A lesson of the explorer.
#[derive(Debug)]
pub(crate) struct Lesson {
    /// The identifier in links.
    pub(crate) id: &'static str,
    /// The text that the lesson follows, if any.
    pub(crate) source: Source,
    /// The items of the source inventory that the lesson covers.
    pub(crate) items: &'static [&'static str],
    pub(crate) title: Words,
    /// The statement to be taught, in one or two sentences.
    pub(crate) statement: Words,
    /// The model files, as named in the scene.
    pub(crate) models: &'static [&'static str],
    pub(crate) parameters: &'static [Parameter],
    /// The panes that have something to show.
    pub(crate) panes: &'static [&'static str],
    /// The world-space point that is pinned initially.
    pub(crate) pin: [f64; 3],
    /// The initial azimuth and elevation of the `world` pane, in degrees.
    pub(crate) orbit: [f64; 2],
    /// The conventions of all reported numbers.
    pub(crate) conventions: ApiConventions,
    /// Builds the scene from the values. The request sets the picture size, sampling and style.
    pub(crate) describe: fn(&Values<'_>) -> LessonScene,
    /// A remark for readers of the scene file, placed after its title.
    pub(crate) remark: &'static str,
    /// The index of the first viewport that shows the model.
    pub(crate) first_view: usize,
    /// Describes the consequences of the values, except for clipping.
    pub(crate) consequences: fn(&Values<'_>, &Facts) -> Vec<Sentence>,
    /// The world-space point that is pinned initially, if it depends on the values.
    pub(crate) point: fn(&Values<'_>) -> Option<[f64; 3]>,
    /// The stage that the `volume` pane shows.
    pub(crate) volume: fn(&Values<'_>) -> VolumeStage,
    /// The picture position through which the line of sight is drawn, in fractions from the upper
    /// left corner. If `None`, the line passes through the pinned point.
    pub(crate) pointer: fn(&Values<'_>) -> Option<[f64; 2]>,
}

/// The stage of the pipeline at which the `volume` pane shows the model.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum VolumeStage {
    /// In the canonical view volume, clipped and then divided by w.
    Divided,
    /// Divided by w without clipping, and therefore torn where w changes sign.
    Torn,
    /// In view space, after this many of the frustum's affine factors: shear, then scale (VV-2).
    Factors(usize),
}

/// The front end of the house's ridge.
pub(crate) const RIDGE: [f64; 3] = [0.0, 4.38, 3.15];

impl Lesson {
    /// A lesson with the settings that most lessons share.
    pub(crate) const USUAL: Self = Self {
        id: "",
        source: Source::LearnWebGl,
        items: &[],
        title: words("", ""),
        statement: words("", ""),
        models: &[HOUSE],
        parameters: &[],
        panes: ALL_PANES,
        pin: RIDGE,
        orbit: [78.0, 20.0],
        conventions: ApiConventions::OpenGl,
        describe: |_| Ok(SceneFile::default()),
        remark: "",
        first_view: 0,
        consequences: |_, _| Vec::new(),
        point: |_| None,
        volume: |_| VolumeStage::Divided,
        pointer: |_| None,
    };

    /// Whether the lesson draws the user's own scene file unchanged and does not call `describe`.
    pub(crate) fn draws_own_file(&self) -> bool {
        self.id == "scene"
    }
}

/// The source of a lesson.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Source {
    /// The tutorial *Learn WebGL*.
    LearnWebGl,
    /// The chapter on viewing in *Fundamentals of Computer Graphics*.
    Chapter,
    /// The slides of a course on projections.
    Slides,
    /// The user's own model.
    Own,
}

impl Source {
    pub(crate) const fn name(self) -> &'static str {
        match self {
            Self::LearnWebGl => "learnwebgl",
            Self::Chapter => "chapter",
            Self::Slides => "slides",
            Self::Own => "own",
        }
    }
}

/// A control of a lesson.
#[derive(Debug)]
pub(crate) struct Parameter {
    pub(crate) key: &'static str,
    pub(crate) label: Words,
    /// The unit: `°`, `%`, or empty for scene units and plain ratios.
    pub(crate) unit: &'static str,
    pub(crate) domain: Domain,
}

/// The allowed values of a parameter.
#[derive(Debug)]
pub(crate) enum Domain {
    Number {
        min: f64,
        max: f64,
        step: f64,
        default: f64,
    },
    /// One of several choices; the first is the default.
    Choice(&'static [Choice]),
}

/// A choice of a parameter.
#[derive(Debug)]
pub(crate) struct Choice {
    pub(crate) value: &'static str,
    pub(crate) label: Words,
}

/// The parameters for the sides of a window on the near plane.
pub(crate) const WINDOW: [&str; 4] = ["left", "right", "bottom", "top"];
pub(crate) const PLANES: [&str; 2] = ["near", "far"];

/// Creates a number parameter from `range[0]` to `range[1]`.
pub(crate) const fn number(
    key: &'static str,
    label: Words,
    unit: &'static str,
    [min, max]: [f64; 2],
    [step, default]: [f64; 2],
) -> Parameter {
    Parameter { key, label, unit, domain: Domain::Number { min, max, step, default } }
}

/// Creates a choice parameter; the first choice is the default.
pub(crate) const fn choice(
    key: &'static str,
    label: Words,
    choices: &'static [Choice],
) -> Parameter {
    Parameter { key, label, unit: "", domain: Domain::Choice(choices) }
}

/// The value of a parameter.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) enum ParameterValue {
    Number(f64),
    Choice(&'static str),
}

impl Parameter {
    pub(crate) const fn default_value(&self) -> ParameterValue {
        match self.domain {
            Domain::Number { default, .. } => ParameterValue::Number(default),
            Domain::Choice(choices) => ParameterValue::Choice(choices[0].value),
        }
    }
}

/// The values of a lesson's parameters and everything else that its scene depends on.
#[derive(Clone, Debug)]
pub(crate) struct Values<'a> {
    pub(crate) lesson: &'static Lesson,
    /// A value for each parameter, in order.
    pub(crate) parameters: &'a [ParameterValue],
    /// Width and height of the picture in pixels.
    pub(crate) size: [u32; 2],
    /// The file that the `model` lesson shows.
    pub(crate) model: Option<&'a str>,
}

impl Values<'_> {
    /// Returns the numeric value of a parameter.
    pub(crate) fn number(&self, key: &str) -> f64 {
        let value = self.value(key);
        debug_assert!(
            matches!(value, Some(ParameterValue::Number(_))),
            "no number parameter {key}"
        );
        match value {
            Some(ParameterValue::Number(number)) => number,
            _ => 0.0,
        }
    }

    /// Returns the numeric values of parameters, formatted as in a scene file.
    pub(crate) fn scene_numbers<const N: usize>(&self, keys: [&str; N]) -> [f64; N] {
        keys.map(|key| scene_number(self.number(key)))
    }

    /// Returns the chosen value of a parameter.
    pub(crate) fn choice(&self, key: &str) -> &'static str {
        let value = self.value(key);
        debug_assert!(
            matches!(value, Some(ParameterValue::Choice(_))),
            "no choice parameter {key}"
        );
        match value {
            Some(ParameterValue::Choice(choice)) => choice,
            _ => "",
        }
    }

    fn value(&self, key: &str) -> Option<ParameterValue> {
        let at = self.lesson.parameters.iter().position(|parameter| parameter.key == key)?;
        self.parameters.get(at).copied()
    }

    /// Returns the aspect ratio of the picture.
    pub(crate) fn aspect(&self) -> f64 {
        f64::from(self.size[0]) / f64::from(self.size[1])
    }
}
