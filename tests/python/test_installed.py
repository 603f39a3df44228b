"""The program and its package as `cmake --install` puts them: they work without the source tree."""

import gzip
import os
import subprocess
import sys
import unittest
from pathlib import Path

from support import InFolder

BUILD = Path(os.environ["VKDOSE"]).parent


class Installed(InFolder):
    def test_what_is_installed_runs_by_itself(self):
        there = Path("there").resolve()
        for component in ("vkdose", "python3-vkdose"):
            subprocess.run(
                ["cmake", "--install", BUILD, "--prefix", there, "--component", component],
                check=True,
                stdout=subprocess.DEVNULL,
            )
        share = there / "share"
        self.assertTrue((share / "vkdose/cases/quickstart.toml").is_file())
        self.assertTrue((share / "vkdose/cases/paper/coils.toml").is_file())
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


if __name__ == "__main__":
    unittest.main()
