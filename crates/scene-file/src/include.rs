//! Merges scene files that include others into one scene, and records the source of each part.
//!
//! ```text
//!  studio.ron ─┐
//!  paper.ron ──┴─► merged includes ─┐
//!  scene.ron ───────────────────────┴─► one scene; errors point into the file with the mistake
//! ```
//! Lists are concatenated, included files first; every other field of the including file replaces
//! the included value as a whole.

use super::file::{BackgroundFile, EnvironmentFile, ModelFile};
use super::include_map::{ElementSources, IncludeMap};
use super::mistake::Mistake;
use super::parse::{ParsedScene, read_recovering};
use super::scene_source::{SceneSource, normalize_path, read_scene_text};
use super::source_text::SourceText;
use super::syntax::PathStep::{Field, Index};
use super::{SceneError, SceneErrors, SceneFile};
use core::ops::Range;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// The maximum number of files that a scene includes, counting each inclusion.
const MAX_INCLUDED_FILES: usize = 64;
/// The maximum total size of included files in bytes, counting each inclusion. Without a limit, a
/// few lines could request a gigabyte of text.
const MAX_INCLUDED_BYTES: usize = 4 << 20;

/// The fields of a scene that are replaced as a whole.
const REPLACED_FIELDS: [&str; 15] = [
    "camera",
    "light_intensity",
    "shadows",
    "ground",
    "environment",
    "ambient_occlusion",
    "style",
    "depth_colormap",
    "image",
    "passes",
    "sheet",
    "camera_path",
    "stereo",
    "caption",
    "viewports_scale",
];

/// A mistake in one of a scene's files.
#[derive(Clone, Debug)]
pub struct FileMistake {
    /// The message, with the file's name and text.
    pub error: SceneError,
    /// The bytes of the field or element with the mistake; nothing else is reported in them.
    pub scope: Range<usize>,
}

impl SceneSource {
    /// Parses the text and the files it includes, which must be inside its folder or an `allowed`
    /// folder. Parts with mistakes are omitted from the scene.
    pub fn parse_recovering(&mut self, allowed: &[PathBuf]) -> (SceneFile, Vec<FileMistake>) {
        let GatheredScene { file, includes, mistakes } = gather_includes(self, allowed);
        self.includes = includes;
        (file, mistakes)
    }

    /// Parses the text and the files it includes, which must be inside its folder or an `allowed`
    /// folder. The returned scene contains everything that they contain, and includes nothing
    /// itself.
    ///
    /// # Errors
    /// Returns every mistake in the texts, or an error if an included file cannot be read, is not
    /// UTF-8 or is too long, or if files include each other.
    pub fn parse_with_includes(
        mut self,
        allowed: &[PathBuf],
    ) -> Result<(Self, SceneFile), SceneErrors> {
        let (file, mistakes) = self.parse_recovering(allowed);
        let errors = mistakes.into_iter().map(|mistake| mistake.error).collect();
        match SceneErrors::from_list(errors) {
            Some(errors) => Err(errors),
            None => Ok((self, file)),
        }
    }
}

/// A scene with everything it includes.
struct GatheredScene {
    /// The scene, without the parts that could not be read.
    file: SceneFile,
    includes: IncludeMap,
    /// The mistakes in the scene file, then the mistakes in the included files in reading order.
    mistakes: Vec<FileMistake>,
}

/// Parses a scene and the files it includes, depth first, and merges them.
///
/// The scene file itself is on the stack of open files from the start, so that including it is
/// detected as a cycle.
fn gather_includes(scene: &SceneSource, allowed: &[PathBuf]) -> GatheredScene {
    let mut resolver = IncludeResolver {
        scene,
        allowed,
        includes: IncludeMap::default(),
        mistakes: Vec::new(),
        is_full: false,
    };
    let source =
        SourceFile { file: None, name: &scene.file, text: &scene.text, folder: Path::new("") };
    let own_path = scene.folder.join(Path::new(&scene.file).file_name().unwrap_or_default());
    let mut open = vec![(normalize_path(Path::new(""), &own_path), scene.file.clone())];
    let MergedScene { file, fields, lists } = resolver.parse_source(&source, &mut open);
    let IncludeResolver { includes, mistakes, .. } = resolver;
    GatheredScene { file, includes: IncludeMap { fields, lists, ..includes }, mistakes }
}

/// A file that is being read.
struct SourceFile<'a> {
    /// Its index, if it is an included file.
    file: Option<usize>,
    name: &'a str,
    text: &'a SourceText,
    /// Its folder, relative to the scene's folder.
    folder: &'a Path,
}

impl SourceFile<'_> {
    /// Creates a mistake at the path of the include with this index.
    fn include_mistake(&self, index: usize, message: String, help: Option<&str>) -> FileMistake {
        let span = self.text.span_of(&[Field("include"), Index(index)]);
        let mistake = Mistake::new(span, message, help.map(str::to_owned));
        FileMistake { error: mistake.to_error(self.name, self.text), scope: mistake.scope }
    }
}

/// A file merged with everything it includes.
#[derive(Default)]
struct MergedScene {
    file: SceneFile,
    fields: BTreeMap<&'static str, Option<usize>>,
    lists: ElementSources,
}

/// Reads included files depth first, and collects the mistakes in all of them.
struct IncludeResolver<'a> {
    scene: &'a SceneSource,
    allowed: &'a [PathBuf],
    includes: IncludeMap,
    mistakes: Vec<FileMistake>,
    /// Whether the included files are too large.
    is_full: bool,
}

impl IncludeResolver<'_> {
    /// Parses a file and merges it over the files it includes; `open` is the stack of files being
    /// read, by normalized path and name.
    ///
    /// Later includes take precedence over earlier ones, and the file itself over all of them. A
    /// file with mistakes contributes the parts that could be read.
    fn parse_source(
        &mut self,
        source: &SourceFile<'_>,
        open: &mut Vec<(PathBuf, String)>,
    ) -> MergedScene {
        let ParsedScene { scene: mut file, mistakes, retained } = read_recovering(source.text);
        self.mistakes.extend(mistakes.into_iter().map(|mistake| FileMistake {
            error: mistake.to_error(source.name, source.text),
            scope: mistake.scope,
        }));
        let mut below = MergedScene::default();
        for (index, include) in std::mem::take(&mut file.include).0.iter().enumerate() {
            match self.load_include(&source.folder.join(include), open) {
                Ok(inner) => below = merge_scenes(below, inner),
                Err((message, help)) => {
                    self.mistakes.push(source.include_mistake(index, message, help));
                }
            }
        }
        rebase_paths(&mut file, source.folder);
        let fields = source.text.top_level_fields();
        let fields = REPLACED_FIELDS.into_iter().filter(|field| fields.contains(field));
        let fields = fields.map(|field| (field, source.file)).collect();
        let of_source =
            |indices: Vec<usize>| indices.into_iter().map(|at| (source.file, at)).collect();
        let lists =
            retained.into_iter().map(|(list, indices)| (list, of_source(indices))).collect();
        merge_scenes(below, MergedScene { file, fields, lists })
    }

    /// Loads an included file and merges it over the files it includes; `path` is relative to the
    /// scene's folder.
    ///
    /// A file may be included several times, but must not include itself; the error message shows
    /// the cycle.
    ///
    /// # Errors
    /// Returns the message and the help if the path leaves the allowed folders, if there are too
    /// many files, or if the file cannot be read or is already being read.
    fn load_include(
        &mut self,
        path: &Path,
        open: &mut Vec<(PathBuf, String)>,
    ) -> Result<MergedScene, (String, Option<&'static str>)> {
        if !self.scene.allows_path(path, self.allowed) {
            let help = "keep included files below the scene's folder, or allow another folder with --allow-outside DIR";
            let message =
                format!("the path \"{}\" points outside the scene's folder", path.display());
            return Err((message, Some(help)));
        }
        // The limit was already reported.
        if self.is_full {
            return Ok(MergedScene::default());
        }
        if self.includes.files.len() == MAX_INCLUDED_FILES {
            return Err((format!("a scene can include at most {MAX_INCLUDED_FILES} files"), None));
        }
        let whole = self.scene.folder.join(path);
        let normalized = normalize_path(Path::new(""), &whole);
        let name = whole.display().to_string();
        if let Some(first) = open.iter().position(|(other, _)| *other == normalized) {
            let names = open[first..].iter().map(|(_, name)| name.as_str()).chain([name.as_str()]);
            let circle = names.collect::<Vec<_>>().join(" → ");
            let help = Some("remove one of these includes");
            return Err((format!("the file includes itself: {circle}"), help));
        }
        let help = Some("check the path; it is relative to the folder of this file");
        let text = read_scene_text(&whole).map_err(|error| (error.to_string(), help))?;
        let text = SourceText::from(text);
        let read: usize = self.includes.files.iter().map(|(_, text)| text.len()).sum();
        if read + text.len() > MAX_INCLUDED_BYTES {
            self.is_full = true;
            let message = format!(
                "the included files total more than {MAX_INCLUDED_BYTES} bytes; a file counts each \
                 time it is included"
            );
            return Err((message, Some("include fewer or smaller files")));
        }
        let index = self.includes.files.len();
        self.includes.files.push((name.clone(), text.clone()));
        let folder = path.parent().unwrap_or(Path::new(""));
        open.push((normalized, name.clone()));
        let source = SourceFile { file: Some(index), name: &name, text: &text, folder };
        let merged = self.parse_source(&source, open);
        open.pop();
        Ok(merged)
    }
}

/// Makes the paths of a file in `folder` relative to the scene's folder, with forward slashes on
/// all systems.
///
/// When adding a field that holds a path, add it here too.
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
    for background in others.chain(&mut file.image.background) {
        if let BackgroundFile::Picture { path, .. } = background {
            rebased(path);
        }
    }
    file.sheet.iter_mut().filter_map(|sheet| sheet.title_block.as_mut()).for_each(rebased);
}

/// Merges a scene over another: lists are concatenated, and other fields are replaced as a whole if
/// `above` sets them.
///
/// The list of lights is optional: if one scene has none, the other's list is used unchanged.
fn merge_scenes(below: MergedScene, above: MergedScene) -> MergedScene {
    // Lists all fields by name, so that a new scene field must be concatenated or replaced here.
    let SceneFile {
        include,
        models,
        camera,
        camera_path,
        viewports,
        viewports_scale,
        stereo,
        lights,
        light_intensity,
        shadows,
        ground,
        environment,
        ambient_occlusion,
        style,
        depth_colormap,
        image,
        overlays,
        caption,
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
        viewports_scale: if has("viewports_scale") { viewports_scale } else { old.viewports_scale },
        stereo: if has("stereo") { stereo } else { old.stereo },
        lights: match (old.lights, lights) {
            (Some(old), Some(new)) => Some(concat_lists(old, new)),
            (old, new) => new.or(old),
        },
        light_intensity: if has("light_intensity") { light_intensity } else { old.light_intensity },
        shadows: if has("shadows") { shadows } else { old.shadows },
        ground: if has("ground") { ground } else { old.ground },
        environment: if has("environment") { environment } else { old.environment },
        ambient_occlusion: if has("ambient_occlusion") {
            ambient_occlusion
        } else {
            old.ambient_occlusion
        },
        style: if has("style") { style } else { old.style },
        depth_colormap: if has("depth_colormap") { depth_colormap } else { old.depth_colormap },
        image: if has("image") { image } else { old.image },
        overlays: concat_lists(old.overlays, overlays),
        caption: if has("caption") { caption } else { old.caption },
        passes: if has("passes") { passes } else { old.passes },
        sections: concat_lists(old.sections, sections),
        sheet: if has("sheet") { sheet } else { old.sheet },
    };
    let fields = below.fields.into_iter().chain(above.fields).collect();
    MergedScene { file, fields, lists: merge_sources(below.lists, above.lists) }
}

/// Returns the sources of the elements of concatenated lists.
fn merge_sources(below: ElementSources, above: ElementSources) -> ElementSources {
    let mut lists = below;
    for (list, elements) in above {
        lists.entry(list).or_default().extend(elements);
    }
    lists
}

/// Concatenates two lists, the included one first.
fn concat_lists<T>(below: Vec<T>, above: Vec<T>) -> Vec<T> {
    below.into_iter().chain(above).collect()
}
