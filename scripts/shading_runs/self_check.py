"""Checks a patched EnergyPlus of a release that was never tested: whether it renders what polygon clipping computes.

The model is a box with a window under an overhang and beside a shade with a Transmittance Schedule, on one design
day. It is epJSON, in which fields have names, so that fields that releases add or move do not matter.
"""

import json
import os
import sqlite3
import subprocess
import tempfile
from contextlib import closing
from pathlib import Path

# Sunlit fractions are rendered to within 0.001; with the tested release the largest difference is 0.0002.
MAX_DIFFERENCE = 0.002
FEWEST_PARTIAL = 40  # fractions between 0.05 and 0.95: what a wrong shadow would change
SECONDS = 300
# Those of shading surfaces are not rendered unless something uses them.
RECEIVERS = ("SOUTH", "EAST", "NORTH", "WEST", "ROOF", "WINDOW")
SUNLIT = "Surface Outside Face Sunlit Fraction"

WIDTH, DEPTH, HEIGHT = 6.0, 4.0, 3.0


class Disagreement(ValueError):
    """Why the release is refused, in one line."""


def _vertices(points):
    return [dict(zip(("vertex_x_coordinate", "vertex_y_coordinate", "vertex_z_coordinate"), point, strict=True))
            for point in points]


def _numbered(points):
    """As windows have them."""
    return {f"vertex_{number}_{axis}_coordinate": value for number, point in enumerate(points, 1)
            for axis, value in zip("xyz", point, strict=True)}


def _wall(kind, points, outside="Outdoors"):
    exposed = outside == "Outdoors"
    return {"surface_type": kind, "construction_name": "Plate", "zone_name": "Box",
            "outside_boundary_condition": outside, "sun_exposure": "SunExposed" if exposed else "NoSun",
            "wind_exposure": "WindExposed" if exposed else "NoWind", "vertices": _vertices(points)}


def model(version):
    """The model, for a release such as "24.2"."""
    w, d, h = WIDTH, DEPTH, HEIGHT
    return {
        "Version": {"Version 1": {"version_identifier": version}},
        "Building": {"Box": {"solar_distribution": "FullExterior", "north_axis": 0, "terrain": "Suburbs"}},
        "GlobalGeometryRules": {"Rules": {"starting_vertex_position": "LowerLeftCorner",
                                          "vertex_entry_direction": "Counterclockwise",
                                          "coordinate_system": "World"}},
        "Timestep": {"Timestep 1": {"number_of_timesteps_per_hour": 4}},
        "SimulationControl": {"Control": {"do_zone_sizing_calculation": "No", "do_system_sizing_calculation": "No",
                                          "do_plant_sizing_calculation": "No",
                                          "run_simulation_for_sizing_periods": "Yes",
                                          "run_simulation_for_weather_file_run_periods": "No"}},
        "Site:Location": {"Site": {"latitude": 42.0, "longitude": -88.0, "time_zone": -6.0, "elevation": 190.0}},
        "SizingPeriod:DesignDay": {"Day": {
            "month": 4, "day_of_month": 21, "day_type": "SummerDesignDay", "maximum_dry_bulb_temperature": 25.0,
            "daily_dry_bulb_temperature_range": 10.0, "humidity_condition_type": "WetBulb",
            "wetbulb_or_dewpoint_at_maximum_dry_bulb": 18.0, "barometric_pressure": 99063.0, "wind_speed": 3.0,
            "wind_direction": 200.0, "solar_model_indicator": "ASHRAEClearSky", "sky_clearness": 1.0}},
        "Material": {"Plate": {"roughness": "Smooth", "thickness": 0.1, "conductivity": 0.5, "density": 1000.0,
                               "specific_heat": 900.0}},
        "WindowMaterial:SimpleGlazingSystem": {"Glass": {"u_factor": 2.5, "solar_heat_gain_coefficient": 0.6}},
        "Construction": {"Plate": {"outside_layer": "Plate"}, "Glass": {"outside_layer": "Glass"}},
        "Zone": {"Box": {}},
        "BuildingSurface:Detailed": {
            "South": _wall("Wall", [(0, 0, 0), (w, 0, 0), (w, 0, h), (0, 0, h)]),
            "East": _wall("Wall", [(w, 0, 0), (w, d, 0), (w, d, h), (w, 0, h)]),
            "North": _wall("Wall", [(w, d, 0), (0, d, 0), (0, d, h), (w, d, h)]),
            "West": _wall("Wall", [(0, d, 0), (0, 0, 0), (0, 0, h), (0, d, h)]),
            "Roof": _wall("Roof", [(0, 0, h), (w, 0, h), (w, d, h), (0, d, h)]),
            "Floor": _wall("Floor", [(0, d, 0), (w, d, 0), (w, 0, 0), (0, 0, 0)], "Ground")},
        "FenestrationSurface:Detailed": {"Window": {
            "surface_type": "Window", "construction_name": "Glass", "building_surface_name": "South",
            "number_of_vertices": 4, **_numbered([(2, 0, 1), (4, 0, 1), (4, 0, 2.2), (2, 0, 2.2)])}},
        "ScheduleTypeLimits": {"Fraction": {"lower_limit_value": 0, "upper_limit_value": 1,
                                            "numeric_type": "Continuous"}},
        "Schedule:Constant": {"Leaves": {"schedule_type_limits_name": "Fraction", "hourly_value": 0.4}},
        "Shading:Building:Detailed": {
            "Overhang": {"vertices": _vertices([(1, -1, 2.5), (5, -1, 2.5), (5, 0, 2.5), (1, 0, 2.5)])},
            "Tree": {"transmittance_schedule_name": "Leaves",
                     "vertices": _vertices([(8, -3, 0), (8, 6, 0), (8, 6, 5), (8, -3, 5)])},
            "House": {"vertices": _vertices([(-3, -5, 0), (-3, 3, 0), (-3, 3, 4), (-3, -5, 4)])}},
        "Output:Variable": {"Sunlit": {"key_value": "*", "variable_name": SUNLIT,
                                       "reporting_frequency": "Timestep"}},
        "Output:SQLite": {"Database": {"option_type": "Simple"}},
    }


def _why(folder, done):
    """The first error of a run that failed."""
    errors = folder / "eplusout.err"
    lines = errors.read_text(errors="replace").splitlines() if errors.is_file() else []
    lines = [line for line in lines if "** Severe" in line or "**  Fatal" in line] or done.stderr.splitlines()
    return lines[0].strip(" *").replace("  ** ", ": ") if lines else f"exit status {done.returncode}"


def _run(program, path, folder, options):
    """Sunlit fractions by surface and time, and what was written to standard error."""
    variables = {key: value for key, value in os.environ.items()
                 if key != "DISPLAY" and not key.startswith("GPU_SHADING")}
    command = [program, *options, "-D", "-d", folder, path]
    try:
        done = subprocess.run(command, cwd=folder.parent, env=variables, stdin=subprocess.DEVNULL, capture_output=True,
                              text=True, errors="replace", timeout=SECONDS)
    except (OSError, subprocess.TimeoutExpired) as error:
        raise Disagreement(f"a short run of it failed: {error}") from error
    database = folder / "eplusout.sql"
    if done.returncode != 0 or not database.is_file():
        raise Disagreement(f"a short run of it failed: {_why(folder, done)}")
    with closing(sqlite3.connect(f"{database.as_uri()}?mode=ro", uri=True)) as sql:
        rows = sql.execute("SELECT KeyValue, TimeIndex, Value FROM ReportData JOIN ReportDataDictionary "
                           "USING (ReportDataDictionaryIndex) WHERE Name = ?", (SUNLIT,))
        return {(name, time): value for name, time, value in rows if name in RECEIVERS}, done.stderr


def _compare(rendered, clipped):
    if not clipped or rendered.keys() != clipped.keys():
        raise Disagreement("its runs with and without --gpu-shading have other outputs")
    partial = sum(0.05 < value < 0.95 for value in clipped.values())
    if partial < FEWEST_PARTIAL:
        raise Disagreement(f"polygon clipping shades its test model at {partial} times only")
    surface, time = max(clipped, key=lambda key: abs(rendered[key] - clipped[key]))
    worst = abs(rendered[surface, time] - clipped[surface, time])
    if worst > MAX_DIFFERENCE:
        raise Disagreement(f"it renders a sunlit fraction of {surface} that differs by {worst:.3f} from polygon "
                           f"clipping ({rendered[surface, time]:.3f}, {clipped[surface, time]:.3f})")
    return worst


def check(prefix, version):
    """Runs the patched EnergyPlus in a folder. Returns the largest difference of a sunlit fraction.

    version: of EnergyPlus, such as "24.2.0". Raises Disagreement.
    """
    with tempfile.TemporaryDirectory(prefix="gpu_shading_check.") as temporary:
        path = Path(temporary, "model.epJSON")
        path.write_text(json.dumps(model(".".join(version.split(".")[:2]))))
        program = Path(prefix) / "energyplus"
        clipped, _ = _run(program, path, Path(temporary, "clipped"), [])
        rendered, said = _run(program, path, Path(temporary, "rendered"), ["--gpu-shading"])
        if "rendered by" not in said:
            raise Disagreement("a short run of it with --gpu-shading rendered nothing")
        return _compare(rendered, clipped)
