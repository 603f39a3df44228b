"""Puts what CMake builds into the wheel. pyproject.toml says the rest.

It is built in build/wheel of the source tree. Where program and module have been built already, VKDOSE_BUILD in the
environment may name that folder by its whole path.
"""

import os
import re
import shutil
import subprocess
import sys
import sysconfig
from pathlib import Path

from setuptools import Distribution, setup
from setuptools.command.build_py import build_py

SOURCE = Path(__file__).resolve().parents[2]
MADE = SOURCE / "build" / "wheel"
MODULE = "_core" + sysconfig.get_config_var("EXT_SUFFIX")

project = SOURCE / "CMakeLists.txt"
if not project.is_file():
    sys.exit(f"{project} is not there: the wheel is made inside the source tree of vkdose")
version = re.search(r"project\(vkdose VERSION (\S+)", project.read_text(encoding="utf-8"))[1]


def built() -> Path:
    """The folder where program and module have been built."""
    named = os.environ.get("VKDOSE_BUILD")
    folder = Path(named).resolve() if named else MADE
    if not named:
        options = ["-DCMAKE_BUILD_TYPE=Release", "-DVKDOSE_TESTS=OFF", f"-DPython_EXECUTABLE={sys.executable}"]
        subprocess.run(["cmake", "-G", "Ninja", "-S", SOURCE, "-B", folder, *options], check=True)
        subprocess.run(["cmake", "--build", folder], check=True)
    if not (folder / "python" / "vkdose" / MODULE).is_file():
        sys.exit(f"{folder} holds no {MODULE}: it takes pybind11-dev and python3-dev, and {sys.executable}")
    return folder


class WithProgram(build_py):
    def run(self) -> None:
        super().run()
        package, folder = Path(self.build_lib, "vkdose").resolve(), built()
        for component, place in (("vkdose", package / "installed"), ("module", package)):
            command = ["cmake", "--install", folder, "--prefix", place, "--component", component, "--strip"]
            subprocess.run(command, check=True, stdout=subprocess.DEVNULL)


class ForOneMachine(Distribution):
    """The wheel is for one Python on one kind of machine."""

    def has_ext_modules(self) -> bool:
        return True


shutil.rmtree(MADE / "setuptools", ignore_errors=True)  # what lies there would go into the wheel
MADE.mkdir(parents=True, exist_ok=True)
setup(
    version=version,
    distclass=ForOneMachine,
    cmdclass={"build_py": WithProgram},
    # Nothing is left in this folder.
    options={"build": {"build_base": str(MADE / "setuptools")}, "egg_info": {"egg_base": str(MADE)}},
)
