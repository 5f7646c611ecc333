"""Errors of the operating system in plain words."""


def in_words(error):
    """The file and what is wrong with it, without the number that Python puts first."""
    if isinstance(error, OSError) and error.strerror and error.filename is not None:
        return f"{error.filename}: {error.strerror}"
    return str(error)
