"""Data sets: views, files, and what the readers of other programs see in them."""

import json
import sys

import alberti
import numpy as np
import pytest
from alberti import datasets

CORNERS = [[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]
FACES = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
SIZE = (64, 48)


def moved(x):
    pose = np.eye(4)
    pose[0, 3] = x
    return pose


@pytest.fixture(scope="module")
def scene():
    """Return a scene of two equal cubes and a small red one between them."""
    cube = alberti.Model.from_arrays(CORNERS, FACES, name="cube")
    small = alberti.Model.from_arrays(np.multiply(CORNERS, 0.4), FACES, name="small", color="red")
    return alberti.Scene([cube, small, cube], [moved(-2), moved(0), moved(2)])


@pytest.fixture(scope="module")
def cameras(scene):
    return datasets.turntable(scene, 4, size=SIZE)


def written(tmp_path, scene, cameras, format):
    return datasets.write(tmp_path / format, scene, cameras, format=format)


def test_every_view_contains_the_whole_model(scene):
    for view in (
        *datasets.turntable(scene, 5, size=SIZE),
        *datasets.hammersley(scene, 9, seed=3, size=SIZE),
        *datasets.forward_facing(scene, 4, size=(48, 64)),
    ):
        mask = alberti.render(scene, camera=view, passes="ids").ids > 0
        assert mask.any()
        edge = (mask[0], mask[-1], mask[:, 0], mask[:, -1])
        assert not any(side.any() for side in edge)


def test_seeds_give_different_views_and_the_same_seed_gives_the_same(scene):
    def eyes(seed):
        return [view.eye.tolist() for view in datasets.hammersley(scene, 8, seed=seed, size=SIZE)]

    assert eyes(1) == eyes(1)
    assert eyes(1) != eyes(2)
    distances = np.linalg.norm(np.array(eyes(1)), axis=1)
    assert np.ptp(distances) < 1e-9


def test_the_same_views_have_the_same_bytes_and_changes_are_found(tmp_path, scene, cameras):
    for format in ("nerf", "colmap", "coco", "bop", "webdataset"):
        first = written(tmp_path / "a", scene, cameras, format)
        again = datasets.write(
            tmp_path / "b" / format, scene, cameras, format=format, threads=1
        )
        manifests = [(path / "manifest.json").read_bytes() for path in (first, again)]
        assert manifests[0] == manifests[1], format
        assert datasets.verify(first) == []
    names = sorted(path for path in first.iterdir() if path.suffix == ".tar")
    names[0].write_bytes(b"")
    (first / "new.txt").write_text("")
    faults = datasets.verify(first)
    assert faults == ["000000.tar has changed", "new.txt is not in the manifest"]


def test_a_failed_run_leaves_no_folder_and_an_old_one_is_kept(tmp_path, scene, cameras):
    without_size = alberti.Camera.look_at((0, 0, 9), (0, 0, 0))
    with pytest.raises(alberti.AlbertiError, match=r"cameras\[4\]: has no size"):
        datasets.write(tmp_path / "set", scene, [*cameras, without_size])
    assert list(tmp_path.iterdir()) == []
    with pytest.raises(alberti.AlbertiError, match="cameras: is empty"):
        datasets.write(tmp_path / "set", scene, [])
    (tmp_path / "set").mkdir()
    (tmp_path / "set" / "mine.txt").write_text("mine")
    with pytest.raises(alberti.AlbertiError, match="is not an empty folder"):
        datasets.write(tmp_path / "set", scene, cameras)
    with pytest.raises(alberti.AlbertiError, match="format: is 'kitti', expected one of nerf"):
        datasets.write(tmp_path / "new", scene, cameras, format="kitti")
    assert [path.name for path in tmp_path.rglob("*")] == ["set", "mine.txt"]


def decoded(path):
    """Decode a picture with Pillow or OpenCV, whichever is installed."""
    Image = pytest.importorskip("PIL.Image")
    return np.asarray(Image.open(path))


def test_nerf_depths_and_matrices_unproject_to_the_model(tmp_path, scene, cameras):
    folder = written(tmp_path, scene, cameras, "nerf")
    content = json.loads((folder / "transforms.json").read_text())
    unit = content["depth_unit_scale_factor"]
    assert len(content["frames"]) == 4
    for frame in content["frames"]:
        depth = decoded(folder / frame["depth_file_path"]).astype(float) * unit
        colors = decoded(folder / frame["file_path"])
        assert colors.shape == (48, 64, 4)
        rows, columns = np.nonzero(depth)
        assert len(rows) > 100
        assert (colors[rows, columns, 3] > 0).all()
        assert (depth[colors[..., 3] == 255] > 0).all()
        # The formulas of nerfstudio: pixel centers at halves, y up, looking along -z.
        z = depth[rows, columns]
        x = (columns + 0.5 - frame["cx"]) / frame["fl_x"] * z
        y = -(rows + 0.5 - frame["cy"]) / frame["fl_y"] * z
        points = np.stack([x, y, -z, np.ones_like(z)]).T @ np.array(frame["transform_matrix"]).T
        low, high = scene.bounds
        assert (points[:, :3] > low - 4 * unit).all()
        assert (points[:, :3] < high + 4 * unit).all()


def test_colmap_reads_its_model(tmp_path, scene, cameras):
    folder = written(tmp_path, scene, cameras, "colmap")
    pycolmap = pytest.importorskip("pycolmap")
    frames = [alberti.render(scene, camera=camera, passes="depth") for camera in cameras]
    for part in ("sparse/0", "sparse_text"):
        model = pycolmap.Reconstruction(str(folder / part))
        assert model.num_images() == 4
        assert model.num_points3D() == len(scene.vertices)
        for number, frame in enumerate(frames, 1):
            image = model.image(number)
            assert image.name == f"{number - 1:06}.png"
            point = scene.vertices[5]
            expected, _ = frame.camera.project([point])
            found = model.camera(image.camera_id).img_from_cam(image.cam_from_world() * point)
            assert np.allclose(found, np.ravel(expected) + 0.5, atol=1e-6)


def test_coco_masks_are_the_objects(tmp_path, scene, cameras):
    folder = written(tmp_path, scene, cameras, "coco")
    content = json.loads((folder / "annotations.json").read_text())
    names = {item["id"]: item["name"] for item in content["categories"]}
    assert set(names.values()) == {"cube", "small"}
    frames = [alberti.render(scene, camera=camera, passes="object_ids") for camera in cameras]
    coco = pytest.importorskip("pycocotools.coco").COCO(str(folder / "annotations.json"))
    for item in content["annotations"]:
        mask = coco.annToMask(item).astype(bool)
        seen = frames[item["image_id"] - 1].object_ids == item["object_id"]
        assert np.array_equal(mask, seen)
        left, top, width, height = item["bbox"]
        assert seen[top : top + height, left : left + width].sum() == seen.sum() == item["area"]


def test_bop_poses_place_the_models_where_they_are_seen(tmp_path, scene, cameras):
    folder = written(tmp_path, scene, cameras, "bop") / "test/000000"
    shots = json.loads((folder / "scene_camera.json").read_text())
    poses = json.loads((folder / "scene_gt.json").read_text())
    info = json.loads((folder / "scene_gt_info.json").read_text())
    assert [item["obj_id"] for item in poses["0"]] == [1, 2, 1]
    sizes = json.loads((folder.parents[1] / "models/models_info.json").read_text())
    assert sizes["1"]["diameter"] == pytest.approx(2000 * 3**0.5)
    assert sizes["2"]["size_x"] == pytest.approx(800)
    hidden = 0
    for image, objects in poses.items():
        K = np.array(shots[image]["cam_K"]).reshape(3, 3)
        for number, item in enumerate(objects):
            R, t = np.array(item["cam_R_m2c"]).reshape(3, 3), np.array(item["cam_t_m2c"])
            corners = 1000 * np.array(CORNERS) * (0.4 if item["obj_id"] == 2 else 1)
            at = (corners @ R.T + t) @ K.T
            at = at[:, :2] / at[:, 2:]
            left, top, width, height = info[image][number]["bbox_obj"]
            low, high = at.min(axis=0), at.max(axis=0)
            assert np.allclose(low, [left, top], atol=1.01)
            assert np.allclose(high, [left + width - 1, top + height - 1], atol=1.01)
            name = f"{int(image):06}_{number:06}.png"
            whole, seen = (decoded(folder / kind / name) > 0 for kind in ("mask", "mask_visib"))
            assert not (seen & ~whole).any()
            assert info[image][number]["px_count_visib"] == seen.sum()
            hidden += int((whole & ~seen).sum())
    assert hidden > 20, "from the side, cubes hide each other"


def test_bop_refuses_scaled_models(tmp_path, cameras):
    cube = alberti.Model.from_arrays(CORNERS, FACES, name="cube")
    scene = alberti.Scene([cube], [np.diag([2.0, 2.0, 2.0, 1.0])])
    with pytest.raises(alberti.AlbertiError, match=r"poses\[0\]: is scaled or sheared"):
        datasets.write(tmp_path / "set", scene, cameras, format="bop")


def test_webdataset_samples_are_the_frames(tmp_path, scene, cameras):
    folder = written(tmp_path, scene, cameras, "webdataset")
    webdataset = pytest.importorskip("webdataset")
    samples = list(webdataset.WebDataset(str(folder / "000000.tar"), shardshuffle=False))
    assert [sample["__key__"] for sample in samples] == [f"{number:06}" for number in range(4)]
    frame = alberti.render(scene, camera=cameras[2], passes=("rgb", "depth"), lights="world")
    assert samples[2]["rgb.png"] == frame.png()
    camera = json.loads(samples[2]["camera.json"])
    assert np.array_equal(camera["pose"], frame.camera.pose("opengl"))


def test_parquet_rows_hold_the_pictures(tmp_path, scene, cameras):
    parquet = pytest.importorskip("pyarrow.parquet")
    folder = written(tmp_path, scene, cameras, "parquet")
    rows = parquet.read_table(folder / "data.parquet").to_pylist()
    frame = alberti.render(scene, camera=cameras[1], lights="world")
    assert rows[1]["image"] == {"bytes": frame.png(), "path": "000001.png"}


def test_the_command_writes_and_verifies(tmp_path, capfd, monkeypatch):
    from alberti.datasets.__main__ import main

    monkeypatch.setattr(sys, "argv", [])
    model = tmp_path / "model.obj"
    model.write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    folder = str(tmp_path / "set")

    def run(*words):
        sys.argv = ["alberti.datasets", *words]
        code = main()
        out, err = capfd.readouterr()
        return code, out + err

    write = (str(model), folder, "--count", "2", "--size", "32x32")
    assert run(*write) == (0, f"2 views in {folder}\n")
    assert run(folder, "--verify") == (0, "intact\n")
    code, told = run(*write)
    assert code == 1
    assert "is not an empty folder; choose a new folder" in told
    (tmp_path / "set/transforms.json").unlink()
    assert run(folder, "--verify") == (1, "transforms.json is missing\n")


def test_depths_beyond_16_bits_are_an_error(tmp_path):
    model = alberti.Model.from_arrays([[0, 0, 0], [99, 0, 0], [0, 99, 0]], [[0, 1, 2]], name="big")
    with pytest.raises(alberti.AlbertiError, match="65535 depth units"):
        datasets.write(tmp_path / "set", model, datasets.turntable(model, 1), format="bop")
    assert list(tmp_path.iterdir()) == []
