"""A run of a case, while it goes on."""

from __future__ import annotations

import json
import os
from typing import Any, Iterator, Mapping, Optional, Sequence, Union

from .errors import error_for
from .program import Process
from .results import Result

Event = Mapping[str, Any]


class Run:
    """A run that was started. It goes on by itself, whether its events are read or not.

    Leaving its ``with`` early, or an exception inside, interrupts the run; ``vkdose.resume`` goes on with it.

        with vkdose.Case("mini").run() as run:
            for dose in run.doses():
                print(dose["mass_kg"])
    """

    def __init__(self, arguments: Sequence[str]) -> None:
        self._process = Process([*arguments, "--events"])
        self._lines = self._process.lines()
        self._first: Optional[Event] = None
        self._last: Optional[Event] = None
        self._code: Optional[int] = None

    def started(self) -> Event:
        """Waits until the run has begun. Returns its first event: case, particles, filled_kg, output, backend.

        Raises what the program refused the case with.
        """
        if self._first is None:
            self._first = next(self._read(), None)
            if self._first is None:
                raise error_for(self._end(), self._process.said)
        return self._first

    def _read(self) -> Iterator[Event]:
        self._process.require_ours()
        for line in self._lines:
            event = json.loads(line)
            if event["event"] == "end":
                self._last = event
            yield event

    def events(self) -> Iterator[Event]:
        """Every event from here to the end, as dicts. "event" says the kind: warning, phase, sample, settled, dose, end.

        The manual's page of the commands lists their members.
        """
        self.started()
        yield from self._read()

    def _of(self, kind: str) -> Iterator[Event]:
        for event in self.events():
            if event["event"] == kind:
                yield event

    def doses(self) -> Iterator[Event]:
        """Each dose when its rest is over: a dict with the columns of doses.csv. Masses are in kg."""
        return self._of("dose")

    def samples(self) -> Iterator[Event]:
        """A dict with the columns of timeseries.csv at each sensor interval."""
        return self._of("sample")

    def interrupt(self) -> None:
        """Asks the run to stop. It keeps what it has computed and can be resumed."""
        self._process.interrupt()

    def _end(self) -> int:
        if self._code is None:
            for _ in self._read():
                pass
            self._code = self._process.wait()
        return self._code

    def wait(self) -> Result:
        """Waits for the end and returns what the run left.

        Raises RunError, DeviceError or OutputError if it could not go on, and Interrupted if it was stopped. What it
        computed stays in its folder.
        """
        self.started()
        code = self._end()
        if code != 0:
            told = self._last["error"] if self._last and self._last["error"] else self._process.said
            stopped = self._last["stop_sentence"] if self._last else "the program ended by itself"
            raise error_for(code, told or stopped)
        return Result(self.folder)

    @property
    def folder(self) -> str:
        """The output folder."""
        return self.started()["output"]

    @property
    def running(self) -> bool:
        return self._process.running()

    def __enter__(self) -> "Run":
        return self

    def __exit__(self, kind: Any, value: Any, trace: Any) -> None:
        if not self._process.ours:
            return  # a fork leaves the run to the process that started it
        self.interrupt()
        self._end()


def resume(folder: Union[str, "os.PathLike[str]"], *, device: Optional[str] = None) -> Run:
    """Goes on with an interrupted run from its checkpoint. Raises InputError if there is none or the run is over."""
    options = [] if device is None else ["--device", device]
    run = Run(["resume", os.fspath(folder), *options])
    run.started()
    return run
