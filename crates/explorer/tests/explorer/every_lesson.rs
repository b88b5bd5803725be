//! Every lesson: default and extreme values produce pictures, and all text is in both languages.

use super::{explorer_with_models, json, lessons};
use explorer::Explorer;
use serde_json::Value as Json;

/// Returns requests that set one parameter at a time to each end of its range or to each choice.
fn extreme_states(lesson: &Json) -> Vec<String> {
    let id = lesson["id"].as_str().expect("an id");
    let mut states = vec![format!("lesson={id}")];
    for parameter in lesson["parameters"].as_array().expect("parameters") {
        let key = parameter["key"].as_str().expect("a key");
        let values: Vec<String> = match parameter["choices"].as_array() {
            Some(choices) => choices
                .iter()
                .map(|choice| choice["value"].as_str().expect("a value").to_owned())
                .collect(),
            None => ["min", "max"].map(|end| parameter[end].to_string()).to_vec(),
        };
        states.extend(values.iter().map(|value| format!("lesson={id}&{key}={value}")));
    }
    states
}

/// Counts the pixels that differ from the upper left pixel.
fn drawn_pixels(pixels: &[u8]) -> usize {
    let pixels = pixels.as_chunks::<4>().0;
    pixels.iter().filter(|pixel| **pixel != pixels[0]).count()
}

fn drawn(explorer: &mut Explorer, what: &str, state: &str) -> usize {
    let query = format!("what={what}&size=96x60&samples=1&{state}");
    let answer = explorer.answer(&query).expect(&query);
    assert_eq!(answer.bytes.len(), 96 * 60 * 4, "{query}");
    drawn_pixels(&answer.bytes)
}

#[test]
fn default_and_extreme_values_produce_pictures() {
    let mut explorer = explorer_with_models();
    let own = std::fs::read(super::scenes_folder().join("models/teapot.glb")).expect("a teapot");
    explorer.add_file("teapot.glb", own).expect("a name");
    let scene = b"Scene(models: [Model(path: \"teapot.glb\")])".to_vec();
    explorer.add_file("own.ron", scene).expect("a name");
    for lesson in lessons(&mut explorer) {
        for mut state in extreme_states(&lesson) {
            state += match lesson["id"].as_str() {
                Some("model") => "&model=teapot.glb",
                Some("scene") => "&model=own.ron",
                _ => "",
            };
            for pane in lesson["panes"].as_array().expect("panes") {
                match pane.as_str().expect("a name") {
                    what @ ("picture" | "world" | "volume") => {
                        let drawn = drawn(&mut explorer, what, &state);
                        assert!(drawn > 60, "{what} of {state}: {drawn}");
                    }
                    "depth" => {
                        let answer = explorer.answer(&format!("what=depth&{state}")).expect("SVG");
                        assert!(answer.bytes.starts_with(b"<svg"), "{state}");
                    }
                    _ => {}
                }
            }
            let said = json(&mut explorer, &format!("what=state&{state}"));
            let link = said["link"].as_str().expect("a link");
            let again = json(&mut explorer, &format!("what=state&{}", &link[1..]));
            assert_eq!(said, again, "{state}");
            let text = said.to_string();
            for word in ["NaN", "inf", "-0 ", "-0,"] {
                let sentences = said["consequences"].to_string();
                assert!(!sentences.contains(word), "{state}: {word} in {sentences}");
            }
            assert!(text.len() > 1000, "{state}");
        }
    }
}

#[test]
fn every_lesson_can_be_a_line_drawing() {
    let mut explorer = explorer_with_models();
    for lesson in lessons(&mut explorer).iter().filter(|lesson| lesson["models"][0].is_string()) {
        let id = lesson["id"].as_str().expect("an id");
        let answer = explorer.answer(&format!("what=drawing&lesson={id}")).expect(id);
        let svg = String::from_utf8(answer.bytes).expect("text");
        assert!(svg.starts_with("<svg") && svg.contains("<path"), "{id}");
    }
}

/// Asserts that an object has English and Chinese text, the latter with Chinese characters.
fn assert_both_languages(words: &Json, what: &str) {
    let [en, zh] = ["en", "zh"].map(|language| words[language].as_str().expect("a text"));
    assert!(!en.is_empty() && en.is_ascii() || en.chars().all(|c| !is_chinese(c)), "{what}: {en}");
    assert!(zh.chars().any(is_chinese), "{what}: {zh}");
}

fn is_chinese(c: char) -> bool {
    ('\u{4e00}'..='\u{9fff}').contains(&c)
}

#[test]
fn all_text_is_in_both_languages() {
    let mut explorer = explorer_with_models();
    for lesson in lessons(&mut explorer) {
        let id = lesson["id"].as_str().expect("an id");
        assert_both_languages(&lesson["title"], id);
        assert_both_languages(&lesson["statement"], id);
        for parameter in lesson["parameters"].as_array().expect("parameters") {
            assert_both_languages(&parameter["label"], id);
        }
        if !lesson["models"][0].is_string() {
            continue;
        }
        let state = json(&mut explorer, &format!("what=state&lesson={id}"));
        let sentences = state["consequences"].as_array().expect("a list");
        assert!(!sentences.is_empty(), "{id}");
        for sentence in sentences {
            assert_both_languages(sentence, id);
        }
    }
}

/// A slider's default and maximum are on its steps.
#[test]
fn slider_defaults_and_maxima_are_on_steps() {
    let mut explorer = explorer_with_models();
    for lesson in lessons(&mut explorer) {
        for parameter in lesson["parameters"].as_array().expect("parameters") {
            let Some(min) = parameter["min"].as_f64() else { continue };
            let [max, step, default] =
                ["max", "step", "default"].map(|key| parameter[key].as_f64().expect("a number"));
            assert!(min <= default && default <= max, "{parameter}");
            for value in [default, max] {
                let steps = (value - min) / step;
                assert!((steps - steps.round()).abs() < 1e-6, "{} {parameter}", lesson["id"]);
            }
        }
    }
}
