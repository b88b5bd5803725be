//! Parsing: from the text of a scene file to its parts, and to every mistake in it.

use super::SceneErrors;
use super::file::SceneFile;
use super::mistake::Mistake;
use super::schema::{Checked, Checker, SceneValue};
use super::syntax::{Node, NodeKind, SAMPLE_SCENE, SyntaxTree, parse_tree};
use std::collections::BTreeMap;

/// Parses the text of a scene file; `file` is its name in messages.
///
/// ```
/// let text = "Scene(models: [(path: \"a.glb\")], style: Falt, image: (siez: (9, 9)))";
/// let errors = pipeline::scene::parse_scene("scene.ron", text).expect_err("two mistakes");
/// assert_eq!(errors.iter().count(), 2);
/// assert_eq!(errors.first().help.as_deref(), Some("did you mean `Flat`?"));
/// ```
///
/// # Errors
/// Every error of grammar, unknown name, wrong type, missing field and value out of range, in the
/// order of the text.
pub fn parse_scene(file: &str, source: &str) -> Result<SceneFile, SceneErrors> {
    let source = strip_byte_order_mark(source);
    let parsed = parse_recovering(source);
    let error = |mistake: &Mistake| mistake.to_error(file, source);
    match SceneErrors::from_list(parsed.mistakes.iter().map(error).collect()) {
        Some(errors) => Err(errors),
        None => Ok(parsed.scene),
    }
}

/// A byte order mark is invisible, so it is accepted and ignored.
pub(super) fn strip_byte_order_mark(source: &str) -> &str {
    source.strip_prefix('\u{feff}').unwrap_or(source)
}

/// A scene and the mistakes in its text.
pub(super) struct ParsedScene {
    /// The scene without what could not be read.
    pub(super) scene: SceneFile,
    /// In the order of the text.
    pub(super) mistakes: Vec<Mistake>,
    /// For each list of the scene the indices of the elements that could be read.
    pub(super) retained: BTreeMap<&'static str, Vec<usize>>,
}

/// Parses a text without a byte order mark as far as possible.
pub(super) fn parse_recovering(source: &str) -> ParsedScene {
    let SyntaxTree { root, errors: mut mistakes, is_unreliable } = parse_tree(source);
    let mut scene = None;
    let mut retained = BTreeMap::new();
    if let Some(root) = root.filter(|_| !is_unreliable) {
        let mut checker = Checker::new(source);
        if is_scene(&root) {
            scene = SceneFile::from_node(&root, &mut checker);
        } else if root.kind != NodeKind::Invalid {
            let length = source[root.span.start..].chars().next().map_or(0, char::len_utf8);
            let start = root.span.start;
            checker.report(
                start..start + length,
                "this is not a scene",
                Some(SAMPLE_SCENE.to_owned()),
            );
        }
        let checked: Checked = checker.finish();
        mistakes.extend(checked.mistakes);
        retained = checked.retained;
    }
    mistakes.sort_by_key(|mistake| mistake.span.start);
    ParsedScene { scene: scene.unwrap_or_default(), mistakes, retained }
}

/// Whether a value is in the brackets of a struct; what is in them is another question.
fn is_scene(root: &Node<'_>) -> bool {
    root.group().is_some_and(|group| group.open == '(')
}
