//! Program calls that write JSON, and the documents that they write.

use alberti_tests::harness::data_folder;
use alberti_tests::project_root;
use import::{ImportOptions, load};
use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// A document that the program wrote.
pub struct Document {
    /// The schema that it must match.
    pub schema: &'static str,
    pub case: String,
    pub json: Value,
}

/// The location of the documents of a call.
enum Place {
    /// Standard output, with one document after another.
    Output,
    /// A file.
    File(&'static str),
    /// Lines in the reports of a batch.
    Reports(&'static str),
}

/// A program call.
pub struct Call {
    pub case: String,
    schema: &'static str,
    arguments: Vec<String>,
    place: Place,
}

impl Call {
    fn new(schema: &'static str, line: &str) -> Self {
        Self::with_paths(schema, line, &[])
    }

    /// Creates a call in which each word `@` is replaced by the next of these paths.
    fn with_paths(schema: &'static str, line: &str, paths: &[&Path]) -> Self {
        let mut paths = paths.iter().map(|path| path.to_string_lossy().into_owned());
        let word = |word: &str| match word {
            "@" => paths.next().unwrap_or_default(),
            word => word.to_owned(),
        };
        let arguments: Vec<String> = line.split_whitespace().map(word).collect();
        Self { case: arguments.join(" "), schema, arguments, place: Place::Output }
    }

    /// Runs the call; returns the documents, or the program's message if there are none.
    pub fn run(&self, program: &Path, folder: &Path) -> Result<Vec<Document>, String> {
        let output = Command::new(program).args(&self.arguments).current_dir(folder).output();
        let output = output.map_err(|error| error.to_string())?;
        let text = match self.place {
            Place::Output => output.stdout,
            Place::File(name) => fs::read(folder.join(name)).map_err(|error| error.to_string())?,
            Place::Reports(name) => report_lines(&folder.join(name)),
        };
        let documents = serde_json::Deserializer::from_slice(&text).into_iter::<Value>();
        let document = |json: Result<Value, _>| {
            let json = json.map_err(|error: serde_json::Error| error.to_string())?;
            Ok(Document { schema: self.schema, case: self.case.clone(), json })
        };
        let documents: Vec<Document> = documents.map(document).collect::<Result<_, String>>()?;
        if documents.is_empty() {
            return Err(format!("no JSON: {}", String::from_utf8_lossy(&output.stderr)));
        }
        Ok(documents)
    }
}

/// Returns the lines of all reports in a folder and its subfolders.
fn report_lines(folder: &Path) -> Vec<u8> {
    let paths =
        fs::read_dir(folder).into_iter().flatten().filter_map(|entry| Some(entry.ok()?.path()));
    let text = |path: PathBuf| match path.extension() {
        Some(ending) if ending == "jsonl" => fs::read(&path).unwrap_or_default(),
        _ if path.is_dir() => report_lines(&path),
        _ => Vec::new(),
    };
    paths.flat_map(text).collect()
}

const WRONG_SCENE: &str =
    "Scene(models: [Model(path: \"gone.glb\")], camera: Camera(view: Frme()), image: 3)";
const ODD_SCENE: &str = "Scene(models: [Model(path: \"crate.glb\")], image: Image(size: (64, 48)), \
    lights: [Directional(direction: (0, 0, -1), intensity: 0)])";

/// Returns all calls, and writes the files they need to the folder in which they run.
pub fn all_calls(folder: &Path) -> Result<Vec<Call>, String> {
    let models = project_root().join("scenes/models");
    let write = |name: &str, text: &[u8]| {
        let path = folder.join(name);
        path.parent().map_or(Ok(()), fs::create_dir_all).and_then(|()| fs::write(&path, text))
    };
    let copies = ["crate.glb", "lamp.glb"].into_iter().flat_map(|name| {
        let bytes = fs::read(models.join(name)).unwrap_or_default();
        [(name.to_owned(), bytes.clone()), (format!("batch/{name}"), bytes)]
    });
    let texts =
        [("wrong.ron", WRONG_SCENE), ("odd.ron", ODD_SCENE), ("batch/broken.glb", "glTF, or not")];
    let texts = texts.map(|(name, text)| (name.to_owned(), text.as_bytes().to_vec()));
    for (name, bytes) in copies.chain(texts) {
        write(&name, &bytes).map_err(|error| format!("{name}: {error}"))?;
    }
    let mut calls = Vec::new();
    for scene in files_with_endings(&project_root().join("scenes"), &["ron"]) {
        let picture = format!("render @ --json --size 64x48 --samples 1 -o {}.png", calls.len());
        calls.push(Call::with_paths("render", &picture, &[&scene]));
        calls.push(Call::with_paths("check", "check @ --json", &[&scene]));
        calls.push(Call::with_paths("scene-check", "scene check @ wrong.ron --json", &[&scene]));
        calls.push(Call::with_paths("explain", "explain @ --point 0.1,0.2,0.3 --json", &[&scene]));
    }
    for path in model_files(&models)? {
        // A model that cannot be loaded has diagnostics, and a model without surfaces has no
        // picture.
        calls.push(Call::with_paths("check", "check @ --json", &[&path]));
        let Ok(model) = load(&path, &ImportOptions::default()) else { continue };
        calls.push(Call::with_paths("info", "info @ --json", &[&path]));
        if !model.animations.is_empty() {
            calls.push(Call::with_paths("info", "info @ --json --time 0.1", &[&path]));
        }
        if model.scene_primitives().next().is_some() {
            let picture =
                format!("render @ --json --size 64x48 --style ids -o {}.png", calls.len());
            calls.push(Call::with_paths("render", &picture, &[&path]));
        }
    }
    calls.extend(other_calls());
    Ok(calls)
}

/// Returns calls that each cover a special case.
fn other_calls() -> Vec<Call> {
    let mut calls: Vec<Call> = [
        ("render", "render crate.glb --json -o a.svg"),
        ("render", "render crate.glb lamp.glb --json --size 32x24 -o {stem}_b.png"),
        ("render", "render crate.glb --json --size 32x24 --crop 2,3,20,10 --bits 16 -o c.png"),
        ("check", "check wrong.ron --json"),
        ("check", "check odd.ron --json"),
        ("check", "check batch/broken.glb --json"),
        ("check", "check gone.glb --json"),
        ("explain", "explain crate.glb --size 64x48 --pixel 32,24 --json"),
        ("explain", "explain crate.glb --node 0 --json"),
        ("explain", "explain --planes 1,2 --point 2,3,4 --json"),
        ("explain", "matrix 1/2 0 0 -0.5 0 2/3 0 1/3 0 0 -0.5 2 0 0 0 1 --json"),
        ("explain", "matrix 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 --json"),
        ("explain", "matrix --frustum -1,3,-2,1,2,6 --conventions vulkan --json"),
        ("explain", "matrix --look-at 4,3,6,0,0,0 --point 3,2,-2 --json"),
        ("exercise", "exercise --json"),
        ("exercise", "exercise 3 --json"),
        ("exercise", "exercise 3 --answer A=n+f;B=-n*f --json"),
        ("exercise", "exercise 3 --answer A=n+f;B=n*f --json"),
        ("exercise", "exercise 3 --answer A=n+f;B=2f --json"),
        ("exercise", "exercise 16 --answer 3.81 --json"),
    ]
    .map(|(schema, line)| Call::new(schema, line))
    .into();
    let curve = Call::new("depth-curve", "curve depth --near 0.1 --far 1000 -o curve.json");
    calls.push(Call { place: Place::File("curve.json"), ..curve });
    let list = "sheet @ --parts-list=list.json --balloons -o assembly.pdf";
    let bearing = project_root().join("scenes/models/bearing.glb");
    let list = Call::with_paths("parts-list", list, &[&bearing]);
    calls.push(Call { place: Place::File("list.json"), ..list });
    let batch = Call::new("batch-record", "batch batch --out-dir out --size 32x24");
    calls.push(Call { place: Place::Reports("out"), ..batch });
    calls
}

/// Returns the scene models and up to eight small asset models in each format.
fn model_files(models: &Path) -> Result<Vec<PathBuf>, String> {
    const ENDINGS: [&str; 6] = ["glb", "gltf", "stl", "obj", "ply", "3mf"];
    let mut files = files_with_endings(models, &ENDINGS);
    if let Some(assets) = data_folder("ASSETS", "assets")? {
        let mut found = Vec::new();
        collect_files(&assets, &mut found);
        for ending in ENDINGS {
            let of_format =
                found.iter().filter(|path| has_ending(path, &[ending]) && is_small(path));
            files.extend(of_format.step_by(9).take(8).cloned());
        }
    }
    Ok(files)
}

fn is_small(path: &Path) -> bool {
    path.metadata().is_ok_and(|file| file.len() < 1 << 20)
}

fn has_ending(path: &Path, endings: &[&str]) -> bool {
    path.extension()
        .is_some_and(|ending| endings.iter().any(|known| ending.eq_ignore_ascii_case(known)))
}

/// Returns the files directly in a folder with one of these extensions, sorted.
fn files_with_endings(folder: &Path, endings: &[&str]) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).into_iter().flatten();
    let mut files: Vec<PathBuf> = entries
        .filter_map(|entry| Some(entry.ok()?.path()))
        .filter(|path| has_ending(path, endings))
        .collect();
    files.sort();
    files
}

/// Collects all files below a folder, sorted.
fn collect_files(folder: &Path, files: &mut Vec<PathBuf>) {
    let entries = fs::read_dir(folder).into_iter().flatten();
    let mut paths: Vec<PathBuf> = entries.filter_map(|entry| Some(entry.ok()?.path())).collect();
    paths.sort();
    for path in paths {
        if path.is_dir() { collect_files(&path, files) } else { files.push(path) }
    }
}
