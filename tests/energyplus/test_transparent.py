"""Transparent shades: the model's own transmittance schedules, and GPUShading:TransparentShade."""

import sys

import pytest
from shading_runs import energyplus, input_file, results

# Three panes one behind the other before the south window (x 1.5 to 4.5, z 0.8 to 2.8, y 0), each cutting
# across it elsewhere, so that the window is seen through none, one, two and three of them.
PANES = {"Pane 1": (-0.5, 1.0, 3.2), "Pane 2": (-1.0, 2.2, 4.0), "Pane 3": (-1.5, 2.8, 5.0)}

HALF_EACH = "Schedule:Constant,Half,,0.5;"
# Months and hours differ; the least of the year is 0.2.
VARYING = """
Schedule:Compact,Leaves,,Through: 4/30,For: AllDays,Until: 24:00,0.8,
  Through: 10/31,For: AllDays,Until: 12:00,0.2,Until: 24:00,0.4,Through: 12/31,For: AllDays,Until: 24:00,0.6;
"""
DETAILED = "ShadowCalculation,PolygonClipping,Periodic,20,15000,,512,DetailedSkyDiffuseModeling;"
TIMESTEP = "ShadowCalculation,PolygonClipping,Timestep,20,15000;"
MAX_DIFFERENCE = 1e-3


def panes(schedule):
    text = ""
    for name, (y, x1, x2) in PANES.items():
        corners = ((x1, y, 3.5), (x1, y, 0.0), (x2, y, 0.0), (x2, y, 3.5))
        points = ",".join(f"{c}" for corner in corners for c in corner)
        text += f"Shading:Building:Detailed,{name},{schedule},4,{points};\n"
    return text


def write(text, path, shadow_calculation=None):
    model = input_file.Idf(text)
    if shadow_calculation:
        model.remove(lambda name: name == "shadowcalculation")
        model = input_file.Idf(model.text + "\n" + shadow_calculation)
    results.instrument(model)
    model.write(path)
    return path


def both(text, official, patched, weather, folder, shadow_calculation=None, options=("-D",)):
    path = write(text, folder / "model.idf", shadow_calculation)
    clip = energyplus.run(official, path, weather, folder / "clip", [*options])
    gpu = energyplus.run(patched, path, weather, folder / "gpu", ["--gpu-shading", *options])
    assert clip.completed, clip.why()
    assert gpu.completed, gpu.why()
    assert gpu.method == "PixelCounting"
    assert [message for message in gpu.severe if message not in clip.severe] == []
    return clip, gpu


def assert_alike(clip, gpu):
    reference, answer = results.Results(clip.folder), results.Results(gpu.folder)
    found = results.differences(reference, answer)
    mean, _, largest = results.summary(found)
    print(f"mean {mean:.1e}, max {largest:.1e}")
    assert mean < MAX_DIFFERENCE
    window = next(each for each in found if each.receiver.kind == "Window")
    assert window.mean < MAX_DIFFERENCE
    clipped, ours = (run.total(results.BEAM, window.receiver.name) for run in (reference, answer))
    assert ours == pytest.approx(clipped, rel=1e-3)
    return answer


@pytest.mark.parametrize("schedule, shadow_calculation", [
    (HALF_EACH, None), (VARYING, None), (VARYING, DETAILED), (VARYING, TIMESTEP),
], ids=["constant", "varying", "detailed sky", "timestep"])
def test_overlapping_schedules_are_honoured(schedule, shadow_calculation, official, patched, box, weather, tmp_path):
    name = schedule.split(",")[1].strip()
    clip, gpu = both(box + schedule + panes(name), official, patched, weather, tmp_path, shadow_calculation)
    assert "treated as completely opaque" not in gpu.text("eplusout.err")
    assert_alike(clip, gpu)
    lines = [line for line in gpu.text("eplusout.eio").splitlines() if line.startswith("GPU Shading Surface,")]
    assert len(lines) == 3


def test_sky_diffuse_sees_through_schedules(official, patched, box, weather, tmp_path):
    clip, gpu = both(box + VARYING + panes("Leaves"), official, patched, weather, tmp_path, DETAILED)
    reference, answer = results.Results(clip.folder), results.Results(gpu.folder)
    name = next(name for name, receiver in reference.receivers.items() if receiver.kind == "Window")
    clipped, ours = (run.total(results.SOLAR, name) for run in (reference, answer))
    assert ours == pytest.approx(clipped, rel=2e-3)


def test_constant_shade_is_a_constant_schedule(official, patched, box, weather, tmp_path):
    (tmp_path / "schedule").mkdir()
    scheduled = energyplus.run(official, write(box + HALF_EACH + panes("Half"), tmp_path / "scheduled.idf"), weather,
                               tmp_path / "schedule" / "run", ["-D"])
    shade = "GPUShading:TransparentShade,Glass,pane *,Constant,0.5;\n"
    shaded = energyplus.run(patched, write(box + panes("") + shade, tmp_path / "shaded.idf"), weather,
                            tmp_path / "shade", ["--gpu-shading", "-D"])
    assert scheduled.completed, scheduled.why()
    assert shaded.completed, shaded.why()
    assert_alike(scheduled, shaded)


def test_schedule_and_shade_multiply(official, patched, box, weather, tmp_path):
    quarter = energyplus.run(official, write(box + "Schedule:Constant,Quarter,,0.25;" + panes("Quarter"),
                                             tmp_path / "quarter.idf"), weather, tmp_path / "quarter", ["-D"])
    shade = "GPUShading:TransparentShade,Glass,pane *,Constant,0.5;\n"
    product = energyplus.run(patched, write(box + HALF_EACH + panes("Half") + shade, tmp_path / "product.idf"),
                             weather, tmp_path / "product", ["--gpu-shading", "-D"])
    assert quarter.completed, quarter.why()
    assert product.completed, product.why()
    assert_alike(quarter, product)


EMS = """
EnergyManagementSystem:Actuator,Leaf,Leaves,Schedule:Compact,Schedule Value;
EnergyManagementSystem:ProgramCallingManager,Caller,BeginTimestepBeforePredictor,Fall;
EnergyManagementSystem:Program,Fall,IF Hour >= 12,SET Leaf = 0.9,ELSE,SET Leaf = 0.1,ENDIF;
"""


def test_actuated_schedule_takes_effect(official, patched, box, weather, tmp_path):
    # A Schedule:Constant is not for comparing: EnergyPlus's own shading ignores its override.
    text = box + VARYING + panes("Leaves") + EMS
    clip, gpu = both(text, official, patched, weather, tmp_path, TIMESTEP)
    answer = assert_alike(clip, gpu)
    # It is the program's values that count, not the schedule's own.
    (tmp_path / "idle").mkdir()
    idle = energyplus.run(patched, write(box + VARYING + panes("Leaves"), tmp_path / "idle" / "model.idf", TIMESTEP),
                          weather, tmp_path / "idle" / "run", ["--gpu-shading", "-D"])
    assert idle.completed, idle.why()
    window = next(name for name, receiver in answer.receivers.items() if receiver.kind == "Window")
    by_itself = results.Results(idle.folder).values[results.SUNLIT][window]
    assert max(abs(a - b) for a, b in zip(answer.values[results.SUNLIT][window], by_itself, strict=True)) > 0.1


def test_an_actuated_constant_schedule_takes_effect_as_a_varying_one(patched, box, weather, tmp_path):
    """EnergyPlus's own shading ignores what an EMS sets for a Schedule:Constant."""
    compact = "Schedule:Compact,Leaves,,Through: 12/31,For: AllDays,Until: 24:00,0.5;"
    fractions = []
    for name, schedule in (("compact", compact), ("constant", "Schedule:Constant,Leaves,,0.5;")):
        ems = EMS.replace("Schedule:Compact", schedule.split(",")[0])
        (tmp_path / name).mkdir()
        path = write(box + schedule + panes("Leaves") + ems, tmp_path / name / "model.idf", TIMESTEP)
        run = energyplus.run(patched, path, weather, tmp_path / name / "run", ["--gpu-shading", "-D"])
        assert run.completed, run.why()
        found = results.Results(run.folder)
        window = next(name for name, receiver in found.receivers.items() if receiver.kind == "Window")
        fractions.append(found.values[results.SUNLIT][window])
    assert max(fractions[0]) > 0.7 and len({round(each, 3) for each in fractions[0]}) > 10
    assert fractions[1] == pytest.approx(fractions[0], abs=1e-6)


def test_actuated_schedule_is_warned_of_once_in_periodic_frequency(patched, box, weather, tmp_path):
    path = write(box + VARYING + panes("Leaves") + EMS, tmp_path / "model.idf")
    run = energyplus.run(patched, path, weather, tmp_path / "run", ["--gpu-shading", "-D"])
    assert run.completed, run.why()
    assert run.text("eplusout.err").count("overridden by an EMS actuator") == 1
    often = energyplus.run(patched, path, weather, tmp_path / "often",
                           ["--gpu-shading", "--gpu-shading-update=timestep", "-D"])
    assert often.completed, often.why()
    assert "overridden by an EMS actuator" not in often.text("eplusout.err")


def test_side_file_holds_shades(patched, box, weather, tmp_path):
    shade = "GPUShading:TransparentShade,Glass,pane *,Constant,0.5;\n"
    inside = energyplus.run(patched, write(box + panes("") + shade, tmp_path / "inside.idf"), weather,
                            tmp_path / "a", ["--gpu-shading", "-D"])
    beside = write(box + panes(""), tmp_path / "beside.idf")
    (tmp_path / "beside.gpu-shading.idf").write_text(shade)
    outside = energyplus.run(patched, beside, weather, tmp_path / "b", ["--gpu-shading", "-D"])
    assert inside.completed, inside.why()
    assert outside.completed, outside.why()
    first, second = results.Results(inside.folder), results.Results(outside.folder)
    assert first.values == second.values


def test_bad_shade_stops_before_energyplus_starts(patched, box, weather, tmp_path):
    shade = "GPUShading:TransparentShade,Glass,tree *,Constant,0.5;\n"
    run = energyplus.run(patched, write(box + panes("") + shade, tmp_path / "bad.idf"), weather, tmp_path / "run",
                         ["--gpu-shading", "-D"])
    assert run.status == 1
    assert "GPUShading:TransparentShade Glass: Surface Name is \"tree *\"" in run.errors
    assert "Surface Name is \"tree *\"" in run.text("eplusout.err")
    assert not run.text("eplusout.eio")


def test_canopy_of_many_panes_dims_by_its_glass(patched, weather, tmp_path, monkeypatch):
    monkeypatch.syspath_prepend(str(energyplus.REPOSITORY / "idf_examples" / "canopy"))
    monkeypatch.delitem(sys.modules, "generate", raising=False)
    import generate

    def skylights(glass):
        text = "".join(generate.model(glass))
        run = energyplus.run(patched, write(text, tmp_path / f"{glass}.idf"), weather, tmp_path / glass,
                             ["--gpu-shading", "-D"])
        assert run.completed, run.why()
        assert run.severe == []
        panes_listed = run.text("eplusout.eio").count("GPU Shading Surface,CANOPY ")
        assert panes_listed == generate.COLUMNS * generate.ROWS
        answer = results.Results(run.folder)
        noon = 11  # the hour before it
        return {name: answer.values[results.SUNLIT][name][noon] for name in answer.receivers if "SKYLIGHT" in name}

    monkeypatch.delitem(sys.modules, "generate", raising=False)
    single, triple = skylights("single"), skylights("triple")
    assert len(single) == 2
    for name in single:
        # At noon the canopy covers a skylight whole, but for the gaps.
        assert 0.60 < single[name] < 0.75
        assert 0.25 < triple[name] < 0.40
