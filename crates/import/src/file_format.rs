//! Model file formats and their detection from the content. The name is used only if the content is
//! ambiguous.

use super::stl;
use super::text::decode_text;
use model::{Diagnostic, codes};
use std::path::Path;

/// A model file format.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum FileFormat {
    /// glTF 2.0, as JSON or in the binary container (GLB).
    Gltf,
    /// STL (stereolithography), ASCII or binary.
    Stl,
    /// Wavefront OBJ, with its material library (MTL).
    Obj,
    /// PLY (polygon file format, Stanford triangle format), ASCII or binary.
    Ply,
    /// 3MF (3D Manufacturing Format): a zip archive.
    ThreeMf,
}

/// Number of bytes at the beginning of a file that are used to distinguish text formats.
///
/// Comments before the first statement of an OBJ file are rarely longer than this.
const PREFIX_BYTES: usize = 16 << 10;

impl FileFormat {
    /// All formats.
    pub const ALL: [Self; 5] = [Self::Gltf, Self::Stl, Self::Obj, Self::Ply, Self::ThreeMf];

    /// Returns the name of the format: `glTF`, `STL`, `OBJ`, `PLY` or `3MF`.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Gltf => "glTF",
            Self::Stl => "STL",
            Self::Obj => "OBJ",
            Self::Ply => "PLY",
            Self::ThreeMf => "3MF",
        }
    }

    /// Returns the file extensions of the format, in lowercase and without the dot.
    #[must_use]
    pub const fn extensions(self) -> &'static [&'static str] {
        match self {
            Self::Gltf => &["gltf", "glb"],
            Self::Stl => &["stl"],
            Self::Obj => &["obj"],
            Self::Ply => &["ply"],
            Self::ThreeMf => &["3mf"],
        }
    }

    /// Returns the format for a file's extension, ignoring case.
    #[must_use]
    pub fn from_extension(path: &Path) -> Option<Self> {
        let extension = path.extension()?.to_str()?.to_ascii_lowercase();
        Self::ALL.into_iter().find(|format| format.extensions().contains(&extension.as_str()))
    }

    /// Identifies the format from the content of a file. Returns `None` if the content is
    /// ambiguous.
    ///
    /// The time does not depend on the length of the file.
    #[must_use]
    pub fn from_content(bytes: &[u8]) -> Option<Self> {
        if bytes.starts_with(b"glTF") {
            return Some(Self::Gltf);
        }
        if bytes.starts_with(b"PK\x03\x04") || bytes.starts_with(b"PK\x05\x06") {
            return Some(Self::ThreeMf);
        }
        let text = decode_text(bytes.get(..PREFIX_BYTES).unwrap_or(bytes));
        let trimmed = text.trim_ascii_start();
        if trimmed.first() == Some(&b'{') {
            Some(Self::Gltf)
        } else if trimmed.starts_with(b"ply") && trimmed.get(3).is_some_and(u8::is_ascii_whitespace)
        {
            Some(Self::Ply)
        } else if stl::is_stl(bytes, &text) {
            Some(Self::Stl)
        } else {
            begins_with_obj_statement(trimmed).then_some(Self::Obj)
        }
    }

    /// Returns whether the first bytes of this format take precedence over the length of a binary
    /// STL file.
    pub(super) fn precedes_binary_stl(self) -> bool {
        matches!(self, Self::Gltf | Self::ThreeMf | Self::Ply)
    }

    /// Returns the format of a file from its content, or else from its name.
    ///
    /// # Errors
    /// Returns [`UNKNOWN_FORMAT`](codes::UNKNOWN_FORMAT) if neither identifies the format.
    pub fn recognize(path: &Path, bytes: &[u8]) -> Result<Self, Diagnostic> {
        let named = Self::from_extension(path);
        let is_scene = path.extension().is_some_and(|ending| ending == "ron");
        let unknown = || if is_scene { scene_as_model() } else { unknown_format(bytes) };
        let is_foreign =
            || named.is_some() && MISLEADING.iter().any(|start| bytes.starts_with(start));
        let found = Self::from_content(bytes).or(named.filter(|_| !is_foreign()));
        found.ok_or_else(unknown)
    }
}

/// Returns whether the first line that is neither blank nor a comment is an OBJ statement with
/// arguments.
fn begins_with_obj_statement(text: &[u8]) -> bool {
    const STATEMENTS: [&[u8]; 16] = [
        b"v", b"vn", b"vt", b"vp", b"f", b"l", b"p", b"o", b"g", b"s", b"mg", b"mtllib", b"usemtl",
        b"usemap", b"cstype", b"maplib",
    ];
    let mut lines = text.split(|byte| matches!(byte, b'\n' | b'\r')).map(<[u8]>::trim_ascii);
    let statement = lines.find(|line| !line.is_empty() && !line.starts_with(b"#"));
    let mut words = statement.into_iter().flat_map(|line| line.split(u8::is_ascii_whitespace));
    let is_statement = words.next().is_some_and(|keyword| STATEMENTS.contains(&keyword));
    is_statement && words.next().is_some() && !text.contains(&0)
}

/// First bytes of files that are named like models but contain something else.
const MISLEADING: [&[u8]; 6] =
    [b"version https://git-lfs", b"<!DOCTYPE", b"<!doctype", b"<html", b"\x1f\x8b", b"\x89PNG"];

/// Unsupported formats: first bytes, name and remedy.
const FOREIGN_FORMATS: [(&[u8], &str, &str); 19] = [
    (b"version https://git-lfs", "a Git LFS pointer", "run `git lfs pull`"),
    (b"<!DOCTYPE", "a web page", "download the model again"),
    (b"<!doctype", "a web page", "download the model again"),
    (b"<html", "a web page", "download the model again"),
    (b"\x1f\x8b", "a gzip archive", "unpack it first, as in `gunzip model.glb.gz`"),
    (b"Kaydara FBX Binary", "an FBX file", "export it as .glb from the program that made it"),
    (b"; FBX", "an FBX file", "export it as .glb from the program that made it"),
    (
        b"ISO-10303-21",
        "a STEP file",
        "convert it first, for example with `gmsh part.step -2 -o part.stl`",
    ),
    (b"PXR-USDC", "a USD file", "export it as .glb from the program that made it"),
    (b"#usda", "a USD file", "export it as .glb from the program that made it"),
    (b"BLENDER", "a Blender file", "export it as .glb from Blender"),
    (b"\x89PNG", "a PNG image", GIVE_A_MODEL),
    (b"\xff\xd8\xff", "a JPEG image", GIVE_A_MODEL),
    (b"PK\x03\x04", "a ZIP archive", "extract it and use a model from it"),
    (b"%PDF", "a PDF file", GIVE_A_MODEL),
    (b"# vtk", "a VTK file", "convert it to .ply or .stl, for example with ParaView"),
    (b"OFF", "an OFF file", "convert it to .ply or .obj, for example with MeshLab"),
    (b"xof ", "a DirectX file", "convert it to .glb, for example with Blender"),
    (b"<?xml", "an XML file (COLLADA, AMF, X3D …)", "export it as .glb or .3mf"),
];

/// Returns the error for a scene file where a model is expected.
fn scene_as_model() -> Diagnostic {
    let help = "`alberti scene check` checks it, and `alberti render` draws it";
    Diagnostic::error(codes::UNKNOWN_FORMAT, "", "this is a scene, not a model", help)
}

/// Returns the error for a file that neither its content nor its name identifies.
fn unknown_format(bytes: &[u8]) -> Diagnostic {
    let is_text = bytes.len() > 8
        && bytes.iter().take(512).all(|b| b.is_ascii_graphic() || b.is_ascii_whitespace());
    let known = FOREIGN_FORMATS.iter().find(|(start, ..)| bytes.starts_with(start));
    let (message, help) = match known {
        Some((_, name, help)) => (format!("this is {name}, which is not supported"), *help),
        None if bytes.is_empty() => ("the file is empty".to_owned(), "export it again"),
        None if is_text => ("this is text, not a model".to_owned(), WRITE_A_SCENE),
        None => ("this is not a model in a known format".to_owned(), GIVE_A_MODEL),
    };
    Diagnostic::error(codes::UNKNOWN_FORMAT, "", message, help)
}

/// The remedy for text that may be intended as a scene.
const WRITE_A_SCENE: &str = "use a .gltf, .glb, .stl, .obj, .ply or .3mf file; scenes are written in \
                             RON, in a .ron file: `alberti scene init model.glb` writes one";

/// The remedy for a file in an unknown format.
const GIVE_A_MODEL: &str = "use a .gltf, .glb, .stl, .obj, .ply or .3mf file";

#[cfg(test)]
mod tests {
    use super::*;

    fn binary_stl(header: &[u8], triangles: u32) -> Vec<u8> {
        let mut file = header.to_vec();
        file.resize(80, 0);
        file.extend(triangles.to_le_bytes());
        file.resize(84 + 50 * triangles as usize, 0);
        file
    }

    #[test]
    fn formats_are_detected_from_content() {
        let utf_16: Vec<u8> =
            "\u{FEFF}v 1 2 3\n".encode_utf16().flat_map(u16::to_le_bytes).collect();
        let table: [(&[u8], Option<FileFormat>); 16] = [
            (b"glTF\x02\0\0\0", Some(FileFormat::Gltf)),
            (b"\xEF\xBB\xBF \n{\"asset\": {}}", Some(FileFormat::Gltf)),
            (b"PK\x03\x04\x14", Some(FileFormat::ThreeMf)),
            (b"ply\r\nformat ascii 1.0\r\n", Some(FileFormat::Ply)),
            (b"plywood", None),
            (b"solid cube\nfacet normal 0 0 1\n", Some(FileFormat::Stl)),
            (b"  SOLID\rENDSOLID\r", Some(FileFormat::Stl)),
            (b"solid advice about nothing", None),
            (&binary_stl(b"exported by a program", 2), Some(FileFormat::Stl)),
            (&binary_stl(b"solid facet", 2), Some(FileFormat::Stl)),
            (b"# made by hand\n\nmtllib a.mtl\n", Some(FileFormat::Obj)),
            (b"\xEF\xBB\xBFv 1 2 3", Some(FileFormat::Obj)),
            (&utf_16, Some(FileFormat::Obj)),
            (b"vertex", None),
            (b"g", None),
            (b"", None),
        ];
        for (bytes, format) in table {
            let start = String::from_utf8_lossy(&bytes[..bytes.len().min(30)]);
            assert_eq!(FileFormat::from_content(bytes), format, "{start}");
        }
    }

    #[test]
    fn ambiguous_content_is_resolved_by_name() {
        let of = |name: &str, bytes: &[u8]| {
            FileFormat::recognize(Path::new(name), bytes).map_err(|error| error.sentence())
        };
        assert_eq!(of("a.STL", b""), Ok(FileFormat::Stl));
        assert_eq!(of("a.stl", b"v 1 2 3\n"), Ok(FileFormat::Obj));
        assert_eq!(of("a.obj", b"# nothing else"), Ok(FileFormat::Obj));
        let message = of("a.step", b"ISO-10303-21;\nHEADER;").unwrap_err();
        assert!(
            message.starts_with("this is a STEP file, which is not supported; convert"),
            "{message}"
        );
        let pointer = of("a.glb", b"version https://git-lfs.github.com/spec/v1").unwrap_err();
        assert!(pointer.ends_with("run `git lfs pull`"), "{pointer}");
        assert!(of("a", b"\0\0").unwrap_err().contains("known format"));
    }
}
