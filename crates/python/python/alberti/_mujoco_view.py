"""The camera, the lights and the fog of a MuJoCo scene."""

from __future__ import annotations

import json
import math
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _native

if TYPE_CHECKING:
    from numpy.typing import NDArray


def camera_of(scene: Any, size: tuple[int, int]) -> _native.Camera:
    """Return the camera of a scene: the average of its two eyes."""
    left, right = scene.camera[0], scene.camera[1]
    eye, ahead, up = (
        (np.array(getattr(left, name), np.float64) + getattr(right, name)) / 2
        for name in ("pos", "forward", "up")
    )
    ahead /= np.linalg.norm(ahead)
    across = np.cross(ahead, up)
    across /= np.linalg.norm(across)
    near, far = float(left.frustum_near), float(left.frustum_far)
    top, bottom = float(left.frustum_top), float(left.frustum_bottom)
    width, height = size
    options: dict[str, Any] = {"near": near, "far": far, "size": size}
    if left.orthographic:
        up = np.cross(across, ahead)
        middle = (left.frustum_center + right.frustum_center) / 2
        eye = eye + across * middle + up * ((top + bottom) / 2)
        view = {"eye": eye, "target": eye + ahead, "up": up, "height": top - bottom}
        return _native.make_camera({**options, **view})
    half = float(left.frustum_width) or 0.5 * width / height * (top - bottom)
    center = (float(left.frustum_center) + float(right.frustum_center)) / 2
    pose = np.eye(4)
    pose[:3, 0], pose[:3, 1], pose[:3, 2] = across, np.cross(across, ahead), -ahead
    pose[:3, 3] = eye
    lens = (
        0.5 * width * near / half,
        height * near / (top - bottom),
        0.5 * width * (1 - center / half),
        0.5 * height * (1 + (top + bottom) / (top - bottom)),
    )
    options.update(K=lens, pose=pose, axes="opengl", pixel_centers="half")
    return _native.make_camera(options)


def highlight_ratio(scene: Any) -> float:
    """Return how bright the highlights of all lights are, relative to their diffuse light."""
    lights = scene.lights[: scene.nlight]
    diffuse = sum(float(light.diffuse.sum()) for light in lights)
    specular = sum(float(light.specular.sum()) for light in lights)
    return round(specular / diffuse, 2) if diffuse > 0 else 0.0


def lights_of(mujoco: Any, scene: Any, model: Any, softness: float) -> dict[str, Any]:
    """Return the lights and shadows as options of a picture."""
    lights: list[dict[str, Any]] = []
    count = scene.nlight
    # MuJoCo's own light for scenes without lights.
    ambient = np.zeros(3) if count else np.full(3, 0.3)
    has_shadows = bool(scene.flags[int(mujoco.mjtRndFlag.mjRND_SHADOW)])
    center = np.array(model.stat.center, np.float64)
    casts = False
    for light in scene.lights[:count]:
        ambient = ambient + light.ambient
        diffuse = np.array(light.diffuse, np.float64)
        strength = float(diffuse.max())
        if strength <= 0:
            continue
        is_caster = has_shadows and bool(light.castshadow)
        casts = casts or is_caster
        described: dict[str, Any] = {
            "color": (diffuse / strength).tolist(),
            "intensity": math.pi * strength,
            "shadows": {"On": {"softness_degrees": softness, "size": 1024}}
            if is_caster
            else "Off",
        }
        kind = _place(mujoco, light, described, center)
        lights.append({kind: described})
    if ambient.max() > 0:
        strength = float(ambient.max())
        color = (ambient / strength).tolist()
        lights.append({"Ambient": {"intensity": math.pi * strength, "color": color}})
    texts = [json.dumps(light) for light in lights]
    return {"lights": texts, "shadows": json.dumps({"On": {}} if casts else "Off")}


def _place(mujoco: Any, light: Any, described: dict[str, Any], center: Any) -> str:
    """Add the place and the direction of a light to its description, and return its kind."""
    direction = np.array(light.dir, np.float64)
    if np.linalg.norm(direction) < 1e-9:
        direction = np.array([0.0, 0.0, -1.0])
    is_sun = int(getattr(light, "type", 0)) == 1 or bool(getattr(light, "directional", False))
    if is_sun:
        described["direction"] = direction.tolist()
        return "Directional"
    position = np.array(light.pos, np.float64)
    described["position"] = position.tolist()
    # MuJoCo's lights have the same strength at every distance by default, and those of physics
    # have their strength at the distance of the model's center.
    distance = float(np.linalg.norm(center - position)) or 1.0
    constant, linear, square = (float(factor) for factor in light.attenuation)
    fall = max(constant + linear * distance + square * distance**2, 1e-6)
    described["intensity"] *= distance**2 / fall
    cutoff, exponent = float(light.cutoff), float(light.exponent)
    if cutoff >= 90:
        return "Point"
    described["direction"] = direction.tolist()
    described["outer_cone_degrees"] = cutoff
    described["inner_cone_degrees"] = 0.99 * cutoff if exponent < 0.5 else 0.0
    return "Spot"


def fog_over(
    pixels: NDArray[np.uint8], depth: NDArray[np.float32], model: Any
) -> NDArray[np.uint8]:
    """Return a picture with linear fog."""
    extent, view = float(model.stat.extent), model.vis
    start, end = float(view.map.fogstart) * extent, float(view.map.fogend) * extent
    thickness = np.clip((depth - start) / max(end - start, 1e-9), 0, 1)[..., None]
    # The sky has no fog.
    thickness = np.where(np.isfinite(depth)[..., None], thickness, 0)
    color = 255 * np.array(view.rgba.fog[:3])
    mixed: NDArray[np.uint8] = np.rint(pixels * (1 - thickness) + color * thickness).astype(np.uint8)
    return mixed
