//! The reference, generated from the program's output: a page for each command, a page for scene
//! files, and manual pages to install.

use crate::Outcome;
use crate::files::{names_in, relative};
use crate::markdown::{Document, escape, slug, to_html};
use crate::program::Program;
use crate::site::Site;
use std::fs;

const COMMANDS: &str = "reference/index.html";
const SCENE: &str = "reference/scene.html";

/// Adds the reference pages.
pub fn add_reference(site: &mut Site, program: &Program) -> Outcome {
    let text = program.run(&site.root, &["reference", "--format", "markdown"])?;
    let parts = sections(&text);
    let is_command = |part: &&(String, String)| part.0.split(' ').next() == Some("alberti");
    let commands: Vec<&(String, String)> = parts.iter().filter(is_command).collect();
    let types: Vec<&(String, String)> = parts.iter().filter(|part| !is_command(part)).collect();
    if commands.len() < 5 || types.len() < 20 {
        return Err("the format of `alberti reference` has changed: see reference.rs".into());
    }
    let manual = manual_pages(site, program)?;
    let mut list = String::from(
        "# Commands\n\nAll commands with all their flags, as printed by `alberti COMMAND --help`.\n\n",
    );
    for (name, body) in &commands {
        let about = body.lines().find(|line| !line.is_empty()).unwrap_or_default();
        list += &format!("- [`{name}`]({}) — {about}\n", relative(COMMANDS, &command_page(name)));
    }
    list += "\nManual pages to install in `man/man1`: ";
    let links =
        manual.iter().map(|(name, place)| format!("[{name}]({})", relative(COMMANDS, place)));
    list += &(links.collect::<Vec<_>>().join(", ") + ".\n");
    site.add_page(COMMANDS, Some("Reference"), to_html(&list, |target| Ok(target.into()))?);
    site.add_page(SCENE, Some("Reference"), scene_document(&types)?);
    for (name, body) in commands {
        let mut document = to_html(&format!("# {name}\n{body}"), |target| Ok(target.into()))?;
        document.html = with_flag_anchors(&document.html);
        site.add_page(&command_page(name), None, document);
    }
    Ok(())
}

fn command_page(name: &str) -> String {
    format!("reference/{}.html", name.replace(' ', "-"))
}

/// Returns the second-level headings, each with the text below it.
fn sections(text: &str) -> Vec<(String, String)> {
    let parts = text.split("\n## ").skip(1);
    let parts = parts.map(|part| part.split_once('\n').unwrap_or((part, "")));
    parts.map(|(name, body)| (name.to_owned(), body.to_owned())).collect()
}

/// Returns the document with all types of scene files, with links for field types.
fn scene_document(types: &[&(String, String)]) -> Result<Document, String> {
    let mut text = String::from(
        "# Scene files\n\nAll types of scene files and their fields, as printed by `alberti scene doc`.\n",
    );
    let names: Vec<&str> = types.iter().map(|(name, _)| name.as_str()).collect();
    for (name, body) in types {
        text += &format!("\n## {name}\n");
        for line in body.lines() {
            text += &(with_type_links(line, &names) + "\n");
        }
    }
    to_html(&text, |target| Ok(target.into()))
}

/// Turns the types in the line for a field, such as `` - `camera`: Camera — … ``, into links.
fn with_type_links(line: &str, types: &[&str]) -> String {
    let Some((field, rest)) = line.split_once("`: ") else { return line.into() };
    let Some((kind, about)) = rest.split_once(" — ") else { return line.into() };
    if !field.trim_start().starts_with("- `") {
        return line.into();
    }
    let linked = kind.split(' ').map(|word| match types.contains(&word) {
        true => format!("[{word}](#{})", slug(word)),
        false => word.to_owned(),
    });
    format!("{field}`: {} — {about}", linked.collect::<Vec<_>>().join(" "))
}

/// Adds anchors to flags, so that `alberti-render.html#--size` leads to `--size`.
fn with_flag_anchors(html: &str) -> String {
    let mut parts = html.split("<li><code>");
    let mut text = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        let name = part.split("</code>").next().unwrap_or_default();
        let flag = name.split(", ").find(|word| word.starts_with("--"));
        let anchor = flag.map(|flag| format!(" id=\"{}\"", escape(flag)));
        text += &format!("<li{}><code>{part}", anchor.unwrap_or_default());
    }
    text
}

/// Writes the manual pages into the site and returns the name and path of each.
fn manual_pages(site: &Site, program: &Program) -> Result<Vec<(String, String)>, String> {
    let folder = std::path::absolute(site.out.join("man")).map_err(|error| error.to_string())?;
    fs::create_dir_all(&folder).map_err(|error| error.to_string())?;
    program.run(&site.root, &["man", "--out-dir", &folder.to_string_lossy()])?;
    let names = names_in(&folder)?;
    Ok(names.into_iter().map(|name| (name.clone(), format!("man/{name}"))).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fields_link_to_their_types_and_flags_have_anchors() {
        let line = "- `models`: list of Model — The models.";
        assert_eq!(
            with_type_links(line, &["Model"]),
            "- `models`: list of [Model](#model) — The models."
        );
        assert_eq!(with_type_links("- `m` — 1 m", &["Model"]), "- `m` — 1 m");
        let html =
            with_flag_anchors("<ul>\n<li><code>-o, --output</code> x</li><li><code>a</code></li>");
        assert!(
            html.contains("<li id=\"--output\"><code>-o") && html.contains("<li><code>a"),
            "{html}"
        );
    }
}
