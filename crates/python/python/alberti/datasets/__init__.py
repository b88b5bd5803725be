"""Data sets: views of a model, written in the formats of other programs.

Cameras come from :func:`turntable`, :func:`hammersley` or :func:`forward_facing`, or from anywhere
else. :func:`write` renders them and writes a folder, and :func:`verify` checks that its files are
still what was written. The same model, cameras and options give the same bytes on every machine.

>>> import tempfile
>>> from alberti import Model, datasets
>>> model = Model.from_arrays([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
>>> cameras = datasets.turntable(model, 4, size=(32, 32))
>>> with tempfile.TemporaryDirectory() as parent:
...     folder = datasets.write(f"{parent}/set", model, cameras, format="nerf")
...     sorted(path.name for path in folder.iterdir()), len(datasets.verify(folder))
(['depth', 'images', 'manifest.json', 'transforms.json'], 0)

======================  =======================================================================
format                  contents
======================  =======================================================================
``nerf``                ``transforms.json`` of nerfstudio and instant-ngp, with depth maps
``colmap``              a sparse model in COLMAP's binary and text formats
``coco``                boxes and masks of objects (COCO), of their visible parts
``bop``                 model poses and masks (BOP)
``webdataset``          tar files with samples for WebDataset
``parquet``             a table for Hugging Face ``datasets`` (needs ``pyarrow``)
======================  =======================================================================
"""

from ._folder import verify
from ._views import forward_facing, hammersley, turntable
from ._write import write

__all__ = ["forward_facing", "hammersley", "turntable", "verify", "write"]
