//! Parsing: reads a scene file with `ron`, and finds every mistake in its text if `ron` rejects it.
//!
//! ```text
//!  text ─► ron ─► SceneFile
//!           └─ rejected ─► checker ─► all mistakes ─► tree without them ─► ron ─► what can be read
//! ```

use super::SceneErrors;
use super::file::SceneFile;
use super::mistake::{MAX_MISTAKES, Mistake};
use super::ron_options::scene_ron_options;
use super::schema::{Checker, SceneValue as _};
use super::source_text::SourceText;
use super::syntax::{Group, Node, NodeKind, SAMPLE_SCENE, SyntaxItem, SyntaxTree, parse_tree};
use core::ops::Range;
use ron::error::Position;
use std::collections::BTreeMap;

/// Parses the text of a scene file; `file` is its name in messages.
///
/// ```
/// let text = "Scene(models: [(path: \"a.glb\")], style: Falt, image: (siez: (9, 9)))";
/// let errors = scene_file::parse_scene("scene.ron", text).expect_err("two mistakes");
/// assert_eq!(errors.iter().count(), 2);
/// assert_eq!(errors.first().help.as_deref(), Some("did you mean `Flat`?"));
/// ```
///
/// # Errors
/// Returns every syntax error, unknown name, wrong type, missing field and out-of-range value, in
/// text order.
pub fn parse_scene(file: &str, source: &str) -> Result<SceneFile, SceneErrors> {
    let source = strip_byte_order_mark(source);
    let parsed = read_recovering(source);
    let text = SourceText::default();
    let text = if parsed.mistakes.is_empty() { text } else { source.into() };
    let error = |mistake: &Mistake| mistake.to_error(file, &text);
    match SceneErrors::from_list(parsed.mistakes.iter().map(error).collect()) {
        Some(errors) => Err(errors),
        None => Ok(parsed.scene),
    }
}

/// Removes a byte order mark. It is accepted because authors cannot see it.
pub(super) fn strip_byte_order_mark(source: &str) -> &str {
    source.strip_prefix('\u{feff}').unwrap_or(source)
}

/// A scene and the mistakes in its text.
#[derive(Default)]
pub(super) struct ParsedScene {
    /// The scene, without the parts that could not be read.
    pub(super) scene: SceneFile,
    /// The mistakes, in text order.
    pub(super) mistakes: Vec<Mistake>,
    /// For each list of the scene, the indices of the elements that could be read.
    pub(super) retained: BTreeMap<&'static str, Vec<usize>>,
}

/// The lists of a scene, by field name.
const LISTS: [&str; 5] = ["models", "viewports", "lights", "overlays", "sections"];

/// The maximum number of times a text is reread without the parts that `ron` rejected.
const MAX_READINGS: usize = 8;

/// Reads a scene with `ron`. If that fails, reports every mistake and reads the parts without
/// mistakes. The text has no byte order mark.
pub(super) fn read_recovering(source: &str) -> ParsedScene {
    let error = match scene_ron_options().from_str::<SceneFile>(source) {
        Ok(scene) => {
            let lengths = [
                scene.models.len(),
                scene.viewports.len(),
                scene.lights.as_ref().map_or(0, Vec::len),
                scene.overlays.len(),
                scene.sections.len(),
            ];
            let whole = lengths.map(|length| (0..length).collect());
            let retained = LISTS.into_iter().zip(whole).collect();
            return ParsedScene { scene, mistakes: Vec::new(), retained };
        }
        Err(error) => error,
    };
    let (tree, mut mistakes) = check_text(source);
    if let Some(mistake) = hash_comment(source) {
        // Messages about the words of the comment would only mislead.
        return ParsedScene { mistakes: vec![mistake], ..ParsedScene::default() };
    }
    if mistakes.is_empty() {
        let start = offset_of(source, error.span.start);
        let end = source[start..].chars().next().map_or(start, |c| start + c.len_utf8());
        mistakes.push(Mistake::new(start..end, error.code.to_string(), None));
    }
    let mut parsed = ParsedScene { mistakes, ..ParsedScene::default() };
    if let Some(root) = tree {
        parsed.read_rest(&root);
    }
    parsed
}

/// Returns the mistake in a line that begins with `#`, as comments do in Python, YAML and shells.
fn hash_comment(source: &str) -> Option<Mistake> {
    let mut start = 0;
    for line in source.split_inclusive('\n') {
        let text = line.trim_start();
        let at = start + line.len() - text.len();
        start += line.len();
        let before = &source[..at];
        let is_comment = before.matches("/*").count() > before.matches("*/").count();
        if text.starts_with('#') && !text.starts_with("#!") && !is_comment {
            let help = "start comments with `//`".to_owned();
            return Some(Mistake::new(at..at + 1, "unexpected `#`".to_owned(), Some(help)));
        }
    }
    None
}

/// Returns the tree of a text, unless it is unreliable, and every mistake in the text, in order.
fn check_text(source: &str) -> (Option<Node<'_>>, Vec<Mistake>) {
    let SyntaxTree { root, errors: mut mistakes, is_unreliable } = parse_tree(source);
    let root = root.filter(|_| !is_unreliable);
    if let Some(root) = &root {
        let mut checker = Checker::new(source);
        if is_scene(root) {
            checker.check(root, &SceneFile::value_type());
        } else if root.kind != NodeKind::Invalid {
            let start = root.span.start;
            let length = source[start..].chars().next().map_or(0, char::len_utf8);
            checker.report(start..start + length, "this is not a scene", Some(other_text(source)));
            // Syntax errors are misleading if the text is in another language.
            mistakes.clear();
        }
        mistakes.extend(checker.finish());
    }
    mistakes.sort_by_key(|mistake| mistake.span.start);
    if let Some(next) = mistakes.get(MAX_MISTAKES) {
        let message = format!("there are more than {MAX_MISTAKES} mistakes");
        let help = "correct the mistakes above first; the rest are not reported".to_owned();
        let last = Mistake::new(next.span.clone(), message, Some(help));
        mistakes.truncate(MAX_MISTAKES);
        mistakes.push(last);
    }
    (root, mistakes)
}

/// Returns the help for a text that is not a scene: the language it seems to be written in, and a
/// sample scene.
fn other_text(source: &str) -> String {
    let text = source.trim_start();
    let begins_field = |line: &str| {
        let name = line.split(':').next().unwrap_or_default();
        line.trim_end().ends_with(':') && name.chars().all(|c| c.is_alphanumeric() || c == '_')
    };
    let language = if text.starts_with(['{', '[']) && text.contains('"') {
        "this looks like JSON, but scenes are written in RON; "
    } else if text.starts_with("---") || begins_field(text.lines().next().unwrap_or_default()) {
        "this looks like YAML, but scenes are written in RON; "
    } else if text.starts_with('<') {
        "this looks like XML, but scenes are written in RON; "
    } else {
        ""
    };
    format!("{language}{SAMPLE_SCENE}")
}

impl ParsedScene {
    /// Reads the scene without the fields and elements that contain mistakes, so that semantic
    /// errors in the rest are reported in the same run.
    ///
    /// If a required field is lost, the value that contains it is omitted too.
    fn read_rest(&mut self, root: &Node<'_>) {
        let mut removed: Vec<Range<usize>> =
            self.mistakes.iter().map(|mistake| mistake.scope.clone()).collect();
        for _ in 0..MAX_READINGS {
            let spans = RemovedSpans::new(&removed);
            let mut rest = Rest { removed: &spans, text: String::new(), items: Vec::new() };
            rest.write(root);
            let error = match scene_ron_options().from_str::<SceneFile>(&rest.text) {
                Ok(scene) => {
                    self.scene = scene;
                    self.retained = retained_elements(root, &spans);
                    return;
                }
                Err(error) => error,
            };
            match rest.innermost_item(offset_of(&rest.text, error.span.start)) {
                Some(span) => removed.push(span),
                None => return,
            }
        }
    }
}

/// The text of a tree, without some of its fields and elements.
struct Rest<'a> {
    /// The omitted bytes of the source.
    removed: &'a RemovedSpans,
    text: String,
    /// For each remaining field and element, its bytes in this text and in the source.
    items: Vec<(Range<usize>, Range<usize>)>,
}

impl Rest<'_> {
    fn write(&mut self, node: &Node<'_>) {
        match &node.kind {
            NodeKind::Number(text) | NodeKind::Word(text) | NodeKind::String(text) => {
                self.text.push_str(text);
            }
            NodeKind::Group(Group { name, open, items }) => {
                self.text.push_str(name.as_ref().map_or("", |name| name.name));
                self.text.push(*open);
                items.iter().for_each(|item| self.write_item(item));
                self.text.push(match open {
                    '[' => ']',
                    '{' => '}',
                    _ => ')',
                });
            }
            NodeKind::Invalid => {}
        }
    }

    fn write_item(&mut self, item: &SyntaxItem<'_>) {
        if item.value.kind == NodeKind::Invalid || self.removed.contains(&item.span()) {
            return;
        }
        let start = self.text.len();
        if let Some(key) = &item.key {
            self.text.push_str(key.name);
            self.text.push(':');
        }
        self.write(&item.value);
        self.items.push((start..self.text.len(), item.span()));
        self.text.push(',');
    }

    /// Returns the smallest field or element around a position in the text, as bytes of the source.
    fn innermost_item(&self, at: usize) -> Option<Range<usize>> {
        let around = self.items.iter().filter(|(here, _)| here.start <= at && at <= here.end);
        around.min_by_key(|(here, _)| here.len()).map(|(_, source)| source.clone())
    }
}

/// Ranges of omitted bytes, sorted for fast searches because a text may have as many mistakes as
/// fields.
struct RemovedSpans(Vec<Range<usize>>);

impl RemovedSpans {
    fn new(removed: &[Range<usize>]) -> Self {
        let mut spans = removed.to_vec();
        spans.sort_by_key(|span| span.start);
        // Extends each span to the largest end so far.
        let mut end = 0;
        for span in &mut spans {
            end = end.max(span.end);
            span.end = end;
        }
        Self(spans)
    }

    /// Whether a range is within one of these ranges.
    fn contains(&self, span: &Range<usize>) -> bool {
        let count = self.0.partition_point(|outer| outer.start <= span.start);
        count > 0 && span.end <= self.0[count - 1].end
    }
}

/// Returns, for each list of a scene, the indices of the elements that remain.
fn retained_elements(
    root: &Node<'_>,
    removed: &RemovedSpans,
) -> BTreeMap<&'static str, Vec<usize>> {
    let items = root.group().map_or(&[][..], |group| &group.items);
    let elements = |list: &'static str| {
        let is_list =
            |item: &&SyntaxItem<'_>| item.key.as_ref().is_some_and(|key| key.name == list);
        let field = items.iter().find(is_list)?;
        let group = field.value.group().filter(|_| !removed.contains(&field.span()))?;
        let is_there = |(_, item): &(usize, &SyntaxItem<'_>)| !removed.contains(&item.span());
        let indices = group.items.iter().enumerate().filter(is_there).map(|(index, _)| index);
        Some((list, indices.collect()))
    };
    LISTS.into_iter().filter_map(elements).collect()
}

/// Returns the byte offset of a position from `ron`, which counts lines and characters from 1.
fn offset_of(source: &str, position: Position) -> usize {
    let mut lines = source.split_inclusive('\n');
    let before: usize = lines.by_ref().take(position.line.saturating_sub(1)).map(str::len).sum();
    let line = lines.next().unwrap_or("");
    let column = line.char_indices().nth(position.col.saturating_sub(1));
    before + column.map_or(line.len(), |(offset, _)| offset)
}

/// Whether a value is in parentheses, as a scene is; the contents do not matter.
fn is_scene(root: &Node<'_>) -> bool {
    root.group().is_some_and(|group| group.open == '(')
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::syntax::tokenize;
    use std::fs;
    use std::path::Path;

    /// The number of mutants in a second-tier run; the first tier uses a tenth of it.
    const MUTANTS: usize = 20_000;

    /// Replacements for tokens in mutants.
    const OTHERS: [&str; 24] = [
        "(",
        ")",
        "[",
        "]",
        "{",
        "}",
        ",",
        ":",
        "None",
        "Some(1)",
        "true",
        "0",
        "-1",
        "1e400",
        "0x10",
        "1_000",
        ".5",
        "\"a\"",
        "r#\"b\"#",
        "/* c */",
        "// d\n",
        "Shaded",
        "Finite(1)",
        "'x'",
    ];

    /// Asserts that `ron` reads exactly the texts in which the checker finds no mistakes.
    #[track_caller]
    fn assert_same(text: &str) -> bool {
        let read = scene_ron_options().from_str::<SceneFile>(text);
        let (_, mistakes) = check_text(text);
        let messages: Vec<_> = mistakes.iter().map(|mistake| &mistake.message).collect();
        match &read {
            Ok(_) => assert!(messages.is_empty(), "`ron` reads it, but: {messages:?}\n{text}"),
            Err(error) => assert!(!messages.is_empty(), "no mistake found, but: {error}\n{text}"),
        }
        read.is_ok()
    }

    /// Returns the texts of the files with this ending in a folder of the repository.
    fn texts_in(folder: &str, ending: &str) -> Vec<String> {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(folder);
        let mut paths: Vec<_> = fs::read_dir(folder)
            .expect("the folder exists")
            .map(|entry| entry.expect("a readable folder").path())
            .filter(|path| path.to_string_lossy().ends_with(ending))
            .collect();
        paths.sort();
        paths.iter().map(|path| fs::read_to_string(path).expect("a readable scene")).collect()
    }

    /// Errors name the field even if a scene is read only with serde.
    #[test]
    fn errors_from_other_readers_name_the_field() {
        let text = "Scene(models: [(path: \"a.glb\"), (path: \"b.glb\", crease_degrees: \"x\")])";
        let error = scene_ron_options().from_str::<SceneFile>(text).expect_err("a string");
        assert!(error.to_string().contains("`models[1].crease_degrees`: "), "{error}");
        let text = "(camera: (projection: Perspective(fov_y_degrees: 500)))";
        let error = scene_ron_options().from_str::<SceneFile>(text).expect_err("an angle");
        let told = "`camera.projection.fov_y_degrees`: expected an angle between 0 and 180 degrees";
        assert!(error.to_string().contains(told), "{error}");
    }

    #[test]
    fn the_checker_finds_mistakes_exactly_where_ron_fails() {
        let scenes = texts_in("scenes", ".ron");
        assert!(scenes.len() > 30);
        for folder in ["book/scenes", "docs/exercises"] {
            assert!(texts_in(folder, ".ron").iter().all(|text| assert_same(text)), "{folder}");
        }
        // Inputs found by fuzzing need not be scenes.
        for folder in ["tests/fuzz/corpus/scene", "tests/fuzz/corpus/include"] {
            let texts = texts_in(folder, "");
            assert!(!texts.is_empty(), "{folder}");
            for text in &texts {
                assert_same(text);
            }
        }
        assert!(scenes.iter().all(|text| assert_same(text)));
        let mut state = 1_u64;
        let mut below = |count: usize| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            (state >> 33) as usize % count
        };
        let mut read = 0;
        let count = if std::env::var_os("THOROUGH").is_some() { MUTANTS } else { MUTANTS / 10 };
        for _ in 0..count {
            let text = &scenes[below(scenes.len())];
            let mut words: Vec<&str> = tokenize(text).iter().map(|token| token.text).collect();
            let at = below(words.len());
            match below(4) {
                0 => drop(words.remove(at)),
                1 => words.insert(at, OTHERS[below(OTHERS.len())]),
                2 => words[at] = OTHERS[below(OTHERS.len())],
                _ => words[at] = words[below(words.len())],
            }
            read += usize::from(assert_same(&words.join("\n")));
        }
        assert!((count / 100..count).contains(&read), "{read} mutants are scenes");
    }
}
