"""Cameras: position, lens, and the maps between points and pixels."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from . import _native

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    Size = tuple[int, int]


class Camera:
    """A camera: position, direction and lens.

    Create one with :meth:`look_at`, :meth:`frame`, :meth:`from_intrinsics`, :meth:`from_opencv`,
    :meth:`from_pytorch3d`, :meth:`from_pose` or :meth:`from_model`. Cameras are immutable.

    Lengths are in the units of the model, angles in degrees, sizes ``(width, height)`` in pixels.
    The world is right-handed, and y points up in glTF. Pixel coordinates are ``(column, row)``,
    and the *center* of the upper left pixel is ``(0, 0)``, as in OpenCV; arrays are indexed
    ``depth[row, column]``. Depth is measured from the eye along the view axis.

    Near and far planes are fitted to the model by default.
    """

    __slots__ = ("_native",)

    def __init__(self, native: _native.Camera) -> None:
        self._native = native

    @classmethod
    def look_at(
        cls,
        eye: ArrayLike,
        target: ArrayLike,
        up: ArrayLike = (0.0, 1.0, 0.0),
        *,
        fov_y: float | None = None,
        fov_x: float | None = None,
        height: float | None = None,
        size: Size | None = None,
        near: float | None = None,
        far: float | None = None,
    ) -> Camera:
        """Make a camera at ``eye`` that looks at ``target``.

        Args:
            eye: Position (3,) in world space.
            target: Point (3,) at the center of the picture.
            up: Direction (3,) that points up in the picture.
            fov_y: Vertical field of view in degrees; 35 by default.
            fov_x: Horizontal field of view in degrees, instead of ``fov_y``.
            height: Height of the view volume; makes the projection orthographic.
            size: Size of the pictures; required by :meth:`project` and similar methods.
            near: Distance of the near plane.
            far: Distance of the far plane.

        >>> camera = Camera.look_at((0, 0, 5), (0, 0, 0), fov_y=90, size=(640, 480))
        >>> camera.K.round(9).tolist()
        [[240.0, 0.0, 319.5], [0.0, 240.0, 239.5], [0.0, 0.0, 1.0]]
        """
        return cls(_native.make_camera(_given(locals())))

    @classmethod
    def frame(
        cls,
        direction: str | ArrayLike = "three-quarter",
        *,
        fov_y: float | None = None,
        orthographic: bool = False,
        padding: float | None = None,
        size: Size | None = None,
        near: float | None = None,
        far: float | None = None,
    ) -> Camera:
        """Make a camera at the distance at which the model just fits in the picture.

        Its position is known only after rendering: ``render(model, camera=…).camera``.

        Args:
            direction: ``front``, ``back``, ``left``, ``right``, ``top``, ``bottom``,
                ``three-quarter``, ``isometric``, ``dimetric`` or ``trimetric``; or a vector (3,)
                from the model to the camera.
            fov_y: Vertical field of view in degrees; 35 by default.
            orthographic: Whether the projection is parallel.
            padding: Margin on each side, in percent of the picture size; 5 by default.
            size: Size of the pictures.
            near: Distance of the near plane.
            far: Distance of the far plane.
        """
        return cls(_native.make_camera(_given(locals())))

    @classmethod
    def from_model(cls, camera: str | int = 0, *, size: Size | None = None) -> Camera:
        """Use a camera from the model file, by name or index."""
        options: dict[str, Any] = {"of_model": camera, "size": size}
        return cls(_native.make_camera(options))

    @classmethod
    def from_intrinsics(
        cls,
        K: ArrayLike,
        size: Size,
        *,
        pose: ArrayLike | None = None,
        axes: str = "opengl",
        pixel_centers: str = "integer",
        near: float | None = None,
        far: float | None = None,
    ) -> Camera:
        """Make a calibrated camera from its matrix K, for pictures of ``size``.

        Args:
            K: Matrix (3, 3) with fx, fy, cx, cy and skew in pixels, or (fx, fy, cx, cy).
            size: Size ``(width, height)`` of the pictures to which K applies.
            pose: Matrix (4, 4) or (3, 4) from the camera to the world; by default, the camera
                frames the model, like :meth:`frame`.
            axes: Directions of the camera axes in the pose; see :meth:`from_pose`.
            pixel_centers: ``integer``: the center of the first pixel is (0, 0), as in OpenCV; or
                ``half``: it is (½, ½), as in COLMAP and OpenGL.
            near: Distance of the near plane.
            far: Distance of the far plane.

        >>> camera = Camera.from_intrinsics((500, 500, 319.5, 239.5), (640, 480))
        >>> camera.size
        (640, 480)
        """
        return cls(_native.make_camera(_given(locals())))

    @classmethod
    def from_opencv(
        cls,
        K: ArrayLike,
        R: ArrayLike,
        t: ArrayLike,
        size: Size,
        *,
        pixel_centers: str = "integer",
        near: float | None = None,
        far: float | None = None,
    ) -> Camera:
        """Make a camera in the convention of OpenCV and COLMAP: camera = R · world + t.

        The camera's x axis points right, y down, z forward.

        Args:
            K: Matrix (3, 3), or (fx, fy, cx, cy). Distortion is not modeled: undistort first.
            R: Rotation (3, 3); or a rotation vector (3,) in radians, as returned by
                ``cv2.solvePnP``; or a quaternion (4,) w, x, y, z, as in COLMAP's ``images.txt``.
            t: Translation (3,): the world origin in camera coordinates.
            size: Size ``(width, height)`` of the pictures to which K applies.
            pixel_centers: ``integer`` for OpenCV, ``half`` for COLMAP.
            near: Distance of the near plane.
            far: Distance of the far plane.

        >>> import numpy as np
        >>> camera = Camera.from_opencv((500, 500, 319.5, 239.5), np.eye(3), (0, 0, 2), (640, 480))
        >>> pixels, depth = camera.project([(0, 0, 0)])
        >>> pixels.tolist(), depth.tolist()
        ([[319.5, 239.5]], [2.0])
        """
        return cls(_native.make_camera({**_given(locals()), "axes": "opencv"}))

    @classmethod
    def from_pytorch3d(
        cls,
        K: ArrayLike,
        R: ArrayLike,
        T: ArrayLike,
        size: Size,
        *,
        pixel_centers: str = "half",
        near: float | None = None,
        far: float | None = None,
    ) -> Camera:
        """Make a camera in the convention of PyTorch3D: row vectors, camera = world · R + T.

        The camera's x axis points left, y up, z forward.

        Args:
            K: Matrix (3, 3), or (fx, fy, cx, cy), in pixels (``in_ndc=False``).
            R: Rotation (3, 3).
            T: Translation (3,).
            size: Size ``(width, height)`` of the pictures to which K applies.
            pixel_centers: As for :meth:`from_intrinsics`.
            near: Distance of the near plane.
            far: Distance of the far plane.
        """
        options = _given(locals())
        options["t"] = options.pop("T")
        return cls(_native.make_camera({**options, "axes": "pytorch3d", "transposed": True}))

    @classmethod
    def from_pose(
        cls,
        pose: ArrayLike,
        *,
        axes: str = "opengl",
        fov_y: float | None = None,
        fov_x: float | None = None,
        height: float | None = None,
        size: Size | None = None,
        near: float | None = None,
        far: float | None = None,
    ) -> Camera:
        """Make a camera from its pose: a matrix (4, 4) or (3, 4) from the camera to the world.

        Args:
            pose: The matrix; its last column is the position of the eye.
            axes: ``opengl``: x right, y up, z backward, as in glTF, Blender, NeRF, pyrender and
                trimesh; ``opencv``: x right, y down, z forward; ``pytorch3d``: x left, y up,
                z forward.
            fov_y: Vertical field of view in degrees; 35 by default.
            fov_x: Horizontal field of view in degrees, instead of ``fov_y``.
            height: Height of the view volume; makes the projection orthographic.
            size: Size of the pictures.
            near: Distance of the near plane.
            far: Distance of the far plane.
        """
        return cls(_native.make_camera(_given(locals())))

    @property
    def size(self) -> Size | None:
        """Width and height of the pictures in pixels, if known."""
        return self._native.size

    @property
    def K(self) -> NDArray[np.float64]:
        """The intrinsic matrix K (3, 3), with pixel centers at integers."""
        return self._native.intrinsics()

    @property
    def R(self) -> NDArray[np.float64]:
        """The rotation (3, 3) from the world to the camera, with OpenCV axes."""
        return self._native.extrinsics("opencv")[0]

    @property
    def t(self) -> NDArray[np.float64]:
        """The translation (3,) from the world to the camera, with OpenCV axes."""
        return self._native.extrinsics("opencv")[1]

    @property
    def eye(self) -> NDArray[np.float64]:
        """The position (3,) in world space."""
        return self.pose()[:3, 3]

    @property
    def projection_matrix(self) -> NDArray[np.float64]:
        """The matrix (4, 4) from view space to clip space, in OpenGL's convention."""
        return self._native.projection_matrix()

    def extrinsics(self, axes: str = "opencv") -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Return R (3, 3) and t (3,) from world to camera; ``axes`` as for :meth:`from_pose`."""
        return self._native.extrinsics(axes)

    def pose(self, axes: str = "opengl") -> NDArray[np.float64]:
        """Return the matrix (4, 4) from camera to world; ``axes`` as for :meth:`from_pose`."""
        import numpy as np

        rotation, translation = self._native.extrinsics(axes)
        pose = np.eye(4)
        pose[:3, :3] = rotation.T
        pose[:3, 3] = -rotation.T @ translation
        return pose

    def project(self, points: ArrayLike) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Project points (N, 3) to pixel coordinates (N, 2), column and row, and depths (N,).

        Points that are not in front of the eye have a depth of at most 0; in perspective, their
        coordinates are NaN.
        """
        return self._native.project(points)

    def unproject(self, depth: ArrayLike, pixels: ArrayLike | None = None) -> NDArray[np.float64]:
        """Return the world points at the given depths along the view axis.

        Args:
            depth: Depths (height, width) of all pixels, like ``Frame.depth``; with ``pixels``, one
                per pixel (N,).
            pixels: Coordinates (N, 2), column and row; may be fractional.

        Returns:
            Points (height, width, 3) or (N, 3); NaN where the depth is infinite.

        >>> camera = Camera.look_at((0, 0, 5), (0, 0, 0), size=(640, 480))
        >>> pixels, depth = camera.project([(0.1, 0.2, 0.3)])
        >>> camera.unproject(depth, pixels).round(9).tolist()
        [[0.1, 0.2, 0.3]]
        """
        if pixels is None:
            return self._native.unproject_image(depth)
        return self._native.unproject_pixels(pixels, depth)

    def rays(self) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Return origins and unit directions (height, width, 3) of the rays through all pixels."""
        return self._native.rays()

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Camera) and self._native.equals(other._native)

    __hash__ = None  # type: ignore[assignment]

    def __reduce__(self) -> tuple[Any, ...]:
        return Camera._restore, (self._native.to_ron(), self.size is not None)

    @staticmethod
    def _restore(text: str, has_size: bool) -> Camera:
        """Return a camera from the scene file that was pickled."""
        return Camera(_native.camera_from_ron(text, has_size))

    def __repr__(self) -> str:
        try:
            eye = ", ".join(f"{x:.4g}" for x in self.eye)
        except Exception:
            return f"Camera(framed, size={self.size})"
        return f"Camera(eye=({eye}), size={self.size})"


def _given(arguments: dict[str, Any]) -> dict[str, Any]:
    """Return the arguments of a class method without the class."""
    del arguments["cls"]
    return arguments
