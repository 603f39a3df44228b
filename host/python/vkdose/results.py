"""What a run left in its output folder."""

from __future__ import annotations

import html
import json
import os
import re
from pathlib import Path
from typing import TYPE_CHECKING, Any, Iterator, Mapping, Optional, Sequence, Union

from .errors import InputError, error_for
from .program import Process, call

if TYPE_CHECKING:
    import numpy
    import pandas


def _table(file: Path) -> "pandas.DataFrame":
    import pandas

    if not file.is_file():
        raise InputError(f"{file} is not there")
    return pandas.read_csv(file, float_precision="round_trip")


class _Arrays(Mapping[str, "numpy.ndarray"]):
    """The arrays of a frame's file by their names. Each is read when it is asked for, and kept.

    ``points`` is the name for the places of the file's cells, ``group`` the part of the file with all else.
    """

    def __init__(self, file: Path, points: str, group: str) -> None:
        import h5py

        if not file.is_file():
            raise InputError(f"{file} is not there; does the case ask for these frames?")
        self._file, self._points, self._group = file, points, group
        with h5py.File(file) as stored:
            self._names = [points, *stored["VTKHDF"][group]]
        self._read: dict[str, "numpy.ndarray"] = {}

    def __getitem__(self, name: str) -> "numpy.ndarray":
        import h5py

        if name not in self._names:
            raise KeyError(name)
        if name not in self._read:
            with h5py.File(self._file) as stored:
                root = stored["VTKHDF"]
                if name != self._points:
                    self._read[name] = root[self._group][name][...]
                elif self._group == "CellData":  # a line for each cell
                    self._read[name] = root["Points"][...][root["Connectivity"][...].reshape(-1, 2)]
                else:
                    self._read[name] = root["Points"][...]
        return self._read[name]

    def __contains__(self, name: object) -> bool:
        return name in self._names

    def __iter__(self) -> Iterator[str]:
        return iter(self._names)

    def __len__(self) -> int:
        return len(self._names)

    def __repr__(self) -> str:
        return f"arrays of {self._file}: {', '.join(self._names)}"


class Frame:
    """The powder at one time. Arrays are read from the file one by one, when they are asked for.

    ``number``, ``time`` [s], ``phase`` and ``dose`` say which frame it is.
    """

    def __init__(self, folder: Path, row: Mapping[str, Any]) -> None:
        self._folder = folder
        self.number = int(row["frame"])
        self.time = float(row["time_s"])
        self.phase = str(row["phase"])
        self.dose = int(row["dose"])

    @property
    def particles(self) -> Mapping[str, "numpy.ndarray"]:
        """Arrays by name, a row for each particle: "position" (n, 3) [m], "radius" [m], "velocity" (n, 3) [m/s] ..."""
        return _Arrays(self._folder / f"particles_{self.number:06d}.hdf", "position", "PointData")

    @property
    def contacts(self) -> Mapping[str, "numpy.ndarray"]:
        """Arrays by name, a row for each contact: "ends" (n, 2, 3) [m], what the line of the contact joins, and its
        forces and springs. Only there with ``frames.contacts`` in the case."""
        return _Arrays(self._folder / f"contacts_{self.number:06d}.hdf", "ends", "CellData")

    @property
    def positions(self) -> "numpy.ndarray":
        """Centres of the particles, (n, 3) [m]."""
        return self.particles["position"]

    def __repr__(self) -> str:
        return f"Frame {self.number}: t = {self.time:.4g} s, {self.phase}, dose {self.dose}"


class Result:
    """The output folder of a run. Everything is read when it is asked for."""

    def __init__(self, folder: Union[str, "os.PathLike[str]"]) -> None:
        self.folder = Path(folder)
        if not (self.folder / "summary.json").is_file():
            raise InputError(f"{self.folder} holds no run that has ended: there is no summary.json")

    def __repr__(self) -> str:
        return f"Result({str(self.folder)!r})"

    @property
    def summary(self) -> dict[str, Any]:
        """summary.json: inputs, doses, figures, ledger, speed. A number that does not exist is None."""
        return json.loads((self.folder / "summary.json").read_text(encoding="utf-8"))

    @property
    def doses(self) -> "pandas.DataFrame":
        """A row for each dose, with the columns of doses.csv."""
        return _table(self.folder / "doses.csv")

    @property
    def timeseries(self) -> "pandas.DataFrame":
        """A row for each sensor interval, with the columns of timeseries.csv."""
        return _table(self.folder / "timeseries.csv")

    @property
    def cycles(self) -> "pandas.DataFrame | None":
        """A row for each turn, pocket or stroke of the device, with the columns of cycles.csv; None if there are none."""
        file = self.folder / "cycles.csv"
        return _table(file) if file.is_file() else None

    @property
    def particles(self) -> "pandas.DataFrame":
        """The end state, a row for each particle."""
        return _table(self.folder / "particles.csv")

    @property
    def frames(self) -> list[Frame]:
        """The frames in the order of time; none if the case asks for none."""
        index = self.folder / "frames" / "frames.csv"
        if not index.is_file():
            return []
        return [Frame(index.parent, row) for row in _table(index).to_dict("records")]

    @property
    def fields(self) -> list[str]:
        """Names of the fields that the case asks for."""
        # NAME.csv; the maps that it lists are NAME_000000.csv.
        files = (self.folder / "fields").glob("*.csv")
        return sorted(file.stem for file in files if not re.fullmatch(r".*_\d{6}", file.stem))

    def field(self, name: str) -> "pandas.DataFrame":
        """A row for each time and point of a field: time_s, phase, dose, the place (y_m, z_m ...), density_kg_m3 ...

        ``field(name).set_index(["time_s", "y_m", "z_m"]).to_xarray()`` makes a grid of it. Fields in three directions
        are files for ParaView, which this does not read.
        """
        import pandas

        folder = self.folder / "fields"
        table = _table(folder / f"{name}.csv")
        if "file" not in table:
            return table
        maps = []
        for row in table.to_dict("records"):
            if not row["file"].endswith(".csv"):
                raise InputError(f"{folder / row['file']} is a file for ParaView, not a table")
            one = _table(folder / row.pop("file"))
            for place, column in enumerate(row):
                one.insert(place, column, row[column])
            maps.append(one)
        return pandas.concat(maps, ignore_index=True)

    def report(self, out: Optional[Union[str, "os.PathLike[str]"]] = None) -> Path:
        """Writes the HTML report (default: report.html in the folder) and returns its path."""
        page = Path(out) if out is not None else self.folder / "report.html"
        call("report", str(self.folder), "--out", str(page))
        return page

    def picture(self, out: Optional[Union[str, "os.PathLike[str]"]] = None, *options: str) -> Path:
        """Draws a PNG (default: picture.png in the folder) and returns its path. ``options`` are those of ``vkdose render``."""
        file = Path(out) if out is not None else self.folder / "picture.png"
        call("render", str(self.folder), "--out", str(file), *options)
        return file

    def _repr_html_(self) -> str:
        """The report, in a frame of its own in a notebook."""
        page = html.escape(self.report().read_text(encoding="utf-8"), quote=True)
        return f'<iframe srcdoc="{page}" style="width: 100%; height: 40em; border: 0"></iframe>'


class SweepResult:
    """The folder of a sweep or of a calibration. Everything is read when it is asked for."""

    def __init__(self, folder: Union[str, "os.PathLike[str]"]) -> None:
        self.folder = Path(folder)
        if not (self.folder / "members.csv").is_file():
            raise InputError(f"{self.folder} holds no sweep: there is no members.csv")

    def __repr__(self) -> str:
        return f"SweepResult({str(self.folder)!r})"

    @property
    def members(self) -> "pandas.DataFrame":
        """A row for each member: its values, its figures, how it ended."""
        return _table(self.folder / "members.csv")

    @property
    def doses(self) -> "pandas.DataFrame":
        """A row for each dose of each member."""
        return _table(self.folder / "doses.csv")

    @property
    def figures(self) -> "pandas.DataFrame":
        """A row for each member that ended well, with every figure that a target can name. See figures.csv."""
        return _table(self.folder / "figures.csv")

    @property
    def prediction(self) -> "Optional[pandas.DataFrame]":
        """Of runs with draws of a powder: for each figure ``draws``, ``mean``, ``deviation``, ``low`` and ``high``.

        One more such run is to be expected between ``low`` and ``high`` with a chance of 95 %. None of other sweeps.
        """
        file = self.folder / "prediction.json"
        if not file.is_file():
            return None
        import pandas

        return pandas.DataFrame(json.loads(file.read_text())["figures"]).set_index("name")

    def member(self, number: int) -> Result:
        """The result of one member, by its number in ``members``."""
        return Result(self.folder / "members" / f"{number:04d}")

    def report(self, out: Optional[Union[str, "os.PathLike[str]"]] = None) -> Path:
        """Writes the HTML report (default: report.html in the folder) and returns its path."""
        page = Path(out) if out is not None else self.folder / "report.html"
        call("report", str(self.folder), "--out", str(page))
        return page

    @property
    def calibrated(self) -> Optional[Path]:
        """The case that a calibration found, ready to run; None if it met no target."""
        file = self.folder / "calibrated.toml"
        return file if file.is_file() else None


def played(arguments: Sequence[str], folder: Path) -> SweepResult:
    """Runs the command of a sweep into ``folder`` and waits. Ctrl-C interrupts it, and a second call goes on with it."""
    process = Process(arguments)
    try:
        for _ in process.lines():
            pass
    except BaseException:
        process.interrupt()
        process.wait()
        raise
    code = process.wait()
    if code not in (0, 1):  # 1: a member failed, or a target was not met; the tables say so
        raise error_for(code, process.said)
    return SweepResult(folder)
