"""The shading cases of ANSI/ASHRAE Standard 140 (BESTEST), of its editions of 2007 and 2020.

Written from the standard's specification (Judkoff and Neymark, IEA BESTEST, 1995; the changes of 2020 as published with
Modelica Buildings, NREL's BESTEST-GSR and Big Ladder's std140-cse). A room of 8 x 6 x 2.7 m with 12 m2 of windows, to
the south in cases 600 and 900, half to the east and half to the west in 620 and 920. Cases 610 and 910 add an overhang
of 1 m along the south wall, at the roof; 630 and 930 an overhang of 1 m and fins of 1 m, from the roof to the ground,
around each window. The cases x40 to x95 are those of 600 and 900 with another thermostat, fans at night, other glass or
more insulation.

The edition of 2020 has other weather, other glass, and a floor above the ground. It also names limits within which
results are acceptable (addendum b).
"""

import csv
from dataclasses import dataclass
from pathlib import Path

from output_files import values_of
from shading_runs import energyplus, results
from shading_runs.version import input_version

SHADED = {610: 600, 630: 620, 910: 900, 930: 920}  # and the same without shades
J_PER_MWH, J_PER_KWH = 3.6e9, 3.6e6
UNITS = {"heating": "MWh", "cooling": "MWh", "peak heating": "kW", "peak cooling": "kW", "transmitted": "kWh/m2",
         "shading coefficient": ""}  # fmt: skip
LOADS = ("heating", "cooling", "peak heating", "peak cooling")
TRANSMITTED = "Surface Window Transmitted Solar Radiation Energy"


@dataclass(frozen=True)
class Edition:
    """What an edition specifies, and what its reference programs found.

    weather: names of the file, in any of which the same hours are. ranges, changes: {case: {name: (least, largest)}} of
    all programs; changes are those by shades, each program's own. outside: {(case, name)} of EnergyPlus's own results
    that are outside, by whatever method it shades.
    """

    cases: tuple
    weather: tuple
    site: str
    timesteps: int
    floor: str
    glass: str
    gap: float
    ranges: dict
    changes: dict
    limits: dict
    outside: frozenset
    changes_outside: frozenset


def named(values):
    return {case: dict(zip(LOADS, bounds, strict=True)) for case, bounds in values.items()}


# ESP, BLAST, DOE2, SRES/SUN, SERIRES, S3PAS, TRNSYS and TASE (Standard 140-2007, part 1 of its results for section 5.2,
# as in NREL's EnergyPlusValidationReports; without TASE for 630 and 930, which the standard disregards).
RANGES_2007 = named({
    600: ((4.296, 5.709), (6.137, 8.448), (3.437, 4.354), (5.965, 7.188)),
    610: ((4.355, 5.786), (3.915, 6.139), (3.437, 4.354), (5.669, 6.673)),
    620: ((4.613, 5.944), (3.417, 5.482), (3.591, 4.379), (3.634, 5.096)),
    630: ((5.050, 6.469), (2.129, 3.701), (3.592, 4.280), (3.072, 4.116)),
    900: ((1.170, 2.041), (2.132, 3.669), (2.850, 3.797), (2.888, 3.932)),
    910: ((1.512, 2.282), (0.821, 1.883), (2.858, 3.801), (1.896, 3.277)),
    920: ((3.261, 4.300), (1.840, 3.313), (3.308, 4.061), (2.385, 3.505)),
    930: ((4.143, 5.335), (1.039, 2.238), (3.355, 4.064), (1.873, 3.080)),
})  # fmt: skip
CHANGES_2007 = named({
    610: ((0.021, 0.098), (-2.309, -1.272), (-0.014, 0.001), (-0.811, -0.116)),
    630: ((0.267, 0.551), (-2.138, -0.983), (-0.026, 0.003), (-0.878, -0.371)),
    910: ((0.179, 0.442), (-1.786, -0.832), (0.003, 0.019), (-1.122, -0.310)),
    930: ((0.595, 1.080), (-1.425, -0.682), (0.026, 0.047), (-0.736, -0.387)),
})  # fmt: skip

# BSIMAC, CSE, DeST, EnergyPlus 9.0.1, ESP-r and TRNSYS (Standard 140-2020, tables B8-1 to B8-4, B8-14 and B8-15, as in
# RESULTS5-2A.xlsx of BESTEST-GSR), and the limits of addendum b (tables A3-1 to A3-4, as in ASHRAE140_data.dat of
# Modelica Buildings).
PROGRAMS_2020 = ("BSIMAC", "CSE", "DeST", "EnergyPlus", "ESP-r", "TRNSYS")


def published_2020():
    """({program: {case: {name: value}}}, {case: {name: limits}})."""
    found, limits = {program: {} for program in PROGRAMS_2020}, {}
    with open(Path(__file__).with_name("ashrae_140_2020.csv"), newline="", encoding="utf-8") as file:
        for row in csv.DictReader(file):
            case, name = int(row["case"]), row["quantity"]
            for program, values in found.items():
                if row[program]:
                    values.setdefault(case, {})[name] = float(row[program])
            if row["lower limit"]:
                limits.setdefault(case, {})[name] = (float(row["lower limit"]), float(row["upper limit"]))
    return found, limits


def change(shaded, plain):
    """What shades change in quantities: differences of loads, and the share of the transmitted sun that is shaded."""
    changed = {name: shaded[name] - plain[name] for name in LOADS}
    if "transmitted" in shaded and "transmitted" in plain:
        changed["shading coefficient"] = 1.0 - shaded["transmitted"] / plain["transmitted"]
    return changed


def bounds_of(each):
    """{name: (least, largest)} of some {name: value}."""
    names = dict.fromkeys(name for values in each for name in values)
    found = {name: [values[name] for values in each if name in values] for name in names}
    return {name: (round(min(values), 3), round(max(values), 3)) for name, values in found.items()}


PUBLISHED_2020, LIMITS_2020 = published_2020()

EDITIONS = {
    2007: Edition(
        cases=(600, 610, 620, 630, 900, 910, 920, 930),
        weather=("drycold.epw",),
        site="Golden,39.8,-104.9,-7,1609",
        timesteps=4,
        floor="Ground",
        glass="0.003175,0.86156,0.07846,0.07846,0.91325,0.082,0.082,0,0.84,0.84,1.06",
        gap=0.013,
        ranges=RANGES_2007,
        changes=CHANGES_2007,
        limits={},
        # Less heating, and a peak of heating, at night, that changes less than in other programs.
        outside=frozenset({(630, "heating"), (930, "heating")}),
        changes_outside=frozenset({(910, "peak heating"), (930, "peak heating")}),
    ),
    2020: Edition(
        cases=tuple(LIMITS_2020),
        weather=("725650TYCST.epw", "USA_CO_Denver.Intl.AP.725650_TMY3.epw"),
        site="Denver,39.83,-104.65,-7,1650",
        timesteps=6,
        floor="Outdoors",
        glass="0.003048,0.834,0.075,0.075,0.91325,0.082,0.082,0,0.84,0.84,1.0",
        gap=0.012,
        ranges={case: bounds_of([values[case] for values in PUBLISHED_2020.values() if case in values])
                for case in LIMITS_2020},
        changes={case: bounds_of([change(values[case], values[plain]) for values in PUBLISHED_2020.values()])
                 for case, plain in SHADED.items()},
        limits=LIMITS_2020,
        # By 0.2 % and by less than 1 W: EnergyPlus 9.0.1 itself is the outermost of the six.
        outside=frozenset({(670, "cooling"), (695, "cooling")}),
        changes_outside=frozenset({(630, "peak heating")}),
    ),
}  # fmt: skip

LENGTH, DEPTH, HEIGHT, SHADE = 8.0, 6.0, 2.7, 1.0
SILL, HEAD, WIDTH = 0.2, 2.2, 3.0  # of each window
SOUTH_WINDOWS = (0.5, 4.5)  # from the west end
SIDE_WINDOW = 1.5  # from the south end

HEADING = f"Version,{input_version()};\n" + """\
SimulationControl,No,No,No,No,Yes;
Building,Case {case},0,Country,0.04,0.004,FullInteriorAndExterior,,6;
Timestep,{timesteps};
ShadowCalculation,PolygonClipping,Periodic,1;
SurfaceConvectionAlgorithm:Inside,TARP;
SurfaceConvectionAlgorithm:Outside,DOE-2;
Site:Location,{site};
RunPeriod,Year,1,1,,12,31;
GlobalGeometryRules,UpperLeftCorner,Counterclockwise,World;
Site:GroundTemperature:BuildingSurface,10,10,10,10,10,10,10,10,10,10,10,10;
Site:GroundReflectance,0.2,0.2,0.2,0.2,0.2,0.2,0.2,0.2,0.2,0.2,0.2,0.2;
Zone,Room;
Schedule:Constant,On,,1;
Schedule:Constant,Dual Setpoint,,4;
OtherEquipment,Gains,None,Room,On,EquipmentLevel,200,,,0,0.6,0;
ZoneInfiltration:DesignFlowRate,Half an Air Change,Room,On,Flow/Zone,0.018,,,,1,0,0,0;
ZoneControl:Thermostat,Thermostat,Room,Dual Setpoint,ThermostatSetpoint:DualSetpoint,Setpoints;
ThermostatSetpoint:DualSetpoint,Setpoints,Heat Below,Cool Above;
ZoneHVAC:EquipmentConnections,Room,Equipment,Inlet,,Air,Outlet;
ZoneHVAC:EquipmentList,Equipment,SequentialLoad,ZoneHVAC:IdealLoadsAirSystem,Ideal,1,1;
ZoneHVAC:IdealLoadsAirSystem,Ideal,,Inlet,,,50,13,0.01,0.01,,,,,,,,,ConstantSupplyHumidityRatio,,
  ConstantSupplyHumidityRatio;

Material,Siding,Rough,0.009,0.14,530,900,0.9,0.6,0.6;
Material,Roof Deck,Rough,0.019,0.14,530,900,0.9,0.6,0.6;
Material,Roof Quilt,Rough,{roof},0.04,12,840,0.9,0.6,0.6;
Material,Ceiling Board,Rough,0.01,0.16,950,840,0.9,0.6,0.6;
Construction,Roof,Roof Deck,Roof Quilt,Ceiling Board;
WindowMaterial:Glazing,Glass,SpectralAverage,,{glass};

Output:SQLite,Simple;
Output:Variable,*,Zone Air System Sensible Heating Energy,Hourly;
Output:Variable,*,Zone Air System Sensible Cooling Energy,Hourly;
Output:Variable,*,Surface Window Transmitted Beam Solar Radiation Energy,Monthly;
Output:Variable,*,Surface Window Transmitted Solar Radiation Energy,Monthly;
"""
THERMOSTAT = "Schedule:Constant,Heat Below,,{heat};\nSchedule:Constant,Cool Above,,{cool};\n"
SETBACK = """
Schedule:Compact,Heat Below,,Through: 12/31,For: AllDays,Interpolate: Linear,Until: 7:00,10,Until: 8:00,20,
  Until: 23:00,20,Until: 23:01,10,Until: 24:00,10;
Schedule:Constant,Cool Above,,27;
"""
FANS_AT_NIGHT = """
Schedule:Constant,Heat Below,,-100;
Schedule:Compact,Cool Above,,Through: 12/31,For: AllDays,Until: 7:00,100,Until: 18:00,27,Until: 24:00,100;
Schedule:Compact,Night,,Through: 12/31,For: AllDays,Until: 7:00,1,Until: 18:00,0,Until: 24:00,1;
ZoneVentilation:DesignFlowRate,Fans,Room,Night,Flow/Zone,0.472222,,,,Natural,0,1,1,0,0,0;
"""
DOUBLE = "WindowMaterial:Gas,Gap,Air,{gap};\nConstruction,Window,Glass,Gap,Glass;\n"
SINGLE = "Construction,Window,Glass;\n"
LOW_E = """
WindowMaterial:Glazing,Coated,SpectralAverage,,0.00318,0.452,0.359,0.397,0.5,0.3,0.3,0,0.84,0.047,1.0;
WindowMaterial:Gas,Gap,Argon,{gap};
Construction,Window,Coated,Gap,Glass;
"""
LOW_MASS = """
Material,Wall Insulation,Rough,{wall},0.9,0.6,0.6;
Material,Wall Board,Rough,0.012,0.16,950,840,0.9,0.6,0.6;
Construction,Wall,Siding,Wall Insulation,Wall Board;
Material,Timber,Rough,0.025,0.14,650,1200,0.9,0.6,0.6;
Material:NoMass,Floor Insulation,Rough,25.075,0.9,0.6,0.6;
Construction,Floor,Floor Insulation,Timber;
"""
HIGH_MASS = """
Material,Wall Insulation,Rough,{wall},0.9,0.6,0.6;
Material,Wall Block,Rough,0.1,0.51,1400,1000,0.9,0.6,0.6;
Construction,Wall,Siding,Wall Insulation,Wall Block;
Material,Slab,Rough,0.08,1.13,1400,1000,0.9,0.6,0.6;
Material:NoMass,Floor Insulation,Rough,25.175,0.9,0.6,0.6;
Construction,Floor,Floor Insulation,Slab;
"""


def vertices(points):
    return "4,\n" + ",\n".join(f"  {x:.6f},{y:.6f},{z:.6f}" for x, y, z in points) + ";\n"


def upright(start, end, bottom, top):
    """A rectangle between two places on the ground, left and right as seen from outside."""
    return [(*start, top), (*start, bottom), (*end, bottom), (*end, top)]


def surface(name, kind, construction, boundary, points):
    exposure = "NoSun,NoWind" if kind == "Floor" else "SunExposed,WindExposed"
    return f"BuildingSurface:Detailed,{name},{kind},{construction},Room,,{boundary},,{exposure},," + vertices(points)


def window(name, wall, points):
    return f"FenestrationSurface:Detailed,{name},Window,Window,{wall},,,,1," + vertices(points)


def shade(name, points):
    return f"Shading:Building:Detailed,{name},," + vertices(points)


def shell(floor):
    corners = [(0.0, 0.0), (LENGTH, 0.0), (LENGTH, DEPTH), (0.0, DEPTH)]
    for i, name in enumerate(("South", "East", "North", "West")):
        yield surface(name, "Wall", "Wall", "Outdoors", upright(corners[i], corners[(i + 1) % 4], 0.0, HEIGHT))
    yield surface("Roof", "Roof", "Roof", "Outdoors", [(*corners[i], HEIGHT) for i in (3, 0, 1, 2)])
    yield surface("Floor", "Floor", "Floor", floor, [(*corners[i], 0.0) for i in (0, 3, 2, 1)])


def to_the_south(with_shades):
    for i, x in enumerate(SOUTH_WINDOWS, 1):
        yield window(f"South Window {i}", "South", upright((x, 0.0), (x + WIDTH, 0.0), SILL, HEAD))
    if with_shades:
        yield shade("Overhang", [(0.0, -SHADE, HEIGHT), (LENGTH, -SHADE, HEIGHT), (LENGTH, 0.0, HEIGHT),
                                 (0.0, 0.0, HEIGHT)])  # fmt: skip


def to_the_sides(with_shades):
    near, far = SIDE_WINDOW, SIDE_WINDOW + WIDTH
    for side, x, out, left, right in (("East", LENGTH, SHADE, near, far), ("West", 0.0, -SHADE, far, near)):
        yield window(f"{side} Window", side, upright((x, left), (x, right), SILL, HEAD))
        if with_shades:
            yield shade(f"{side} Overhang", [(x, left, HEIGHT), (x + out, left, HEIGHT), (x + out, right, HEIGHT),
                                             (x, right, HEIGHT)])  # fmt: skip
            for name, y in (("Left", left), ("Right", right)):
                yield shade(f"{side} {name} Fin", upright((x, y), (x + out, y), 0.0, HEIGHT))


def model(edition, case):
    """The input file as text."""
    variant, high_mass, insulated = case % 100, case >= 900, case % 100 in (80, 95)
    if high_mass:
        mass, wall = HIGH_MASS, "0.2452,0.04,10,1400" if insulated else "0.0615,0.04,10,1400"
    else:
        mass, wall = LOW_MASS, "0.25,0.04,10,1400" if insulated else "0.066,0.04,12,840"
    heading = HEADING.format(case=case, timesteps=edition.timesteps, site=edition.site, glass=edition.glass,
                             roof=0.4 if insulated else 0.1118)
    glazing = {60: LOW_E, 70: SINGLE}.get(variant, DOUBLE).format(gap=edition.gap)
    control = {40: SETBACK, 50: FANS_AT_NIGHT}.get(variant, THERMOSTAT)
    control = control.format(heat=20, cool=20 if variant in (85, 95) else 27)
    windows = to_the_sides if variant in (20, 30) else to_the_south
    return "\n".join([heading, mass.format(wall=wall), glazing, control, *shell(edition.floor),
                      *windows(case in SHADED)])  # fmt: skip


def find_weather(edition):
    """The path of an edition's weather file, by any of its names."""
    for name in edition.weather[1:]:
        try:
            return energyplus.find_weather(name)
        except FileNotFoundError:
            pass
    return energyplus.find_weather(edition.weather[0])


def run(edition, case, program, options, folder):
    """The run of a case for its year; FileNotFoundError if the standard's weather file is missing."""
    weather = find_weather(edition)
    folder.mkdir()
    (folder / "case.idf").write_text(model(edition, case))
    done = energyplus.run(program, folder / "case.idf", weather, folder / "out", options)
    if not done.completed:
        raise RuntimeError(f"case {case}: {done.why()}")
    return done


def quantities(done):
    """{name: value}, as in UNITS. Peaks are of an hour's mean, and the transmitted sun is that of the windows to the
    south or else to the west, as in the standard."""
    hours = [values_of(done, variable)["ROOM"] for variable in (results.HEATING, results.COOLING)]
    loads = (*(sum(values) / J_PER_MWH for values in hours), *(max(values) / J_PER_KWH for values in hours))
    sunny = [sum(values) for key, values in values_of(done, TRANSMITTED).items() if key.startswith(("SOUTH", "WEST"))]
    area = len(sunny) * WIDTH * (HEAD - SILL)
    return dict(zip(LOADS, loads, strict=True)) | {"transmitted": sum(sunny) / J_PER_KWH / area}


def beam(done):
    """Beam through all windows in the year, MWh."""
    return sum(sum(each) for each in values_of(done, results.BEAM).values()) / J_PER_MWH


def is_within(value, bounds):
    return bounds[0] <= round(value, 3) <= bounds[1]
