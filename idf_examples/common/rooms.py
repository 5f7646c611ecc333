"""A building of box-shaped rooms: their surfaces, the walls between them, and their heating and cooling.

Where two rooms touch, there is a wall or a slab between them. A side that touches no other room is exposed to the
outdoors, or to the ground at z = 0. No side may be partly both.
"""

from dataclasses import dataclass

from common import idf

LOW = 1e-6  # m; less than this is no contact


@dataclass(frozen=True)
class Room:
    """A zone; low and high are its lowest and highest corner, parts those of its outside walls along x."""

    name: str
    low: tuple
    high: tuple
    parts: int = 1

    def parts_of(self, side):
        return self.parts if side in ("South", "North") else 1

    @property
    def floor_area(self):
        return (self.high[0] - self.low[0]) * (self.high[1] - self.low[1])


# By side: the axis that it is across, whether it is the high one, and its kind.
SIDES = {"South": (1, False, "Wall"), "East": (0, True, "Wall"), "North": (1, True, "Wall"),
         "West": (0, False, "Wall"), "Top": (2, True, "Roof"), "Bottom": (2, False, "Floor")}  # fmt: skip
OPPOSITE = {"South": "North", "North": "South", "East": "West", "West": "East", "Top": "Bottom", "Bottom": "Top"}
BETWEEN = {"Top": ("Ceiling", "Slab"), "Bottom": ("Floor", "Slab")}


def upright(side, at, left, bottom, right, top):
    """A rectangle on a wall; left and right are x or y, as seen from outside; from its upper left corner."""
    def corner(along, z):
        return (along, at, z) if side in ("South", "North") else (at, along, z)

    return [corner(left, top), corner(left, bottom), corner(right, bottom), corner(right, top)]


def level(at, low, high, up=True):
    """A horizontal rectangle between two corners."""
    (x1, y1), (x2, y2) = low[:2], high[:2]
    corners = [(x1, y2, at), (x1, y1, at), (x2, y1, at), (x2, y2, at)]
    return corners if up else corners[::-1]


def outline(side, low, high):
    """One side of a box, seen from outside."""
    axis, is_high, _ = SIDES[side]
    at = (high if is_high else low)[axis]
    if axis == 2:
        return level(at, low, high, is_high)
    along = 1 - axis
    ends = (low[along], high[along])
    left, right = ends if side in ("South", "East") else ends[::-1]
    return upright(side, at, left, low[2], right, high[2])


def part_of(corners, part, parts):
    """One of equal parts, side by side, of a rectangle from its upper left corner."""
    upper_left, lower_left, lower_right, upper_right = corners

    def at(left, right, number):
        return tuple(a + (b - a) * number / parts for a, b in zip(left, right, strict=True))

    return [at(upper_left, upper_right, part), at(lower_left, lower_right, part),
            at(lower_left, lower_right, part + 1), at(upper_left, upper_right, part + 1)]  # fmt: skip


def contact(room, other, side):
    """The part of a room's side that touches another room: its low and high corner, or None."""
    axis, is_high, _ = SIDES[side]
    if abs((room.high if is_high else room.low)[axis] - (other.low if is_high else other.high)[axis]) > LOW:
        return None
    low = tuple(map(max, room.low, other.low))
    high = tuple(map(min, room.high, other.high))
    if any(high[i] - low[i] < LOW for i in range(3) if i != axis):
        return None
    return low, high


def area(low, high, axis):
    first, second = (high[i] - low[i] for i in range(3) if i != axis)
    return first * second


def wall_name(room, side, part):
    return f"{room.name} {side}" + (f" {part + 1}" if room.parts_of(side) > 1 else "")


def opening_on(room, side, name, kind, construction, left, bottom, width, height, part=0):
    """An opening in a part of a wall, with left and bottom in metres from the part's lower left corner.

    Parts are counted from the left, as seen from outside.
    """
    axis, is_high, _ = SIDES[side]
    at = (room.high if is_high else room.low)[axis]
    along = 1 - axis
    left += part * (room.high[along] - room.low[along]) / room.parts_of(side)
    z = room.low[2] + bottom
    if side in ("South", "East"):
        start = room.low[along] + left
        end = start + width
    else:
        start = room.high[along] - left
        end = start - width
    wall = wall_name(room, side, part)
    return idf.opening(f"{wall} {name}", kind, construction, wall, upright(side, at, start, z, end, z + height))


def surfaces_of(room, rooms):
    for side, (axis, _, kind) in SIDES.items():
        touching = [(other, found) for other in rooms if other is not room and (found := contact(room, other, side))]
        whole = area(room.low, room.high, axis)
        if not touching:
            on_ground = side == "Bottom" and room.low[2] < LOW
            construction = {"Wall": "Outer Wall", "Roof": "Outer Roof", "Floor": "Ground Floor"}[kind]
            parts = room.parts_of(side)
            for part in range(parts):
                yield idf.surface(wall_name(room, side, part), kind, construction, room.name,
                                  "Ground" if on_ground else "Outdoors",
                                  part_of(outline(side, room.low, room.high), part, parts))  # fmt: skip
            continue
        if abs(sum(area(*found, axis) for _, found in touching) - whole) > LOW * whole:
            raise ValueError(f"{room.name} {side} is partly outside and partly between rooms")
        between, construction = BETWEEN.get(side, ("Wall", "Partition"))
        for other, (low, high) in touching:
            flat_low, flat_high = list(low), list(high)
            flat_low[axis] = flat_high[axis] = (room.high if SIDES[side][1] else room.low)[axis]
            yield idf.surface(f"{room.name} to {other.name}", between, construction, room.name, "Surface",
                              outline(side, flat_low, flat_high), f"{other.name} to {room.name}")  # fmt: skip


CONSTRUCTIONS = """
Material,Insulation,Rough,0.12,0.04,30,1400;
Material,Block,Rough,0.15,0.5,1400,1000;
Material,Concrete,Rough,0.25,1.7,2300,900;
Material,Board,Smooth,0.1,0.25,800,1000;
WindowMaterial:SimpleGlazingSystem,Glazing,1.6,0.5;
Construction,Outer Wall,Insulation,Block;
Construction,Outer Roof,Insulation,Concrete;
Construction,Ground Floor,Insulation,Concrete;
Construction,Slab,Concrete;
Construction,Partition,Board;
Construction,Window,Glazing;
"""

# Gains all day, setpoints of 20 and 25 degrees.
SHARED_SYSTEMS = """
ScheduleTypeLimits,Any;
Schedule:Constant,Heating Setpoint,Any,20;
Schedule:Constant,Cooling Setpoint,Any,25;
Schedule:Constant,Control Type,Any,4;
Schedule:Compact,In Use,Any,Through: 12/31,For: AllDays,Until: 8:00,0.2,Until: 19:00,1,Until: 24:00,0.2;
ThermostatSetpoint:DualSetpoint,Setpoints,Heating Setpoint,Cooling Setpoint;
"""


def conditioning(room):
    """Ideal loads, internal gains of 10 W/m2, and half an air change per hour."""
    name = room.name
    return (f"\nZone,{name};\n"
            f"ZoneControl:Thermostat,{name} Thermostat,{name},Control Type,ThermostatSetpoint:DualSetpoint,Setpoints;\n"
            f"ZoneHVAC:EquipmentConnections,{name},{name} Equipment,{name} Inlet,,{name} Air,{name} Return;\n"
            f"ZoneHVAC:EquipmentList,{name} Equipment,SequentialLoad,ZoneHVAC:IdealLoadsAirSystem,{name} Ideal Loads,"
            f"1,1;\n"
            f"ZoneHVAC:IdealLoadsAirSystem,{name} Ideal Loads,,{name} Inlet;\n"
            f"ElectricEquipment,{name} Gains,{name},In Use,Watts/Area,,10;\n"
            f"ZoneInfiltration:DesignFlowRate,{name} Air Change,{name},In Use,AirChanges/Hour,,,,0.5;\n")  # fmt: skip


def model_of(rooms):
    yield CONSTRUCTIONS + SHARED_SYSTEMS
    for room in rooms:
        yield conditioning(room)
        yield from surfaces_of(room, rooms)
