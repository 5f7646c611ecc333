"""Scenes of surfaces, and their sunlit fractions."""

from __future__ import annotations

import itertools
import os
from collections.abc import Iterable, Mapping, Sequence
from ctypes import byref, c_size_t
from dataclasses import dataclass, fields
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, overload

import numpy as np
from numpy.typing import ArrayLike

from gpu_shading import _library, _pickles
from gpu_shading._arrays import FARTHEST, Floats, number, numbers, pointer, ring, whole, within
from gpu_shading._overlaps import fans, without_overlaps
from gpu_shading.crown import Crown, LeafAngles, Shape
from gpu_shading.errors import InvalidInput
from gpu_shading.meshes import faces_of, to_pyvista, to_trimesh
from gpu_shading.model import Contents, read
from gpu_shading.optics import FlatFilter, Screen, Transmittance, choice
from gpu_shading.rays import Faces, Rays, RayScreens, make_rays
from gpu_shading.renderer import Receivers, Renderer, Values, schedule_table
from gpu_shading.rule import Rule
from gpu_shading.scene_files import Part, save, series

if TYPE_CHECKING:
    import xarray

Casts = Literal["always", "turned away", "never"]

_CASTS = ("always", "turned away", "never")
_MAX_PIXELS = 1 << 20  # along a side
_MAX_TURN = 3600.0  # degrees


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
    crown: Crown | None = None
    screen_origin: tuple[float, float] = (0.0, 0.0)
    screen_rotation: float = 0.0
    schedule: str | None = None
    deployment: str | None = None


class Scene:
    """Surfaces that receive sun, cast shadows, or both.

    Vertices are arrays of shape (number, 3), in metres: x east, y north, z up, counterclockwise as seen from outside,
    the side that the sun may light. Polygons may be non-convex, and have holes.

        scene = Scene(receivers={"window": window}, casters=[overhang])
        scene.sunlit([[180.0, 45.0]])      # azimuth and altitude in degrees: fractions, directions x receivers

    `receivers` given here cast no shadows; `add` has every choice. The accuracy of answers, unless renderer() asks for
    another, is either `error`, an absolute error that 99 % of fractions are within (1e-5 to 0.1), or `resolution`, the
    number of pixels along each side of every receiver's tile.
    """

    def __init__(self, receivers: Iterable[ArrayLike] | Mapping[str, ArrayLike] = (),
                 casters: Iterable[ArrayLike] | Mapping[str, ArrayLike] = (), *, error: float = 1e-3,
                 resolution: int | None = None) -> None:
        self.error = number(error, "error")
        self.resolution = None if resolution is None else whole(resolution, "resolution", 1, _MAX_PIXELS)
        self.schedules: list[str] = []
        """Names of transmittance schedules; their values are the `factors` of a question."""
        self.deployments: list[str] = []
        """Names of schedules of what part of a screen is deployed, and of a crown's share of leaves."""
        self._surfaces: list[Surface] = []
        self._rule: Rule | None = None
        self._native: _library.Handle | None = None
        self._renderers: dict[tuple[str, float, int | None], Renderer] = {}
        for name, vertices in _named(receivers, "receiver"):
            self.add(vertices, name=name, receives=True, casts="never")
        for name, vertices in _named(casters, "caster"):
            self.add(vertices, name=name)

    @classmethod
    def from_energyplus(cls, model: str | os.PathLike[str], weather: str | os.PathLike[str] | None = None,
                        extensions: str | os.PathLike[str] | None = None) -> Scene:
        """The scene that `energyplus --gpu-shading` renders for an IDF or epJSON file: EnergyPlus's surfaces, what our
        extension objects add, their optics, and the model's own rules of which surface shades which. EnergyPlus runs
        up to its shading calculation. `weather`: an EPW file; if None, one that comes with EnergyPlus. `extensions`: a
        side file in place of the model's own. An error in the model raises RunError."""
        return cls._made(read(model, weather, extensions))

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
            screen_rotation: float = 0.0, schedule: str | None = None, deployment: str | None = None,
            crown: Crown | None = None) -> int:
        """Adds a surface and returns its index.

        `casts`: "always", both faces; "turned away", only while it faces away from the sun, which is enough for each
        face of a closed body; or "never". It is opaque unless it has a transmittance (a constant, 0 to 1, or one by
        angle of incidence), a screen or a schedule, which multiply. `screen_origin` (m): the position of the screen's
        tile from the second vertex, along u, which leads to the third vertex, and v; `screen_rotation` (degrees) turns
        the tile. `schedule` names a factor that varies with time (`factors` of Renderer.sunlit). `deployment` names the
        deployed part of the screen, or the share of leaves of a `crown` (`deployments`). A crown has neither a
        transmittance nor a screen.
        """
        index = len(self._surfaces)
        what = f"surface {name or index}"
        choice(casts, _CASTS, f"{what}: casts")
        if transmittance is not None and not isinstance(transmittance, FlatFilter):
            transmittance = Transmittance.constant(number(transmittance, f"{what}: transmittance", 0.0, 1.0))
        if screen is not None and not isinstance(screen, Screen):
            raise InvalidInput(f"{what}: screen: expected a Screen")
        if crown is not None and not isinstance(crown, Crown):
            raise InvalidInput(f"{what}: crown: expected a Crown")
        if crown is not None and (transmittance is not None or screen is not None):
            raise InvalidInput(f"{what}: a crown has neither a transmittance nor a screen")
        origin = numbers(screen_origin, f"{what}: screen_origin")
        if origin.shape != (2,):
            raise InvalidInput(f"{what}: screen_origin: an array of shape {origin.shape}, expected two numbers")
        within(origin, f"{what}: screen_origin", -FARTHEST, FARTHEST, " m")
        for value, kind in ((schedule, "schedule"), (deployment, "deployment")):
            if value is not None and not isinstance(value, str):
                raise InvalidInput(f"{what}: {kind}: {value!r}, expected a name")
        surface = Surface(
            name=str(index if name is None else name), vertices=_kept(ring(vertices, what)),
            holes=tuple(_kept(ring(hole, f"{what}: hole")) for hole in holes), receives=bool(receives), casts=casts,
            transmittance=transmittance, screen=screen, crown=crown, screen_origin=(float(origin[0]), float(origin[1])),
            screen_rotation=number(screen_rotation, f"{what}: screen_rotation", -_MAX_TURN, _MAX_TURN),
            schedule=schedule, deployment=deployment)
        for known, wanted in ((self.schedules, schedule), (self.deployments, deployment)):
            if wanted is not None and wanted not in known:
                known.append(wanted)
        self._surfaces.append(surface)
        self._forget()
        return index

    def add_tree(self, foot: ArrayLike, height: float, crown_diameter: float, leaf_density: float, *,
                 name: str | None = None, crown_base: float | None = None, shape: Shape = "ellipsoid",
                 trunk_diameter: float = 0.3, leaf_angles: LeafAngles = "spherical", wood_density: float = 0.0,
                 leaves: str | None = None) -> int:
        """Adds a tree that stands at `foot` (x, y, z) and returns the index of its crown; see Crown. Lengths in metres;
        the crown begins at `crown_base` above the foot, by default a quarter of the height. The trunk is an
        opaque hexagonal prism up to the middle of the crown; none if its diameter is 0. `leaves` names a schedule of
        the share of leaves (`deployments` of a question)."""
        what = f"tree {name or len(self._surfaces)}"
        place = numbers(foot, f"{what}: foot")
        if place.shape != (3,):
            raise InvalidInput(f"{what}: foot: an array of shape {place.shape}, expected three numbers")
        base = 0.25 * height if crown_base is None else number(crown_base, f"{what}: crown_base", 0.0, FARTHEST)
        diameter = number(crown_diameter, f"{what}: crown_diameter", 0.0, FARTHEST)
        crown = Crown(height - base, leaf_density, shape=shape, leaf_angles=leaf_angles, wood_density=wood_density)
        plan = 0.5 * diameter * np.array([[-1.0, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]])
        index = self.add(place + plan + [0.0, 0.0, base], name=name, crown=crown, deployment=leaves)
        sides = 6
        if number(trunk_diameter, f"{what}: trunk_diameter", 0.0, FARTHEST) > 0.0:
            angles = np.linspace(0.0, 2.0 * np.pi, sides + 1)
            ring = 0.5 * trunk_diameter * np.column_stack([np.cos(angles), np.sin(angles), 0.0 * angles])
            up = np.array([0.0, 0.0, 0.5 * (base + height)])
            for low, next_low in itertools.pairwise(place + ring):
                self.add([low, next_low, next_low + up, low + up], name=name)
        return index

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

    @property
    def facing(self) -> Floats:
        """Where each surface looks, degrees: azimuth of its normal, and tilt, 0 upwards to 180 downwards. A window that
        looks into its own building was given clockwise, and is never lit."""
        x, y, z = self.normals.T
        angles = np.degrees(np.column_stack([np.arctan2(x, y), np.arctan2(np.hypot(x, y), z)]))
        turned: Floats = np.remainder(angles, 360.0)
        return turned

    def index(self, name: str) -> int:
        """The index of the first surface of that name."""
        for index, surface in enumerate(self._surfaces):
            if surface.name == name:
                return index
        raise InvalidInput(f"{name}: no surface of that name")

    @overload
    def sunlit(self, directions: ArrayLike, *, receivers: Receivers | None = None, factors: Values | None = None,
               deployments: Values | None = None, below_horizon: bool = False, device: str = "auto",
               labelled: Literal[False] = False, progress: bool = False) -> Floats: ...

    @overload
    def sunlit(self, directions: ArrayLike, *, receivers: Receivers | None = None, factors: Values | None = None,
               deployments: Values | None = None, below_horizon: bool = False, device: str = "auto",
               labelled: Literal[True], progress: bool = False) -> xarray.DataArray: ...

    def sunlit(self, directions: ArrayLike, *, receivers: Receivers | None = None, factors: Values | None = None,
               deployments: Values | None = None, below_horizon: bool = False, device: str = "auto",
               labelled: bool = False, progress: bool = False) -> Floats | xarray.DataArray:
        """Sunlit fractions, 0 to 1: the sunlit area over the area, each part weighted by what the shades in front of
        it let pass; 0 where the sun is below the horizon or behind the receiver, as it always is behind one that
        `facing` shows to look into its building. See Renderer.sunlit, which answers."""
        renderer = self.renderer(device=device)
        if labelled:
            return renderer.sunlit(directions, receivers=receivers, factors=factors, deployments=deployments,
                                   below_horizon=below_horizon, labelled=True, progress=progress)
        return renderer.sunlit(directions, receivers=receivers, factors=factors, deployments=deployments,
                               below_horizon=below_horizon, progress=progress)

    def add_mesh(self, mesh: Any, *, name: str, **surface: Any) -> list[int]:
        """Adds the faces of a trimesh.Trimesh, a PyVista PolyData, or of any object with `vertices` and `faces`, and
        returns their indices. All have one name; more arguments as `add` has. In metres."""
        return [self.add(corners, name=name, **surface) for corners in faces_of(mesh)]

    def to_pyvista(self, values: Mapping[str, ArrayLike] | None = None) -> Any:
        """The surfaces as a PyVista PolyData for drawing in 3D: a polygon each, or triangles of one with holes.
        `values`: arrays by name with a value for each surface, such as sunlit fractions, which its cells get; they have
        its index as "surface"."""
        return to_pyvista([list(self._triangles(index)) if surface.holes else [surface.vertices]
                           for index, surface in enumerate(self._surfaces)], values or {})

    def save(self, file: str | os.PathLike[str], values: Any = None, *, times: Sequence[Any] | None = None,
             name: str = "sunlit") -> None:
        """Writes the surfaces with values, such as sunlit fractions, for drawing in 3D: a .glb, which browsers show and
        which plays the times one after another; a .vtp of VTK with an array of cells for each time, "sunlit 12:00"; or
        a .pvd, ParaView's list of a .vtp for each time. `values`: as `sunlit` returns them, or by name as Run.values
        has them. `times`: a label for each row of values. Where surfaces lie on one another, as a window on its
        wall, the smallest is drawn."""
        shown = None if values is None else series(name, values, times, self.names, self.receivers)
        triangles = [self._triangles(index) for index in range(len(self._surfaces))]
        valued = np.zeros(len(triangles), dtype=np.bool_)
        if shown is not None:
            valued |= ~np.isnan(shown.values).all(axis=0)
        parts = []
        for surface, corners, left in zip(self._surfaces, triangles, without_overlaps(triangles, valued), strict=True):
            polygons = left if left is not None else list(corners) if surface.holes else [surface.vertices]
            parts.append(Part(polygons, corners if left is None else fans(left),
                              bool(surface.transmittance or surface.screen or surface.crown)))
        save(Path(file), parts, shown)

    def to_trimesh(self) -> Any:
        """The surfaces as a trimesh.Trimesh of triangles; `face_attributes["surface"]` has their indices."""
        return to_trimesh([self._triangles(index) for index in range(len(self._surfaces))])

    def renderer(self, *, device: str = "auto", error: float | None = None,
                 resolution: int | None = None) -> Renderer:
        """A Renderer of this scene as it is now. `device`: "auto", the first GPU and otherwise the CPU; "cpu"; or a
        number from `gpu_shading devices`. Renderers are kept until a surface is added."""
        key = (str(device), self.error if error is None else error,
               self.resolution if resolution is None and error is None else resolution)
        if key not in self._renderers:
            self._renderers[key] = self._new_renderer(*key)
        return self._renderers[key]

    def _new_renderer(self, device: str, error: float, resolution: int | None) -> Renderer:
        pixels = 0 if resolution is None else whole(resolution, "resolution", 1, _MAX_PIXELS)
        handle = _library.Handle("renderer", "renderer_new", self.native(), device.encode(errors="replace"), pixels,
                                 number(error, "error"))
        return Renderer(handle, self._area_vectors(), self.receivers, self.names, self.factor_table,
                        self.deployment_shares)

    def rays(self, *, faces: Faces = "as casting", screens: RayScreens = "effective") -> Rays:
        """Rays through this scene as it is now. `faces` that stop rays: "as casting", as each surface casts shadows if
        the sun is in the ray's direction, or "both". `screens`: rays meet their "effective" transmittance, their
        "holes", or what each screen's detail says ("automatic")."""
        return make_rays(self.native(), len(self._surfaces), self.factor_table, self.deployment_shares, faces, screens)

    def factor_table(self, factors: Values | None, directions: int | None) -> Floats:
        """Values of the schedules in rows: one, or one for each direction."""
        return schedule_table(factors, self.schedules, directions, "factors", None)

    def deployment_shares(self, deployments: Values | None) -> Floats:
        """Values of the schedules of deployment."""
        return schedule_table(deployments, self.deployments, None, "deployments", 1.0).reshape(-1)

    def native(self) -> _library.Handle:
        """The library's own scene, of the surfaces as they are now."""
        if self._native is None:
            made = _library.Handle("scene", "scene_new")
            for surface in self._surfaces:
                self._add_native(made, surface)
            if self._rule is not None:
                roles, zone_shades = self._rule.roles_of(len(self._surfaces)), self._rule.zone_shades
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
        filtered = surface.transmittance or surface.crown
        record = _library.SurfaceRecord(
            name=surface.name.encode(errors="replace"), vertices=pointer(rings), ring_sizes=pointer(sizes),
            rings=len(sizes), casting=_CASTS.index(surface.casts),
            filter=filtered.handle.pointer if filtered else None,
            schedule=self.schedules.index(surface.schedule) if surface.schedule is not None else -1,
            screen=surface.screen.handle.pointer if surface.screen else None,
            origin_u=surface.screen_origin[0], origin_v=surface.screen_origin[1],
            rotation=np.radians(surface.screen_rotation),
            deployment=self.deployments.index(surface.deployment) if surface.deployment is not None else -1)
        _library.call("scene_add", scene, byref(record))

    def _triangles(self, index: int) -> Floats:
        """Of a surface: triangles x 3 x 3."""
        count = c_size_t()
        _library.call("scene_triangles", self.native(), index, None, byref(count))
        corners = np.empty((count.value, 3, 3))
        _library.call("scene_triangles", self.native(), index, pointer(corners), byref(count))
        return corners

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


def _named(surfaces: Iterable[ArrayLike] | Mapping[str, ArrayLike], kind: str) -> Iterable[tuple[str, ArrayLike]]:
    if isinstance(surfaces, Mapping):
        return surfaces.items()
    return ((f"{kind} {number}", vertices) for number, vertices in enumerate(surfaces))
