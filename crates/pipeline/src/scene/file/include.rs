//! The scene files that a scene file includes.

use crate::scene::schema::{Checker, Declared, SceneValue, Shape, TypeEntry, ValueType};
use crate::scene::syntax::{Node, NodeKind};

/// Paths of included files. Written `"studio.ron"` or `["studio.ron", "paper.ron"]`.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Paths(pub Vec<String>);

impl Declared for Paths {
    const ENTRY: &'static TypeEntry = &TypeEntry {
        name: "Paths",
        doc: "One path, `\"studio.ron\"`, or several, `[\"studio.ron\", \"paper.ron\"]`, from the folder of the file that names them.",
        shape: Shape::Plain,
    };
}

impl SceneValue for Paths {
    fn value_type() -> ValueType {
        ValueType::Declared(Self::ENTRY)
    }

    fn from_node(node: &Node<'_>, checker: &mut Checker<'_>) -> Option<Self> {
        match &node.kind {
            NodeKind::Group(_) => Vec::from_node(node, checker).map(Self),
            _ => String::from_node(node, checker).map(|path| Self(vec![path])),
        }
    }
}
