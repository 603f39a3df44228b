"""A run inside Python: it goes on when it is told to, and can be looked at in between."""

from __future__ import annotations

import os
import sys
from contextlib import nullcontext
from pathlib import Path
from typing import TYPE_CHECKING, Any, ContextManager, Iterator, Mapping, Optional, Union

from .case import Case, Source
from .errors import InputError, VkdoseError

if TYPE_CHECKING:
    import numpy
    import pandas
    from numpy.typing import NDArray

    from . import _core

    Numbers = NDArray[numpy.float64]


class Simulation:
    """A case that is run in this process. It writes no files but by ``store``. Its bits are those of ``Case.run``.

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
        """Goes on for ``seconds`` [s] of simulated time, to within half an interval of the sensors, and at least to their
        next reading. Does nothing if the run is over.

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

    # Orders to the drive

    @property
    def takes_orders(self) -> bool:
        """Whether the drive takes orders now: it conveys, nothing has told it to stop, and the run rests at a reading
        of the sensors. The first reading of a rotation is one interval after its start."""
        return self._run.takes_orders

    def change_speed(self, rpm: float) -> None:
        """From this reading on the drive conveys at ``rpm`` turns per minute, to the end of this dose's rotation. The
        ramp of the case applies. The next dose begins at the speed of the case.

        Raises RuntimeError unless ``takes_orders``, and InputError if the speed is too high for the time step.
        """
        self._run.change_speed(rpm)

    def stop_drive(self) -> None:
        """The drive is told to stop at this reading. The dose then goes on as at the end of its rotation: the ramp, the
        turn back and the rest of the case. ``stopped_by`` of the dose is "order".

        Raises RuntimeError unless ``takes_orders``.
        """
        self._run.stop_drive()

    def add_powder(self, refill: str) -> None:
        """Adds the powder of the ``[[refill]]`` of this name before the next step, as if its time had come. It begins at
        rest on a grid over the powder that is there; ``RunError`` ends the run if there is no room for it.

        Raises ValueError if the case has no such refill, and RuntimeError if it has been added already, or if the run
        rests between two readings of the sensors.
        """
        self._run.add_powder(refill)

    # Looking

    @property
    def over(self) -> bool:
        """Whether the run has ended by its schedule, by a rule of the case or by an error."""
        return self._run.over

    @property
    def stop_reason(self) -> Optional[str]:
        """The reason why the run ended, as in summary.json: "dose_count", "empty", ...; None before."""
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
        """The latest reading of the sensors: a dict with the columns of timeseries.csv, and with those of bodies, the coil
        among them, and regions by their names in "bodies" and "regions" if the case has any, and those of the powders in
        "powders" if it has several. Its "time_s" is ``time``, unless Ctrl-C stopped the run between two readings."""
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
        return self._run.state.positions.copy()

    @property
    def velocities(self) -> "Numbers":
        """Velocities of the particles, half a time step ago, a copy, (n, 3) [m/s]."""
        return self._run.state.velocities.copy()

    @property
    def spins(self) -> "Numbers":
        """Angular velocities of the particles, half a time step ago, a copy, (n, 3) [rad/s]."""
        return self._run.state.spins.copy()

    @property
    def radii(self) -> "Numbers":
        """Radii of the particles, a copy, (n,) [m]."""
        return self._run.state.radii.copy()

    @property
    def ids(self) -> "NDArray[numpy.int64]":
        """Numbers of the particles, (n,), from 0: those of particles.csv and of frames."""
        import numpy

        return numpy.arange(len(self._run.state.radii))

    @property
    def active(self) -> "NDArray[numpy.bool_]":
        """Whether each particle is in the canister or its throat, a copy, (n,)."""
        return self._run.state.status == 0

    def view(self) -> "View":
        """The same arrays without a copy, for a ``with``: see ``View``."""
        return View(self)

    @property
    def particles(self) -> "dict[str, numpy.ndarray]":
        """All that a frame tells of the particles, as ``Frame.particles``: arrays by name, a row for each particle.

        "position", "velocity" and "spin" (n, 3) [m, m/s, rad/s], "radius" [m], "force" (n, 3) [N] of all its contacts in
        the last step, "overlap" [m] of its deepest contact, "kinetic_energy" [J], "id", "status" (0: active, 1: dosed,
        2: lost, 3: waiting for its refill) and "member" (0). In a domain that repeats also "periods_gone" (n, 3), how often
        it has gone through each end, upwards less downwards. Each call asks the backend for its contacts.
        """
        return self._run.particles

    @property
    def contacts(self) -> "dict[str, numpy.ndarray]":
        """The contacts now, as ``Frame.contacts``: arrays by name, a row for each contact.

        "kind" is 0 for two particles, 1 for a particle and a wall, 2 for a particle and the coil. "particle" is the
        number of the particle; "other" that of the other particle, of the wall, of a slot for the turn of the coil, or
        behind the numbers of the walls that of a body. "ends" (n, 2, 3) [m]: the centre of the particle, and the other
        centre or the place where they touch. "force" (n, 3) [N] on the particle in the last step, "normal_force" and
        "tangential_force" [N] its parts, the normal one positive if it repels. "overlap" [m] of now, "max_overlap" [m]
        the largest so far. "sliding" and "rolling" (n, 3) and "torsion" [m] are the springs.

        Before the first step there are no forces. Each call asks the backend for its contacts.
        """
        return self._run.contacts

    @property
    def fields(self) -> list[str]:
        """Names of the fields that the case asks for."""
        return self._run.fields

    def field(self, name: str) -> "pandas.DataFrame":
        """A field of the case as it is now: a row for each point, with the columns of ``Result.field``.

        It is that of the instant, also where the case asks for averages. Of a profile of heights it gives the densities.
        Contact stress is that of the last step, and zero before any. Raises InputError if the case has no such field.
        """
        import pandas

        if name not in self.fields:
            known = ", ".join(self.fields) or "none ([[field]] in the case asks for one)"
            raise InputError(f"there is no field {name!r}; the case has {known}")
        table = pandas.DataFrame(self._run.field(name))
        when = {"time_s": self.time, "phase": self.phase, "dose": self.sample["dose"]}
        for place, column in enumerate(when):
            table.insert(place, column, when[column])
        return table

    # Storing

    def store(self, folder: Union[str, "os.PathLike[str]"], force: bool = False) -> Path:
        """Leaves in ``folder`` what ``Case.run`` would have left if it had been interrupted now, and returns its path.

        ``vkdose.resume(folder)``, or ``vkdose resume`` on the command line, goes on from there with the same bits. This
        run goes on likewise when it is told to. Of a run that is over it leaves the result: ``vkdose.Result(folder)``.
        Time series, doses and fields are whole. Frames of the time before, and the states that other runs can begin
        with, are not there.

        The schedule is that of the case: orders to the drive count in the dose in which they were given. At this reading
        the drive takes no more orders afterwards. Raises InputError if the folder is not empty, unless ``force`` is set
        and it holds a run, which is then replaced; and OutputError if it cannot be written.
        """
        with _hdf5():
            self._run.store(str(Path(folder)), force)
        return Path(folder)


class View:
    """The particles of a simulation at rest, without copies:

        with sim.view() as powder:
            highest = powder.positions[powder.active, 1].max()

    The arrays are read-only. They lie over the state that was read back from the backend, once for each rest, because a
    backend keeps its particles in a form of its own. So a view saves the copy of each array and nothing else.

    When the ``with`` is over, or the run has gone on, or the simulation was closed, the view gives no more arrays: that is
    a RuntimeError, or a VkdoseError of a closed simulation. An array that somebody keeps stays as it was, and keeps the
    state at that rest in memory.
    """

    def __init__(self, simulation: Simulation) -> None:
        self._simulation = simulation
        self._state: Optional[_core.State] = None

    def __enter__(self) -> "View":
        self._state = self._simulation._run.state
        return self

    def __exit__(self, kind: Any, value: Any, trace: Any) -> None:
        self._state = None

    @property
    def _now(self) -> "_core.State":
        if self._state is None:
            raise RuntimeError("a view is for a `with`, and this one is not in it: with sim.view() as powder: ...")
        if not self._simulation._run.is_now(self._state):
            raise RuntimeError("the run has gone on since the view was made; take another one")
        return self._state

    @property
    def positions(self) -> "Numbers":
        """Centres of the particles, (n, 3) [m]."""
        return self._now.positions

    @property
    def velocities(self) -> "Numbers":
        """Velocities of the particles, half a time step ago, (n, 3) [m/s]."""
        return self._now.velocities

    @property
    def spins(self) -> "Numbers":
        """Angular velocities of the particles, half a time step ago, (n, 3) [rad/s]."""
        return self._now.spins

    @property
    def radii(self) -> "Numbers":
        """Radii of the particles, (n,) [m]."""
        return self._now.radii

    @property
    def status(self) -> "NDArray[numpy.uint32]":
        """0 for an active particle, 1 for a dosed one, 2 for a lost one, 3 for one that waits for its refill, (n,)."""
        return self._now.status

    @property
    def active(self) -> "NDArray[numpy.bool_]":
        """Whether each particle is in the canister or its throat, (n,); made from ``status``."""
        return self.status == 0


def _hdf5() -> ContextManager[Any]:
    """Keeps other threads out of HDF5, which may be the same library here and in h5py, and lets in one at a time."""
    h5py = sys.modules.get("h5py._objects")
    return h5py.phil if h5py is not None else nullcontext()


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
