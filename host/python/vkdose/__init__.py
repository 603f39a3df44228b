"""vkdose from Python: cases, runs, studies and their results.

    import vkdose

    with vkdose.Case("mini", {"coil.speed_rpm": 60}).run() as run:
        for dose in run.doses():
            print(dose["dose"], dose["mass_kg"])
        result = run.wait()
    result.timeseries.plot("time_s", "dosed_mass_kg")

Runs and studies are computed by the installed program, in processes of its own. ``Simulation`` is a run inside Python.
"""

from pkgutil import extend_path

__path__ = extend_path(__path__, __name__)  # in a source tree _core lies in the build folder

from .case import Case, Check
from .errors import (
    CaseWarning,
    DeviceError,
    Fault,
    InputError,
    Interrupted,
    OutputError,
    RunError,
    VkdoseError,
)
from .program import program, version
from .results import Frame, Result, SweepResult
from .run import Run, resume
from .simulation import Simulation, View
from .study import Study

__all__ = [
    "Case",
    "CaseWarning",
    "Check",
    "DeviceError",
    "Fault",
    "Frame",
    "InputError",
    "Interrupted",
    "OutputError",
    "Result",
    "Run",
    "RunError",
    "Simulation",
    "Study",
    "SweepResult",
    "View",
    "VkdoseError",
    "__version__",
    "program",
    "resume",
    "version",
]


def __getattr__(name: str) -> str:
    if name == "__version__":  # asked of the program, and only when somebody wants to know
        return version()
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
