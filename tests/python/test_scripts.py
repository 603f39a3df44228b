"""The scripts of cases/python run from their files alone, and stay short enough to be shown."""

import contextlib
import io
import runpy
import unittest
from pathlib import Path

from support import ROOT, InFolder


class Scripts(InFolder):
    def said_by(self, name):
        file = ROOT / "cases" / "python" / f"{name}.py"
        self.assertLessEqual(len(file.read_text(encoding="utf-8").splitlines()), 25)
        said = io.StringIO()
        with contextlib.redirect_stdout(said):
            runpy.run_path(str(file), run_name="__main__")
        return said.getvalue()

    def test_first_dose(self):
        self.assertRegex(self.said_by("first_dose"), r"dose 1: 0\.\d+ g of 0\.216 g")

    def test_dose_to_mass(self):
        try:
            import vkdose._core  # noqa: F401
        except ImportError:
            self.skipTest("the module for runs inside Python was not built")
        self.assertEqual(self.said_by("dose_to_mass").count("g of 0.1 g, stopped by order"), 3)

    def test_sweep_and_plot(self):
        self.assertEqual(self.said_by("sweep_and_plot").count("0.000"), 4)
        self.assertTrue(Path("out/sweep-and-plot.png").read_bytes().startswith(b"\x89PNG"))

    def test_calibrate_scipy(self):
        self.assertRegex(self.said_by("calibrate_scipy"), r"nearest with friction 0\.\d+")

    def test_fields(self):
        self.assertIn("change of density", self.said_by("fields"))

    def test_every_script_has_its_test(self):
        scripts = {f"test_{file.stem}" for file in (ROOT / "cases" / "python").glob("*.py")}
        self.assertLessEqual(scripts, set(dir(self)))


if __name__ == "__main__":
    unittest.main()
