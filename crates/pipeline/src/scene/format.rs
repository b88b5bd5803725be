//! One layout for scene files: what fits on a line stands on a line, all else has a line for each part; comments stay.
//!
//! ```text
//!  text ─► tokens with the line breaks before them ─► groups of items ─► lines
//! ```
//! A bracket that is followed by a line break stays open: the writer decides what is worth several lines, and nothing changes
//! when it is laid out again. Blank lines between items stay too, one at a time.

mod tokens;
mod tree;

pub(super) use tokens::{TokenKind, tokenize as tokens};

use super::{SceneError, parse_scene};
use tree::{Element, Group, Item, Part};

/// The longest line that is not broken.
const MAX_LINE_WIDTH: usize = 100;
/// Columns of a level.
const INDENT_WIDTH: usize = 4;

/// The text of a scene file in the usual layout. `file` is its name in messages.
///
/// # Errors
/// If the text is no scene file, or would say something else in another layout.
pub fn format_source(file: &str, text: &str) -> Result<String, SceneError> {
    let scene = parse_scene(file, text)?;
    let top = tree::group_tokens(&tokens::tokenize(text));
    let mut page = String::new();
    write_items(&mut page, &top, 0, "");
    if parse_scene(file, &page).is_ok_and(|again| again == scene) {
        return Ok(page);
    }
    // No text is known that comes here; a person's file is not the place to find one.
    let message = "this file cannot be laid out without changing what it says".to_owned();
    Err(SceneError { file: file.into(), source: text.into(), span: 0..0, message, help: None })
}

/// The items of a group, each on lines of its own; `comma` stands behind each element.
fn write_items(page: &mut String, items: &[Item], indent: usize, comma: &str) {
    for (number, item) in items.iter().enumerate() {
        if item.blank_before && number > 0 {
            page.push('\n');
        }
        let column = page.len();
        page.push_str(&" ".repeat(indent));
        if let Some(element) = &item.element {
            write_element(page, element, indent, column, comma.len());
            page.push_str(comma);
        }
        if let Some(comment) = &item.comment {
            if item.element.is_some() {
                page.push(' ');
            }
            page.push_str(comment);
        }
        page.push('\n');
    }
}

/// An element that begins on the line at `line` of the page, with room for `behind` columns after it.
fn write_element(page: &mut String, element: &Element, indent: usize, line: usize, behind: usize) {
    for part in &element.parts {
        match part {
            Part::Text(text) => page.push_str(text),
            Part::Group(group) => {
                let flat = single_line(group);
                let used = page[line..].chars().count();
                let fits = |flat: &&String| used + flat.chars().count() + behind <= MAX_LINE_WIDTH;
                if let Some(flat) = flat.as_ref().filter(fits) {
                    page.push_str(flat);
                } else {
                    page.push(group.open);
                    page.push('\n');
                    write_items(page, &group.items, indent + INDENT_WIDTH, ",");
                    page.push_str(&" ".repeat(indent));
                    page.push(group.close);
                }
            }
        }
    }
}

/// A group on one line, if it can be.
fn single_line(group: &Group) -> Option<String> {
    if group.multiline {
        return None;
    }
    let mut text = String::from(group.open);
    for (number, item) in group.items.iter().enumerate() {
        let element = item.element.as_ref().filter(|_| item.comment.is_none())?;
        if number > 0 {
            text.push_str(", ");
        }
        for part in &element.parts {
            match part {
                Part::Text(words) => text.push_str(words),
                Part::Group(inner) => text.push_str(&single_line(inner)?),
            }
        }
    }
    text.push(group.close);
    Some(text)
}

#[cfg(test)]
mod tests {
    use super::format_source;

    #[track_caller]
    fn check(text: &str, expected: &str) {
        let once = format_source("scene.ron", text).expect("a scene");
        assert_eq!(once, expected);
        assert_eq!(format_source("scene.ron", &once).expect("a scene"), once, "laid out again");
    }

    #[test]
    fn what_fits_is_one_line_and_what_is_open_stays_open() {
        check(
            "Scene(models:[(path:\"a.glb\",scale:2.)],style:Flat)",
            "Scene(models: [(path: \"a.glb\", scale: 2.)], style: Flat)\n",
        );
        check(
            "Scene(\n models:[(path:\"a.glb\")]  , camera:(\nview:LookAt(eye:( 1,2,3 ) ,target:(0,0,0,)),),)",
            "Scene(\n    models: [(path: \"a.glb\")],\n    camera: (\n        view: LookAt(eye: (1, 2, 3), target: (0, 0, 0)),\n    ),\n)\n",
        );
    }

    #[test]
    fn what_is_too_long_is_broken_from_outside() {
        let path = "p".repeat(60);
        check(
            &format!("(models: [(path: \"{path}\"), (path: \"{path}\")])"),
            &format!(
                "(\n    models: [\n        (path: \"{path}\"),\n        (path: \"{path}\"),\n    ],\n)\n"
            ),
        );
    }

    #[test]
    fn comments_and_blank_lines_stay() {
        check(
            "\u{feff}#![enable(implicit_some)]\r\n// What it is.  \r\n\r\n\r\nScene( // all\r\n models: [(path: \"a//b.glb\")], // one\r\n\r\n\r\n /* a\n block */\n style: /* in */ Flat // the last\n // after\n)\n// end",
            "#![enable(implicit_some)]\n// What it is.\n\nScene(\n    // all\n    models: [(path: \"a//b.glb\")], // one\n\n    /* a\n block */\n    style: /* in */ Flat, // the last\n    // after\n)\n// end\n",
        );
    }

    #[test]
    fn a_comment_inside_of_an_element_goes_before_it() {
        check(
            "(models: [(path: // where\n \"a.glb\")])",
            "(\n    models: [\n        (\n            // where\n            path: \"a.glb\",\n        ),\n    ],\n)\n",
        );
    }

    #[test]
    fn strings_are_left_as_they_are() {
        check(
            "(models: [(path: \"a\\\"(,//.glb\"), (path: r#\"b\"(.glb\"#)])",
            "(models: [(path: \"a\\\"(,//.glb\"), (path: r#\"b\"(.glb\"#)])\n",
        );
    }

    #[test]
    fn an_attribute_ends_with_its_bracket() {
        check(
            "#![enable(implicit_some)] Scene(models: [])",
            "#![enable(implicit_some)]\nScene(models: [])\n",
        );
    }

    #[test]
    fn no_scene_is_no_layout() {
        for text in ["", "Scene(", "Scene(models: [)]", "Scene(modles: [])"] {
            assert!(format_source("scene.ron", text).is_err(), "{text}");
        }
    }
}
