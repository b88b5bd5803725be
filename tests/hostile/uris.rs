//! URIs that try to leave the folder, and URIs that only appear to.

use crate::hostile::case::{Expected, check_load_result, check_path};
use alberti_tests::gltf::Document;
use import::{ImportOptions, Limits, load_bytes};
use serde_json::json;
use std::fs;
use std::path::Path;

const OUTSIDE: &str = "copy the file next to the model and refer to it by a relative path, or \
                       allow its folder with --allow-outside DIR";

/// The name of a case, and its error.
pub type UriResult = (String, Result<(), String>);

/// Runs the cases in a separate folder; returns the outcome of each.
pub fn run_uri_cases(folder: &Path) -> Result<Vec<UriResult>, String> {
    let models = folder.join("models");
    create_files(folder, &models).map_err(|error| error.to_string())?;
    let mut results = Vec::new();
    for (uri, expected) in uri_table(&models) {
        let document = Document::single_triangle().with_value("/buffers/0/uri", json!(uri));
        let file = models.join("model.gltf");
        fs::write(&file, document.json.to_string()).map_err(|error| error.to_string())?;
        let limits = Limits { file_bytes: 4096, ..Limits::default() };
        let options = ImportOptions { limits, ..ImportOptions::default() };
        results.push((format!("uri {uri:?}"), check_path(&file, &options, &expected)));
        results
            .push((format!("uri {uri:?} in memory"), check_in_memory(&uri, &document, &expected)));
        let options = ImportOptions { root: Some(models.to_owned()), ..options };
        let loaded = load_bytes("model.gltf", document.json.to_string().as_bytes(), &options);
        let name = format!("uri {uri:?} in memory with a root");
        results.push((name, check_load_result(&loaded, &expected)));
    }
    for (root, uri, expected) in [
        (folder, "../secret.bin", Expected::LoadsClean),
        (folder, "../../secret.bin", Expected::Refused),
        (folder, "../models/data.bin", Expected::LoadsClean),
        (&models.join("sub"), "data.bin", Expected::Refused),
        (&models.join("nowhere"), "data.bin", Expected::Refused),
    ] {
        let document = Document::single_triangle().with_value("/buffers/0/uri", json!(uri));
        let file = models.join("model.gltf");
        fs::write(&file, document.json.to_string()).map_err(|error| error.to_string())?;
        let options = ImportOptions { root: Some(root.to_owned()), ..ImportOptions::default() };
        let name = format!("root {:?}, uri {uri:?}", root.file_name().unwrap_or_default());
        results.push((name, check_path(&file, &options, &expected)));
    }
    check_allowed_folders(folder, &models, &mut results)?;
    Ok(results)
}

/// Tests folders that are allowed in addition to the model's own, and paths that remain forbidden.
fn check_allowed_folders(
    folder: &Path,
    models: &Path,
    results: &mut Vec<UriResult>,
) -> Result<(), String> {
    for (allowed, uri, expected) in [
        (folder.to_owned(), "../secret.bin", Expected::LoadsClean),
        (folder.to_owned(), "out.bin", Expected::LoadsClean),
        (folder.to_owned(), "../../secret.bin", Expected::Refused),
        (folder.to_owned(), "../models/../models/data.bin", Expected::LoadsClean),
        (folder.to_owned(), "zero.bin", Expected::Refused),
        (folder.to_owned(), "folder.bin", Expected::Refused),
        (folder.to_owned(), "http://example.com/a.bin", Expected::Refused),
        (models.join("sub"), "../secret.bin", Expected::Refused),
        (models.join("sub"), "sub/in.bin", Expected::LoadsClean),
        (models.join("nowhere"), "data.bin", Expected::Refused),
    ] {
        if cfg!(not(unix)) && ["out.bin", "zero.bin"].contains(&uri) {
            continue;
        }
        let document = Document::single_triangle().with_value("/buffers/0/uri", json!(uri));
        let file = models.join("model.gltf");
        fs::write(&file, document.json.to_string()).map_err(|error| error.to_string())?;
        let name = format!("{:?} allowed, uri {uri:?}", allowed.file_name().unwrap_or_default());
        let options = ImportOptions { allow_outside: vec![allowed], ..ImportOptions::default() };
        results.push((name, check_path(&file, &options, &expected)));
    }
    let secret = folder.join("secret.bin");
    let document = Document::single_triangle().with_value("/buffers/0/uri", json!(secret));
    let file = models.join("model.gltf");
    fs::write(&file, document.json.to_string()).map_err(|error| error.to_string())?;
    let allow_outside = vec![folder.to_owned()];
    let options = ImportOptions { allow_outside, ..ImportOptions::default() };
    let judged = check_path(&file, &options, &Expected::Refused);
    results.push(("an absolute path into an allowed folder".to_owned(), judged));
    Ok(())
}

/// Checks that a file in memory may have data URIs, but cannot read anything else.
fn check_in_memory(uri: &str, document: &Document, expected: &Expected) -> Result<(), String> {
    let text = document.json.to_string();
    let loaded = load_bytes("model.gltf", text.as_bytes(), &ImportOptions::default());
    let is_data = uri.get(..5).is_some_and(|start| start.eq_ignore_ascii_case("data:"));
    if is_data || uri.is_empty() {
        return check_load_result(&loaded, expected);
    }
    let problem = format!("a model in memory cannot refer to the file {uri:?}");
    check_load_result(
        &loaded,
        &fault_at(
            &problem,
            "load the model from its own file, or export it as a .glb, which contains everything",
        ),
    )
}

fn create_files(folder: &Path, models: &Path) -> std::io::Result<()> {
    fs::create_dir_all(models.join("sub"))?;
    fs::create_dir_all(models.join("folder.bin"))?;
    let bytes = Document::single_triangle().bytes;
    fs::write(folder.join("secret.bin"), &bytes)?;
    for name in
        ["data.bin", "a b.bin", "a+b.bin", "50%.bin", "%41.bin", "ü.bin", "sub/in.bin", "..bin"]
    {
        fs::write(models.join(name), &bytes)?;
    }
    fs::write(models.join("large.bin"), vec![0; 5000])?;
    #[cfg(unix)]
    {
        fs::write(models.join("x:y.bin"), &bytes)?;
        for (target, link) in [
            ("../secret.bin", "out.bin"),
            ("data.bin", "in.bin"),
            ("in.bin", "twice.bin"),
            ("self.bin", "self.bin"),
            ("..", "up"),
            ("nowhere", "dangling.bin"),
            ("/dev/zero", "zero.bin"),
        ] {
            let link = models.join(link);
            let _ = fs::remove_file(&link);
            std::os::unix::fs::symlink(target, link)?;
        }
    }
    Ok(())
}

/// Names of existing files, in every allowed spelling.
const ALLOWED: [&str; 17] = [
    "data.bin",
    "a b.bin",
    "a%20b.bin",
    "a+b.bin",
    "50%.bin",
    "%41.bin",
    "%C3%BC.bin",
    "ü.bin",
    "sub/in.bin",
    "./data.bin",
    "sub/../data.bin",
    "sub/./in.bin",
    "sub//in.bin",
    "%64ata.bin",
    "..bin",
    "sub\\in.bin",
    "sub%2Fin.bin",
];

/// Names that lead out of the folder without a symbolic link.
const FORBIDDEN: [&str; 7] = [
    "../secret.bin",
    "../../../../../../etc/passwd",
    "sub/../../secret.bin",
    "/etc/passwd",
    "\\etc\\passwd",
    "..",
    "a/../../secret.bin",
];

fn fault_at(problem: &str, remedy: &str) -> Expected {
    Expected::Says(format!("/buffers/0/uri: {problem}; {remedy}"))
}

fn outside_folder(uri: &str) -> Expected {
    fault_at(&format!("{uri:?} is outside the model's folder"), OUTSIDE)
}

fn missing_file(uri: &str) -> Expected {
    fault_at(&format!("the file {uri:?} does not exist"), "put it next to the model")
}

fn unsupported_scheme(scheme: &str, uri: &str) -> Expected {
    fault_at(&format!("the scheme {scheme:?} of {uri:?} is not supported"), OUTSIDE)
}

fn uri_table(models: &Path) -> Vec<(String, Expected)> {
    let absolute = models.join("data.bin").to_string_lossy().into_owned();
    let file = format!("file://{absolute}");
    let mut table = vec![
        (absolute.clone(), outside_folder(&absolute)),
        (file.clone(), unsupported_scheme("file", &file)),
    ];
    table.extend(ALLOWED.map(|uri| (uri.to_owned(), Expected::LoadsClean)));
    table.extend(FORBIDDEN.map(|uri| (uri.to_owned(), outside_folder(uri))));
    table.extend(strange_name_cases());
    table.extend(data_uri_cases());
    if cfg!(unix) {
        table.extend(symlink_cases());
    }
    table
}

fn strange_name_cases() -> Vec<(String, Expected)> {
    vec![
        ("%2e%2e/secret.bin".to_owned(), outside_folder("../secret.bin")),
        ("%2E%2E%2Fsecret.bin".to_owned(), outside_folder("../secret.bin")),
        ("%2Fetc%2Fpasswd".to_owned(), outside_folder("/etc/passwd")),
        ("..\\secret.bin".to_owned(), outside_folder("../secret.bin")),
        ("data.bin%00".to_owned(), outside_folder("data.bin\0")),
        ("%252e%252e/secret.bin".to_owned(), missing_file("%252e%252e/secret.bin")),
        ("nowhere.bin".to_owned(), missing_file("nowhere.bin")),
        ("data.bin?x=1".to_owned(), missing_file("data.bin?x=1")),
        ("%FF%FE.bin".to_owned(), missing_file("%FF%FE.bin")),
        ("%".to_owned(), missing_file("%")),
        ("%4".to_owned(), missing_file("%4")),
        ("x".repeat(10_000), Expected::Refused),
        (String::new(), fault_at("the URI is empty", "export the file again")),
        ("folder.bin".to_owned(), fault_at("\"folder.bin\" is not a regular file", OUTSIDE)),
        (".".to_owned(), fault_at("\".\" is not a regular file", OUTSIDE)),
        (
            "large.bin".to_owned(),
            fault_at(
                "the file has 5000 bytes, more than the limit of 4096",
                "raise the limit `file_bytes` (--max-file-bytes) if you trust the file",
            ),
        ),
        (
            "http://example.com/a.bin".to_owned(),
            unsupported_scheme("http", "http://example.com/a.bin"),
        ),
        (
            "HTTPS://example.com/a.bin".to_owned(),
            unsupported_scheme("HTTPS", "HTTPS://example.com/a.bin"),
        ),
        ("C:\\x.bin".to_owned(), Expected::Refused),
    ]
}

fn data_uri_cases() -> Vec<(String, Expected)> {
    vec![
        (
            "data:".to_owned(),
            fault_at("the data URI has no comma before its data", "export the file again"),
        ),
        ("data:;base64,".to_owned(), Expected::Refused),
        ("data:;base64,!!!!".to_owned(), Expected::Refused),
        ("data:;base64,A".to_owned(), Expected::Refused),
        ("data:application/octet-stream;base64,AAAA".to_owned(), Expected::Refused),
        (format!("data:;base64,{}", "A".repeat(60)), Expected::LoadsClean),
        (format!("data:;base64,{}", "-_".repeat(30)), Expected::Loads),
        (format!("DATA:application/gltf-buffer;base64,{}=", "A".repeat(59)), Expected::Loads),
        (format!("data:,{}", "%00".repeat(44)), Expected::LoadsClean),
        (format!("data:,{}", "%FF".repeat(44)), Expected::Loads),
    ]
}

/// Returns names that only some systems allow, and symbolic links.
fn symlink_cases() -> Vec<(String, Expected)> {
    vec![
        ("x:y.bin".to_owned(), Expected::LoadsClean),
        ("in.bin".to_owned(), Expected::LoadsClean),
        ("twice.bin".to_owned(), Expected::LoadsClean),
        ("out.bin".to_owned(), fault_at("\"out.bin\" points outside the model's folder", OUTSIDE)),
        (
            "up/secret.bin".to_owned(),
            fault_at("\"up/secret.bin\" points outside the model's folder", OUTSIDE),
        ),
        (
            "zero.bin".to_owned(),
            fault_at("\"zero.bin\" points outside the model's folder", OUTSIDE),
        ),
        ("self.bin".to_owned(), missing_file("self.bin")),
        ("dangling.bin".to_owned(), missing_file("dangling.bin")),
    ]
}
