"""Scenes of surfaces, and how much of them the sun reaches."""

from __future__ import annotations

import itertools
import os
import threading
import time
import warnings
from collections.abc import Iterable, Mapping, Sequence
from ctypes import byref
from dataclasses import dataclass, fields
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gpu_shading import _library, _pickles
from gpu_shading._arrays import (
    FARTHEST,
    Floats,
    indices,
    number,
    numbers,
    pointer,
    ring,
    suns,
    unit_vectors,
    unmasked,
    whole,
    within,
)
from gpu_shading.errors import InvalidInput
from gpu_shading.model import Contents, read
from gpu_shading.optics import FlatFilter, Screen, Transmittance, choice
from gpu_shading.rays import Faces, Rays, RayScreens, make_rays

Casts = Literal["always", "turned away", "never"]
Values = Mapping[str, float] | ArrayLike

_CASTS = ("always", "turned away", "never")
_LEAST_COSINE = 1e-5  # EnergyPlus's: with less, the sun is behind a surface
_MOST_DIRECTIONS = 1024  # in one call of the library, between which Python may stop
_FIRST_DIRECTIONS = 64
_LONG_CALL = 0.25  # s
_MOST_ANSWERS = 1 << 20
_MOST_PIXELS = 1 << 20  # along a side
_MOST_TURN = 3600.0  # degrees


@dataclass(frozen=True)
class Surface:
    """A surface as the scene keeps it. Vertices in metres: x east, y north, z up."""

    name: str
    vertices: Floats
    holes: tuple[Floats, ...] = ()
    receives: bool = False
    casts: Casts = "always"
    transmittance: FlatFilter | None = None
    screen: Screen | None = None
    screen_origin: tuple[float, float] = (0.0, 0.0)
    screen_rotation: float = 0.0
    schedule: str | None = None
    deployment: str | None = None


@dataclass(frozen=True)
class Rule:
    """Which caster counts for which receiver, as a model asks (gpu_shading/shading_rule.h)."""

    roles: NDArray[np.uint32]
    """Of each surface in a row: wall, zone, 0 to 3 for which surfaces it shades, and the only one if that is 3."""
    zone_shades: NDArray[np.uint8]
    """Square, by the receiver's zone and then the caster's: 1 where it shades."""

    def __post_init__(self) -> None:
        roles = _whole_numbers(self.roles, "rule: roles", (1 << 32) - 1).astype(np.uint32)
        if roles.shape[1] != 4:
            raise InvalidInput(f"rule: roles: an array of shape {roles.shape}, expected (surfaces, 4)")
        zone_shades = _whole_numbers(self.zone_shades, "rule: zone_shades", 1).astype(np.uint8)
        if zone_shades.shape[0] != zone_shades.shape[1]:
            raise InvalidInput(f"rule: zone_shades: an array of shape {zone_shades.shape}, expected (zones, zones)")
        for column, name, least_beyond in ((1, "zone", len(zone_shades)), (2, "shades", 4)):
            if len(roles) and roles[:, column].max() >= least_beyond:
                raise InvalidInput(f"rule: roles: {name} {roles[:, column].max()}, expected less than {least_beyond}")
        for field, array in (("roles", roles), ("zone_shades", zone_shades)):
            array.setflags(write=False)
            object.__setattr__(self, field, array)


class Scene:
    """Surfaces that receive sun, cast shadows, or both.

    Vertices are arrays of shape (number, 3), in metres: x east, y north, z up, counterclockwise as seen from outside,
    the side that the sun may light. Polygons may be non-convex, and have holes.

        scene = Scene(receivers={"window": window}, casters=[overhang])
        scene.sunlit([[180.0, 45.0]])      # azimuth and altitude in degrees: fractions, directions x receivers

    `receivers` given here cast no shadows; `add` has every choice. `error` and `resolution` are the accuracy of the
    answers where a question does not say: 99 % of fractions are within this absolute error, 1e-5 to 0.1, or the number
    of pixels along each side of every receiver's tile.
    """

    def __init__(self, receivers: Iterable[ArrayLike] | Mapping[str, ArrayLike] = (),
                 casters: Iterable[ArrayLike] | Mapping[str, ArrayLike] = (), *, error: float = 1e-3,
                 resolution: int | None = None) -> None:
        self.error = number(error, "error")
        self.resolution = None if resolution is None else whole(resolution, "resolution", 1, _MOST_PIXELS)
        self.schedules: list[str] = []
        """Names of transmittance schedules; their values are the `factors` of a question."""
        self.deployments: list[str] = []
        """Names of schedules of what part of a screen is deployed."""
        self._surfaces: list[Surface] = []
        self._rule: Rule | None = None
        self._native: _library.Handle | None = None
        self._renderers: dict[tuple[str, float, int | None], Renderer] = {}
        for name, vertices in _named(receivers, "receiver"):
            self.add(vertices, name=name, receives=True, casts="never")
        for name, vertices in _named(casters, "caster"):
            self.add(vertices, name=name)

    @classmethod
    def from_energyplus(cls, model: str | os.PathLike[str], weather: str | os.PathLike[str] | None = None) -> Scene:
        """The scene that `energyplus --gpu-shading` renders for an IDF or epJSON file: EnergyPlus's surfaces, what our
        extension objects add, their optics, and the model's own rules of which surface shades which. EnergyPlus runs
        up to its shading calculation. `weather`: an EPW file, without which one that comes with EnergyPlus is used."""
        return cls._made(read(model, weather))

    @classmethod
    def _made(cls, contents: Contents) -> Scene:
        made = cls(error=contents.error, resolution=contents.resolution)
        # In their order, which is that of factors, whichever surface comes first.
        made.schedules[:], made.deployments[:] = contents.schedules, contents.deployments
        for surface in contents.surfaces:
            made.add(**surface)
        if contents.rule is not None:
            made.set_rule(Rule(*contents.rule))
        return made

    def add(self, vertices: ArrayLike, *, name: str | None = None, holes: Iterable[ArrayLike] = (),
            receives: bool = False, casts: Casts = "always", transmittance: float | FlatFilter | None = None,
            screen: Screen | None = None, screen_origin: tuple[float, float] = (0.0, 0.0),
            screen_rotation: float = 0.0, schedule: str | None = None, deployment: str | None = None) -> int:
        """Adds a surface and returns its index.

        `casts`: "always", both faces; "turned away", only while it faces away from the sun, which is enough for each
        face of a closed body; or "never". It is opaque unless it has a transmittance (a constant, 0 to 1, or one by
        angle of incidence), a screen or a schedule, which multiply. A screen's tile begins at `screen_origin` (m),
        along axes at the second vertex, of which u leads to the third, and is turned by `screen_rotation` (degrees).
        `schedule` names a factor that varies with time, `deployment` the part of the screen that is deployed.
        """
        place = len(self._surfaces)
        what = f"surface {name or place}"
        choice(casts, _CASTS, f"{what}: casts")
        if transmittance is not None and not isinstance(transmittance, FlatFilter):
            transmittance = Transmittance.constant(number(transmittance, f"{what}: transmittance", 0.0, 1.0))
        if screen is not None and not isinstance(screen, Screen):
            raise InvalidInput(f"{what}: screen: expected a Screen")
        origin = numbers(screen_origin, f"{what}: screen_origin")
        if origin.shape != (2,):
            raise InvalidInput(f"{what}: screen_origin: an array of shape {origin.shape}, expected two numbers")
        within(origin, f"{what}: screen_origin", -FARTHEST, FARTHEST, " m")
        for value, kind in ((schedule, "schedule"), (deployment, "deployment")):
            if value is not None and not isinstance(value, str):
                raise InvalidInput(f"{what}: {kind}: {value!r}, expected a name")
        surface = Surface(
            name=str(place if name is None else name), vertices=_kept(ring(vertices, what)),
            holes=tuple(_kept(ring(hole, f"{what}: hole")) for hole in holes), receives=bool(receives), casts=casts,
            transmittance=transmittance, screen=screen, screen_origin=(float(origin[0]), float(origin[1])),
            screen_rotation=number(screen_rotation, f"{what}: screen_rotation", -_MOST_TURN, _MOST_TURN),
            schedule=schedule, deployment=deployment)
        for known, wanted in ((self.schedules, schedule), (self.deployments, deployment)):
            if wanted is not None and wanted not in known:
                known.append(wanted)
        self._surfaces.append(surface)
        self._forget()
        return place

    @property
    def surfaces(self) -> tuple[Surface, ...]:
        """All surfaces, by index."""
        return tuple(self._surfaces)

    @property
    def names(self) -> list[str]:
        """The names of all surfaces, by index."""
        return [surface.name for surface in self._surfaces]

    @property
    def receivers(self) -> list[int]:
        """Indices of the surfaces that receive, in order: the columns of answers."""
        return [index for index, surface in enumerate(self._surfaces) if surface.receives]

    @property
    def areas(self) -> Floats:
        """Net area of each surface, m2."""
        areas: Floats = np.linalg.norm(self._area_vectors(), axis=1)
        return areas

    @property
    def normals(self) -> Floats:
        """Unit normal of each surface; zero for a surface without area."""
        vectors, areas = self._area_vectors(), self.areas[:, None]
        return np.divide(vectors, areas, out=np.zeros_like(vectors), where=areas > 0.0)

    def index(self, name: str) -> int:
        """The index of the first surface of that name."""
        for index, surface in enumerate(self._surfaces):
            if surface.name == name:
                return index
        raise InvalidInput(f"{name}: no surface of that name")

    def sunlit(self, directions: ArrayLike, *, receivers: Sequence[int] | None = None, factors: Values | None = None,
               deployments: Values | None = None, device: str = "auto") -> Floats:
        """Sunlit fractions, 0 to 1: the sunlit area over the area, each part weighted by what the shades in front of
        it let pass; 0 where the sun is behind the receiver. See Renderer.sunlit, which answers."""
        return self.renderer(device=device).sunlit(
            directions, receivers=receivers, factors=factors, deployments=deployments)

    def renderer(self, *, device: str = "auto", error: float | None = None,
                 resolution: int | None = None) -> Renderer:
        """What answers for this scene as it is now. `device`: "auto", the first GPU and otherwise the CPU; "cpu"; or a
        number from `gpu_shading devices`. Renderers are kept until a surface is added."""
        key = (str(device), self.error if error is None else error,
               self.resolution if resolution is None and error is None else resolution)
        if key not in self._renderers:
            self._renderers[key] = Renderer(self, *key)
        return self._renderers[key]

    def rays(self, *, faces: Faces = "as casting", screens: RayScreens = "effective") -> Rays:
        """What answers for single rays through this scene as it is now. `faces` that stop rays: "as casting", by what
        each surface casts, with the ray as the direction to the sun, or "both". `screens`: what a ray meets of them:
        their effective transmittance, their "holes", or "automatic", as each screen's detail says."""
        return make_rays(self.native(), len(self._surfaces), self.factor_table, self.deployment_shares, faces, screens)

    def factor_table(self, factors: Values | None, directions: int | None) -> Floats:
        """Values of the schedules in rows: one, or one for each direction."""
        return _table(factors, self.schedules, directions, "factors", None)

    def deployment_shares(self, deployments: Values | None) -> Floats:
        """Values of the schedules of deployment."""
        return _table(deployments, self.deployments, None, "deployments", 1.0).reshape(-1)

    def native(self) -> _library.Handle:
        """The library's own scene, of the surfaces as they are now."""
        if self._native is None:
            made = _library.Handle("scene", "scene_new")
            for surface in self._surfaces:
                self._add_native(made, surface)
            if self._rule is not None:
                roles, zone_shades = _completed(self._rule.roles, len(self._surfaces)), self._rule.zone_shades
                _library.call("scene_set_rule", made, pointer(roles), len(roles), pointer(zone_shades),
                              len(zone_shades))
            self._native = made
        return self._native

    def set_rule(self, rule: Rule) -> None:
        """Which surface shades which; there must be a role for each. Surfaces that are added later are like the shading
        surfaces of a model."""
        if not isinstance(rule, Rule):
            raise InvalidInput(f"rule: {type(rule).__name__}, expected a Rule")
        # Unpickling fills the fields of a Rule without checking them.
        checked = Rule(rule.roles, rule.zone_shades)
        if len(checked.roles) != len(self._surfaces):
            raise InvalidInput(f"rule: roles of {len(checked.roles)} surfaces, expected {len(self._surfaces)}")
        self._rule = checked
        self._forget()

    def _add_native(self, scene: _library.Handle, surface: Surface) -> None:
        rings = np.ascontiguousarray(np.concatenate([surface.vertices, *surface.holes]))
        sizes = np.array([len(surface.vertices), *map(len, surface.holes)], dtype=np.uintp)
        record = _library.SurfaceRecord(
            name=surface.name.encode(errors="replace"), vertices=pointer(rings), ring_sizes=pointer(sizes),
            rings=len(sizes), casting=_CASTS.index(surface.casts),
            filter=surface.transmittance.handle.pointer if surface.transmittance else None,
            schedule=self.schedules.index(surface.schedule) if surface.schedule is not None else -1,
            screen=surface.screen.handle.pointer if surface.screen else None,
            origin_u=surface.screen_origin[0], origin_v=surface.screen_origin[1],
            rotation=np.radians(surface.screen_rotation),
            deployment=self.deployments.index(surface.deployment) if surface.deployment is not None else -1)
        _library.call("scene_add", scene, byref(record))

    def _area_vectors(self) -> Floats:
        vectors = np.empty((len(self._surfaces), 3))
        _library.call("scene_areas", self.native(), pointer(vectors))
        return vectors

    def _forget(self) -> None:
        self._native = None
        self._renderers = {}

    def __reduce__(self) -> tuple[Any, ...]:
        surfaces = [{field.name: getattr(surface, field.name) for field in fields(surface)} | {
            "vertices": _pickles.packed(surface.vertices),
            "holes": [_pickles.packed(hole) for hole in surface.holes]} for surface in self._surfaces]
        rule = None
        if self._rule is not None:
            rule = _pickles.packed(self._rule.roles), _pickles.packed(self._rule.zone_shades)
        return _restored, (_pickles.VERSION, {
            "error": self.error, "resolution": self.resolution, "schedules": self.schedules,
            "deployments": self.deployments, "surfaces": surfaces, "rule": rule})

    def __repr__(self) -> str:
        return f"<Scene: {len(self._surfaces)} surfaces, {len(self.receivers)} receivers>"


class Renderer:
    """Computes how much of a scene the sun reaches. Made by Scene.renderer. Threads may share one; it answers one
    question at a time, on all cores or on the GPU, and meanwhile other threads of Python run."""

    def __init__(self, scene: Scene, device: str, error: float, resolution: int | None) -> None:
        pixels = 0 if resolution is None else whole(resolution, "resolution", 1, _MOST_PIXELS)
        self._handle = _library.Handle("renderer", "renderer_new", scene.native(), device.encode(errors="replace"),
                                       pixels, number(error, "error"))
        self._lock = threading.Lock()  # of the deployments and the question that they are for
        self._surfaces = len(scene.surfaces)
        self._vectors = scene._area_vectors()
        self._receivers = scene.receivers
        self._factor_table = scene.factor_table
        self._shares = scene.deployment_shares

    @property
    def device(self) -> str:
        """What computes, such as "CPU (2 threads, AVX2)"."""
        return _library.text("renderer_device", self._handle)

    def sunlit(self, directions: ArrayLike, *, receivers: Sequence[int] | None = None, factors: Values | None = None,
               deployments: Values | None = None) -> Floats:
        """Sunlit fractions, 0 to 1, of shape directions x receivers.

        `directions`: of shape (..., 2), azimuth clockwise from north and altitude from the horizon in degrees, or
        (..., 3), vectors to the sun. `receivers`: indices of surfaces, without which all that receive are meant.
        `factors`: values of the scene's schedules, by name or in their order, or a row of them for each direction;
        needed if the scene has schedules. `deployments`: the deployed part of screens, by name or in order, 1 if not
        given. Many directions in one call are faster than one call each.
        """
        angles, shape = suns(directions)
        wanted = self._wanted(receivers)
        areas = self._projected(angles, wanted, factors, deployments)
        vectors = self._vectors[wanted]
        facing = unit_vectors(angles) @ vectors.T
        lit = facing > _LEAST_COSINE * np.linalg.norm(vectors, axis=1)
        fractions = np.divide(areas, facing, out=np.zeros_like(areas), where=lit)
        limited: Floats = np.clip(fractions, 0.0, 1.0)
        return limited.reshape(*shape, len(wanted))

    def projected_areas(self, directions: ArrayLike, *, receivers: Sequence[int] | None = None,
                        factors: Values | None = None, deployments: Values | None = None) -> Floats:
        """The same as areas normal to the beam, m2, as EnergyPlus asks for them."""
        angles, shape = suns(directions)
        wanted = self._wanted(receivers)
        return self._projected(angles, wanted, factors, deployments).reshape(*shape, len(wanted))

    def interior_areas(self, directions: ArrayLike, window: int, interiors: Sequence[int], *,
                       factors: Values | None = None, deployments: Values | None = None) -> Floats:
        """Areas normal to the beam (m2) of each of `interiors` that the sun lights through `window` alone."""
        angles, shape = suns(directions)
        through = int(indices([window], self._surfaces, "window")[0])
        wanted = indices(interiors, self._surfaces, "interiors")
        return self._ask("renderer_interior", angles, wanted, factors, deployments, through).reshape(
            *shape, len(wanted))

    def _wanted(self, receivers: Sequence[int] | None) -> np.ndarray[Any, np.dtype[np.uint32]]:
        return indices(self._receivers if receivers is None else receivers, self._surfaces, "receivers")

    def _projected(self, angles: Floats, wanted: np.ndarray[Any, np.dtype[np.uint32]], factors: Values | None,
                   deployments: Values | None) -> Floats:
        return self._ask("renderer_sunlit", angles, wanted, factors, deployments)

    def _ask(self, question: str, angles: Floats, wanted: np.ndarray[Any, np.dtype[np.uint32]],
             factors: Values | None, deployments: Values | None, *window: int) -> Floats:
        table = self._factor_table(factors, len(angles))
        shares = self._shares(deployments)
        results = np.empty((len(angles), len(wanted)))
        most = max(1, min(_MOST_DIRECTIONS, _MOST_ANSWERS // max(1, len(wanted))))
        first, step = 0, min(most, _FIRST_DIRECTIONS)
        with self._lock:
            _library.call("renderer_set_deployments", self._handle, pointer(shares), len(shares))
            while first < len(angles) and len(wanted):
                began = time.monotonic()
                part, rows = angles[first:first + step], table if len(table) == 1 else table[first:first + step]
                _library.call(question, self._handle, pointer(part), len(part), *window, pointer(wanted), len(wanted),
                              byref(_library.FactorTable(pointer(rows), *rows.shape)), pointer(results[first:]))
                first += step
                step = min(most, 2 * step) if time.monotonic() - began < _LONG_CALL else max(1, step // 2)
            lines = _library.text("renderer_warnings", self._handle).splitlines()
        for line in lines:
            warnings.warn(line, RuntimeWarning, stacklevel=4)
        return results


def _restored(version: int, state: Mapping[str, Any]) -> Scene:
    """What a pickle of a scene holds."""
    _pickles.require_version(version)
    try:
        surfaces = [dict(surface) | {
            "vertices": _pickles.unpacked(surface["vertices"], "vertices"),
            "holes": [_pickles.unpacked(hole, "hole") for hole in surface["holes"]]} for surface in state["surfaces"]]
        rule = state["rule"]
        if rule is not None:
            roles, zone_shades = rule
            rule = _pickles.unpacked(roles, "roles"), _pickles.unpacked(zone_shades, "zone_shades")
        names = [list(state["schedules"]), list(state["deployments"])]
        contents = Contents(state["error"], state["resolution"], names[0], names[1], surfaces, rule)
    except InvalidInput:
        raise
    except (AttributeError, KeyError, TypeError, ValueError) as error:
        raise InvalidInput(f"pickle: scene: {type(error).__name__}: {error}, expected what Scene writes") from None
    if not all(isinstance(name, str) for name in itertools.chain(*names)):
        raise InvalidInput("pickle: scene: schedules and deployments: expected names")
    return Scene._made(contents)


def _kept(array: Floats) -> Floats:
    """A copy that cannot be changed, so that what was checked stays so."""
    kept = array.copy()
    kept.setflags(write=False)
    return kept


def _whole_numbers(values: ArrayLike, what: str, most: int) -> NDArray[Any]:
    """A copy in C's order, in rows, of numbers from 0 to `most`."""
    try:
        found = np.array(unmasked(values, what), order="C")
    except InvalidInput:
        raise
    except ValueError:
        raise InvalidInput(f"{what}: rows of different lengths, expected an array of whole numbers") from None
    if found.dtype.kind not in "biu" or found.ndim != 2:
        raise InvalidInput(f"{what}: {found.dtype} of shape {found.shape}, expected whole numbers in rows")
    if found.size and (found.min() < 0 or found.max() > most):
        raise InvalidInput(f"{what}: {found.min()} to {found.max()}, expected 0 to {most}")
    return found


def _completed(roles: np.ndarray[Any, np.dtype[np.uint32]], surfaces: int) -> np.ndarray[Any, np.dtype[np.uint32]]:
    """Roles with those of surfaces that were added later: each a wall of its own, in the zone of shading surfaces."""
    added = np.zeros((surfaces - len(roles), 4), dtype=np.uint32)
    added[:, 0] = roles[:, 0].max(initial=0) + 1 + np.arange(len(added))
    return np.ascontiguousarray(np.concatenate([roles, added]))


def _named(surfaces: Iterable[ArrayLike] | Mapping[str, ArrayLike], kind: str) -> Iterable[tuple[str, ArrayLike]]:
    if isinstance(surfaces, Mapping):
        return surfaces.items()
    return ((f"{kind} {number}", vertices) for number, vertices in enumerate(surfaces))


def _table(values: Values | None, names: list[str], directions: int | None, what: str,
           default: float | None) -> Floats:
    """Values of schedules, 0 to 1, in rows by the order of `names`."""
    if values is None:
        if names and default is None:
            raise InvalidInput(f"{what}: needed for the schedules {', '.join(names)}")
        return np.full((1, len(names)), 1.0 if default is None else default)
    if isinstance(values, Mapping):
        unknown = [name for name in values if name not in names]
        missing = [name for name in names if name not in values]
        if unknown or (missing and default is None):
            raise InvalidInput(f"{what}: expected {', '.join(names) or 'none'}, got {', '.join(map(str, values))}")
        table = numbers([values.get(name, default or 0.0) for name in names], what)
    else:
        table = numbers(values, what)
    rows = table[None] if table.ndim == 1 else table
    if rows.ndim != 2 or rows.shape[1] != len(names) or len(rows) not in (1, directions or 1):
        raise InvalidInput(f"{what}: an array of shape {table.shape}, expected ({len(names)},)" +
                           (f" or ({directions}, {len(names)})" if directions is not None else ""))
    if rows.size and (rows.min() < 0.0 or rows.max() > 1.0):
        raise InvalidInput(f"{what}: {rows.min():g} to {rows.max():g}, expected 0 to 1")
    return np.ascontiguousarray(rows)
