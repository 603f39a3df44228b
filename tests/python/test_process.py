"""What the process around brings: a decimal comma, a disk that fails."""

import locale
import os
import subprocess
import sys
import unittest
from pathlib import Path

from inside import simulation  # first: it tells what is missing
from support import InFolder, run, short

import numpy
import vkdose

FAULTS = Path(os.environ["VKDOSE"]).parent / "tests" / "layer" / "libvkdose_io_faults.so"
READ = """import sys
import vkdose
result = vkdose.Result("run")
{}
"""


class Locale(InFolder):
    def comma(self):
        """Sets a decimal comma. The locale is made here, because a system need not have one."""
        Path("comma").write_text('LC_NUMERIC\ndecimal_point ","\nthousands_sep "."\ngrouping 3;3\nEND LC_NUMERIC\n',
                                 encoding="ascii")
        Path("characters").write_text("<code_set_name> NONE\n<mb_cur_min> 1\n<mb_cur_max> 1\nCHARMAP\nEND CHARMAP\n",
                                      encoding="ascii")
        # It complains of every other category that there is not, and writes this one.
        subprocess.run(["localedef", "-c", "-i", "./comma", "-f", "./characters", "./de_DE"], check=False,
                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.environ["LOCPATH"] = os.getcwd()
        self.addCleanup(os.environ.pop, "LOCPATH")
        locale.setlocale(locale.LC_NUMERIC, "de_DE")
        self.addCleanup(locale.setlocale, locale.LC_NUMERIC, "C")
        self.assertEqual(locale.localeconv()["decimal_point"], ",")

    def states(self):
        with simulation(short(**{"particles.size.radius_min_mm": 0.95})) as sim:
            sim.advance(0.02)
            return sim.time, numpy.array(sim.positions), numpy.array(sim.velocities), numpy.array(sim.radii)

    def test_a_decimal_comma_changes_no_bit(self):
        plain = self.states()
        self.comma()
        self.assertEqual(locale.format_string("%.1f", 0.5), "0,5")
        for here, there in zip(self.states(), plain):
            numpy.testing.assert_array_equal(here, there)


class Disk(InFolder):
    def test_what_cannot_be_read_to_its_end_is_an_error(self):
        run(short(**{"frames.interval_s": 0.05})).wait()
        self.assertTrue(FAULTS.is_file())
        for file, reads in {
            "summary.json": "result.summary",
            "timeseries.csv": "result.timeseries",
            "doses.csv": "result.doses",
            "frames.csv": "list(result.frames)",
            "particles_000001.hdf": "list(result.frames)[1].positions",
        }.items():
            for fault in ("", "read:EIO", "read:EIO:1", "read:short:100,read:EIO:3"):
                Path("told").unlink(missing_ok=True)
                preload = {"LD_PRELOAD": str(FAULTS), "VKDOSE_IO_FILE": file, "VKDOSE_IO_FAULT": fault,
                           "VKDOSE_IO_TOLD": "told"}
                done = subprocess.run([sys.executable, "-c", READ.format(reads)], stderr=subprocess.PIPE, text=True,
                                      check=False,
                                      env={**os.environ, **preload, "PYTHONPATH": os.pathsep.join(sys.path)})
                with self.subTest(file=file, fault=fault, said=done.stderr):
                    struck = Path("told").exists() and "EIO" in Path("told").read_text(encoding="ascii")
                    if fault in ("", "read:EIO"):
                        self.assertEqual(struck, fault != "")
                    self.assertEqual(done.returncode != 0, struck)

    def test_a_case_that_cannot_be_read_is_an_input_error(self):
        Path("mine.toml").write_text('base = "base.toml"\n', encoding="ascii")
        os.mkdir("base.toml")
        with self.assertRaisesRegex(vkdose.InputError, "base.toml"):
            vkdose.Simulation("mine.toml", backend="reference")


if __name__ == "__main__":
    unittest.main()
