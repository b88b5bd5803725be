"""COLMAP's sparse models."""

from __future__ import annotations

import struct
from typing import TYPE_CHECKING, Any

from ._images import pixel_camera

if TYPE_CHECKING:
    from .._frame import Frame
    from .._model import Model
    from ._folder import Folder

#: The number of the model PINHOLE, whose parameters are fx, fy, cx and cy.
PINHOLE = 1
#: The maximum number of points.
MAX_POINTS = 10_000


class Colmap:
    """A sparse model in COLMAP's binary and text formats, with vertices of the model as points."""

    passes = ("rgb",)

    def __init__(self, folder: Folder, model: Model) -> None:
        self._folder = folder
        vertices = model.vertices
        # Every n-th vertex, so that the points are spread over the model.
        self._points = vertices[:: max(1, -(-len(vertices) // MAX_POINTS))].tolist()
        self._cameras: dict[tuple[Any, ...], int] = {}
        self._images: list[tuple[int, list[float], int, str]] = []

    def add(self, index: int, frame: Frame) -> None:
        """Write a frame's picture."""
        name = f"{index:06}.png"
        self._folder.write(f"images/{name}", frame.png())
        key = (*frame.size, *pixel_camera(frame))
        camera = self._cameras.setdefault(key, len(self._cameras) + 1)
        R, t = frame.camera.extrinsics("opencv")
        self._images.append((index + 1, [*_quaternion(R.tolist()), *t.tolist()], camera, name))

    def finish(self) -> None:
        """Write the cameras, images and points."""
        cameras = [(number, *key) for key, number in self._cameras.items()]
        self._write_text(cameras)
        binary = struct.pack("<Q", len(cameras))
        for number, width, height, *parameters in cameras:
            binary += struct.pack("<iiQQ4d", number, PINHOLE, width, height, *parameters)
        self._folder.write("sparse/0/cameras.bin", binary)
        parts = [struct.pack("<Q", len(self._images))]
        for number, pose, camera, name in self._images:
            parts.append(struct.pack("<i7di", number, *pose, camera) + name.encode() + b"\0")
            parts.append(struct.pack("<Q", 0))
        self._folder.write("sparse/0/images.bin", b"".join(parts))
        parts = [struct.pack("<Q", len(self._points))]
        for number, point in enumerate(self._points, 1):
            parts.append(struct.pack("<Q3d3BdQ", number, *point, 128, 128, 128, 0.0, 0))
        self._folder.write("sparse/0/points3D.bin", b"".join(parts))

    def _write_text(self, cameras: list[tuple[Any, ...]]) -> None:
        """Write the text files, which contain the same as the binary files."""
        lines = ["# CAMERA_ID, MODEL, WIDTH, HEIGHT, PARAMS[]"]
        for number, width, height, *parameters in cameras:
            lines.append(f"{number} PINHOLE {width} {height} {_numbers(parameters)}")
        self._write_lines("cameras", lines)
        lines = ["# IMAGE_ID, QW, QX, QY, QZ, TX, TY, TZ, CAMERA_ID, NAME; then POINTS2D[]"]
        for number, pose, camera, name in self._images:
            lines += [f"{number} {_numbers(pose)} {camera} {name}", ""]
        self._write_lines("images", lines)
        lines = ["# POINT3D_ID, X, Y, Z, R, G, B, ERROR, TRACK[]"]
        for number, point in enumerate(self._points, 1):
            lines.append(f"{number} {_numbers(point)} 128 128 128 0")
        self._write_lines("points3D", lines)

    def _write_lines(self, name: str, lines: list[str]) -> None:
        self._folder.write(f"sparse_text/{name}.txt", ("\n".join(lines) + "\n").encode())


def _numbers(values: list[float]) -> str:
    return " ".join(repr(float(value)) for value in values)


def _quaternion(R: list[list[float]]) -> list[float]:
    """Return the quaternion (w, x, y, z), with w ≥ 0, of a rotation matrix (Shepperd, 1978)."""
    squares = [
        1 + R[0][0] + R[1][1] + R[2][2],
        1 + R[0][0] - R[1][1] - R[2][2],
        1 - R[0][0] + R[1][1] - R[2][2],
        1 - R[0][0] - R[1][1] + R[2][2],
    ]
    # The products of the components; dividing by the largest component loses no digits.
    products = [
        [squares[0], R[2][1] - R[1][2], R[0][2] - R[2][0], R[1][0] - R[0][1]],
        [R[2][1] - R[1][2], squares[1], R[0][1] + R[1][0], R[0][2] + R[2][0]],
        [R[0][2] - R[2][0], R[0][1] + R[1][0], squares[2], R[1][2] + R[2][1]],
        [R[1][0] - R[0][1], R[0][2] + R[2][0], R[1][2] + R[2][1], squares[3]],
    ]
    row = products[squares.index(max(squares))]
    length = sum(part * part for part in row) ** 0.5 * (-1 if row[0] < 0 else 1)
    return [part / length for part in row]
