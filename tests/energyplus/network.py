"""Hosts in namespaces of their own: each has its processes, its name, a disk and a cable to the first of them."""

import functools
import os
import shutil
import signal
import subprocess
import time
from pathlib import Path

ADDRESS = "10.77.0.1"  # of the first host


@functools.cache
def why_not():
    """Why this machine cannot have such hosts; "" if it can."""
    for program in ("unshare", "nsenter", "ip", "mount"):
        if not shutil.which(program, path=_environment()["PATH"]):
            return f"{program} is missing"
    trial = subprocess.run(
        ["unshare", "--user", "--map-root-user", "--net", "--mount", "--pid", "--fork", "sh", "-c",
         "mount -t tmpfs -o size=64k tmpfs /mnt && ip link add here type veth peer name there"],
        env=_environment(), capture_output=True, text=True)
    return f"no network namespaces: {trial.stderr.strip()}" if trial.returncode else ""


def _environment(**variables):
    kept = {key: value for key, value in os.environ.items() if not key.startswith(("GPU_SHADING", "DASK"))}
    return kept | {"PATH": f"{os.environ['PATH']}:/usr/sbin:/sbin"} | variables


class Host:
    """A host: `local` is its own disk, and `disk` is the one that all hosts share, under the same names on each."""

    def __init__(self, words, local):
        # Whatever ends this process closes the pipe, which ends the host and all that runs on it.
        self._holder = subprocess.Popen([*words, "unshare", "--mount", "--net", "--uts", "--pid", "--fork",
                                         "--kill-child", "--mount-proc", "cat"], stdin=subprocess.PIPE,
                                        env=_environment())
        self.pid = _wait_for(lambda: _child(self._holder))
        _wait_for(lambda: Path(f"/proc/{self.pid}/comm").read_text() == "cat\n")
        self.local = local
        self.run("mount", "-t", "tmpfs", "-o", "size=64m", "tmpfs", local)
        self.run("ip", "link", "set", "lo", "up")

    def popen(self, *command, **options):
        return subprocess.Popen(
            ["nsenter", f"--target={self.pid}", "--user", "--preserve-credentials", "--mount", "--net", "--uts",
             "--pid", *map(str, command)], text=True,
            env=_environment(TMPDIR=str(self.local), **options.pop("variables", {})), **options)

    def run(self, *command):
        with self.popen(*command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT) as process:
            output = process.communicate(timeout=60)[0]
        assert process.returncode == 0, (command, output)
        return output

    def seen(self, path):
        """A path of the host, for this process."""
        return Path(f"/proc/{self.pid}/root{path}")

    def die(self):
        self._holder.kill()
        self._holder.communicate()


class Network(Host):
    """The first host, and those that are connected to it."""

    def __init__(self, folder):
        self._folder, self.hosts = folder, {}
        self.disk, local = folder / "disk", folder / "local"
        for made in (self.disk, local):
            made.mkdir()
        super().__init__(["unshare", "--user", "--map-root-user"], local)
        self.run("mount", "-t", "tmpfs", "-o", "size=64m", "tmpfs", self.disk)
        self.run("ip", "address", "add", f"{ADDRESS}/32", "dev", "lo")

    def add(self, name):
        """A host whose processes see each other, the shared disk and the first host."""
        host = Host(["nsenter", f"--target={self.pid}", "--user", "--preserve-credentials", "--mount"], self.local)
        number = len(self.hosts) + 1
        self.hosts[name] = host
        host.run("hostname", name)
        self.run("sh", "-c", f"ip link delete {name} 2>/dev/null; true")
        # Numbers of processes are those of this process's namespace.
        subprocess.run(["nsenter", f"--target={self.pid}", "--user", "--preserve-credentials", "--net", "ip", "link",
                        "add", name, "type", "veth", "peer", "name", "cable", "netns", str(host.pid)],
                       env=_environment(), check=True)
        self.run("ip", "address", "add", f"10.77.{number}.1/24", "dev", name)
        self.plug(name)
        host.run("ip", "address", "add", f"10.77.{number}.2/24", "dev", "cable")
        host.run("ip", "link", "set", "cable", "up")
        host.run("ip", "route", "add", "default", "via", f"10.77.{number}.1")
        return host

    def unplug(self, name):
        self.run("ip", "link", "set", name, "down")

    def plug(self, name):
        self.run("ip", "link", "set", name, "up")

    def close(self):
        for host in [*self.hosts.values(), self]:
            host.die()


def kill(process):
    """A process of a host, of which nsenter is the parent."""
    os.kill(_child(process), signal.SIGKILL)
    process.wait()


def _child(process):
    return int(Path(f"/proc/{process.pid}/task/{process.pid}/children").read_text() or 0)


def _wait_for(value):
    limit = time.monotonic() + 10
    while True:
        try:
            if found := value():
                return found
        except OSError:
            pass
        assert time.monotonic() < limit
        time.sleep(0.01)
