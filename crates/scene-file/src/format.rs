//! The scene file formatter: one layout for all files.
//!
//! ```text
//!  text ─► tokens with their line breaks ─► groups of items ─► lines
//! ```
//! A group that fits on a line is written on one line; in any other group, each item is on a
//! separate line. Comments are kept. A group whose opening bracket is followed by a line break
//! stays open: the author decides which groups deserve several lines, and formatting again changes
//! nothing. Blank lines between items are kept, but consecutive ones become one.

mod tree;

use super::syntax::tokenize;
use super::{SceneError, SceneErrors, parse_scene};
use tree::{Element, FormatGroup, FormatItem, Part};

/// The maximum line width.
const MAX_LINE_WIDTH: usize = 100;
/// Columns per indentation level.
const INDENT_WIDTH: usize = 4;

/// Formats the text of a scene file. `file` is its name in messages.
///
/// ```
/// let text = "(models:[( path:\"a.glb\",translation:(1,2,3) )])";
/// let formatted = scene_file::format_source("scene.ron", text)?;
/// assert_eq!(formatted, "(models: [(path: \"a.glb\", translation: (1, 2, 3))])\n");
/// # Ok::<(), scene_file::SceneErrors>(())
/// ```
///
/// The result is parsed again and compared with the original scene, so that a bug in the formatter
/// cannot damage a file. Formatting is idempotent, and comments are never lost.
///
/// # Errors
/// Returns the mistakes in the text if it is not a scene file, or an error if formatting would
/// change its meaning.
pub fn format_source(file: &str, text: &str) -> Result<String, SceneErrors> {
    let scene = parse_scene(file, text)?;
    let top = tree::group_tokens(&tokenize(text));
    let mut page = String::new();
    write_items(&mut page, &top, 0, "");
    if parse_scene(file, &page).is_ok_and(|again| again == scene) {
        return Ok(page);
    }
    // No known text reaches this point, but if one does, the user's file must not be damaged.
    let message = "this file cannot be formatted without changing its meaning".to_owned();
    let error =
        SceneError { file: file.into(), source: text.into(), span: 0..0, message, help: None };
    Err(error.into())
}

/// Writes the items of a group, each starting on a new line; `comma` follows each element.
///
/// `indent` is in columns. At the top level `comma` is empty, because a file holds one value and
/// attributes. Consecutive blank lines become one, and blank lines at the start of a group are
/// dropped.
fn write_items(page: &mut String, items: &[FormatItem], indent: usize, comma: &str) {
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

/// Writes an element to the output line that starts at byte offset `line` of `page`. `behind`
/// columns follow the element on its last line.
///
/// Width is counted in characters, not bytes. Groups are tried from the outside in: the outermost
/// group that does not fit is broken, then its items are tried.
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

/// Formats the group on one line; returns `None` if it is open in the source, or contains a comment
/// or an open group.
///
/// Each level of nesting formats its groups again, so the cost is O(length × depth); the parser
/// bounds the depth.
fn single_line(group: &FormatGroup) -> Option<String> {
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
        assert_eq!(format_source("scene.ron", &once).expect("a scene"), once, "formatted again");
    }

    #[test]
    fn short_groups_get_one_line_and_open_groups_stay_open() {
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
    fn long_groups_are_broken_from_the_outside_in() {
        let path = "p".repeat(60);
        check(
            &format!("(models: [(path: \"{path}\"), (path: \"{path}\")])"),
            &format!(
                "(\n    models: [\n        (path: \"{path}\"),\n        (path: \"{path}\"),\n    ],\n)\n"
            ),
        );
    }

    #[test]
    fn comments_and_blank_lines_are_kept() {
        check(
            "\u{feff}#![enable(implicit_some)]\r\n// What it is.  \r\n\r\n\r\nScene( // all\r\n models: [(path: \"a//b.glb\")], // one\r\n\r\n\r\n /* a\n block */\n style: /* in */ Flat // the last\n // after\n)\n// end",
            "#![enable(implicit_some)]\n// What it is.\n\nScene(\n    // all\n    models: [(path: \"a//b.glb\")], // one\n\n    /* a\n block */\n    style: /* in */ Flat, // the last\n    // after\n)\n// end\n",
        );
    }

    #[test]
    fn comments_inside_an_element_move_before_it() {
        check(
            "(models: [(path: // where\n \"a.glb\")])",
            "(\n    models: [\n        (\n            // where\n            path: \"a.glb\",\n        ),\n    ],\n)\n",
        );
    }

    #[test]
    fn strings_are_unchanged() {
        check(
            "(models: [(path: \"a\\\"(,//.glb\"), (path: r#\"b\"(.glb\"#)])",
            "(models: [(path: \"a\\\"(,//.glb\"), (path: r#\"b\"(.glb\"#)])\n",
        );
    }

    #[test]
    fn attributes_end_at_their_closing_bracket() {
        check(
            "#![enable(implicit_some)] Scene(models: [])",
            "#![enable(implicit_some)]\nScene(models: [])\n",
        );
    }

    #[test]
    fn invalid_scenes_are_not_formatted() {
        for text in ["", "Scene(", "Scene(models: [)]", "Scene(modles: [])"] {
            assert!(format_source("scene.ron", text).is_err(), "{text}");
        }
    }
}
