"""Compare ``alberti.mujoco.Renderer`` with MuJoCo's own renderer and with its rays."""

import hashlib
import json
import os
import re
import subprocess
import sys
from pathlib import Path

import alberti
import numpy as np
import pytest
from conftest import PROJECT
from mujoco_models import BALL, CLOTH, PRIMITIVES, SCENES, crowd

mujoco = pytest.importorskip("mujoco", reason="SKIPPED: mujoco is not installed")

from alberti.mujoco import Renderer  # noqa: E402

HEIGHT, WIDTH = 120, 160


def start(text, steps=0):
    """Return a model and its state after a few steps."""
    model = mujoco.MjModel.from_xml_string(text)
    data = mujoco.MjData(model)
    for _ in range(steps):
        mujoco.mj_step(model, data)
    mujoco.mj_forward(model, data)
    return model, data


def all_modes(renderer, data, camera=-1):
    """Return the colors, the segmentation and the depth."""
    renderer.update_scene(data, camera)
    colors = renderer.render()
    renderer.enable_segmentation_rendering()
    objects = renderer.render()
    renderer.enable_depth_rendering()
    depth = renderer.render()
    renderer.disable_depth_rendering()
    return colors, objects, depth


# Runs in another process, because the choice of OpenGL applies to the whole process.
THEIRS = """
import sys, mujoco, numpy as np
sys.path.insert(0, sys.argv[1])
from test_mujoco import HEIGHT, WIDTH, all_modes, start
from mujoco_models import SCENES
found = {}
for name, text in SCENES.items():
    for steps in (0, 40, 90):
        model, data = start(text, steps)
        with mujoco.Renderer(model, HEIGHT, WIDTH) as renderer:
            for mode, pixels in zip(("rgb", "seg", "depth"), all_modes(renderer, data)):
                found[f"{name}-{steps}-{mode}"] = pixels
np.savez(sys.argv[2], **found)
"""


@pytest.fixture(scope="module")
def theirs(tmp_path_factory):
    """Return pictures from MuJoCo's own renderer in OSMesa."""
    path = tmp_path_factory.mktemp("mujoco") / "theirs.npz"
    folder = str(Path(__file__).parent)
    places = [str(Path(alberti.__file__).parents[1]), os.environ.get("PYTHONPATH", "")]
    environment = {**os.environ, "MUJOCO_GL": "osmesa", "PYTHONPATH": os.pathsep.join(places)}
    command = [sys.executable, "-c", THEIRS, folder, str(path)]
    done = subprocess.run(command, env=environment, capture_output=True, text=True)
    if not path.exists():
        lines = done.stderr.strip().splitlines() or ["no message"]
        pytest.skip(f"SKIPPED: MuJoCo cannot render with OSMesa: {lines[-1]}")
    return dict(np.load(path))


@pytest.mark.parametrize("steps", [0, 40, 90])
@pytest.mark.parametrize("name", SCENES)
def test_pictures_match_those_of_mujoco(theirs, name, steps):
    model, data = start(SCENES[name], steps)
    with Renderer(model, HEIGHT, WIDTH) as renderer:
        colors, objects, depth = all_modes(renderer, data)
    expected = {mode: theirs[f"{name}-{steps}-{mode}"] for mode in ("rgb", "seg", "depth")}
    assert objects.dtype == np.int32 and depth.dtype == np.float32
    same = (objects == expected["seg"]).all(axis=-1)
    assert same.mean() >= 0.9995
    assert np.abs(depth - expected["depth"])[same].max() <= 1e-3 * expected["depth"].max()
    difference = np.abs(colors.astype(int) - expected["rgb"])
    assert difference.mean() < 6


@pytest.mark.parametrize("name", ["primitives", "terrain", "meshes", "crowd"])
def test_depth_and_ids_match_rays(name):
    model, data = start(SCENES[name], 30)
    with Renderer(model, 48, 64) as renderer:
        _, objects, depth = all_modes(renderer, data)
        eye, right_eye = renderer.scene.camera[0], np.array(renderer.scene.camera[1].pos)
    ahead, up = np.array(eye.forward, float), np.array(eye.up, float)
    across = np.cross(ahead, up)
    slope = eye.frustum_top / eye.frustum_near
    origin = (np.array(eye.pos, float) + right_eye) / 2
    agree = []
    for row in range(0, 48, 3):
        for column in range(0, 64, 3):
            x, y = (2 * (column + 0.5) / 64 - 1) * 64 / 48, 1 - 2 * (row + 0.5) / 48
            ray = ahead + slope * (x * across + y * up)
            hit = np.zeros(1, np.int32)
            along = mujoco.mj_ray(model, data, origin, ray, None, 1, -1, hit, None)
            found = objects[row, column]
            expected = hit[0] if 0 < along < eye.frustum_far else -1
            is_near = expected == -1 or abs(along - depth[row, column]) < 0.03 * along
            agree.append(found[0] == expected and is_near)
    # Rays meet exact spheres, and pictures show their facets.
    assert np.mean(agree) > 0.97


def test_missing_objects_are_background():
    model, data = start("<mujoco><worldbody/></mujoco>")
    with Renderer(model, 20, 30) as renderer:
        colors, objects, depth = all_modes(renderer, data)
        far = renderer.scene.camera[0].frustum_far
    assert not colors.any() and (objects == -1).all() and np.allclose(depth, far)


def test_calls_behave_as_in_mujoco():
    model, data = start(PRIMITIVES)
    renderer = Renderer(model, height=24, width=32)
    assert (renderer.height, renderer.width, renderer.model) == (24, 32, model)
    # MuJoCo moves infinite planes to where the camera was before.
    for _ in range(2):
        renderer.update_scene(data, "side")
    side = renderer.render()
    out = np.zeros((24, 32, 3), np.float64)
    assert renderer.render(out=out) is out and (out == side).all()
    renderer.update_scene(data, 0)
    assert (renderer.render() == side).all()
    renderer.update_scene(data)
    assert (renderer.render() != side).any()
    with pytest.raises(ValueError, match='camera "top" does not exist'):
        renderer.update_scene(data, "top")
    with pytest.raises(ValueError, match="out of range"):
        renderer.update_scene(data, 1)
    with pytest.raises(ValueError, match="out.shape"):
        renderer.render(out=np.zeros((24, 32)))
    renderer.close()
    with pytest.raises(RuntimeError, match="close"):
        renderer.render()


def test_options_and_added_geoms_are_drawn():
    model, data = start(BALL)
    with Renderer(model, 48, 64) as renderer:
        renderer.enable_segmentation_rendering()
        hidden = mujoco.MjvOption()
        hidden.geomgroup[:] = 0
        renderer.update_scene(data, scene_option=hidden)
        assert (renderer.render() == -1).all()
        renderer.disable_segmentation_rendering()
        renderer.update_scene(data)
        ball = renderer.render()
        scene = renderer.scene
        place, turn = np.array([0, 0, 0.2]), np.eye(3).ravel()
        red, size = np.array([1, 0, 0, 1], np.float32), np.array([0.4, 0.05, 0.05])
        box = int(mujoco.mjtGeom.mjGEOM_BOX)
        mujoco.mjv_initGeom(scene.geoms[scene.ngeom], box, size, place, turn, red)
        scene.ngeom += 1
        more = renderer.render()
    assert (more != ball).any() and (more[..., 0] > more[..., 1].astype(int) + 50).any()


def test_shadows_fall_and_can_be_turned_off():
    model, data = start(PRIMITIVES)
    with Renderer(model, HEIGHT, WIDTH) as renderer:
        renderer.update_scene(data)
        with_shadows = renderer.render().astype(int)
        renderer.scene.flags[int(mujoco.mjtRndFlag.mjRND_SHADOW)] = False
        without = renderer.render().astype(int)
    assert (without >= with_shadows - 2).mean() > 0.999
    assert 0.01 < (without - with_shadows > 20).any(axis=-1).mean() < 0.3


def test_moving_cloth_is_drawn_where_it_is():
    model, data = start(CLOTH)
    with Renderer(model, 48, 64) as renderer:
        renderer.enable_depth_rendering()
        renderer.update_scene(data)
        before = renderer.render()
        for _ in range(80):
            mujoco.mj_step(model, data)
        renderer.update_scene(data)
        assert np.abs(renderer.render() - before).max() > 0.02


def test_pictures_are_the_same_with_any_number_of_threads():
    model, data = start(PRIMITIVES, 20)
    digests = set()
    for threads in (1, 2, None):
        with Renderer(model, HEIGHT, WIDTH, threads=threads) as renderer:
            pixels = b"".join(array.tobytes() for array in all_modes(renderer, data))
            digests.add(hashlib.sha256(pixels).hexdigest())
    assert len(digests) == 1


LEAK = """
import json, sys, mujoco
sys.path.insert(0, sys.argv[1])
from mujoco_models import crowd
from alberti.mujoco import Renderer

def resident():
    with open("/proc/self/status") as file:
        return next(int(line.split()[1]) for line in file if line.startswith("VmRSS"))

model = mujoco.MjModel.from_xml_string(crowd(4))
data = mujoco.MjData(model)
sizes = []
with Renderer(model, 8, 8) as renderer:
    for frame in range(int(sys.argv[2])):
        mujoco.mj_step(model, data)
        renderer.update_scene(data)
        renderer.render()
        if frame % 1000 == 999:
            sizes.append(resident())
print(json.dumps(sizes))
"""


@pytest.mark.skipif(not Path("/proc/self/status").exists(), reason="SKIPPED: needs /proc")
def test_memory_stays_flat_over_ten_thousand_frames():
    folder = str(Path(__file__).parent)
    places = [str(Path(alberti.__file__).parents[1]), os.environ.get("PYTHONPATH", "")]
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(places)}
    command = [sys.executable, "-c", LEAK, folder, "10000"]
    done = subprocess.run(command, env=environment, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    sizes = json.loads(done.stdout)
    assert sizes[-1] - sizes[0] < 5 * 1024, f"resident kB: {sizes}"


def test_parts_of_a_frame_are_made_only_once(monkeypatch):
    from alberti import _mujoco_looks

    made = []
    build = _mujoco_looks._native.build_model

    class Counter:
        def __getattr__(self, name):
            return getattr(alberti._native, name)

        def build_model(self, *arguments):
            made.append(1)
            return build(*arguments)

    monkeypatch.setattr(_mujoco_looks, "_native", Counter())
    model, data = start(crowd())
    with Renderer(model, 16, 16) as renderer:
        renderer.update_scene(data)
        renderer.render()
        first = len(made)
        for _ in range(5):
            mujoco.mj_step(model, data)
            renderer.update_scene(data)
            renderer.render()
    assert first > 0 and len(made) == first


def test_the_package_does_not_import_mujoco():
    code = "import sys, alberti, alberti.mujoco, alberti.gym; print('mujoco' in sys.modules)"
    places = [str(Path(alberti.__file__).parents[1]), os.environ.get("PYTHONPATH", "")]
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(places)}
    command = [sys.executable, "-c", code]
    done = subprocess.run(command, env=environment, capture_output=True, text=True)
    assert done.stdout.strip() == "False", done.stderr


def test_page_example():
    page = (PROJECT / "docs" / "python.md").read_text()
    section = page.split("## Coming from MuJoCo")[1].split("\n## ")[0]
    codes = re.findall(r"```python\n(.*?)```", section, re.DOTALL)
    names = {}
    exec(codes[0], names)
    assert names["pixels"].shape == (240, 320, 3) and names["pixels"].any()
    assert names["depth"].dtype == np.float32 and names["objects"].shape == (240, 320, 2)


def test_gymnasium_observations_are_pictures():
    gymnasium = pytest.importorskip("gymnasium", reason="SKIPPED: gymnasium is not installed")
    from alberti.gym import wrap
    from gymnasium.wrappers import AddRenderObservation

    class Ball(gymnasium.Env):
        action_space = gymnasium.spaces.Discrete(2)
        observation_space = gymnasium.spaces.Discrete(2)

        def __init__(self):
            self.model, self.data = start(BALL)

        def reset(self, *, seed=None, options=None):
            super().reset(seed=seed)
            mujoco.mj_resetData(self.model, self.data)
            mujoco.mj_forward(self.model, self.data)
            return 0, {}

        def step(self, action):
            mujoco.mj_step(self.model, self.data)
            return 0, 0.0, False, False, {}

    environment = AddRenderObservation(wrap(Ball(), height=36, width=48))
    observation, _ = environment.reset(seed=1)
    assert observation.shape == (36, 48, 3) and observation.dtype == np.uint8
    assert observation.any() and environment.observation_space.contains(observation)
    observation, *_ = environment.step(1)
    assert observation.any()
    environment.close()
    with pytest.raises(alberti.AlbertiError, match="no MuJoCo model"):
        wrap(gymnasium.Env())
