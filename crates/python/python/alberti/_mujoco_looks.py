"""Materials and textures of MuJoCo's geoms, as meshes that alberti renders."""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from . import _native
from ._mujoco_shapes import Shape

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

#: The axis along which each face of a cube looks, and the axes of its columns and rows, as numbers
#: from 1 with a sign.
_CUBE_FACES = ((1, -3, -2), (-1, 3, -2), (2, 1, 3), (-2, 1, -3), (3, 1, -2), (-3, -1, -2))


class Look(NamedTuple):
    """The appearance of a geom."""

    rgba: tuple[float, float, float, float]
    emission: float = 0.0
    #: Reflectance at normal incidence, and the exponent of the highlight.
    f0: float = 0.0
    exponent: float = 64.0
    #: The texture's number, or -1, with its repetitions.
    texture: int = -1
    repeat: tuple[float, float] = (1.0, 1.0)
    #: Sizes to which a uniform texture is scaled; None for other textures.
    uniform: tuple[float, float, float] | None = None
    is_unlit: bool = False
    is_double_sided: bool = False


@lru_cache(1)
def _encoded_bytes() -> NDArray[np.uint8]:
    """Return the sRGB code of each byte of linear light.

    MuJoCo multiplies the colors in its files by the light and displays the product, without a
    transfer function, so they are linear here.
    """
    light = np.arange(256) / 255
    encoded = np.where(light <= 0.0031308, 12.92 * light, 1.055 * light ** (1 / 2.4) - 0.055)
    codes: NDArray[np.uint8] = np.rint(255 * encoded).astype(np.uint8)
    return codes


def texture_image(model: Any, index: int) -> tuple[NDArray[np.uint8], bool]:
    """Return a texture's image (H, W, 4), and whether it is a cube of six images."""
    height, width = int(model.tex_height[index]), int(model.tex_width[index])
    channels = int(model.tex_nchannel[index]) if hasattr(model, "tex_nchannel") else 3
    data = model.tex_data if hasattr(model, "tex_data") else model.tex_rgb
    start = int(model.tex_adr[index])
    texels = np.asarray(data[start : start + height * width * channels])
    texels = texels.reshape(height, width, channels)
    image = np.full((height, width, 4), 255, np.uint8)
    if channels < 3:
        image[..., :3] = _encoded_bytes()[texels[..., :1]]
    else:
        image[..., :3] = _encoded_bytes()[texels[..., :3]]
        image[..., 3:] = texels[..., 3:4] if channels == 4 else 255
    # 0 is a flat image; 1 and 2 are cubes for geoms and for the sky.
    is_cube = int(model.tex_type[index]) != 0
    if is_cube and height == width:
        image = np.tile(image, (6, 1, 1))
    return image, is_cube


def cube_coordinates(directions: Floats, side: int) -> Floats:
    """Return coordinates (3 F, 2) in six images below each other, for corners of triangles.

    Each triangle uses the image that its center faces.
    """
    centers = directions.reshape(-1, 3, 3).mean(axis=1)
    faces = np.stack([np.sign(axis) * centers[:, abs(axis) - 1] for axis, _, _ in _CUBE_FACES])
    chosen = np.repeat(faces.argmax(axis=0), 3)
    axes = np.array(_CUBE_FACES)[chosen]

    def along(column: int) -> Floats:
        axis = axes[:, column]
        picked: Floats = np.sign(axis) * directions[np.arange(len(axis)), np.abs(axis) - 1]
        return picked

    depth = np.maximum(np.abs(along(0)), 1e-9)
    u, v = 0.5 + 0.5 * along(1) / depth, 0.5 + 0.5 * along(2) / depth
    margin = 0.5 / max(side, 1)
    u, v = np.clip(u, margin, 1 - margin), np.clip(v, margin, 1 - margin)
    return np.stack([u, (chosen + v) / 6], axis=1)


def _coordinates(shape: Shape, look: Look, is_cube: bool, side: int) -> Floats:
    """Return texture coordinates with (0, 0) at the upper left."""
    if shape.uv is not None:
        return shape.uv
    if is_cube:
        scale = np.array(look.uniform or (1.0, 1.0, 1.0))
        return cube_coordinates(shape.vertices * scale, side)
    repeat = np.array([0.5, -0.5]) * look.repeat
    return shape.vertices[:, :2] * repeat - 0.5


def build(name: str, shape: Shape, look: Look, model: Any) -> _native.Subject:
    """Make a mesh with a material."""
    red, green, blue, alpha = look.rgba
    phong: dict[str, Any] = {
        "diffuse": look.rgba,
        "emission": [look.emission * channel for channel in (red, green, blue)],
        "f0": look.f0,
        "roughness": min(1.0, (2 / (look.exponent + 2)) ** 0.25),
        "unlit": look.is_unlit,
        "blend": alpha < 0.995,
        "double_sided": look.is_double_sided,
    }
    mesh: dict[str, Any] = {"name": name, "phong": phong}
    columns = [shape.vertices, shape.normals]
    if look.texture >= 0 and not shape.is_lines:
        image, is_cube = texture_image(model, look.texture)
        columns.append(_coordinates(shape, look, is_cube, image.shape[1]))
        mesh["texture"] = image
    corners, indices = _merge_corners(np.concatenate(columns, axis=1))
    mesh["vertices"] = corners[:, :3]
    if shape.is_lines:
        phong["unlit"] = True
        mesh["lines"] = indices.reshape(-1, 2)
    else:
        mesh["normals"] = corners[:, 3:6]
        mesh["faces"] = indices.reshape(-1, 3)
    if "texture" in mesh:
        mesh["uv"] = corners[:, 6:] * [1.0, -1.0] + [0.0, 1.0]
    return _native.build_model([mesh], None, {"name": name})


def _merge_corners(corners: Floats) -> tuple[NDArray[np.float32], NDArray[np.int64]]:
    """Return the distinct corners, and the index of each corner among them."""
    # Adding 0 turns -0 into 0, so that equal numbers have equal bytes.
    rows = np.ascontiguousarray(corners, np.float32) + np.float32(0)
    keys = rows.view(np.dtype((np.void, rows.dtype.itemsize * rows.shape[1]))).ravel()
    _, first, inverse = np.unique(keys, return_index=True, return_inverse=True)
    return rows[first], inverse.reshape(-1)
