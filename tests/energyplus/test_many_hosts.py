"""A study on hosts of a network of their own: tables after hosts, cables, disks and the scheduler fail."""

import importlib.util
import shutil
import subprocess
import sys
import time

import network
import pytest
from shading_runs import energyplus

PLAN = """
models = "box.idf"
weather = "{weather}"
arguments = "-D"
keep = "nothing"

[[variant]]
name = "as built"

[[variant]]
name = "cool"
set = {{ "Schedule:Constant/cooling*/Hourly Value" = 22 }}

[[variant]]
name = "bare"
remove = ["Shading:Building:Detailed"]
"""

# EnergyPlus, which waits while its host has the file "hold" on its own disk.
STAND_IN = """#!/bin/bash
touch "$TMPDIR/began"
while [ -e "$TMPDIR/hold" ]; do sleep 0.05; done
exec {program} "$@"
"""
COMMAND = energyplus.REPOSITORY / "gpu_shading" / "python" / "gpu_shading" / "study" / "__main__.py"
SCHEDULER = f"tcp://{network.ADDRESS}:8786"


class Cluster:
    """A scheduler of Dask on the first host, and a worker on each of the others."""

    def __init__(self, net, prefix, place):
        self.net, self.place, self._workers = net, place, {}
        self._variables = {
            "GPU_SHADING_PREFIX": str(prefix),
            "PYTHONPATH": str(energyplus.REPOSITORY / "gpu_shading" / "python"),
            "DASK_DISTRIBUTED__COMM__TIMEOUTS__TCP": "11s",  # the least for a silent host; 30 s by default
            "DASK_DISTRIBUTED__COMM__TIMEOUTS__CONNECT": "3s",
        }
        self.start_scheduler()
        for name in ("east", "west"):
            self.add(name)

    def _start(self, host, *words, **options):
        return host.popen(sys.executable, *words, variables=self._variables, **options)

    def start_scheduler(self):
        self.scheduler = self._start(self.net, "-m", "distributed.cli.dask_scheduler", "--port", "8786",
                                     "--no-dashboard", stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

    def add(self, name):
        self.net.add(name)
        self.start_worker(name)

    def start_worker(self, name):
        host = self.net.hosts[name]
        self._workers[name] = self._start(
            host, "-m", "distributed.cli.dask_worker", SCHEDULER, "--nthreads", "1", "--no-nanny", "--no-dashboard",
            "--death-timeout", "60", stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

    def end_worker(self, name):
        self._workers[name].wait(timeout=60)

    def hold(self, name):
        for file in ("began", "hold"):
            self.local(name, file).unlink(missing_ok=True)
        self.local(name, "hold").touch()

    def release(self, name):
        self.local(name, "hold").unlink()

    def local(self, name, file):
        return self.net.hosts[name].seen(self.net.local / file)

    def wait_for(self, is_so, process):
        limit = time.monotonic() + 30
        while not is_so():
            if time.monotonic() > limit:
                network.kill(process)
            assert process.poll() is None, process.communicate()
            time.sleep(0.02)

    def study(self, output):
        return self._start(self.net, COMMAND, self.place / "plan.toml", "-o", self.place / output, "--scheduler",
                           SCHEDULER, stdout=subprocess.PIPE, stderr=subprocess.PIPE)

    def finish(self, process, status=0):
        errors = process.communicate(timeout=60)[1]
        assert process.returncode == status, errors
        return errors

    def output(self, name):
        return self.net.seen(self.place / name)

    def records(self, name):
        return {path.parent.name: path.stat().st_mtime_ns for path in self.output(name).glob("runs/*/record.json")}


def tables(folder):
    return [path.read_bytes() for path in sorted(folder.glob("runs.*"))]


@pytest.fixture(scope="module")
def prefix(patched, tmp_path_factory):
    folder = tmp_path_factory.mktemp("prefix")
    for entry in patched.parent.iterdir():
        if entry.name != "energyplus":
            (folder / entry.name).symlink_to(entry)
    (folder / "energyplus").write_text(STAND_IN.format(program=patched))
    (folder / "energyplus").chmod(0o755)
    return folder


@pytest.fixture(scope="module")
def cluster(prefix, box, weather, tmp_path_factory):
    if not importlib.util.find_spec("distributed"):
        pytest.skip("Dask is missing: run scripts/setup")
    if why := network.why_not():
        pytest.skip(why)
    net = network.Network(tmp_path_factory.mktemp("network"))
    place = net.disk / "study"
    net.seen(place).mkdir()
    net.seen(place / "box.idf").write_text(box)
    net.seen(place / "plan.toml").write_text(PLAN.format(weather=weather))
    yield Cluster(net, prefix, place)
    net.close()


@pytest.fixture(scope="module")
def reference(cluster, patched, tmp_path_factory):
    """The tables of one worker here, which no network takes part in."""
    folder = tmp_path_factory.mktemp("here")
    for name in ("box.idf", "plan.toml"):
        shutil.copy(cluster.net.seen(cluster.place / name), folder)
    done = subprocess.run([patched.parent / "gpu_shading", "study", "plan.toml", "-o", "out", "--workers", "1"],
                          cwd=folder, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return tables(folder / "out")


def test_a_scheduler_s_workers_make_the_same_tables(cluster, reference):
    errors = cluster.finish(cluster.study("plain"))
    assert f"workers of {SCHEDULER}" in errors and "3 of 3 runs, 0 failed" in errors
    assert tables(cluster.output("plain")) == reference


def test_the_run_of_a_dead_host_goes_to_another(cluster, reference):
    cluster.hold("east")
    process = cluster.study("dead")
    cluster.wait_for(cluster.local("east", "began").exists, process)
    cluster.net.hosts["east"].die()
    assert "3 of 3 runs, 0 failed" in cluster.finish(process)
    assert tables(cluster.output("dead")) == reference
    cluster.add("east")


def test_the_run_behind_a_cut_cable_goes_to_another(cluster, reference):
    cluster.hold("west")
    process = cluster.study("cut")
    cluster.wait_for(cluster.local("west", "began").exists, process)
    cluster.net.unplug("west")
    assert "3 of 3 runs, 0 failed" in cluster.finish(process)
    assert tables(cluster.output("cut")) == reference
    # What the host ends by itself, and writes to the shared disk, is too late.
    records = cluster.records("cut")
    cluster.release("west")
    cluster.end_worker("west")
    assert cluster.records("cut") == records and tables(cluster.output("cut")) == reference
    cluster.net.plug("west")
    cluster.start_worker("west")


def test_a_study_resumes_once_its_disk_has_room(cluster, reference):
    cluster.hold("east")
    cluster.hold("west")
    process = cluster.study("full")
    cluster.wait_for(lambda: any(cluster.local(name, "began").exists() for name in ("east", "west")), process)
    ballast = cluster.net.seen(cluster.net.disk / "ballast")
    with pytest.raises(OSError, match="No space"), open(ballast, "wb", buffering=0) as file:
        while file.write(bytes(1 << 16)):
            pass
    cluster.release("east")
    cluster.release("west")
    errors = cluster.finish(process, 1)
    assert "No space left on device" in errors.splitlines()[-1] or ", 3 failed" in errors, errors
    assert not cluster.records("full")
    ballast.unlink()
    assert "3 of 3 runs, 0 failed" in cluster.finish(cluster.study("full"))
    assert tables(cluster.output("full")) == reference


def test_a_study_resumes_with_another_scheduler(cluster, reference):
    cluster.hold("east")
    process = cluster.study("orphaned")
    cluster.wait_for(lambda: len(cluster.records("orphaned")) >= 1, process)
    network.kill(cluster.scheduler)
    errors = cluster.finish(process, 1)
    assert "the same command resumes" in errors.splitlines()[-1]
    kept = cluster.records("orphaned")
    cluster.release("east")
    for name in ("east", "west"):
        cluster.end_worker(name)
    cluster.start_scheduler()
    for name in ("east", "west"):
        cluster.start_worker(name)
    assert "3 of 3 runs, 0 failed" in cluster.finish(cluster.study("orphaned"))
    assert {name: when for name, when in cluster.records("orphaned").items() if name in kept} == kept
    assert tables(cluster.output("orphaned")) == reference
