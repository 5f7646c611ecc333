"""gpu_shading.pv: power of partly shaded modules against pvlib's own functions, one cell at a time, and Martinez's
measured blocks."""

import re
import sys
import xml.etree.ElementTree as ET

import numpy as np
import pytest
import test_modules
from shading_runs import energyplus

sys.path.insert(0, str(energyplus.REPOSITORY / "gpu_shading" / "python"))
sys.path.append(str(energyplus.REPOSITORY / ".venv" / "tools"))
pvlib = pytest.importorskip("pvlib", reason="pvlib is missing: run scripts/setup")

from gpu_shading.drawings import Picture  # noqa: E402

import gpu_shading  # noqa: E402
from gpu_shading import pv, pv_modules  # noqa: E402

# A module of 60 cells, as the CEC has them.
MODULE = {"alpha_sc": 0.0039, "a_ref": 1.56, "I_L_ref": 9.31, "I_o_ref": 2.1e-10, "R_sh_ref": 832.0, "R_s": 0.268,
          "Adjust": -3.2, "N_s": 60}


def modules(cells, strings=None, beam=800.0, sky_view=None, half_cut=False):
    """Level modules at noon of an equinox on the equator, the sun in the zenith."""
    cells = np.round(65535 * np.asarray(cells, float)).astype(np.uint16)
    times, number = cells.shape[:2]
    field = pv_modules.ModuleField(
        "Deck", cells, np.zeros(number, int) if strings is None else np.array(strings),
        np.array([(i, 0) for i in range(number)]),
        180.0, 0.0, np.ones(number) if sky_view is None else np.array(sky_view), 1.0, 3, half_cut, 1.6,
        Picture(b""))
    row = {"month": "3", "day": "21", "hour": "12", "timestep": "1", "sun azimuth [deg]": "180",
           "sun altitude [deg]": "89.9", "beam [W/m2]": str(beam), "diffuse [W/m2]": "100", "air [C]": "20",
           "wind [m/s]": "2"}
    return pv_modules.Modules([field], [row] * times, 2017, 1)


def voltage_at(current, curve):
    """Of one cell, which passes more than its light current in reverse only."""
    optimize = pytest.importorskip("scipy.optimize")
    diode = optimize.brentq(lambda volts: pvlib.singlediode.bishop88(volts, *curve, **pv.REVERSE)[0] - current,
                            0.9999 * pv.REVERSE["breakdown_voltage"], 1.0)
    return pvlib.singlediode.bishop88(diode, *curve, **pv.REVERSE)[1]


def test_a_module_as_pvlib_s_cells_in_series():
    cells = np.ones((3, 1, 10, 6))
    cells[1, 0, :3, :2] = 0.0  # six cells of the first diode
    cells[2, 0, 0, :] = 0.35  # a cell of each column
    shaded = modules(cells)
    [power] = gpu_shading.power(shaded, MODULE)
    light = pv._irradiance(shaded[0], shaded, 0.2)
    for i in range(3):
        each = (light.beam[i] * cells[i] + light.sky[i] + light.ground[i]).reshape(10, 3, 2)
        temperature = pvlib.temperature.faiman(each.mean(), 20.0, 2.0)
        per_cell = {**{key: MODULE[key] for key in ("alpha_sc", "I_L_ref", "I_o_ref", "Adjust")},
                    **{key: MODULE[key] / 60 for key in ("a_ref", "R_sh_ref", "R_s")}}
        current = np.linspace(0.5, 9.0, 300)
        voltage = np.zeros_like(current)
        for block in range(3):
            levels, counts = np.unique(each[:, block], return_counts=True)
            of_block = np.zeros_like(current)
            for level, count in zip(levels, counts, strict=True):
                curve = pvlib.pvsystem.calcparams_cec(level, temperature, **per_cell)
                of_block += count * np.array([voltage_at(amps, curve) for amps in current])
            voltage += np.maximum(of_block, -0.5)
        expected = (current * voltage).max()
        print(f"{power.module_with[i, 0]:.2f} W, by pvlib cell by cell {expected:.2f} W")
        assert power.module_with[i, 0] == pytest.approx(expected, rel=1e-3)
        whole = pvlib.pvsystem.calcparams_cec(each.mean(), temperature, **{key: MODULE[key] for key in MODULE
                                                                          if key != "N_s"})
        assert power.module_without[i, 0] == pytest.approx(
            pvlib.pvsystem.singlediode(*whole)["p_mp"], rel=2e-3)
    # Two of three diodes work on; a dark cell in each column stops them all.
    assert power.module_with[1, 0] / power.module_with[0, 0] == pytest.approx(2 / 3, abs=0.04)
    assert power.module_with[2, 0] / power.module_with[0, 0] < 0.5


@pytest.mark.parametrize("shade", [1.0, 0.7, 0.2, 0.0])
def test_halves_of_a_half_cut_module_are_in_parallel(shade):
    cells = np.ones((1, 1, 20, 6))
    cells[0, 0, :10] = shade
    shaded = modules(cells, half_cut=True)
    [power] = gpu_shading.power(shaded, MODULE)
    light = pv._irradiance(shaded[0], shaded, 0.2)
    rest = light.sky[0] + light.ground[0]
    temperature = pvlib.temperature.faiman(light.beam[0] * (1 + shade) / 2 + rest, 20.0, 2.0)
    volts = np.linspace(0.0, 45.0, 20001)
    amps = sum(pvlib.pvsystem.i_from_v(volts, *(pvlib.pvsystem.calcparams_cec(
        light.beam[0] * lit + rest, temperature, **{key: MODULE[key] for key in MODULE if key != "N_s"})[k]
        for k in (0, 1, 2, 3, 4))) for lit in (1.0, shade)) / 2
    expected = (volts * amps).max()
    print(f"{power.module_with[0, 0]:.2f} W, by pvlib {expected:.2f} W")
    assert power.module_with[0, 0] == pytest.approx(expected, rel=1e-3)
    if shade == 0.0:
        # The upper half goes on; in one series, all would be lost.
        assert power.module_with[0, 0] / power.module_without[0, 0] > 0.9


def test_levels_of_mismatch():
    cells = np.ones((2, 4, 10, 6))
    cells[1, 2, :, :] = 0.5  # one of four modules: no mismatch in itself
    [power] = gpu_shading.power(modules(cells, strings=[0, 0, 1, 1]), MODULE)
    assert power.module_with[0] == pytest.approx(power.module_without[0], rel=1e-9)
    assert power.surface_with[0] == pytest.approx(power.surface_without[0], rel=1e-9)
    assert power.reduction[0] == pytest.approx(0.0, abs=1e-9)
    assert power.module_with[1] == pytest.approx(power.module_without[1], rel=2e-3)
    assert power.string_with[1, 0] == pytest.approx(power.string_with[0, 0], rel=0.02)  # cooler
    assert power.string_with[1, 1] < 0.8 * power.string_without[1, 1]
    assert power.surface_with[1] == pytest.approx(power.string_with[1].sum())
    # The beam is reduced until the irradiance of all has lost what the power has.
    lost = 1 - power.surface_with[1] / power.surface_without[1]
    beam, rest = 800.0, 100.0
    before = beam * power.sunlit[1] + rest
    assert beam * (power.sunlit[1] - power.reduction[1]) + rest == pytest.approx(before * (1 - lost), rel=0.02)
    assert 0 < power.loss < 0.2
    picture = ET.fromstring(power.svg(1))
    told = [title.text for title in picture.iter("{http://www.w3.org/2000/svg}title")]
    assert told[:4] == ["0.0%"] * 4  # modules
    assert told[5] == f"{1 - power.string_with[1, 1] / power.string_without[1, 1]:.1%}"
    frame = pytest.importorskip("pandas") and power.frame()
    assert frame["surface", 1, "with"].to_numpy() == pytest.approx(power.surface_with)
    assert frame.shape == (2, 2 * (1 + 2 + 4))


def test_tables_are_written_as_parquet(tmp_path):
    pandas = pytest.importorskip("pandas")
    pytest.importorskip("fastparquet")
    shaded = modules(np.linspace(0.25, 1.0, 2 * 4 * 60).reshape(2, 4, 10, 6), strings=[0, 0, 1, 1])
    [power] = gpu_shading.power(shaded, MODULE)
    shaded.write(tmp_path / "modules.parquet")
    power.write(tmp_path / "power.parquet")
    again = pandas.read_parquet(tmp_path / "modules.parquet")
    assert again.to_numpy() == pytest.approx(shaded[0].cells.mean(axis=(2, 3)) / 65535)
    assert list(again.columns) == ["Deck 1 1 1", "Deck 1 2 1", "Deck 2 3 1", "Deck 2 4 1"]
    again = pandas.read_parquet(tmp_path / "power.parquet")
    assert again["string 2 with"].to_numpy() == pytest.approx(power.string_with[:, 1])
    with pytest.raises(gpu_shading.InvalidInput, match=r"expected a name that ends in \.parquet"):
        power.write(tmp_path / "power.csv")
    assert sorted(path.name for path in tmp_path.iterdir()) == ["modules.parquet", "power.parquet"]


def test_a_darker_sky_is_mismatch_too():
    [power] = gpu_shading.power(modules(np.zeros((1, 2, 10, 6)), sky_view=[1.0, 0.5], beam=0.0), MODULE)
    assert power.module_with[0, 1] == pytest.approx(power.module_with[0, 0] / 2, rel=0.1)
    assert power.string_with[0, 0] < 0.9 * power.string_without[0, 0]


def test_wrong_parameters_are_named():
    with pytest.raises(gpu_shading.InvalidInput, match="'No such' is not in pvlib's table"):
        gpu_shading.power(modules(np.ones((1, 1, 10, 6))), "No such")
    with pytest.raises(gpu_shading.InvalidInput, match="R_s, N_s missing"):
        gpu_shading.power(modules(np.ones((1, 1, 10, 6))), dict(list(MODULE.items())[:5], Adjust=0.0))
    with pytest.raises(gpu_shading.InvalidInput, match="N_s is 72, but modules on Deck have 10 x 6 cells, 60 in"):
        gpu_shading.power(modules(np.ones((1, 1, 10, 6))), {**MODULE, "N_s": 72})


# F. Martinez-Moreno, J. Munoz and E. Lorenzo, Solar Energy Materials and Solar Cells 94 (2010), table 2, as pvlib's
# tests have it: shaded part of the width and of the height, shaded blocks of 16, direct and diffuse irradiance (W/m2),
# loss of power by the model.
MARTINEZ = [
    (1.00, 0.09, 16, 846.59, 59.42, 0.8844), (1.00, 0.18, 16, 841.85, 59.69, 0.8888),
    (1.00, 0.36, 16, 843.38, 59.22, 0.8994), (0.04, 0.64, 1, 851.90, 59.40, 0.0783),
    (0.17, 0.45, 3, 862.86, 58.40, 0.2237), (0.29, 0.27, 5, 864.14, 58.11, 0.3282),
    (0.50, 0.09, 8, 863.23, 58.31, 0.4634), (0.13, 1.00, 2, 870.14, 58.02, 0.2137),
    (0.25, 1.00, 4, 876.57, 57.98, 0.4000), (0.38, 1.00, 6, 866.86, 58.89, 0.5577),
    (0.50, 1.00, 8, 874.58, 58.44, 0.6892), (0.58, 0.82, 10, 876.80, 58.16, 0.7359),
    (0.75, 0.73, 12, 866.89, 58.73, 0.8113), (0.92, 0.64, 15, 861.48, 59.66, 0.8894)]


def test_martinez_s_blocks(patched, weather, tmp_path):
    """Decks of 8 modules with two diodes, 16 blocks side by side, each behind a plate as large as the shade."""
    decks = ""
    for i, (wide, high, *_) in enumerate(MARTINEZ):
        y, width, height = 3.0 * i, 8.0 * wide, 1.6 * high
        # Eighths of the width are rounded in the table; the plates end before the next block.
        width = 8.0 * round(16 * wide) / 16 - 0.01 if wide in (0.13, 0.25, 0.38, 0.5, 0.75) else width
        for name, z, right, back in (("Deck", 9, 28, y + 1.6), ("Plate", 9.001, 20 + width, y + height)):
            decks += (f"Shading:Building:Detailed,{name} {i},,4, "
                      f"20,{back},{z}, 20,{y},{z}, {right},{y},{z}, {right},{back},{z};\n")
    decks += "GPUShading:PVModules,Modules,Deck *,1,1.6,,6,10,2,0,0;\n"
    shaded = test_modules.Shaded(test_modules.HALL + decks, weather, tmp_path, "--from", "06-21", "--to", "06-21")
    noon = max(range(len(shaded.times)), key=lambda i: shaded.suns[i][2])
    fields = pv_modules.read_modules(shaded.folder)
    for i, (_, _, blocks, direct, diffuse, expected) in enumerate(MARTINEZ):
        field = fields[f"Deck {i}"]
        found = field.blocks()[noon].sum()
        loss = pvlib.shading.direct_martinez(direct + diffuse, direct, 1 - field.sunlit[noon].mean(), found, 16)
        print(f"{found} blocks, loss {loss:.4f}, in the paper {expected:.4f}")
        assert found == blocks
        assert loss == pytest.approx(expected, abs=5e-3)  # as in pvlib's test


DAYS = "RunPeriod,Year,12,18,,12,22"


@pytest.fixture(scope="module")
def winter(patched, weather, tmp_path_factory):
    """The example in five days of December: (model, weather, power by row)"""
    folder = tmp_path_factory.mktemp("winter")
    text = test_modules.EXAMPLE.read_text().replace("RunPeriod,Year,1,1,,12,31", DAYS)
    (folder / "pv_roof.idf").write_text(text + "Output:Variable,*,Generator Produced DC Electricity Energy,Timestep;\n")
    cells = gpu_shading.modules(folder / "pv_roof.idf", weather, first="12-18", last="12-22")
    return folder / "pv_roof.idf", weather, gpu_shading.power(cells, {**MODULE, "I_L_ref": 9.3})


def test_generators_and_load_centres_lose_what_strings_lose(winter, tmp_path):
    model, weather, powers = winter
    runs = [gpu_shading.run(model, weather, tmp_path / name, pv=pv) for name, pv in (("plain", None), ("pv", powers))]
    energies = [run.values("Generator Produced DC Electricity Energy", "TimeStep") for run in runs]
    for number, power in enumerate(powers, 1):
        before, after = (energy[f"GENERATOR {number}"].sum() for energy in energies)
        expected = power.surface_with.sum() / power.surface_without.sum()
        print(f"{power.name}: {after / before:.3f} of EnergyPlus's energy is left, {expected:.3f} by pvlib")
        assert f"--gpu-shading-pv: {power.name}: sunlit fraction reduced at " in " ".join(runs[1].messages)
        # PVWatts has light of the sky that nothing shades: it cannot lose more than its beam.
        low, high = (-0.02, 0.15) if number == 1 else (-0.03, 0.03)
        assert low < after / before - expected < high and expected < 0.9
    produced = [run.values("Electric Load Center Produced Electricity Energy", "Monthly") for run in runs]
    before, after = (sum(energy[f"GENERATOR {number}"].sum() for number in (2, 3)) for energy in energies)
    # Produced before the inverter.
    assert produced[0]["PHOTOVOLTAIC"].sum() - produced[1]["PHOTOVOLTAIC"].sum() == pytest.approx(before - after)


def test_refused_reductions_are_named(winter, tmp_path):
    model, weather, _ = winter
    for row, why in (("12,21,12,1,0.5,0.5,Roof", "is a surface of the building, whose heat balance would change"),
                     ("12,21,12,1,0.5,0.5,Row 4", "no shading surface of the model; did you mean"),
                     ("12,21,12,1,1.5,0.5,Row 1", 'line 2: reduction is "1.5", expected a number from 0 to 1'),
                     ("12,21,25,1,1,1,Row 1", 'hour is "25", expected an integer from 1 to 24')):
        (tmp_path / "pv.csv").write_text(f"month,day,hour,timestep,reduction,PVWatts,surface\n{row}\n")
        with pytest.raises(gpu_shading.RunError, match=re.escape(why)):
            gpu_shading.run(model, weather, tmp_path / row.replace("/", " "),
                            arguments=[f"--gpu-shading-pv={tmp_path / 'pv.csv'}"])


def test_a_surface_of_pvwatts_is_rendered(patched):
    """Nothing but the generator asks for it."""
    listed = gpu_shading.check(test_modules.EXAMPLE)
    assert [each["receives"] for each in listed["surfaces"] if each["name"].startswith("ROW")] == [True] * 3
