//! A 3MF model part: objects, the property groups they refer to, and the items to build.

use super::namespaces::{Namespaces, Support};
use super::object::{Object, ObjectContent};
use super::package::Package;
use super::properties::{GroupKind, Palette, PartProperties, parse_id, parse_number};
use super::xml::{Element, XmlReader};
use crate::text::{TextScanner, parse_f64};
use glam::{DMat4, DVec4};
use gltf_import::ImportWarnings;
use homog::{Affine, Model as ModelSpace};
use model::{Diagnostic, LengthUnit, Material};

/// Memory for an object without its mesh and components. The object's tags may be shorter.
const OBJECT_BYTES: u64 = 256;

/// A reference to an object: an item to build, or a component of an object.
#[derive(Debug)]
pub(super) struct ObjectReference {
    /// The part that contains the object, if it is a different part (production extension).
    pub(super) path: Option<String>,
    /// The id of the object in its part.
    pub(super) id: u32,
    /// The transform from the object's coordinates to its parent's.
    pub(super) transform: Affine<ModelSpace, ModelSpace>,
    /// Location of the reference, for messages.
    pub(super) location: String,
}

/// The content of a model part.
#[derive(Debug, Default)]
pub(super) struct ModelPart {
    /// The unit of lengths in the part.
    pub(super) unit: LengthUnit,
    /// The objects in order.
    pub(super) objects: Vec<Object>,
    /// The build items.
    pub(super) items: Vec<ObjectReference>,
    /// Colors and materials.
    pub(super) properties: PartProperties,
}

/// The reader of a model part.
pub(super) struct PartReader<'a, 'w> {
    pub(super) xml: XmlReader<'a>,
    pub(super) namespaces: Namespaces<'a>,
    /// Counts the memory of the parsed data.
    package: &'w Package<'w>,
    pub(super) palette: &'w mut Palette,
    pub(super) warnings: &'w mut ImportWarnings,
    /// The subjects that have had a warning, so that each is reported once.
    said: Vec<&'static str>,
}

impl<'a, 'w> PartReader<'a, 'w> {
    /// Creates a reader for the part with this name.
    pub(super) fn new(
        text: &'a [u8],
        name: &'a str,
        package: &'w Package<'w>,
        palette: &'w mut Palette,
        warnings: &'w mut ImportWarnings,
    ) -> Self {
        let (xml, namespaces) = (XmlReader::new(text, name), Namespaces::default());
        Self { xml, namespaces, package, palette, warnings, said: Vec::new() }
    }

    /// Reads the part.
    ///
    /// # Errors
    /// Fails if the part is not XML, is not a model, breaks a rule, or requires an unknown
    /// extension. In lenient mode, the content before the error is used.
    pub(super) fn read_part(&mut self) -> Result<ModelPart, Diagnostic> {
        let mut part = ModelPart { unit: LengthUnit::Millimeter, ..ModelPart::default() };
        let Some(root) = self.xml.next_child(0)?.filter(|root| root.local_name() == "model") else {
            return Err(self.xml.fault(0, "this is not a 3MF model"));
        };
        self.namespaces = Namespaces::from_root(&root);
        let location = self.xml.location_of(&root);
        self.namespaces.check_required(&root, &location, self.warnings)?;
        part.unit = self.read_unit(&root);
        if let Err(fault) = self.read_model(&mut part) {
            self.warnings.downgrade_if_lenient(fault, "the rest of the part is skipped")?;
        }
        Ok(part)
    }

    /// Reads the unit of the model.
    fn read_unit(&mut self, root: &Element<'_>) -> LengthUnit {
        match root.attribute("unit") {
            None | Some(b"millimeter") => LengthUnit::Millimeter,
            Some(b"micron") => LengthUnit::Micrometer,
            Some(b"centimeter") => LengthUnit::Centimeter,
            Some(b"meter") => LengthUnit::Meter,
            Some(b"inch") => LengthUnit::Inch,
            Some(b"foot") => LengthUnit::Foot,
            Some(_) => {
                let location = self.xml.location_of(root);
                self.warnings.push_warning(&location, "unknown unit; millimeters are used");
                LengthUnit::Millimeter
            }
        }
    }

    /// Reads the content of the root element.
    fn read_model(&mut self, part: &mut ModelPart) -> Result<(), Diagnostic> {
        while let Some(child) = self.xml.next_child(1)? {
            match child.local_name() {
                "resources" if self.is_read(&child) => self.read_resources(part)?,
                "build" if self.is_read(&child) => {
                    part.items.extend(self.read_references("item")?);
                }
                _ => {}
            }
        }
        Ok(())
    }

    /// Returns whether the namespace of an element is read, and warns if the element is skipped.
    pub(super) fn is_read(&mut self, element: &Element<'_>) -> bool {
        if self.namespaces.is_read(element) {
            return true;
        }
        let (name, support) = self.namespaces.support_of(element.prefix());
        if matches!(support, Support::LeftOut | Support::Refused) {
            self.say_once(element, name, &format!("skipped unsupported {name}"));
        }
        false
    }

    /// Adds a warning at an element, unless there is already a warning on the same subject.
    pub(super) fn say_once(&mut self, element: &Element<'_>, subject: &'static str, message: &str) {
        if !self.said.contains(&subject) {
            self.said.push(subject);
            self.warnings.push_warning(&self.xml.location_of(element), message);
        }
    }

    /// Reads objects, groups and textures.
    fn read_resources(&mut self, part: &mut ModelPart) -> Result<(), Diagnostic> {
        let depth = self.xml.depth();
        while let Some(resource) = self.xml.next_child(depth)? {
            if !self.is_read(&resource) {
                continue;
            }
            match resource.local_name() {
                "object" => {
                    let object = self.read_object(&resource)?;
                    part.objects.push(object);
                }
                "texture2d" => {
                    let location = self.xml.location_of(&resource);
                    self.package.charge_bytes(&location, size_of::<Material>() as u64)?;
                    part.properties.add_texture(&resource, location, self.palette);
                }
                _ => self.read_group(&resource, &mut part.properties)?,
            }
        }
        Ok(())
    }

    /// Reads a property group. Any other resource is skipped.
    fn read_group(
        &mut self,
        start: &Element<'_>,
        properties: &mut PartProperties,
    ) -> Result<(), Diagnostic> {
        let depth = self.xml.depth();
        let group = match properties.open_group(start, self.palette) {
            Ok(Some(group)) => group,
            Ok(None) => return Ok(()),
            Err(message) => {
                let location = self.xml.location_of(start);
                self.warnings.push_warning(&location, format!("{message}; it is skipped"));
                return Ok(());
            }
        };
        let Some(id) = parse_id(start, "id") else {
            self.warnings.push_warning(&self.xml.location_of(start), "the group has no id");
            return Ok(());
        };
        match start.local_name() {
            "multiproperties" => {
                let message =
                    "property layers are approximated by their colors or by the last texture";
                self.say_once(start, "multiproperties", message);
            }
            "compositematerials" => {
                let message = "mixed materials are shown in their average color";
                self.say_once(start, "compositematerials", message);
            }
            _ => {}
        }
        let Some(kind) = group.kind() else {
            properties.close_metallic(id, self.read_metallic()?);
            return Ok(());
        };
        let mut entries = Vec::new();
        while let Some(entry) = self.xml.next_child(depth)? {
            // Charged one by one, because a material takes far more memory than its text.
            if kind == GroupKind::Base {
                let location = self.xml.location_of(&entry);
                self.package.charge_bytes(&location, size_of::<Material>() as u64)?;
            }
            let property = group.read_entry(&entry, entries.len(), properties, self.palette);
            let Some(property) = property else {
                let fault = Diagnostic::invalid(
                    &self.xml.location_of(&entry),
                    format!("the {} is malformed", entry.local_name()),
                );
                self.warnings.downgrade(&fault, "the group ends here");
                break;
            };
            entries.push(property);
        }
        properties.close_group(id, kind, entries);
        Ok(())
    }

    /// Reads the metalness and roughness of each entry in a list.
    fn read_metallic(&mut self) -> Result<Vec<[f32; 2]>, Diagnostic> {
        let depth = self.xml.depth();
        let mut entries = Vec::new();
        while let Some(entry) = self.xml.next_child(depth)? {
            let number = |name: &str, default| {
                parse_number(&entry, name).map_or(default, |x| x.clamp(0.0, 1.0))
            };
            entries.push([number("metallicness", 0.0), number("roughness", 1.0)]);
        }
        Ok(entries)
    }

    /// Reads the items of a build or the components of an object.
    pub(super) fn read_references(
        &mut self,
        name: &str,
    ) -> Result<Vec<ObjectReference>, Diagnostic> {
        let depth = self.xml.depth();
        let mut references = Vec::new();
        while let Some(child) = self.xml.next_child(depth)? {
            if child.local_name() != name || !self.is_read(&child) {
                continue;
            }
            let location = self.xml.location_of(&child);
            self.package.charge_bytes(&location, size_of::<ObjectReference>() as u64)?;
            let Some(id) = parse_id(&child, "objectid") else {
                let fault = Diagnostic::invalid(&location, format!("the {name} has no objectid"));
                self.warnings.downgrade_if_lenient(fault, "it is skipped")?;
                continue;
            };
            let transform = match child.attribute("transform").map(parse_transform) {
                None => Affine::IDENTITY,
                Some(Some(transform)) => transform,
                Some(None) => {
                    let message = "the transform must be twelve finite numbers";
                    let fault = Diagnostic::invalid(&location, message);
                    self.warnings
                        .downgrade_if_lenient(fault, "the object is shown without a transform")?;
                    Affine::IDENTITY
                }
            };
            let path = child.text_attribute("path");
            references.push(ObjectReference { path, id, transform, location });
        }
        Ok(references)
    }

    /// Reads an object.
    fn read_object(&mut self, start: &Element<'_>) -> Result<Object, Diagnostic> {
        let location = self.xml.location_of(start);
        self.package.charge_bytes(&location, OBJECT_BYTES)?;
        let Some(id) = parse_id(start, "id") else {
            return Err(Diagnostic::invalid(&location, "the object has no id"));
        };
        let kind = start.text_attribute("type").unwrap_or_default();
        let mut object = Object {
            id,
            name: start.text_attribute("name").filter(|name| !name.is_empty()),
            is_shown: !matches!(kind.as_str(), "support" | "solidsupport" | "other"),
            group: parse_id(start, "pid"),
            property: parse_id(start, "pindex"),
            location,
            content: ObjectContent::default(),
        };
        let depth = self.xml.depth();
        while let Some(child) = self.xml.next_child(depth)? {
            match child.local_name() {
                "mesh" if self.is_read(&child) => {
                    object.content.mesh = Some(self.read_mesh()?);
                }
                "components" if self.is_read(&child) => {
                    object.content.components.extend(self.read_references("component")?);
                }
                _ => drop(self.is_read(&child)),
            }
        }
        Ok(object)
    }
}

/// Parses a transform of twelve numbers: the rows of a 4×3 matrix for row vectors. The first three
/// rows are the images of the axes, and the last row is the translation.
fn parse_transform(text: &[u8]) -> Option<Affine<ModelSpace, ModelSpace>> {
    let mut scanner = TextScanner::new(text);
    let mut rows = [[0.0; 3]; 4];
    for number in rows.as_flattened_mut() {
        *number = parse_f64(scanner.next_token()?.bytes)?;
    }
    let row = |at: usize, w| DVec4::new(rows[at][0], rows[at][1], rows[at][2], w);
    let matrix = DMat4::from_cols(row(0, 0.0), row(1, 0.0), row(2, 0.0), row(3, 1.0));
    let map = Affine::from_raw(matrix)?;
    (scanner.next_token().is_none() && map.is_finite()).then_some(map)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn transforms_are_rows_of_a_matrix() {
        let map = parse_transform(b"0 1 0  -1 0 0  0 0 2  10 20 30").unwrap();
        let image = map.transform_point([1.0, 2.0, 3.0].into());
        // x maps to y, y to −x, and z to 2 z; then the last row is added.
        assert_eq!(image.raw().to_array(), [10.0 - 2.0, 20.0 + 1.0, 30.0 + 6.0]);
        for wrong in
            ["1 0 0 0 1 0 0 0 1 0 0", "1 0 0 0 1 0 0 0 1 0 0 0 0", "1 0 0 0 1 0 0 0 1 0 0 nan"]
        {
            assert!(parse_transform(wrong.as_bytes()).is_none(), "{wrong}");
        }
    }
}
