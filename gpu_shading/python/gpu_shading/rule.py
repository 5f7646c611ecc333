"""Rules of which surface shades which."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gpu_shading._arrays import unmasked
from gpu_shading.errors import InvalidInput


@dataclass(frozen=True)
class Rule:
    """Which casters shade which receivers (gpu_shading/shading_rule.h)."""

    roles: NDArray[np.uint32]
    """A row for each surface: wall, zone, 0 to 3 for which surfaces it shades, and the only one if that is 3."""
    zone_shades: NDArray[np.uint8]
    """Square, by the receiver's zone and then the caster's: 1 where it shades."""

    def __post_init__(self) -> None:
        roles = _whole_numbers(self.roles, "rule: roles", (1 << 32) - 1).astype(np.uint32)
        if roles.shape[1] != 4:
            raise InvalidInput(f"rule: roles: an array of shape {roles.shape}, expected (surfaces, 4)")
        zone_shades = _whole_numbers(self.zone_shades, "rule: zone_shades", 1).astype(np.uint8)
        if zone_shades.shape[0] != zone_shades.shape[1]:
            raise InvalidInput(f"rule: zone_shades: an array of shape {zone_shades.shape}, expected (zones, zones)")
        for column, name, end in ((1, "zone", len(zone_shades)), (2, "shades", 4)):
            if len(roles) and roles[:, column].max() >= end:
                raise InvalidInput(f"rule: roles: {name} {roles[:, column].max()}, expected less than {end}")
        for field, array in (("roles", roles), ("zone_shades", zone_shades)):
            array.setflags(write=False)
            object.__setattr__(self, field, array)

    def roles_of(self, surfaces: int) -> NDArray[np.uint32]:
        """Roles with those of surfaces that were added later: each a wall of its own, in the zone of shading surfaces.
        """
        added = np.zeros((surfaces - len(self.roles), 4), dtype=np.uint32)
        added[:, 0] = self.roles[:, 0].max(initial=0) + 1 + np.arange(len(added))
        return np.ascontiguousarray(np.concatenate([self.roles, added]))


def _whole_numbers(values: ArrayLike, what: str, high: int) -> NDArray[Any]:
    """A copy in C's order, in rows, of numbers from 0 to `high`."""
    try:
        found = np.array(unmasked(values, what), order="C")
    except InvalidInput:
        raise
    except ValueError:
        raise InvalidInput(f"{what}: rows of different lengths, expected an array of whole numbers") from None
    if found.dtype.kind not in "biu" or found.ndim != 2:
        raise InvalidInput(f"{what}: {found.dtype} of shape {found.shape}, expected whole numbers in rows")
    if found.size and (found.min() < 0 or found.max() > high):
        raise InvalidInput(f"{what}: {found.min()} to {found.max()}, expected 0 to {high}")
    return found
