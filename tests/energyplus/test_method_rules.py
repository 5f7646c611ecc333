"""What PolygonClipping leaves out on the model's own request, pixel counting must leave out too."""

import re

import pytest
from shading_runs import energyplus, input_file, results

DISABLE = {
    "no self-shading at all": ("Yes", "Yes"),
    "none within groups": ("Yes", "No"),
    "none between groups": ("No", "Yes"),
}


def largest_difference(text, official, patched, weather, folder):
    """Of the sunlit fractions of exterior receivers, over the design days, and how many were compared."""
    model = input_file.Idf(text)
    results.instrument(model)
    path = folder / "model.idf"
    model.write(path)
    clip = energyplus.run(official, path, weather, folder / "clip", ["-D"])
    gpu = energyplus.run(patched, path, weather, folder / "gpu", ["--gpu-shading", "-D"])
    assert clip.completed, clip.why()
    assert gpu.completed, gpu.why()
    assert gpu.method == "PixelCounting"
    found = results.differences(results.Results(clip.folder), results.Results(gpu.folder))
    return max(each.largest for each in found), sum(len(each.values) for each in found)


@pytest.mark.parametrize("disable", DISABLE.values(), ids=DISABLE.keys())
def test_self_shading_is_disabled_as_in_polygon_clipping(disable, official, patched, courtyard, weather, tmp_path):
    text = courtyard.read_text()
    zones = re.findall(r"(?im)^\s*Zone\s*,\s*([^,;!\n]+?)\s*[,;]", re.sub(r"!.*", "", text))
    assert len(zones) >= 2
    text = re.sub(r"(?is)\bShadowCalculation\s*,[^;]*;", "", re.sub(r"!.*", "", text))
    text += f"""
ZoneList,Group 1,{zones[0]};
ZoneList,Group 2,{zones[1]};
ShadowCalculation,PolygonClipping,Periodic,20,15000,,512,,No,{disable[0]},{disable[1]},Group 1,Group 2;
"""
    largest, count = largest_difference(text, official, patched, weather, tmp_path)
    assert count > 100
    assert largest < 3e-3


def test_minimal_shadowing_knows_reveals_alone(official, patched, courtyard, weather, tmp_path):
    text, changed = re.subn(r"Full(Interior(And)?)?(And)?Exterior(WithReflections)?", "MinimalShadowing",
                            courtyard.read_text())
    assert changed
    largest, count = largest_difference(text, official, patched, weather, tmp_path)
    assert count > 100
    assert largest < 3e-3
