"""COCO: boxes and masks of the visible parts of objects."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from .._frame import Frame
    from .._model import Model
    from ._folder import Folder


class Coco:
    """``annotations.json`` with an annotation for each visible object of each picture.

    Categories are the meshes by name. Masks are run lengths, column by column.
    """

    passes = ("rgb", "object_ids")

    def __init__(self, folder: Folder, model: Model) -> None:
        self._folder = folder
        self._names = {item.id: item.mesh or item.path or item.model for item in model.objects}
        names = sorted(set(self._names.values()))
        self._categories = {name: number for number, name in enumerate(names, 1)}
        self._images: list[dict[str, Any]] = []
        self._annotations: list[dict[str, Any]] = []

    def add(self, index: int, frame: Frame) -> None:
        """Write a frame's picture and keep its annotations."""
        name = f"{index:06}.png"
        self._folder.write(f"images/{name}", frame.png())
        width, height = frame.size
        image = {"id": index + 1, "file_name": f"images/{name}", "width": width, "height": height}
        self._images.append(image)
        for number, category in self._names.items():
            mask = frame.object_ids == number
            if mask.any():
                self._annotations.append(
                    {
                        "id": len(self._annotations) + 1,
                        "image_id": index + 1,
                        "category_id": self._categories[category],
                        "object_id": number,
                        "bbox": box(mask),
                        "area": int(mask.sum()),
                        "iscrowd": 0,
                        "segmentation": {"size": [height, width], "counts": run_lengths(mask)},
                    }
                )

    def finish(self) -> None:
        """Write the annotations."""
        categories = [{"id": number, "name": name} for name, number in self._categories.items()]
        self._folder.write_json(
            "annotations.json",
            {"images": self._images, "annotations": self._annotations, "categories": categories},
        )


def box(mask: NDArray[np.bool_]) -> list[int]:
    """Return the bounding box of a mask: left, top, width and height; -1 and 0 if it is empty."""
    columns, rows = mask.any(axis=0).nonzero()[0], mask.any(axis=1).nonzero()[0]
    if len(columns) == 0:
        return [-1, -1, 0, 0]
    left, top = int(columns[0]), int(rows[0])
    return [left, top, int(columns[-1]) + 1 - left, int(rows[-1]) + 1 - top]


def run_lengths(mask: NDArray[np.bool_]) -> list[int]:
    """Return the lengths of the runs of a mask, column by column; the first run is unset."""
    import numpy as np

    flat = mask.ravel(order="F")
    changes = np.flatnonzero(flat[1:] != flat[:-1]) + 1
    ends = [0, *changes.tolist(), flat.size]
    lengths = [after - before for before, after in zip(ends, ends[1:])]
    return [0, *lengths] if flat[0] else lengths
