"""Damaged files that the Python package reads: each is read, or refused by one line of its own exceptions."""

import json
import os
import pickle
import random
import sqlite3
import struct
import sys

import numpy as np
import pytest
from shading_runs import energyplus

sys.path.insert(0, str(energyplus.REPOSITORY / "gpu_shading" / "python"))
sys.path.append(str(energyplus.REPOSITORY / ".venv" / "tools"))
ROUNDS = 150  # of random damage to each file


@pytest.fixture(scope="module")
def gs(patched):
    import gpu_shading

    return gpu_shading


def modules(folder):
    """2 modules of 4 x 6 cells at 3 times."""
    np.save(folder / "ROOF.npy", np.full((3, 2, 4, 6), 65535, np.uint16))
    (folder / "modules.json").write_text(json.dumps({
        "format": "gpu_shading modules 1", "year": 2017, "steps_per_hour": 4,
        "fields": [{"surface": "Roof", "files": "ROOF", "modules": 2, "strings": 1, "cell_columns": 6, "cell_rows": 4,
                    "bypass_diodes": 3, "half_cut": False, "module_area": 1.6}]}))
    (folder / "modules.csv").write_text(
        "surface,string,column,row,azimuth [deg],tilt [deg],sky view factor,unshaded view factor\n"
        "Roof,1,1,1,180,30,0.9,0.93\nRoof,1,2,1,180,30,0.9,0.93\n")
    (folder / "times.csv").write_text(
        "month,day,hour,timestep,sun azimuth [deg],sun altitude [deg],beam [W/m2],diffuse [W/m2],air [C],wind [m/s]\n"
        + "".join(f"6,21,12,{i},180,60,800,100,20,2\n" for i in (1, 2, 3)))


def samples(folder):
    (folder / "samples.json").write_text(json.dumps({
        "format": "gpu_shading samples 1", "receivers": [{"name": "A", "area": 2.0, "normal": [0, -1, 0]}],
        "mode": "coarse", "fineness": 2, "inputs": {"model": {"name": "m.idf"}, "weather": {"name": "w.epw"}},
        "site": {"latitude": 40, "longitude": -105}, "versions": {"gpu_shading": "1"}}))
    (folder / "year.csv").write_text("time,azimuth,altitude,A\n" + "".join(
        f"2017-01-01 00:{minute},1,2,0.5\n" for minute in (15, 30, 45)))


def results(folder):
    (folder / "eplusout.eso").write_text(
        "Program Version\n1,5,Environment Title[]\n2,8,Day of Simulation[]\n"
        "7,1,WINDOW,Surface Outside Face Sunlit Fraction [] !Hourly\nEnd of Data Dictionary\n"
        "1,Year,40,-105,-7,1829\n2,1,1,1,0,1,0,60,WinterDesignDay\n7,0.5\n7,0.25\nEnd of Data\n")
    (folder / "eplusout.end").write_text(
        "EnergyPlus Completed Successfully-- 1 Warning; 0 Severe Errors; Elapsed Time=00hr 00min  1.25sec\n")
    (folder / "eplusout.eio").write_text("! <Site:Location>, ...\nSite:Location,Golden,39.74,-105.18,-7.0,1829\n")
    data = sqlite3.connect(folder / "eplusout.sql")
    data.executescript("""
        CREATE TABLE ReportDataDictionary (ReportDataDictionaryIndex, Name, KeyValue, ReportingFrequency);
        CREATE TABLE Time (TimeIndex, Year, Month, Day, Hour, Minute, WarmupFlag, EnvironmentPeriodIndex);
        CREATE TABLE ReportData (ReportDataDictionaryIndex, TimeIndex, Value);
        CREATE TABLE TabularDataWithStrings (TableName, RowName, ColumnName, Value, Units);
        INSERT INTO ReportDataDictionary VALUES (1, 'Sunlit', 'WINDOW', 'Hourly');
        INSERT INTO Time VALUES (1, 2017, 6, 21, 12, 0, 0, 1);
        INSERT INTO ReportData VALUES (1, 1, 0.5);
        INSERT INTO TabularDataWithStrings VALUES ('Site and Source Energy', 'Total Site Energy', 'Total Energy',
                                                   '12.5', 'GJ');""")
    data.commit()
    data.close()


def read_run(gs):
    def read(folder):
        run = gs.Run(folder, ())
        done = []
        for ask in (lambda: run.values("Surface Outside Face Sunlit Fraction"), run.summary,
                    lambda: run.frame(frequency="Hourly")):
            try:
                done.append(ask())
            except gs.Error as error:
                done.append(error)
        for each in done:
            if isinstance(each, gs.Error):
                raise each

    return read


KINDS = {"modules": (modules, lambda gs: gs.read_modules), "samples": (samples, lambda gs: gs.read_samples),
         "results": (results, read_run)}


def damages(content):
    """What may have happened to a file: cuts, changed bytes, text in place of numbers."""
    chance = random.Random(1)
    yield from (b"", b"\0" * 100, b"\xff\xfe\xff", b"[" * 100_000, content * 2, content.replace(b",", b";"), b"null",
                b"[]", b'{"format": 1}', b"PK\x03\x04" + content)
    for number in (b"nan", b"-1", b"1e999", b"x", b"", b"99999999999999999999"):
        for old in (b"0.9", b"0.5", b"180", b"1", b"2", b"4", b"2017"):
            yield content.replace(old, number)
    for _ in range(ROUNDS):
        changed = bytearray(content)
        for _ in range(chance.choice((1, 1, 5))):
            changed[chance.randrange(len(changed))] = chance.choice((0, 10, 34, 44, 48, 91, 255, chance.randrange(256)))
        yield bytes(changed)
        yield content[:chance.randrange(len(content))]


def is_one_line(error, folder):
    text = str(error)
    assert text.isprintable() and len(text) < 600, text
    assert str(folder) in text, text


@pytest.mark.parametrize("kind", KINDS)
def test_damage_is_one_line(kind, gs, tmp_path):
    write, reader = KINDS[kind]
    if kind != "modules":
        pytest.importorskip("xarray")
    write(tmp_path)
    read = reader(gs)
    read(tmp_path)  # as it is
    refused = 0
    for path in sorted(tmp_path.iterdir()):
        content = path.read_bytes()
        for damaged in damages(content):
            path.write_bytes(damaged)
            try:
                read(tmp_path)
            except gs.Error as error:
                is_one_line(error, tmp_path)
                refused += 1
        path.unlink()
        for make in (path.mkdir, lambda path=path: os.mkfifo(path), lambda path=path: path.symlink_to(path), None):
            if make:
                make()
            # A run without tables, or without an end, has less to say.
            try:
                read(tmp_path)
            except gs.Error as error:
                is_one_line(error, tmp_path)
            if make:
                path.rmdir() if path.is_dir() else path.unlink()
        path.write_bytes(content)
    assert refused > 200
    read(tmp_path)


def test_values_that_cannot_be_are_refused(gs, tmp_path):
    modules(tmp_path)

    def changed(name, old, new, why):
        text = (tmp_path / name).read_text()
        assert old in text
        (tmp_path / name).write_text(text.replace(old, new))
        with pytest.raises(gs.InvalidInput, match=why):
            gs.read_modules(tmp_path)
        (tmp_path / name).write_text(text)

    changed("modules.csv", "0.9,", "nan,", "sky view factor: expected 0 to 1")
    changed("modules.csv", "Roof,1,2", "Roof,0,2", "string, column or row: expected 1 to")
    changed("modules.csv", "Roof,1,2,1,180,30,0.9,0.93", "Roof,1,2,1,180", "modules.csv, line 3: has another number")
    changed("times.csv", "6,21,12,3,180,60,800,100,20,2\n", "", "differ")
    changed("times.csv", "800", "inf", "beam")
    changed("modules.json", '"ROOF"', '"../ROOF"', "expected the name of a file")
    changed("modules.json", '"year": 2017', '"year": "x"', "year")
    changed("modules.json", '"fields"', '"felds"', "fields is missing")


def test_arrays_are_not_unpickled(gs, tmp_path):
    modules(tmp_path)
    marker = tmp_path / "executed"

    class Trap:
        def __reduce__(self):
            return os.mkdir, (str(marker),)

    trap = np.empty((3, 2, 4, 6), object)
    trap[:] = Trap()
    np.save(tmp_path / "ROOF.npy", trap, allow_pickle=True)
    plain = pickle.dumps(Trap())
    for content in ((tmp_path / "ROOF.npy").read_bytes(), plain):
        (tmp_path / "ROOF.npy").write_bytes(content)
        with pytest.raises(gs.InvalidInput, match="is not a folder of gpu_shading modules"):
            gs.read_modules(tmp_path)
        assert not marker.exists()


def test_an_array_that_claims_to_be_huge_takes_no_memory(gs, tmp_path):
    modules(tmp_path)
    header = b"{'descr': '<u2', 'fortran_order': False, 'shape': (3000000000, 2, 4, 6), }"
    header += b" " * (-(len(header) + 11) % 64) + b"\n"
    (tmp_path / "ROOF.npy").write_bytes(b"\x93NUMPY\x01\x00" + struct.pack("<H", len(header)) + header + b"\0" * 99)
    with pytest.raises(gs.InvalidInput, match="is not a folder of gpu_shading modules") as error:
        gs.read_modules(tmp_path)
    is_one_line(error.value, tmp_path)


def test_parameters_of_power(gs, tmp_path):
    modules(tmp_path)
    cells = gs.read_modules(tmp_path)
    module = {"alpha_sc": 0.0039, "a_ref": 1.56, "I_L_ref": 9.31, "I_o_ref": 2.1e-10, "R_sh_ref": 832.0, "R_s": 0.268,
              "Adjust": -3.2, "N_s": 24}
    for given, why in (({**module, "R_s": "x"}, "module: R_s"), ({**module, "N_s": float("nan")}, "module: N_s"),
                       ({**module, "a_ref": None}, "module: a_ref")):
        with pytest.raises(gs.InvalidInput, match=why):
            gs.power(cells, given)
    with pytest.raises(gs.InvalidInput, match="albedo"):
        gs.power(cells, module, albedo=7)
    with pytest.raises(gs.InvalidInput, match="reverse: breakdown_exp missing"):
        gs.power(cells, module, reverse={"breakdown_factor": 2e-3, "breakdown_voltage": -15.0})


@pytest.mark.parametrize("printed", ["", "[]", "null", "{", '{"format": 1}', "[" * 5000, "\x1b[2J",
                                     '{"format": "gpu_shading scene 1"}',
                                     '{"format": "gpu_shading scene 1", "transmittances": 7}'])
def test_a_program_that_prints_something_else(printed, gs, tmp_path, monkeypatch):
    (tmp_path / "printed").write_text(printed)
    (tmp_path / "gpu_shading").write_text(f"#!/bin/sh\ncat '{tmp_path / 'printed'}'\n")
    (tmp_path / "gpu_shading").chmod(0o700)
    (tmp_path / "model.idf").write_text("")
    monkeypatch.setenv("GPU_SHADING_PREFIX", str(tmp_path))
    with pytest.raises(gs.Error) as error:
        gs.Scene.from_energyplus(tmp_path / "model.idf")
    assert str(error.value).isprintable() and len(str(error.value)) < 600
