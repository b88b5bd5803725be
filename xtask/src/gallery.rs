//! `cargo xtask gallery`: renders every scene to one page, with the comment of its file as the
//! caption. With `--models DIR`, it renders every model in a folder with every style and lighting
//! (`tests/gallery`).

use crate::Outcome;
use crate::program::{Build, Program, cargo_command, run_visibly};
use crate::workspace::{create_folder, list_scenes, target_folder};
use std::fs;

const PAGE_HEAD: &str = "<!doctype html>
<html lang=\"en\">
<meta charset=\"utf-8\">
<title>Alberti: gallery</title>
<style>
  body { margin: 3rem auto; max-width: 90rem; padding: 0 2rem; font: 16px/1.5 Georgia, serif; color: #22313f; background: #faf8f3; }
  main { display: grid; grid-template-columns: repeat(auto-fill, minmax(24rem, 1fr)); gap: 3rem 2.5rem; align-items: end; }
  figure { margin: 0; }
  img { display: block; width: 100%; height: auto; }
  figcaption { padding-top: .7rem; }
  b { display: block; font-family: monospace; font-weight: normal; color: #9c4438; }
</style>
<h1>Alberti: gallery</h1>
<main>
";

/// Renders all scenes and writes the page.
pub fn run_gallery(arguments: &[String]) -> Outcome {
    match arguments {
        [] => {}
        [flag, models] if flag == "--models" => return run_model_gallery(models),
        [flag] if flag == "--models" => return Err("--models needs a folder".to_owned()),
        [argument, ..] => return Err(format!("unknown argument `{argument}`")),
    }
    let folder = target_folder().join("gallery");
    create_folder(&folder)?;
    let program = Program::build(Build::Release)?;
    let mut page = String::from(PAGE_HEAD);
    for scene in list_scenes()? {
        program.render(&scene.path, &folder.join(format!("{}.png", scene.name)), &[])?;
        page += &figure_html(&scene.name, &scene.scene_caption()?);
    }
    page += "</main>\n";
    let path = folder.join("index.html");
    fs::write(&path, page).map_err(|error| format!("{}: {error}", path.display()))?;
    println!("{}", path.display());
    Ok(())
}

/// Renders every model in a folder in all variants.
fn run_model_gallery(models: &str) -> Outcome {
    let folder = fs::canonicalize(models).map_err(|error| format!("{models}: {error}"))?;
    let call = ["bench", "--quiet", "--package", "alberti-tests", "--bench", "gallery", "--"];
    run_visibly(cargo_command(&call).arg(folder))
}

fn figure_html(name: &str, caption: &str) -> String {
    let (name, caption) = (escape_html(name), escape_html(caption));
    format!(
        "<figure>\n  <img src=\"{name}.png\" alt=\"{caption}\">\n  <figcaption><b>scenes/{name}.ron</b> {caption}</figcaption>\n</figure>\n"
    )
}

fn escape_html(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('"', "&quot;")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn captions_cannot_break_the_page() {
        assert!(figure_html("a", "1 < 2 & \"so\"").contains("1 &lt; 2 &amp; &quot;so&quot;"));
    }
}
