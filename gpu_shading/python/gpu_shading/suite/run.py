"""A run of the suite: from folders and commands to files."""

from __future__ import annotations

import sys
from pathlib import Path

from gpu_shading._files import staged, write_whole
from gpu_shading._text import escaped
from gpu_shading.errors import InvalidInput
from gpu_shading.suite import scenes, scores, tools

_DRAWN = 1e-3  # error of a tool, from which on a scene is drawn


def run(folder: Path, commands: list[str], output: Path, limit: float) -> str:
    """Returns the table by feature, which is also in output/scores.md. Raises Error."""
    chosen = [tools.tool_of(command) for command in commands]
    if len({tool.name for tool in chosen}) < len(chosen):
        raise InvalidInput("--tool: two tools have the same name; expected NAME=COMMAND with distinct names")
    if not 0 < limit <= 1e6:
        raise InvalidInput(f"--limit {limit:g}: expected 0 to 1e6 seconds")
    all_scenes = scenes.read(folder)
    if output.exists() and (not output.is_dir() or any(output.iterdir())):
        raise InvalidInput(f"-o {output}: is not an empty folder; expected a new or empty one")
    found = []
    for number, scene in enumerate(all_scenes, 1):
        print(f"gpu_shading suite: {number} of {len(all_scenes)}: {escaped(scene.name)}", file=sys.stderr, flush=True)
        found += [scores.Score(scene, tool, tools.ask(tool, scene, limit)) for tool in chosen]
    output.mkdir(parents=True, exist_ok=True)
    for scene in all_scenes:
        of_scene = [score for score in found if score.scene is scene]
        if any((score.error or 0.0) > _DRAWN for score in of_scene):
            from gpu_shading.suite import pictures

            with staged(output / f"{scene.path.stem}.png") as picture:
                pictures.draw(scene, of_scene, picture)
    write_whole(output / "scores.csv", scores.rows(found))
    table = scores.table(found, chosen)
    write_whole(output / "scores.md", table)
    return table
