"""What can go wrong, as exceptions. Each class stands for an exit code of the program."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Fault:
    """An error of a case file.

    ``file`` and ``line`` (0: not a line of a file) say where it stands, ``key`` and ``value`` what was read, ``text``
    what is wrong and ``cure`` what would be right.
    """

    file: str
    line: int
    key: str
    value: str
    text: str
    cure: str

    def __str__(self) -> str:
        place = f"{self.file}:{self.line}" if self.line else self.file
        value = f" = {self.value}" if self.value else ""
        return f"{place}: {self.key}{value}: {self.text}; {self.cure}"


@dataclass(frozen=True)
class CaseWarning:
    """Something in a case that is valid and yet hardly what was meant.

    ``name`` is that of the rule, ``key`` the value to look at first. ``accepted`` tells that the case itself names the
    rule in ``accepted_warnings``.
    """

    name: str
    key: str
    value: str
    text: str
    cure: str
    accepted: bool

    def __str__(self) -> str:
        value = f" = {self.value}" if self.value else ""
        return f"{self.key}{value}: {self.text}; {self.cure} ({self.name})"


class VkdoseError(Exception):
    """An error of the program. ``code`` is its exit code."""

    code = 1


class InputError(VkdoseError):
    """A case, a study, a file or an option is wrong. Nothing was written.

    ``faults`` holds every error of a case; it is empty when the error is of another kind.
    """

    code = 2

    def __init__(self, text: str, faults: tuple[Fault, ...] = ()) -> None:
        super().__init__(text)
        self.faults = faults


class RunError(VkdoseError):
    """The run could not go on. What was computed is kept in its folder."""

    code = 3


class DeviceError(VkdoseError):
    """There is no usable Vulkan device, or it failed. What was computed is kept."""

    code = 4


class OutputError(VkdoseError):
    """A result could not be written."""

    code = 5


class Interrupted(VkdoseError):
    """The run was asked to stop before it was over. It can go on: see ``vkdose.resume``."""

    code = 130


def error_for(code: int, text: str) -> VkdoseError:
    """The exception for an exit code of the program. ``text`` is what it said."""
    for kind in (InputError, RunError, DeviceError, OutputError, Interrupted):
        if kind.code == code:
            return kind(text)
    error = VkdoseError(text or f"vkdose ended with code {code}")
    error.code = code
    return error
