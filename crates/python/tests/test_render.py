"""Compare pictures and passes with the program, with formulas and with each other."""

import io
import subprocess
import sys

import alberti
import numpy as np
import pytest

PASSES = (
    "rgb depth distance normal view_normal position uv barycentric ids model_ids node_ids "
    "mesh_ids material_ids overdraw coverage"
).split()


def run(program, *arguments):
    subprocess.run([program, *map(str, arguments)], check=True, capture_output=True)


@pytest.mark.parametrize("name", ["teapot", "house", "table", "bearing"])
def test_bytes_match_the_program(name, models, program, tmp_path):
    source, target = models / f"{name}.glb", tmp_path / "picture.png"
    passes = "depth,distance,normal,position,id,node,material,uv"
    size = ("--size", "320x240")
    flags = ("--passes", passes, "--pass-format", "npy")
    run(program, "render", source, "-o", target, *size, *flags)
    frame = alberti.render(alberti.load(source), size=(320, 240), passes=PASSES)
    assert frame.png() == target.read_bytes()
    assert frame._repr_png_() == frame.png()
    arrays = {
        "depth": frame.depth,
        "distance": frame.distance,
        "normal": frame.normal,
        "position": frame.position,
        "id": frame.ids,
        "node": frame.node_ids,
        "material": frame.material_ids,
        "uv": frame.uv,
    }
    for name, array in arrays.items():
        expected = np.load(tmp_path / f"picture.{name}.npy")
        assert array.dtype == expected.dtype, name
        assert array.tobytes() == expected.tobytes(), name


def test_scene_file_matches_the_program(models, program, tmp_path):
    scene, target = models.parent / "house.ron", tmp_path / "picture.png"
    run(program, "render", scene, "-o", target)
    assert alberti.render(alberti.load_scene(scene)).png() == target.read_bytes()


def test_styles_cameras_and_backgrounds_match_the_program(teapot, models, program, tmp_path):
    target = tmp_path / "picture.png"
    for style in ("clay", "toon", "lines", "x-ray", "depth-cued"):
        flags = ("--style", style, "--view", "front", "--background", "#102030", "--samples", "8")
        run(program, "render", models / "teapot.glb", "-o", target, "--size", "160x120", *flags)
        frame = alberti.render(
            teapot,
            camera="front",
            size=(160, 120),
            style=style.replace("-", "_"),
            background="#102030",
            samples=8,
        )
        assert frame.png() == target.read_bytes(), style


def test_threads_do_not_change_the_picture(teapot):
    one, many = (
        alberti.render(teapot, size=(333, 222), passes=PASSES, threads=threads)
        for threads in (1, 7)
    )
    for name in PASSES:
        assert getattr(one, name).tobytes() == getattr(many, name).tobytes(), name


def test_shapes_and_dtypes(teapot):
    frame = alberti.render(teapot, size=(31, 17), passes=PASSES)
    channels = {"normal": 3, "view_normal": 3, "position": 3, "barycentric": 3, "uv": 2, "rgb": 3}
    for name in PASSES:
        array = getattr(frame, name)
        expected = (17, 31) + ((channels[name],) if name in channels else ())
        assert array.shape == expected, name
        integer = name.endswith("ids") or name == "overdraw"
        dtype = np.uint8 if name == "rgb" else np.uint32 if integer else np.float32
        assert array.dtype == dtype, name
        assert array is getattr(frame, name), name
    assert frame.rgba.shape == (17, 31, 4)
    assert frame.size == (31, 17) and frame.mask.dtype == bool


def test_rgb_matches_a_white_background(teapot):
    """Both blend in linear light; codes of transparent pixels are rounded twice."""
    dark = alberti.Model.from_arrays([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]], color="black")
    for model, samples in ((teapot, 4), (dark, 16)):
        frame = alberti.render(model, size=(64, 48), samples=samples)
        white = alberti.render(model, size=(64, 48), samples=samples, background="white")
        assert np.abs(frame.rgb.astype(int) - white.rgb.astype(int)).max() <= 1
        assert (frame.rgb[0, 0] == 255).all()


def test_depth_of_a_plane_matches_its_formula():
    # A ray hits the plane z = 0 at eye + s · direction, with s = −eye.z / direction.z. One triangle
    # extends beyond the picture, so that no pixel is on its border.
    corners = [[-1000, -1000, 0], [3000, -1000, 0], [-1000, 3000, 0]]
    plane = alberti.Model.from_arrays(corners, [[0, 1, 2]])
    rng = np.random.default_rng(1)
    for _ in range(20):
        eye = rng.uniform((-3, -3, 2), (3, 3, 9))
        target = np.append(rng.uniform(-1, 1, 2), 0)
        camera = alberti.Camera.look_at(eye, target, fov_y=rng.uniform(20, 70), size=(160, 120))
        frame = alberti.render(plane, camera=camera, passes=("depth", "distance", "position"))
        origins, directions = camera.rays()
        along = -origins[..., 2] / directions[..., 2]
        ahead = (target - eye) / np.linalg.norm(target - eye)
        hit = frame.mask
        assert hit.mean() > 0.5
        expected = (along * (directions @ ahead))[hit]
        assert np.abs(frame.depth[hit] / expected - 1).max() < 1e-6
        assert np.abs(frame.distance[hit] / along[hit] - 1).max() < 1e-6
        assert np.isinf(frame.depth[~hit]).all()
        points = origins + along[..., None] * directions
        far = np.linalg.norm(points[hit] - eye, axis=1)
        assert (
            np.linalg.norm(camera.unproject(frame.depth)[hit] - points[hit], axis=1) / far
        ).max() < 1e-6
        assert (np.linalg.norm(frame.position[hit] - points[hit], axis=1) / far).max() < 1e-6


def test_distance_from_depth_matches_the_pass(teapot):
    both = alberti.render(teapot, size=(200, 150), passes=("depth", "distance"))
    depth = alberti.render(teapot, size=(200, 150), passes="depth")
    hit = both.mask
    error = np.abs(depth.distance[hit] / both.distance[hit] - 1)
    # If snapping to 1/256 pixel moves a triangle off a pixel center, the passes describe a point on
    # its border, which is not exactly on the ray.
    assert np.quantile(error, 0.99) < 3e-7 and error.max() < 1e-4
    assert np.isinf(depth.distance[~hit]).all()


def test_points_lie_on_the_surface(teapot):
    frame = alberti.render(teapot, size=(200, 150), passes=("depth", "position"))
    error = np.abs(frame.points() - frame.position[frame.mask]).max(axis=1)
    assert np.quantile(error, 0.99) < 2e-6 and error.max() < 1e-3


def test_ids_are_rows_of_faces():
    vertices = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]
    model = alberti.Model.from_arrays(vertices, [[0, 1, 2], [0, 2, 3]])
    camera = alberti.Camera.look_at((0.5, 0.5, 5), (0.5, 0.5, 0), height=1, size=(10, 10))
    ids = alberti.render(model, camera=camera, passes="ids").ids
    assert ids[9, 9] == 1 and ids[0, 0] == 2
    assert ((ids == 1).sum(), (ids == 2).sum()) in ((45, 55), (55, 45), (50, 50))


def test_scenes_from_models_with_poses(plane):
    box = np.eye(4)
    box[:3, 3] = (0, 0, 1)
    small = alberti.Model.from_arrays([[-1, -1, 0], [1, -1, 0], [0, 1, 0]], [[0, 1, 2]])
    scene = alberti.Scene([plane, small], [np.eye(4), box])
    camera = alberti.Camera.look_at((0, 0, 5), (0, 0, 0), size=(64, 64))
    frame = alberti.render(scene, camera=camera, passes=("depth", "model_ids"))
    assert frame.model_ids[32, 32] == 2 and frame.model_ids[0, 0] == 1
    assert frame.depth[32, 32] == 4 and abs(frame.depth[0, 0] - 5) < 1e-6


def test_render_many_matches_render(teapot):
    cameras = [alberti.Camera.frame(name) for name in ("front", "left", "top", "isometric")]
    passes = ("rgb", "depth", "ids")
    jobs = [{"model": teapot, "camera": c, "size": (64, 48), "passes": passes} for c in cameras]
    for frame, camera in zip(alberti.render_many(jobs * 5, threads=3), cameras * 5):
        single = alberti.render(teapot, camera=camera, size=(64, 48), passes=passes)
        assert frame.rgba.tobytes() == single.rgba.tobytes()
        assert frame.depth.tobytes() == single.depth.tobytes()
        assert frame.ids.tobytes() == single.ids.tobytes()
    assert alberti.render_many([]) == []


def test_camera_of_a_frame_renders_the_same_picture(teapot):
    for camera in (
        alberti.Camera.frame("three-quarter"),
        alberti.Camera.frame((1, 2, 3), orthographic=True, padding=10),
        alberti.Camera.from_intrinsics((300, 310, 100, 70), (200, 150)),
    ):
        first = alberti.render(teapot, camera=camera, size=(200, 150), passes=("rgb", "depth"))
        again = alberti.render(teapot, camera=first.camera, passes=("rgb", "depth"))
        assert again.size == (200, 150)
        close = np.isclose(first.depth, again.depth, rtol=1e-6)
        assert close.mean() > 0.999
        assert np.abs(first.rgb.astype(int) - again.rgb).mean() < 0.05


def test_drawings(teapot, models, program, tmp_path):
    drawing = alberti.draw(teapot, size=(320, 240), camera="isometric")
    target = tmp_path / "drawing.svg"
    flags = ("--style", "lines", "--view", "isometric", "--size", "320x240")
    run(program, "render", models / "teapot.glb", "-o", target, *flags)
    assert drawing.svg == target.read_text()
    drawing.save(tmp_path / "copy.pdf")
    assert (tmp_path / "copy.pdf").read_bytes() == drawing.pdf and drawing.pdf[:5] == b"%PDF-"
    run(program, "render", models / "teapot.glb", "-o", tmp_path / "drawing.dxf", *flags)
    drawing.save(tmp_path / "copy.dxf")
    assert (tmp_path / "copy.dxf").read_bytes() == (tmp_path / "drawing.dxf").read_bytes()
    count = len(drawing.lines)
    assert drawing.lines.shape == (count, 2, 2) and drawing.visible.all()
    assert len(drawing.classes) == len(drawing.objects) == len(drawing.edges) == count
    assert {"silhouette"} <= set(drawing.classes)


def test_lines_are_projected_edges():
    square = alberti.Model.from_arrays([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], [[0, 1, 2, 3]])
    camera = alberti.Camera.look_at((2, 3, 4), (0.5, 0.5, 0), size=(320, 240))
    drawing = alberti.draw(square, camera=camera)
    corners = camera.project([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]])[0]
    ends = drawing.lines.reshape(-1, 2)
    distances = np.linalg.norm(ends[:, None] - corners[None], axis=2).min(axis=1)
    assert len(drawing.lines) == 4 and distances.max() < 1e-6
    assert set(drawing.classes) == {"boundary"}


def test_explanations_match_the_program(teapot, models, program):
    import json

    arguments = ["explain", models / "teapot.glb", "--point", "0.1,0.2,0.3", "--json"]
    text = subprocess.run(
        [program, *map(str, arguments)], check=True, capture_output=True, text=True
    ).stdout
    steps = alberti.explain(teapot, point=(0.1, 0.2, 0.3))["steps"]
    assert steps == json.loads(text)["steps"]
    pixel = alberti.explain(teapot, pixel=(480, 360), size=(960, 720))
    assert pixel["verdict"] and len(pixel["steps"]) > 3
    node = alberti.explain(teapot, node=0)
    assert node["subject"]


def test_program_is_installed(program):
    done = subprocess.run([program, "--version"], capture_output=True, text=True)
    assert done.returncode == 0 and done.stdout.startswith("alberti")
    wrong = subprocess.run([program, "render", "--no-such-flag"], capture_output=True, text=True)
    assert wrong.returncode == 2 and "--no-such-flag" in wrong.stderr
    missing = subprocess.run([program, "info", "missing.glb"], capture_output=True, text=True)
    assert missing.returncode == 1 and missing.stderr.startswith("error: ")
    module = subprocess.run([sys.executable, "-m", "alberti", "--version"], capture_output=True)
    assert module.stdout.decode() == done.stdout


def test_pictures_are_encoded_as_png(teapot):
    assert io.BytesIO(teapot._repr_png_()).read(8) == b"\x89PNG\r\n\x1a\n"
