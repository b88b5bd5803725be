//! Words for which there is no field, with advice on getting the same effect.

/// Words and advice about them. Each row has:
/// - the struct, variant or enum around the word;
/// - the words in lowercase, without hyphens or underscores, separated by spaces;
/// - the help.
const ADVICE: &[(&str, &str, &str)] = &[
    (
        "Sheet",
        "view layout arrangement",
        "a sheet has a front, a top, a side and a fourth view: choose side_view: Left or Right, and axonometric_view: Isometric, Dimetric, Trimetric, ThreeQuarter or None; or list all views: views: [View(from: Front), View(from: Top)]",
    ),
    (
        "CameraPath",
        "turntable orbit spin circle rotate",
        "`alberti animate SCENE --turntable -o turn.png` rotates the models without a path; to define a path, write camera_path: (keys: [(time: 0, eye: (0, 2, 6), target: (0, 0, 0)), (time: 2, eye: (6, 2, 0), target: (0, 0, 0))])",
    ),
    (
        "Camera",
        "rotation rotationeuler orientation",
        "a camera has no rotation angles: write camera: (view: LookAt(eye: (4, 3, 6), target: (0, 0, 0)))",
    ),
    (
        "Scene",
        "frame",
        "to choose a moment of an animation, set a model's `time` in seconds, or use `--time 1.5`; sheet: (frame: …) sets the border of a drawing",
    ),
    ("Scene", "resolution", "write the picture size as image: (size: (640, 480))"),
    ("Scene", "exposure exposureev exposurevalue ev", "write it as image: (exposure_ev: …)"),
    ("Image", "width height", "write the size as size: (640, 480)"),
    ("Scene", "width height", "write the picture size as image: (size: (640, 480))"),
    (
        "Scene",
        "time",
        "write models: [(path: \"model.glb\", time: …)] for an animation; for a still of a camera path, run `alberti render SCENE --time 2`",
    ),
    (
        "Section",
        "plane cut clip clippingplane x y z front top side axis offset distance at",
        "write sections: [(point: (0, 0, 0), normal: (0, 0, 1))]: a point on the plane, and a normal toward the half to remove",
    ),
    (
        "Projection::OnePoint",
        "fov fovy fovydegrees fieldofview angle focallength",
        "write distance: 3, the distance of the eye in half picture heights; larger values narrow the view",
    ),
    (
        "Projection::OnePoint",
        "vanishingpoint vp center z",
        "write at: (0.35, 0.45), from −1 at the bottom of the picture to 1 at the top",
    ),
    (
        "Projection::TwoPoint",
        "fov fovy fovydegrees fieldofview angle focallength distance",
        "the vanishing points determine the field of view, as in x: (-3.2, 0.4), z: (2.4, 0.4); move them farther apart to narrow it, or choose projection: Perspective(fov_y_degrees: 35)",
    ),
    (
        "Projection::TwoPoint",
        "at vanishingpoint vanishingpoints vp left right points horizon",
        "set both vanishing points: x: (-3.2, 0.4), z: (2.4, 0.4), from −1 at the bottom of the picture to 1 at the top",
    ),
    (
        "Projection::ThreePoint",
        "fov fovy fovydegrees fieldofview angle focallength distance at vanishingpoint vanishingpoints",
        "the vanishing points determine the field of view, as in x: (-3.2, 1.2), y: (0.1, -5), z: (2.4, 1.2); move them farther apart to narrow it",
    ),
    (
        "View::Frame",
        "distance zoom eye position target lookat scale height elevation",
        "Frame finds the distance itself: padding_percent: 20 moves the eye away, and camera: (zoom: 2) doubles the size; to place the eye yourself, write view: LookAt(eye: (0, 2, 6), target: (0, 0, 0))",
    ),
    (
        "View::Frame",
        "angle azimuth yaw pitch",
        "write from: Direction((1, 1, 1)), the direction from the models to the camera",
    ),
    (
        "Overlay",
        "dimensions dimension measure measures",
        "dimensions are drawn only on sheets: remove this overlay, write sheet: (dimensions: true) and run `alberti sheet`",
    ),
    (
        "Ground::Shadow",
        "color colour material texture size albedo basecolor",
        "the ground shows only shadows; for a color behind them, set image: (background: Color(\"#f4f1ea\"))",
    ),
    (
        "Ground::Shadow",
        "opacity alpha strength intensity darkness softness blur",
        "the lights determine this: Ambient(intensity: 1) or an environment makes shadows paler, and shadows: On(softness_degrees: 4) makes them softer",
    ),
    (
        "Background::Gradient",
        "top bottom from to start end first second left right",
        "write Gradient(colors: [\"#ffffff\", \"#c8d0d8\"]), from top to bottom",
    ),
    (
        "Light::Spot",
        "target lookat towards",
        "write direction: (x, y, z), the target minus the position",
    ),
    (
        "Light::Directional",
        "target lookat towards",
        "write direction: (-1, -2, -1), the direction in which the light travels: from the light to the models",
    ),
    (
        "Light",
        "arealight area rectarealight rectlight",
        "there are no area lights: write environment: Studio(), which has soft boxes, or lights: [Directional(direction: (-1, -2, -1), intensity: 3)] with shadows: On(softness_degrees: 4)",
    ),
    (
        "Ground",
        "plane floor grid",
        "write ground: Shadow(), which shows the shadows of the models; overlays: [Grid()] draws a grid",
    ),
    (
        "Lines",
        "hatch hatching hatched",
        "write face_fill: Hatching; cuts made by `sections` are always hatched, with hatch_spacing_mm",
    ),
    (
        "Lines",
        "hatchangle hatchdirection hatchdegrees",
        "the direction of hatch lines is fixed; hatch_spacing_mm: 2 sets their spacing",
    ),
    (
        "Lines",
        "stroke line pen",
        "write width: Px(2) for the line width and color: \"black\" for the line color",
    ),
    (
        "Light",
        "softbox softlight studiolight keylight filllight rimlight",
        "write lights: [Directional(direction: (-1, -2, -1), intensity: 3)]; environment: Studio() has soft boxes",
    ),
    (
        "Image",
        "format filetype file output path name",
        "remove this field; the name of the output sets the format, as in `alberti render SCENE -o picture.png`, .svg, .pdf or .dxf",
    ),
    (
        "Instances",
        "random scatter poisson points array",
        "write instances: List([(translation: (1, 0, 2), rotation_degrees: (0, 40, 0)), (translation: (4, 0, 1))])",
    ),
    (
        "Instances::Grid",
        "rows columns cols layers nx ny nz x y z size",
        "write count: (5, 1, 4), along x, y and z; y is up",
    ),
    (
        "Instances::Grid",
        "spacing distance pitch gap offset",
        "write step: (2, 0, 2), the distances along x, y and z; y is up",
    ),
    (
        "CameraPath",
        "duration seconds length loop closed time times fps frames speed",
        "the times of the keys set the duration: the path ends at the last key, and closes if that key repeats the first; write keys: [(time: 0, eye: (0, 2, 6), target: (0, 0, 0)), (time: 2, eye: (6, 2, 0), target: (0, 0, 0))]",
    ),
    (
        "Viewport",
        "x y width height left top w h rect region area position size rectangle bounds",
        "write at: (0.5, 0, 0.5, 0.5): left, top, width and height as fractions of the picture",
    ),
    (
        "Stereo",
        "true yes on enabled stereo",
        "write stereo: SideBySide(), or Anaglyph() for red and cyan glasses",
    ),
    (
        "Style",
        "depthcued depthcue depthcueing",
        "write style: Lines(edges: Facets, hidden: Drawn, depth_cue_percent: 80)",
    ),
    ("Style", "dashed", "write style: Lines(hidden: Dashed)"),
    ("Style", "silhouette", "write style: Lines(edges: Silhouette)"),
    ("Style", "outline", "write style: Lines(edges: Outline)"),
    ("Style", "technical", "write style: Lines(edges: Tangents, hidden: Dashed, width: Iso(0.5))"),
    (
        "Style",
        "patent",
        "write style: Lines(width: Iso(0.35), color: \"#000000\", hatch_spacing_mm: 1.2, face_fill: ShadeHatching)",
    ),
    (
        "Style",
        "blueprint",
        "write style: Lines(edges: Tangents, hidden: Dashed, width: Iso(0.5), color: \"#ffffff\", paper: \"#1d4279\")",
    ),
    (
        "Style",
        "sketch",
        "write style: Lines(width: Mm(0.3), color: \"#444240\", hand_drawn_mm: 0.35)",
    ),
    (
        "EdgeSelection",
        "technical blueprint",
        "`--style technical` is short for Lines(edges: Tangents, hidden: Dashed, width: Iso(0.5))",
    ),
    ("Style", "hatched hatching hatch engraving", "write style: Lines(face_fill: Hatching)"),
];

/// Returns advice for a word in `owner` that is not one of its fields; `word` is lowercase, without
/// hyphens or underscores.
pub(super) fn find_advice(owner: &str, word: &str) -> Option<&'static str> {
    let is_meant = |(place, words, _): &&(&str, &str, &str)| {
        *place == owner && words.split(' ').any(|known| known == word)
    };
    ADVICE.iter().find(is_meant).map(|(.., help)| *help)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::file::StyleFile;
    use crate::parse_scene;

    /// The advice for a name that `--style` accepts for line drawings gives the same style in a
    /// scene.
    #[test]
    fn advice_on_line_styles_matches_the_flags() {
        let mut checked = 0;
        for (name, style) in StyleFile::NAMED {
            let word: String = name.chars().filter(char::is_ascii_alphabetic).collect();
            let Some(help) = find_advice("Style", &word) else { continue };
            let field = help.strip_prefix("write ").expect("a field");
            let source = format!("Scene(models: [(path: \"a.glb\")], {field})");
            let scene = parse_scene("scene.ron", &source).expect(help);
            assert_eq!(scene.style, style(), "{name}");
            checked += 1;
        }
        assert_eq!(checked, 8);
    }
}
