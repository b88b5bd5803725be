"""Test cameras: round trips, conventions, and pixels compared with formulas and OpenCV."""

import alberti
import numpy as np
import pytest
from conftest import random_rotation

Camera = alberti.Camera


def random_K(rng, size, skew=True):
    width, height = size
    fx, fy = rng.uniform(0.4, 3, 2) * width
    cx, cy = rng.uniform(-0.3, 1.3, 2) * size
    return np.array([[fx, rng.uniform(-5, 5) * skew, cx], [0, fy, cy], [0, 0, 1.0]])


def random_camera(rng, skew=True):
    size = tuple(int(side) for side in rng.integers(16, 2000, 2))
    K = random_K(rng, size, skew)
    R, t = random_rotation(rng), rng.uniform(-5, 5, 3)
    return Camera.from_opencv(K, R, t, size), K, R, t


def points_ahead(rng, R, t, count=50):
    """Return world points in front of the camera."""
    inside = rng.uniform((-4, -4, 0.5), (4, 4, 20), (count, 3))
    return (inside - t) @ R


def test_intrinsics_and_extrinsics_round_trip():
    rng = np.random.default_rng(2)
    for _ in range(1000):
        camera, K, R, t = random_camera(rng)
        assert np.abs(camera.K - K).max() / np.abs(K).max() < 1e-12
        assert np.abs(camera.R - R).max() < 1e-12
        assert np.abs(camera.t - t).max() < 1e-12 * 20
        again = Camera.from_opencv(camera.K, camera.R, camera.t, camera.size)
        assert np.abs(again.K - K).max() / np.abs(K).max() < 1e-12


def test_projection_matches_its_formula():
    rng = np.random.default_rng(3)
    for _ in range(200):
        camera, K, R, t = random_camera(rng)
        points = points_ahead(rng, R, t)
        inside = points @ R.T + t
        expected = inside @ K.T
        pixels, depth = camera.project(points)
        assert np.abs(depth - inside[:, 2]).max() < 1e-9
        error = np.abs(pixels - expected[:, :2] / expected[:, 2:])
        assert (error / np.maximum(1, np.abs(pixels))).max() < 1e-10


def test_unproject_inverts_project():
    rng = np.random.default_rng(4)
    for number in range(300):
        if number % 3:
            camera, _, R, t = random_camera(rng)
        else:
            eye, height = rng.uniform(-5, 5, 3), rng.uniform(0.1, 20)
            camera = Camera.look_at(eye, (0.1, 0.2, 0.3), height=height, size=(300, 200))
            R, t = camera.R, camera.t
        points = points_ahead(rng, R, t)
        pixels, depth = camera.project(points)
        assert np.abs(camera.unproject(depth, pixels) - points).max() < 1e-9


def test_points_behind_the_eye_have_no_pixels():
    camera = Camera.look_at((0, 0, 5), (0, 0, 0), size=(64, 48))
    pixels, depth = camera.project([[0, 0, 6], [0, 0, 5], [0, 0, 4]])
    assert np.isnan(pixels[:2]).all() and pixels[2].tolist() == [31.5, 23.5]
    assert depth.tolist() == [-1, 0, 1]


def test_rays_pass_through_their_pixels():
    rng = np.random.default_rng(5)
    for number in range(20):
        camera = random_camera(rng)[0]
        if number % 2:
            camera = Camera.look_at(rng.uniform(1, 5, 3), (0, 0, 0), height=3, size=(50, 40))
        origins, directions = camera.rays()
        width, height = camera.size
        assert origins.shape == directions.shape == (height, width, 3)
        assert np.abs(np.linalg.norm(directions, axis=2) - 1).max() < 1e-12
        points = (origins + 3 * directions).reshape(-1, 3)[::97]
        pixels, _ = camera.project(points)
        rows, columns = np.divmod(np.arange(width * height)[::97], width)
        assert np.abs(pixels - np.stack([columns, rows], 1)).max() < 1e-7


def test_conventions_describe_the_same_camera():
    rng = np.random.default_rng(6)
    for _ in range(100):
        camera, K, R, t = random_camera(rng)
        flips = {"opencv": (1, 1, 1), "opengl": (1, -1, -1), "pytorch3d": (-1, -1, 1)}
        for axes, flip in flips.items():
            rotation, translation = camera.extrinsics(axes)
            assert np.abs(rotation - np.diag(flip) @ R).max() < 1e-12, axes
            assert np.abs(translation - np.array(flip) * t).max() < 1e-11, axes
            pose = camera.pose(axes)
            assert np.abs(pose[:3, :3] - rotation.T).max() < 1e-12
            same = Camera.from_intrinsics(K, camera.size, pose=pose, axes=axes)
            assert np.abs(same.R - R).max() < 1e-12 and np.abs(same.t - t).max() < 1e-11
        rotation, translation = camera.extrinsics("pytorch3d")
        same = Camera.from_pytorch3d(K, rotation.T, translation, camera.size)
        half = Camera.from_opencv(K, R, t, camera.size, pixel_centers="half")
        assert np.abs(same.K - half.K).max() < 1e-9 and np.abs(same.t - t).max() < 1e-11
        # COLMAP: the center of the first pixel is (½, ½).
        assert np.abs(half.K - K + [[0, 0, 0.5], [0, 0, 0.5], [0, 0, 0]]).max() < 1e-9


def test_rotation_vectors_and_quaternions():
    rng = np.random.default_rng(7)
    K, size = (500, 500, 320, 240), (640, 480)
    for angle in (0, 1e-12, 1e-3, 1, 3, np.pi, 5):
        axis = rng.normal(size=3)
        axis /= np.linalg.norm(axis)
        cross = np.cross(np.eye(3), axis)
        # Rodrigues' formula.
        R = np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross
        by_vector = Camera.from_opencv(K, axis * angle, (1, 2, 3), size)
        assert np.abs(by_vector.R - R).max() < 1e-12, angle
        quaternion = np.append(np.cos(angle / 2), np.sin(angle / 2) * axis) * 7
        by_quaternion = Camera.from_opencv(K, quaternion, (1, 2, 3), size)
        assert np.abs(by_quaternion.R - R).max() < 1e-12, angle


def test_projection_matrix_is_opengls():
    camera = Camera.look_at((0, 0, 5), (0, 0, 0), fov_y=60, size=(400, 300), near=0.5, far=20)
    f = 1 / np.tan(np.pi / 6)
    expected = np.array(
        [
            [f * 3 / 4, 0, 0, 0],
            [0, f, 0, 0],
            [0, 0, 20.5 / -19.5, 2 * 0.5 * 20 / -19.5],
            [0, 0, -1, 0],
        ]
    )
    assert np.abs(camera.projection_matrix - expected).max() < 1e-12


def test_framing_camera_has_no_position_before_rendering():
    camera = Camera.frame("front", size=(64, 48))
    with pytest.raises(alberti.AlbertiError, match="frame.camera"):
        camera.project([[0, 0, 0]])
    with pytest.raises(alberti.AlbertiError, match="size"):
        Camera.look_at((0, 0, 5), (0, 0, 0)).project([[0, 0, 0]])


def test_pixels_agree_with_opencv_and_the_picture():
    cv2 = pytest.importorskip("cv2", reason="SKIPPED: opencv-python-headless is not installed")
    rng = np.random.default_rng(8)
    worst = 0
    for number in range(1000):
        camera, K, R, t = random_camera(rng, skew=False)
        points = points_ahead(rng, R, t)
        vector = cv2.Rodrigues(R)[0]
        if number % 2:
            camera = Camera.from_opencv(K, vector, t.reshape(3, 1), camera.size)
        expected = cv2.projectPoints(points, vector, t, K, None)[0].reshape(-1, 2)
        worst = max(worst, np.abs(camera.project(points)[0] - expected).max())
    assert worst < 1e-6


def test_pictures_of_calibrated_cameras_agree_with_the_formula():
    """For 1,000 cameras and lens shifts, each pixel's position projects back to the pixel (with
    OpenCV if it is installed), and the centroid of a square's coverage matches its center.

    A square that faces the camera is also a square in the picture, so the centroid of its coverage
    is the projection of its center. It is rotated by a random angle, so that the quantization by 8
    samples averages out along its sides.
    """
    try:
        from cv2 import projectPoints
    except ImportError:
        projectPoints = None
    rng = np.random.default_rng(9)
    size, errors = (256, 192), []
    rows, columns = np.mgrid[: size[1], : size[0]]
    centers = np.stack([columns, rows], axis=-1)
    for _ in range(1000):
        K = np.array([[rng.uniform(150, 500), 0, 0], [0, rng.uniform(150, 500), 0], [0, 0, 1.0]])
        # A lens shift of up to several picture widths; the square stays in the picture.
        K[:2, 2] = rng.uniform(-600, 600, 2)
        R, t = random_rotation(rng), rng.uniform(-5, 5, 3)
        middle = rng.uniform((120, 90), (136, 102))
        angle = rng.uniform(0, 2 * np.pi) + np.arange(4) * np.pi / 2
        pixels = middle + rng.uniform(60, 85) * np.stack([np.cos(angle), np.sin(angle)], axis=1)
        inside = np.column_stack([(pixels - K[:2, 2]) / [K[0, 0], K[1, 1]], np.ones(4)])
        corners = (inside * rng.uniform(2, 9) - t) @ R
        model = alberti.Model.from_arrays(corners, [[0, 1, 2, 3]])
        camera = Camera.from_opencv(K, R, t, size)
        passes = ("coverage", "position", "ids")
        frame = alberti.render(model, camera=camera, passes=passes, samples=8, threads=1)

        weight = frame.coverage / frame.coverage.sum()
        errors.append([(weight * columns).sum(), (weight * rows).sum()] - middle)

        # Skip the diagonal of the square, where a pixel center may be just outside its triangle.
        whole = frame.coverage == 1
        for axis, step in ((0, 1), (0, -1), (1, 1), (1, -1)):
            whole &= np.roll(frame.ids, step, axis) == frame.ids
        points = frame.position[whole].astype(float)
        if projectPoints:
            found = projectPoints(points, R, t, K, None)[0].reshape(-1, 2)
        else:
            found = (points @ R.T + t) @ K.T
            found = found[:, :2] / found[:, 2:]
        assert np.abs(found - centers[whole]).max() < 0.01
    errors = np.abs(errors)
    assert np.sqrt((errors**2).mean()) < 0.005, np.sqrt((errors**2).mean())
    # If the sides run along rows and columns, the errors do not average out.
    assert np.quantile(errors, 0.98) < 0.02 and errors.max() < 1 / 15, errors.max()
