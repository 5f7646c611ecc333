#!/usr/bin/env python3
"""Writes the model of one box with a south window behind N louvres.

    generate.py N > box_with_louvres.idf

The louvres are rectangles in up to 20 rows in front of the window, each row cut into pieces to give N in total. Beyond
20, the shadows hardly change with N, but the work does.
"""

import sys

# Metres; x east, y north, z up. The south-west corner of the box is at the origin.
WIDTH, DEPTH, HEIGHT = 6.0, 6.0, 3.0
WINDOW = (1.5, 0.8, 4.5, 2.8)  # x, z, x, z in the south wall
MAX_ROWS = 20
BLADE_DEPTH = 0.08
BLADE_DROP = 0.04  # how much lower the outer edge is than the inner one
BLADE_DISTANCE = 0.05  # from the wall to the inner edge
PIECE_SHARE = 0.95  # fraction of its part of a row that a piece covers, if a row has several

HEAD = """\
! One box with one south window and {n} louvres before it. Written by generate.py {n}.
! Weather: USA_CO_Golden-NREL.724666_TMY3.epw, which comes with EnergyPlus.

Version,25.2;

SimulationControl,
  No,                      !- Do Zone Sizing Calculation
  No,                      !- Do System Sizing Calculation
  No,                      !- Do Plant Sizing Calculation
  No,                      !- Run Simulation for Sizing Periods
  Yes;                     !- Run Simulation for Weather File Run Periods

ShadowCalculation,
  PolygonClipping,         !- Shading Calculation Method
  Periodic,                !- Shading Calculation Update Frequency Method
  20;                      !- Shading Calculation Update Frequency

Building,
  Box with Louvres,        !- Name
  0,                       !- North Axis {{deg}}
  Country,                 !- Terrain
  0.04,                    !- Loads Convergence Tolerance Value {{W}}
  0.2,                     !- Temperature Convergence Tolerance Value {{deltaC}}
  FullInteriorAndExterior, !- Solar Distribution
  30,                      !- Maximum Number of Warmup Days
  6;                       !- Minimum Number of Warmup Days

Timestep,4;

Site:Location,
  Golden,                  !- Name
  39.74,                   !- Latitude {{deg}}
  -105.18,                 !- Longitude {{deg}}
  -7,                      !- Time Zone {{hr}}
  1829;                    !- Elevation {{m}}

RunPeriod,
  Year,                    !- Name
  1,                       !- Begin Month
  1,                       !- Begin Day of Month
  ,                        !- Begin Year
  12,                      !- End Month
  31,                      !- End Day of Month
  ,                        !- End Year
  Sunday;                  !- Day of Week for Start Day

SizingPeriod:DesignDay,
  Clear Autumn Day,        !- Name
  10,                      !- Month
  21,                      !- Day of Month
  SummerDesignDay,         !- Day Type
  25,                      !- Maximum Dry-Bulb Temperature {{C}}
  12,                      !- Daily Dry-Bulb Temperature Range {{deltaC}}
  DefaultMultipliers,      !- Dry-Bulb Temperature Range Modifier Type
  ,                        !- Dry-Bulb Temperature Range Modifier Day Schedule Name
  WetBulb,                 !- Humidity Condition Type
  12,                      !- Wetbulb or DewPoint at Maximum Dry-Bulb {{C}}
  ,                        !- Humidity Condition Day Schedule Name
  ,                        !- Humidity Ratio at Maximum Dry-Bulb
  ,                        !- Enthalpy at Maximum Dry-Bulb
  ,                        !- Daily Wet-Bulb Temperature Range
  81000,                   !- Barometric Pressure {{Pa}}
  2,                       !- Wind Speed {{m/s}}
  180,                     !- Wind Direction {{deg}}
  No,                      !- Rain Indicator
  No,                      !- Snow Indicator
  No,                      !- Daylight Saving Time Indicator
  ASHRAEClearSky,          !- Solar Model Indicator
  ,                        !- Beam Solar Day Schedule Name
  ,                        !- Diffuse Solar Day Schedule Name
  ,                        !- ASHRAE Clear Sky Optical Depth for Beam Irradiance
  ,                        !- ASHRAE Clear Sky Optical Depth for Diffuse Irradiance
  1.0;                     !- Sky Clearness

GlobalGeometryRules,UpperLeftCorner,Counterclockwise,World;

Material,Insulation,Rough,0.1,0.04,30,1400;
Material,Block,Rough,0.1,0.5,1400,1000;
WindowMaterial:SimpleGlazingSystem,Glazing,1.4,0.6;
Construction,Outer Wall,Insulation,Block;
Construction,Window,Glazing;

Zone,Box;

ScheduleTypeLimits,Temperature,-100,100,Continuous,Temperature;
ScheduleTypeLimits,Control Type,0,4,Discrete;
Schedule:Constant,Heating Setpoint,Temperature,20;
Schedule:Constant,Cooling Setpoint,Temperature,26;
Schedule:Constant,Dual Setpoint Control,Control Type,4;
ThermostatSetpoint:DualSetpoint,Setpoints,Heating Setpoint,Cooling Setpoint;
ZoneControl:Thermostat,Thermostat,Box,Dual Setpoint Control,ThermostatSetpoint:DualSetpoint,Setpoints;
ZoneHVAC:EquipmentConnections,Box,Equipment,Box Inlet,,Box Air,Box Return;
ZoneHVAC:EquipmentList,Equipment,SequentialLoad,ZoneHVAC:IdealLoadsAirSystem,Ideal Loads,1,1;
ZoneHVAC:IdealLoadsAirSystem,Ideal Loads,,Box Inlet;

Output:Table:SummaryReports,AllSummary;
Output:Meter,Heating:EnergyTransfer,Annual;
Output:Meter,Cooling:EnergyTransfer,Annual;
"""


def vertices(points):
    return ",\n".join("  " + ",".join(f"{value:.6g}" for value in point) for point in points) + ";\n"


def surface(name, kind, boundary, sun, points):
    wind = "WindExposed" if sun == "SunExposed" else "NoWind"
    return (f"\nBuildingSurface:Detailed,\n  {name},{kind},Outer Wall,Box,,{boundary},,{sun},{wind},,4,\n"
            + vertices(points))  # fmt: skip


def box():
    w, d, h = WIDTH, DEPTH, HEIGHT
    outside = ("Outdoors", "SunExposed")
    yield surface("South", "Wall", *outside, [(0, 0, h), (0, 0, 0), (w, 0, 0), (w, 0, h)])
    yield surface("East", "Wall", *outside, [(w, 0, h), (w, 0, 0), (w, d, 0), (w, d, h)])
    yield surface("North", "Wall", *outside, [(w, d, h), (w, d, 0), (0, d, 0), (0, d, h)])
    yield surface("West", "Wall", *outside, [(0, d, h), (0, d, 0), (0, 0, 0), (0, 0, h)])
    yield surface("Roof", "Roof", *outside, [(0, d, h), (0, 0, h), (w, 0, h), (w, d, h)])
    yield surface("Floor", "Floor", "Adiabatic", "NoSun", [(0, 0, 0), (0, d, 0), (w, d, 0), (w, 0, 0)])
    x0, z0, x1, z1 = WINDOW
    yield "\nFenestrationSurface:Detailed,\n  South Window,Window,Window,South,,,,,4,\n"
    yield vertices([(x0, 0, z1), (x0, 0, z0), (x1, 0, z0), (x1, 0, z1)])


def blades(count):
    """The four corners of each louvre, seen from above counter-clockwise."""
    x0, z0, x1, z1 = WINDOW
    rows = min(count, MAX_ROWS)
    for row in range(rows):
        pieces = count // rows + (1 if row < count % rows else 0)
        z = z1 - (z1 - z0) * row / rows
        inner, outer = -BLADE_DISTANCE, -BLADE_DISTANCE - BLADE_DEPTH
        part = (x1 - x0) / pieces
        gap = part * (1 - PIECE_SHARE) / 2 if pieces > 1 else 0.0
        for piece in range(pieces):
            left, right = x0 + piece * part + gap, x0 + (piece + 1) * part - gap
            yield [(left, inner, z), (left, outer, z - BLADE_DROP), (right, outer, z - BLADE_DROP), (right, inner, z)]


def model(count):
    """The whole input file with count louvres, as text."""
    parts = [HEAD.format(n=count), *box()]
    for number, points in enumerate(blades(count), 1):
        parts.append(f"\nShading:Building:Detailed,\n  Louvre {number},,4,\n" + vertices(points))
    return "".join(parts)


if __name__ == "__main__":
    if len(sys.argv) != 2 or not sys.argv[1].isdigit() or int(sys.argv[1]) < 1:
        sys.exit("usage: generate.py N   (N louvres, at least 1)")
    sys.stdout.write(model(int(sys.argv[1])))
