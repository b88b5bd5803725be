//! The catalog of lessons as JSON.

use crate::lesson::{Choice, Domain, Lesson, Parameter};
use crate::lesson_state::STYLES;
use crate::lessons::LESSONS;
use crate::request::DEFAULT_SIZE;
use serde_json::{Value as Json, json};

/// Returns all lessons as JSON, in page order.
pub(crate) fn catalogue_json() -> Json {
    json!({
        "version": 1,
        "size": DEFAULT_SIZE,
        "styles": STYLES,
        "lessons": LESSONS.map(lesson_json),
    })
}

fn lesson_json(lesson: &Lesson) -> Json {
    json!({
        "id": lesson.id,
        "source": lesson.source.name(),
        "items": lesson.items,
        "title": lesson.title.to_json(),
        "statement": lesson.statement.to_json(),
        "models": lesson.models,
        "parameters": lesson.parameters.iter().map(parameter_json).collect::<Vec<_>>(),
        "panes": lesson.panes,
        "pin": lesson.pin,
        "orbit": lesson.orbit,
    })
}

fn parameter_json(parameter: &Parameter) -> Json {
    let Parameter { key, label, unit, domain } = parameter;
    let (label, key) = (label.to_json(), *key);
    match *domain {
        Domain::Number { min, max, step, default } => json!({
            "key": key, "label": label, "unit": unit, "kind": "number",
            "min": min, "max": max, "step": step, "default": default,
        }),
        Domain::Choice(choices) => {
            let choice = |Choice { value, label }: &Choice| json!({"value": value, "label": label.to_json()});
            json!({
                "key": key, "label": label, "unit": unit, "kind": "choice",
                "default": choices[0].value,
                "choices": choices.iter().map(choice).collect::<Vec<_>>(),
            })
        }
    }
}
