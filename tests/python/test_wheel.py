"""The wheel: all that vkdose takes from its source tree, in a virtual environment of its own."""

import importlib.util
import os
import subprocess
import sys
import unittest
from pathlib import Path

from support import ROOT, InFolder  # first: it tells what is missing

BUILD = Path(os.environ["VKDOSE"]).parent

for name in ("pip", "setuptools", "wheel", "venv"):
    if importlib.util.find_spec(name) is None:
        print(f"skipped: no Python module {name} (tools/packages-python)")
        sys.exit(77)
if not list((BUILD / "python" / "vkdose").glob("_core*")):
    print("skipped: the module for runs inside Python was not built, and the wheel takes it")
    sys.exit(77)


def called(*command, **more):
    """What a command prints. It knows neither the program nor the package that are tested otherwise."""
    environment = {name: value for name, value in os.environ.items() if name not in ("VKDOSE", "PYTHONPATH")}
    environment.update(more, PIP_NO_INDEX="1", PIP_DISABLE_PIP_VERSION_CHECK="1")
    return subprocess.run(command, env=environment, check=True, stdout=subprocess.PIPE, text=True).stdout


class Wheel(InFolder):
    def test_what_the_wheel_installs_runs_by_itself(self):
        pip = (sys.executable, "-m", "pip", "--quiet")
        options = ("--no-build-isolation", "--no-deps", "--wheel-dir", "made")
        called(*pip, "wheel", *options, ROOT / "host" / "python", VKDOSE_BUILD=str(BUILD))
        (wheel,) = Path("made").iterdir()
        self.assertRegex(wheel.name, r"^vkdose-\d+\.\d+\.\d+-cp3\d+-cp3\d+-linux_\w+\.whl$")

        # pandas and the like are this machine's; a user's pip fetches them.
        called(sys.executable, "-m", "venv", "--system-site-packages", "--without-pip", "there")
        python = Path("there/bin/python").absolute()
        called(*pip, "--python", python, "install", "--no-deps", wheel)
        package = Path("there").resolve() / "lib" / f"python3.{sys.version_info.minor}" / "site-packages" / "vkdose"

        script = """
            import vkdose, vkdose._core
            print(vkdose.program(), vkdose._core.__file__, vkdose.Case("quickstart").check().file, sep="\\n")
            with vkdose.Simulation("mini", backend="reference") as sim:
                sim.advance()
                print(len(sim.positions))
        """
        lines = called(python, "-B", "-c", "\n".join(line[12:] for line in script.splitlines())).splitlines()
        self.assertEqual(lines[0], str(package / "installed/bin/vkdose"))
        self.assertEqual(Path(lines[1]).parent, package)
        self.assertEqual(Path(lines[2]).resolve(), package / "installed/share/vkdose/cases/quickstart.toml")
        self.assertEqual(lines[3], "111")
        self.assertIn("111", called("there/bin/vkdose", "check", "mini"))
        self.assertTrue((package / "installed/share/vkdose/cases/python/fields.py").is_file())


if __name__ == "__main__":
    unittest.main()
