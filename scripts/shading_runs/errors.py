"""Errors of the operating system in plain words, and text that may hold anything for a terminal."""

import re


def printable(text):
    """The text in one line, with control characters escaped: names in models can hold those of terminals."""
    return re.sub(r"[\x00-\x1f\x7f-\x9f]", lambda found: f"\\x{ord(found[0]):02x}", text)


def in_words(error):
    """The file and what is wrong with it, without the number that Python puts first."""
    if isinstance(error, OSError) and error.strerror and error.filename is not None:
        return f"{error.filename}: {error.strerror}"
    return str(error)
