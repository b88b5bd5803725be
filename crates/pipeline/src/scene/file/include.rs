//! Other scene files that a scene begins with.

use core::fmt;
use serde::de::{Deserialize, Deserializer, Error, SeqAccess, Visitor};

/// One path, `"studio.ron"`, or several, `["studio.ron", "paper.ron"]`, from the folder of the file that names them.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Paths(pub Vec<String>);

impl<'de> Deserialize<'de> for Paths {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(PathsVisitor).map(Self)
    }
}

struct PathsVisitor;

impl<'de> Visitor<'de> for PathsVisitor {
    type Value = Vec<String>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("the path of a scene file in quotation marks, or a list of them")
    }

    fn visit_str<E: Error>(self, path: &str) -> Result<Vec<String>, E> {
        Ok(vec![path.to_owned()])
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> Result<Vec<String>, A::Error> {
        let mut paths = Vec::new();
        while let Some(path) = seq.next_element()? {
            paths.push(path);
        }
        Ok(paths)
    }
}
