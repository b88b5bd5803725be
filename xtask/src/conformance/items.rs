//! The list of topics to test, each with the crates responsible for it.
//!
//! The topics are the items that the sources teach (C), the misprints found in them (M), and the
//! exercises of the textbook's chapter.

use std::sync::LazyLock;

/// An item that must have tests.
pub struct Item {
    /// The id, such as `C4`, `M11b` or `exercise 3`.
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

    /// Returns the owners whose tests must be complete: the math crates.
    pub fn complete_owners(&self) -> impl Iterator<Item = &'static str> {
        self.owners.iter().copied().filter(|owner| crate::tidy::NO_STD.contains(owner))
    }
}

/// The topics in the sources.
pub static ITEMS: LazyLock<Vec<Item>> = LazyLock::new(|| parse_rows(ITEM_ROWS));
/// The misprints in the sources. A test of a misprint shows that the printed form is wrong.
pub static MISPRINTS: LazyLock<Vec<Item>> = LazyLock::new(|| parse_rows(MISPRINT_ROWS));

/// The exercises. Each covers an item, and a test of the exercise also counts toward the item.
pub static EXERCISES: LazyLock<Vec<Item>> = LazyLock::new(|| {
    let asked = |id: &str| ITEMS.iter().find(|item| item.id == id);
    let exercise = |(i, id): (usize, &&str)| {
        let item = asked(id)?;
        let owners = item.owners[..1].to_vec();
        Some(Item { id: format!("exercise {}", i + 1), owners, title: item.title })
    };
    EXERCISE_ITEMS.iter().enumerate().filter_map(exercise).collect()
});

/// The items that exercises 1 to 11 cover.
const EXERCISE_ITEMS: [&str; 11] =
    ["C38", "C39", "C40", "C41", "C42", "C43", "C44", "C45", "C45", "C46", "C47"];

/// Returns the item that an exercise covers.
pub fn exercise_item(exercise: &str) -> Option<&'static str> {
    let number: usize = exercise.strip_prefix("exercise ")?.parse().ok()?;
    EXERCISE_ITEMS.get(number.checked_sub(1)?).copied()
}

/// Returns every item, exercise and misprint.
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
C1    | viewport pipeline   | The forward map and the pixel ray of a camera are inverses
C2    | raster pipeline     | Wireframe pictures: near lines do not hide far lines
C3    | homog pipeline      | World, camera, canonical and screen space; the chain is the product of its factors
C4    | projection clip     | The canonical volume [−1, 1]³, viewed along −z
C5    | viewport            | Pixel centers at integers, the image from −½ to n − ½
C6    | viewport            | The viewport matrix preserves z
C7    | projection clip     | The orthographic box and its six planes
C8    | projection          | M_orth and its inverse
C9    | pipeline            | Viewport times M_orth gives pixels and canonical depth
C10   | pipeline            | The line-drawing loop for an orthographic box
C11   | camera              | The camera's basis u, v, w from gaze and view-up
C12   | camera              | M_cam as rotation times translation
C13   | pipeline            | The line-drawing loop with a camera
C14   | projection pipeline | Size is inversely proportional to distance
C15   | homog               | Linear, affine and projective matrices, and how to classify them
C16   | homog               | A worked 2D map of the unit square
C17   | homog               | Multiples of a matrix, or of a point, are equivalent
C18   | homog               | Homogeneous coordinates on the line
C19   | homog               | Homogeneous coordinates in the plane
C20   | homog               | The divide can wait; w may be 0 until then
C21   | homog               | Perspective from a plane to a line
C22   | projection          | The matrix P preserves the depths of the near and far planes
C23   | projection pipeline | P scales x and y down and preserves lines; lines through the eye become parallel
C24   | projection          | The image of a point under P: no flip, order preserved
C25   | projection          | The inverse of P, exact and up to a factor
C26   | viewport projection | From a screen position back into space
C27   | projection          | M_per is M_orth after P
C28   | projection pipeline | The whole chain, with the divide at the end
C29   | projection          | M_per written out, and OpenGL's matrix derived from it
C30   | projection          | Conventions of graphics APIs, and conversions between them
C31   | homog clip raster   | Segments stay segments; f(t) gives the image of their points
C32   | homog               | Planes stay planes, and triangles stay triangles
C33   | projection          | Symmetric windows from a field of view
C34   | projection          | Orthographic projection measures true lengths
C35   | pipeline            | Spheres off the axis are drawn as ellipses
C36   | clip pipeline       | Segments across the plane of the eye wrap around unless clipped first
C37   | homog               | Translations work on homogeneous points before the divide
C38   | viewport            | The viewport for pixel rows counted from the top
C39   | viewport projection | Viewport times M_orth is a single windowing
C40   | projection          | The third row of P follows from the two planes it preserves
C41   | projection          | P preserves the order of depths
C42   | homog               | Affine maps treat all multiples of a point alike
C43   | projection          | The inverse of P, verified
C44   | projection          | M_per takes the near corner to (1, 1, 1)
C45   | projection          | P for n = 1 and f = 2, and the image of a point
C46   | camera              | A camera that looks straight down
C47   | homog clip          | f(t) preserves the order of points on a segment
C48   | projection          | The midpoint between near and far moves away from the eye
C49   | projection          | The field of view is measured between the midpoints of the bottom and top edges
C50   | homog               | Frames: points depend on the origin, and vectors do not
C51   | homog               | Conversion between Cartesian and homogeneous coordinates
C52   | homog               | Translation moves only points; rotation and scale also change vectors
C53   | homog viewport      | Linear remapping, inside and outside the range
C54   | clip pipeline       | Projection takes two steps, with clipping between them
C55   | projection          | The image of a point on the near plane by similar triangles
C56   | projection          | The depth row follows from two given values
C57   | projection pipeline | The derivation of the frustum matrix, step by step
C58   | homog               | Perspective is linear on 4-vectors but not affine on points
C59   | viewport pipeline   | The viewport undoes the stretch of the canonical square
C60   | projection          | Perspective by field of view as in OpenGL and Direct3D, vertical or horizontal
C61   | projection          | Field of view, aspect ratio, near and far are validated
C62   | pipeline            | Sheets that show the effect of field of view, aspect ratio and planes
C63   | projection          | The lesson's frustum with a moved apex, compared with the true frustum
C64   | pipeline            | Sheets that show the effect of a frustum's borders, with its apex
C65   | camera projection   | Stereo: two off-axis frusta
C66   | projection pipeline | The lesson's frustum in its five steps
C67   | projection          | The lesson's depth constants c1 and c2
C68   | projection          | The lesson's table of depths, and where depth is 0
C69   | projection          | Conversion between field of view and frustum, where possible
C70   | pipeline            | Image and window have the same aspect ratio
C71   | homog               | A change of coordinates is a matrix
C72   | projection          | Center, projectors and plane; parallel projection as a limit
C73   | projection pipeline | The tree of planar geometric projections
C74   | projection          | Parallel lines stay parallel in parallel projections
C75   | projection viewport | Front, top and side views on one sheet
C76   | projection          | Axonometric projection by normal, angles or ratios
C77   | projection          | Oblique projection: cavalier, cabinet, any angle
C78   | projection          | The oblique matrix by length and angle
C79   | projection          | The oblique matrix by direction, equal to the former
C80   | pipeline            | Foreshortening and vanishing points, drawn in a picture
C81   | homog projection    | Parallel lines meet at the image of their point at infinity
C82   | projection          | One-point perspective from an eye in front of the plane z = 0
C83   | homog projection    | Nonzero entries among p, q, r count the principal vanishing points
C84   | pipeline            | Projection in a renderer: view coordinates, a view volume, and depth
C85   | projection clip     | View plane, window, space and volume, with corners and planes
C86   | projection          | A slanted prism is normalized by a shear and a box
C87   | projection clip     | A slanted frustum is normalized by a shear and a scale; clipping is possible there
C88   | projection pipeline | The frustum becomes a box, and depth order is preserved
C89   | projection clip     | One clipper serves parallel and perspective projections
C90   | projection          | Ortho as translation and scale; equal borders are rejected
C91   | projection          | glFrustum, symmetric or off-axis, to [−1, 1]³
C92   | projection          | The symmetric perspective matrix
C93   | projection          | Agreement with a well-known library, in radians
C94   | pipeline            | Sheets for ortho and perspective
C95   | viewport            | Window to viewport by equal ratios
C96   | viewport            | Window to viewport by translation, scale, translation
C97   | viewport            | From screen to normalized device coordinates
C98   | viewport pipeline   | Grid indices mapped to [−1, 1]², for height fields
C99   | viewport            | Several viewports on one image, each with a position and a size
C100  | projection viewport | Handedness, the flip of z, and depth on the screen
C101  | homog pipeline      | Column vectors: the model matrix is applied first; row vectors use the transpose
C102  | homog projection    | A classical projection is singular; a renderer's projection is not
C103  | pipeline            | The pipeline, stage by stage
C104  | documents           | Exercises of this project
";

const MISPRINT_ROWS: &str = "\
M1    | homog               | The point's y is missing: d/z instead of (d/z)·y
M2    | homog               | x ~ α instead of x ~ αx, α ≠ 0
M3    | projection          | P keeps points of “n = f”: it preserves the plane z = f, but not its points
M4    | projection          | P is missing from the perspective chain
M5    | projection          | f_n instead of the product f·n in the depth
M6    | homog               | t_y instead of t_z in the third row of a translation
M7    | projection          | [0, 1] instead of the volume [0, 1]³
M8    | projection          | OpenGL has the same volume but the opposite direction of z
M9    | projection          | n = 1 and f = 2 contradict the chapter's 0 > n > f
M10   | documents           | Equation and figure numbers from several editions
M11   | camera              | A translation without the 1 in its third row
M11b  | projection camera   | = instead of ~ in the effect of P; a camera “from” −z instead of one that looks along −z
M12   | projection          | An off-center window in the fourth column: another projection
M13   | projection          | _mid_y instead of −mid_y
M14   | projection          | A 1 at the end of a perspective's bottom row
M14b  | projection          | The window's lower left corner is (−1, −1)
M14c  | projection          | An off-center window returns nothing instead of an error
M15   | projection          | The sign of the depth offset in Ortho
M15b  | projection          | A parenthesis in Ortho's translation along z
M16   | projection          | right − left instead of right + left in glFrustum
M17   | projection          | Half the tangent instead of the tangent of half the angle
M18   | viewport            | +y instead of −y in the window's first translation
M19   | projection          | 45 degrees passed as 45 radians
M20   | projection          | u ∈ [0, 1] in one-point perspective: it exceeds 1 in front of the plane
M21   | projection viewport | gluOrtho with the six arguments of glOrtho
M22   | viewport            | (1 − Z)/2, although near is not at +1
M23   | viewport            | Row and column counts swapped
M24   | projection          | “Unit cube” instead of a cube of side 2
M25   | projection          | The same name for the foot and the oblique image
M26   | documents           | A name and the size of a mural
M27   | homog               | Missing comparison signs; “non-linear” instead of projective
M28   | clip                | Clipping against a cube instead of −w ≤ x, y, z ≤ w before the divide
";

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_number_appears_once_and_every_owner_is_known() {
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
