"""Cases and runs from Python."""

import os
import signal
import subprocess
import sys
import textwrap
import unittest
import unittest.mock
from pathlib import Path

from support import ROOT, SHORT, InFolder, run, short  # first: it tells what is missing

import h5py
import numpy
import vkdose
from vkdose.case import placed


def is_alive(process):
    """Whether the process with this number runs. One that has ended but has not been waited for does not."""
    try:
        state = Path(f"/proc/{process}/stat").read_text(encoding="utf-8")
    except OSError:
        return False
    return state.rpartition(")")[2].split()[0] != "Z"


class Cases(InFolder):
    def test_a_check_gives_figures_and_warnings(self):
        check = vkdose.Case("mini", {"coil.speed_rpm": 0}).check()
        self.assertTrue(check.ok)
        self.assertEqual(check.figures["particles"], 111)
        names = {warning.name: warning for warning in check.warnings}
        self.assertTrue(names["pinch"].accepted)
        self.assertFalse(any(w.accepted for w in check.warnings if w.key == "coil.speed_rpm"))
        self.assertEqual(Path(check.file), ROOT / "cases" / "mini.toml")

    def test_every_fault_of_a_case_is_an_object(self):
        bad = vkdose.Case("mini", {"contact.k": -1, "particles.density": -5})
        check = bad.check()
        self.assertFalse(check.ok)
        self.assertEqual([(f.key, f.value) for f in check.errors], [("particles.density", "-5"), ("contact.k", "-1")])
        with self.assertRaises(vkdose.InputError) as caught:
            bad.run("run")
        self.assertEqual(caught.exception.faults, check.errors)
        self.assertFalse(Path("run").exists())

    def test_a_fault_of_a_file_names_its_line(self):
        Path("bad.toml").write_text('base = "gone.toml"\n[coil]\nspeed_rmp = 60\n', encoding="utf-8")
        faults = vkdose.Case("bad.toml").check().errors
        self.assertTrue(any(f.file.endswith("bad.toml") and f.line > 0 for f in faults))

    def test_no_such_case(self):
        with self.assertRaisesRegex(vkdose.InputError, "did you mean mini"):
            vkdose.Case("mimi").check()

    def test_a_dict_is_a_case_with_or_without_a_base(self):
        figures = vkdose.Case({"base": "mini", "particles": {"mass_g": 0.5}}).check().figures
        self.assertEqual(figures, vkdose.Case("mini", {"particles.mass_g": 0.5}).check().figures)
        own = vkdose.Case({"boundaries": "none", "particles": {"mass_g": 1}}).check()
        self.assertIn("particles.density", [f.key for f in own.errors])
        Path("sub").mkdir()
        Path("sub/my.toml").write_text(f'base = "{ROOT}/cases/mini.toml"\n', encoding="utf-8")
        self.assertTrue(vkdose.Case({"base": "sub/my.toml", "seed": 2}).check().ok)

    def test_changes_of_every_kind(self):
        case = vkdose.Case("mini").with_(
            {"seed": 3, "sensors.energy": True, "gravity": [0, -1.62, 0], "field": [{"preset": "outlet"}]}
        )
        self.assertEqual(case.check().errors, ())


class Runs(InFolder):
    def test_doses_come_while_the_run_goes_on(self):
        with run(short()) as going:
            self.assertEqual(going.started()["case"], "mini")
            doses = list(going.doses())
            result = going.wait()
        self.assertEqual([dose["dose"] for dose in doses], [1, 2])
        self.assertEqual([dose["mass_kg"] for dose in doses], [dose["mass_kg"] for dose in result.summary["doses"]])
        numpy.testing.assert_allclose(result.doses.mass_kg, [dose["mass_kg"] for dose in doses], rtol=1e-8)
        self.assertEqual(result.folder, Path("run").resolve())

    def test_the_bits_are_those_of_the_command_line(self):
        run(short()).wait()
        settings = [part for key, value in SHORT.items() for part in ("--set", f"{key}={value}")]
        subprocess.run(
            [vkdose.program(), "run", "mini", *settings, "--backend", "reference", "--quiet", "--out", "plain"],
            check=True,
        )
        for file in ("timeseries.csv", "doses.csv", "particles.csv"):
            self.assertEqual(Path("run", file).read_bytes(), Path("plain", file).read_bytes())

    def test_a_run_that_is_left_can_be_resumed_to_the_same_bits(self):
        run(short(), "whole").wait()
        with run(short(), "left") as going:
            next(going.samples())
        self.assertFalse(going.running)
        with self.assertRaises(vkdose.Interrupted):
            going.wait()
        self.assertTrue(vkdose.Result("left").summary["interrupted"])
        vkdose.resume("left").wait()
        for file in ("timeseries.csv", "doses.csv", "particles.csv"):
            self.assertEqual(Path("left", file).read_bytes(), Path("whole", file).read_bytes())
        with self.assertRaises(vkdose.InputError):
            vkdose.resume("left")

    def test_a_run_ends_with_the_python_that_started_it(self):
        script = f"""
            import os, signal, sys
            sys.path.insert(0, {str(ROOT / "host" / "python")!r})
            import vkdose
            run = vkdose.Case("mini", {{"stop.max_doses": 1000000}}).run("run", backend="reference")
            next(run.samples())
            print(run._process._process.pid, flush=True)
            os.kill(os.getpid(), signal.SIGKILL)
        """
        parent = subprocess.run([sys.executable, "-c", textwrap.dedent(script)], stdout=subprocess.PIPE, text=True)
        self.assertEqual(parent.returncode, -signal.SIGKILL)
        child = int(parent.stdout)
        while is_alive(child):  # it goes; the runner's limit on the time of a test would tell if not
            pass
        self.assertTrue(vkdose.Result("run").summary["interrupted"])

    def test_errors_of_a_run_are_exceptions(self):
        with self.assertRaisesRegex(vkdose.RunError, "overlap"):
            run(short(**{"contact.max_overlap_ratio": 0.001})).wait()
        self.assertIn("overlap", vkdose.Result("run").summary["error"])
        with self.assertRaises(vkdose.InputError):
            run(short())  # the folder holds a run
        run(short(), "other").wait()
        with self.assertRaises(vkdose.DeviceError):
            short().run("third", device="no such device")

    def test_a_fork_leaves_a_run_to_the_process_that_started_it(self):
        with run(short(**{"stop.max_doses": 1000000}), "forked") as going:
            next(going.samples())
            reads, writes = os.pipe()
            child = os.fork()
            if child == 0:
                said = []
                try:
                    with going:
                        for call in (going.wait, lambda: next(going.samples()), lambda: going.running):
                            try:
                                call()
                            except vkdose.VkdoseError as refusal:
                                said.append(str(refusal))
                finally:
                    os.write(writes, "\n".join(said).encode())
                    os._exit(0)
            os.close(writes)
            self.assertEqual(os.waitpid(child, 0), (child, 0))
            with os.fdopen(reads) as pipe:
                said = pipe.read().splitlines()
            self.assertEqual(len(said), 3, said)
            for line in said:
                self.assertRegex(line, f"process {os.getpid()} has started")
            self.assertTrue(going.running)
            next(going.samples())

    def test_the_version_is_there_in_both_ways(self):
        self.assertRegex(vkdose.version(), r"^\d+\.\d+\.\d+$")
        self.assertEqual(vkdose.__version__, vkdose.version())
        with self.assertRaisesRegex(AttributeError, "has no attribute 'nothing'"):
            vkdose.nothing

    def test_no_program(self):
        os.environ["VKDOSE"], before = "/nowhere/vkdose", os.environ.get("VKDOSE")
        try:
            with self.assertRaises(FileNotFoundError):
                vkdose.version()
        finally:
            if before is None:
                del os.environ["VKDOSE"]
            else:
                os.environ["VKDOSE"] = before


class Results(InFolder):
    def test_tables_and_frames(self):
        result = run(short(**{"frames.interval_s": 0.1, "frames.contacts": True})).wait()
        self.assertEqual(len(result.timeseries), len(Path("run/timeseries.csv").read_text("utf-8").splitlines()) - 1)
        last = result.frames[-1]
        self.assertAlmostEqual(last.time, result.summary["simulated_time_s"])
        self.assertEqual(last.positions.shape, (111, 3))
        # The end state and the last frame are the same powder.
        ends = result.particles
        order = numpy.argsort(last.particles["id"])
        numpy.testing.assert_allclose(last.positions[order], ends[["x_m", "y_m", "z_m"]], atol=1e-7)
        contacts = last.contacts
        self.assertGreater(len(contacts["ends"]), 10)
        self.assertTrue(all(len(values) == len(contacts["ends"]) for values in contacts.values()))
        self.assertEqual(result.fields, [])

    def test_the_mass_rate(self):
        case = short(**{"dose.rotate_s": 0.5, "dose.rest_s": 0, "stop.max_doses": 1, "sensors.rate_window_s": 0.05})
        result = run(case).wait()
        rate = result.summary["analysis"]["rate"]
        self.assertEqual(rate["windows"], 10)
        self.assertAlmostEqual(rate["mean_kg_s"], result.doses.mass_kg[0] / 0.5, delta=1e-6 * rate["mean_kg_s"])

    def test_the_mass_of_each_turn(self):
        case = short(**{"dose.rotate_s": 0.5, "dose.rest_s": 0, "stop.max_doses": 1, "coil.speed_rpm": 480,
                        "time.step_s": 5.0002e-5})  # the turns do not end with a step
        result = run(case).wait()
        self.assertEqual(result.summary["analysis"]["cycle"]["is"], "turn of the drive")
        self.assertEqual(list(result.cycles.cycle), [1, 2, 3, 4])
        dosed = result.doses.mass_kg[0]
        # The dose is whole steps: it ends a part of a step after the fourth turn.
        self.assertAlmostEqual(result.cycles.mass_kg.sum(), dosed, delta=1e-4 * dosed)
        self.assertIsNone(run(short(**{"coil.speed_rpm": 0, "stop.max_doses": 1}), "still").wait().cycles)

    def test_arrays_of_a_frame_are_read_when_they_are_touched(self):
        frame = run(short(**{"frames.interval_s": 0.1})).wait().frames[0]
        read = []
        plain = h5py.Dataset.__getitem__

        def noted(self, *arguments):
            read.append(self.name)
            return plain(self, *arguments)

        with unittest.mock.patch.object(h5py.Dataset, "__getitem__", noted):
            particles = frame.particles
            self.assertIn("velocity", particles)
            self.assertEqual(read, [])
            self.assertIs(particles["radius"], particles["radius"])
            self.assertEqual(frame.positions.shape, (111, 3))
        self.assertEqual(read, ["/VTKHDF/PointData/radius", "/VTKHDF/Points"])
        with self.assertRaises(KeyError):
            particles["colour"]
        with self.assertRaisesRegex(vkdose.InputError, "contacts_000000.hdf"):
            frame.contacts

    def test_fields(self):
        fields = [{"preset": "outlet"}, {"preset": "mid-plane", "interval_s": 0.1}]
        result = run(short(field=fields)).wait()
        self.assertEqual(result.fields, ["mid-plane", "outlet"])
        self.assertLess(set(result.field("outlet").time_s), set(result.timeseries.time_s))  # which has ends of phases too
        grid = result.field("mid-plane").set_index(["time_s", "y_m", "z_m"])
        times, heights, lengths = (len(level) for level in grid.index.levels)
        self.assertEqual(len(grid), times * heights * lengths)
        # The plane is thin, so its mass is less than the canister's, but there is some.
        self.assertGreater(grid.density_kg_m3.max(), 100)
        with self.assertRaises(vkdose.InputError):
            result.field("none")

    def test_a_report_and_a_picture_of_a_notebook(self):
        result = run(short()).wait()
        self.assertIn("<html", result.report().read_text(encoding="utf-8")[:200])
        self.assertIn("srcdoc", result._repr_html_()[:100])

    def test_a_folder_without_a_run(self):
        with self.assertRaises(vkdose.InputError):
            vkdose.Result(".")


class Paths(InFolder):
    """Relative paths in a dict start from the current folder, though its file lies in another."""

    def setUp(self):
        super().setUp()
        for name in ("p.csv", "s.csv", "own.glsl", "b.toml"):
            Path(name).write_text("", encoding="utf-8")

    def at(self, name):
        return str(Path(name).resolve())

    def test_of_a_case(self):
        case = {"contact": {"law": "own.glsl"}, "particles": {"size": {"sieves": "s.csv"}}, "base": "b.toml"}
        self.assertEqual(
            placed(case),
            {
                "contact": {"law": self.at("own.glsl")},
                "particles": {"size": {"sieves": self.at("s.csv")}},
                "base": self.at("b.toml"),
            },
        )
        words = {"contact": {"law": "luding"}, "base": "mini", "coil": {"hand": "b.toml"}}
        self.assertEqual(placed(words), words)

    def test_of_a_study(self):
        study = {
            "set": {"particles.list": "p.csv"},
            "axis": [
                {"key": "particles.size.sieves", "values": ["s.csv", "none.csv"]},
                {"keys": ["contact.law", "seed"], "values": [["own.glsl", 1], ("luding", 2), ["own.glsl"]]},
                {"key": "name", "values": ["p.csv"]},
            ],
        }
        self.assertEqual(
            placed(study),
            {
                "set": {"particles.list": self.at("p.csv")},
                "axis": [
                    {"key": "particles.size.sieves", "values": [self.at("s.csv"), "none.csv"]},
                    {"keys": ["contact.law", "seed"], "values": [[self.at("own.glsl"), 1], ["luding", 2], ["own.glsl"]]},
                    {"key": "name", "values": ["p.csv"]},
                ],
            },
        )

    def test_a_sweep_over_lists_of_particles(self):
        Path("p.csv").write_text("x,y,z,r\n0,0.002,0.005,0.001\n0,0.002,0.008,0.001\n", encoding="utf-8")
        axis = {"key": "particles.list", "values": ["p.csv"]}
        swept = vkdose.Study({"base": "mini", "set": dict(SHORT), "axis": [axis]}).sweep("swept", backend="reference")
        self.assertEqual(list(swept.members.particles), [2])

    def test_the_base_of_a_target_may_be_the_name_of_a_case(self):
        target = {"figure": "mass_per_dose_g", "value": 1, "uncertainty": 1, "base": "mini"}
        study = vkdose.Study({"base": "mini", "calibrate": {"method": "surrogate", "target": [target, dict(target)]}})
        with study._file() as file:
            written = Path(file).read_text(encoding="utf-8")
        self.assertEqual(written.count(str(ROOT / "cases" / "mini.toml")), 3)

    def test_a_name_with_a_slash(self):
        self.assertTrue(vkdose.Case({"base": "mini", "name": "a/b", "seed": 2}).check())
        self.assertTrue(vkdose.Case({"name": "a/b", "boundaries": "none"}).check().errors)
        study = vkdose.Study({"name": "/kc/mu", "base": "mini"})
        self.assertEqual(study._name(), "-kc-mu")
        with study._file() as file:
            self.assertTrue(Path(file).is_file())


class Studies(InFolder):
    def test_a_case_with_draws_of_a_powder(self):
        Path("powder.toml").write_text(
            'title = "Made up"\ndraws = "draws.csv"\n[particles]\ndensity = 1427.0\n[particles.size]\n'
            'distribution = "uniform"\nradius_min_mm = 0.9\nradius_max_mm = 1.3\n[contact]\nk = 2000.0\n'
            "k1_over_k = 0.2\nkc_over_k = 0.3\nplasticity_depth = 0.05\ndamping = 0.02\nfriction = 0.5\n"
        )
        Path("draws.csv").write_text("contact.friction\n0.4\n0.5\n0.6\n")
        case = vkdose.Case("mini", SHORT)
        swept = case.draws("powder.toml", 2, "drawn", backend="reference")
        self.assertEqual(list(swept.members["contact.friction"]), [0.4, 0.5])
        torque = swept.figures["coil.largest_torque_Nm"]
        told = swept.prediction.loc["coil.largest_torque_Nm"]
        self.assertEqual(told["draws"], 2)
        self.assertAlmostEqual(told["mean"], torque.mean())
        self.assertLess(told["low"], torque.min())
        with self.assertRaisesRegex(vkdose.InputError, "has 3 rows"):
            case.draws("powder.toml", 4, "more")
        swept = vkdose.Study({"base": "mini", "set": dict(SHORT)}).sweep("plain", backend="reference")
        self.assertIsNone(swept.prediction)

    def test_a_sweep_of_a_dict(self):
        study = vkdose.Study(
            {"base": "mini", "set": dict(SHORT), "seeds": 2, "axis": [{"key": "coil.speed_rpm", "values": [60, 90]}]}
        )
        swept = study.sweep("swept", backend="reference")
        self.assertEqual(len(swept.members), 4)
        self.assertEqual(sorted(set(swept.members["coil.speed_rpm"])), [60, 90])
        self.assertEqual(len(swept.doses), 8)
        self.assertEqual(len(swept.member(0).doses), 2)
        self.assertIsNone(swept.calibrated)
        again = study.sweep("swept", backend="reference")  # all have ended
        self.assertTrue(again.members.equals(swept.members))

    def test_a_wrong_study_is_refused(self):
        with self.assertRaisesRegex(vkdose.InputError, "coil.sped_rpm"):
            vkdose.Study({"base": "mini", "axis": [{"key": "coil.sped_rpm", "values": [60, 90]}]}).sweep()


if __name__ == "__main__":
    unittest.main()
