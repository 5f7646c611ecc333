"""What compare_shading says of two runs."""

from types import SimpleNamespace

import pytest
from shading_runs import methods, results, verdict


class Values:
    """Results with totals alone."""

    def __init__(self, **totals):
        self.totals = {results.SOLAR: 100.0, results.HEATING: 0.0, results.COOLING: 50.0, results.LIGHTS: 20.0}
        self.totals |= {getattr(results, name): value for name, value in totals.items()}

    def total(self, variable):
        return self.totals[variable]


@pytest.fixture
def run(tmp_path):
    def make(title, differences=(), is_ours=True, text="Zone,Box;\n", options=(), side=None, **totals):
        model = tmp_path / f"{title}.idf"
        model.write_text(text)
        if side:
            side = tmp_path / f"{title}.side"
            side.write_text("GPUShading:Settings,auto;\nGPUShading:PerforatedScreen,Veil,Screen,Round;\n")
        return SimpleNamespace(title=title, is_ours=is_ours, model=model, options=options, extension_file=side,
                               found=[SimpleNamespace(values=list(differences))], results=Values(**totals))

    return make


def test_agreement_and_the_same_energy(run):
    clip = run("Clipping", is_ours=False)
    ours = run("Renderer", [0.0] * 90 + [0.0004] * 10, COOLING=50.003, LIGHTS=20.0)
    assert verdict.sentences([clip, ours], ours) == [
        "Sunlit fractions agree: 99 % of the hours are within 0.0004.",
        "Compared with Clipping: 0.006 % more cooling; the same transmitted solar radiation, lighting."]


@pytest.mark.parametrize(("difference", "said"), [
    (1.46e-4, "0.0002"), (1.0000001e-4, "0.0002"), (1e-4, "0.0001"), (9.1e-4, "0.001"), (3e-6, "3e-06"),
])
def test_no_hour_is_said_to_differ_by_less_than_it_does(run, difference, said):
    ours = run("Renderer", [difference] * 100)
    assert verdict.sentences([run("A"), ours], ours)[0] == (
        f"Sunlit fractions agree: 99 % of the hours are within {said}.")
    assert float(said) >= difference


@pytest.mark.parametrize(("after", "said"), [
    (110.0, "120"), (1050.0, "2,000"), (49.7, "0.6"), (55.7, "11"), (50.006, "0.012"), (54.98, "10")])
def test_no_percentage_has_an_exponent(run, after, said):
    ours = run("Renderer", [0.0], COOLING=after)
    kind = "more" if after > 50.0 else "less"
    assert verdict.sentences([run("A"), ours], ours)[-1].startswith(f"Compared with A: {said} % {kind} cooling")


def test_identical_runs(run):
    ours = run("B", [0.0, 0.0])
    assert verdict.sentences([run("A"), ours], ours) == ["Sunlit fractions are the same.", "Energies are the same."]


def test_differences(run):
    ours = run("B", [0.0] * 60 + [-0.1] * 40, SOLAR=160.0, HEATING=12.5)
    assert verdict.sentences([run("A"), ours], ours) == [
        "Sunlit fractions differ: 40 % of the hours by more than 0.001, and by 0.04 in the mean.",
        "Compared with A: 60 % more transmitted solar radiation, 12.5 kWh of heating, instead of none; "
        "the same cooling, lighting."]


def test_the_error_asked_for_is_allowed(run):
    differences = [0.0] * 90 + [0.004] * 10
    plain = run("Plain", differences)
    assert "differ" in verdict.sentences([run("A"), plain], plain)[0]
    for options in (["--gpu-shading-error=0.01"], ["--gpu-shading-error", "0.01"]):
        rough = run("Rough", differences, options=options)
        assert "agree" in verdict.sentences([run("A"), rough], rough)[0]


@pytest.mark.parametrize("in_model", [True, False])
def test_a_run_that_ignores_screens_is_said_to(run, in_model):
    clip = run("Clipping", is_ours=False)
    text = "GPUShading:PerforatedScreen,Veil,Screen,Round;\n" if in_model else "Zone,Box;\n"
    ours = run("Renderer", [0.0], text=text, side=not in_model)
    assert verdict.unseen([clip, ours]) == [
        "Clipping takes shading surfaces with GPUShading:PerforatedScreen as opaque, or by their transmittance "
        "schedule."]
    assert verdict.unseen([run("Other", text=text), ours]) == []


def test_what_stock_makes_of_each_kind_of_object_is_said(run):
    kinds = ("Settings", "TransparentShade", "MovingShade", "Geometry", "Tree")
    ours = run("Renderer", [0.0], text="".join(f"GPUShading:{kind},x;\n" for kind in kinds))
    assert verdict.unseen([run("Clipping", is_ours=False), ours]) == [
        "Clipping takes shading surfaces with GPUShading:TransparentShade as opaque, or by their transmittance "
        "schedule; leaves surfaces with GPUShading:MovingShade as they are drawn; has nothing of "
        "GPUShading:Geometry and GPUShading:Tree."]


def test_variants_are_named_by_what_differs(tmp_path):
    def variant(short, variation, model):
        return SimpleNamespace(short=short, title="Renderer", label="", variation=variation, model=model)

    pair = [variant("A", "", "m.idf"), variant("B", "glass.idf", "m.idf")]
    methods.name_by_difference(pair)
    assert [each.title for each in pair] == ["the model as it is", "glass.idf"]
    pair = [variant("A", "m.idf", tmp_path / "v1" / "m.idf"),
            variant("B", "m.idf", tmp_path / "v2" / "m.idf")]
    methods.name_by_difference(pair)
    assert [each.title for each in pair] == ["v1/m.idf", "v2/m.idf"]
    pair = [variant("A", "", "m.idf"), variant("B", "", "m.idf")]
    methods.name_by_difference(pair)
    assert len({each.title for each in pair}) == 2
