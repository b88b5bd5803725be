//! The scene files that a scene file includes.

use crate::schema::{
    Checker, Data, Declared, Form, Notation, SceneValue, Shape, TypeEntry, ValueType, read_plain,
    serde_by_scene_value,
};
use crate::syntax::Node;

serde_by_scene_value! { Paths }

/// Paths of included files, written as `"studio.ron"` or `["studio.ron", "paper.ron"]`.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Paths(pub Vec<String>);

impl Declared for Paths {
    const ENTRY: &'static TypeEntry = &TypeEntry {
        name: "Paths",
        doc: "One path, `\"studio.ron\"`, or several, `[\"studio.ron\", \"paper.ron\"]`, relative to the folder of the file that includes them.",
        shape: Shape::Plain(Notation {
            check: check_paths,
            form: Form::Any(String::value_type),
            read: read_plain::<Self>,
        }),
    };
}

impl SceneValue for Paths {
    fn value_type() -> ValueType {
        ValueType::Declared(Self::ENTRY)
    }

    fn from_data(data: &Data) -> Result<Self, String> {
        match data {
            Data::Text(path) => Ok(Self(vec![path.clone()])),
            list => Vec::from_data(list).map(Self),
        }
    }

    fn to_data(&self) -> Data {
        match self.0.as_slice() {
            [path] => path.to_data(),
            _ => self.0.to_data(),
        }
    }
}

/// Reports the mistakes in one path or a list of paths.
fn check_paths(node: &Node<'_>, checker: &mut Checker<'_>) {
    match node.group() {
        Some(group) if group.open != '{' => {
            checker.check_elements(&group.items, &String::value_type());
        }
        _ => Checker::check_string(node, checker),
    }
}
