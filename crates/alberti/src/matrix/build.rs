//! Flags that build a matrix from parameters, and products of such matrices.
//!
//! ```text
//!  --viewport 4,3 --ortho … --p -1,-3     =     M_vp M_orth P: the rightmost is applied first
//! ```

use super::super::CliError;
use super::builders::*;
use clap::{Arg, ArgAction, ArgGroup, ArgMatches, Command};
use explain::ApiConventions;
use glam::DMat4;
use projection::Convention;
use recognition::parse_number;

/// The text on near and far for all flags except `--p`, in the help and in messages.
pub(super) const DISTANCES: &str = "near and far are distances ahead of the eye, with 0 < near < \
    far. --ortho and --oblique also accept near = 0 and, except with the conventions alberti and \
    chapter, a near plane behind the eye, as in glOrtho's -1,1. For the textbook's coordinates \
    0 > n > f, use near = -n and far = -f";

/// Options that change the matrices of some flags.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Modifier {
    Conventions,
    Reversed,
    OntoPlane,
}

use Modifier::{Conventions, OntoPlane, Reversed};

/// A flag that builds a matrix.
struct BuilderFlag {
    name: &'static str,
    value: &'static str,
    help: &'static str,
    /// The modifiers that affect the matrix.
    uses: &'static [Modifier],
    build: fn(&NumberList, BuildOptions) -> Built,
}

const fn flag(
    name: &'static str,
    value: &'static str,
    uses: &'static [Modifier],
    build: fn(&NumberList, BuildOptions) -> Built,
    help: &'static str,
) -> BuilderFlag {
    BuilderFlag { name, value, help, uses, build }
}

/// All builder flags, in help order.
const FLAGS: [BuilderFlag; 16] = [
    flag(
        "perspective",
        "FOVY,ASPECT,NEAR,FAR",
        &[Conventions, Reversed],
        build_perspective,
        "Perspective projection with this vertical field of view in degrees; FAR may be `inf`",
    ),
    flag(
        "frustum",
        "L,R,B,T,NEAR,FAR",
        &[Conventions, Reversed],
        build_frustum,
        "Perspective projection with this window at NEAR, like glFrustum; FAR may be `inf`",
    ),
    flag(
        "moved-apex",
        "L,R,B,T,NEAR,FAR",
        &[Conventions, Reversed],
        build_moved_apex,
        "Perspective projection of the WebGL lesson: the apex moves behind the window's center",
    ),
    flag(
        "intrinsics",
        "FX,FY,CX,CY,WIDTH,HEIGHT,NEAR,FAR",
        &[Conventions, Reversed],
        build_intrinsics,
        "Perspective projection of a calibrated camera with the matrix K, for pictures of WIDTH x \
         HEIGHT pixels; pixel centers have integer coordinates, as in OpenCV",
    ),
    flag(
        "ortho",
        "L,R,B,T,NEAR,FAR",
        &[Conventions, Reversed],
        build_ortho,
        "Orthographic projection of this box, like glOrtho",
    ),
    flag("p", "N,F", &[], build_p, "The textbook's P with signed n and f, such as -1,-10"),
    flag(
        "oblique",
        "LENGTH,ANGLE[,L,R,B,T,NEAR,FAR]",
        &[Conventions, Reversed, OntoPlane],
        build_oblique,
        "Oblique projection that draws a unit of depth with this length and angle in degrees; six \
         more numbers define the view volume",
    ),
    flag(
        "axonometric",
        "ALPHA,BETA",
        &[OntoPlane],
        build_axonometric,
        "Axonometric projection with angles in degrees about y and x; 45,35.26439 is isometric",
    ),
    flag(
        "n-point",
        "P,Q,R",
        &[OntoPlane],
        build_n_point,
        "One-, two- or three-point perspective with the bottom row (p, q, r, 1)",
    ),
    flag(
        "look-at",
        "EYE,TARGET[,UP]",
        &[Conventions],
        build_look_at,
        "Camera at EYE that looks at TARGET, with the up direction UP (by default y); \
         --conventions direct3d makes the world left-handed (XMMatrixLookAtLH)",
    ),
    flag(
        "look-to",
        "EYE,DIRECTION[,UP]",
        &[Conventions],
        build_look_to,
        "Camera at EYE that looks along DIRECTION (the gaze), with the up direction UP \
         (by default y)",
    ),
    flag(
        "viewport",
        "[X,Y,]WIDTH,HEIGHT",
        &[Conventions],
        build_viewport,
        "Viewport of an image, or of a rectangle in an image",
    ),
    flag(
        "window-to-viewport",
        "L,R,B,T,L,R,B,T",
        &[],
        build_window_to_viewport,
        "Window to viewport: left, right, bottom and top of each",
    ),
    flag("translate", "X,Y,Z", &[], build_translation, "Translation"),
    flag("scale", "X,Y,Z", &[], build_scale, "Scale"),
    flag(
        "rotate",
        "X,Y,Z,DEGREES",
        &[],
        build_rotation,
        "Rotation about an axis through the origin",
    ),
];

/// The flags on the command line with their numbers, in the order written.
#[derive(Clone, Debug, Default)]
pub(super) struct BuildArgs {
    /// Each flag's index in [`FLAGS`], and its numbers.
    calls: Vec<(usize, NumberList)>,
}

impl clap::FromArgMatches for BuildArgs {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, clap::Error> {
        let mut placed = Vec::new();
        for (at, flag) in FLAGS.iter().enumerate() {
            let places = matches.indices_of(flag.name).into_iter().flatten();
            let lists = matches.get_many::<NumberList>(flag.name).into_iter().flatten();
            placed.extend(places.zip(lists).map(|(place, list)| (place, at, list.clone())));
        }
        placed.sort_by_key(|(place, ..)| *place);
        Ok(Self { calls: placed.into_iter().map(|(_, at, list)| (at, list)).collect() })
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), clap::Error> {
        *self = Self::from_arg_matches(matches)?;
        Ok(())
    }
}

impl clap::Args for BuildArgs {
    fn augment_args(command: Command) -> Command {
        let heading = "Matrix from parameters (several matrices are multiplied; the rightmost is \
                       applied first)";
        let arg = |flag: &BuilderFlag| {
            Arg::new(flag.name)
                .long(flag.name)
                .value_name(flag.value)
                .help(flag.help)
                .help_heading(heading)
                .value_parser(parse_list)
                .allow_hyphen_values(true)
                .action(ArgAction::Append)
        };
        let group = ArgGroup::new("BuildArgs").multiple(true).args(FLAGS.iter().map(|f| f.name));
        command.args(FLAGS.iter().map(arg)).group(group)
    }

    fn augment_args_for_update(command: Command) -> Command {
        Self::augment_args(command)
    }
}

/// Numbers separated by commas; their count depends on the flag.
#[derive(Clone, Debug)]
pub(super) struct NumberList(pub(super) Vec<f64>);

fn parse_list(text: &str) -> Result<NumberList, recognition::MatrixTextError> {
    text.split(',').map(|word| parse_number(word.trim())).collect::<Result<_, _>>().map(NumberList)
}

impl NumberList {
    pub(super) fn exactly<const N: usize>(&self, flag: &str) -> Result<[f64; N], CliError> {
        let found = self.0.len();
        <[f64; N]>::try_from(self.0.as_slice())
            .map_err(|_| wrong_count(&format!("--{flag}"), &N.to_string(), found))
    }
}

/// Returns the message for a list with too many or too few numbers.
pub(super) fn wrong_count(flag: &str, expected: &str, found: usize) -> CliError {
    CliError::Usage(format!(
        "{flag} expects {expected} numbers, found {found}; join them with commas, without spaces"
    ))
}

/// The modifiers on the command line.
#[derive(Clone, Copy, Debug)]
pub(super) struct BuildOptions {
    /// `None` for the default, OpenGL.
    pub(super) given_conventions: Option<ApiConventions>,
    pub(super) reversed: bool,
    pub(super) onto_plane: bool,
}

impl BuildOptions {
    pub(super) fn conventions(self) -> ApiConventions {
        self.given_conventions.unwrap_or(ApiConventions::OpenGl)
    }

    pub(super) fn volume(self) -> Convention {
        let volume = self.conventions().canonical_volume();
        if self.reversed { volume.reversed() } else { volume }
    }

    fn given(self) -> impl Iterator<Item = (Modifier, &'static str)> {
        [
            (Conventions, "--conventions", self.given_conventions.is_some()),
            (Reversed, "--reversed", self.reversed),
            (OntoPlane, "--onto-plane", self.onto_plane),
        ]
        .into_iter()
        .filter_map(|(modifier, name, given)| given.then_some((modifier, name)))
    }

    /// Rejects modifiers if no flag builds a matrix.
    pub(super) fn check_unused(self) -> Result<(), CliError> {
        self.given().next().map_or(Ok(()), |(_, name)| {
            let message = format!(
                "{name} applies only to matrices from parameters: --perspective, --ortho, …"
            );
            Err(CliError::Usage(message))
        })
    }

    /// Rejects the modifiers of view volumes for a matrix without a view volume.
    pub(super) fn refuse_volume(self, what: &str) -> Result<(), CliError> {
        let refused = self.given().find(|(modifier, _)| *modifier != OntoPlane);
        refused.map_or(Ok(()), |(_, name)| {
            Err(CliError::Usage(format!("{name} has no effect on {what}; omit it")))
        })
    }

    /// Rejects a modifier that affects none of the flags.
    fn check(self, calls: &[(usize, NumberList)]) -> Result<(), CliError> {
        for (modifier, name) in self.given() {
            let obeys = |flag: &BuilderFlag| flag.uses.contains(&modifier);
            if calls.iter().any(|(at, _)| obeys(&FLAGS[*at])) {
                continue;
            }
            let names = |flags: Vec<&BuilderFlag>| {
                flags.iter().map(|flag| format!("--{}", flag.name)).collect::<Vec<_>>().join(", ")
            };
            let asked = names(calls.iter().map(|(at, _)| &FLAGS[*at]).collect());
            let users = names(FLAGS.iter().filter(|flag| obeys(flag)).collect());
            let message = format!("{name} has no effect on {asked}; it applies to {users}");
            return Err(CliError::Usage(message));
        }
        Ok(())
    }
}

/// A matrix with its factors.
#[derive(Debug)]
pub(super) struct BuiltMatrix {
    /// The name of the matrix, with its parameters.
    pub(super) subject: String,
    /// The ids of the matrix's formulas.
    pub(super) formula: Option<&'static str>,
    pub(super) matrix: DMat4,
    /// A remark on the matrix.
    pub(super) note: Option<&'static str>,
    /// The names and matrices of the factors, in order of application.
    pub(super) factors: Vec<(&'static str, DMat4)>,
    /// The ids of the factors' formulas.
    pub(super) factor_formula: Option<&'static str>,
    /// The matrices of a product, in order of application; empty for a single matrix.
    pub(super) product_of: Vec<(String, DMat4)>,
}

impl BuiltMatrix {
    pub(super) fn new(subject: String, matrix: DMat4) -> Self {
        Self {
            subject,
            formula: None,
            matrix,
            note: None,
            factors: Vec::new(),
            factor_formula: None,
            product_of: Vec::new(),
        }
    }
}

pub(super) type Built = Result<BuiltMatrix, CliError>;

impl BuildArgs {
    /// Builds the matrix that the flags describe, or the product if there are several flags;
    /// returns `None` without flags.
    ///
    /// # Errors
    /// Returns an error if the number of parameters is wrong, if the builder rejects one, or if a
    /// modifier is unused.
    pub(super) fn build(&self, options: BuildOptions) -> Option<Built> {
        (!self.calls.is_empty()).then(|| self.build_product(options))
    }

    /// Rejects numbers next to a flag that builds a matrix; the cause is a space in a list, or a
    /// second matrix.
    pub(super) fn check_alone(&self, numbers: &[String]) -> Result<(), CliError> {
        let (Some((at, list)), false) = (self.calls.last(), numbers.is_empty()) else {
            return Ok(());
        };
        let flag = &FLAGS[*at];
        let rest = numbers.join(" ");
        let parts = numbers.iter().flat_map(|word| word.split([',', ' ']));
        let count = list.0.len() + parts.filter(|word| !word.is_empty()).count();
        let written = Self::as_written(*at, list);
        let joined = numbers.join(",");
        Err(CliError::Usage(format!(
            "unexpected `{rest}` after `{written}`: --{} takes one list of numbers joined by \
             commas, without spaces\n  = help: for one list of {count} numbers, write \
             `{written},{joined}`; give either a matrix of numbers or one from parameters, not both",
            flag.name
        )))
    }

    /// Formats a flag and its numbers as on a command line.
    fn as_written(at: usize, list: &NumberList) -> String {
        let numbers: Vec<String> = list.0.iter().map(f64::to_string).collect();
        format!("--{} {}", FLAGS[at].name, numbers.join(","))
    }

    fn build_product(&self, options: BuildOptions) -> Built {
        options.check(&self.calls)?;
        let single = self.calls.len() == 1;
        let build = |(at, list): &(usize, NumberList)| {
            let flag = &FLAGS[*at];
            // Each flag of a product gets only the modifiers that affect it.
            let has = |modifier: Modifier| single || flag.uses.contains(&modifier);
            let own = BuildOptions {
                given_conventions: options.given_conventions.filter(|_| has(Conventions)),
                reversed: options.reversed && has(Reversed),
                onto_plane: options.onto_plane && has(OntoPlane),
            };
            (flag.build)(list, own)
        };
        let factors = self.calls.iter().map(build).collect::<Result<Vec<_>, CliError>>()?;
        let depends = |(at, list): &(usize, NumberList)| {
            // --oblique without a volume is the same in all conventions.
            let whole = FLAGS[*at].name != "oblique" || list.0.len() > 2;
            whole && FLAGS[*at].uses.contains(&Conventions)
        };
        let conventions = match self.calls.iter().any(depends) {
            true => format!(" (conventions: {})", options.conventions().name()),
            false => String::new(),
        };
        let factors = match <[BuiltMatrix; 1]>::try_from(factors) {
            Ok([built]) => {
                let subject = built.subject + &conventions;
                return Ok(BuiltMatrix { subject, ..built });
            }
            Err(factors) => factors,
        };
        let matrix = factors.iter().fold(DMat4::IDENTITY, |product, next| product * next.matrix);
        let names: Vec<String> =
            self.calls.iter().map(|(at, _)| format!("--{}", FLAGS[*at].name)).collect();
        let product = names.join(" · ");
        let subject = format!("The product {product}, the rightmost applied first{conventions}");
        let named = self.calls.iter().zip(&factors).rev();
        let product_of =
            named.map(|((at, list), built)| (Self::as_written(*at, list), built.matrix));
        Ok(BuiltMatrix { product_of: product_of.collect(), ..BuiltMatrix::new(subject, matrix) })
    }
}
