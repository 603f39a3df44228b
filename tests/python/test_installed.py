"""The program and its package as `cmake --install` puts them: they work without the source tree."""

import gzip
import os
import subprocess
import sys
import unittest
from pathlib import Path

from support import InFolder, run, short  # first: it tells what is missing

BUILD = Path(os.environ["VKDOSE"]).parent


def installed(*components):
    """The folder into which these components are installed."""
    there = Path("there").resolve()
    for component in components:
        called("cmake", "--install", BUILD, "--prefix", there, "--component", component)
    return there


def called(*command):
    """What a command prints; its errors go where those of the test go."""
    return subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True).stdout


class Installed(InFolder):
    def test_what_is_installed_runs_by_itself(self):
        there = installed("vkdose", "python3-vkdose")
        share = there / "share"
        self.assertTrue((share / "vkdose/cases/quickstart.toml").is_file())
        self.assertTrue((share / "vkdose/cases/paper/coils.toml").is_file())
        self.assertTrue((share / "vkdose/cases/python/fields.py").is_file())
        page = gzip.decompress((share / "man/man1/vkdose-run.1.gz").read_bytes())
        self.assertIn(b".TH", page)
        for script in (
            "bash-completion/completions/vkdose",
            "zsh/vendor-completions/_vkdose",
            "fish/vendor_completions.d/vkdose.fish",
        ):
            self.assertIn("vkdose", (share / script).read_text(encoding="utf-8"))
        script = (
            "import vkdose; print(vkdose.program(), vkdose.__file__, vkdose.Case('quickstart').check().file, "
            "vkdose.Case('mini').check().figures['particles'], sep='\\n')\n"
            "import importlib.util; module = importlib.util.find_spec('vkdose._core'); print(module and module.origin)"
        )
        environment = {name: value for name, value in os.environ.items() if name not in ("VKDOSE", "PYTHONPATH")}
        environment |= {
            "PATH": f"{there / 'bin'}:{os.environ['PATH']}",
            "PYTHONPATH": str(there / "lib/python3/dist-packages"),
        }
        said = subprocess.run(
            [sys.executable, "-B", "-c", script], env=environment, check=True, stdout=subprocess.PIPE, text=True
        ).stdout.splitlines()
        self.assertEqual(said[0], str(there / "bin/vkdose"))
        self.assertTrue(said[1].startswith(str(there)))
        self.assertEqual(said[2], str(share / "vkdose/cases/quickstart.toml"))
        self.assertEqual(said[3], "111")
        for module in (BUILD / "python" / "vkdose").glob("_core*"):  # one, if it was built
            self.assertEqual(said[4], str(there / "lib/python3/dist-packages/vkdose" / module.name))

    def test_a_program_in_cpp_finds_the_library(self):
        there = installed("libvkdose-dev")
        examples = there / "share/doc/libvkdose-dev/examples"
        called("cmake", "-G", "Ninja", "-S", examples, "-B", "made", f"-DCMAKE_PREFIX_PATH={there}")
        called("cmake", "--build", "made")
        result = run(short()).wait()
        said = called("made/first_dose", "run/case.toml", "reference").splitlines()
        masses = [dose["mass_kg"] * 1e3 for dose in result.summary["doses"]]
        self.assertEqual(said, [f"dose {n}: {mass:.6g} g" for n, mass in enumerate(masses, start=1)])
        self.assertEqual(len(masses), 2)


if __name__ == "__main__":
    unittest.main()
