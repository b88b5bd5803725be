"""Lights and environments."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields
from typing import TYPE_CHECKING, Any, ClassVar, Union

from ._errors import AlbertiError

if TYPE_CHECKING:
    Triple = Sequence[float]
    Color = Union[str, Sequence[float]]


class Light:
    """A light of a picture; see the subclasses."""

    _kind: ClassVar[str]


@dataclass(frozen=True)
class DirectionalLight(Light):
    """A light at infinity, such as the sun.

    Attributes:
        direction: Direction (3,) in which the light travels, in world space.
        intensity: Illuminance in lux of a surface that faces the light; white then has the linear
            value ``intensity`` / π.
        color: "#rrggbb", a CSS color name, or three linear numbers; white by default.
        shadows: Whether it casts shadows; by default as the picture's ``shadows``.
    """

    direction: Triple
    intensity: float = 3.0
    color: Color | None = None
    shadows: bool | None = None
    _kind: ClassVar[str] = "Directional"


@dataclass(frozen=True)
class PointLight(Light):
    """A light at a point. Its illuminance falls off with the square of the distance.

    Attributes:
        position: Position (3,) in world space.
        intensity: Luminous intensity in candela: the illuminance at a distance of 1.
        range: Distance beyond which the light has no effect; unlimited by default.
        color: As for :class:`DirectionalLight`.
        shadows: As for :class:`DirectionalLight`.
    """

    position: Triple
    intensity: float
    range: float | None = None
    color: Color | None = None
    shadows: bool | None = None
    _kind: ClassVar[str] = "Point"


@dataclass(frozen=True)
class SpotLight(Light):
    """A point light that is restricted to a cone.

    Attributes:
        position: Position (3,) in world space.
        direction: Direction (3,) of the cone's axis, in which the light travels.
        intensity: Luminous intensity in candela along the axis.
        inner_cone_degrees: Angle from the axis where the falloff begins; 0 by default.
        outer_cone_degrees: Angle from the axis where the falloff ends; 45 by default.
        range: Distance beyond which the light has no effect; unlimited by default.
        color: As for :class:`DirectionalLight`.
        shadows: As for :class:`DirectionalLight`.
    """

    position: Triple
    direction: Triple
    intensity: float
    inner_cone_degrees: float | None = None
    outer_cone_degrees: float | None = None
    range: float | None = None
    color: Color | None = None
    shadows: bool | None = None
    _kind: ClassVar[str] = "Spot"


@dataclass(frozen=True)
class AmbientLight(Light):
    """Uniform diffuse light from all directions.

    Attributes:
        intensity: Illuminance in lux of every surface.
        color: As for :class:`DirectionalLight`.
    """

    intensity: float
    color: Color | None = None
    _kind: ClassVar[str] = "Ambient"


@dataclass(frozen=True)
class ModelLights(Light):
    """The lights in the models' files (KHR_lights_punctual)."""

    _kind: ClassVar[str] = "FromModels"


@dataclass(frozen=True)
class Environment:
    """Light from all directions: it lights diffuse surfaces and is reflected in shiny ones.

    Attributes:
        kind: ``studio`` (soft boxes), ``sky`` (clear, without a sun), ``uniform``, ``file`` (an
            equirectangular image, ``.hdr``), or ``dark`` (no environment).
        strength: Factor for its intensity; 1 by default.
        rotation_degrees: Rotation of a studio or an image about the y axis.
        sun: Direction (3,) to the sun of a sky.
        color: Color of uniform light.
        path: Path of the image.
    """

    kind: str
    strength: float | None = None
    rotation_degrees: float | None = None
    sun: Triple | None = None
    color: Color | None = None
    path: str | None = None

    def _to_json(self) -> Any:
        name = self.kind.capitalize()
        return _variant(name, self, skip=("kind",))


def light_options(options: dict[str, Any]) -> None:
    """Convert lights, environment, shadows and ground to the JSON form of scene files."""
    lights = options.get("lights")
    if lights is not None and not isinstance(lights, str):
        if isinstance(lights, Light):
            lights = [lights]
        texts = []
        for index, light in enumerate(lights):
            if not isinstance(light, Light):
                message = f"is a {type(light).__name__}, expected a light"
                raise AlbertiError(message, pointer=f"lights[{index}]")
            texts.append(_dump(f"lights[{index}]", _variant(light._kind, light)))
        options["lights"] = texts
    environment = options.get("environment")
    if isinstance(environment, str):
        environment = Environment(environment)
    if environment is not None:
        if not isinstance(environment, Environment):
            message = f"is a {type(environment).__name__}, expected a name or an Environment"
            raise AlbertiError(message, pointer="environment")
        options["environment"] = _dump("environment", environment._to_json())
    shadows = options.get("shadows")
    if shadows is not None:
        options["shadows"] = _dump("shadows", _shadows(shadows))
    ground = options.get("ground")
    if ground is False:
        options["ground"] = None
    elif ground is not None:
        height = {} if ground is True else {"height": ground}
        options["ground"] = _dump("ground", {"Shadow": height})


def _shadows(shadows: bool | float) -> Any:
    """Return shadows that are on or off, or on with a softness in degrees."""
    if shadows is True:
        return {"On": {}}
    return "Off" if shadows is False else {"On": {"softness_degrees": shadows}}


def _variant(name: str, value: Any, skip: tuple[str, ...] = ()) -> Any:
    """Return a dataclass as a variant of a scene file's enumeration, without default values."""
    contents = {
        field.name: getattr(value, field.name)
        for field in fields(value)
        if field.name not in skip and getattr(value, field.name) is not None
    }
    if "shadows" in contents:
        contents["shadows"] = _shadows(contents["shadows"])
    return {name: contents} if contents or name in _WITH_FIELDS else name


#: Variants that have fields, all of which are optional.
_WITH_FIELDS = ("Studio", "Sky", "Uniform")


def _dump(pointer: str, value: Any) -> str:
    """Return a value as JSON; NumPy's arrays and numbers become lists and numbers."""

    def convert(value: Any) -> Any:
        if hasattr(value, "tolist"):
            return value.tolist()
        if isinstance(value, Mapping):
            return dict(value)
        raise TypeError(f"is a {type(value).__name__}, expected numbers")

    try:
        return json.dumps(value, default=convert, allow_nan=False)
    except (TypeError, ValueError) as error:
        raise AlbertiError(str(error), pointer=pointer) from None
