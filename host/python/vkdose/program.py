"""Finds and starts the installed program.

The program runs in a process of its own, so that a crash of a graphics driver does not end Python.
"""

from __future__ import annotations

import os
import shutil
import signal
import subprocess
import threading
from pathlib import Path
from typing import Sequence

from .errors import VkdoseError, error_for


def program() -> str:
    """Path of the program: what ``VKDOSE`` in the environment names, the one in this package, or that on the PATH.

    Raises VkdoseError if there is none.
    """
    named = os.environ.get("VKDOSE")
    if named:
        return named
    inside = Path(__file__).parent / "installed" / "bin" / "vkdose"
    if inside.is_file():
        return str(inside)
    found = shutil.which("vkdose")
    if found is None:
        raise VkdoseError(
            "the program vkdose is not installed: install the package vkdose, or name the program in the variable VKDOSE"
        )
    return found


class Process:
    """A program that was started. Its output can be read while it runs, and what it says on stderr is collected."""

    def __init__(self, arguments: Sequence[str]) -> None:
        self._starter = os.getpid()
        # A session of its own: Ctrl-C reaches Python alone, which then decides what becomes of the run.
        self._process = subprocess.Popen(
            [program(), *arguments],
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            encoding="utf-8",
            errors="replace",
            start_new_session=True,
        )
        self._said: list[str] = []
        # Read all along: a full pipe would hold the program.
        self._listener = threading.Thread(target=self._listen, daemon=True)
        self._listener.start()

    def _listen(self) -> None:
        assert self._process.stderr is not None
        with self._process.stderr as stream:
            self._said.extend(stream)

    @property
    def ours(self) -> bool:
        """Whether this process has started it. One that was forked off later shares the pipe, but is no parent."""
        return os.getpid() == self._starter

    def require_ours(self) -> None:
        """Raises VkdoseError in a process that was forked off."""
        if not self.ours:
            raise VkdoseError(
                f"process {self._starter} has started this program, and only it can follow it; this process was forked "
                f"off from it and has the number {os.getpid()}"
            )

    def lines(self):
        """The lines of stdout as they come."""
        assert self._process.stdout is not None
        while True:
            self.require_ours()  # each time: a fork that comes in between would take lines from its parent
            line = self._process.stdout.readline()
            if not line:
                return
            yield line

    def interrupt(self) -> None:
        """Asks the program to stop and to keep what it has. In a process that was forked off it does nothing."""
        if self.ours and self._process.poll() is None:
            self._process.send_signal(signal.SIGINT)

    def running(self) -> bool:
        self.require_ours()
        return self._process.poll() is None

    def wait(self) -> int:
        """Waits for the end. Returns the exit code; of a program that a signal ended it is 128 and the signal."""
        self.require_ours()
        assert self._process.stdout is not None
        code = self._process.wait()
        self._listener.join()
        self._process.stdout.close()
        return 128 - code if code < 0 else code

    @property
    def said(self) -> str:
        """What it said on stderr so far."""
        return "".join(self._said).strip()


def call(*arguments: str) -> str:
    """Runs a command to its end and returns what it prints. Raises what its exit code stands for."""
    process = Process(arguments)
    try:
        text = "".join(process.lines())
    except BaseException:
        process.interrupt()
        process.wait()
        raise
    code = process.wait()
    if code != 0:
        raise error_for(code, process.said)
    return text


def version() -> str:
    """Version of the program, such as "0.1.0"."""
    return call("--version").split()[-1]
