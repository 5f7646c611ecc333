"""All of the light that ground, shades and neighbours reflect (--gpu-shading-reflections), in whole runs."""

import math
import re
import subprocess

import pytest
import radiance
import radiance_reflections
from output_files import rows_of, values_of
from reflecting_scenes import (
    BY_GROUND,
    BY_SHADES,
    GLASS,
    INCIDENT,
    PARTS,
    SCENES,
    WINDOW,
    Comparison,
    awning,
    bare,
    egg_crate,
    louvres,
    reflectances,
    reflected_of,
    run_days,
    shade,
    street,
    suns_of,
    with_days,
)
from shading_runs import energyplus


@pytest.mark.parametrize("scene", SCENES)
@pytest.mark.parametrize("reflectance", [0.2, 0.5, 0.8])
def test_reflected_light_is_radiance_s(patched, weather, tmp_path, box, scene, reflectance):
    """tests/bench/reflected_light.py has more suns and points."""
    if radiance.is_missing():
        pytest.skip(f"{radiance.FOLDER} is missing: scripts/setup could not fetch pyradiance")
    points = 200
    found = Comparison(patched, weather, tmp_path, box, scene, reflectance, (6, 9, 12))
    suns = radiance.spread(list(found.ours), 7)
    theirs = {sun: found.theirs(sun, points) for sun in suns}
    for sun in suns:
        print(f"{scene} {reflectance} {sun[0]:6.1f} {sun[1]:5.1f}: {found.ours[sun]:.4f} {theirs[sun]:.4f}")
    mean = sum(theirs.values()) / len(suns)
    all_light = sum(theirs[sun] + found.direct[sun] for sun in suns) / len(suns)
    rms = math.sqrt(sum((found.ours[sun] - theirs[sun]) ** 2 for sun in suns) / len(suns)) / all_light
    sky = found.their_sky(4 * points)  # Radiance draws others in each run
    print(f"{scene} {reflectance}: sum {sum(found.ours[sun] for sun in suns) / mean / len(suns):.4f}, rms {rms:.4f}, "
          f"sky {found.our_sky:.4f} {sky:.4f}")
    assert sum(found.ours[sun] for sun in suns) == pytest.approx(mean * len(suns), rel=0.045)
    assert abs(sum(found.ours[sun] for sun in suns) / len(suns) - mean) < 0.025 * all_light
    assert rms < 0.05
    assert found.our_sky == pytest.approx(sky, abs=0.03 * (sky + found.sky_direct))


def test_sky_by_patch_is_radiance_s(patched, weather, tmp_path, box):
    """A clear sky, bright around the sun, in a street that is open to the south-west."""
    if radiance.is_missing():
        pytest.skip(f"{radiance.FOLDER} is missing: scripts/setup could not fetch pyradiance")
    text = with_days(bare(box) + street(0.5), (6,), 600, 150)
    light = {}
    for sky in ("perez-patches", "energyplus"):
        model, run = run_days(patched, weather, tmp_path, text, f"--gpu-shading-sky={sky}")
        light[sky] = reflected_of(run)
    surfaces = radiance.surfaces(patched.parent / "gpu_shading", model)
    differences = []
    for hour in (8, 12, 16):
        sun = suns_of(run)[hour]
        theirs = [strength * radiance_reflections.reflected(surfaces, WINDOW, each, tmp_path, reflectances(0.5),
                                                            {WINDOW: GLASS})
                  for strength, each in ((600, radiance_reflections.sun(radiance.towards(sun))),
                                         (1, radiance_reflections.perez_sky(sun, 600, 150)))]
        ours = {sky: values[hour] for sky, values in light.items()}
        print(sun, ours, theirs)
        assert ours["perez-patches"] == pytest.approx(sum(theirs), rel=0.03)
        differences.append(abs(ours["perez-patches"] - ours["energyplus"]))
    assert max(differences) > 1


def test_incident_light_is_the_sum_of_its_parts(patched, weather, tmp_path, box):
    """At each timestep, for windows, walls and the flat roof, with beam and sky."""
    _, run = run_days(patched, weather, tmp_path, with_days(bare(box) + street(0.5), (3, 6), 700, 150))
    total, parts = values_of(run, INCIDENT.format("")), [values_of(run, INCIDENT.format(part)) for part in PARTS]
    reflected = [values_of(run, name) for name in (BY_GROUND, BY_SHADES)]
    assert WINDOW in reflected[0] and "ROOF" in reflected[0]
    for name in (WINDOW, "SOUTH", "ROOF"):
        assert max(reflected[1][name]) > 1, name
    for name in reflected[0]:
        for step in range(len(total[name])):
            ground = parts[2][name][step]
            assert total[name][step] == pytest.approx(sum(part[name][step] for part in parts), abs=1e-9), name
            assert ground == pytest.approx(sum(part[name][step] for part in reflected), rel=1e-9, abs=1e-6), name


def test_outputs_have_the_frequency_that_is_asked_for(patched, weather, tmp_path, box):
    monthly = "".join(f"Output:Variable,{WINDOW},{name},Monthly;\n" for name in (BY_GROUND, BY_SHADES))
    _, run = run_days(patched, weather, tmp_path, with_days(bare(box) + street(0.5), (6,), 700, 150) + monthly)
    for name in (BY_GROUND, BY_SHADES):
        steps = values_of(run, name, "Zone Timestep")[WINDOW]
        [mean] = values_of(run, name, "Monthly")[WINDOW]
        assert mean == pytest.approx(sum(steps) / len(steps), rel=1e-9)


def passing(angle, thickness, diameter, share):
    """What passes round holes, straight and black: two discs' overlap."""
    shift = thickness * math.tan(angle) / diameter
    if shift >= 1:
        return 0.0
    return share * 2 / math.pi * (math.acos(shift) - shift * math.sqrt(1 - shift * shift))


def test_a_sheet_dims_light_from_the_ground_by_its_diffuse_transmittance(patched, weather, tmp_path, box):
    thickness, diameter, share = 0.002, 0.005, 0.4
    pitch = diameter * math.sqrt(math.pi / (2 * math.sqrt(3)) / share)
    far = 400.0
    sheet = (shade("Sheet", [(-far, -0.4, far), (-far, -0.4, 0), (far, -0.4, 0), (far, -0.4, far)], 0.0)
             + f"GPUShading:PerforatedScreen,Holes,Sheet,Round,,Staggered60,{diameter},,{pitch},,{thickness};\n")
    text = with_days(bare(box).replace("Until: 24:00,0.7", "") + sheet, (6,), 1000, 0)
    _, run = run_days(patched, weather, tmp_path, text)
    steps = 20_000
    angles = [(i + 0.5) / steps * math.pi / 2 for i in range(steps)]
    diffuse = math.pi / 2 / steps * sum(passing(angle, thickness, diameter, share) * math.sin(2 * angle)
                                        for angle in angles)
    ratios = []
    for sun, light in zip(suns_of(run), values_of(run, BY_GROUND)[WINDOW], strict=True):
        # The sheet's shadow falls behind it.
        if sun[1] >= 40 and 120 < sun[0] < 240:
            ratios.append(light / (1000 * math.sin(math.radians(sun[1])) * 0.2 * 0.5 * diffuse))
    print(ratios)
    assert ratios == pytest.approx([1.0] * len(ratios), abs=0.04)  # 2 % of all light, of which this is half
    assert sum(ratios) / len(ratios) == pytest.approx(1.0, abs=0.02)


def test_a_window_that_is_closed_off_gets_no_light(patched, weather, tmp_path, box):
    front = [(x, -0.3, z) for x, z in ((1, 3), (1, 0.5), (5, 0.5), (5, 3))]
    sides = [front] + [[a, b, (b[0], 0, b[2]), (a[0], 0, a[2])]
                       for a, b in zip(front, front[1:] + front[:1], strict=True)]
    black = "".join(shade(f"Side {number}", corners, 0.0) for number, corners in enumerate(sides))
    text = with_days(bare(box) + black, (6,), 800, 100)
    light = {}
    for option in ("all", "energyplus"):
        _, run = run_days(patched, weather, tmp_path, text, f"--gpu-shading-reflections={option}")
        light[option] = max(values_of(run, INCIDENT.format("Ground Diffuse "))[WINDOW])
    assert light["all"] < 1e-6
    assert light["energyplus"] > 50


@pytest.mark.parametrize("objects, option, ours", [
    ("", "auto", False),
    ("Schedule:Constant,Half,,0.5;\nGPUShading:TransparentShade,Cloth,Awning,Constant,0.5;\n", "auto", True),
    ("GPUShading:TransparentShade,Cloth,Awning,Constant,0.5;\n", "energyplus", False),
    ("", "all", True),
])
def test_who_reflects(patched, weather, tmp_path, box, objects, option, ours):
    text = with_days(bare(box) + awning(0.5) + objects, (6,), 800, 100)
    _, run = run_days(patched, weather, tmp_path, text, f"--gpu-shading-reflections={option}")
    ground = values_of(run, INCIDENT.format("Ground Diffuse "))
    # EnergyPlus gives all vertical surfaces the same.
    assert (ground[WINDOW] == ground["NORTH"]) != ours
    assert bool(values_of(run, BY_GROUND)) == ours
    said = run.folder.joinpath("eplusout.err").read_text()
    assert ("light that ground, shades and neighbours reflect: traced" in said) == ours
    assert ("Reflections is energyplus: GPUShading objects neither reflect" in said) == (
        option == "energyplus" and bool(objects))


def test_a_warning_says_how_much_light_from_the_ground_is_too_high(patched, weather, tmp_path, box):
    """Behind a dense screen, against EnergyPlus's outputs."""
    sheet = (shade("Sheet", [(-9, -0.4, 9), (-9, -0.4, 0), (15, -0.4, 0), (15, -0.4, 9)], 0.2)
             + "GPUShading:PerforatedScreen,Holes,Sheet,Round,,Staggered60,0.005,,0.012,,0.005;\n")
    model = with_days(bare(box) + sheet, (3, 6, 9, 12), 700, 150)
    _, run = run_days(patched, weather, tmp_path, model, "--gpu-shading-reflections=energyplus")
    _, traced = run_days(patched, weather, tmp_path, model)
    shares = {}
    times = {}
    for name in ("SOUTH", WINDOW, "EAST", "WEST", "NORTH", "ROOF"):
        beam, sky, ground = (sum(values_of(run, INCIDENT.format(part))[name]) for part in PARTS)
        shares[name] = 100 * ground / (beam + sky + ground)
        times[name] = ground / max(1e-9, sum(values_of(traced, INCIDENT.format(PARTS[2]))[name]))
    assert shares[WINDOW] > 50 and shares["ROOF"] == 0
    [said] = re.findall(r"light from the ground that no GPUShading object.*?; see",
                        re.sub(r"\s*\*\*\s*~~~\s*\*\*\s*", " ", (run.folder / "eplusout.err").read_text()), re.S)
    assert f"on {sum(share > 10 for share in shares.values())} surfaces: " in said
    named = {name.strip(): (float(share), float(ratio))
             for name, share, ratio in re.findall(r"([A-Z ]+) \((\d+) %, ([\d.]+) times all reflected light\)", said)}
    assert {name: share for name, (share, _) in named.items()} == {
        name: round(shares[name]) for name in sorted(shares, key=lambda name: -shares[name])[:3]}
    assert times[WINDOW] > 5
    for name, (_, ratio) in named.items():
        assert ratio == pytest.approx(times[name], rel=0.15)


DOWN_AFTER_NOON = """
Schedule:Compact,Down,,Through: 12/31,For: AllDays,Until: 12:00,0,Until: 24:00,1;
"""


def noons(run, name=WINDOW):
    """Reflected light of the hours before and after noon of a day of constant irradiance."""
    values = reflected_of(run, name)
    return values[10], values[13]


def test_a_screen_that_is_lowered_dims_from_then_on(patched, weather, tmp_path, box):
    """Without beam, all light of a day is the same but for the schedule."""
    sheet = (shade("Sheet", [(-9, -0.4, 9), (-9, -0.4, 0), (15, -0.4, 0), (15, -0.4, 9)], 0.2) + DOWN_AFTER_NOON
             + "GPUShading:PerforatedScreen,Holes,Sheet,Round,,Staggered60,0.005,,0.008,,0.003,,,,,,,,,,,Down;\n")
    _, run = run_days(patched, weather, tmp_path, with_days(bare(box) + sheet, (6,), 0, 300))
    raised, lowered = noons(run)
    _, run = run_days(patched, weather, tmp_path, with_days(bare(box), (6,), 0, 300))
    assert raised == pytest.approx(noons(run)[0], rel=0.03)
    always = sheet.replace("12:00,0", "12:00,1")
    _, run = run_days(patched, weather, tmp_path, with_days(bare(box) + always, (6,), 0, 300))
    assert lowered == pytest.approx(noons(run)[1], rel=0.03)
    assert lowered < 0.5 * raised


def test_a_shade_that_moves_reflects_from_where_it_stands(patched, weather, tmp_path, box):
    shelf = awning(0.8)
    moving = DOWN_AFTER_NOON.replace(",0,", ",-90,").replace(",1;", ",0;") + (
        "GPUShading:MovingShade,Flap,Awning,Rotate,Edge,1,0,0,,,,-90,0,45,,Schedule,Down;\n")
    _, run = run_days(patched, weather, tmp_path, with_days(bare(box) + shelf + moving, (6,), 0, 300))
    folded, out = noons(run)
    _, run = run_days(patched, weather, tmp_path, with_days(bare(box) + shelf, (6,), 0, 300))
    assert out == pytest.approx(noons(run)[1], rel=0.03)
    assert folded != pytest.approx(out, rel=0.1)


def test_one_thread_gives_the_same_as_two(patched, weather, tmp_path, box):
    text = with_days(bare(box) + egg_crate(0.5), (3,), 700, 150)
    runs = [run_days(patched, weather, tmp_path, text, f"--gpu-shading-threads={threads}")[1] for threads in (1, 2)]
    assert [values_of(run, BY_SHADES) for run in runs][0] == values_of(runs[1], BY_SHADES)


def test_monthly_and_snowy_ground_is_weighed(patched, weather, tmp_path, box):
    months = "Site:GroundReflectance,0.6,0.6,0.6,0.6,0.6,0.3,0.3,0.3,0.3,0.3,0.6,0.6;\n"
    _, run = run_days(patched, weather, tmp_path, with_days(bare(box) + months, (3, 6), 0, 300))
    march, june = (values_of(run, BY_GROUND)[WINDOW][i] for i in (11, 24 + 11))
    assert march / june == pytest.approx(2.0, rel=0.01)  # more where the wall and the ground reflect to one another


def test_epjson_gives_the_same(patched, weather, tmp_path, box):
    text = with_days(bare(box) + street(0.5), (3,), 700, 150)
    model, run = run_days(patched, weather, tmp_path, text)
    converted = subprocess.run([energyplus.official_prefix() / "energyplus", "--convert-only", "-d", tmp_path, model],
                               capture_output=True, text=True)
    assert converted.returncode == 0, converted.stderr
    again = energyplus.run(patched, tmp_path / "model.epJSON", weather, tmp_path / "json",
                           ["-D", "--gpu-shading", "--gpu-shading-reflections=all"])
    assert again.completed, again.why()
    ours, theirs = (values_of(each, BY_SHADES)[WINDOW] for each in (run, again))
    assert theirs == pytest.approx(ours, rel=1e-6)


GROUND_LIGHT = INCIDENT.format("Ground Diffuse ")


def with_two_days(model):
    """With a run period of two days instead of its own."""
    model = re.sub(r"RunPeriod,.*?;[^\n]*\n", "", model, flags=re.S)
    return model + "RunPeriod,Days,1,30,,1,31,,,No,No,No,Yes,Yes;\n"


def ground_light(patched, weather, folder, model, *options):
    run = energyplus.run(patched, model, weather, folder, ["--gpu-shading", *options])
    assert run.completed, run.why()
    return values_of(run, GROUND_LIGHT)


@pytest.mark.parametrize("method", ["scheduled", "opengl"])
def test_methods_without_a_patch_pass_the_same_light(patched, weather, tmp_path, box, method):
    """In run periods and, on other dates, design days."""
    text = with_days(bare(box) + street(0.5) + louvres(0.7), (6,), 700, 150)
    snow = "Site:GroundReflectance,0.6,0.3,0.3,0.3,0.3,0.3,0.3,0.3,0.3,0.3,0.3,0.3;\n"
    model = tmp_path / "model.idf"
    model.write_text(with_two_days(text) + snow)
    ours, theirs = (ground_light(patched, weather, tmp_path / name, model, "--gpu-shading-reflections=all",
                                 f"--gpu-shading-method={name}") for name in ("patched", method))
    assert max(ours[WINDOW]) > 20
    for name, light in ours.items():
        assert theirs[name] == pytest.approx(light, rel=1e-6, abs=1e-6), name


def test_an_exported_model_has_its_light_in_files(patched, weather, tmp_path, box):
    """Any EnergyPlus of the release reads them."""
    sheet = (shade("Sheet", [(-9, -0.4, 9), (-9, -0.4, 0), (15, -0.4, 0), (15, -0.4, 9)], 0.2) + DOWN_AFTER_NOON
             + "GPUShading:PerforatedScreen,Holes,Sheet,Round,,Staggered60,0.005,,0.008,,0.003,,,,,,,,,,,Down;\n")
    model = tmp_path / "model.idf"
    model.write_text(with_two_days(with_days(bare(box) + sheet, (6,), 700, 150)))
    ours = ground_light(patched, weather, tmp_path / "run", model)
    exported = tmp_path / "exported"
    done = subprocess.run([patched.parent / "gpu_shading", "export", model, "-w", weather, "--scheduled", exported],
                          capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    run = energyplus.run(energyplus.official_prefix() / "energyplus", exported / "model.idf", weather,
                         tmp_path / "stock")
    assert run.completed, run.why()
    theirs = values_of(run, GROUND_LIGHT)
    for name, light in ours.items():
        assert theirs[name] == pytest.approx(light, rel=1e-6, abs=1e-6), name


LIGHT = ("beam", "sky", "reflected by ground", "reflected by shades", "all")


@pytest.mark.parametrize("distribution, option, shades", [
    ("FullExterior", "all", louvres), ("FullExterior", "energyplus", street),
    ("FullExteriorWithReflections", "energyplus", street)])
def test_the_report_has_the_light_of_each_month_and_hour(patched, weather, tmp_path, box, distribution, option, shades):
    """Against EnergyPlus's outputs, from which the sky's part is read at each timestep."""
    text = re.sub(r"Full(In|Ex)terior[A-Za-z]*", distribution, bare(box)) + shades(0.5) + "Output:SQLite,Simple;\n"
    text = re.sub(r"Output:Variable,[^;]*;[^\n]*\n", "", text)
    text = text.replace("Timestep,4;", "Timestep,2;") + "".join(
        f"Output:Variable,*,{INCIDENT.format(part)},Hourly;\n" for part in ("", *PARTS))
    (tmp_path / "model.idf").write_text(text)
    report = tmp_path / "report"
    run = energyplus.run(patched, tmp_path / "model.idf", weather, tmp_path / "out",
                         ["--gpu-shading", f"--gpu-shading-reflections={option}", f"--gpu-shading-report={report}"])
    assert run.completed, run.why()
    theirs = {part: values_of(run, INCIDENT.format(part)) for part in ("", *PARTS)}
    months = {(row["receiver"], int(row["month"])): row for row in rows_of(report / "run_months.csv")}
    mean_days = {(row["receiver"], int(row["month"]), int(row["hour"])): row
                 for row in rows_of(report / "run_mean_days.csv")}
    receivers = {name for name, _ in months}
    assert receivers >= {WINDOW, "SOUTH", "ROOF"}
    begin = 0
    for month, days in enumerate((31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31), start=1):
        for name in receivers:
            expected = {part: values[name][begin:begin + 24 * days] for part, values in theirs.items()}
            row = {kind: float(months[name, month][f"{kind} [kWh/m2]"]) for kind in LIGHT}
            assert row["beam"] == pytest.approx(sum(expected["Beam "]) / 1000, abs=0.051 + 1e-4 * row["beam"])
            assert row["sky"] == pytest.approx(sum(expected["Sky Diffuse "]) / 1000, abs=0.051)
            assert row["all"] == pytest.approx(sum(expected[""]) / 1000, abs=0.051 + 1e-4 * row["beam"])
            assert row["all"] == pytest.approx(sum(row[kind] for kind in LIGHT[:-1]), abs=0.21)
            for hour in range(1, 25):
                total = sum(expected[""][hour - 1::24]) / days
                found = mean_days.get((name, month, hour))
                assert float(found["all [W/m2]"] if found else 0) == pytest.approx(total, abs=0.06 + 1e-4 * total)
        begin += 24 * days
    by_shades = max(float(row["reflected by shades [kWh/m2]"]) for row in months.values())
    assert (by_shades > 1) == (option == "all" or "With" in distribution)
