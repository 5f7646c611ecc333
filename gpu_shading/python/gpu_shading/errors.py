"""Exceptions. Each has one line that says what is wrong and what was expected."""

from gpu_shading._text import one_line


class Error(Exception):
    """Any error of this package. Names in its line may be those of strangers, and reach a terminal."""

    def __str__(self) -> str:
        return one_line(super().__str__())


class InvalidInput(Error, ValueError):
    """A value, an array or a model that is refused."""


class FileError(Error, OSError):
    """A file that cannot be written."""


class DeviceError(Error, RuntimeError):
    """The device that was asked for is not there, or was lost."""


class RunError(Error, RuntimeError):
    """EnergyPlus or the gpu_shading program could not do what was asked."""
