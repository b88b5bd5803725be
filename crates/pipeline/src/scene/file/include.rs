//! The scene files that a scene file includes.

use crate::scene::schema::{
    AnyForm, Checker, Declared, Notation, SceneValue, Shape, TypeEntry, ValueType,
    serde_by_scene_value,
};
use crate::scene::syntax::Node;
use serde::de::{Deserialize, Deserializer, Error as _};
use serde::ser::Serializer;

serde_by_scene_value! { Paths }

/// Paths of included files. Written `"studio.ron"` or `["studio.ron", "paper.ron"]`.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Paths(pub Vec<String>);

impl Declared for Paths {
    const ENTRY: &'static TypeEntry = &TypeEntry {
        name: "Paths",
        doc: "One path, `\"studio.ron\"`, or several, `[\"studio.ron\", \"paper.ron\"]`, from the folder of the file that names them.",
        shape: Shape::Plain(Notation(check_paths)),
    };
}

impl SceneValue for Paths {
    fn value_type() -> ValueType {
        ValueType::Declared(Self::ENTRY)
    }

    fn read<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        match AnyForm::deserialize(deserializer)? {
            AnyForm::List(paths) => Ok(Self(paths)),
            AnyForm::Text(path) => Ok(Self(vec![path])),
            _ => Err(D::Error::custom("expected a path or a list of paths")),
        }
    }

    fn write<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self.0.as_slice() {
            [path] => serializer.serialize_str(path),
            paths => serializer.collect_seq(paths),
        }
    }
}

/// Reports what is wrong with one path or a list of paths.
fn check_paths(node: &Node<'_>, checker: &mut Checker<'_>) {
    match node.group() {
        Some(group) if group.open != '{' => {
            checker.check_elements(&group.items, &String::value_type());
        }
        _ => Checker::check_string(node, checker),
    }
}
