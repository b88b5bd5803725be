"""The sky box of a MuJoCo scene, and the haze above the horizon."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _native
from ._mujoco_looks import _merge_corners, cube_coordinates, texture_image
from ._mujoco_shapes import unit_shape
from ._mujoco_view import head_of

if TYPE_CHECKING:
    from numpy.typing import NDArray

#: The distance of the sky, relative to the far plane.
_DISTANCE = 0.55
#: The number of segments around the horizon.
_SLICES = 48


class Sky:
    """The meshes around the camera, made once."""

    def __init__(self, mujoco: Any, model: Any) -> None:
        self._mujoco, self._model = mujoco, model
        self._box: _native.Subject | None = None
        self._haze: _native.Subject | None = None
        skies = np.nonzero(np.asarray(model.tex_type) == 2)[0]
        self._texture = int(skies[0]) if len(skies) else -1

    def parts(self, scene: Any) -> tuple[list[_native.Subject], NDArray[np.float64]]:
        """Return the meshes with their places; none without a sky."""
        flags = self._mujoco.mjtRndFlag
        if self._texture < 0 or not scene.flags[int(flags.mjRND_SKYBOX)]:
            return [], np.zeros((0, 4, 4))
        camera = scene.camera[0]
        distance = float(camera.frustum_far) * _DISTANCE
        head = head_of(scene)
        pose = np.eye(4)
        pose[:3, :3] *= distance
        pose[:3, 3] = head
        if self._box is None:
            self._box = self._make_box()
        subjects, poses = [self._box], [pose]
        if scene.flags[int(flags.mjRND_HAZE)]:
            hazy = self._haze_pose(scene, head, distance)
            if hazy is not None:
                if self._haze is None:
                    self._haze = self._make_haze()
                subjects.append(self._haze)
                poses.append(hazy)
        return subjects, np.array(poses)

    def _make_box(self) -> _native.Subject:
        """Return the sky box, seen from inside."""
        image, _ = texture_image(self._model, self._texture)
        box = unit_shape("box", 4, 4).vertices
        # The sky's y axis points up.
        turned = np.stack([box[:, 0], box[:, 2], -box[:, 1]], axis=1)
        uv = cube_coordinates(turned, image.shape[1])
        corners, indices = _merge_corners(np.concatenate([box, uv], axis=1))
        mesh = {
            "name": "sky",
            "vertices": corners[:, :3],
            "faces": indices.reshape(-1, 3),
            "uv": corners[:, 3:] * [1.0, -1.0] + [0.0, 1.0],
            "texture": image,
            "phong": {"unlit": True, "double_sided": True},
        }
        return _native.build_model([mesh], None, {"name": "sky"})

    def _make_haze(self) -> _native.Subject:
        """Return the haze: a ring from the horizon, where it is opaque, upward to nothing."""
        model = self._model
        width = max(float(model.vis.map.haze), 1e-3)
        alpha = math.atan2(1, width)
        height = math.sqrt(0.5) * width * math.sin(alpha) / math.sin(0.75 * math.pi - alpha)
        angles = np.arange(_SLICES + 1) * (2 * np.pi / _SLICES)
        rings = []
        for level in (0.0, height, 1.0):
            radius = 1 - width * (1 - level)
            ring = [radius * np.cos(angles), radius * np.sin(angles), np.full(len(angles), level)]
            rings.append(np.stack(ring, axis=1))
        count = len(angles)
        first = [row * count + at for row in range(2) for at in range(_SLICES)]
        faces = [[at, at + 1, at + count + 1, at + count] for at in first]
        color = np.array(model.vis.rgba.haze, float)
        colors = np.tile(color, (3 * count, 1))
        colors[:, 3] = np.repeat([0.0, 1.0, 0.0], count)
        mesh = {
            "name": "haze",
            "vertices": np.concatenate(rings),
            "faces": np.array(faces),
            "colors": _encode(colors),
            "phong": {"unlit": True, "double_sided": True, "blend": True},
        }
        return _native.build_model([mesh], None, {"name": "haze"})

    def _haze_pose(self, scene: Any, head: Any, distance: float) -> Any:
        """Return the place of the haze above the first infinite plane, or None without one."""
        for geom in scene.geoms[: scene.ngeom]:
            if geom.type != 0 or geom.size[0] != 0 or geom.size[1] != 0:
                continue
            rotation = np.array(geom.mat, np.float64)
            elevation = float((head - geom.pos) @ rotation[:, 2])
            if elevation <= 0:
                return None
            pose = np.eye(4)
            pose[:3, :3] = rotation * [distance, distance, elevation]
            pose[:3, 3] = head - rotation[:, 2] * elevation
            return pose
        return None


def _encode(colors: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the sRGB code of linear colors with alpha."""
    light = np.clip(colors[:, :3], 0, 1)
    encoded = np.where(light <= 0.0031308, 12.92 * light, 1.055 * light ** (1 / 2.4) - 0.055)
    return np.concatenate([np.clip(encoded, 0, 1), colors[:, 3:]], axis=1)
