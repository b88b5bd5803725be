//! The gallery: each scene with its freshly rendered picture, its file, its command and its models.

use crate::Outcome;
use crate::files::relative;
use crate::markdown::{Document, code_html, escape};
use crate::program::Program;
use crate::site::Site;
use std::fs;
use std::path::Path;

/// The path of the page with all scenes.
pub const PAGE: &str = "gallery/index.html";

/// A scene from the repository, with its picture.
pub struct Scene {
    name: String,
    text: String,
    /// The width and height of the picture.
    size: (u32, u32),
}

impl Scene {
    fn source(&self) -> String {
        format!("scenes/{}.ron", self.name)
    }

    fn page(&self) -> String {
        format!("gallery/{}.html", self.name)
    }

    fn picture(&self) -> String {
        format!("gallery/{}.png", self.name)
    }

    /// Returns the comment at the beginning of the file.
    fn caption(&self) -> String {
        let lines = self.text.lines().map_while(|line| line.trim().strip_prefix("//"));
        lines.map(str::trim).collect::<Vec<_>>().join(" ")
    }

    fn image_html(&self, page: &str) -> String {
        let (width, height) = self.size;
        let (source, name) = (relative(page, &self.picture()), escape(&self.name));
        format!(
            "<img src=\"{source}\" width=\"{width}\" height=\"{height}\" loading=\"lazy\" alt=\"The scene {name}\">"
        )
    }
}

/// Renders all scenes into the site.
pub fn render_scenes(site: &Site, program: &Program) -> Result<Vec<Scene>, String> {
    let mut scenes = Vec::new();
    for file in site.names_in("scenes")? {
        let Some(name) = file.strip_suffix(".ron").map(str::to_owned) else { continue };
        let text = site.read_text(&format!("scenes/{file}"))?;
        let mut scene = Scene { name, text, size: (0, 0) };
        let picture = std::path::absolute(site.out.join(scene.picture()));
        let picture = picture.map_err(|error| error.to_string())?;
        fs::create_dir_all(picture.parent().unwrap_or(&site.out)).map_err(|e| e.to_string())?;
        let path = picture.to_string_lossy().into_owned();
        program.run(&site.root, &["render", &scene.source(), "-o", &path])?;
        scene.size = png_size(&picture)?;
        scenes.push(scene);
    }
    Ok(scenes)
}

/// Adds the page with all scenes and a page for each scene.
pub fn add_gallery(site: &mut Site, scenes: &[Scene]) -> Outcome {
    let mut html = String::from(
        "<h1 id=\"gallery\">Gallery</h1>\n<p>Every scene in the repository, rendered when this page was built. Each links to its \
         file, its command and its models. A scene shows one feature, which its first lines describe.</p>\n<div class=\"gallery\">\n",
    );
    for scene in scenes {
        let (page, name) = (relative(PAGE, &scene.page()), escape(&scene.name));
        let (image, caption) = (scene.image_html(PAGE), escape(&scene.caption()));
        html += &format!(
            "<figure><a href=\"{page}\">{image}</a>\n<figcaption><a href=\"{page}\">{name}</a> {caption}</figcaption></figure>\n"
        );
        site.place(&scene.source(), &scene.page());
        site.place(&format!("tests/goldens/{}.png", scene.name), &scene.picture());
    }
    let title = "Gallery".to_owned();
    site.add_page(
        PAGE,
        Some("Alberti"),
        Document { title, html: html + "</div>\n", ..Document::default() },
    );
    scenes.iter().try_for_each(|scene| add_scene(site, scene))
}

/// Adds the page of one scene.
fn add_scene(site: &mut Site, scene: &Scene) -> Outcome {
    let page = scene.page();
    let (name, source) = (escape(&scene.name), scene.source());
    let file = format!("gallery/{}.ron", scene.name);
    site.write_text(&file, &scene.text)?;
    let mut downloads =
        format!("<li><a href=\"{}\" download>{source}</a></li>\n", relative(&page, &file));
    for other in named_files(&scene.text) {
        let path = format!("scenes/{other}");
        if site.root.join(&path).is_file() {
            let place = site.copy_file(&path)?;
            downloads +=
                &format!("<li><a href=\"{}\" download>{path}</a></li>\n", relative(&page, &place));
        }
    }
    let html = format!(
        "<h1 id=\"{name}\">{name}</h1>\n<p>{}</p>\n<p class=\"picture\">{}</p>\n{}<h2 id=\"file\">File</h2>\n{}\
         <h2 id=\"downloads\">Downloads</h2>\n<ul>\n{downloads}</ul>\n\
         <p><a href=\"index.html\">All scenes</a> · <a href=\"../reference/scene.html\">Reference for scene files</a></p>\n",
        escape(&scene.caption()),
        scene.image_html(&page),
        code_html("sh", &format!("alberti render {source}")),
        code_html("ron", &scene.text),
    );
    site.add_page(
        &page,
        None,
        Document { title: format!("Scene {}", scene.name), html, ..Document::default() },
    );
    Ok(())
}

/// Returns the quoted strings in a scene that may be file names.
fn named_files(text: &str) -> Vec<&str> {
    let mut names: Vec<&str> =
        text.split('"').skip(1).step_by(2).filter(|word| word.contains('.')).collect();
    names.sort_unstable();
    names.dedup();
    names
}

/// Reads the width and height of a PNG from its header.
fn png_size(path: &Path) -> Result<(u32, u32), String> {
    let bytes = fs::read(path).map_err(|error| format!("{}: {error}", path.display()))?;
    let number = |at: usize| Some(u32::from_be_bytes(bytes.get(at..at + 4)?.try_into().ok()?));
    number(16).zip(number(20)).ok_or_else(|| format!("{}: no PNG", path.display()))
}
