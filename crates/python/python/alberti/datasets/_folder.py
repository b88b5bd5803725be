"""The folder of a data set: written completely or not at all, with a manifest of its files."""

from __future__ import annotations

import hashlib
import json
import os
import shutil
from pathlib import Path
from typing import Any

from .._errors import AlbertiError, MissingFileError

#: The name of the file that lists all others.
MANIFEST = "manifest.json"


class Folder:
    """A folder whose files appear at its final path only when all of them are complete."""

    def __init__(self, path: str | os.PathLike[str]) -> None:
        self.path = Path(path)
        if self.path.exists() and (not self.path.is_dir() or any(self.path.iterdir())):
            help = "choose a new folder, or remove this one"
            raise AlbertiError(f"{self.path} is not an empty folder", pointer="folder", help=help)
        self._part = self.path.with_name(f"{self.path.name}.{os.getpid()}.part")
        self._digests: dict[str, str] = {}

    def write(self, name: str, content: bytes) -> None:
        """Write a file; ``name`` is its path in the folder, with slashes."""
        target = self._part / name
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_bytes(content)
        self._digests[name] = hashlib.sha256(content).hexdigest()

    def write_json(self, name: str, content: Any) -> None:
        """Write a JSON file with the members in the given order."""
        self.write(name, (json.dumps(content, indent=1) + "\n").encode())

    def finish(self, description: dict[str, Any]) -> Path:
        """Write the manifest and move the folder to its path."""
        files = {name: self._digests[name] for name in sorted(self._digests)}
        self.write_json(MANIFEST, {**description, "sha256": files})
        if self.path.exists():
            self.path.rmdir()
        self._part.rename(self.path)
        return self.path

    def discard(self) -> None:
        """Remove the incomplete files."""
        shutil.rmtree(self._part, ignore_errors=True)


def verify(folder: str | os.PathLike[str]) -> list[str]:
    """Compare a data set with its manifest.

    Args:
        folder: A folder that :func:`write` returned, or a copy.

    Returns:
        One sentence for each file that is missing or has changed, and for each that does not
        belong to the data set. The list is empty if the data set is intact.

    Raises:
        MissingFileError: If there is no manifest.
    """
    path = Path(folder)
    manifest = path / MANIFEST
    if not manifest.is_file():
        raise MissingFileError(str(manifest))
    try:
        digests: dict[str, str] = json.loads(manifest.read_text(encoding="utf-8"))["sha256"]
    except (ValueError, KeyError, TypeError):
        message = f"{manifest} is not the manifest of a data set"
        raise AlbertiError(message, "INVALID_DATA", "folder") from None
    faults = []
    for name, digest in digests.items():
        file = path / name
        if not file.is_file():
            faults.append(f"{name} is missing")
        elif hashlib.sha256(file.read_bytes()).hexdigest() != digest:
            faults.append(f"{name} has changed")
    found = (file.relative_to(path).as_posix() for file in path.rglob("*") if file.is_file())
    known = {*digests, MANIFEST}
    faults += [f"{name} is not in the manifest" for name in sorted(found) if name not in known]
    return faults
