"""Studies: a case, what is varied of it, and seeds."""

from __future__ import annotations

import os
from contextlib import contextmanager
from pathlib import Path
from typing import Any, Iterator, Mapping, Optional, Union

from .case import Case, Source, file_name, placed, written
from .results import SweepResult, played


def _targets(study: Mapping[str, Any]) -> list[dict[str, Any]]:
    """The targets of a calibration. Each may have a base of its own."""
    aim = study.get("calibrate")
    targets = aim.get("target", []) if isinstance(aim, Mapping) else []
    return [t for t in targets if isinstance(t, dict)] if isinstance(targets, list) else []


def _case_file(base: str) -> str:
    """A study file names its base case by a path; a dict may name one that comes with vkdose."""
    return base if Path(base).is_file() else Case(base).check().file


class Study:
    """A study from a file, its name, or a dict with the tables of a study file.

        Study({"base": "mini", "seeds": 2, "axis": [{"key": "coil.speed_rpm", "values": [60, 90]}]})
    """

    def __init__(self, source: Source) -> None:
        self.source = source

    def __repr__(self) -> str:
        return f"Study({self.source!r})"

    @contextmanager
    def _file(self) -> Iterator[str]:
        if isinstance(self.source, Mapping):
            study = placed(self.source)
            for table in (study, *_targets(study)):
                if "base" in table:
                    table["base"] = _case_file(table["base"])
            with written(study, "study") as file:
                yield str(file)
        else:
            yield os.fspath(self.source)

    def _name(self) -> str:
        if isinstance(self.source, Mapping):
            return file_name(self.source.get("name", "study"))
        return Path(self.source).stem

    def _play(self, command: str, out: Any, jobs: Optional[int], options: Mapping[str, Optional[str]]) -> SweepResult:
        folder = Path(out) if out is not None else Path("out") / self._name()
        with self._file() as study:
            arguments = [command, study, "--quiet", "--out", str(folder)]
            if jobs is not None:
                arguments += ["--jobs", str(jobs)]
            for name, value in options.items():
                if value is not None:
                    arguments += [f"--{name}", value]
            return played(arguments, folder)

    def sweep(
        self,
        out: Optional[Union[str, "os.PathLike[str]"]] = None,
        *,
        jobs: Optional[int] = None,
        backend: Optional[str] = None,
        device: Optional[str] = None,
    ) -> SweepResult:
        """Runs every member that has not ended yet, and waits. ``jobs`` members run at once (default: one a core).

        Members that fail do not raise; ``members`` tells how each ended. Ctrl-C interrupts the sweep, and a second
        call goes on with it.
        """
        return self._play("sweep", out, jobs, {"backend": backend, "device": device})

    def calibrate(
        self,
        out: Optional[Union[str, "os.PathLike[str]"]] = None,
        *,
        jobs: Optional[int] = None,
        backend: Optional[str] = None,
        device: Optional[str] = None,
    ) -> SweepResult:
        """Looks for the parameters that dose the measured mass; the study needs a table ``calibrate``. See ``sweep``."""
        return self._play("calibrate", out, jobs, {"backend": backend, "device": device})
