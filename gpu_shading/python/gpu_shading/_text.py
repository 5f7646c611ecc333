"""Text that may hold anything, for messages and terminals, as energyplus_patch/platform/text.h has it in C++."""

from __future__ import annotations

import os
import re

# Control characters, marks that turn the direction of text, ends of lines, and bytes that are not UTF-8.
_UNSAFE = re.compile(r"[\x00-\x1f\x7f-\x9f\u2028\u2029\u202a-\u202e\u2066-\u2069\ud800-\udfff]")
_MAX_LINE = 2000
_START = 1200


def escaped(text: str) -> str:
    """Control characters as \\x1b or \\u202e, bytes that are not UTF-8 as U+FFFD."""
    return _UNSAFE.sub(_escape, text)


def _escape(found: re.Match[str]) -> str:
    code = ord(found[0])
    if code >= 0xD800:
        return "\ufffd"
    return {"\n": "\\n", "\t": "\\t"}.get(found[0], f"\\x{code:02x}" if code < 0x100 else f"\\u{code:04x}")


def quoted(value: object, longest: int = 80) -> str:
    """A value as Python writes it, for a message; of a long one, the beginning."""
    try:
        text = escaped(repr(value[:longest + 1] if isinstance(value, str) else value))
    except (ValueError, RecursionError):  # a number of thousands of digits
        text = "a value too long to print"
    return text if len(text) <= longest + 2 else f"{text[:longest]}..."


def one_line(message: str) -> str:
    """A message whatever names and values it has: lines joined, the middle of a very long one left out."""
    line = escaped(re.sub(r"\s*[\r\n]+\s*", " ", message.strip()))
    return line if len(line) <= _MAX_LINE else f"{line[:_START]} ... {line[-(_MAX_LINE - _START):]}"


def of_error(error: BaseException) -> str:
    """What an exception says, in one line. The system's errors name the file first."""
    if isinstance(error, OSError) and error.strerror and isinstance(error.filename, (str, bytes, os.PathLike)):
        return one_line(f"{os.fsdecode(error.filename)}: {error.strerror}")
    return one_line(str(error) or type(error).__name__)
