"""The exception and warning types of the package."""

from __future__ import annotations

import errno
import warnings as _warnings
from collections.abc import Iterable


class AlbertiError(Exception):
    """Raised by every function for invalid input.

    Attributes:
        code: Kind of error, for use in code: ``INVALID_ARGUMENT`` for an argument,
            ``SCENE_ERROR`` for a mistake in a scene or a camera, ``LIMIT_EXCEEDED``,
            ``IO_ERROR``, or an importer code such as ``INVALID_DATA`` for an error
            in a file.
        pointer: Location: the argument (``faces[3, 1]``), or the position in a file: a JSON
            pointer in glTF, otherwise ``line 4, column 2``. May be empty.
        help: Suggested remedy, or None.
    """

    code: str
    pointer: str
    help: str | None

    def __init__(
        self,
        message: str,
        code: str = "INVALID_ARGUMENT",
        pointer: str = "",
        help: str | None = None,
    ) -> None:
        super().__init__(message, code, pointer, help)
        self.message = message
        self.code = code
        self.pointer = pointer
        self.help = help

    def __str__(self) -> str:
        text = f"{self.pointer}: {self.message}" if self.pointer else self.message
        if self.help and self.help not in self.message:
            text = f"{text}; {self.help}"
        return text


class MissingFileError(AlbertiError, FileNotFoundError):
    """A file does not exist; also a ``FileNotFoundError``."""

    def __init__(self, path: str) -> None:
        super().__init__(f"there is no file {path}", "FILE_NOT_FOUND", "source")
        self.errno = errno.ENOENT
        self.filename = path

    def __reduce__(self) -> tuple[type[MissingFileError], tuple[str]]:
        return MissingFileError, (self.filename,)


class AlbertiWarning(UserWarning):
    """Part of a file was skipped or corrected, or part of a picture is missing."""


_MOST_WARNINGS = 8


def warn_all(messages: Iterable[str], stacklevel: int = 3) -> None:
    """Warn with the first few messages, and then with the number of remaining ones."""
    messages = list(messages)
    for message in messages[:_MOST_WARNINGS]:
        _warnings.warn(message, AlbertiWarning, stacklevel=stacklevel + 1)
    rest = len(messages) - _MOST_WARNINGS
    if rest > 0:
        _warnings.warn(f"{rest} more warnings", AlbertiWarning, stacklevel=stacklevel + 1)
