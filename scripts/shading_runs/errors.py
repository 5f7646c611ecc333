"""Errors of the operating system in plain words, and text that may hold anything for a terminal."""

import re


def printable(text):
    """The text with control characters but line breaks escaped: names in models can hold those of terminals."""
    return re.sub(r"[\x00-\x09\x0b-\x1f\x7f-\x9f]", lambda found: f"\\x{ord(found[0]):02x}", text)


def in_words(error):
    """The file and what is wrong with it, without the number that Python puts first."""
    if not isinstance(error, OSError) or not error.strerror:
        return printable(str(error))
    return printable(error.strerror if error.filename is None else f"{error.filename}: {error.strerror}")
