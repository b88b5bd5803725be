"""The scene of a MuJoCo renderer: geoms of an ``mjvScene`` as placed meshes, and its passes."""

from __future__ import annotations

from collections import OrderedDict
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _native
from ._mujoco_looks import Look, build
from ._mujoco_shapes import (
    PLACEMENTS,
    Placement,
    Shape,
    flex_shape,
    height_field_shape,
    mesh_shape,
    skin_shape,
    unit_shape,
)
from ._mujoco_sky import Sky
from ._mujoco_view import camera_of, fog_over, head_of, highlight_ratio, lights_of, without_shadows

if TYPE_CHECKING:
    from numpy.typing import NDArray

    #: A part of a geom: the geom's index, its mesh, and its placement.
    Part = tuple[int, _native.Subject, Placement]

#: The number of meshes with materials that are kept for later frames.
_MOST_MESHES = 4096
#: The largest distance in pixels between a circle and its chords in colors.
_CHORD_PIXELS = 0.2
#: The role of colors in ``mat_texid``.
_COLOR_ROLE = 1
#: Half the side of the part of an infinite plane that receives shadows, in extents of the model.
_SHADED_EXTENTS = 2.0


class Stage:
    """Renders the scene, and keeps what does not change from frame to frame."""

    def __init__(self, mujoco: Any, model: Any, scene: Any, options: dict[str, Any]) -> None:
        self._mujoco, self._model, self._scene = mujoco, model, scene
        self._options = options
        self._type_names = {
            int(value): name.removeprefix("mjGEOM_")
            for name, value in mujoco.mjtGeom.__members__.items()
        }
        round_names = ("SPHERE", "ELLIPSOID", "CYLINDER", "CAPSULE", "ARROW", "ARROW1", "ARROW2")
        names = self._type_names.items()
        self._round_types = frozenset(kind for kind, name in names if name in round_names)
        self._shapes: dict[Any, Shape] = {}
        #: The meshes and placements of geoms of the same kind.
        self._recipes: OrderedDict[Any, list[tuple[_native.Subject, Placement]]] = OrderedDict()
        #: The composed scene of each layer, with the meshes it was made from.
        self._composed: dict[str, tuple[list[_native.Subject], _native.Subject]] = {}
        #: The mesh of each skin and flexible body in its last pose.
        self._moving: dict[tuple[str, int], tuple[Shape, Look, _native.Subject]] = {}
        self._sky = Sky(mujoco, model)
        self._notes: list[str] = []
        self._noted: set[str] = set()

    def take_notes(self) -> list[str]:
        """Return the warnings about parts of the scene that are not drawn, each only once."""
        notes, self._notes = self._notes, []
        return notes

    def _note(self, text: str) -> None:
        if text not in self._noted:
            self._noted.add(text)
            self._notes.append(text)

    def depth(self, size: tuple[int, int]) -> NDArray[np.float32]:
        """Return the depth along the view axis; the far plane's distance in the background."""
        arrays, _ = self._passes(size, ("depth",))
        far = np.float32(self._scene.camera[0].frustum_far)
        if arrays is None:
            return np.full((size[1], size[0]), far, np.float32)
        depth: NDArray[np.float32] = np.minimum(arrays["depth"], far)
        return depth

    def segmentation(self, size: tuple[int, int]) -> NDArray[np.int32]:
        """Return the ids and types of the objects."""
        arrays, parts = self._passes(size, ("model_ids",))
        if arrays is None:
            return np.full((size[1], size[0], 2), -1, np.int32)
        geoms = self._scene.geoms
        table = np.full((len(parts) + 1, 2), -1, np.int32)
        table[1:] = [(geoms[at].objid, geoms[at].objtype) for at, _, _ in parts]
        objects: NDArray[np.int32] = np.take(table, arrays["model_ids"], axis=0)
        return objects

    def rgb(self, size: tuple[int, int]) -> NDArray[np.uint8]:
        """Return the colors."""
        flags = self._mujoco.mjtRndFlag
        has_fog = bool(self._scene.flags[int(flags.mjRND_FOG)])
        camera = camera_of(self._scene, size)
        light = {
            **lights_of(self._mujoco, self._scene, size, self._options["softness"]),
            "camera": camera,
        }
        behind = self._behind(size, light)
        parts = self._parts(range(self._scene.ngeom), "front", size)
        arrays = self._render("front", parts, size, {**light, "passes": ("rgb",)})
        if arrays is None:
            if behind is None:
                return np.zeros((size[1], size[0], 3), np.uint8)
            return _native.show_linear(behind)
        pixels = _native.show_linear(arrays["rgba"], behind)
        return fog_over(pixels, self.depth(size), self._model) if has_fog else pixels

    def _behind(self, size: tuple[int, int], light: dict[str, Any]) -> NDArray[np.uint8] | None:
        """Return the picture of the sky and of infinite planes, which receive no shadows."""
        subjects, poses = self._sky.parts(self._scene)
        planes = [at for at in range(self._scene.ngeom) if self._is_infinite(at)]
        parts = self._parts(planes, "behind", size)
        if not parts and not subjects:
            return None
        matrices = np.concatenate([poses, self._poses(parts)]) if parts else poses
        subjects = subjects + [subject for _, subject, _ in parts]
        options = {**without_shadows(light), "passes": ("rgb",)}
        arrays = self._draw("behind", subjects, matrices, size, options)
        behind: NDArray[np.uint8] = arrays["rgba"]
        return behind

    def _is_infinite(self, index: int) -> bool:
        """Whether the geom is a plane without a limit in some direction."""
        geom = self._scene.geoms[index]
        is_plane = geom.type == 0 and geom.dataid >= 0
        return bool(is_plane and (geom.size[0] <= 0 or geom.size[1] <= 0))

    def _passes(
        self, size: tuple[int, int], passes: tuple[str, ...]
    ) -> tuple[dict[str, Any] | None, list[Part]]:
        """Return passes of all geoms with ids."""
        geoms = self._scene.geoms
        shown = [at for at in range(self._scene.ngeom) if geoms[at].segid >= 0]
        # Of surfaces in the same place, MuJoCo shows the last one, and alberti the first one.
        parts = self._parts(shown[::-1], "solid", size)
        camera = camera_of(self._scene, size)
        options = {"camera": camera, "passes": passes, "lights": []}
        return self._render("solid", parts, size, options), parts

    def _render(
        self, layer: str, parts: list[Part], size: tuple[int, int], options: dict[str, Any]
    ) -> dict[str, Any] | None:
        """Render parts, or return None if there are none."""
        if not parts:
            return None
        subjects = [subject for _, subject, _ in parts]
        return self._draw(layer, subjects, self._poses(parts), size, options)

    def _draw(
        self,
        layer: str,
        subjects: list[_native.Subject],
        poses: NDArray[np.float64],
        size: tuple[int, int],
        options: dict[str, Any],
    ) -> dict[str, Any]:
        """Render meshes in their places. Meshes that were in the last frame only move."""
        known, composed = self._composed.get(layer, (None, None))
        if composed is not None and known == subjects:
            placed = _native.move_models(composed, poses)
        else:
            placed = _native.compose_array(subjects, poses)
            self._composed[layer] = subjects, placed
        options = {
            "environment": '"Dark"',
            "background": "transparent",
            "size": size,
            "samples": self._options["samples"],
            "threads": self._options["threads"],
            **options,
        }
        arrays, _, warnings = _native.render(placed, options)
        for text in warnings:
            self._note(text)
        return arrays

    def _poses(self, parts: list[Part]) -> NDArray[np.float64]:
        """Return the matrix (N, 4, 4) from each part's shape to the world."""
        geoms = self._scene.geoms
        rows = [geoms[at] for at, _, _ in parts]
        sizes = np.array([geom.size for geom in rows], np.float64)
        rotations = np.array([geom.mat for geom in rows], np.float64).reshape(-1, 3, 3)
        positions = np.array([geom.pos for geom in rows], np.float64)
        scale = np.array([placement.scale for _, _, placement in parts])
        scales = (scale * sizes[:, None, :]).sum(axis=2)
        # Components that no size scales.
        scales[~scale.any(axis=2)] = 1.0
        # Parts without extent become too small to be seen.
        scales = np.maximum(scales, 1e-9)
        shifts = (np.array([placement.shift for _, _, placement in parts]) * sizes).sum(axis=1)
        for row, (_, _, placement) in enumerate(parts):
            if placement.is_turned:
                scales[row, 1:] *= -1
            elif placement.shape in ("skin", "flex"):
                rotations[row], positions[row] = np.eye(3), 0.0
            elif placement.shape == "near":
                positions[row] = self._near_center(rows[row], rotations[row], positions[row])
        poses = np.zeros((len(parts), 4, 4))
        poses[:, :3, :3] = rotations * scales[:, None, :]
        poses[:, :3, 3] = positions + rotations[:, :, 2] * shifts[:, None]
        poses[:, 3, 3] = 1.0
        return poses

    def _near_center(self, geom: Any, rotation: Any, position: Any) -> Any:
        """Return the point of an infinite plane near the model's center with the same texture."""
        center = rotation.T @ (np.array(self._model.stat.center) - position)
        shift = np.where(np.array(geom.size[:2]) > 0, 0.0, center[:2])
        texture, repeat, _ = self._texture(geom)
        if texture >= 0:
            period = 2 / np.where(np.array(repeat) > 0, repeat, 1.0)
            shift = np.rint(shift / period) * period
        return position + rotation[:, :2] @ shift

    def _parts(self, indices: Any, layer: str, picture: tuple[int, int]) -> list[Part]:
        """Return the parts of geoms in a picture of this size.

        In the layer ``front``, infinite planes are only as large as the shadows on them; parts in
        the layer ``solid`` have no material.
        """
        geoms = self._scene.geoms
        head = head_of(self._scene)
        ratio = highlight_ratio(self._scene)
        parts: list[Part] = []
        rows = [geoms[at] for at in indices]
        is_solid = layer == "solid" or not rows
        details = [0] * len(rows) if is_solid else self._slices(rows, picture)
        for at, geom, detail in zip(indices, rows, details):
            size, kind = geom.size, geom.type
            is_plane = kind == 0
            # Boxes, meshes and the like have no slices.
            detail = detail if kind in self._round_types else 0
            key = (layer, ratio, detail, kind, geom.dataid, geom.matid, geom.texcoord)
            if layer != "solid":
                look = (geom.emission, geom.specular, geom.shininess, geom.rgba.tobytes())
                key += look  # type: ignore[assignment]
            if is_plane or (geom.matid >= 0 and layer != "solid"):
                is_behind = is_plane and ((head - geom.pos) @ geom.mat[:, 2] < 0)
                key += (size.tobytes(), bool(is_behind))  # type: ignore[assignment]
            recipe = self._recipes.get(key)
            if recipe is None:
                recipe = self._recipe(geom, layer, ratio, head, detail)
                if recipe is not None:
                    self._recipes[key] = recipe
                    if len(self._recipes) > _MOST_MESHES:
                        self._recipes.popitem(last=False)
            if recipe is None:
                recipe = self._moving_recipe(at, geom, layer, ratio)
            for subject, placement in recipe:
                parts.append((at, subject, placement))
        return parts

    def _recipe(
        self, geom: Any, layer: str, ratio: float, head: Any, slices: int
    ) -> list[tuple[_native.Subject, Placement]] | None:
        """Return the meshes of a geom with their placements, or None if its vertices move."""
        name = self._type_names.get(geom.type, "")
        placements = PLACEMENTS.get(name)
        if placements is None:
            if name not in ("LABEL", "NONE"):
                self._note(f"geoms of type {name or geom.type} are not drawn")
            return []
        if name in ("SKIN", "FLEX"):
            return None
        if name in ("MESH", "SDF", "HFIELD") and geom.dataid < 0:
            return []
        look = self._look(geom, name, layer, ratio)
        if name == "PLANE":
            look = look._replace(is_double_sided=True)
            if (head - geom.pos) @ geom.mat[:, 2] < 0 and layer != "solid":
                look = look._replace(rgba=(*look.rgba[:3], 0.3 * look.rgba[3]))
            if geom.dataid >= 0 and min(geom.size[:2]) <= 0:
                shape = self._infinite_plane(geom, layer == "front")
                placement = Placement("near" if layer == "front" else "far", placements[0].scale)
                placement = placement._replace(scale=((0.0,) * 3,) * 3)
                return [(build(name.lower(), shape, look, self._model), placement)]
        elif name == "TRIANGLE":
            look = look._replace(is_double_sided=True)
        shapes = [self._shape(part.shape, geom.dataid, slices) for part in placements]
        meshes = [build(name.lower(), shape, look, self._model) for shape in shapes]
        return list(zip(meshes, placements))

    def _moving_recipe(
        self, at: int, geom: Any, layer: str, ratio: float
    ) -> list[tuple[_native.Subject, Placement]]:
        """Return the mesh of a skin or a flexible body, made again if it has moved."""
        name = self._type_names[geom.type]
        if name == "SKIN":
            shape: Shape | None = skin_shape(self._model, self._scene, geom.objid)
        else:
            tube, ball = self._shape("tube", -1), self._shape("sphere", -1)
            shape = flex_shape(self._scene, geom, tube, ball)
        if shape is None:
            return []
        look = self._look(geom, name, layer, ratio)
        known = self._moving.get((layer, at))
        if known is not None:
            its_shape, its_look, subject = known
            if its_look == look and np.array_equal(its_shape.vertices, shape.vertices):
                return [(subject, PLACEMENTS[name][0])]
        subject = build(name.lower(), shape, look, self._model)
        self._moving[layer, at] = shape, look, subject
        return [(subject, PLACEMENTS[name][0])]

    def _shape(self, name: str, dataid: int, slices: int = 0) -> Shape:
        """Return a shape, made on first use; with as many slices as in MuJoCo if 0 are given."""
        model = self._model
        if name == "hfield":
            return height_field_shape(model, dataid)
        key = (name, dataid) if name == "mesh" else (name, slices)
        if key not in self._shapes:
            if name == "mesh":
                self._shapes[key] = mesh_shape(model, dataid)
            else:
                whole, stacks = model.vis.quality.numslices, model.vis.quality.numstacks
                if 0 < slices < whole:
                    whole, stacks = slices, max(2 * round(stacks * slices / whole / 2), 4)
                self._shapes[key] = unit_shape(name, whole, stacks)
        return self._shapes[key]

    def _slices(self, geoms: list[Any], size: tuple[int, int]) -> list[int]:
        """Return for round geoms how many slices look smooth in a picture of this size.

        The chord of a slice is at most a fifth of a pixel from the circle. Numbers are even, so
        that few different shapes are needed.
        """
        camera = self._scene.camera[0]
        span = float(camera.frustum_top - camera.frustum_bottom)
        places = np.array([geom.pos for geom in geoms], np.float64)
        radii = np.array([geom.size for geom in geoms], np.float64).max(axis=1)
        away = places - head_of(self._scene)
        distances = np.sqrt((away * away).sum(axis=1)) - radii
        if camera.orthographic:
            pixels = radii * size[1] / span
        else:
            near = float(camera.frustum_near)
            pixels = radii * near * size[1] / (span * np.maximum(distances, near))
        slices = np.pi / np.sqrt(2 * _CHORD_PIXELS / np.maximum(pixels, 0.5))
        # Quadrants stay whole, so that boxes around round shapes touch them.
        chosen: list[int] = (4 * np.ceil(np.clip(slices, 8, 400) / 4)).astype(int).tolist()
        return chosen

    def _infinite_plane(self, geom: Any, is_near: bool) -> Shape:
        """Return a plane that ends beyond the far plane, or where its shadows end."""
        model = self._model
        sides = []
        _, repeat, _ = self._texture(geom)
        for size, count in zip(geom.size[:2], repeat):
            far = 2.1 * model.vis.map.zfar * model.stat.extent
            half = far / 2 + (2 / count if count > 0 else far / 198)
            if is_near:
                half = min(half, _SHADED_EXTENTS * model.stat.extent)
            sides.append(float(size) if size > 0 else half)
        square = self._shape("plane", -1)
        return square._replace(vertices=square.vertices * [*sides, 1.0])

    def _texture(self, geom: Any) -> tuple[int, tuple[float, float], bool]:
        """Return the number of a geom's texture or -1, its repetitions, and if it is uniform."""
        model, material = self._model, geom.matid
        if material < 0:
            return -1, (0.0, 0.0), False
        roles = model.mat_texid[material]
        texture = int(roles[_COLOR_ROLE]) if np.ndim(roles) else int(roles)
        across, down = model.mat_texrepeat[material]
        return texture, (float(across), float(down)), bool(model.mat_texuniform[material])

    def _look(self, geom: Any, name: str, layer: str, ratio: float) -> Look:
        """Return the appearance of a geom."""
        if layer == "solid":
            return Look((1.0, 1.0, 1.0, 1.0))
        if geom.reflectance > 0:
            self._note("surfaces do not mirror each other: reflectance is ignored")
        texture, repeat, is_uniform = self._texture(geom)
        size = tuple(float(side) for side in geom.size)
        factors = []
        for count, side in zip(repeat, size):
            # The coordinates of these shapes are lengths, and those of others from -1 to 1.
            has_lengths = geom.dataid >= 0 and (name != "PLANE" or min(size[:2]) <= 0)
            if has_lengths:
                factor = 1.0 if is_uniform or side <= 0 else 1 / side
            else:
                factor = side if is_uniform else 1.0
            factors.append(count * factor)
        exponent = 128.0 * float(geom.shininess)
        red, green, blue, alpha = (float(channel) for channel in geom.rgba)
        if alpha < 0.995:
            # MuJoCo blends transparent geoms twice: front to back, and back to front.
            alpha = 1 - (1 - alpha) ** 2
        return Look(
            rgba=(red, green, blue, alpha),
            emission=float(geom.emission),
            f0=float(geom.specular) * ratio * 8 / (exponent + 2),
            exponent=exponent,
            texture=texture,
            repeat=(factors[0], factors[1]),
            uniform=size if is_uniform else None,  # type: ignore[arg-type]
            is_unlit=name in ("LINE", "LINEBOX"),
        )
