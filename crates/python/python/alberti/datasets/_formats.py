"""The formats of data sets."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from ._bop import Bop
from ._colmap import Colmap
from ._images import depth_png
from ._masks import Coco
from ._tables import Parquet, WebDataset

if TYPE_CHECKING:
    from .._frame import Frame
    from .._model import Model
    from ._folder import Folder


class Nerf:
    """``transforms.json`` as read by nerfstudio and instant-ngp.

    Matrices map from the camera to the world, and cameras look along -z (OpenGL). Pixel centers are
    at halves. Depths are 16-bit PNG files; ``depth_unit_scale_factor`` is the length of one code.
    """

    passes = ("rgb", "depth")

    def __init__(self, folder: Folder, model: Model) -> None:
        self._folder = folder
        bounds = model.bounds
        # The farthest depth is a few times the size of the model; codes have 16 bits.
        extent = 1.0 if bounds is None else float((bounds[1] - bounds[0]).max())
        self._unit = 10.0 ** _exponent(extent / 10_000)
        self._frames: list[dict[str, Any]] = []

    def add(self, index: int, frame: Frame) -> None:
        """Write a frame."""
        name = f"{index:06}.png"
        self._folder.write(f"images/{name}", frame.png())
        self._folder.write(f"depth/{name}", depth_png(frame.depth, self._unit))
        K, (width, height) = frame.camera.K, frame.size
        self._frames.append(
            {
                "file_path": f"images/{name}",
                "depth_file_path": f"depth/{name}",
                "transform_matrix": frame.camera.pose("opengl").tolist(),
                "fl_x": float(K[0, 0]),
                "fl_y": float(K[1, 1]),
                "cx": float(K[0, 2]) + 0.5,
                "cy": float(K[1, 2]) + 0.5,
                "w": width,
                "h": height,
            }
        )

    def finish(self) -> None:
        """Write ``transforms.json``."""
        scale = {"depth_unit_scale_factor": self._unit}
        self._folder.write_json(
            "transforms.json", {"camera_model": "OPENCV", **scale, "frames": self._frames}
        )


def _exponent(value: float) -> int:
    """Return the exponent of the smallest power of ten that is not less than a value."""
    return int(f"{value:e}".partition("e")[2]) + 1


FORMATS: dict[str, Any] = {
    "nerf": Nerf,
    "colmap": Colmap,
    "coco": Coco,
    "bop": Bop,
    "webdataset": WebDataset,
    "parquet": Parquet,
}
