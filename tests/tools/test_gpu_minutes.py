"""tools/gpu-minutes and tools/queue: each piece by itself with made-up programs, then a dry run of the smallest cases on
the device of the tests, twice, and in a folder that was packed to be carried."""

import json
import os
import shutil
import stat
import subprocess
import sys
import tarfile
import tempfile
import unittest

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path.insert(0, os.path.join(ROOT, "tools", "gpu-parts"))

import memory as memories  # noqa: E402
import pack  # noqa: E402
import parts  # noqa: E402
import place as places  # noqa: E402
import queue_file  # noqa: E402
import studies  # noqa: E402
from run import Deadline, run  # noqa: E402

PROGRAM = os.environ["VKDOSE"]


class InFolder(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, self.folder)

    def write(self, name, text, program=False):
        path = os.path.join(self.folder, name)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path, "w", encoding="utf-8") as f:
            f.write(text)
        if program:
            os.chmod(path, os.stat(path).st_mode | stat.S_IXUSR)
        return path

    def session(self, script, seconds=60.0, now=None):
        """A session whose program is a shell script."""
        program = self.write("vkdose", "#!/bin/sh\n" + script, program=True)
        out = os.path.join(self.folder, "out")
        os.makedirs(out, exist_ok=True)
        memory = memories.Memory(out)
        memory.open_card("card", "hash")
        deadline = Deadline(seconds, now) if now else Deadline(seconds)
        return parts.Session(places.Place(ROOT, program), out, memory, deadline, None, True)


class Runs(InFolder):
    def test_a_program_that_overruns_is_ended_with_all_that_it_started(self):
        mark = os.path.join(self.folder, "child")
        words = ["sh", "-c", f"trap '' INT; sh -c 'echo $$ > {mark}; exec sleep 600' & wait; sleep 600"]
        ended = run(words, 0.5, os.path.join(self.folder, "log"), dict(os.environ), self.folder, grace=0.1)
        self.assertTrue(ended.overran)
        self.assertEqual(ended.words(), "overran its time and was ended")
        if os.path.exists(mark):
            with open(mark, encoding="utf-8") as f:
                state = f"/proc/{f.read().strip()}/stat"
            if os.path.exists(state):  # a zombie is over too
                with open(state, encoding="utf-8") as f:
                    self.assertEqual(f.read().rsplit(")", 1)[1].split()[0], "Z")

    def test_what_a_program_says_and_how_it_ends_is_told(self):
        log = os.path.join(self.folder, "logs", "log")
        ended = run(["sh", "-c", "echo said; echo more >&2; exit 3"], 60, log, dict(os.environ), self.folder)
        self.assertEqual((ended.code, ended.words()), (3, "exit code 3"))
        self.assertEqual(ended.text, "said\nmore\n")
        self.assertIn("signal 11", run(["sh", "-c", "kill -SEGV $$"], 60, log, dict(os.environ), self.folder).words())
        self.assertIn("could not be started", run(["/nowhere"], 60, log, dict(os.environ), self.folder).words())

    def test_a_part_of_the_time_is_no_longer_than_what_is_left(self):
        now = [100.0]
        whole = Deadline(50, lambda: now[0])
        self.assertEqual(whole.part(20).left(), 20)
        now[0] = 140.0
        self.assertEqual(whole.part(20).left(), 10)
        now[0] = 160.0
        self.assertEqual(whole.part(20).left(), 0)


class Parts(InFolder):
    def test_known_answers_are_met_once_and_those_that_fail_are_tried_again(self):
        script = """
case "$*" in
*--list*) echo 'a/good  x'; echo 'a/bad  x'; echo 'a/dead  x';;
*a/dead*) kill -SEGV $$;;
*) shift; while [ "$1" != --only ]; do shift; done; case=$2; while [ "$1" != --out ]; do shift; done; mkdir -p "$2"
   [ $case = a/good ] && passes=true || passes=false
   echo "{\\"results\\": [{\\"case\\": \\"$case\\", \\"kind\\": \\"known answer\\", \\"quantity\\": \\"q\\", \\"got\\": 1,
          \\"expected\\": 2, \\"passes\\": $passes}]}" > "$2/verify.json"; echo "$case" >> "%s/calls";;
esac
""" % self.folder
        s = self.session(script)
        parts.verify(s, 60)
        met = s.memory.card["verify"]
        self.assertEqual((met["a/good"]["met"], met["a/good"]["failed"]), (1, 0))
        self.assertEqual((met["a/bad"]["met"], met["a/bad"]["failed"]), (0, 1))
        self.assertIn("signal 11", met["a/dead"]["why"])
        parts.verify(self.session(script), 60)  # as a second call
        with open(os.path.join(self.folder, "calls"), encoding="utf-8") as f:
            self.assertEqual(sorted(f.read().split()), ["a/bad", "a/bad", "a/good"])

    def test_no_program_begins_after_the_time(self):
        now = [0.0]
        s = self.session("true", now=lambda: now[0])
        begun = []
        for name, ended in s.side_by_side("abcdefgh" * 8, lambda name: ["sh", "-c", "exit 3"], s.deadline.part(10)):
            begun.append((name, ended.code))
            now[0] = 11.0
        self.assertLess(len(begun), 64)
        self.assertEqual({code for _, code in begun}, {3})

    def test_nothing_begins_without_time(self):
        s = self.session(f"echo called >> {self.folder}/calls")
        parts.bench(s, 0)
        parts.members(s, 0)
        self.assertFalse(os.path.exists(os.path.join(self.folder, "calls")))

    def test_a_refusal_is_a_result_and_a_crash_is_told(self):
        s = self.session("""shift; while [ "$1" != --out ]; do shift; done; mkdir -p "$2"
case "$2" in */1) printf 'workload,on,refused\\n"x","y","too large"\\n' > "$2/bench.csv";; *) exit 4;; esac""")
        parts.members(s, 60)
        self.assertEqual(s.memory.card["members"]["1"], {"refused": "too large"})
        self.assertEqual(s.memory.card["members"]["2"], {"failed": "exit code 4"})
        self.assertEqual(s.memory.rate(), 0.0)


QUEUE = """# studies
[[study]]
study = "a.toml"
priority = 2
cost_G = 100  # by a dry run
state = "open"
[[study]]
study = "b.toml"
command = "calibrate"
priority = 1
cost_G = 1e3
state = "open"
[[study]]
study = "c.toml"
priority = 1
state = "done"
"""


class Queue(InFolder):
    def setUp(self):
        super().setUp()
        for name in "abc":
            self.write(name + ".toml", "")

    def test_it_is_read_and_its_faults_are_told_with_their_lines(self):
        entries = queue_file.read(self.write("queue.toml", QUEUE))
        self.assertEqual([e["name"] for e in entries], ["a", "b", "c"])
        self.assertEqual([e["command"] for e in entries], ["sweep", "calibrate", "sweep"])
        self.assertEqual(entries[2]["cost_G"], queue_file.UNKNOWN)
        for old, new, said in [("priority = 2", "prority = 2", ":4: prority: there is no such key"),
                               ("priority = 2", "priority = two", ":4: priority = two"),
                               ("priority = 2", "priority = \"2\"", ":4: priority"),
                               ("priority = 2\n", "", ":2: priority is missing"),
                               ("priority = 2", "priority = 2\npriority = 2", ":5: priority stands twice"),
                               ("cost_G = 100", "cost_G = 0", ":2: cost_G must be more than 0"),
                               ("\"done\"", "\"ready\"", ":13: state = \"ready\": give open or done"),
                               ("c.toml", "d.toml", ":13: study = \"d.toml\": there is no file"),
                               ("c.toml", "a.toml", ":2: a.toml stands twice"),
                               ("calibrate", "render", "give sweep or calibrate"),
                               ("[[study]]", "[study]", ":2: '[study]' is neither")]:
            with self.subTest(new):
                with self.assertRaises(queue_file.QueueError) as caught:
                    queue_file.read(self.write("queue.toml", QUEUE.replace(old, new, 1)))
                self.assertIn(said, str(caught.exception))

    def test_from_the_top_it_takes_what_fits_and_else_the_top_one(self):
        entries = queue_file.read(self.write("queue.toml", QUEUE))
        take = lambda left, rate, seconds: queue_file.chosen(entries, left, rate, seconds)
        self.assertEqual(take({}, 1e9, 1000)[0]["name"], "b")
        self.assertEqual(take({}, 1e9, 999)[0]["name"], "a")
        self.assertEqual(take({"b": 500.0}, 1e9, 999)[0]["name"], "b")
        study, fits = take({}, 1e9, 99)
        self.assertEqual((study["name"], fits), ("b", False))
        self.assertEqual(take({"b": 0.0}, 1e9, 99)[0]["name"], "a")
        self.assertEqual(take({"b": 0.0, "a": 0.0}, 1e9, 99), (None, False))

    def test_what_sweeps_say_of_work_is_understood(self):
        self.assertEqual(queue_file.members_left("the time is up; 3 of 12 members left, 53.1 G particle-steps by"), 53.1)
        self.assertEqual(queue_file.members_left("1 of 2 members left, 1.5e+04 G particle-steps by"), 15000.0)
        self.assertAlmostEqual(queue_file.members_left("left, 12 particle-steps by"), 12e-9)
        self.assertIsNone(queue_file.members_left("interrupted"))
        self.assertAlmostEqual(queue_file.cost_told("x: 1 member, 950 M particle-steps by the closed forms"), 0.95)

    def test_studies_end_go_on_or_fail(self):
        path = self.write("queue.toml", QUEUE)
        s = self.session("""echo "$@" >> %s/calls
case "$1" in calibrate) echo 'the time is up; 1 of 2 members left, 7 G particle-steps by the closed forms' >&2
    [ -e %s/again ] && exit 0; touch %s/again; exit 6;; *) exit 3;; esac""" % ((self.folder,) * 3))
        studies.queue(s, path, 60, 1e9, least=1)
        known = s.memory.all["queue"]
        self.assertEqual((known["b"]["state"], known["b"]["left_G"]), ("done", 0.0))  # went on within the same call
        self.assertEqual(known["a"]["why"], "exit code 3")
        with open(os.path.join(self.folder, "calls"), encoding="utf-8") as f:
            calls = f.read().splitlines()
        self.assertEqual([c.split()[0] for c in calls], ["calibrate", "calibrate", "sweep"])
        self.assertIn("--for ", calls[0])

    def test_every_study_of_the_queue_is_there_and_takes_its_command(self):
        for entry in queue_file.read(os.path.join(ROOT, "cases", "queue.toml")):
            with open(entry["file"], encoding="utf-8") as f:
                calibrates = "\n[calibrate]" in f.read()
            self.assertEqual(entry["command"], "calibrate" if calibrates else "sweep", entry["study"])


class Packs(InFolder):
    def test_tables_come_first_and_no_file_is_too_long(self):
        out = os.path.join(self.folder, "out")
        for n in range(3):
            with open(self.write(f"out/studies/s/members/000{n}/checkpoint.h5", ""), "wb") as f:
                f.write(os.urandom(30000))
        self.write("out/studies/s/members.csv", "a\n")
        self.write("out/gpu-minutes.md", "# table\n")
        with open(self.write("out/studies/s/huge.h5", ""), "wb") as f:
            f.write(os.urandom(90000))
        packs, left = pack.back(out, most_files=2, most_bytes=50000)
        self.assertEqual(len(packs), 2)
        self.assertEqual(sorted(left), ["studies/s/huge.h5", "studies/s/members/0002/checkpoint.h5"])
        for path in packs:
            self.assertLessEqual(os.path.getsize(path), 50000)
        with tarfile.open(packs[0]) as first:
            self.assertEqual(first.getnames()[:2], ["gpu-minutes.md", "studies/s/members.csv"])
        again, _ = pack.back(out, most_files=2, most_bytes=50000)  # former packs are no results
        self.assertEqual(again, packs)


class Whole(InFolder):
    """On the device of the tests."""

    def call(self, root, *words):
        done = subprocess.run([os.path.join(root, "tools", "gpu-minutes"), *words], capture_output=True, text=True,
                              check=False)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return done.stdout

    def queue(self):
        self.write("tiny.toml", f'base = "{ROOT}/cases/mini.toml"\n[set]\nsettle.time_s = 0.01\ndose.rotate_s = 0.02\n'
                   'dose.rest_s = 0.005\nstop.max_doses = 1\n[[axis]]\nkey = "contact.friction"\nvalues = [0.2, 0.4]\n')
        return self.write("queue.toml", '[[study]]\nstudy = "tiny.toml"\npriority = 1\ncost_G = 1e-3\nstate = "open"\n')

    def test_a_dry_run_does_all_and_a_second_call_repeats_nothing(self):
        out, queue = os.path.join(self.folder, "out"), self.queue()
        words = ["60", "--tiny", "--out", out, "--queue", queue, "--program", PROGRAM]
        first = self.call(ROOT, *words)
        with open(os.path.join(out, "memory.json"), encoding="utf-8") as f:
            memory = json.load(f)
        (card,) = [c for programs in memory["cards"].values() for c in programs.values()]
        self.assertGreaterEqual(len(card["verify"]), 3)
        self.assertTrue(all(v["failed"] == 0 for v in card["verify"].values()), card["verify"])
        self.assertTrue(all(v == "passed" for v in card["tests"].values()), card["tests"])
        self.assertEqual(list(card["members"]), ["1", "2"])
        self.assertTrue(all(r["rate"] > 0 for r in [*card["members"].values(), *card["bench"].values()]))
        self.assertEqual(memory["queue"]["tiny"]["state"], "done")
        self.assertIn("gpu-minutes-1.tar.gz", first)
        with open(os.path.join(out, "gpu-minutes.md"), encoding="utf-8") as f:
            self.assertIn("known answers met in", f.read())
        self.assertTrue(os.path.exists(os.path.join(out, "studies", "tiny", "members.csv")))

        shutil.rmtree(os.path.join(out, "logs"))
        self.call(ROOT, *words)
        made = sorted(n for n in os.listdir(os.path.join(out, "logs")) if not n.startswith("list-"))
        self.assertEqual(made, ["devices.txt", "first.txt", "verify-list.txt"])

    def test_only_the_parts_that_are_asked_for_run(self):
        out = os.path.join(self.folder, "out")
        self.call(ROOT, "60", "--tiny", "--only", "queue", "--out", out, "--queue", self.queue(), "--program", PROGRAM)
        made = sorted(os.listdir(os.path.join(out, "logs")))
        self.assertEqual(made, ["devices.txt", "first.txt", "queue-tiny.txt"])
        done = subprocess.run([os.path.join(ROOT, "tools", "gpu-minutes"), "--only", "quark"], capture_output=True,
                              text=True, check=False)
        self.assertEqual(done.returncode, 2)
        self.assertIn("quark: give parts of verify,tests,members,bench,queue", done.stderr)

    def test_a_packed_folder_works_by_itself(self):
        packed = os.path.join(self.folder, "card.tar.gz")
        said = self.call(ROOT, "--pack", packed, "--program", PROGRAM)
        self.assertIn("left out: the validation layer", said)
        self.assertLessEqual(os.path.getsize(packed), pack.MOST_CARRIED)
        with tarfile.open(packed) as archive:
            archive.extractall(self.folder)
        folder = os.path.join(self.folder, pack.FOLDER)
        libraries = os.listdir(os.path.join(folder, "lib"))
        self.assertTrue(any(n.startswith("libfmt") for n in libraries))
        self.assertFalse(any(n.startswith("libc.so") for n in libraries))
        for name in places.DRIVER_NEEDS:
            self.assertTrue(name in libraries or f"left out: {name}" in said, name)
        out = os.path.join(self.folder, "out")
        self.call(folder, "60", "--tiny", "--out", out, "--queue", self.queue())
        self.assertTrue(os.path.exists(os.path.join(out, "gpu-minutes.md")))


if __name__ == "__main__":
    unittest.main(verbosity=2)
