"""Runs inside Python."""

import ctypes
import gc
import os
import signal
import subprocess
import sys
import threading
import unittest
import unittest.mock
from pathlib import Path

from inside import DEVICE, simulation  # first: it tells what is missing
from support import ROOT, SHORT, InFolder, run_examples, short

import numpy
import pandas
import vkdose


def endless():
    return vkdose.Case("mini", {"stop.rule": "none", "stop.max_doses": 1000000})


class Bits(InFolder):
    def same_as_the_program(self, backend, device):
        mini = str(ROOT / "cases" / "mini.toml")
        changes = {**SHORT, "coil.speed_rpm": 360}  # a quick coil doses much in a short time
        vkdose.Case(mini, changes).run("out", backend=backend, device=device).wait()
        with vkdose.Simulation(mini, changes, backend=backend, device=device or "") as sim:
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
            samples = pandas.DataFrame(
                {**{key: value for key, value in sample.items() if key != "bodies"},
                 **{f"coil.{key}": value for key, value in sample["bodies"]["coil"].items()}}
                for sample in sim.samples())
        self.assertEqual(list(samples.columns), list(table.columns))
        for name in table.columns:
            with self.subTest(column=name):
                if name == "phase":
                    self.assertEqual(list(samples[name]), list(table[name]))
                else:
                    numpy.testing.assert_allclose(samples[name].astype(float), table[name], rtol=1e-5)


class Looking(InFolder):
    def test_a_simulation_tells_where_it_is(self):
        with simulation(short(**{"time.step_s": 5e-5})) as sim:  # all times are whole numbers of these steps
            self.assertEqual((sim.time, sim.over, sim.stop_reason, sim.ended_doses), (0, False, None, []))
            self.assertEqual(sim.positions.shape, (111, 3))
            self.assertAlmostEqual(sim.canister_mass, 0.9e-3, delta=1e-5)
            sim.advance(seconds=0.05)
            self.assertEqual(sim.phase, "settle")
            self.assertAlmostEqual(sim.time, 0.05, places=6)
            first = sim.positions
            sim.advance(sim.sensor_interval)
            self.assertAlmostEqual(sim.time, 0.055, places=6)
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

    def frames_are_those_of_the_program(self, backend, device):
        case = short(**{"frames.interval_s": 0.1, "frames.contacts": True})
        case.run("out", backend=backend, device=device).wait()
        frames = vkdose.Result("out").frames
        self.assertGreater(len(frames[1].contacts["overlap"]), 50)
        with vkdose.Simulation(case, backend=backend, device=device or "") as sim:
            for frame in frames[1:3]:
                sim.advance(frame.time - sim.time)
                for now, stored in ((sim.particles, frame.particles), (sim.contacts, frame.contacts)):
                    self.assertEqual(set(now), set(stored))
                    for name in stored:
                        with self.subTest(time=frame.time, array=name):
                            self.assertEqual(now[name].dtype, stored[name].dtype)
                            numpy.testing.assert_array_equal(now[name], stored[name])

    def test_particles_and_contacts_are_those_of_a_frame(self):
        self.frames_are_those_of_the_program("reference", None)

    def test_particles_and_contacts_are_those_of_a_frame_on_a_device(self):
        self.frames_are_those_of_the_program("vulkan", DEVICE or None)

    def test_contacts_balance(self):
        with simulation(short()) as sim:
            self.assertEqual(numpy.abs(sim.contacts["force"]).max(initial=0), 0)  # no step has been made
            sim.advance(0.05)
            contacts, particles = sim.contacts, sim.particles
            pairs = contacts["kind"] == 0
            self.assertEqual(contacts["ends"].shape, (len(pairs), 2, 3))
            self.assertGreater(pairs.sum(), 20)
            self.assertGreater((contacts["kind"] == 1).sum(), 5)
            # Forces of a pair are opposite, so that the forces of walls and coil are the sum over the particles.
            others = contacts["force"][~pairs].sum(axis=0)
            weight = (sim.radii**3).sum() * 4 / 3 * numpy.pi * 1427 * 9.81
            numpy.testing.assert_allclose(particles["force"].sum(axis=0), others, atol=1e-5 * weight)
            self.assertGreater(others[1], 0.5 * weight)
            between = contacts["ends"][pairs]
            distance = numpy.linalg.norm(between[:, 0] - between[:, 1], axis=1)
            reach = sim.radii[contacts["particle"][pairs]] + sim.radii[contacts["other"][pairs]]
            numpy.testing.assert_allclose(reach - distance, contacts["overlap"][pairs], atol=1e-8)
            contacts["force"][:] = 0  # a copy
            self.assertGreater(numpy.abs(sim.contacts["force"]).max(), 0)

    def test_a_view_shows_the_state_without_a_copy_while_its_with_lasts(self):
        sim = simulation(short())
        self.addCleanup(sim.close)
        sim.advance(0.1)
        with sim.view() as view, sim.view() as other:
            for name in ("positions", "velocities", "spins", "radii", "active"):
                numpy.testing.assert_array_equal(getattr(view, name), getattr(sim, name))
            self.assertTrue(numpy.shares_memory(view.positions, other.positions))
            self.assertFalse(numpy.shares_memory(view.positions, sim.positions))
            kept = view.positions
            before = sim.positions
            for forbidden in (lambda: kept.__setitem__(0, 0), lambda: kept.setflags(write=True)):
                with self.assertRaises(ValueError):
                    forbidden()
            sim.advance()
            with self.assertRaisesRegex(RuntimeError, "gone on"):
                view.positions
            with sim.view() as later:
                self.assertGreater(numpy.abs(later.positions - kept).max(), 0)
        with self.assertRaisesRegex(RuntimeError, "with sim.view"):
            later.radii
        with self.assertRaisesRegex(RuntimeError, "with sim.view"):
            sim.view().radii
        with sim.view() as view:
            last = view.positions[:5]
            sim.close()
            with self.assertRaisesRegex(vkdose.VkdoseError, "closed"):
                view.positions
        del sim, view, other, later
        gc.collect()
        # Memory that had been freed would be used for these.
        fill = [numpy.full_like(before, 7) for _ in range(100)]
        numpy.testing.assert_array_equal(kept, before)
        self.assertEqual(last.shape, (5, 3))
        self.assertEqual(len(fill), 100)

    def test_fields_of_now_have_the_columns_of_the_files(self):
        case = short(field=[{"preset": "outlet"}, {"preset": "mid-plane", "interval_s": 0.1}])
        case.run("out", backend="reference").wait()
        with simulation(case) as sim:
            self.assertEqual(sim.fields, ["outlet", "mid-plane"])
            sim.advance(0.2)
            stored = vkdose.Result("out").field("mid-plane")
            stored = stored[numpy.isclose(stored.time_s, sim.time, rtol=0, atol=1e-4)].reset_index(drop=True)
            now = sim.field("mid-plane")
            self.assertEqual(list(now.columns), list(stored.columns))
            self.assertGreater(len(now), 100)
            self.assertEqual(list(now.phase), list(stored.phase))
            for name in set(now.columns) - {"phase"}:
                with self.subTest(column=name):
                    scale = numpy.nanmax(numpy.abs(stored[name]))
                    numpy.testing.assert_allclose(now[name], stored[name], rtol=1e-5, atol=1e-7 * scale)
            with self.assertRaisesRegex(vkdose.InputError, "outlet, mid-plane"):
                sim.field("throat")

    def looking_changes_nothing(self, backend, device):
        with vkdose.Simulation(short(), backend=backend, device=device) as undisturbed:
            undisturbed.run()
            expected = undisturbed.positions
        case = short(field=[{"preset": "outlet", "interval_s": 0.1}])
        with vkdose.Simulation(case, backend=backend, device=device) as sim:
            while not sim.over:
                sim.advance(0.02)
                self.assertGreater(len(sim.field("outlet")), 0)
                self.assertGreater(len(sim.contacts["kind"]), 0)
            numpy.testing.assert_array_equal(sim.positions, expected)

    def test_looking_changes_no_bit(self):
        self.looking_changes_nothing("reference", "")

    def test_looking_changes_no_bit_on_a_device(self):
        self.looking_changes_nothing("vulkan", DEVICE)

    def test_several_at_once_and_cases_of_every_kind(self):
        tables = {"base": str(ROOT / "cases" / "mini.toml"), "seed": 2}
        with simulation(tables) as one, simulation(vkdose.Case("mini"), changes={"seed": 2}) as other:
            one.advance(0.02)
            other.advance(0.01)
            other.advance(0.01)
            numpy.testing.assert_array_equal(one.positions, other.positions)

    def test_the_examples_of_the_page_run(self):
        blocks, names = run_examples(inside=True)
        self.assertGreaterEqual(blocks, 1)
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
        # From 3.12 on Python warns of every fork beside other threads.
        quiet = ["-W", "ignore:This process:DeprecationWarning"]
        return subprocess.run([sys.executable, "-B", *quiet, "-c", script], env=environment, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True)

    def forked(self, device):
        """What a child says that is forked off from a process with an open simulation, and how both end."""
        options = 'backend="reference"' if device is None else f"device={device!r}"
        script = f"""if True:
            import os, sys, vkdose
            case = {SHORT!r}
            sim = vkdose.Simulation("mini", case, {options})
            sim.advance()
            positions = sim.positions
            if os.fork() == 0:
                for call in (sim.advance, sim.run, lambda: sim.time, lambda: sim.positions, lambda: sim.store("x")):
                    try:
                        call()
                        print("no refusal")
                    except vkdose.VkdoseError as refusal:
                        print(refusal)
                sim.close()
                with vkdose.Simulation("mini", case, {options}) as own:
                    own.advance()
                    print("the same", (own.positions == positions).all())
                kept = vkdose.Simulation("mini", case, {options})  # open at the end
                sys.exit(0)
            print("child", os.waitstatus_to_exitcode(os.wait()[1]))
            sim.advance()
            print("parent", sim.time > 0)
        """
        said = self.python(script, sys.path)
        lines = said.stdout.splitlines()
        self.assertEqual(said.returncode, 0, said.stdout)
        self.assertEqual(len(lines), 8, said.stdout)
        for line in lines[:5]:
            self.assertRegex(line, r"opened in process \d+.*forked off")
        self.assertEqual(lines[5:], ["the same True", "child 0", "parent True"])

    def test_a_fork_cannot_use_an_open_simulation_and_ends_well(self):
        self.forked(None)

    def test_a_fork_cannot_use_an_open_simulation_and_ends_well_on_a_device(self):
        self.forked(DEVICE)

    def test_a_child_that_never_looks_at_an_open_simulation_ends_well(self):
        script = f"""if True:
            import os, sys, vkdose
            sim = vkdose.Simulation("mini", {SHORT!r}, backend="reference")
            if os.fork() == 0:
                sys.exit(3)
            print("child", os.waitstatus_to_exitcode(os.wait()[1]))
        """
        said = self.python(script, sys.path)
        self.assertEqual((said.returncode, said.stdout), (0, "child 3\n"))

    def test_python_ends_well_while_a_daemon_thread_runs(self):
        script = """if True:
            import threading, vkdose
            sim = vkdose.Simulation("mini", {"stop.rule": "none", "stop.max_doses": 1000000}, backend="reference")
            def work():
                sim.run()
                print("went on")
            threading.excepthook = lambda told: print("refused:", told.exc_value, flush=True)
            threading.Thread(target=work, daemon=True).start()
            while True:  # until the other thread waits inside run
                try:
                    sim.time
                except RuntimeError:
                    break
        """
        for _ in range(5):
            said = self.python(script, sys.path)
            self.assertEqual(said.returncode, 0, said.stdout)
            # The thread may be stopped within the line.
            self.assertTrue("refused: Python is ending, so no simulation goes on\n".startswith(said.stdout), said.stdout)

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
