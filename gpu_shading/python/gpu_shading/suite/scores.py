"""How far tools are off, by scene and by feature."""

from __future__ import annotations

import csv
import io
from dataclasses import dataclass

from gpu_shading._text import escaped
from gpu_shading.suite.scenes import Scene
from gpu_shading.suite.tools import Outcome, Tool

LEVELS = (1e-3, 1e-2)


@dataclass(frozen=True)
class Score:
    """Of one tool on one scene."""

    scene: Scene
    tool: Tool
    outcome: Outcome

    @property
    def error(self) -> float | None:
        """The largest of all receivers and suns."""
        if self.outcome.answers is None:
            return None
        return max(abs(values[name] - exact[name]) for values, exact in
                   zip(self.outcome.answers, self.scene.exact, strict=True) for name in exact)


def rows(scores: list[Score]) -> str:
    """A line of CSV for each answer."""
    text = io.StringIO()
    table = csv.writer(text, lineterminator="\n")
    table.writerow(["scene", "feature", "tool", "azimuth [deg]", "altitude [deg]", "receiver", "exact", "answer",
                    "error", "why there is none"])
    for score in scores:
        why = score.outcome.unsupported and f"not supported: {score.outcome.unsupported}" or score.outcome.failed
        for place, (sun, exact) in enumerate(zip(score.scene.suns, score.scene.exact, strict=True)):
            for name, value in exact.items():
                answer = None if score.outcome.answers is None else score.outcome.answers[place][name]
                table.writerow([score.scene.name, score.scene.feature, score.tool.name, *sun, name, value,
                                "" if answer is None else repr(answer),
                                "" if answer is None else f"{answer - value:.3g}", why])
    return text.getvalue()


def table(scores: list[Score], tools: list[Tool]) -> str:
    """Markdown: for each feature and tool, the scenes within the tolerance and within each of LEVELS, and the largest
    error."""
    features = list(dict.fromkeys(score.scene.feature for score in scores))
    levels = " / ".join(f"{level:g}" for level in LEVELS)
    lines = [f"Scenes within their own tolerance / {levels} of all that the tool supports, and the largest error.", "",
             "| feature | scenes | " + " | ".join(_cell(tool.name) for tool in tools) + " |",
             "|---|---:|" + "---:|" * len(tools)]
    for feature in [*sorted(features), "all"]:
        of_feature = [score for score in scores if feature in ("all", score.scene.feature)]
        count = len({score.scene.name for score in of_feature})
        cells = [_summary([score for score in of_feature if score.tool == tool]) for tool in tools]
        lines.append(f"| {_cell(feature)} | {count} | " + " | ".join(cells) + " |")
    failed = [f"- {_cell(score.scene.name)}, {_cell(score.tool.name)}: {_cell(score.outcome.failed)}"
              for score in scores if score.outcome.failed]
    return "\n".join([*lines, *(["", "Without an answer:", "", *failed] if failed else []), ""])


def _summary(scores: list[Score]) -> str:
    supported = [score for score in scores if not score.outcome.unsupported]
    errors = [score.error for score in supported]
    known = [error for error in errors if error is not None]
    if not supported:
        return "not supported"
    own = sum(error is not None and error <= score.scene.tolerance
              for score, error in zip(supported, errors, strict=True))
    counts = [own, *(sum(error <= level for error in known) for level in LEVELS)]
    largest = f"{max(known):.1g}" if known else "no answer"
    return f"{' / '.join(map(str, counts))} of {len(supported)}; {largest}"


def _cell(text: str) -> str:
    return escaped(text).replace("|", "\\|")
