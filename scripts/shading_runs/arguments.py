"""Arguments of scripts. Only Python's standard library is used."""

import argparse
import difflib

from shading_runs.version import version


def add_version(parser):
    """Adds --version."""
    parser.add_argument("--version", action="version", version=f"%(prog)s {version()}")


class Parser(argparse.ArgumentParser):
    """Says which flag a mistyped one may stand for, as gpu_shading does."""

    def parse_args(self, args=None, namespace=None):
        parsed, unknown = self.parse_known_args(args, namespace)
        if unknown:
            self.error(self._what_is_wrong(unknown))
        return parsed

    def _what_is_wrong(self, unknown):
        flag = unknown[0].partition("=")[0]
        known = [name for action in self._actions for name in action.option_strings]
        near = difflib.get_close_matches(flag, known, 1)
        if flag.startswith("-") and near:
            return f"{flag}: no such flag; did you mean {near[0]}?"
        return f"unrecognized arguments: {' '.join(unknown)}"
