//! Output file names: from a template or from a job list.
//!
//! ```text
//! {stem}-{line:08}.png            fox-00000017.png
//! {prefix}/{folder}/{stem}.png    a4/animals/small/fox.png
//! ```

use crate::template::NameTemplate;
use files::visible_text;
use sha2::{Digest, Sha256};
use std::path::{Component, Path};

/// A name template with the fields of a batch.
#[derive(Clone, Debug)]
pub struct PictureName(NameTemplate);

/// The source of a name's fields.
#[derive(Clone, Copy, Debug)]
pub(super) struct NameSource<'a> {
    /// The input, relative to the folder or list in which it was found.
    pub(super) input: &'a Path,
    /// The number of the line, or of the input, from 1.
    pub(super) line: usize,
    /// The number of the picture within its line, from 1.
    pub(super) picture: usize,
}

impl PictureName {
    /// Returns the template for lists that do not name their pictures.
    ///
    /// Lines cannot be compared with each other, because a list may be larger than memory, so the
    /// line number makes the name unique.
    pub(super) fn of_line(has_pictures: bool) -> Self {
        let text =
            if has_pictures { "{stem}-{line:08}-{picture}.png" } else { "{stem}-{line:08}.png" };
        Self(Self::parse_fields(text).unwrap_or_else(|_| NameTemplate::default()))
    }

    /// Parses the `--name` template.
    ///
    /// # Errors
    /// Returns an error if a field is unknown, or if the name does not end in `.png`.
    pub fn parse(text: &str) -> Result<Self, String> {
        if !has_png_extension(text) {
            return Err("pictures are PNG files; end the name in .png".to_owned());
        }
        Self::parse_fields(text).map(Self)
    }

    /// Parses a template with the fields of a batch.
    fn parse_fields(text: &str) -> Result<NameTemplate, String> {
        NameTemplate::parse(text, &["stem", "name", "folder", "prefix"], &["line", "picture"])
    }

    /// Returns whether the template has this field.
    pub(super) fn has_field(&self, field: &str) -> bool {
        self.0.has_field(field)
    }

    /// Returns the name of a picture.
    ///
    /// `{prefix}` is computed from the name without the prefix, so a name always gets the same
    /// prefix.
    pub(super) fn name_picture(&self, source: NameSource<'_>) -> String {
        let plain = self.expand(source, "");
        if !self.has_field("prefix") {
            return plain;
        }
        let first = Sha256::digest(plain.as_bytes()).first().copied().unwrap_or_default();
        self.expand(source, &format!("{first:02x}"))
    }

    /// Returns the name with this prefix, without empty parts.
    fn expand(&self, source: NameSource<'_>, prefix: &str) -> String {
        let part = |part: Option<&std::ffi::OsStr>| {
            part.unwrap_or_default().to_string_lossy().into_owned()
        };
        let folder = || normal_parts(source.input.parent().unwrap_or(Path::new("")));
        let word = |field: &str| match field {
            "stem" => part(source.input.file_stem()),
            "name" => part(source.input.file_name()),
            "folder" => folder(),
            _ => prefix.to_owned(),
        };
        let number = |field: &str| if field == "line" { source.line } else { source.picture };
        normal_parts(&self.0.expand_fields(word, number))
    }
}

/// Returns a path without root, `.` and `..`, with `/` as separator, so that it stays below the
/// output folder.
///
/// `../up/x.glb` and `/up/x.glb` both become `up/x.glb`. A list is often made by another program
/// and must not be able to write outside the folder.
pub(super) fn normal_parts(path: &Path) -> String {
    let normal = path.components().filter_map(|part| match part {
        Component::Normal(part) => Some(part.to_string_lossy()),
        _ => None,
    });
    normal.collect::<Vec<_>>().join("/")
}

/// Checks the name that a list assigns to a picture.
///
/// # Errors
/// Returns an error if the name points outside the output folder or does not end in `.png`.
pub(super) fn check_picture_name(name: &str) -> Result<(), String> {
    let (path, shown) = (Path::new(name), visible_text(name));
    let is_normal = path.components().all(|part| matches!(part, Component::Normal(_)));
    if !is_normal || name.contains('\0') {
        return Err(format!(
            "the picture {shown} would be outside the output folder\n  = help: give a relative \
             path without `.` or `..`"
        ));
    }
    if !has_png_extension(name) {
        return Err(format!(
            "the picture {shown} is not a PNG file\n  = help: end the name in .png"
        ));
    }
    Ok(())
}

/// Returns whether a name ends in `.png`.
fn has_png_extension(name: &str) -> bool {
    Path::new(name).extension().is_some_and(|ending| ending.eq_ignore_ascii_case("png"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_follow_their_template() {
        let source = NameSource { input: Path::new("../a/b c/fox.glb"), line: 17, picture: 2 };
        for (template, name) in [
            ("{stem}.png", "fox.png"),
            ("{folder}/{name}-{picture}.png", "a/b c/fox.glb-2.png"),
            ("{line:05}.png", "00017.png"),
        ] {
            let template = PictureName::parse(template).expect(template);
            assert_eq!(template.name_picture(source), name);
        }
        let root = NameSource { input: Path::new("fox.glb"), line: 1, picture: 1 };
        let folder = PictureName::parse("{folder}/{stem}.png").expect("a template");
        assert_eq!(folder.name_picture(root), "fox.png", "no folder, no empty part");
        assert!(PictureName::parse("{stem}").is_err() && PictureName::parse("{x}.png").is_err());
    }

    #[test]
    fn prefixes_are_hashes_of_the_name() {
        let template = PictureName::parse("{prefix}/{stem}.png").expect("a template");
        let name = |input: &str| {
            template.name_picture(NameSource { input: Path::new(input), line: 1, picture: 1 })
        };
        // SHA-256 of "/fox.png" without its root: printf fox.png | sha256sum
        assert_eq!(name("fox.glb"), format!("{:02x}/fox.png", Sha256::digest("fox.png")[0]));
        assert_eq!(name("fox.glb"), name("elsewhere/fox.stl"));
    }

    #[test]
    fn names_from_lists_stay_below_the_output_folder() {
        for name in ["a.png", "a/b.PNG", "a b/ä.png"] {
            assert_eq!(check_picture_name(name), Ok(()), "{name}");
        }
        for name in ["", "/a.png", "../a.png", "a/../b.png", "a", "a.jpg", ".png"] {
            assert!(check_picture_name(name).is_err(), "{name}");
        }
    }
}
