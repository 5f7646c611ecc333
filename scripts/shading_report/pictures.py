"""Pictures of what the sun sees of receivers, drawn by the gpu_shading program from the model of a run."""

import base64
import subprocess

SIZE = 240  # pixels on the longer side


def data_uri(path):
    return "data:image/png;base64," + base64.b64encode(path.read_bytes()).decode("ascii")


def draw(run, weather, wanted, folder):
    """(data URIs, '') for each wanted (receiver, (azimuth, altitude) in degrees), or ([None, ...], why not)."""
    nothing = [None] * len(wanted)
    if not wanted:
        return nothing, "the runs do not differ"
    program = run.program.parent / "gpu_shading"
    folder.mkdir(parents=True)
    table = folder / "views.txt"
    table.write_text("".join(f"{number}.png {azimuth:.6f} {altitude:.6f} {receiver}\n"
                             for number, (receiver, (azimuth, altitude)) in enumerate(wanted)), encoding="utf-8")
    command = [program, "view", run.placed, "-w", weather, "--list", table, "-o", folder, "--size", str(SIZE)]
    if run.extension_file:
        command += ["--gpu-shading-file", run.extension_file]
    done = subprocess.run(command, capture_output=True, text=True, errors="replace", stdin=subprocess.DEVNULL)
    if done.returncode:
        return nothing, (done.stderr.strip().splitlines() or [f"exit status {done.returncode}"])[-1]
    return [data_uri(folder / f"{number}.png") for number in range(len(wanted))], ""
