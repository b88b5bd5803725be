//! Explanations: the viewing pipeline step by step, as JSON.

use crate::arrays;
use crate::detached::run_detached;
use crate::failure::{Failure, Fallible};
use crate::keywords::{Keywords, not_a, plain_name};
use crate::scene_options::apply_options;
use crate::subject::Subject;
use ::explain::{
    ApiConventions, Explanation, TransformChain, explain_homogeneous_point, explain_node,
    explain_pixel, explain_point, explain_segment, explain_transforms,
};
use homog::{Point, World};
use model::ModelInstance;
use pipeline::{RenderError, Scene};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use scene_file::file::Choice;

/// The subject of an explanation.
enum ExplainedPart {
    Transforms,
    Point([f64; 3]),
    Homogeneous([f64; 4]),
    Segment([[f64; 3]; 2]),
    Pixel([u32; 2]),
    Node(Choice),
}

/// Explains a part of a subject and returns the explanation as JSON.
#[pyfunction]
pub(crate) fn explain(
    py: Python<'_>,
    subject: &Bound<'_, Subject>,
    options: &Bound<'_, PyDict>,
) -> PyResult<String> {
    let options = Keywords(options);
    let subject = subject.get();
    let file = apply_options(subject, &options)?;
    let part = read_part(&options)?;
    let conventions = read_conventions(&options)?;
    run_detached(py, |_| -> Fallible<String> {
        let scene = subject.resolve(&file)?;
        let size = (scene.image.width, scene.image.height);
        let chain = TransformChain::new(&scene.view_projection, size, conventions);
        let chain = chain.map_err(RenderError::from)?;
        Ok(explain_part(&chain, &scene, &part)?.to_json().to_string())
    })
}

/// Reads the subject of the explanation.
fn read_part(options: &Keywords<'_, '_>) -> PyResult<ExplainedPart> {
    let given = ["point", "segment", "pixel", "node"];
    let mut found = Vec::new();
    for name in given {
        found.extend(options.value(name)?.map(|value| (name, value)));
    }
    let [(name, value)] = &found[..] else {
        let [_, (second, _), ..] = &found[..] else { return Ok(ExplainedPart::Transforms) };
        let message = "pass only one of point, segment, pixel and node";
        return Err(Failure::argument(*second, message).into());
    };
    Ok(match *name {
        "point" => match arrays::real_array::<f64>("point", value, "float64")?.shape[..] {
            [4] => ExplainedPart::Homogeneous(arrays::vector("point", value)?),
            _ => ExplainedPart::Point(arrays::vector("point", value)?),
        },
        "segment" => ExplainedPart::Segment(arrays::matrix("segment", value)?),
        "pixel" => {
            let wrong = |_| PyErr::from(not_a("pixel", value, "(column, row)"));
            let (column, row) = value.extract::<(u32, u32)>().map_err(wrong)?;
            ExplainedPart::Pixel([column, row])
        }
        _ => {
            let index = value.extract().map(Choice::Index);
            let named = || value.extract().map(Choice::Name);
            let wrong = |_| PyErr::from(not_a("node", value, "a name or an index"));
            ExplainedPart::Node(index.or_else(|_| named()).map_err(wrong)?)
        }
    })
}

/// Reads the conventions for view space, the canonical volume and pixels.
fn read_conventions(options: &Keywords<'_, '_>) -> PyResult<ApiConventions> {
    let name = options.text("conventions")?.unwrap_or_else(|| "alberti".to_owned());
    let known =
        ApiConventions::ALL.into_iter().find(|known| plain_name(known.name()) == plain_name(&name));
    known.ok_or_else(|| {
        let names = ApiConventions::ALL.map(ApiConventions::name).join(", ");
        Failure::argument("conventions", format!("is {name:?}, expected one of {names}")).into()
    })
}

/// Explains a part of a scene.
fn explain_part(
    chain: &TransformChain,
    scene: &Scene,
    part: &ExplainedPart,
) -> Fallible<Explanation> {
    match part {
        ExplainedPart::Transforms => Ok(explain_transforms(chain)),
        ExplainedPart::Point(point) => Ok(explain_point(chain, Point::<World>::from(*point))),
        ExplainedPart::Homogeneous(point) => {
            let explained = explain_homogeneous_point(chain, (*point).into());
            explained.map_err(|message| Failure::argument("point", message))
        }
        ExplainedPart::Segment(ends) => Ok(explain_segment(chain, ends.map(Point::<World>::from))),
        ExplainedPart::Pixel([x, y]) => explain_pixel(chain, scene, *x, *y)
            .map_err(|message| Failure::argument("pixel", message)),
        ExplainedPart::Node(node) => {
            let (placed, node) = find_node(&scene.models, node)?;
            Ok(explain_node(chain, placed, node))
        }
    }
}

/// Finds the first model that has a node with this index or name.
fn find_node<'a>(
    models: &'a [ModelInstance],
    wanted: &Choice,
) -> Fallible<(&'a ModelInstance, usize)> {
    let found = models.iter().find_map(|placed| {
        let nodes = &placed.model.nodes;
        let node = match wanted {
            Choice::Index(index) => (*index < nodes.len()).then_some(*index),
            Choice::Name(name) => nodes.iter().position(|node| node.name.as_ref() == Some(name)),
        };
        Some((placed, node?))
    });
    found.ok_or_else(|| {
        let wanted = match wanted {
            Choice::Index(index) => index.to_string(),
            Choice::Name(name) => format!("{name:?}"),
        };
        let count: usize = models.iter().map(|placed| placed.model.nodes.len()).sum();
        Failure::argument(
            "node",
            format!("is {wanted}, but no model has it; there are {count} nodes"),
        )
    })
}
