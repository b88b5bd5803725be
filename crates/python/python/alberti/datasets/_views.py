"""Cameras around a model."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from .._camera import Camera
from .._errors import AlbertiError

if TYPE_CHECKING:
    from collections.abc import Iterable

    from .._model import Model

    Size = tuple[int, int]


def turntable(
    model: Model,
    count: int = 36,
    *,
    elevation: float = 20.0,
    size: Size = (512, 512),
    fov_y: float = 35.0,
) -> list[Camera]:
    """Make cameras on a circle around a model, at equal angles, from the front counterclockwise.

    Args:
        model: The model at the center of every picture.
        count: Number of cameras.
        elevation: Angle above the horizontal plane in degrees, from -90 to 90.
        size: ``(width, height)`` of the pictures.
        fov_y: Vertical field of view in degrees.

    Every camera is at the same distance, from which the whole model is visible.
    """
    _check(count, size, fov_y)
    if not -90 <= elevation <= 90:
        raise AlbertiError(f"is {elevation}, expected -90 to 90", pointer="elevation")
    height, radius = _sin(elevation), _cos(elevation)
    angles = (360 * number / count for number in range(count))
    directions = ((radius * _sin(angle), height, radius * _cos(angle)) for angle in angles)
    return _around(model, directions, size, fov_y)


def hammersley(
    model: Model,
    count: int = 100,
    *,
    seed: int = 0,
    size: Size = (512, 512),
    fov_y: float = 35.0,
) -> list[Camera]:
    """Make cameras that are evenly distributed over a sphere around a model (Hammersley points).

    Args:
        model: The model at the center of every picture.
        count: Number of cameras.
        seed: Shifts the points, so that different seeds give different views.
        size: ``(width, height)`` of the pictures.
        fov_y: Vertical field of view in degrees.
    """
    _check(count, size, fov_y)
    # Shifts by multiples of the golden ratio's fraction are far apart for consecutive seeds.
    shift = (seed * 0.6180339887498949) % 1.0
    directions = []
    for number in range(count):
        y = 1 - (2 * number + 1) / count
        angle = 360 * ((_radical_inverse(number) + shift) % 1.0)
        radius = math.sqrt(1 - y * y)
        directions.append((radius * _sin(angle), y, radius * _cos(angle)))
    return _around(model, directions, size, fov_y)


def forward_facing(
    model: Model,
    count: int = 20,
    *,
    spread: float = 15.0,
    seed: int = 0,
    size: Size = (512, 512),
    fov_y: float = 35.0,
) -> list[Camera]:
    """Make cameras in front of a model, as of a person who moves the camera a little.

    Args:
        model: The model at the center of every picture.
        count: Number of cameras.
        spread: Maximum angle from the front in degrees, from 0 to 90.
        seed: Shifts the points, so that different seeds give different views.
        size: ``(width, height)`` of the pictures.
        fov_y: Vertical field of view in degrees.
    """
    _check(count, size, fov_y)
    if not 0 <= spread <= 90:
        raise AlbertiError(f"is {spread}, expected 0 to 90", pointer="spread")
    shift = (seed * 0.6180339887498949) % 1.0
    lowest = _cos(spread)
    directions = []
    for number in range(count):
        z = 1 - (1 - lowest) * (2 * number + 1) / (2 * count)
        angle = 360 * ((_radical_inverse(number) + shift) % 1.0)
        radius = math.sqrt(1 - z * z)
        directions.append((radius * _cos(angle), radius * _sin(angle), z))
    return _around(model, directions, size, fov_y)


def _check(count: int, size: Size, fov_y: float) -> None:
    if count < 1:
        raise AlbertiError(f"is {count}, expected at least 1", pointer="count")
    if len(tuple(size)) != 2 or min(size) < 1:
        raise AlbertiError(f"is {size}, expected (width, height)", pointer="size")
    if not 0 < fov_y < 180:
        raise AlbertiError(f"is {fov_y}, expected more than 0 and less than 180", pointer="fov_y")


def _around(
    model: Model, directions: Iterable[tuple[float, float, float]], size: Size, fov_y: float
) -> list[Camera]:
    """Make cameras in these directions from the center, whose pictures contain the model."""
    bounds = model.bounds
    if bounds is None:
        raise AlbertiError("is empty, so there is nothing to look at", pointer="model")
    low, high = bounds.tolist()
    center = [(a + b) / 2 for a, b in zip(low, high)]
    radius = math.sqrt(sum(((b - a) / 2) ** 2 for a, b in zip(low, high))) or 1.0
    # The bounding sphere fits in the narrower of the two angles, with a margin of 5 %.
    width, height = size
    narrow = math.tan(math.radians(fov_y) / 2) * min(1.0, width / height)
    distance = round(1.05 * radius * math.sqrt(1 + 1 / narrow**2), 9)
    cameras = []
    for direction in directions:
        eye = [at + distance * way for at, way in zip(center, direction)]
        # From straight above or below, north is up in the picture.
        up = (0, 1, 0) if abs(direction[1]) < 1 - 1e-9 else (0, 0, -1)
        cameras.append(Camera.look_at(eye, center, up, fov_y=fov_y, size=size))
    return cameras


def _sin(degrees: float) -> float:
    """Return a sine that is the same on every machine: the last digits depend on the C library."""
    return round(math.sin(math.radians(degrees)), 12)


def _cos(degrees: float) -> float:
    """Return a cosine that is the same on every machine."""
    return round(math.cos(math.radians(degrees)), 12)


def _radical_inverse(number: int) -> float:
    """Return the binary digits of a number, mirrored at the point (van der Corput)."""
    value, place = 0.0, 0.5
    while number:
        value += place * (number & 1)
        number, place = number >> 1, place / 2
    return value
