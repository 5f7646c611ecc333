"""EnergyPlus's symbols: the table of those that are used, and that no library takes another's. EnergyPlus's library
carries old copies of expat, zlib and sqlite."""

import re
import subprocess

from shading_runs import energyplus

TABLE = energyplus.REPOSITORY / "energyplus_patch" / "routes" / "patched" / "symbols" / "energyplus_symbols.inc"

BINDING = re.compile(r"binding file (\S+) \[\d+\] to (\S+) \[\d+\]: \w+ symbol `([^']+)'")
# Statics of the C++ library's inline functions: one of a kind in a process by the ABI's own rule.
UNIQUE = re.compile(r"_ZG?V?Z+N?K?S")


def bindings(folder):
    for log in folder.glob("bindings.*"):
        with open(log, encoding="utf-8", errors="replace") as lines:
            for line in lines:
                if found := BINDING.search(line):
                    yield found.groups()


def test_no_library_takes_another_ones_symbols(patched, courtyard, weather, tmp_path):
    # With pictures, so that OpenImageIO's libraries are there as well as Mesa's, and with a mesh, whose library is not.
    (tmp_path / "flag.obj").write_text("v 0 0 90\nv 1 0 90\nv 0 0 91\nf 1 2 3\n")
    model = tmp_path / "model.idf"
    model.write_text(courtyard.read_text() + "GPUShading:Geometry,Flag,flag.obj,m,Z;\n")
    run = energyplus.run(patched, model, weather, tmp_path / "run",
                         ["--gpu-shading", f"--gpu-shading-report={tmp_path / 'report'}", "-D"],
                         {"LD_DEBUG": "bindings", "LD_DEBUG_OUTPUT": str(tmp_path / "bindings")})
    assert run.completed, run.why()
    assert list((tmp_path / "report").glob("*.png")), "no pictures: OpenImageIO was not loaded"
    seen = 0
    users = set()
    for user, owner, symbol in bindings(tmp_path):
        seen += 1
        users.add(user)
        if "libenergyplusapi" in owner and "libenergyplusapi" not in user:
            assert UNIQUE.match(symbol), f"{user} uses EnergyPlus's {symbol}"
        if "libgpu_shading" in owner:
            assert "libgpu_shading" in user, f"{user} uses our {symbol}"
        if "libenergyplusapi" in user:
            foreign = r"swrast|gallium|expat|libpng|libtiff|sqlite|assimp|libz\."
            assert not re.search(foreign, owner), f"{symbol} of {owner}"
    assert seen > 1000, "the loader's log was not read"
    assert any("libassimp" in user for user in users), "no mesh: Assimp was not loaded"
    for log in tmp_path.glob("bindings.*"):
        text = log.read_text(errors="replace")
        assert "libassimp" not in text or "libenergyplusapi" not in text, "Assimp is in EnergyPlus's process"


def test_the_tested_release_has_every_symbol_of_the_table(official):
    rows = re.findall(r'^(?:FUNCTION|CLASS)\((\w+), (\w+),[^"]*"(\w+)"\)$', TABLE.read_text(), re.M)
    assert len(rows) > 70
    library = official.parent / "libenergyplusapi.so"
    listed = subprocess.run(["nm", "--defined-only", library], capture_output=True, text=True, check=True).stdout
    symbols = {line.split()[-1] for line in listed.splitlines()}
    lacking = {name for need, name, symbol in rows if symbol not in symbols}
    assert lacking == {name for need, name, _ in rows if need == "before_25_1"}


def test_mangled_names_of_energyplus_stand_in_the_table_alone():
    mangled = re.compile(r"_ZN?K?\d*(10EnergyPlus|8Penumbra|9ObjexxFCL)|_ZTVN")
    sources = [path for path in (energyplus.REPOSITORY / "energyplus_patch").rglob("*")
               if path.suffix in {".cpp", ".h", ".inc", ".txt"}]
    assert [path for path in sources if mangled.search(path.read_text(encoding="utf-8"))] == [TABLE]
