//! Meshes shown many times by one node (EXT_mesh_gpu_instancing): accessors with a place for each time.

use super::accessor::Source;
use super::attribute::{Format, PLACE, TURN};
use super::error::Fault;
use super::warnings::Warnings;
use crate::Node;
use homog::{Affine, Model as ModelSpace, Vector};
use serde_json::{Map, Value};

/// The name of the extension.
const NAME: &str = "EXT_mesh_gpu_instancing";

type Place = Affine<ModelSpace, ModelSpace>;

/// Gives the nodes the places that their meshes are shown at. What cannot be read leaves the mesh where its node is.
pub(super) fn read(
    source: &Source<'_>,
    nodes: &mut [Node],
    warnings: &mut Warnings,
) -> Result<(), Fault> {
    for (at, node) in nodes.iter_mut().enumerate() {
        let json = source.root.nodes.get(at).and_then(|json| json.extensions.as_ref());
        let Some(extension) = json.and_then(|extensions| extensions.others.get(NAME)) else {
            continue;
        };
        let pointer = format!("/nodes/{at}/extensions/{NAME}");
        if node.skin.is_some() || node.mesh.is_none() {
            let message =
                "only a mesh without skin can be shown many times; the places are not used";
            warnings.add(&pointer, message);
            continue;
        }
        let read = match extension.get("attributes").and_then(Value::as_object) {
            Some(attributes) => places(source, attributes, &format!("{pointer}/attributes")),
            None => Err(Fault::invalid(&pointer, "the member `attributes` is missing")),
        };
        let all = match read {
            Err(fault) if fault.is_soft() => {
                warnings.soft(&fault, "the mesh is shown once");
                continue;
            }
            places => places?,
        };
        let count = all.len();
        let shown = |place: &Place| place.then(node.to_model).is_finite();
        let places: Vec<Place> = all.into_iter().flatten().filter(shown).collect();
        if places.len() < count {
            let lost = count - places.len();
            let message = format!("places are no finite ones; they are left out (places: {lost})");
            warnings.add(&pointer, message);
        }
        node.places = Some(places);
    }
    Ok(())
}

/// The places: scaled, then turned, then moved. `None` stands for one that is none.
fn places(
    source: &Source<'_>,
    attributes: &Map<String, Value>,
    pointer: &str,
) -> Result<Vec<Option<Place>>, Fault> {
    let column = Column { source, attributes, pointer };
    let moved = column.read::<3>("TRANSLATION", &PLACE)?;
    let turned = column.read::<4>("ROTATION", &TURN)?;
    let scaled = column.read::<3>("SCALE", &PLACE)?;
    let counts = [
        moved.as_ref().map(Vec::len),
        turned.as_ref().map(Vec::len),
        scaled.as_ref().map(Vec::len),
    ];
    let mut counts = counts.into_iter().flatten();
    let count = counts.next().unwrap_or(0);
    if counts.any(|other| other != count) {
        return Err(Fault::invalid(pointer, "the attributes have not equally many elements"));
    }
    source
        .buffers
        .charge(pointer, (count as u64).saturating_mul(size_of::<Option<Place>>() as u64))?;
    let place = |at: usize| {
        let row = moved.as_ref().map_or([0.0; 3], |moved| moved[at]).map(f64::from);
        let turn = turned.as_ref().map_or([0.0, 0.0, 0.0, 1.0], |turned| turned[at]);
        let [x, y, z] = scaled.as_ref().map_or([1.0; 3], |scaled| scaled[at]).map(f64::from);
        let turn = Affine::<ModelSpace, ModelSpace>::from_quaternion(turn.map(f64::from))?;
        let place = Place::scale(x, y, z).then(turn).then(Affine::translation(Vector::from(row)));
        place.is_finite().then_some(place)
    };
    Ok((0..count).map(place).collect())
}

struct Column<'a> {
    source: &'a Source<'a>,
    attributes: &'a Map<String, Value>,
    pointer: &'a str,
}

impl Column<'_> {
    fn read<const N: usize>(
        &self,
        name: &str,
        format: &Format,
    ) -> Result<Option<Vec<[f32; N]>>, Fault> {
        let Some(value) = self.attributes.get(name) else { return Ok(None) };
        let pointer = format!("{}/{name}", self.pointer);
        let accessor = value.as_u64().ok_or_else(|| Fault::invalid(&pointer, "an index is due"))?;
        let accessor = usize::try_from(accessor).unwrap_or(usize::MAX);
        let elements = self.source.elements(accessor, &pointer)?;
        format.check(&elements, &pointer)?;
        self.source.floats(&elements).map(Some)
    }
}
