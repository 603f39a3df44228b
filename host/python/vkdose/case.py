"""A case: one device with its powder and schedule."""

from __future__ import annotations

import json
import os
import tempfile
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Iterator, Mapping, Optional, Union

import tomli_w

from .errors import CaseWarning, Fault, InputError, error_for
from .program import Process
from .results import SweepResult, played
from .run import Run

Source = Union[str, "os.PathLike[str]", Mapping[str, Any]]


@dataclass(frozen=True)
class Check:
    """What ``vkdose check`` says of a case.

    ``figures`` holds numbers in SI units, with the unit in the name ("time_step_s"). None stands for a number that
    does not exist in this case. It is empty if there are errors.
    """

    errors: tuple[Fault, ...]
    warnings: tuple[CaseWarning, ...]
    figures: Mapping[str, Any]
    file: str

    @property
    def ok(self) -> bool:
        """Whether the case can be run. Warnings do not stop a run."""
        return not self.errors


def _value(value: Any) -> str:
    """A value as TOML on one line, as ``--set`` takes it."""
    if isinstance(value, Mapping):
        return "{" + ", ".join(f"{_value(str(key))} = {_value(part)}" for key, part in value.items()) + "}"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(_value(part) for part in value) + "]"
    return tomli_w.dumps({"v": value}).partition("=")[2].strip()


class Case:
    """A case from a file, the name of a case that comes with vkdose, or a dict with the tables of a case file.

    ``changes`` are laid over it: {"coil.speed_rpm": 60}. A dict with a ``base`` starts from that case, by its file or
    its name. Relative paths in a dict start from the current folder.

        Case("mini", {"seed": 2})
        Case({"base": "mini", "coil": {"speed_rpm": 60}})
    """

    def __init__(self, source: Source, changes: Optional[Mapping[str, Any]] = None) -> None:
        own: dict[str, Any] = {}
        if isinstance(source, Mapping):
            source = placed(source)
            if "base" in source:
                own = flat({key: value for key, value in source.items() if key != "base"})
                source = source["base"]
        self.source = source
        self.changes: dict[str, Any] = {**own, **(changes or {})}

    def __repr__(self) -> str:
        return f"Case({self.source!r}, {self.changes!r})"

    def with_(self, changes: Mapping[str, Any]) -> "Case":
        """Returns this case with further changes. They win over earlier ones."""
        return Case(self.source, {**self.changes, **changes})

    def settings(self) -> list[str]:
        """The changes as ``--set`` takes them: ["coil.speed_rpm=60"]."""
        return [f"{key}={_value(value)}" for key, value in self.changes.items()]

    @contextmanager
    def file(self) -> Iterator[str]:
        """The file or the name of this case without its changes. That of a dict is there inside the ``with`` only."""
        if not isinstance(self.source, Mapping):
            yield os.fspath(self.source)
            return
        with written(self.source, "case") as file:
            yield str(file)

    @contextmanager
    def arguments(self) -> Iterator[list[str]]:
        """The arguments of the command line that name this case. Those of a dict hold inside the ``with`` only."""
        with self.file() as file:
            yield [file, *(part for setting in self.settings() for part in ("--set", setting))]

    def check(self) -> Check:
        """Validates the case. Raises InputError if there is no such case at all."""
        with self.arguments() as case:
            process = Process(["check", *case, "--json", "--assume"])
            text = "".join(process.lines())
            code = process.wait()
        if not text:
            raise error_for(code, process.said)
        found = json.loads(text)
        return Check(
            errors=tuple(Fault(**fault) for fault in found["errors"]),
            warnings=tuple(CaseWarning(**warning) for warning in found["warnings"]),
            figures=found.get("figures", {}),
            file=found["file"],
        )

    def run(
        self,
        out: Optional[Union[str, "os.PathLike[str]"]] = None,
        *,
        force: bool = False,
        backend: Optional[str] = None,
        device: Optional[str] = None,
    ) -> Run:
        """Starts a run and returns at once.

        ``out`` is the output folder (default: out/NAME). ``force`` replaces a former run there. ``backend`` is
        "vulkan" or "reference", ``device`` the index of a Vulkan device or part of its name.

        Raises InputError, with every fault in ``faults``, if the case is wrong; DeviceError if there is no device;
        OutputError if the folder cannot be written.
        """
        options = ["--force"] if force else []
        for name, value in (("--out", out), ("--backend", backend), ("--device", device)):
            if value is not None:
                options += [name, os.fspath(value)]
        with self.arguments() as case:
            run = Run(["run", *case, *options])
            try:
                run.started()  # the program has read the case file by then
            except InputError as error:
                faults = self.check().errors
                raise InputError(str(error), faults) from None
        return run

    def draws(
        self,
        powder: Union[str, "os.PathLike[str]"],
        count: int,
        out: Optional[Union[str, "os.PathLike[str]"]] = None,
        *,
        jobs: Optional[int] = None,
        backend: Optional[str] = None,
        device: Optional[str] = None,
    ) -> SweepResult:
        """Runs the case with the first ``count`` draws of a powder, each with another seed, and waits.

        ``powder`` is a powder file that has draws, or its name. ``prediction`` of the result has the intervals of the
        figures. ``out`` is the folder (default: out/NAME-draws); a second call goes on in it. ``jobs`` runs go on at
        once. Raises InputError if case or powder are wrong, or the powder has fewer draws.
        """
        options = ["--powder", os.fspath(powder), "--draws", str(count), "--quiet"]
        with self.arguments() as case:
            folder = Path(out) if out is not None else Path("out") / f"{Path(case[0]).stem}-draws"
            given = (("--jobs", jobs), ("--backend", backend), ("--device", device))
            for name, value in given:
                if value is not None:
                    options += [name, str(value)]
            return played(["run", *case, *options, "--out", str(folder)], folder)


@contextmanager
def written(tables: Mapping[str, Any], name: str) -> Iterator[Path]:
    """A file with these tables, for the time of the ``with``."""
    with tempfile.TemporaryDirectory(prefix="vkdose-") as folder:
        file = Path(folder) / f"{file_name(tables.get('name', name))}.toml"
        file.write_text(tomli_w.dumps(tables), encoding="utf-8")
        yield file


def file_name(name: Any) -> str:
    """A name as that of a file or folder: without a slash it stays where it is put."""
    safe = str(name).replace("/", "-").replace("\0", "-")
    return "-" if safe in ("", ".", "..") else safe


def flat(tables: Mapping[str, Any], above: str = "") -> dict[str, Any]:
    """{"coil": {"speed_rpm": 60}} as {"coil.speed_rpm": 60}."""
    keys: dict[str, Any] = {}
    for key, value in tables.items():
        if isinstance(value, Mapping):
            keys.update(flat(value, f"{above}{key}."))
        else:
            keys[above + key] = value
    return keys


# The last parts of the keys whose values may be paths of files.
PATHS = ("base", "list", "sieves", "mesh", "file", "law", "measured")


def placed(value: Any, key: str = "") -> Any:
    """The tables of a case or study with the paths of files made absolute: a file counts them from its own folder."""
    if isinstance(value, Mapping):
        parts = {k: placed(v, k) for k, v in value.items()}
        if not isinstance(value.get("values"), (list, tuple)):
            return parts
        if "key" in value:  # an axis
            parts["values"] = placed(value["values"], str(value["key"]))
        elif "keys" in value:  # one whose keys move together
            parts["values"] = [_placed_point(point, value["keys"]) for point in value["values"]]
        return parts
    if isinstance(value, (list, tuple)):
        return [placed(v, key) for v in value]
    if key.rpartition(".")[2] in PATHS and isinstance(value, (str, os.PathLike)):
        # A law may be a word, and a base the name of a case: no file has it, and it stays.
        return str(Path(value).resolve()) if Path(value).is_file() else os.fspath(value)
    return value


def _placed_point(point: Any, keys: Any) -> Any:
    """A value of an axis whose keys move together. One of a wrong shape stays, for the program to refuse."""
    if not isinstance(point, (list, tuple)) or not isinstance(keys, (list, tuple)) or len(point) != len(keys):
        return point
    return [placed(value, str(key)) for key, value in zip(keys, point)]
