//! Tests the preprocessor through mdBook's protocol: plain mdBook builds a book in both languages.

use mdbook_driver::MDBook;
use mdbook_driver::config::Config;
use std::fs;
use std::path::{Path, PathBuf};

const PAGE: &str = "# Page\n\nText with `$x_1$` and `C4`.\n\n```formula PE-1\nx = \\frac{1}{2}\n% check n=1 : PE-1\n```\n\n## A section\n\n[link](page.md#a-section)\n";

const CATALOG: &str = r#"msgid ""
msgstr ""
"Project-Id-Version: p\n"
"POT-Creation-Date: \n"
"PO-Revision-Date: \n"
"Language-Team: \n"
"MIME-Version: 1.0\n"
"Content-Type: text/plain; charset=UTF-8\n"
"Content-Transfer-Encoding: 8bit\n"
"Language: zh\n"
"Plural-Forms: nplurals=1; plural=0;\n"

msgid "A section"
msgstr "一节"

msgid "Text with `$x_1$` and `C4`."
msgstr "文字 `$x_1$`，`C4`。"
"#;

/// Writes a project whose book has one page.
fn write_project(name: &str, page: &str) -> PathBuf {
    let root = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name);
    let files = [
        ("tests/CONFORMANCE.md", "| C4 | The canonical volume | a |\n"),
        ("book/src/SUMMARY.md", "# Summary\n\n- [Page](page.md)\n"),
        ("book/src/page.md", page),
        ("book/po/zh/page.po", CATALOG),
    ];
    for (path, text) in files {
        let path = root.join(path);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, text).unwrap();
    }
    root
}

/// Builds the book in a language and returns the HTML of its page.
fn build(root: &Path, language: &str) -> Result<String, String> {
    let command = env!("CARGO_BIN_EXE_mdbook-alberti");
    let toml = format!(
        "[book]\nlanguage = \"{language}\"\n[build]\nbuild-dir = \"out-{language}\"\n\
         use-default-preprocessors = false\n[preprocessor.alberti]\ncommand = \"{command}\"\n"
    );
    let config: Config = toml.parse().unwrap();
    let book = MDBook::load_with_config(root.join("book"), config).unwrap();
    book.build().map_err(|error| format!("{error:#}"))?;
    Ok(fs::read_to_string(root.join(format!("book/out-{language}/page.html"))).unwrap())
}

#[test]
fn plain_mdbook_builds_both_languages() {
    let root = write_project("both", PAGE);
    let english = build(&root, "en").unwrap();
    for part in [
        "<math><msub><mi>x</mi><mn>1</mn></msub></math>",
        "id=\"PE-1\"",
        "<a class=\"topic\" id=\"C4\" href=\"topics.html#C4\" title=\"Topic C4: The canonical volume\">C4</a>",
        "<h2 id=\"a-section\">",
        "href=\"../zh/page.html\"",
    ] {
        assert!(english.contains(part), "{part}\n{english}");
    }
    let chinese = build(&root, "zh").unwrap();
    for part in [
        "文字 <math>",
        "<h2 id=\"a-section\"><a class=\"header\" href=\"#a-section\">一节",
        "<html lang=\"zh\"",
    ] {
        assert!(chinese.contains(part), "{part}\n{chinese}");
    }
}

#[test]
fn the_build_fails_if_the_program_is_missing() {
    let root =
        write_project("failing", "# Page\n\n```alberti\nalberti render a.ron\n```\n\n*A.*\n");
    assert!(build(&root, "en").is_err());
}
