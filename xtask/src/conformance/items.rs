//! The list of topics to test: the items that the sources teach (C), the misprints found in them
//! (M), and the exercises of the textbook's chapter, each with the crates responsible for it.

use std::sync::LazyLock;

/// An item that tests prove.
pub struct Item {
    /// `C4`, `M11b` or `exercise 3`.
    pub id: String,
    /// The crates responsible for it. Each must have a test for it.
    pub owners: Vec<&'static str>,
    /// The topic in a few words.
    pub title: &'static str,
}

impl Item {
    fn new(id: &str, owners: &'static str, title: &'static str) -> Self {
        Self { id: id.to_owned(), owners: owners.split_whitespace().collect(), title }
    }

    /// The owners that must have their tests by now: the math crates are complete.
    pub fn complete_owners(&self) -> impl Iterator<Item = &'static str> {
        self.owners.iter().copied().filter(|owner| crate::tidy::NO_STD.contains(owner))
    }
}

/// Topics, exercises and misprints of the sources. A test of a misprint shows that the printed form
/// fails.
pub static ITEMS: LazyLock<Vec<Item>> = LazyLock::new(|| parse_rows(ITEM_ROWS));
/// The misprints of the sources.
pub static MISPRINTS: LazyLock<Vec<Item>> = LazyLock::new(|| parse_rows(MISPRINT_ROWS));

/// The exercises: each asks for an item, and any proof of the exercise proves the item.
pub static EXERCISES: LazyLock<Vec<Item>> = LazyLock::new(|| {
    let asked = |id: &str| ITEMS.iter().find(|item| item.id == id);
    let exercise = |(i, id): (usize, &&str)| {
        let item = asked(id)?;
        let owners = item.owners[..1].to_vec();
        Some(Item { id: format!("exercise {}", i + 1), owners, title: item.title })
    };
    EXERCISE_ITEMS.iter().enumerate().filter_map(exercise).collect()
});

/// The items that exercises 1 to 11 ask for.
const EXERCISE_ITEMS: [&str; 11] =
    ["C38", "C39", "C40", "C41", "C42", "C43", "C44", "C45", "C45", "C46", "C47"];

/// The item that an exercise asks for.
pub fn exercise_item(exercise: &str) -> Option<&'static str> {
    let number: usize = exercise.strip_prefix("exercise ")?.parse().ok()?;
    EXERCISE_ITEMS.get(number.checked_sub(1)?).copied()
}

/// Every item, exercise and misprint.
pub fn all_items() -> impl Iterator<Item = &'static Item> {
    ITEMS.iter().chain(EXERCISES.iter()).chain(MISPRINTS.iter())
}

fn parse_rows(table: &'static str) -> Vec<Item> {
    let row = |line: &'static str| {
        let mut cells = line.splitn(3, '|').map(str::trim);
        Some(Item::new(cells.next()?, cells.next()?, cells.next()?))
    };
    table.lines().filter_map(row).collect()
}

const ITEM_ROWS: &str = "\
C1    | viewport pipeline   | Forward map and ray of a pixel from one camera undo each other
C2    | raster pipeline     | Wireframe pictures: near lines do not hide far ones
C3    | homog pipeline      | World, camera, canonical and screen space; the chain is the product of its factors
C4    | projection clip     | The canonical volume [−1, 1]³, looked at along −z
C5    | viewport            | Pixel centers at integers, the image from −½ to n − ½
C6    | viewport            | The viewport matrix keeps z
C7    | projection clip     | The orthographic box and its six named planes
C8    | projection          | M_orth and its inverse
C9    | pipeline            | Viewport times M_orth gives pixels and canonical depth
C10   | pipeline            | The line-drawing loop for a box
C11   | camera              | The camera's basis u, v, w from gaze and view-up
C12   | camera              | M_cam as rotation times translation
C13   | pipeline            | The line-drawing loop with a camera
C14   | projection pipeline | Size goes with the reciprocal of the distance
C15   | homog               | Linear, affine and projective matrices, and how to classify them
C16   | homog               | The worked 2-D map of the unit square
C17   | homog               | Multiples of a matrix, or of a point, are the same
C18   | homog               | Homogeneous points of the line
C19   | homog               | Homogeneous points of the plane
C20   | homog               | The divide can wait; w may be 0 until then
C21   | homog               | Perspective from the plane to a line
C22   | projection          | The matrix P keeps the depths of near and far plane
C23   | projection pipeline | P scales x and y down and keeps lines; lines through the eye become parallel
C24   | projection          | The image of a point under P: no flip, order kept
C25   | projection          | The inverse of P, exact and up to a factor
C26   | viewport projection | From a screen position back into space
C27   | projection          | M_per is M_orth after P
C28   | projection pipeline | The whole chain, with the divide at its end
C29   | projection          | M_per written out, and OpenGL's matrix derived from it
C30   | projection          | Conventions of the graphics interfaces; any converts to any other
C31   | homog clip raster   | Segments stay segments; f(t) gives the image of their points
C32   | homog               | Planes and triangles stay planes and triangles
C33   | projection          | Symmetric windows from an angle of view
C34   | projection          | Orthographic projection measures true lengths
C35   | pipeline            | Spheres off the axis are drawn as ellipses
C36   | clip pipeline       | Segments across the plane of the eye wrap around unless clipped first
C37   | homog               | Translations work on homogeneous points before the divide
C38   | viewport            | The viewport for pixels counted from the top
C39   | viewport projection | Viewport times M_orth is a single windowing
C40   | projection          | The third row of P follows from the two planes it keeps
C41   | projection          | P keeps the order of depths
C42   | homog               | Affine maps treat all multiples of a point alike
C43   | projection          | The inverse of P, verified
C44   | projection          | M_per takes the near corner to (1, 1, 1)
C45   | projection          | P for n = 1 and f = 2, and the image of a point
C46   | camera              | A camera above that looks straight down
C47   | homog clip          | f(t) keeps the order of points on a segment
C48   | projection          | The midpoint between near and far moves away from the eye
C49   | projection          | The angle of view goes from the middle of the bottom edge to that of the top edge
C50   | homog               | Frames: points have an origin and vectors have none
C51   | homog               | Between ordinary and homogeneous coordinates, both ways
C52   | homog               | Translation moves points only; rotation and scale move both
C53   | homog viewport      | Linear remapping, also beyond the range
C54   | clip pipeline       | Projecting takes two steps, and clipping comes between them
C55   | projection          | The image of a point on the near plane by similar triangles
C56   | projection          | The depth row is solved from two given values
C57   | projection pipeline | The derivation of the frustum matrix reaches it step by step
C58   | homog               | Perspective is linear on 4-vectors and not affine on points
C59   | viewport pipeline   | The viewport undoes the stretch of the canonical square
C60   | projection          | Perspective by angle as OpenGL and Direct3D build it, by height or by width
C61   | projection          | Angle, aspect, near and far are checked
C62   | pipeline            | Sheets that show the effect of angle, aspect and planes
C63   | projection          | The lesson's frustum with moved apex beside the true one
C64   | pipeline            | Sheets that show the effect of a frustum's borders, its apex drawn
C65   | camera projection   | Stereo: two off-axis frusta
C66   | projection pipeline | The lesson's frustum in its five steps
C67   | projection          | The lesson's depth constants c1 and c2
C68   | projection          | The lesson's table of depths, and where depth is 0
C69   | projection          | Perspective to frustum and back, where possible
C70   | pipeline            | Image and window have the same aspect
C71   | homog               | A change of coordinates is a matrix
C72   | projection          | Center, projectors and plane; parallel projection as a limit
C73   | projection pipeline | The tree of planar geometric projections
C74   | projection          | Parallel lines stay parallel in parallel projections
C75   | projection viewport | Front, top and side views on one sheet
C76   | projection          | Axonometric projection by normal, by angles, by ratios
C77   | projection          | Oblique projection: cavalier, cabinet, any angle
C78   | projection          | The oblique matrix by length and angle of the slant
C79   | projection          | The oblique matrix by direction, and that both are the same
C80   | pipeline            | Foreshortening and vanishing points, drawn in a picture
C81   | homog projection    | Parallels meet in the image of their point at infinity
C82   | projection          | One-point perspective from an eye in front of the plane z = 0
C83   | homog projection    | p, q, r count the principal vanishing points
C84   | pipeline            | A computer's projection: view coordinates, a view volume, depth retained
C85   | projection clip     | View plane, window, space and volume, their corners and planes
C86   | projection          | A slanted prism is normalised by a shear and a box
C87   | projection clip     | A slanted frustum is normalised by a shear and a scale; clipping may come there
C88   | projection pipeline | The frustum becomes a box and order is kept
C89   | projection clip     | One clipper serves parallel and perspective projection
C90   | projection          | Ortho as translation and scale, equal borders refused
C91   | projection          | glFrustum, symmetric or off-axis, to [−1, 1]³
C92   | projection          | The symmetric perspective matrix
C93   | projection          | Parity with the builders of a well-known library, in radians
C94   | pipeline            | Sheets for ortho and perspective
C95   | viewport            | Window to viewport by equal ratios
C96   | viewport            | Window to viewport by translation, scale, translation
C97   | viewport            | From the screen to normalised coordinates
C98   | viewport pipeline   | Indices of a grid to [−1, 1]², for height fields
C99   | viewport            | Viewports with position and size, several on one image
C100  | projection viewport | Handedness, the flip of z, and depth on the screen
C101  | homog pipeline      | Column vectors, the model matrix first; row vectors want the transpose
C102  | homog projection    | A classical projection is singular and a computer's is not
C103  | pipeline            | The stages of the pipeline, one by one
C104  | documents           | Exercises of this project
";

const MISPRINT_ROWS: &str = "\
M1    | homog               | The point's own y is missing: d/z for (d/z)·y
M2    | homog               | x ~ α for x ~ αx with α ≠ 0
M3    | projection          | P keeps points of “n = f”: it keeps z = f as a plane, not its points
M4    | projection          | P left out of the chain for perspective
M5    | projection          | f_n for the product f·n in the image's depth
M6    | homog               | t_y for t_z in the third row of a translation
M7    | projection          | [0, 1] for the volume [0, 1]³
M8    | projection          | OpenGL has the same volume but the opposite direction of z
M9    | projection          | n = 1, f = 2 against the chapter's 0 > n > f
M10   | documents           | Numbers of equations and figures from several editions
M11   | camera              | A translation without its 1 in the third row
M11b  | projection camera   | = for ~ in what P does; a camera “from” −z for one that looks along it
M12   | projection          | An off-center window in the fourth column: another projection
M13   | projection          | _mid_y for −mid_y
M14   | projection          | A 1 at the end of the bottom row of a perspective
M14b  | projection          | The window's lower left corner is (−1, −1)
M14c  | projection          | Nothing returned for an off-center window, where an error is expected
M15   | projection          | The sign of the depth offset in Ortho
M15b  | projection          | A parenthesis in Ortho's translation along z
M16   | projection          | right − left for right + left in glFrustum
M17   | projection          | Half of the tangent for the tangent of the half
M18   | viewport            | +y for −y in the window's first translation
M19   | projection          | 45 degrees given as 45 radians
M20   | projection          | u ∈ [0, 1] in one-point perspective: it exceeds 1 in front of the plane
M21   | projection viewport | gluOrtho with the six arguments of glOrtho
M22   | viewport            | (1 − Z)/2 where near is not at +1
M23   | viewport            | Counts of rows and columns paired crosswise
M24   | projection          | “Unit cube” for a cube of side 2
M25   | projection          | One name for the foot and the oblique image
M26   | documents           | A name and the size of a mural
M27   | homog               | Lost signs of comparison; “non-linear” for projective
M28   | clip                | Clipping in a cube: it is against −w ≤ x, y, z ≤ w, before the divide
";

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_number_is_there_once_and_every_owner_is_known() {
        let ids: Vec<&str> = all_items().map(|item| item.id.as_str()).collect();
        let known = ["homog", "camera", "projection", "clip", "viewport", "raster", "pipeline"];
        for (prefix, count) in [("C", 104), ("exercise ", 11), ("M", 28)] {
            for number in 1..=count {
                let id = format!("{prefix}{number}");
                assert_eq!(ids.iter().filter(|known| **known == id).count(), 1, "{id}");
            }
        }
        for item in all_items() {
            let fit = |owner: &&str| known.contains(owner) || *owner == "documents";
            assert!(item.owners.iter().all(fit) && !item.title.is_empty(), "{}", item.id);
        }
        assert_eq!(exercise_item("exercise 9"), Some("C45"));
        assert_eq!(exercise_item("exercise 12"), None);
    }
}
