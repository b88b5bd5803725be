"""Test that invalid input raises an exception with the argument and value, and never aborts."""

import pickle
import signal
import subprocess
import sys
import threading
import time
import warnings

import alberti
import numpy as np
import pytest

Camera, Model = alberti.Camera, alberti.Model
SQUARE = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]
NAN = [[0, 0, 0], [1, np.nan, 0], [1, 1, 0]]


@pytest.mark.parametrize(
    ("pointer", "words", "arguments"),
    [
        ("vertices", "(4, 2)", {"vertices": np.zeros((4, 2))}),
        ("vertices", "(3,)", {"vertices": np.zeros(3)}),
        ("vertices", "complex", {"vertices": np.zeros((4, 3), complex)}),
        ("vertices", "expected", {"vertices": "house"}),
        ("vertices", "None", {"vertices": None}),
        ("vertices[1, 1]", "NaN", {"vertices": NAN}),
        ("vertices[2, 0]", "inf", {"vertices": [[0, 0, 0], [1, 0, 0], [1e300, 1, 0]]}),
        ("faces[0, 2]", "9", {"faces": [[0, 1, 9]]}),
        ("faces[1, 0]", "-1", {"faces": np.array([[0, 1, 2], [-1, 0, 1]])}),
        ("faces[1]", "0 vertices", {"faces": [[0, 1, 2], []]}),
        ("faces", "(2, 0)", {"faces": np.zeros((2, 0), int)}),
        ("faces", "float64", {"faces": np.zeros((2, 3))}),
        ("faces", "object", {"faces": np.array([[0, 1, 2], [0, 1]], dtype=object)}),
        ("faces[0, 0]", "vertices", {"faces": np.full((1, 3), 2**63, np.uint64)}),
        ("normals", "3 rows", {"normals": np.zeros((3, 3))}),
        ("colors", "(7, 3)", {"colors": np.zeros((7, 3))}),
        ("colors.flat[0]", "2", {"colors": np.full((4, 3), 2.0)}),
        ("uv", "3 rows", {"uv": np.zeros((3, 2))}),
        ("texture", "uv", {"texture": np.zeros((2, 2, 3), np.uint8)}),
        ("texture", "float64", {"uv": np.zeros((4, 2)), "texture": np.zeros((2, 2, 3))}),
        ("texture", "int64", {"uv": np.zeros((4, 2)), "texture": np.zeros((2, 2, 3), int)}),
        ("texture", "PNG", {"uv": np.zeros((4, 2)), "texture": b"GIF89a"}),
        ("color", "bleu", {"color": "bleu"}),
        ("metallic", "2", {"metallic": 2}),
        ("roughness", "rough", {"roughness": "rough"}),
        ("crease", "200", {"crease": 200}),
        ("up", "north", {"up": "north"}),
        ("unit", "furlong", {"unit": "furlong"}),
        ("limits['pixels']", "unknown limit", {"limits": {"pixels": 1}}),
    ],
)
def test_invalid_arrays_are_rejected(pointer, words, arguments):
    arguments = {"vertices": SQUARE, "faces": [[0, 1, 2, 3]], **arguments}
    with pytest.raises(alberti.AlbertiError) as caught:
        Model.from_arrays(**arguments)
    error = caught.value
    assert error.code == "INVALID_ARGUMENT"
    assert error.pointer.replace('"', "'") == pointer
    assert words in str(error), str(error)


def test_exceeded_limits_are_reported():
    many = np.zeros((1000, 3))
    with pytest.raises(alberti.AlbertiError, match="array_bytes") as caught:
        Model.from_arrays(many, limits={"array_bytes": 1000})
    assert caught.value.code == "LIMIT_EXCEEDED" and "1000" in str(caught.value)
    with pytest.raises(alberti.AlbertiError) as caught:
        Model.from_arrays(SQUARE, [[0, 1, 2]] * 9, limits={"scene_items": 5})
    assert caught.value.code == "LIMIT_EXCEEDED"


def camera(**options):
    return Camera.look_at((0, 0, 5), (0, 0, 0), **options)


@pytest.mark.parametrize(
    ("pointer", "make"),
    [
        ("eye", lambda: Camera.look_at((0, 0), (0, 0, 0))),
        ("eye[2]", lambda: Camera.look_at((0, 0, np.inf), (0, 0, 0))),
        ("fov_y", lambda: camera(fov_y=180)),
        ("fov_x", lambda: camera(fov_y=20, fov_x=30)),
        ("near", lambda: camera(near=0)),
        ("near", lambda: camera(near="1 m")),
        ("height", lambda: camera(height=-1)),
        ("size", lambda: camera(size=(0, 5))),
        ("size", lambda: camera(size=(2**40, 5))),
        ("size", lambda: camera(size=640)),
        ("direction", lambda: Camera.frame("above")),
        ("padding", lambda: Camera.frame("top", padding=-5)),
        ("K", lambda: Camera.from_intrinsics(np.eye(4), (64, 48))),
        ("K", lambda: Camera.from_intrinsics(np.zeros((3, 3)), (64, 48))),
        ("K[0, 0]", lambda: Camera.from_intrinsics(np.diag([np.nan, 1, 1]), (64, 48))),
        ("R", lambda: Camera.from_opencv((9, 9, 1, 1), np.ones((3, 3)), (0, 0, 0), (64, 48))),
        ("R", lambda: Camera.from_opencv((9, 9, 1, 1), -np.eye(3), (0, 0, 0), (64, 48))),
        ("R", lambda: Camera.from_opencv((9, 9, 1, 1), np.zeros(4), (0, 0, 0), (64, 48))),
        ("R", lambda: Camera.from_opencv((9, 9, 1, 1), np.zeros(5), (0, 0, 0), (64, 48))),
        ("t", lambda: Camera.from_opencv((9, 9, 1, 1), np.eye(3), (0, 0), (64, 48))),
        ("pose", lambda: Camera.from_pose(np.eye(3))),
        ("pose", lambda: Camera.from_pose(np.ones((4, 4)))),
        ("axes", lambda: Camera.from_pose(np.eye(4), axes="maya")),
        ("points", lambda: camera(size=(9, 9)).project(np.zeros(3))),
        ("depth", lambda: camera(size=(9, 9)).unproject(np.zeros((9, 8)))),
        ("depth", lambda: camera(size=(9, 9)).unproject(np.zeros(3), np.zeros((2, 2)))),
        ("pixels", lambda: camera(size=(9, 9)).unproject(np.zeros(3), np.zeros((3, 3)))),
    ],
)
def test_invalid_cameras_are_rejected(pointer, make):
    with pytest.raises(alberti.AlbertiError) as caught:
        make()
    assert caught.value.pointer == pointer, caught.value


@pytest.mark.parametrize(
    ("pointer", "options"),
    [
        ("size", {"size": (0, 1)}),
        ("size", {"size": (10**6, 10**6)}),
        ("size", {"size": (1.5, 2)}),
        ("passes", {"passes": ("rgb", "deep")}),
        ("passes", {"passes": ("depth_ids",)}),
        ("passes", {"passes": 3}),
        ("style", {"style": "cubist"}),
        ("background", {"background": "plaid"}),
        ("samples", {"samples": 3}),
        ("threads", {"threads": -1}),
        ("camera", {"camera": 5}),
        ("direction", {"camera": "nowhere"}),
    ],
)
def test_invalid_render_options_are_rejected(teapot, pointer, options):
    with pytest.raises(alberti.AlbertiError) as caught:
        alberti.render(teapot, **options)
    assert caught.value.pointer == pointer, caught.value
    if "threads" not in options:
        with pytest.raises(alberti.AlbertiError):
            alberti.render_many([{"model": teapot, **options}])


# A pose that overflows when combined with itself.
FAR = [[1, 0, 0, 1.7e308], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]


def test_other_invalid_calls_are_rejected(teapot, tmp_path):
    for call in (
        lambda: alberti.load(tmp_path / "missing.glb"),
        lambda: alberti.load(b""),
        lambda: alberti.load(b"garbage", name="x.glb"),
        lambda: alberti.load(5),
        lambda: alberti.load("scene.ron"),
        lambda: alberti.load_scene(),
        lambda: alberti.load_scene(tmp_path / "missing.ron"),
        lambda: alberti.render(None),
        lambda: alberti.render(teapot).depth,
        lambda: alberti.render_many([{"model": teapot, "tint": "red"}]),
        lambda: alberti.render_many([{}]),
        lambda: alberti.explain(teapot, point=(1, 2)),
        lambda: alberti.explain(teapot, pixel=(10**6, 0)),
        lambda: alberti.explain(teapot, node="lid of another"),
        lambda: alberti.explain(teapot, point=(0, 0, 0), pixel=(0, 0)),
        lambda: alberti.explain(teapot, conventions="maya"),
        lambda: alberti.Scene([teapot], []),
        lambda: alberti.Scene([teapot], [np.zeros((4, 4))]),
        lambda: alberti.Scene(["teapot"]),
        lambda: alberti.Scene([alberti.Scene([teapot], [FAR])], [FAR]),
        lambda: alberti.draw(teapot).save("drawing.dwg"),
        lambda: Model.from_trimesh(5),
    ):
        with pytest.raises(alberti.AlbertiError) as caught:
            call()
        assert str(caught.value) and caught.value.code


def test_scene_mistakes_have_a_location_and_help():
    text = 'Scene(models: [(path: "x.glb")], camera: (view: LookAt(eye: (1, 2, 3), traget: (0, 0, 0))))'
    with pytest.raises(alberti.AlbertiError) as caught:
        alberti.load_scene(text=text)
    error = caught.value
    assert error.code == "SCENE_ERROR" and error.pointer.startswith("line 1, column ")
    assert "target" in str(error)
    assert pickle.loads(pickle.dumps(error)).pointer == error.pointer


def test_arrays_of_every_dtype_and_layout_are_read():
    expected = Model.from_arrays(SQUARE, [[0, 1, 2, 3]])
    picture = alberti.render(expected, size=(40, 30)).png()
    square = np.asarray(SQUARE)
    strided = np.zeros((8, 6))[::2, ::2]
    strided[:] = square
    kinds = [square.astype(kind) for kind in ("f2", "f4", ">f8", "i1", "u8", ">i2")]
    for vertices in [*kinds, strided, np.asfortranarray(square), tuple(map(tuple, SQUARE))]:
        for faces in ([[0, 1, 2, 3]], np.array([[0, 1, 2, 3]], ">u2"), ((0, 1, 2, 3),)):
            model = Model.from_arrays(vertices, faces)
            assert alberti.render(model, size=(40, 30)).png() == picture
    square.flags.writeable = False
    assert alberti.render(Model.from_arrays(square, [[0, 1, 2, 3]]), size=(40, 30)).png() == picture


def test_import_warnings_become_python_warnings(assets):
    broken = next(iter(sorted((assets / "meshes" / "obj").glob("space_in_material_name.obj"))))
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        model = alberti.load(
            broken.read_bytes().replace(b"usemtl", b"usemtl missing "), name="x.obj"
        )
    assert [str(w.message) for w in caught] == model.warnings[:8]
    assert caught and all(w.category is alberti.AlbertiWarning for w in caught)
    assert all(w.filename == __file__ for w in caught)


def test_other_threads_run_during_rendering(teapot):
    rendered = []

    def work():
        rendered.append(alberti.render(teapot, size=(2000, 1500), samples=16, threads=1))

    thread = threading.Thread(target=work)
    thread.start()
    steps = 0
    while thread.is_alive():
        steps += 1
        time.sleep(0.001)
    thread.join()
    assert rendered and steps > 10


def test_ctrl_c_cancels_a_picture():
    code = """
import alberti, os, signal, sys, threading, time
# Processes that a shell starts in the background ignore interrupts.
signal.signal(signal.SIGINT, signal.default_int_handler)
model = alberti.load(sys.argv[1])
main = os.getpid()
threading.Timer(0.3, lambda: os.kill(main, signal.SIGINT)).start()
begin = time.monotonic()
try:
    while True:
        alberti.render(model, size=(8000, 8000), samples=16, style="x-ray", threads=1)
except KeyboardInterrupt:
    print("stopped", time.monotonic() - begin < 20)
print(alberti.render(model, size=(8, 8)).rgb.shape)
"""
    from conftest import PROJECT

    model = PROJECT / "scenes" / "models" / "spheres.glb"
    done = subprocess.run(
        [sys.executable, "-c", code, str(model)], capture_output=True, text=True, timeout=300
    )
    assert done.stdout == "stopped True\n(8, 8, 3)\n", done.stderr
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler
