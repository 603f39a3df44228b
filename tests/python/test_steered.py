"""Runs inside Python that are given orders, and that are stored."""

import unittest
import unittest.mock
from pathlib import Path

from inside import DEVICE, simulation  # first: it tells what is missing
from support import SOFT, InFolder, short

import h5py
import numpy
import pandas
import vkdose


class Orders(InFolder):
    SCHEDULE = {**SOFT, "settle.time_s": 0.05, "dose.rest_s": 0.02, "dose.ramp_s": 0.02, "stop.max_doses": 2}
    ORDERED = {**SCHEDULE, "dose.rotate_s": 1}
    TARGET = 4e-5  # kg

    def test_orders_give_the_bits_of_a_schedule_that_says_the_same(self):
        stage = [{"speed_rpm": 120, "until": 0.5}]  # the speed of mini
        to_mass = {"dose.mass_g": self.TARGET * 1e3, "dose.max_rotate_s": 1, "dose.stage": stage, "coil.speed_rpm": 60}
        with simulation("mini", changes={**self.SCHEDULE, **to_mass}) as sim:
            sim.run()
            expected, doses = sim.positions, sim.ended_doses
        self.assertEqual(doses[0]["stopped_by"], "mass")
        with simulation("mini", changes=self.ORDERED) as sim:
            while not sim.over:
                sim.advance()
                if sim.takes_orders and sim.dose_mass >= self.TARGET:
                    sim.stop_drive()
                elif sim.takes_orders and sim.dose_mass >= self.TARGET / 2:
                    sim.change_speed(rpm=60)
            numpy.testing.assert_array_equal(sim.positions, expected)
            self.assertEqual(sim.ended_doses[0]["stopped_by"], "order")
            for dose, other in zip(sim.ended_doses, doses):
                self.assertEqual((dose["mass_kg"], dose["end_time_s"]), (other["mass_kg"], other["end_time_s"]))

    def test_orders_at_the_wrong_time_and_speeds_that_are_too_high(self):
        with simulation("mini", changes=self.ORDERED) as sim:
            self.assertFalse(sim.takes_orders)
            with self.assertRaisesRegex(RuntimeError, "while it conveys"):
                sim.stop_drive()
            while not sim.takes_orders:
                sim.advance()
            self.assertEqual(sim.phase, "rotate")
            sim.change_speed(rpm=130)
            with self.assertRaises(vkdose.InputError) as caught:
                sim.change_speed(rpm=1e7)
            self.assertEqual([f.key for f in caught.exception.faults], ["coil.speed_rpm"])
            with self.assertRaises(ValueError):
                sim.change_speed(rpm=-1)


class Refills(InFolder):
    SPOON = [{"name": "spoon", "mass_g": 0.3}]

    def powder_comes(self, backend, device):
        step = {"time.step_s": 5e-5}  # a reading comes at 0.1 s
        timed = short(refill=[{**self.SPOON[0], "time_s": 0.1}], **step).run("timed", backend=backend, device=device)
        added = [event["mass_kg"] for event in timed.events() if event["event"] == "refill"]
        timed.wait()
        with vkdose.Simulation(short(refill=self.SPOON, **step), backend=backend, device=device or "") as sim:
            with self.assertRaisesRegex(ValueError, "fork"):
                sim.add_powder("fork")
            sim.advance(0.1)
            with sim.view() as powder:
                self.assertEqual(set(powder.status), {0, 3})
            waiting = (~sim.active).sum()
            sim.add_powder("spoon")
            with self.assertRaisesRegex(RuntimeError, "has been added"):
                sim.add_powder("spoon")
            sim.advance()
            self.assertAlmostEqual(sim.canister_mass + sim.throat_mass, 1.2e-3, delta=1e-5)  # with the 0.9 g of mini
            self.assertGreater(waiting, 20)
            self.assertEqual((~sim.active).sum(), 0)
            sim.run()
            with self.assertRaisesRegex(RuntimeError, "not now"):
                sim.add_powder("spoon")
            sim.store("told")
        for name in ("particles.csv", "timeseries.csv", "doses.csv"):
            self.assertEqual(Path("told", name).read_bytes(), Path("timed", name).read_bytes())
        refill = vkdose.Result("timed").summary["refills"][0]
        self.assertEqual((refill["name"], refill["particles"]), ("spoon", waiting))
        self.assertAlmostEqual(refill["time_s"], 0.1, delta=2e-4)
        self.assertEqual(added, [refill["mass_kg"]])

    def test_powder_comes_by_an_order_as_by_the_case(self):
        self.powder_comes("reference", None)

    def test_powder_comes_by_an_order_as_by_the_case_on_a_device(self):
        self.powder_comes("vulkan", DEVICE or None)


class Storing(InFolder):
    def the_program_goes_on(self, backend, device, times):
        case = short(field=[{"preset": "outlet"}], **{"sensors.energy": True})
        case.run("whole", backend=backend, device=device).wait()
        with vkdose.Simulation(case, backend=backend, device=device or "") as sim:
            for number, time in enumerate(times):
                sim.advance(time - sim.time)
                self.assertEqual(sim.store(f"stored{number}"), Path(f"stored{number}"))
            sim.run()
            sim.store("end")
        for number, time in enumerate(times):
            result = vkdose.resume(f"stored{number}", device=device).wait()
            self.same_files(result.folder)
        self.same_files("end")
        ended = vkdose.Result("end").summary
        self.assertEqual(ended["stop_reason"], vkdose.Result("whole").summary["stop_reason"])

    def same_files(self, folder):
        for name in ("particles.csv", "timeseries.csv", "doses.csv", "fields/outlet.csv", "case.toml"):
            with self.subTest(folder=folder, file=name):
                self.assertEqual(Path(folder, name).read_bytes(), Path("whole", name).read_bytes())

    def test_the_program_goes_on_with_the_same_bits(self):
        self.the_program_goes_on("reference", None, (0.03, 0.11, 0.16, 0.2))

    def test_the_program_goes_on_with_the_same_bits_on_a_device(self):
        self.the_program_goes_on("vulkan", DEVICE or None, (0.11,))

    def test_a_folder_in_use_is_refused(self):
        with simulation(short()) as sim:
            Path("mine").mkdir()
            Path("mine/letter").write_text("mine", encoding="utf-8")
            with self.assertRaisesRegex(vkdose.InputError, "holds no run"):
                sim.store("mine", force=True)
            sim.store("run")
            with self.assertRaisesRegex(vkdose.InputError, "unfinished run"):
                sim.store("run")
            sim.advance()
            sim.store("run", force=True)
            with self.assertRaisesRegex(vkdose.InputError, "is a file"):
                sim.store("mine/letter")
        self.assertEqual(len(pandas.read_csv("run/timeseries.csv")), 1)

    def test_it_is_stored_while_no_other_thread_is_in_h5py(self):
        there = []

        class Lock:
            def __enter__(self):
                there.append(Path("run/checkpoint.h5").exists())

            def __exit__(self, *error):
                there.append(Path("run/checkpoint.h5").exists())

        with simulation(short()) as sim, unittest.mock.patch.object(h5py._objects, "phil", Lock()):
            sim.store("run")
        self.assertEqual(there, [False, True])


if __name__ == "__main__":
    unittest.main()
