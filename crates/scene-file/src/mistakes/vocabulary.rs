//! Tests of words from three.js, Blender, glTF and f3d, used instead of the scene language's words.

use super::{mistakes, scene_with};

/// A scene field with a foreign word, and text that the help must contain.
const WORDS: [(&str, &str); 66] = [
    // three.js
    ("camera: (projection: Perspective(fov: 35))", "`fov_y_degrees`"),
    ("camera: (fov: 35)", "camera: (projection: Perspective(fov_y_degrees: …))"),
    ("camera: (position: (4, 3, 6))", "camera: (view: LookAt(eye: …))"),
    ("camera: (view: LookAt(position: (4, 3, 6), target: (0, 0, 0)))", "`eye`"),
    ("camera: (view: LookAt(eye: (4, 3, 6), lookAt: (0, 0, 0)))", "`target`"),
    ("camera: (lookAt: (0, 0, 0))", "camera: (view: LookAt"),
    ("camera: PerspectiveCamera(fov: 35)", "camera: (projection: Perspective(…))"),
    ("camera: (projection: OrthographicCamera())", "`Orthographic`"),
    ("camera: (near: 0.1)", "camera: (projection: Perspective(near: …))"),
    ("lights: [DirectionalLight(intensity: 1)]", "`Directional`"),
    ("lights: [PointLight(intensity: 1)]", "`Point`"),
    ("lights: [SpotLight(intensity: 1)]", "`Spot`"),
    ("lights: [AmbientLight(intensity: 1)]", "`Ambient`"),
    ("lights: [HemisphereLight(intensity: 1)]", "environment: Sky(…)"),
    ("lights: [RectAreaLight(intensity: 1)]", "Studio()"),
    ("lights: [Directional(direction: (0, -1, 0), intensity: 1, castShadow: true)]", "`shadows`"),
    (
        "lights: [Spot(position: (0, 1, 0), direction: (0, -1, 0), intensity: 1, penumbra: 1)]",
        "`inner_cone_degrees`",
    ),
    (
        "lights: [Spot(position: (0, 1, 0), direction: (0, -1, 0), intensity: 1, angle: 1)]",
        "`outer_cone_degrees`",
    ),
    ("lights: [Point(position: (0, 1, 0), intensity: 1, distance: 9)]", "`range`"),
    ("light: Ambient(intensity: 1)", "`lights`"),
    ("toneMapping: Aces", "image: (tone_mapping: …)"),
    ("image: (toneMapping: Aces)", "`tone_mapping`"),
    ("image: (tone_mapping: ACESFilmicToneMapping)", "`Aces`"),
    ("image: (toneMappingExposure: 1)", "`exposure_ev`"),
    ("image: (antialias: true)", "`samples`"),
    ("background: Color(\"white\")", "image: (background: …)"),
    ("image: (background: \"white\")", "`Color(\"white\")`"),
    ("image: (background: white)", "`Color(\"white\")`"),
    ("fog: 1", "expected one of"),
    ("wireframe: true", "`style`"),
    ("style: MeshNormalMaterial", "`Normals`"),
    // Blender
    ("lights: [Sun(direction: (0, -1, 0), intensity: 1)]", "`Directional`"),
    ("lights: [Area(intensity: 1)]", "Studio()"),
    ("lights: [Directional(direction: (0, -1, 0), energy: 1)]", "`intensity`"),
    ("lights: [Point(location: (0, 1, 0), intensity: 1)]", "`position`"),
    ("lights: [Point(position: (0, 1, 0), power: 1)]", "`intensity`"),
    (
        "lights: [Spot(position: (0, 1, 0), direction: (0, -1, 0), intensity: 1, spot_size: 1)]",
        "`outer_cone_degrees`",
    ),
    ("world: File(path: \"a.hdr\")", "`environment`"),
    ("image: (resolution: (800, 600))", "`size`"),
    ("resolution: (800, 600)", "image"),
    ("image: (film_transparent: true)", "Transparent"),
    ("image: (view_transform: AgX)", "`tone_mapping`"),
    ("camera: (projection: Perspective(clip_start: 1))", "`near`"),
    ("camera: (projection: Orthographic(ortho_scale: 1))", "`height`"),
    ("shadow_catcher: true", "ground"),
    ("style: Freestyle", "`Lines()`"),
    // glTF
    ("camera: (projection: Perspective(yfov: 35))", "`fov_y_degrees`"),
    ("camera: (projection: Perspective(znear: 1))", "`near`"),
    ("camera: (projection: Perspective(zfar: 1))", "`far`"),
    ("camera: (projection: Orthographic(xmag: 1))", "`height`"),
    ("camera: (projection: Orthographic(ymag: 1))", "`height`"),
    ("camera: (projection: Perspective(aspectRatio: 1))", "image: (size: …)"),
    (
        "lights: [Spot(position: (0, 1, 0), direction: (0, -1, 0), intensity: 1, innerConeAngle: 1)]",
        "`inner_cone_degrees`",
    ),
    ("nodes: []", "`models`"),
    // f3d
    ("camera: (view: LookAt(camera-position: (4, 3, 6), target: (0, 0, 0)))", "`eye`"),
    ("camera: (view: LookAt(eye: (4, 3, 6), camera-focal-point: (0, 0, 0)))", "`target`"),
    (
        "camera: (view: LookAt(eye: (4, 3, 6), target: (0, 0, 0), camera-view-up: (0, 1, 0)))",
        "`up`",
    ),
    ("camera-direction: (0, 0, 1)", "camera: (view: "),
    ("hdri: \"a.hdr\"", "environment: File(…)"),
    ("hdri-file: \"a.hdr\"", "environment: File(…)"),
    ("ambient-occlusion: true", "`ambient_occlusion`"),
    ("anti-aliasing: true", "image: (samples: …)"),
    ("bg-color: \"white\"", "image: (background: …)"),
    ("style: Lines(line-width: 2)", "`width`"),
    ("overlays: [Axis()]", "`Axes`"),
    ("samples: 4", "image: (samples: …)"),
];

/// Model fields with a foreign word.
const MODEL_WORDS: [(&str, &str); 20] = [
    ("position: (1, 2, 3)", "`translation`"),
    ("location: (1, 2, 3)", "`translation`"),
    ("translate: (1, 2, 3)", "`translation`"),
    ("rotation: (1, 2, 3)", "`rotation_degrees`"),
    ("rotation_euler: (1, 2, 3)", "`rotation_degrees`"),
    ("rotate_degrees: (1, 2, 3)", "`rotation_degrees`"),
    ("animation_time: 1", "`time`"),
    ("material: (roughness: 1)", "`materials`"),
    ("materials: [(metalness: 1)]", "`metallic`"),
    ("materials: [(metallicFactor: 1)]", "`metallic`"),
    ("materials: [(roughnessFactor: 1)]", "`roughness`"),
    ("materials: [(baseColorFactor: \"red\")]", "`base_color`"),
    ("materials: [(color: \"red\")]", "`base_color`"),
    ("materials: [(emissiveIntensity: 1)]", "`emissive_strength`"),
    ("materials: [(opacity: 1)]", "`alpha`"),
    ("materials: [(doubleSided: true)]", "`double_sided`"),
    ("materials: [(alphaMode: Blend)]", "`alpha_mode`"),
    ("materials: [(alpha_mode: BLEND)]", "`Blend`"),
    ("roughness: 1", "models: [(materials: [(roughness: …)])]"),
    ("animation: \"Walk\"", "`Name(\"Walk\")`"),
];

#[test]
fn words_from_other_programs_get_a_hint_with_the_right_word() {
    let in_scene = WORDS.map(|(field, expected)| (scene_with(field), expected));
    let in_model = MODEL_WORDS
        .map(|(field, expected)| (format!("(models: [(path: \"a.glb\", {field})])"), expected));
    let mut wrong = Vec::new();
    for (source, expected) in in_scene.iter().chain(&in_model) {
        let found = mistakes(source);
        let is_answered = matches!(found.as_slice(), [(.., help)] if help.contains(expected));
        if !is_answered {
            wrong.push((source, expected, found));
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

/// A field written directly in the scene by mistake gets a hint that shows where it belongs.
#[test]
fn misplaced_fields_get_a_hint_with_their_position() {
    use crate::reference::{FieldEntry, Shape, all_types};
    let types = all_types();
    let fields_of = |shape: Shape| -> Vec<&'static FieldEntry> {
        match shape {
            Shape::Plain(_) => Vec::new(),
            Shape::Fields(fields) => fields.iter().collect(),
            Shape::Variants(variants) => variants.iter().flat_map(|v| v.fields).collect(),
        }
    };
    let own: Vec<&str> = fields_of(types[0].shape).iter().map(|field| field.name).collect();
    let mut wrong = Vec::new();
    for field in types.iter().flat_map(|entry| fields_of(entry.shape)) {
        // In the scene, `width` and `height` are taken for the size of the picture.
        if own.contains(&field.name) || ["width", "height"].contains(&field.name) {
            continue;
        }
        let found = mistakes(&scene_with(&format!("{}: 1", field.name)));
        let named = format!("{}: …", field.name);
        if !matches!(found.as_slice(), [(.., help)] if help.contains(&named)) {
            wrong.push(format!("{}: {}", field.name, found[0].2));
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

/// Variants need the brackets that `ron` expects; the message shows them.
#[test]
fn only_variants_with_fields_have_brackets() {
    for (field, help) in [
        ("style: Lines", "write Lines()"),
        ("style: Shaded()", "write Shaded"),
        ("camera: (projection: Perspective)", "write Perspective()"),
        ("camera: (view: LookAt)", "write LookAt(…) with its fields"),
        ("camera: (view: FromModel)", "write FromModel(…) with a CameraChoice"),
        ("style: Lines((width: Px(2)))", "write Lines(…)"),
        ("shadows: On", "write On()"),
    ] {
        let found = mistakes(&scene_with(field));
        assert!(matches!(found.as_slice(), [(.., told)] if told == help), "{field}: {found:?}");
    }
}
