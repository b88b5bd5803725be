//! `alberti explain`: every intermediate value of the viewing pipeline for one primitive or pixel.
//!
//! The transforms are the ones the renderer uses for the chosen picture, so the last coordinates
//! are real pixel coordinates. `--conventions` shows the chain as another API would compute it,
//! with its handedness, depth range and pixel origin.

use super::load_options::LoadArgs;
use super::number_list::{parse_number_list, parse_numbers};
use super::render::thread_count;
use super::scene_overrides::SceneOverrideArgs;
use super::{CliError, print_json, print_text};
use explain::{
    ApiConventions, BareMap, Explanation, TransformChain, VertexRef, explain_homogeneous_point,
    explain_node, explain_pixel, explain_point, explain_segment, explain_transforms,
    explain_triangle, explain_vertex,
};
use files::visible_text;
use homog::{HPoint, Point, World};
use model::{Model, ModelInstance};
use pipeline::{Picture, Scene};
use scene::Inset;
use std::path::PathBuf;

/// The longer side of the picture embedded in an HTML page, in pixels.
///
/// A small picture is enough to show where the subject is, and keeps the page small.
const MAX_PAGE_SIDE: f64 = 960.0;

/// Arguments of `alberti explain`.
#[derive(Debug, clap::Args)]
pub(crate) struct ExplainArgs {
    /// Scene (.ron) or model (.gltf, .glb, .stl, .obj, .ply, .3mf); omit it with --matrix or
    /// --planes
    input: Option<PathBuf>,
    #[command(flatten)]
    subject: ExplainSubjectArgs,
    #[command(flatten)]
    map: BareMapArgs,
    /// API conventions for view space, the canonical volume and pixels
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

/// A single matrix instead of a scene.
#[derive(Debug, clap::Args)]
#[command(next_help_heading = "Without a scene")]
struct BareMapArgs {
    /// Map --point or --segment with this 4x4 matrix (row by row) instead of a scene's camera
    #[arg(
        long,
        value_name = "NUMBERS",
        value_parser = parse_matrix,
        allow_hyphen_values = true,
        conflicts_with_all = ["input", "planes", "node", "pixel", "html"]
    )]
    matrix: Option<Box<[f64; 16]>>,
    /// Map --point or --segment with the textbook's matrix P for the planes z = N and z = F
    ///
    /// Both numbers are z-coordinates, negative ahead of the camera, as in -1,-3.
    #[arg(
        long,
        value_name = "N,F",
        value_parser = parse_numbers::<2>,
        allow_hyphen_values = true,
        conflicts_with_all = ["input", "node", "pixel", "html"]
    )]
    planes: Option<[f64; 2]>,
}

/// The subject of the explanation; by default, the transforms of the pipeline themselves.
#[derive(Debug, clap::Args)]
#[command(next_help_heading = "Subject")]
struct ExplainSubjectArgs {
    /// Point in world space; add W for a homogeneous point, or W = 0 for a direction
    #[arg(
        long,
        value_name = "X,Y,Z[,W]",
        value_parser = parse_point,
        allow_hyphen_values = true,
        conflicts_with_all = ["segment", "node"]
    )]
    point: Option<SubjectPoint>,
    /// Pixel by column and row from the upper left, to show what is visible and explain the color
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
    /// Node of the model, by name or index, to explain why it is visible or not
    #[arg(long, value_name = "NAME|INDEX")]
    node: Option<String>,
    /// Vertex of the node's mesh, by index
    #[arg(long, value_name = "INDEX", requires = "node", conflicts_with = "triangle")]
    vertex: Option<usize>,
    /// Triangle of the node's mesh, by index
    #[arg(long, value_name = "INDEX", requires = "node")]
    triangle: Option<usize>,
    /// Primitive that contains the vertex or triangle, by index
    #[arg(long, value_name = "INDEX", requires = "node", default_value_t = 0)]
    primitive: usize,
    /// Model that contains the node, by index
    #[arg(long, value_name = "INDEX", requires = "node", default_value_t = 0)]
    model: usize,
}

/// Prints or writes the explanation of a subject.
///
/// The format is text, JSON or HTML. For HTML, the scene is rendered last.
///
/// # Errors
/// Returns an error if the input is invalid or lacks the subject, or writing the output fails.
pub(crate) fn run(args: &ExplainArgs) -> Result<(), CliError> {
    if let Some(map) = args.map.build_map()? {
        let explanation =
            map.explain_points(&args.subject.bare_points()).map_err(CliError::Usage)?;
        return write_explanation(args, &explanation, |explanation| Ok(explanation.to_string()));
    }
    let Some(input) = &args.input else {
        let message = "no scene or model to explain\n  = help: name one, or use --point or \
                       --segment with --planes N,F (the textbook's P) or --matrix NUMBERS";
        return Err(CliError::Usage(message.to_owned()));
    };
    let (_, file, scene) = args.overrides.open_scene(input, &args.load_options)?;
    let size = (scene.image.width, scene.image.height);
    let chain = TransformChain::new(&scene.view_projection, size, args.conventions)
        .map_err(pipeline::RenderError::from)?;
    let mut explanation = args.subject.explain_subject(&chain, &scene).map_err(CliError::Usage)?;
    if let (Some(_), [left, right]) = (file.stereo, &scene.insets[..]) {
        let eyes = [eye_chain(left, args.conventions)?, eye_chain(right, args.conventions)?];
        explanation = explanation.with_stereo_pair(&eyes, args.subject.stereo_point());
    }
    explanation.subject += &format!(" (conventions: {})", args.conventions.name());
    write_explanation(args, &explanation, |explanation| match args.html {
        true => Ok(explanation.to_html(&chain, Some(&render_page_picture(scene)?))),
        false => Ok(explanation.to_string()),
    })
}

/// Returns the transforms for one eye of a stereo pair, in that eye's picture.
fn eye_chain(eye: &Inset, conventions: ApiConventions) -> Result<TransformChain, CliError> {
    let size = (eye.rect.width, eye.rect.height);
    let chain = TransformChain::new(&eye.scene.view_projection, size, conventions);
    Ok(chain.map_err(pipeline::RenderError::from)?)
}

/// Writes an explanation as JSON or in `format`, to a file or the standard output.
fn write_explanation(
    args: &ExplainArgs,
    explanation: &Explanation,
    format: impl FnOnce(&Explanation) -> Result<String, CliError>,
) -> Result<(), CliError> {
    let text =
        if args.json { format!("{:#}\n", explanation.to_json()) } else { format(explanation)? };
    match &args.output {
        Some(path) => pipeline::write_file(path, text.as_bytes())?,
        None if args.json => print_json(&text)?,
        None => print_text(&text)?,
    }
    Ok(())
}

/// Renders the scene, scaled down to at most [`MAX_PAGE_SIDE`].
///
/// A smaller picture keeps its size. The aspect ratio is preserved to within a pixel.
fn render_page_picture(mut scene: Scene) -> Result<Picture, CliError> {
    let image = &mut scene.image;
    let most = f64::from(image.width.max(image.height));
    let shrunk_side =
        |side: u32| ((f64::from(side) * (MAX_PAGE_SIDE / most).min(1.0)) as u32).max(1);
    (image.width, image.height) = (shrunk_side(image.width), shrunk_side(image.height));
    Ok(pipeline::render(&scene, thread_count(None))?)
}

impl ExplainSubjectArgs {
    /// Explains the subject that the flags select.
    ///
    /// clap rejects combinations, so the first subject that is set is the only one.
    ///
    /// # Errors
    /// Returns an error if the scene has no such model, node, primitive, vertex, triangle or pixel.
    fn explain_subject(
        &self,
        chain: &TransformChain,
        scene: &Scene,
    ) -> Result<Explanation, String> {
        match self.point {
            Some(SubjectPoint::Cartesian(point)) => return Ok(explain_point(chain, point.into())),
            Some(SubjectPoint::Homogeneous(point)) => {
                return explain_homogeneous_point(chain, point.into());
            }
            None => {}
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
            format!("there is no model {}: the scene has {count}, numbered from 0", self.model)
        })?;
        self.explain_part(chain, placed, find_node(&placed.model, node)?)
    }

    /// Returns the points for a map without a scene: one point, a segment's endpoints, or none.
    fn bare_points<S: homog::Space>(&self) -> Vec<HPoint<S>> {
        let point = self.point.map(SubjectPoint::numbers).into_iter();
        let ends = self
            .segment
            .iter()
            .flat_map(|[ax, ay, az, bx, by, bz]| [[*ax, *ay, *az, 1.0], [*bx, *by, *bz, 1.0]]);
        point.chain(ends).map(HPoint::from).collect()
    }

    /// Returns the point that both eyes of a stereo pair see, or `None` for other subjects.
    fn stereo_point(&self) -> Option<Point<World>> {
        HPoint::<World>::from(self.point?.numbers()).divide()
    }

    /// Explains a vertex, a triangle, or the visibility of a node.
    ///
    /// # Errors
    /// Returns an error if the node has no mesh, or the mesh has no such primitive, vertex or
    /// triangle.
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

/// Finds the index of a node from an index or a name; an index is tried first.
///
/// A node whose name is a number is found by name only if no node has that index.
///
/// # Errors
/// Returns an error if there is no such node; the message lists up to twelve names.
fn find_node(model: &Model, node: &str) -> Result<usize, String> {
    let named = || model.nodes.iter().position(|known| known.name.as_deref() == Some(node));
    let numbered = node.parse().ok().filter(|&number: &usize| number < model.nodes.len());
    numbered.or_else(named).ok_or_else(|| {
        let names: Vec<&str> =
            model.nodes.iter().filter_map(|node| node.name.as_deref()).take(12).collect();
        let count = model.nodes.len();
        format!(
            "there is no node `{node}`; nodes of the model ({count}): {}",
            visible_text(&names.join(", "))
        )
    })
}

/// A point from the command line: three coordinates, or four homogeneous coordinates.
#[derive(Clone, Copy, Debug)]
pub(super) enum SubjectPoint {
    /// x, y, z.
    Cartesian([f64; 3]),
    /// x, y, z, w.
    Homogeneous([f64; 4]),
}

impl SubjectPoint {
    /// Returns the four homogeneous coordinates.
    pub(super) fn numbers(self) -> [f64; 4] {
        match self {
            Self::Cartesian([x, y, z]) => [x, y, z, 1.0],
            Self::Homogeneous(numbers) => numbers,
        }
    }
}

impl BareMapArgs {
    /// Returns the map that the flags define, or `None` without such flags.
    ///
    /// # Errors
    /// Returns an error if the planes do not define a matrix P.
    fn build_map(&self) -> Result<Option<BareMap>, CliError> {
        if let Some(entries) = &self.matrix {
            let [a, b, c, d] = [0, 4, 8, 12].map(|at| std::array::from_fn(|j| entries[at + j]));
            return Ok(Some(BareMap::from_rows([a, b, c, d])));
        }
        let Some([near, far]) = self.planes else { return Ok(None) };
        let map = BareMap::from_planes(near, far);
        map.map(Some).map_err(|error| CliError::Usage(format!("--planes {near},{far}: {error}")))
    }
}

/// Parses sixteen numbers, boxed to keep the command's argument struct small.
fn parse_matrix(text: &str) -> Result<Box<[f64; 16]>, String> {
    let one_word =
        |problem| format!("{problem}; join numbers with commas, or quote them: \"1 0 0 0  0 1 …\"");
    parse_numbers(text).map(Box::new).map_err(one_word)
}

/// Parses a point of three or four numbers.
///
/// # Errors
/// Returns an error if the count is wrong, a number is not finite, or all four are 0.
pub(super) fn parse_point(text: &str) -> Result<SubjectPoint, String> {
    let numbers = parse_number_list(text)?;
    match numbers[..] {
        [x, y, z] => Ok(SubjectPoint::Cartesian([x, y, z])),
        [0.0, 0.0, 0.0, 0.0] => {
            Err("0,0,0,0 is not a point; use w = 1 for a point, w = 0 for a direction".to_owned())
        }
        [x, y, z, w] => Ok(SubjectPoint::Homogeneous([x, y, z, w])),
        _ => Err(format!("expected 3 or 4 numbers separated by commas, found {}", numbers.len())),
    }
}

/// Parses a column and a row.
///
/// Whether the pixel is inside the picture is checked once the scene is known.
fn parse_pixel(text: &str) -> Result<[u32; 2], String> {
    let fault = || "expected a column and a row, such as 320,200".to_owned();
    let (x, y) = text.split_once(',').ok_or_else(fault)?;
    let side = |digits: &str| digits.trim().parse().map_err(|_| fault());
    Ok([side(x)?, side(y)?])
}

/// Returns a parser for convention names, with their summaries as help.
pub(super) fn conventions_parser() -> impl clap::builder::TypedValueParser<Value = ApiConventions> {
    use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser as _};
    let value = |known: ApiConventions| PossibleValue::new(known.name()).help(known.summary());
    PossibleValuesParser::new(ApiConventions::ALL.map(value))
        .try_map(|name| name.parse::<ApiConventions>())
}
