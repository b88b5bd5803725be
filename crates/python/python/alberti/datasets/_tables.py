"""Tables of samples: tar files for WebDataset, and Parquet."""

from __future__ import annotations

import hashlib
import io
import json
import tarfile
from typing import TYPE_CHECKING, Any

from .._errors import AlbertiError
from ._images import camera_json

if TYPE_CHECKING:
    from .._frame import Frame
    from .._model import Model
    from ._folder import Folder

#: The number of samples in a tar file.
SAMPLES_PER_FILE = 1000


class WebDataset:
    """Tar files with ``NUMBER.rgb.png``, ``NUMBER.depth.npy``, ``NUMBER.ids.npy`` and
    ``NUMBER.camera.json`` for each picture."""

    passes = ("rgb", "depth", "object_ids")

    def __init__(self, folder: Folder, model: Model) -> None:
        self._folder = folder
        self._members: list[tuple[str, bytes]] = []
        self._files = self._samples = 0

    def add(self, index: int, frame: Frame) -> None:
        """Add a sample to the current file."""
        import numpy as np

        def array(values: Any) -> bytes:
            content = io.BytesIO()
            np.save(content, values)
            return content.getvalue()

        self._members += [
            (f"{index:06}.rgb.png", frame.png()),
            (f"{index:06}.depth.npy", array(frame.depth)),
            (f"{index:06}.ids.npy", array(frame.object_ids)),
            (f"{index:06}.camera.json", json.dumps(camera_json(frame)).encode()),
        ]
        self._samples += 1
        if self._samples == SAMPLES_PER_FILE:
            self.finish()

    def finish(self) -> None:
        """Write the current file."""
        if not self._members:
            return
        content = io.BytesIO()
        # Members without times and owners have the same bytes everywhere.
        with tarfile.open(fileobj=content, mode="w", format=tarfile.USTAR_FORMAT) as tar:
            for name, data in self._members:
                member = tarfile.TarInfo(name)
                member.size = len(data)
                tar.addfile(member, io.BytesIO(data))
        self._folder.write(f"{self._files:06}.tar", content.getvalue())
        self._files, self._samples, self._members = self._files + 1, 0, []


class Parquet:
    """A table with a row for each picture; ``image`` is a struct as in Hugging Face ``datasets``."""

    passes = ("rgb",)

    def __init__(self, folder: Folder, model: Model) -> None:
        try:
            import pyarrow  # type: ignore[import-not-found,import-untyped,unused-ignore]
            import pyarrow.parquet  # type: ignore[import-not-found,import-untyped,unused-ignore]
        except ImportError:
            help = "install it with `pip install pyarrow`"
            raise AlbertiError("needs the package pyarrow", pointer="format", help=help) from None
        self._arrow: Any = pyarrow
        self._folder = folder
        self._rows: list[dict[str, Any]] = []

    def add(self, index: int, frame: Frame) -> None:
        """Add a row."""
        picture = frame.png()
        camera = camera_json(frame)
        self._rows.append(
            {
                "image": {"bytes": picture, "path": f"{index:06}.png"},
                "K": sum(camera["K"], []),
                "pose": sum(camera["pose"], []),
                "sha256": hashlib.sha256(picture).hexdigest(),
            }
        )

    def finish(self) -> None:
        """Write the table."""
        arrow = self._arrow
        image = arrow.struct([("bytes", arrow.binary()), ("path", arrow.string())])
        numbers = arrow.list_(arrow.float64())
        fields = [("image", image), ("K", numbers), ("pose", numbers), ("sha256", arrow.string())]
        table = arrow.Table.from_pylist(self._rows, schema=arrow.schema(fields))
        content = io.BytesIO()
        arrow.parquet.write_table(table, content)
        self._folder.write("data.parquet", content.getvalue())
