"""A run inside Python: it goes on when it is told to, and can be looked at in between."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING, Any, Iterator, Mapping, Optional, Union

from .case import Case, Source
from .errors import VkdoseError

if TYPE_CHECKING:
    import numpy
    from numpy.typing import NDArray

    from . import _core

    Numbers = NDArray[numpy.float64]


class Simulation:
    """A case that is run in this process. It writes no files. Its bits are those of ``Case.run``.

    ``case`` and ``changes`` are as in ``Case``. ``backend`` is "vulkan" or "reference", ``device`` the index of a
    Vulkan device or part of its name.

        with vkdose.Simulation("mini", {"coil.speed_rpm": 60}) as sim:
            for dose in sim.doses():
                print(dose["mass_kg"], sim.positions.shape)

    Another thread of Python can work while ``advance`` waits; only one may use the simulation. Ctrl-C lets the run rest
    within about a second, and it can go on. A crash of a graphics driver ends Python: ``Case.run`` is safe from that.

    Raises InputError, with every fault in ``faults``, if the case is wrong; DeviceError if there is no device; and
    ImportError if the module for runs inside Python is not there.
    """

    def __init__(
        self,
        case: Union[Case, Source],
        changes: Optional[Mapping[str, Any]] = None,
        *,
        backend: str = "vulkan",
        device: str = "",
    ) -> None:
        self._open: Optional[_core.Simulation] = None
        module = _module()
        case = case.with_(changes or {}) if isinstance(case, Case) else Case(case, changes)
        with case.file() as file:
            if not os.path.exists(file) and not Path(file).is_absolute():
                file = case.check().file  # the program knows where cases with a name are
            self._open = module.Simulation(file, case.settings(), backend, device)

    def __repr__(self) -> str:
        if self._open is None:
            return "Simulation, closed"
        return f"Simulation of {self._run.name}: t = {self.time:.4g} s, {self.phase}, on {self.backend}"

    def __enter__(self) -> "Simulation":
        return self

    def __exit__(self, kind: Any, value: Any, trace: Any) -> None:
        self.close()

    def close(self) -> None:
        """Ends the run and gives back its memory and its device. Arrays that were read stay."""
        self._open = None

    @property
    def _run(self) -> "_core.Simulation":
        if self._open is None:
            raise VkdoseError("the simulation was closed")
        return self._open

    # Going on

    def advance(self, seconds: float = 0) -> None:
        """Goes on to the reading of the sensors nearest to ``seconds`` [s] of simulated time from now, and at least to
        the next one. Does nothing if the run is over.

        Sensors are read at the case's interval, at the end of each phase and when the coil is told to stop. Raises
        RunError or DeviceError if the run cannot go on; its last state can still be read.
        """
        self._run.advance(seconds)

    def run(self) -> None:
        """Goes on until the run is over. Raises as ``advance``."""
        self._run.advance(float("inf"))

    def samples(self) -> Iterator[dict[str, Any]]:
        """Goes on from reading to reading, and gives ``sample`` at each."""
        while not self.over:
            self.advance()
            yield self.sample

    def doses(self) -> Iterator[dict[str, Any]]:
        """Goes on from dose to dose, and gives each when its rest is over: a dict with the columns of doses.csv, masses
        in kg. The last one has ``complete`` False if the run ended within it."""
        seen = len(self.ended_doses)
        while True:
            if len(self.ended_doses) == seen:
                self._run.advance_to_dose()
            ended = self.ended_doses[seen:]
            if not ended:
                return
            seen += len(ended)
            yield from ended

    # Looking

    @property
    def over(self) -> bool:
        """Whether the run has ended by its schedule, by a rule of the case or by an error."""
        return self._run.over

    @property
    def stop_reason(self) -> Optional[str]:
        """The reason why the run ended, as in summary.json: "doses", "empty", ...; None before."""
        return self._run.stop_reason if self.over else None

    @property
    def backend(self) -> str:
        """"reference", or "vulkan: " and the name of the device."""
        return self._run.backend

    @property
    def time(self) -> float:
        """Simulated time [s]."""
        return self._run.time

    @property
    def sensor_interval(self) -> float:
        """Time from one reading of the sensors to the next [s]."""
        return self._run.sensor_interval

    @property
    def sample(self) -> dict[str, Any]:
        """The latest reading of the sensors: a dict with the columns of timeseries.csv, and with those of bodies and
        regions by their names in "bodies" and "regions" if the case has any. Its "time_s" is ``time``, unless Ctrl-C
        stopped the run between two readings."""
        return self._run.sample

    @property
    def ended_doses(self) -> list[dict[str, Any]]:
        """The doses that have ended, as ``doses`` gives them."""
        return self._run.doses

    @property
    def phase(self) -> str:
        """The phase up to the latest reading: "settle", "rotate", "reverse" or "rest"."""
        return self.sample["phase"]

    @property
    def dosed_mass(self) -> float:
        """Mass that has been dosed since the start of the run, at the latest reading [kg]."""
        return self.sample["dosed_mass_kg"]

    @property
    def dose_mass(self) -> float:
        """Mass that has been dosed since the start of the latest dose, at the latest reading [kg]; 0 before it."""
        return self._run.dose_mass

    @property
    def throat_mass(self) -> float:
        """Mass in the throat of the outlet at the latest reading [kg]."""
        return self.sample["throat_mass_kg"]

    @property
    def canister_mass(self) -> float:
        """Mass in the canister at the latest reading [kg]."""
        return self.sample["canister_mass_kg"]

    @property
    def torque(self) -> float:
        """Torque of the drive [N m], mean between the two latest readings; positive when the powder resists."""
        return self.sample["coil_torque_Nm"]

    # The particles. Each array is a copy, with a row for each particle that was filled in. A particle keeps its row; a
    # dosed one stands where it was when it was counted.

    @property
    def positions(self) -> "Numbers":
        """Centres of the particles now, a copy, (n, 3) [m]."""
        return self._run.positions

    @property
    def velocities(self) -> "Numbers":
        """Velocities of the particles, half a time step ago, a copy, (n, 3) [m/s]."""
        return self._run.velocities

    @property
    def spins(self) -> "Numbers":
        """Angular velocities of the particles, half a time step ago, a copy, (n, 3) [rad/s]."""
        return self._run.spins

    @property
    def radii(self) -> "Numbers":
        """Radii of the particles, a copy, (n,) [m]."""
        return self._run.radii

    @property
    def ids(self) -> "NDArray[numpy.int64]":
        """Numbers of the particles, (n,), from 0: those of particles.csv and of frames."""
        import numpy

        return numpy.arange(len(self.radii))

    @property
    def active(self) -> "NDArray[numpy.bool_]":
        """Whether each particle is neither dosed nor lost, a copy, (n,)."""
        return self._run.active


def _module() -> Any:
    try:
        from . import _core
    except ImportError as lack:
        raise ImportError(
            "a run inside Python takes the module vkdose._core, which is not there: build vkdose with pybind11-dev and "
            "python3-dev, and in a source tree add build/release/python to PYTHONPATH; vkdose.Case(...).run() does "
            f"without it ({lack})"
        ) from lack
    return _core
