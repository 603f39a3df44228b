"""Runs inside Python."""

import ctypes
import os
import signal
import subprocess
import sys
import threading
import unittest
from pathlib import Path

from support import ROOT, SHORT, InFolder, examples, short  # first: it tells what is missing

import numpy
import pandas
import vkdose

try:
    import vkdose._core
except ImportError as lack:
    print(f"skipped: the module for runs inside Python was not built ({lack})")
    sys.exit(77)

DEVICE = os.environ.get("VKDOSE_TEST_DEVICE", "")


def simulation(case, **options):
    """On the reference, which is the same everywhere."""
    return vkdose.Simulation(case, backend="reference", **options)


def endless():
    return vkdose.Case("mini", {"stop.rule": "none", "stop.max_doses": 1000000})


class Bits(InFolder):
    def same_as_the_program(self, backend, device):
        mini = str(ROOT / "cases" / "mini.toml")
        vkdose.Case(mini).run("out", backend=backend, device=device).wait()
        with vkdose.Simulation(mini, backend=backend, device=device or "") as sim:
            sim.advance(0.1)
            sim.advance()
            doses = list(sim.doses())
            self.assertTrue(sim.over)
            self.assertEqual(sim.stop_reason, vkdose.Result("out").summary["stop_reason"])
            # Without the round trip pandas reads other numbers than those that were written.
            ends = pandas.read_csv("out/particles.csv", float_precision="round_trip")
            numpy.testing.assert_array_equal(sim.positions, ends[["x_m", "y_m", "z_m"]])
            numpy.testing.assert_array_equal(sim.velocities, ends[["vx_m_s", "vy_m_s", "vz_m_s"]])
            numpy.testing.assert_array_equal(sim.spins, ends[["wx_rad_s", "wy_rad_s", "wz_rad_s"]])
            numpy.testing.assert_array_equal(sim.radii, ends.radius_m)
            numpy.testing.assert_array_equal(sim.ids, ends.id)
            numpy.testing.assert_array_equal(sim.active, ends.status == "active")
        self.assertGreater((ends.status == "dosed").sum(), 10)
        ended = vkdose.Result("out").summary["doses"]
        self.assertEqual([dose["mass_kg"] for dose in doses], [dose["mass_kg"] for dose in ended])

    def test_the_reference_gives_the_bits_of_the_program(self):
        self.same_as_the_program("reference", None)

    def test_the_device_gives_the_bits_of_the_program(self):
        self.same_as_the_program("vulkan", DEVICE or None)

    def test_each_reading_is_a_line_of_the_time_series(self):
        changes = {"sensors.energy": True}
        short(**changes).run("out", backend="reference").wait()
        table = pandas.read_csv("out/timeseries.csv", float_precision="round_trip")
        with simulation(short(**changes)) as sim:
            samples = pandas.DataFrame(sim.samples())
        self.assertEqual(list(samples.columns), list(table.columns))
        for name in table.columns:
            with self.subTest(column=name):
                if name == "phase":
                    self.assertEqual(list(samples[name]), list(table[name]))
                else:
                    numpy.testing.assert_allclose(samples[name].astype(float), table[name], rtol=1e-5)


class Looking(InFolder):
    def test_a_simulation_tells_where_it_is(self):
        with simulation(short()) as sim:
            self.assertEqual((sim.time, sim.over, sim.stop_reason, sim.ended_doses), (0, False, None, []))
            self.assertEqual(sim.positions.shape, (111, 3))
            self.assertAlmostEqual(sim.canister_mass, 0.9e-3, delta=1e-5)
            sim.advance(seconds=0.05)
            self.assertEqual(sim.phase, "settle")
            self.assertAlmostEqual(sim.time, 0.05, places=6)
            first = sim.positions
            sim.advance(sim.sensor_interval)
            self.assertAlmostEqual(sim.time, 0.055, delta=1e-4)  # a whole number of steps
            self.assertEqual(sim.phase, "rotate")
            self.assertGreater(sim.torque, 0)
            self.assertGreater(numpy.abs(sim.positions - first).max(), 0)
            first[:] = 0  # a copy
            self.assertNotEqual(sim.positions[0, 1], 0)
            before = sim.dosed_mass
            dose = next(sim.doses())
            self.assertEqual((dose["dose"], dose["stopped_by"], dose["complete"]), (1, "time", True))
            self.assertAlmostEqual(sim.dose_mass, dose["mass_kg"], places=12)
            self.assertAlmostEqual(sim.dosed_mass, dose["cumulative_mass_kg"], places=12)
            self.assertGreaterEqual(sim.dosed_mass, before)
            total = sim.dosed_mass + sim.throat_mass + sim.canister_mass
            self.assertAlmostEqual(total, (sim.radii**3).sum() * 4 / 3 * numpy.pi * 1427, delta=1e-12)
            self.assertEqual([d["dose"] for d in sim.doses()], [2])
            self.assertIn("t = 0.29 s", repr(sim))
        with self.assertRaisesRegex(vkdose.VkdoseError, "closed"):
            sim.advance()

    def test_several_at_once_and_cases_of_every_kind(self):
        tables = {"base": str(ROOT / "cases" / "mini.toml"), "seed": 2}
        with simulation(tables) as one, simulation(vkdose.Case("mini"), changes={"seed": 2}) as other:
            one.advance(0.02)
            other.advance(0.01)
            other.advance(0.01)
            numpy.testing.assert_array_equal(one.positions, other.positions)

    def test_the_examples_of_the_page_run(self):
        blocks = examples(inside=True)
        self.assertGreaterEqual(len(blocks), 1)
        names = {"vkdose": vkdose}
        for block in blocks:
            exec(compile(block, "README.md", "exec"), names)
        self.assertGreater(names["highest"], 0)


class Errors(InFolder):
    def test_faults_of_a_case_are_objects(self):
        with self.assertRaises(vkdose.InputError) as caught:
            simulation(vkdose.Case("mini", {"contact.k": -1, "particles.density": -5}))
        self.assertEqual([f.key for f in caught.exception.faults], ["particles.density", "contact.k"])
        Path("bad.toml").write_text('base = "gone.toml"\n[coil]\nspeed_rmp = 60\n', encoding="utf-8")
        with self.assertRaises(vkdose.InputError) as caught:
            simulation("bad.toml")
        self.assertTrue(any(f.file.endswith("bad.toml") and f.line > 0 for f in caught.exception.faults))
        with self.assertRaisesRegex(vkdose.InputError, "did you mean mini"):
            simulation("mimi")

    def test_backends_and_devices_that_there_are_not(self):
        with self.assertRaisesRegex(vkdose.InputError, "vulkan or reference"):
            vkdose.Simulation("mini", backend="cuda")
        with self.assertRaises(vkdose.InputError):
            simulation("mini", device="0")
        with self.assertRaises(vkdose.DeviceError):
            vkdose.Simulation("mini", device="no such device")

    def test_after_an_error_the_state_can_be_read(self):
        with simulation(short(**{"contact.max_overlap_ratio": 0.001})) as sim:
            with self.assertRaisesRegex(vkdose.RunError, "overlap"):
                sim.run()
            self.assertTrue(sim.over)
            self.assertEqual(sim.stop_reason, "run_error")
            self.assertEqual(sim.positions.shape, (111, 3))
        with simulation("mini") as sim, self.assertRaises(ValueError):
            sim.advance(-1)

    def test_ctrl_c_lets_it_rest_and_it_goes_on(self):
        with simulation(endless()) as sim:
            refused = []

            def press():
                while not refused:  # this thread runs while the other one waits inside advance
                    try:
                        sim.time
                    except RuntimeError as refusal:
                        refused.append(refusal)
                os.kill(os.getpid(), signal.SIGINT)

            other = threading.Thread(target=press)
            with self.assertRaises(KeyboardInterrupt):
                other.start()
                sim.run()
            other.join()
            self.assertFalse(sim.over)
            sim.advance()
            self.assertEqual(sim.time, sim.sample["time_s"])
            with simulation(endless()) as undisturbed:
                undisturbed.advance(sim.time)
                numpy.testing.assert_array_equal(undisturbed.positions, sim.positions)

    def test_the_environment_stays_as_it_is(self):
        getenv = ctypes.CDLL(None).getenv
        getenv.restype = ctypes.c_char_p
        before = getenv(b"LP_NUM_THREADS")
        with vkdose.Simulation(short(), device=DEVICE) as sim:
            sim.advance()
        self.assertEqual(getenv(b"LP_NUM_THREADS"), before)

    def python(self, script, path):
        environment = dict(os.environ, PYTHONPATH=os.pathsep.join(path))
        return subprocess.run([sys.executable, "-B", "-c", script], env=environment, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True)

    def test_nothing_is_printed(self):
        script = f"import vkdose; vkdose.Simulation('mini', {SHORT!r}, backend='reference').run()"
        said = self.python(script, sys.path)
        self.assertEqual((said.returncode, said.stdout), (0, ""))

    def test_without_the_module_all_else_works(self):
        script = """if True:
            import vkdose
            assert vkdose.Case("mini").check().ok
            try:
                vkdose.Simulation("mini")
            except ImportError as lack:
                print(lack)
        """
        said = self.python(script, [str(ROOT / "host" / "python")])
        self.assertRegex(said.stdout, "pybind11-dev.*without it")


if __name__ == "__main__":
    unittest.main()
