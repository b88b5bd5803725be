"""BOP: model poses and masks (Hodaň et al., 2018)."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from .._errors import AlbertiError
from .._render import render
from ._images import depth_png, mask_png
from ._masks import box

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from .._frame import Frame
    from .._model import Model
    from ._folder import Folder

#: The length of one depth code, in scene units.
DEPTH_SCALE = 0.001


class Bop:
    """One scene of a BOP data set: each model of a :class:`alberti.Scene` is an object.

    Copies of a model have the same ``obj_id``. Poses map from the model to the camera (OpenCV
    axes). Scene units are taken as meters and written as millimeters, as BOP requires, and depth
    codes are millimeters. ``mask`` shows a model as if nothing were in front of it.
    """

    passes = ("rgb", "depth", "model_ids")

    def __init__(self, folder: Folder, model: Model) -> None:
        import numpy as np

        self._folder = folder
        name, arguments = model._origin or ("", ())
        placed = list(zip(*arguments)) if name == "Scene" else [(model, np.eye(4))]
        self._models: list[Model] = [part for part, _ in placed]
        self._poses = [np.asarray(pose, dtype=np.float64) for _, pose in placed]
        for number, pose in enumerate(self._poses):
            if not np.allclose(pose[:3, :3] @ pose[:3, :3].T, np.eye(3), atol=1e-6):
                help = "BOP allows rotations and translations; scale the model itself"
                raise AlbertiError("is scaled or sheared", pointer=f"poses[{number}]", help=help)
        distinct: list[Model] = []
        for part in self._models:
            if not any(part is known for known in distinct):
                distinct.append(part)
        self._distinct = distinct
        self._cameras: dict[str, Any] = {}
        self._poses_of_image: dict[str, Any] = {}
        self._info: dict[str, Any] = {}

    def add(self, index: int, frame: Frame) -> None:
        """Write a frame's pictures and masks."""
        import numpy as np

        start = "test/000000"
        self._folder.write(f"{start}/rgb/{index:06}.png", frame.png())
        self._folder.write(f"{start}/depth/{index:06}.png", depth_png(frame.depth, DEPTH_SCALE))
        R, t = frame.camera.extrinsics("opencv")
        self._cameras[str(index)] = {
            "cam_K": frame.camera.K.ravel().tolist(),
            "cam_R_w2c": R.ravel().tolist(),
            "cam_t_w2c": (1000 * t).tolist(),
            "depth_scale": 1.0,
        }
        poses, info = [], []
        for number, (model, pose) in enumerate(zip(self._models, self._poses)):
            rotation, translation = R @ pose[:3, :3], R @ pose[:3, 3] + t
            poses.append(
                {
                    "cam_R_m2c": rotation.ravel().tolist(),
                    "cam_t_m2c": (1000 * translation).tolist(),
                    "obj_id": 1 + next(i for i, it in enumerate(self._distinct) if it is model),
                }
            )
            whole = self._whole_mask(model, pose, frame)
            visible = frame.model_ids == number + 1
            for kind, mask in (("mask", whole), ("mask_visib", visible)):
                self._folder.write(f"{start}/{kind}/{index:06}_{number:06}.png", mask_png(mask))
            measured = whole & np.isfinite(frame.depth)
            count, seen = int(whole.sum()), int(visible.sum())
            info.append(
                {
                    "bbox_obj": box(whole),
                    "bbox_visib": box(visible),
                    "px_count_all": count,
                    "px_count_valid": int(measured.sum()),
                    "px_count_visib": seen,
                    "visib_fract": seen / count if count else 0.0,
                }
            )
        self._poses_of_image[str(index)] = poses
        self._info[str(index)] = info

    def _whole_mask(self, model: Model, pose: NDArray[np.float64], frame: Frame) -> NDArray[np.bool_]:
        """Return the pixels of a model as if nothing were in front of it."""
        from .._model import Scene

        single = Scene([model], [pose])
        ids = render(single, camera=frame.camera, passes="model_ids", threads=1).model_ids
        return ids > 0

    def finish(self) -> None:
        """Write the poses, and the models with their sizes."""
        import numpy as np

        for name, content in (
            ("scene_camera", self._cameras),
            ("scene_gt", self._poses_of_image),
            ("scene_gt_info", self._info),
        ):
            self._folder.write_json(f"test/000000/{name}.json", content)
        sizes = {}
        for number, model in enumerate(self._distinct, 1):
            vertices = 1000 * np.asarray(model.vertices)
            low, high = vertices.min(axis=0), vertices.max(axis=0)
            sizes[str(number)] = {
                "diameter": _diameter(vertices),
                **{f"min_{axis}": float(value) for axis, value in zip("xyz", low)},
                **{f"size_{axis}": float(value) for axis, value in zip("xyz", high - low)},
            }
            self._folder.write(f"models/obj_{number:06}.ply", _ply(vertices, model.faces))
        self._folder.write_json("models/models_info.json", sizes)


def _diameter(vertices: NDArray[np.float64]) -> float:
    """Return the largest distance of two vertices.

    For many vertices, only those that are extreme in one of 1,000 directions are compared.
    """
    import numpy as np

    if len(vertices) > 1000:
        numbers = np.arange(1000) + 0.5
        y = 1 - 2 * numbers / 1000
        angle = numbers * 2.399963229728653
        radius = np.sqrt(1 - y * y)
        ways = np.stack([radius * np.cos(angle), y, radius * np.sin(angle)])
        vertices = vertices[np.unique((vertices @ ways).argmax(axis=0))]
    offsets = vertices[:, None] - vertices[None]
    return round(float(np.sqrt((offsets**2).sum(axis=2).max())), 9)


def _ply(vertices: NDArray[np.float64], faces: NDArray[np.uint32]) -> bytes:
    """Encode a mesh as binary PLY."""
    import numpy as np

    header = (
        "ply\nformat binary_little_endian 1.0\n"
        f"element vertex {len(vertices)}\n"
        "property float x\nproperty float y\nproperty float z\n"
        f"element face {len(faces)}\n"
        "property list uchar int vertex_indices\nend_header\n"
    )
    rows = np.zeros(len(faces), dtype=[("count", "u1"), ("corners", "<i4", 3)])
    rows["count"], rows["corners"] = 3, faces
    return header.encode() + vertices.astype("<f4").tobytes() + rows.tobytes()
