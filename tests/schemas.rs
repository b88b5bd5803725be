//! Checks the program's JSON documents against the published JSON Schemas with a validator for
//! draft 2020-12. The commands cover all scenes, models in all formats, broken files and the
//! explorer. `validate.py` validates their output.

mod documents;
mod server;

use alberti_tests::harness::{Arguments, Tally, map_parallel, run_program};
use alberti_tests::{program_path, project_root};
use documents::{Document, all_calls};
use serde_json::{Value, json};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};

pub fn run() -> ExitCode {
    run_program("schemas", |arguments| {
        let program = program_path()?;
        let mut tally = Tally::default();
        for (name, path) in schema_files()? {
            tally.record(
                &format!("reference --schema {name}"),
                check_printed(&program, &name, &path),
            );
        }
        tally.record("reference --schema nonsense", check_unknown_name(&program));
        tally.record("embedded schemas", check_embedded());
        let documents = collect_documents(&program, arguments, &mut tally)?;
        // Filters leave some schemas without documents.
        if arguments.filters().is_empty() {
            validate_documents(&documents, &mut tally)?;
        }
        Ok(tally)
    })
}

fn schema_folder() -> PathBuf {
    project_root().join("docs/schemas")
}

/// Returns all schemas with their names and files.
fn schema_files() -> Result<Vec<(String, PathBuf)>, String> {
    let folder = schema_folder();
    let entries =
        fs::read_dir(&folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    let mut files: Vec<(String, PathBuf)> = entries
        .filter_map(|entry| {
            let path = entry.ok()?.path();
            let name = path.file_name()?.to_str()?.strip_suffix(".schema.json")?.to_owned();
            Some((name, path))
        })
        .collect();
    files.sort();
    Ok(files)
}

/// Checks that `reference --schema` prints the file, and that the file's id contains the name.
fn check_printed(program: &Path, name: &str, path: &Path) -> Result<(), String> {
    let output = Command::new(program).args(["reference", "--schema", name]).output();
    let output = output.map_err(|error| error.to_string())?;
    let file = fs::read(path).map_err(|error| error.to_string())?;
    if !output.status.success() || output.stdout != file {
        return Err("it does not print the file".into());
    }
    let schema = read_json(path)?;
    let expected = format!("urn:alberti:{name}:1");
    if schema["$id"] != json!(expected) {
        return Err(format!("its $id is {}, not {expected}", schema["$id"]));
    }
    Ok(())
}

/// Checks that an unknown name is a usage error and that the message lists the known names.
fn check_unknown_name(program: &Path) -> Result<(), String> {
    let output = Command::new(program).args(["reference", "--schema", "nonsense"]).output();
    let output = output.map_err(|error| error.to_string())?;
    let said = String::from_utf8_lossy(&output.stderr);
    let lists_all = schema_files()?.iter().all(|(name, _)| said.contains(name.as_str()));
    let is_right = output.status.code() == Some(2) && lists_all;
    is_right.then_some(()).ok_or_else(|| format!("{}: {said}", output.status))
}

/// Checks that the schemas of the explorer's answers embed the schema of `explain`.
fn check_embedded() -> Result<(), String> {
    let read = |name: &str| read_json(&schema_folder().join(format!("{name}.schema.json")));
    let mut explain = read("explain")?;
    explain.as_object_mut().ok_or("it is not an object")?.remove("$schema");
    for name in ["explore-state", "explore-pick"] {
        if read(name)?["$defs"]["explanation"] != explain {
            return Err(format!("`explanation` of {name} does not match explain.schema.json"));
        }
    }
    Ok(())
}

fn read_json(path: &Path) -> Result<Value, String> {
    let text = fs::read(path).map_err(|error| format!("{}: {error}", path.display()))?;
    serde_json::from_slice(&text).map_err(|error| format!("{}: {error}", path.display()))
}

/// Returns the documents from all commands.
fn collect_documents(
    program: &Path,
    arguments: &Arguments,
    tally: &mut Tally,
) -> Result<Vec<Document>, String> {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("schemas");
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    let mut calls = all_calls(&folder)?;
    calls.retain(|call| arguments.select(&call.case));
    let outcomes = map_parallel(&calls, |_, call| call.run(program, &folder));
    let mut documents = Vec::new();
    for (call, outcome) in calls.iter().zip(outcomes) {
        match outcome {
            Ok(found) => documents.extend(found),
            Err(reason) => tally.fail(&call.case, &reason),
        }
    }
    if arguments.select("explore") {
        documents.extend(server::explorer_documents(program)?);
    }
    Ok(documents)
}

/// Passes all documents to the validator.
fn validate_documents(documents: &[Document], tally: &mut Tally) -> Result<(), String> {
    let file = Path::new(env!("CARGO_TARGET_TMPDIR")).join("schemas/documents.jsonl");
    let lines: String = documents
        .iter()
        .map(|Document { schema, case, json }| {
            format!("{}\n", json!({"schema": schema, "case": case, "document": json}))
        })
        .collect();
    fs::write(&file, lines).map_err(|error| format!("{}: {error}", file.display()))?;
    let script = project_root().join("tests/schemas/validate.py");
    let Some(python) = python_with_validator() else {
        tally
            .skip("schemas", "jsonschema is not installed for Python (Debian: python3-jsonschema)");
        return Ok(());
    };
    let output = Command::new(python).arg(script).arg(schema_folder()).arg(&file).output();
    let output = output.map_err(|error| format!("{python}: {error}"))?;
    let [said, problem] =
        [&output.stdout, &output.stderr].map(|text| String::from_utf8_lossy(text));
    for line in said.lines() {
        match line.strip_prefix("FAILED ") {
            Some(fault) => tally.fail("validation", fault),
            None => println!("{line}"),
        }
    }
    tally.record("validate.py", if problem.is_empty() { Ok(()) } else { Err(problem.into()) });
    tally.pass(documents.len());
    Ok(())
}

/// Returns a Python that has the validator: the first in the path, or the system's.
fn python_with_validator() -> Option<&'static str> {
    let has_validator = |python: &&str| {
        let call = "from jsonschema import Draft202012Validator";
        let output = Command::new(python).args(["-c", call]).output();
        output.is_ok_and(|output| output.status.success())
    };
    ["python3", "/usr/bin/python3"].into_iter().find(has_validator)
}
