"""Make random valid and invalid calls: none of them may crash the process or leak memory.

    python fuzz_calls.py [CALLS] [SEED]

Every call either returns or raises `AlbertiError` (or `MemoryError`).
"""

import random
import sys
import warnings

import alberti
import numpy as np

SPECIAL = [0, 1, -1, 0.5, 1e-300, 1e300, float("nan"), float("inf"), 2**31, 2**64, None, "", "x"]
OBJECTS = [
    None,
    True,
    "front",
    b"glTF",
    [],
    {},
    (),
    object(),
    [[]],
    [[1], [2, 3]],
    3 + 4j,
    range(3),
]
KINDS = ["f2", "f4", "f8", ">f8", "i1", "u1", "i4", ">i8", "u8", "c8", "?", "O", "U3", "M8[s]"]


class Caller:
    """A source of random arguments, reproducible from a seed."""

    def __init__(self, seed):
        self.rng = random.Random(seed)
        self.numbers = np.random.default_rng(seed)
        self.models = [self.good_model()]
        self.cameras = [alberti.Camera.frame()]

    def pick(self, values):
        return self.rng.choice(values)

    def rare(self, part=0.1):
        return self.rng.random() < part

    def array(self, *shape):
        """Return an array of about this shape: mostly valid, sometimes with errors."""
        if self.rare(0.05):
            return self.pick(OBJECTS)
        if self.rare(0.1):
            shape = [self.pick([0, 1, 2, 3, 4, 5, side]) for side in shape]
        if self.rare(0.05):
            shape = shape[: self.pick([0, 1, 2])]
        array = self.numbers.normal(size=tuple(shape))
        if self.rare(0.1) and array.size:
            array.flat[self.rng.randrange(array.size)] = self.pick(SPECIAL[:8])
        if self.rare(0.15):
            with np.errstate(all="ignore"):
                try:
                    array = array.astype(self.pick(KINDS))
                except (ValueError, TypeError):
                    pass
        if self.rare(0.1) and array.ndim:
            array = np.repeat(array, 2, axis=0)[::2]
        if self.rare(0.1):
            array = np.asfortranarray(array)
        return array.tolist() if self.rare(0.2) else array

    def good_model(self):
        count = self.rng.randrange(3, 30)
        faces = self.numbers.integers(0, count, (self.rng.randrange(1, 40), 3))
        return alberti.Model.from_arrays(self.numbers.normal(size=(count, 3)), faces)

    def options(self, **known):
        """Return some of the options, occasionally with a wrong type."""
        chosen = {name: value() for name, value in known.items() if self.rare(0.4)}
        for name in chosen:
            if name != "passes" and self.rare(0.08):
                chosen[name] = self.pick(OBJECTS + SPECIAL)
        return chosen

    def size(self):
        sides = [1, 2, 7, 16, 33, 64]
        wrong = [(0, 1), (-5, 5), (10**7, 10**7), (2**70, 1), (8,), 8, "8x8", (1.5, 2)]
        return self.pick(wrong) if self.rare(0.1) else (self.pick(sides), self.pick(sides))

    def call_arrays(self):
        count, rows = self.rng.randrange(0, 20), self.rng.randrange(0, 20)
        faces = self.numbers.integers(-1 if self.rare(0.1) else 0, max(count, 1), (rows, 3))
        if self.rare(0.2):
            faces = [
                [self.rng.randrange(-1, 9) for _ in range(self.rng.randrange(7))] for _ in "abc"
            ]
        if self.rare(0.1):
            faces = self.array(rows, 3)
        options = self.options(
            normals=lambda: self.array(count, 3),
            colors=lambda: self.numbers.integers(0, 256, (self.pick([count, rows]), 4)),
            uv=lambda: self.array(count, 2),
            texture=lambda: self.numbers.integers(0, 256, (4, 5, 3)).astype("u1"),
            color=lambda: self.pick(["red", "#123", "no", (0.1, 0.2, 0.3), (300, 0, 0)]),
            metallic=lambda: self.pick(SPECIAL),
            roughness=lambda: self.pick(SPECIAL),
            crease=lambda: self.pick(SPECIAL + [30, 180, 181]),
            up=lambda: self.pick(["x", "y", "z", "Z", "w"]),
            limits=lambda: self.pick([{}, {"array_bytes": 10}, {"nodes": -1}, {1: 2}, {"x": 1}]),
        )
        model = alberti.Model.from_arrays(self.array(count, 3), faces, **options)
        self.models = [*self.models[-5:], model]
        model.bounds, repr(model), model.nodes, model.warnings

    def call_camera(self):
        lens = self.options(
            fov_y=lambda: self.pick(SPECIAL + [40, 179]),
            near=lambda: self.pick(SPECIAL),
            far=lambda: self.pick(SPECIAL),
            size=self.size,
        )
        K = np.array([[50, 0, 20], [0, 50, 20], [0, 0, 1.0]]) + self.numbers.normal(size=(3, 3)) * (
            self.rare(0.2)
        )
        rotation = np.linalg.qr(self.numbers.normal(size=(3, 3)))[0]
        Camera, array, size = alberti.Camera, self.array, self.size
        camera = self.pick(
            [
                lambda: Camera.look_at(array(3), array(3), array(3), **lens),
                lambda: Camera.frame(self.pick(["front", "top", "up", array(3)]), **lens),
                lambda: Camera.from_intrinsics(K, size()),
                lambda: Camera.from_intrinsics(array(3, 3), size(), pose=array(4, 4)),
                lambda: Camera.from_opencv(K, rotation, array(3), size()),
                lambda: Camera.from_opencv(K, array(self.pick([3, 4])), array(3), size()),
                lambda: Camera.from_pose(np.eye(4), **lens),
                lambda: Camera.from_pose(array(4, 4), axes=self.pick(["opencv", "z"]), **lens),
                lambda: Camera.from_model(self.pick([0, 1, "camera", -1, None])),
            ]
        )()
        self.cameras = [*self.cameras[-5:], camera]
        repr(camera), camera.size

    def call_maps(self):
        camera = self.pick(self.cameras)
        self.pick(
            [
                lambda: camera.project(self.array(5, 3)),
                lambda: camera.unproject(self.array(16, 16)),
                lambda: camera.unproject(self.array(5), self.array(5, 2)),
                lambda: camera.rays(),
                lambda: (camera.K, camera.R, camera.t, camera.eye, camera.projection_matrix),
                lambda: camera.pose(self.pick(["opengl", "opencv", "pytorch3d", "x"])),
            ]
        )()

    def render_options(self):
        names = "rgb depth distance normal position uv ids node_ids overdraw coverage x".split()
        return self.options(
            camera=lambda: self.pick(self.cameras + ["front", "nowhere"]),
            size=self.size,
            passes=lambda: [self.pick(names) for _ in range(self.rng.randrange(4))],
            style=lambda: self.pick(
                ["clay", "flat", "lines", "toon", "x-ray", "ids", "depth", "y"]
            ),
            background=lambda: self.pick(["white", "#123456", "transparent", "#12", "plaid"]),
            samples=lambda: self.pick([1, 4, 8, 16, 2]),
            threads=lambda: self.pick([1, 2, 3]),
        )

    def call_render(self):
        options = {"size": (24, 18), **self.render_options()}
        frame = alberti.render(self.pick(self.models), **options)
        self.cameras = [*self.cameras[-5:], frame.camera]
        if "depth" in options.get("passes", "rgb"):
            frame.points()
        elif "rgb" in options.get("passes", "rgb"):
            frame.png()

    def call_many(self):
        jobs = [{"model": self.pick(self.models), **self.render_options()} for _ in range(3)]
        for job in jobs:
            job.pop("threads", None)
            job.setdefault("size", (24, 18))
        alberti.render_many(jobs, threads=self.pick([1, 2, 3, 0, None]))

    def call_draw(self):
        options = self.render_options()
        for name in ("passes", "samples"):
            options.pop(name, None)
        drawing = alberti.draw(self.pick(self.models), **{"size": (40, 30), **options})
        drawing.svg, drawing.lines, drawing.pdf, drawing.dxf

    def call_explain(self):
        options = self.options(
            point=lambda: self.array(self.pick([3, 4])),
            segment=lambda: self.array(2, 3),
            pixel=lambda: self.pick([(0, 0), (5, 5), (99999, 0), (-1, 2), "a"]),
            node=lambda: self.pick([0, 1, "mesh", -1]),
            conventions=lambda: self.pick(["opengl", "vulkan", "x"]),
        )
        alberti.explain(self.pick(self.models), **options)

    def call_load(self):
        glb = b"glTF\x02\x00\x00\x00" + self.rng.randbytes(self.rng.randrange(60))
        stl = bytes(80) + b"\x01\x00\x00\x00" + self.rng.randbytes(self.pick([50, 49, 20]))
        obj = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 " + self.pick([b"3", b"4", b"-9", b"x"])
        text = self.pick(["Scene()", "Scene(models: [])", "Scene(", "x", 'Scene(style: "a")'])
        self.pick(
            [
                lambda: alberti.load(self.pick([glb, stl, obj, b"", self.rng.randbytes(40)])),
                lambda: alberti.load(obj, name="x.obj", time=self.pick([None, 1.0, "now"])),
                lambda: alberti.load(self.pick(["missing.glb", "/", "", "\0"])),
                lambda: alberti.load_scene(text=text),
                lambda: alberti.Scene(self.models[:2], self.array(2, 4, 4)),
            ]
        )()

    def call(self):
        calls = [
            self.call_arrays,
            self.call_arrays,
            self.call_camera,
            self.call_maps,
            self.call_render,
            self.call_render,
            self.call_many,
            self.call_draw,
            self.call_explain,
            self.call_load,
        ]
        try:
            self.pick(calls)()
        except (alberti.AlbertiError, MemoryError):
            return False
        return True


def main():
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 10_000
    caller = Caller(int(sys.argv[2]) if len(sys.argv) > 2 else 1)
    warnings.simplefilter("ignore")
    right = sum(caller.call() for _ in range(count))
    print(f"{count} calls: {right} returned, {count - right} raised")
    # If all calls were invalid, nothing would be tested.
    assert 0.2 < right / count < 0.95


if __name__ == "__main__":
    main()
