//! `alberti explain`: where a point, a segment, a vertex or a triangle goes, stage by stage, and why a node is not seen.

use super::CliError;
use super::load_options::LoadArgs;
use super::render::{open_input, thread_count};
use super::scene_overrides::SceneOverrideArgs;
use homog::{Point, World};
use model::Model;
use model::ModelInstance;
use pipeline::explain::{
    ApiConventions, Explanation, TransformChain, VertexRef, explain_node, explain_pixel,
    explain_point, explain_segment, explain_transforms, explain_triangle, explain_vertex,
};
use pipeline::scene::ResolveOptions;
use pipeline::{Picture, Scene};
use std::io::Write as _;
use std::path::PathBuf;

/// The longer side of the picture on a page, in pixels.
const MAX_PAGE_SIDE: f64 = 960.0;

#[derive(Debug, clap::Args)]
pub(crate) struct ExplainArgs {
    /// A scene (.ron) or a model (.gltf, .glb)
    input: PathBuf,
    #[command(flatten)]
    subject: ExplainSubjectArgs,
    /// Whose canonical volume, view space and pixels are spoken of
    #[arg(long, value_name = "NAME", default_value = "alberti", value_parser = conventions())]
    conventions: ApiConventions,
    /// The explanation for programs
    #[arg(long)]
    json: bool,
    /// The explanation as a page with figures, which needs no other file
    #[arg(long, conflicts_with = "json")]
    html: bool,
    /// Where it goes [default: the standard output]
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    #[command(flatten)]
    overrides: SceneOverrideArgs,
    #[command(flatten)]
    load_options: LoadArgs,
}

/// What is explained: a place, or a part of a model; without any the maps themselves.
#[derive(Debug, clap::Args)]
#[command(next_help_heading = "Subject")]
struct ExplainSubjectArgs {
    /// A point of the world
    #[arg(long, value_name = "X,Y,Z", value_parser = numbers::<3>, allow_hyphen_values = true, conflicts_with_all = ["segment", "node"])]
    point: Option<[f64; 3]>,
    /// A pixel by its column and row from the upper left corner: what is seen in it, and why it has its colour
    #[arg(long, value_name = "X,Y", value_parser = pair, conflicts_with_all = ["point", "segment", "node"])]
    pixel: Option<[u32; 2]>,
    /// A segment of the world, from one point to another
    #[arg(long, value_name = "X,Y,Z,X,Y,Z", value_parser = numbers::<6>, allow_hyphen_values = true, conflicts_with = "node")]
    segment: Option<[f64; 6]>,
    /// A node of the model, by name or by number from 0: why it is seen, or not
    #[arg(long, value_name = "NAME|INDEX")]
    node: Option<String>,
    /// A vertex of the node's mesh, by number from 0
    #[arg(long, value_name = "INDEX", requires = "node", conflicts_with = "triangle")]
    vertex: Option<usize>,
    /// A triangle of the node's mesh, by number from 0
    #[arg(long, value_name = "INDEX", requires = "node")]
    triangle: Option<usize>,
    /// Which primitive of the mesh the vertex or triangle is in
    #[arg(long, value_name = "INDEX", requires = "node", default_value_t = 0)]
    primitive: usize,
    /// Which model of the scene the node is in
    #[arg(long, value_name = "INDEX", requires = "node", default_value_t = 0)]
    model: usize,
}

pub(crate) fn run(args: &ExplainArgs) -> Result<(), CliError> {
    let (origin, mut file) =
        open_input(&args.input, &args.overrides.import_options(&args.load_options))?;
    args.overrides.apply_to(&mut file);
    let scene = Scene::resolve(
        &origin,
        &file,
        &ResolveOptions { import: args.overrides.import_options(&args.load_options) },
    )?;
    let size = (scene.image.width, scene.image.height);
    let chain = TransformChain::new(&scene.view_projection, size, args.conventions)
        .map_err(pipeline::RenderError::from)?;
    let explanation = args.subject.explain_subject(&chain, &scene).map_err(CliError::Usage)?;
    let text = match (args.json, args.html) {
        (true, _) => format!("{:#}\n", explanation.to_json()),
        (_, true) => explanation.to_html(&chain, Some(&render_page_picture(scene)?)),
        _ => explanation.to_string(),
    };
    match &args.output {
        Some(path) => pipeline::write_file(path, text.as_bytes())?,
        None => std::io::stdout().write_all(text.as_bytes())?,
    }
    Ok(())
}

/// The picture of a scene, no larger than a page has room for.
fn render_page_picture(mut scene: Scene) -> Result<Picture, CliError> {
    let image = &mut scene.image;
    let most = f64::from(image.width.max(image.height));
    let shrunk_side =
        |side: u32| ((f64::from(side) * (MAX_PAGE_SIDE / most).min(1.0)) as u32).max(1);
    (image.width, image.height) = (shrunk_side(image.width), shrunk_side(image.height));
    Ok(pipeline::render(&scene, thread_count(None))?)
}

impl ExplainSubjectArgs {
    fn explain_subject(
        &self,
        chain: &TransformChain,
        scene: &Scene,
    ) -> Result<Explanation, String> {
        if let Some(place) = self.point {
            return Ok(explain_point(chain, place.into()));
        }
        if let Some([x, y]) = self.pixel {
            return explain_pixel(chain, scene, x, y);
        }
        if let Some([ax, ay, az, bx, by, bz]) = self.segment {
            let ends = [[ax, ay, az], [bx, by, bz]];
            return Ok(explain_segment(chain, ends.map(Point::<World>::from)));
        }
        let Some(node) = &self.node else { return Ok(explain_transforms(chain)) };
        let placed = scene.models.get(self.model).ok_or_else(|| {
            let count = scene.models.len();
            format!("the scene has {count} models; there is no model {}", self.model)
        })?;
        self.explain_part(chain, placed, find_node(&placed.model, node)?)
    }

    fn explain_part(
        &self,
        chain: &TransformChain,
        placed: &ModelInstance,
        node: usize,
    ) -> Result<Explanation, String> {
        let primitive = self.primitive;
        match (self.vertex, self.triangle) {
            (Some(index), _) => explain_vertex(chain, placed, VertexRef { node, primitive, index }),
            (_, Some(triangle)) => explain_triangle(chain, placed, node, primitive, triangle),
            _ => Ok(explain_node(chain, placed, node)),
        }
    }
}

/// The number of a node by its number or name.
fn find_node(model: &Model, node: &str) -> Result<usize, String> {
    let named = || model.nodes.iter().position(|known| known.name.as_deref() == Some(node));
    let numbered = node.parse().ok().filter(|&number: &usize| number < model.nodes.len());
    numbered.or_else(named).ok_or_else(|| {
        let names: Vec<&str> =
            model.nodes.iter().filter_map(|node| node.name.as_deref()).take(12).collect();
        let count = model.nodes.len();
        format!("there is no node `{node}`; there are {count}, among them: {}", names.join(", "))
    })
}

fn numbers<const N: usize>(text: &str) -> Result<[f64; N], String> {
    let fault = || format!("expected {N} numbers with commas between them");
    let numbers: Vec<f64> = text
        .split(',')
        .map(|word| word.trim().parse().map_err(|_| fault()))
        .collect::<Result<_, _>>()?;
    let numbers: [f64; N] = numbers.try_into().map_err(|_| fault())?;
    if numbers.iter().all(|number| number.is_finite()) { Ok(numbers) } else { Err(fault()) }
}

fn pair(text: &str) -> Result<[u32; 2], String> {
    let fault = || "expected a column and a row, such as 320,200".to_owned();
    let (x, y) = text.split_once(',').ok_or_else(fault)?;
    let side = |digits: &str| digits.trim().parse().map_err(|_| fault());
    Ok([side(x)?, side(y)?])
}

fn conventions() -> impl clap::builder::TypedValueParser<Value = ApiConventions> {
    use clap::builder::{PossibleValuesParser, TypedValueParser as _};
    PossibleValuesParser::new(ApiConventions::ALL.map(ApiConventions::name))
        .try_map(|name| name.parse::<ApiConventions>())
}
