//! The protocol between the coordinator of a batch and its workers: one JSON object per line.
//!
//! ```text
//!  coordinator ─► {"input":"a.glb","pictures":[{"flags":["--size=64x64"],…},…]} ─► worker
//!              ◄─ {"answer":{"done":{…}},"follows":0} ◄─ …   one for each picture
//! ```

use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// An input to load, and its pictures to render.
#[derive(Serialize, Deserialize, Debug)]
pub struct WorkRequest {
    /// The model or scene.
    #[serde(with = "any_path")]
    pub input: PathBuf,
    /// The pictures, of which there is at least one.
    pub pictures: Vec<PictureRequest>,
}

/// A picture to render.
#[derive(Serialize, Deserialize, Debug)]
pub struct PictureRequest {
    /// The scene into which the input is inserted.
    pub scene: Option<PathBuf>,
    /// All flags of the picture.
    pub flags: Vec<String>,
    /// The destination of the picture.
    pub target: PictureTarget,
}

/// The destination of a picture.
#[derive(Serialize, Deserialize, Debug)]
#[serde(rename_all = "snake_case")]
pub enum PictureTarget {
    /// A file, which is first written under a temporary name.
    File {
        /// The file.
        #[serde(with = "any_path")]
        path: PathBuf,
        /// The temporary name.
        #[serde(with = "any_path")]
        partial: PathBuf,
    },
    /// The pipe, right after the answer line.
    Pipe,
}

/// An answer, and the number of picture bytes that follow its line.
#[derive(Serialize, Deserialize, Debug)]
pub struct FramedAnswer {
    /// The answer.
    pub answer: WorkAnswer,
    /// The number of bytes.
    pub follows: u64,
}

/// The result of a picture.
#[derive(Serialize, Deserialize, PartialEq, Debug)]
#[serde(rename_all = "snake_case")]
pub enum WorkAnswer {
    /// The picture was rendered, and written unless it follows through the pipe.
    Done {
        /// Time in seconds, including loading if this picture triggered it.
        seconds: f64,
        /// The number of warnings.
        warnings: usize,
        /// The first warning; empty if there are none.
        message: String,
        /// The size of the picture.
        bytes: u64,
        /// The picture's SHA-256 in hexadecimal.
        sha256: String,
    },
    /// The model, the scene or a flag is wrong.
    Failed {
        /// Time in seconds.
        seconds: f64,
        /// The error.
        message: String,
    },
    /// The output folder is unusable, so no other picture can be written either.
    Stopped {
        /// The error.
        message: String,
    },
}

/// Paths as text, or as bytes if they are not UTF-8.
mod any_path {
    use serde::de::Error as _;
    use serde::ser::Error as _;
    use serde::{Deserialize, Deserializer, Serialize, Serializer};
    use std::path::{Path, PathBuf};

    /// A path in a form that JSON can represent.
    #[derive(Serialize, Deserialize)]
    #[serde(untagged)]
    enum PathText {
        Text(String),
        Bytes(Vec<u8>),
    }

    pub(super) fn serialize<S: Serializer>(path: &Path, to: S) -> Result<S::Ok, S::Error> {
        let text = match path.to_str() {
            Some(text) => Some(PathText::Text(text.to_owned())),
            None => path_bytes(path).map(PathText::Bytes),
        };
        text.ok_or_else(|| S::Error::custom("a name is not Unicode"))?.serialize(to)
    }

    pub(super) fn deserialize<'de, D: Deserializer<'de>>(from: D) -> Result<PathBuf, D::Error> {
        match PathText::deserialize(from)? {
            PathText::Text(text) => Ok(PathBuf::from(text)),
            PathText::Bytes(bytes) => {
                path_of(bytes).ok_or_else(|| D::Error::custom("a name is not Unicode"))
            }
        }
    }

    #[cfg(unix)]
    #[expect(clippy::unnecessary_wraps, reason = "other systems have names that are not bytes")]
    fn path_bytes(path: &Path) -> Option<Vec<u8>> {
        use std::os::unix::ffi::OsStrExt as _;
        Some(path.as_os_str().as_bytes().to_owned())
    }

    #[cfg(unix)]
    #[expect(clippy::unnecessary_wraps, reason = "other systems have names that are not bytes")]
    fn path_of(bytes: Vec<u8>) -> Option<PathBuf> {
        use std::os::unix::ffi::OsStringExt as _;
        Some(std::ffi::OsString::from_vec(bytes).into())
    }

    #[cfg(not(unix))]
    fn path_bytes(_path: &Path) -> Option<Vec<u8>> {
        None
    }

    #[cfg(not(unix))]
    fn path_of(_bytes: Vec<u8>) -> Option<PathBuf> {
        None
    }
}
