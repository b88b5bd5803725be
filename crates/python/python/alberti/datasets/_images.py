"""Encoders for the pictures in data sets."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from .. import _native
from .._errors import AlbertiError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from .._frame import Frame


def depth_png(depth: NDArray[np.float32], unit: float) -> bytes:
    """Encode depths as a 16-bit PNG in multiples of a unit; 0 is background."""
    import numpy as np

    codes = np.where(np.isfinite(depth), np.rint(depth.astype(np.float64) / unit), 0)
    if codes.max(initial=0) > 65535:
        help = "move the camera closer, or scale the model"
        raise AlbertiError("is farther than 65535 depth units", pointer="cameras", help=help)
    return _native.encode_gray_png(codes.astype(np.uint16))


def mask_png(mask: NDArray[np.bool_]) -> bytes:
    """Encode a mask as a PNG: white where it is set, black elsewhere."""
    import numpy as np

    return _native.encode_gray_png(np.where(mask, 65535, 0).astype(np.uint16))


def pixel_camera(frame: Frame) -> list[float]:
    """Return fx, fy, cx and cy in pixels, with pixel centers at halves, as in COLMAP."""
    K = frame.camera.K
    return [float(K[0, 0]), float(K[1, 1]), float(K[0, 2]) + 0.5, float(K[1, 2]) + 0.5]


def camera_json(frame: Frame) -> dict[str, Any]:
    """Return the camera of a frame: its matrix K, its pose (OpenGL axes), and the size."""
    return {
        "K": frame.camera.K.tolist(),
        "pose": frame.camera.pose("opengl").tolist(),
        "size": list(frame.size),
    }
