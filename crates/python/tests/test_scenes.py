"""Ids and objects of scenes, lights, pickling, and the contents of models."""

import copy
import io
import pickle
import warnings

import alberti
import numpy as np
import pytest

CORNERS = [[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]]
ID_PASSES = ("ids", "model_ids", "object_ids", "node_ids", "mesh_ids", "material_ids")


def shifted(x):
    pose = np.eye(4)
    pose[0, 3] = x
    return pose


def square(name, **options):
    return alberti.Model.from_arrays(CORNERS, [[0, 1, 2, 3]], name=name, **options)



@pytest.fixture
def row():
    """Return a scene of a, b and a again, from left to right."""
    a, b = square("a"), square("b", color="red")
    return alberti.Scene([a, b, a], [shifted(x) for x in (-3, 0, 3)])


def front(row):
    pose = np.eye(4)
    pose[2, 3] = 5
    return alberti.render(
        row, camera=alberti.Camera.from_pose(pose, height=3), size=(90, 30), passes=ID_PASSES
    )


def test_ids_index_the_names_of_a_scene(row):
    frame = front(row)
    at = {name: [int(frame[name][15, x]) for x in (15, 45, 75)] for name in ID_PASSES}
    assert at["model_ids"] == at["object_ids"] == at["node_ids"] == [1, 2, 3]
    assert [row.nodes[id - 1] for id in at["node_ids"]] == ["a", "b", "a"]
    assert [row.meshes[id - 1] for id in at["mesh_ids"]] == ["a", "b", "a"]
    assert at["mesh_ids"] == [1, 2, 1] and len(row.meshes) == 2


def test_objects_are_a_table_of_ids(row, models):
    frame = front(row)
    assert frame.objects == row.objects
    assert [(o.id, o.model_id, o.model, o.node_id, o.path, o.mesh_id) for o in frame.objects] == [
        (1, 1, "a", 1, "a", 1),
        (2, 2, "b", 2, "b", 2),
        (3, 3, "a", 3, "a", 1),
    ]
    table = alberti.load(models / "crate.glb")
    scene = alberti.Scene([table, row, table])
    frame = alberti.render(scene, size=(200, 150), passes=ID_PASSES)
    for object_id in np.unique(frame.object_ids)[1:]:
        shown, here = frame.objects[object_id - 1], frame.object_ids == object_id
        for name in ("model", "node", "mesh"):
            assert (frame[f"{name}_ids"][here] == getattr(shown, f"{name}_id")).all()
        assert set(np.unique(frame.material_ids[here])) <= set(shown.material_ids)
        assert shown.path.split("/")[-1] == (scene.nodes[shown.node_id - 1] or "")
        assert shown.mesh == scene.meshes[shown.mesh_id - 1]


def test_instances_of_one_mesh_are_separate_objects(assets):
    model = alberti.load(assets / "models" / "simple-instancing" / "simple-instancing.glb")
    frame = alberti.render(model, size=(400, 300), passes=("object_ids", "node_ids"))
    assert len(model.objects) > 100
    assert len(np.unique(frame.object_ids)) > 50 and len(np.unique(frame.node_ids)) == 2


def test_faces_are_indexed_by_ids(row):
    frame = front(row)
    corners = row.vertices[row.faces[frame.ids[15, 45] - 1]]
    assert corners.shape == (3, 3) and np.abs(corners[:, 0]).max() == 1
    assert row.vertices[:, 0].min() == -4


def test_world_lights_do_not_follow_the_camera(models):
    ball = alberti.load(models / "primitives.glb")
    wall = square("wall", roughness=1)
    for lights, is_constant in (("world", True), (None, False)):
        codes = []
        for angle in (-60, -30, 0, 30, 60):
            eye = 6 * np.array([np.sin(np.radians(angle)), 0, np.cos(np.radians(angle))])
            camera = alberti.Camera.look_at(eye, (0, 0, 0))
            frame = alberti.render(wall, camera=camera, size=(64, 48), lights=lights)
            codes.append(int(frame.rgb[24, 32, 0]))
        assert (np.ptp(codes) <= 4) == is_constant, codes
    assert alberti.render(ball, size=(64, 48), lights="world").rgb.min() < 128


def test_world_lights_match_the_default_view(models):
    model = alberti.load(models / "teapot.glb")
    default, fixed = (alberti.render(model, size=(64, 48), lights=x) for x in (None, "world"))
    assert np.abs(default.rgb.astype(int) - fixed.rgb.astype(int)).max() <= 1


def test_lights_follow_their_formulas():
    matte = square("wall", color="white", roughness=1)
    camera = alberti.Camera.look_at((0, 0, 5), (0, 0, 0))

    def linear(*lights, **options):
        frame = alberti.render(matte, camera=camera, size=(33, 33), lights=lights, **options)
        code = frame.rgb[16, 16].astype(float) / 255
        return np.where(code <= 0.04045, code / 12.92, ((code + 0.055) / 1.055) ** 2.4)

    ambient = linear(alberti.AmbientLight(np.pi / 2))
    assert np.allclose(ambient, 0.5, atol=0.05)
    sun = linear(alberti.DirectionalLight((0, 0, -1), 1.5, color=(1, 0, 0)))
    assert sun[0] > 0.3 and (sun[1:] < 0.02).all()
    near = linear(alberti.PointLight(np.array([0, 0, 2.0]), 4))
    far = linear(alberti.PointLight((0, 0, 4), 4))
    assert near[0] / far[0] == pytest.approx(4, rel=0.06)
    inside = linear(alberti.SpotLight((0, 0, 2), (0, 0, -1), 4, outer_cone_degrees=10))
    outside = linear(alberti.SpotLight((0, 0, 2), (0, 1, -0.5), 4, outer_cone_degrees=10))
    assert inside[0] == pytest.approx(near[0], rel=0.02) and outside.max() == 0
    brighter = linear(alberti.DirectionalLight((0, 0, -1), 0.5), exposure=1)
    assert np.allclose(brighter, linear(alberti.DirectionalLight((0, 0, -1), 1)), atol=0.01)


def test_environment_shadows_and_ground_change_the_picture(models):
    crate = alberti.load(models / "crate.glb")
    sun = alberti.DirectionalLight((1, -1, -1), 3)

    def picture(**options):
        return alberti.render(crate, size=(80, 60), lights=[sun], **options).rgba.tobytes()

    pictures = [
        picture(),
        picture(environment="studio"),
        picture(environment=alberti.Environment("sky", sun=(1, 1, 0), strength=0.5)),
        picture(environment=alberti.Environment("uniform", color="red")),
        picture(ground=True),
        picture(ground=True, shadows=5.0),
        picture(tone_mapping="aces"),
    ]
    assert len(set(pictures)) == len(pictures)
    assert picture(environment="dark", ground=False) == pictures[0]


@pytest.mark.parametrize(
    ("options", "pointer"),
    [
        ({"lights": "sun"}, "lights"),
        ({"lights": [1]}, "lights[0]"),
        ({"lights": [alberti.DirectionalLight((0, 0), 1)]}, "lights[0]"),
        ({"lights": [alberti.PointLight((0, 0, 0), float("nan"))]}, "lights[0]"),
        ({"lights": [alberti.PointLight((0, 0, 0), -1)]}, "lights[0]"),
        ({"environment": "cave"}, "environment"),
        ({"environment": 3}, "environment"),
        ({"shadows": 40}, "shadows"),
        ({"ground": "low"}, "ground"),
        ({"exposure": "bright"}, "exposure"),
        ({"tone_mapping": "film"}, "tone_mapping"),
    ],
)
def test_wrong_light_options_are_errors(teapot, options, pointer):
    with pytest.raises(alberti.AlbertiError) as caught:
        alberti.render(teapot, size=(8, 8), **options)
    assert caught.value.pointer == pointer, caught.value
    assert "line 1" not in str(caught.value)


def test_unlit_surfaces_show_their_color():
    wall = square("wall", color=np.array([200, 100, 50], np.uint8), metallic=0.8)
    camera = alberti.Camera.look_at((1, 2, 4), (0, 0, 0))
    frame = alberti.render(wall, camera=camera, size=(33, 33), style="unlit", exposure=2)
    assert frame.rgb[16, 16].tolist() == [200, 100, 50]


def test_settings_of_a_scene_that_becomes_a_part_are_reported(models, teapot):
    lit = alberti.load_scene(models.parent / "lights.ron")
    with pytest.warns(alberti.AlbertiWarning, match=r"models\[0\].*lights"):
        alberti.Scene([lit, teapot])
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        alberti.Scene([teapot, teapot])


def test_everything_is_pickled(teapot, models, row):
    posed = alberti.load(models / "teapot.glb", unit="millimeter")
    meshes = [teapot, posed, row, alberti.load_scene(models.parent / "house.ron")]
    meshes.append(alberti.load((models / "teapot.glb").read_bytes()))
    for model in meshes:
        again = pickle.loads(pickle.dumps(model))
        assert type(again) is type(model) and again.objects == model.objects
        assert copy.deepcopy(model) is model and copy.copy(model) is model
        first, second = (alberti.render(m, size=(40, 30), passes=("rgb", "ids")) for m in (model, again))
        assert first.png() == second.png() and (first.ids == second.ids).all()
    frame = pickle.loads(pickle.dumps(first))
    assert frame.png() == first.png() and frame.camera == first.camera
    assert np.allclose(frame.camera.K, first.camera.K) and frame.objects == first.objects
    drawing = alberti.draw(teapot, camera="front", size=(60, 40), style="dashed")
    assert pickle.loads(pickle.dumps(drawing)).svg == drawing.svg
    assert repr(drawing).startswith("Drawing(60 x 40: ")


def test_arrays_that_change_later_do_not_change_a_pickled_model():
    corners = np.array(CORNERS, float)
    model = alberti.Model.from_arrays(corners, [[0, 1, 2], [0, 2, 3]])
    corners *= 7
    assert (pickle.loads(pickle.dumps(model)).bounds == model.bounds).all()


def test_cameras_are_compared_and_pickled():
    cameras = [
        alberti.Camera.look_at((1, 2, 3), (0, 0, 0)),
        alberti.Camera.look_at((1, 2, 3), (0, 0, 0), fov_y=50, size=(64, 48)),
        alberti.Camera.frame("front", orthographic=True),
        alberti.Camera.from_opencv((60, 61, 31, 23), np.eye(3), (0, 0.1, 3), (64, 48)),
    ]
    for number, camera in enumerate(cameras):
        again = pickle.loads(pickle.dumps(camera))
        assert again == camera and again.size == camera.size
        assert [camera == other for other in cameras] == [number == k for k in range(4)]
    assert camera != "front"
    assert (pickle.loads(pickle.dumps(camera)).K == camera.K).all()


def test_models_work_in_spawned_processes(teapot):
    from concurrent.futures import ProcessPoolExecutor
    from multiprocessing import get_context

    with ProcessPoolExecutor(1, get_context("spawn")) as pool:
        there = pool.submit(alberti.render, teapot, size=(40, 30)).result()
    assert there.png() == alberti.render(teapot, size=(40, 30)).png()


def test_frames_are_yielded_one_by_one(teapot):
    read = []

    def jobs():
        number = 0
        while True:
            read.append(number)
            camera = alberti.Camera.look_at((5, number / 10, 5), (0, 0, 0))
            yield {"model": teapot, "camera": camera, "size": (16, 12)}
            number += 1

    frames = alberti.render_each(jobs(), threads=2)
    first = [next(frames) for _ in range(5)]
    frames.close()
    assert len(read) < 12
    again = jobs()
    expected = alberti.render_many([next(again) for _ in range(5)])
    assert [frame.png() for frame in first] == [frame.png() for frame in expected]


@pytest.mark.parametrize("many", [alberti.render_many, alberti.render_each])
@pytest.mark.parametrize(
    ("wrong", "pointer"),
    [
        ({"size": (0, 1)}, "jobs[1].size"),
        ({"passes": ("depht",)}, "jobs[1].passes"),
        ({"style": "oil"}, "jobs[1].style"),
        ({"camera": 3}, "jobs[1].camera"),
        ({"model": 3}, "jobs[1].model"),
        ({"lights": "sun"}, "jobs[1].lights"),
        ({"colour": 3}, "jobs[1]"),
    ],
)
def test_errors_name_the_job(teapot, many, wrong, pointer):
    jobs = [{"model": teapot, "size": (8, 8)}, {"model": teapot, "size": (8, 8), **wrong}]
    with pytest.raises(alberti.AlbertiError) as caught:
        list(many(jobs))
    assert caught.value.pointer == pointer


def test_posed_models_match_loaded_ones(assets):
    path = assets / "models" / "morph-stress-test" / "MorphStressTest.gltf"
    model = alberti.load(path)
    names = [animation.name for animation in model.animations]
    assert len(names) == 3 and all(animation.duration > 0.5 for animation in model.animations)
    for time in (0.1, 0.4):
        posed = model.posed(names[1], time)
        loaded = alberti.load(path, animation=names[1], time=time)
        first, second = (alberti.render(m, size=(60, 40)) for m in (posed, loaded))
        assert first.png() == second.png() != alberti.render(model, size=(60, 40)).png()
        assert (posed.vertices != model.vertices).any()
    with pytest.raises(alberti.AlbertiError, match=names[1]):
        model.posed(names[1][:-1])


def test_an_empty_model_is_background():
    empty = alberti.Model.from_arrays(np.zeros((0, 3)))
    frame = alberti.render(empty, size=(8, 6), passes=("rgb", "depth", "ids"))
    assert (frame.rgb == 255).all() and not frame.mask.any() and not frame.ids.any()
    assert empty._repr_png_().startswith(b"\x89PNG")


def test_names_of_passes_are_the_names_of_arrays(teapot):
    frame = alberti.render(teapot, size=(8, 6), passes=("rgb", "view_normal", "object_ids"))
    assert list(frame) == ["rgb", "view_normal", "object_ids"] == list(frame.passes)
    assert all(frame[name].shape[:2] == (6, 8) for name in frame)
    assert "view_normal, object_ids" in repr(frame)
    with pytest.raises(alberti.AlbertiError, match="view_normal.*object_ids"):
        alberti.render(teapot, size=(8, 6), passes="view")
    for name in ("node_ids", "mesh_ids", "model_ids", "distance"):
        mask = alberti.render(teapot, size=(8, 6), passes=name).mask
        assert (mask == alberti.render(teapot, size=(8, 6), passes="depth").mask).all()
    with pytest.raises(alberti.AlbertiError, match="distinguishes"):
        alberti.render(teapot, size=(8, 6), passes="position").mask  # noqa: B018


def test_pictures_are_saved_as_png_only(teapot, tmp_path):
    frame = alberti.render(teapot, size=(8, 6))
    frame.save(tmp_path / "a.PNG")
    assert (tmp_path / "a.PNG").read_bytes() == frame.png()
    for name in ("a.jpg", "a.exr", "a.npz", "a"):
        with pytest.raises(alberti.AlbertiError, match=r"expected \.png"):
            frame.save(tmp_path / name)
        assert not (tmp_path / name).exists()


def test_sizes_and_backgrounds_may_be_lists_and_tuples(teapot):
    frame = alberti.render(teapot, size=[20, 10], background=(255, 0, 0))
    named = alberti.render(teapot, size=np.array([20, 10]), background="#f00")
    assert frame.png() == named.png()
    with pytest.raises(alberti.AlbertiError, match="background"):
        alberti.render(teapot, size=(20, 10), background=(255, 0, 256))


def test_a_missing_file_is_a_file_not_found_error(tmp_path):
    for load in (alberti.load, alberti.load_scene):
        with pytest.raises(FileNotFoundError) as caught:
            load(tmp_path / "none.glb")
        assert isinstance(caught.value, alberti.AlbertiError)
        assert "none.glb" in str(caught.value) and caught.value.errno == 2
        assert pickle.loads(pickle.dumps(caught.value)).filename == caught.value.filename


def test_files_keep_their_coordinates(tmp_path):
    text = "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 2 3\n"
    path = tmp_path / "a.stl"
    path.write_text(text + "endloop\nendfacet\nendsolid a\n")
    assert alberti.load(path).bounds[1].tolist() == [1, 2, 3]
    assert alberti.load(path, up="z").bounds.tolist() == [[0, 0, -2], [1, 3, 0]]
    with open(path, "rb") as file:
        assert alberti.load(file, name="a.stl").triangle_count == 1
    with open(path) as file, pytest.raises(alberti.AlbertiError, match="binary"):
        alberti.load(io.StringIO(file.read()))


def test_sixteen_samples_do_not_move_the_picture():
    """The centroid of the alpha of a disc is its projected center."""
    angles = np.linspace(0, 2 * np.pi, 300, endpoint=False)
    rng = np.random.default_rng(4)
    for samples in (4, 8, 16):
        errors = []
        for _ in range(20):
            x, y, radius = rng.uniform(20, 44), rng.uniform(20, 44), rng.uniform(8, 15)
            corners = np.stack([x + radius * np.cos(angles), 64 - (y + radius * np.sin(angles))], 1)
            disc = alberti.Model.from_arrays(
                np.column_stack([corners - 32, np.zeros(300)]), [list(range(300))]
            )
            camera = alberti.Camera.from_pose(
                [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 9]], height=64
            )
            alpha = alberti.render(disc, camera=camera, size=(64, 64), samples=samples).rgba[..., 3]
            weight = alpha.astype(float) / alpha.sum()
            rows, columns = np.mgrid[:64, :64] + 0.5
            errors.append([(weight * columns).sum() - x, (weight * rows).sum() - y])
        assert np.abs(np.mean(errors, axis=0)).max() < 0.015, samples


def test_the_package_has_its_version():
    assert alberti.__version__.count(".") == 2


def test_models_are_not_created_directly():
    with pytest.raises(alberti.AlbertiError, match="load"):
        alberti.Model()
    with pytest.raises(alberti.AlbertiError, match="list of models"):
        alberti.Scene(square("a"))
