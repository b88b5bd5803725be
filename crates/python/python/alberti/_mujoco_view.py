"""The camera, the lights and the fog of a MuJoCo scene."""

from __future__ import annotations

import json
import math
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _native

if TYPE_CHECKING:
    from numpy.typing import NDArray


#: The least texels along the side of a shadow map, and the most in all maps.
_LEAST_TEXELS = 128
_MOST_TEXELS = 1 << 26


def head_of(scene: Any) -> NDArray[np.float64]:
    """Return the position between the two eyes."""
    left, right = scene.camera[0], scene.camera[1]
    head: NDArray[np.float64] = 0.5 * (left.pos.astype(np.float64) + right.pos)
    return head


def camera_of(scene: Any, size: tuple[int, int]) -> _native.Camera:
    """Return the camera of a scene: the average of its two eyes."""
    left, right = scene.camera[0], scene.camera[1]
    eye, ahead, up = (
        (np.array(getattr(left, name), np.float64) + getattr(right, name)) / 2
        for name in ("pos", "forward", "up")
    )
    ahead /= np.linalg.norm(ahead)
    across = _cross(ahead, up)
    across /= np.linalg.norm(across)
    near, far = float(left.frustum_near), float(left.frustum_far)
    top, bottom = float(left.frustum_top), float(left.frustum_bottom)
    width, height = size
    options: dict[str, Any] = {"near": near, "far": far, "size": size}
    if left.orthographic:
        up = _cross(across, ahead)
        middle = (left.frustum_center + right.frustum_center) / 2
        eye = eye + across * middle + up * ((top + bottom) / 2)
        view = {"eye": eye, "target": eye + ahead, "up": up, "height": top - bottom}
        return _native.make_camera({**options, **view})
    half = float(left.frustum_width) or 0.5 * width / height * (top - bottom)
    center = (float(left.frustum_center) + float(right.frustum_center)) / 2
    pose = np.eye(4)
    pose[:3, 0], pose[:3, 1], pose[:3, 2] = across, _cross(across, ahead), -ahead
    pose[:3, 3] = eye
    lens = (
        0.5 * width * near / half,
        height * near / (top - bottom),
        0.5 * width * (1 - center / half),
        0.5 * height * (1 + (top + bottom) / (top - bottom)),
    )
    options.update(K=lens, pose=pose, axes="opengl", pixel_centers="half")
    return _native.make_camera(options)


def _cross(one: Any, other: Any) -> NDArray[np.float64]:
    """Return the cross product. NumPy's own function is slow for single vectors."""
    (a, b, c), (x, y, z) = one.tolist(), other.tolist()
    return np.array([b * z - c * y, c * x - a * z, a * y - b * x])


def highlight_ratio(scene: Any) -> float:
    """Return how bright the highlights of all lights are, relative to their diffuse light."""
    lights = scene.lights[: scene.nlight]
    diffuse = sum(float(light.diffuse.sum()) for light in lights)
    specular = sum(float(light.specular.sum()) for light in lights)
    return round(specular / diffuse, 2) if diffuse > 0 else 0.0


def lights_of(
    mujoco: Any, scene: Any, size: tuple[int, int], softness: float
) -> dict[str, Any]:
    """Return the lights and shadows as options of a picture of this size."""
    lights: list[dict[str, Any]] = []
    legacy: list[list[float]] = []
    count = scene.nlight
    # MuJoCo's own light for scenes without lights.
    ambient = np.zeros(3) if count else np.full(3, 0.3)
    has_shadows = bool(scene.flags[int(mujoco.mjtRndFlag.mjRND_SHADOW)])
    casters = sum(bool(light.castshadow) for light in scene.lights[:count]) * has_shadows
    # Finer maps than the picture would hardly show.
    texels = min(max(max(size), _LEAST_TEXELS), int(math.sqrt(_MOST_TEXELS / max(casters, 1))))
    for light in scene.lights[:count]:
        ambient = ambient + light.ambient
        strength = float(light.diffuse.max())
        if strength <= 0:
            continue
        direction = np.array(light.dir, np.float64)
        length = float(np.linalg.norm(direction))
        direction = direction / length if length > 1e-9 else np.array([0.0, 0.0, -1.0])
        side = texels if has_shadows and light.castshadow else 0
        is_sun = int(getattr(light, "type", 0)) == 1 or bool(getattr(light, "directional", False))
        if is_sun:
            shadows = {"On": {"softness_degrees": softness, "size": side}}
            described = {
                "direction": direction.tolist(),
                "color": (light.diffuse / strength).tolist(),
                "intensity": math.pi * strength,
                "shadows": shadows if side else "Off",
            }
            lights.append({"Directional": described})
            continue
        cutoff = math.cos(math.radians(min(float(light.cutoff), 180.0)))
        row = [*light.pos, *direction, *(math.pi * light.diffuse), *light.attenuation]
        legacy.append([*row, float(light.exponent), cutoff, side, math.radians(softness)])
    if ambient.max() > 0:
        strength = float(ambient.max())
        color = (ambient / strength).tolist()
        lights.append({"Ambient": {"intensity": math.pi * strength, "color": color}})
    options: dict[str, Any] = {"lights": [json.dumps(light) for light in lights]}
    if legacy:
        options["legacy_lights"] = np.array(legacy)
    return options


def without_shadows(options: dict[str, Any]) -> dict[str, Any]:
    """Return the options of lights that cast no shadows."""
    lights = []
    for text in options["lights"]:
        light = json.loads(text)
        for described in light.values():
            described.pop("shadows", None)
        lights.append(json.dumps(light))
    changed = {**options, "lights": lights, "shadows": '"Off"'}
    if "legacy_lights" in options:
        changed["legacy_lights"] = options["legacy_lights"].copy()
        changed["legacy_lights"][:, 14] = 0
    return changed


def fog_over(
    pixels: NDArray[np.uint8], depth: NDArray[np.float32], model: Any
) -> NDArray[np.uint8]:
    """Return a picture with linear fog."""
    extent, view = float(model.stat.extent), model.vis
    start, end = float(view.map.fogstart) * extent, float(view.map.fogend) * extent
    thickness = np.clip((depth - start) / max(end - start, 1e-9), 0, 1)[..., None]
    color = 255 * np.array(view.rgba.fog[:3])
    mixed = np.rint(pixels * (1 - thickness) + color * thickness)
    foggy: NDArray[np.uint8] = mixed.astype(np.uint8)
    return foggy
