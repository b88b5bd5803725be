//! Scene files that include others: put together, with a note of which part is written where.
//!
//! ```text
//!  studio.ron ─┐
//!  paper.ron ──┴─► what lies below ─┐
//!  scene.ron ───────────────────────┴─► one scene; errors point into the file that says it
//! ```
//! Lists are joined, what is included first; of every other field the including file's goes before the included ones', whole.

use super::file::{BackgroundFile, EnvironmentFile, ModelFile};
use super::origin::{normalize_path, read_scene_text};
use super::source_span::PathStep::{self, Field, Index};
use super::source_span::{has_field, span_of};
use super::{Origin, ResolveError, SceneError, SceneFile, parse_scene};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// The most files that one scene includes, each counted as often as it is.
const MAX_INCLUDED_FILES: usize = 64;

/// The fields of a scene that are taken whole.
const REPLACED_FIELDS: [&str; 10] = [
    "camera",
    "shadows",
    "ground",
    "environment",
    "ambient_occlusion",
    "style",
    "image",
    "sheet",
    "camera_path",
    "stereo",
];

/// Which parts of a scene are written in which included file. What is not here is in the scene file itself.
#[derive(Clone, PartialEq, Eq, Default, Debug)]
pub(super) struct IncludeMap {
    /// Name and text of each included file.
    files: Vec<(String, String)>,
    /// For each field that is taken whole the file it is in, by number.
    fields: BTreeMap<&'static str, Option<usize>>,
    /// For each element of a list the file it is in, and its number there.
    lists: BTreeMap<&'static str, Vec<(Option<usize>, usize)>>,
}

impl IncludeMap {
    /// Name and text of the included file that the value at the end of `path` is written in, and its path there.
    pub(super) fn resolve_source<'a>(
        &self,
        path: &[PathStep<'a>],
    ) -> (Option<(&str, &str)>, Vec<PathStep<'a>>) {
        let (file, path) = match *path {
            [Field(list), Index(at), ref rest @ ..] if self.lists.contains_key(list) => {
                let place = self.lists.get(list).and_then(|list| list.get(at));
                let (file, at) = place.copied().unwrap_or((None, at));
                (file, [&[Field(list), Index(at)], rest].concat())
            }
            [Field(field), ..] => (self.fields.get(field).copied().flatten(), path.to_vec()),
            _ => (None, path.to_vec()),
        };
        let source = file.and_then(|file| self.files.get(file));
        (source.map(|(name, text)| (name.as_str(), text.as_str())), path)
    }

    pub(super) fn included_texts(&self) -> impl Iterator<Item = &str> {
        self.files.iter().map(|(_, text)| text.as_str())
    }
}

/// The scene of a file and all that it includes.
pub(super) fn gather_includes(
    origin: &Origin,
    allowed: &[PathBuf],
) -> Result<(SceneFile, IncludeMap), ResolveError> {
    let own = parse_scene(&origin.file, &origin.text)?;
    if own.include.0.is_empty() {
        return Ok((own, IncludeMap::default()));
    }
    let mut gatherer = IncludeResolver { origin, allowed, written: IncludeMap::default() };
    let page =
        SourceFile { file: None, name: &origin.file, text: &origin.text, folder: Path::new("") };
    let own_path = origin.folder.join(Path::new(&origin.file).file_name().unwrap_or_default());
    let mut open = vec![(normalize_path(Path::new(""), &own_path), origin.file.clone())];
    let layer = gatherer.merge_includes(own, &page, &mut open)?;
    let MergedScene { file, fields, lists } = layer;
    Ok((file, IncludeMap { fields, lists, ..gatherer.written }))
}

/// A file that is being read.
struct SourceFile<'a> {
    /// Its number, if it is included.
    file: Option<usize>,
    name: &'a str,
    text: &'a str,
    /// Its folder, from that of the scene on.
    folder: &'a Path,
}

/// What one file says together with all that it includes.
#[derive(Default)]
struct MergedScene {
    file: SceneFile,
    fields: BTreeMap<&'static str, Option<usize>>,
    lists: BTreeMap<&'static str, Vec<(Option<usize>, usize)>>,
}

struct IncludeResolver<'a> {
    origin: &'a Origin,
    allowed: &'a [PathBuf],
    written: IncludeMap,
}

impl IncludeResolver<'_> {
    /// A file with what it includes below it. `open` are the files that are being read, each with its name.
    fn merge_includes(
        &mut self,
        mut file: SceneFile,
        page: &SourceFile<'_>,
        open: &mut Vec<(PathBuf, String)>,
    ) -> Result<MergedScene, ResolveError> {
        let mut below = MergedScene::default();
        for (number, include) in std::mem::take(&mut file.include).0.iter().enumerate() {
            let fault = |message: String, help: Option<String>| SceneError {
                file: page.name.to_owned(),
                source: page.text.to_owned(),
                span: span_of(page.text, &[Field("include"), Index(number)]),
                message,
                help,
            };
            let inner = self.load_include(&page.folder.join(include), open, fault)?;
            below = merge_scenes(below, inner);
        }
        rebase_paths(&mut file, page.folder);
        let said = REPLACED_FIELDS.into_iter().filter(|field| has_field(page.text, field));
        let elements = |count: usize| (0..count).map(|at| (page.file, at)).collect::<Vec<_>>();
        let lists = [
            ("models", elements(file.models.len())),
            ("lights", elements(file.lights.as_ref().map_or(0, Vec::len))),
            ("overlays", elements(file.overlays.len())),
            ("sections", elements(file.sections.len())),
            ("viewports", elements(file.viewports.len())),
        ];
        let fields = said.map(|field| (field, page.file)).collect();
        Ok(merge_scenes(below, MergedScene { file, fields, lists: lists.into() }))
    }

    /// An included file; `path` is its place from the scene's folder on.
    fn load_include(
        &mut self,
        path: &Path,
        open: &mut Vec<(PathBuf, String)>,
        fault: impl Fn(String, Option<String>) -> SceneError,
    ) -> Result<MergedScene, ResolveError> {
        let shown = path.display();
        if !self.origin.allows_path(path, self.allowed) {
            let help = "keep included files below the scene's folder, or allow another with --allow-outside DIR";
            let message = format!("the path \"{shown}\" leads out of the scene's folder");
            return Err(fault(message, Some(help.to_owned())).into());
        }
        if self.written.files.len() == MAX_INCLUDED_FILES {
            let message = format!("the scene includes more than {MAX_INCLUDED_FILES} files");
            return Err(fault(message, None).into());
        }
        let whole = self.origin.folder.join(path);
        let place = normalize_path(Path::new(""), &whole);
        let name = whole.display().to_string();
        if let Some(first) = open.iter().position(|(other, _)| *other == place) {
            let names = open[first..].iter().map(|(_, name)| name.as_str()).chain([name.as_str()]);
            let circle = names.collect::<Vec<_>>().join(" → ");
            let help = Some("remove one of these includes".to_owned());
            return Err(fault(format!("the file includes itself: {circle}"), help).into());
        }
        let help = "check the path: it begins at the folder of this file".to_owned();
        let text = read_scene_text(&whole).map_err(|error| fault(error.to_string(), Some(help)))?;
        let file = parse_scene(&name, &text)?;
        let number = self.written.files.len();
        self.written.files.push((name.clone(), text.clone()));
        let folder = path.parent().unwrap_or(Path::new(""));
        open.push((place, name.clone()));
        let layer = self.merge_includes(
            file,
            &SourceFile { file: Some(number), name: &name, text: &text, folder },
            open,
        )?;
        open.pop();
        Ok(layer)
    }
}

/// Makes the paths of a file in `folder` paths from the scene's own folder on. Every field that holds a path belongs here.
fn rebase_paths(file: &mut SceneFile, folder: &Path) {
    if folder.as_os_str().is_empty() {
        return;
    }
    let rebased =
        |path: &mut String| *path = folder.join(&*path).to_string_lossy().replace('\\', "/");
    file.models.iter_mut().for_each(|ModelFile { path, .. }| rebased(path));
    if let Some(EnvironmentFile::File { path, .. }) = &mut file.environment {
        rebased(path);
    }
    let others = file.viewports.iter_mut().filter_map(|viewport| viewport.background.as_mut());
    for background in others.chain([&mut file.image.background]) {
        if let BackgroundFile::Picture { path, .. } = background {
            rebased(path);
        }
    }
}

/// Two layers as one.
fn merge_scenes(below: MergedScene, above: MergedScene) -> MergedScene {
    // All fields by name: who adds one to the scene decides here whether it is joined or replaced.
    let SceneFile {
        include,
        models,
        camera,
        camera_path,
        viewports,
        stereo,
        lights,
        shadows,
        ground,
        environment,
        ambient_occlusion,
        style,
        image,
        overlays,
        passes,
        sections,
        sheet,
    } = above.file;
    let old = below.file;
    let has = |field: &str| above.fields.contains_key(field);
    let file = SceneFile {
        include,
        models: concat_lists(old.models, models),
        camera: if has("camera") { camera } else { old.camera },
        camera_path: if has("camera_path") { camera_path } else { old.camera_path },
        viewports: concat_lists(old.viewports, viewports),
        stereo: if has("stereo") { stereo } else { old.stereo },
        lights: match (old.lights, lights) {
            (Some(old), Some(new)) => Some(concat_lists(old, new)),
            (old, new) => new.or(old),
        },
        shadows: if has("shadows") { shadows } else { old.shadows },
        ground: if has("ground") { ground } else { old.ground },
        environment: if has("environment") { environment } else { old.environment },
        ambient_occlusion: if has("ambient_occlusion") {
            ambient_occlusion
        } else {
            old.ambient_occlusion
        },
        style: if has("style") { style } else { old.style },
        image: if has("image") { image } else { old.image },
        overlays: concat_lists(old.overlays, overlays),
        passes: if has("passes") { passes } else { old.passes },
        sections: concat_lists(old.sections, sections),
        sheet: if has("sheet") { sheet } else { old.sheet },
    };
    let fields = below.fields.into_iter().chain(above.fields).collect();
    let mut lists = below.lists;
    for (list, elements) in above.lists {
        lists.entry(list).or_default().extend(elements);
    }
    MergedScene { file, fields, lists }
}

fn concat_lists<T>(below: Vec<T>, above: Vec<T>) -> Vec<T> {
    below.into_iter().chain(above).collect()
}
