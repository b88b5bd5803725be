//! `alberti explain`: every intermediate value of the viewing pipeline for one primitive or pixel.
//!
//! The chain of transforms is that of the renderer for the chosen picture, so the last coordinates
//! are those of real pixels. `--conventions` shows the chain as another API would compute it, with
//! its handedness, depth range and origin of pixels.

use super::CliError;
use super::load_options::LoadArgs;
use super::render::thread_count;
use super::scene_overrides::SceneOverrideArgs;
use homog::{Point, World};
use model::Model;
use model::ModelInstance;
use pipeline::explain::{
    ApiConventions, Explanation, TransformChain, VertexRef, explain_node, explain_pixel,
    explain_point, explain_segment, explain_transforms, explain_triangle, explain_vertex,
};
use pipeline::{Picture, Scene};
use std::io::Write as _;
use std::path::PathBuf;

/// The longer side of the picture embedded in an HTML page, in pixels.
///
/// The picture only shows where the subject is, and it is embedded in base64.
const MAX_PAGE_SIDE: f64 = 960.0;

/// Arguments of `alberti explain`.
#[derive(Debug, clap::Args)]
pub(crate) struct ExplainArgs {
    /// Scene (.ron) or model (.gltf, .glb)
    input: PathBuf,
    #[command(flatten)]
    subject: ExplainSubjectArgs,
    /// API conventions of view space, canonical volume and pixels
    #[arg(long, value_name = "NAME", default_value = "alberti", value_parser = conventions_parser())]
    conventions: ApiConventions,
    /// Print the explanation as JSON
    #[arg(long)]
    json: bool,
    /// Print the explanation as a self-contained HTML page with figures
    #[arg(long, conflicts_with = "json")]
    html: bool,
    /// Output file [default: the standard output]
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    #[command(flatten)]
    overrides: SceneOverrideArgs,
    #[command(flatten)]
    load_options: LoadArgs,
}

/// The subject of the explanation; without any, the transforms of the pipeline themselves.
#[derive(Debug, clap::Args)]
#[command(next_help_heading = "Subject")]
struct ExplainSubjectArgs {
    /// Point in world space
    #[arg(
        long,
        value_name = "X,Y,Z",
        value_parser = parse_numbers::<3>,
        allow_hyphen_values = true,
        conflicts_with_all = ["segment", "node"]
    )]
    point: Option<[f64; 3]>,
    /// Pixel by column and row from the upper left: what is visible, and why it has its color
    #[arg(
        long,
        value_name = "X,Y",
        value_parser = parse_pixel,
        conflicts_with_all = ["point", "segment", "node"]
    )]
    pixel: Option<[u32; 2]>,
    /// Segment in world space, as its two endpoints
    #[arg(
        long,
        value_name = "X,Y,Z,X,Y,Z",
        value_parser = parse_numbers::<6>,
        allow_hyphen_values = true,
        conflicts_with = "node"
    )]
    segment: Option<[f64; 6]>,
    /// Node of the model, by name or index: why it is visible or not
    #[arg(long, value_name = "NAME|INDEX")]
    node: Option<String>,
    /// Vertex of the node's mesh, by index
    #[arg(long, value_name = "INDEX", requires = "node", conflicts_with = "triangle")]
    vertex: Option<usize>,
    /// Triangle of the node's mesh, by index
    #[arg(long, value_name = "INDEX", requires = "node")]
    triangle: Option<usize>,
    /// Primitive of the mesh that has the vertex or triangle
    #[arg(long, value_name = "INDEX", requires = "node", default_value_t = 0)]
    primitive: usize,
    /// Model of the scene that has the node
    #[arg(long, value_name = "INDEX", requires = "node", default_value_t = 0)]
    model: usize,
}

/// Prints or writes the explanation of a subject.
///
/// The format is text, JSON or HTML; only HTML renders the scene, and only after the explanation
/// has succeeded.
///
/// # Errors
/// If the input is invalid or has no such subject, or the output cannot be written.
pub(crate) fn run(args: &ExplainArgs) -> Result<(), CliError> {
    let (_, _, scene) = args.overrides.open_scene(&args.input, &args.load_options)?;
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

/// Renders the scene, scaled down to at most [`MAX_PAGE_SIDE`].
///
/// A picture that is smaller already keeps its size. The aspect ratio is preserved to a pixel.
fn render_page_picture(mut scene: Scene) -> Result<Picture, CliError> {
    let image = &mut scene.image;
    let most = f64::from(image.width.max(image.height));
    let shrunk_side =
        |side: u32| ((f64::from(side) * (MAX_PAGE_SIDE / most).min(1.0)) as u32).max(1);
    (image.width, image.height) = (shrunk_side(image.width), shrunk_side(image.height));
    Ok(pipeline::render(&scene, thread_count(None))?)
}

impl ExplainSubjectArgs {
    /// Explains the subject that the flags name.
    ///
    /// clap has rejected combinations, so the first subject that is set is the only one.
    ///
    /// # Errors
    /// If the scene has no such model, node, primitive, vertex, triangle or pixel.
    fn explain_subject(
        &self,
        chain: &TransformChain,
        scene: &Scene,
    ) -> Result<Explanation, String> {
        if let Some(point) = self.point {
            return Ok(explain_point(chain, point.into()));
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

    /// Explains a vertex, a triangle, or the visibility of a node.
    ///
    /// # Errors
    /// If the node has no mesh, or it has no such primitive, vertex or triangle.
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

/// The index of a node, from its index or its name; an index is tried first.
///
/// A node whose name is a number is found by name only if there is no node of that index.
///
/// # Errors
/// If there is no such node; the message lists up to twelve names.
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

/// Parses `N` finite numbers separated by commas.
///
/// # Errors
/// If there are more or fewer numbers, or one is not finite.
fn parse_numbers<const N: usize>(text: &str) -> Result<[f64; N], String> {
    let fault = || format!("expected {N} numbers separated by commas");
    let numbers: Vec<f64> = text
        .split(',')
        .map(|word| word.trim().parse().map_err(|_| fault()))
        .collect::<Result<_, _>>()?;
    let numbers: [f64; N] = numbers.try_into().map_err(|_| fault())?;
    if numbers.iter().all(|number| number.is_finite()) { Ok(numbers) } else { Err(fault()) }
}

/// Parses a column and a row.
///
/// Whether the pixel is inside the picture is checked when the scene is known.
fn parse_pixel(text: &str) -> Result<[u32; 2], String> {
    let fault = || "expected a column and a row, such as 320,200".to_owned();
    let (x, y) = text.split_once(',').ok_or_else(fault)?;
    let side = |digits: &str| digits.trim().parse().map_err(|_| fault());
    Ok([side(x)?, side(y)?])
}

/// Parses conventions by the name that the `pipeline` crate has for them.
pub(super) fn conventions_parser() -> impl clap::builder::TypedValueParser<Value = ApiConventions> {
    use clap::builder::{PossibleValuesParser, TypedValueParser as _};
    PossibleValuesParser::new(ApiConventions::ALL.map(ApiConventions::name))
        .try_map(|name| name.parse::<ApiConventions>())
}
