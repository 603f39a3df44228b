"""The ground an attack stands on: tries in folders of their own, small cases, and undisturbed runs to compare with."""

import os
import random
import shlex
import signal
import threading
import time

import folders
import program

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
MINI = os.path.join(ROOT, "cases", "mini.toml")

# Runs of a second or two, a checkpoint every 500 steps, everything a run can keep.
LONG = {"settle.time_s": 0.03, "dose.rotate_s": 0.06, "dose.rest_s": 0.01, "stop.max_doses": 2,
        "frames.interval_s": 0.04, "frames.contacts": "true", "checkpoint.time_s": 0.006,
        "field": '[{preset="outlet"},{preset="mid-plane",interval_s=0.04,average=true}]'}
# A fraction of a second.
SHORT = {**LONG, "particles.mass_g": 0.4, "settle.time_s": 0.01, "dose.rotate_s": 0.02, "frames.interval_s": 0.01,
         "checkpoint.time_s": 0.004,
         "field": '[{preset="outlet"},{preset="mid-plane",interval_s=0.01,average=true}]'}
# What is written only at the start and at the end.
PLAIN = {key: value for key, value in LONG.items() if not key.startswith(("frames", "checkpoint", "field"))}
CASES = {"long": LONG, "short": SHORT, "plain": PLAIN}
CHECKPOINT = "checkpoint.h5"

STUDY = """name = "attacked"
reason = "Members that are over in a second."
base = "base-case.toml"
seeds = [1, 2]
[[axis]]
key = "contact.friction"
values = [0.3, 0.5]
"""


class Try:
    """One attack: a folder, random numbers of its own, the list of actions, and the finds."""

    def __init__(self, ground, kind, number):
        self.ground, self.kind, self.number = ground, kind, number
        self.rng = random.Random(f"{ground.seed}/{kind}/{number}")
        self.folder = os.path.join(ground.work, f"{kind}-{number:04}")
        self.log, self.finds = [], []
        folders.remove(self.folder)
        os.makedirs(self.folder)

    def path(self, *names):
        return os.path.join(self.folder, *names)

    def note(self, text):
        self.log.append(f"# {text}")

    def found(self, text):
        self.note(f"FOUND: {text}")
        self.finds.append(text)

    def start(self, *words, folder=None, environment=None, **limits):
        """Starts the program in the try's folder or another one, with further variables."""
        line = [self.ground.program, *words]
        more = environment or {}
        self.log.append(" ".join([f"{key}={shlex.quote(value)}" for key, value in more.items()] + [shlex.join(line)]))
        if folder:
            self.log[-1] = f"(cd {shlex.quote(folder)} && {self.log[-1]})"
        return program.Running(line, folder or self.folder, {**self.ground.environment, **more}, **limits)

    def ended(self, running, sent=()):
        """Waits for the program and notes what no command may do. `sent`: the signals that it was sent."""
        end = running.wait(self.ground.patience)
        self.note(f"{end.how()} after {end.seconds:.2f} s: {end.said()}")
        fault = end.fault(sent)
        if fault:
            self.found(fault)
        if not running.wait_family(self.ground.patience):
            self.found("processes outlive the program")
        return end

    def python(self, script, module):
        """Runs a script with the package of the source tree and the module in this folder."""
        self.log.append(f"PYTHONPATH={ROOT}/host/python:{module} python3 {script}")
        environment = {**self.ground.environment, "VKDOSE": self.ground.program,
                       "PYTHONPATH": os.pathsep.join((os.path.join(ROOT, "host", "python"), module))}
        return self.ended(program.Running(["/usr/bin/python3", "-B", script], self.folder, environment))

    def vkdose(self, *words, **limits):
        return self.ended(self.start(*words, **limits))

    def expect_same(self, good, folder, what, but=()):
        different = folders.differences(good, folder, but)
        if different:
            self.found(f"{what}: {folders.brief(different)}")
        return not different

    def close(self, keep):
        """Ends the try: its folder goes, unless something was found or it is to be kept."""
        if self.finds or keep:
            folders.write(self.path("commands.txt"), f"cd {shlex.quote(self.folder)}\n" + "\n".join(self.log) + "\n")
        else:
            folders.remove(self.folder)


DESIGN = """[design]
max_runs = 3
confirming_seeds = 2
[[design.goal]]
figure = "dose.left_kg"
wish = "largest"
[[design.parameter]]
key = "contact.friction"
low = 0.3
high = 0.5
"""


def of_design(study):
    """The study with a design in place of its axes."""
    return study.split("[[axis]]")[0] + DESIGN


class Ground:
    """What all tries share. Undisturbed runs are made when first asked for and kept."""

    def __init__(self, options):
        self.program = os.path.abspath(options.program)
        self.seed, self.patience = options.seed, options.patience
        self.work = os.path.join(ROOT, "out", "attack", f"seed-{options.seed}")
        self.over = threading.Event()  # no further tries
        self.sanitized = b"__asan_init" in folders.bytes_of(self.program)
        # The address sanitizer reserves terabytes and has a limit of its own.
        self.memory = 0 if self.sanitized else options.memory << 20
        self.environment = {**os.environ, "LP_NUM_THREADS": "0", "LC_ALL": "C.UTF-8",
                            "ASAN_OPTIONS": f"hard_rss_limit_mb={options.memory}:exitcode=99:"
                                            "verify_asan_link_order=0",
                            "UBSAN_OPTIONS": "halt_on_error=1:exitcode=99"}
        self._made, self._locks, self._guard = {}, {}, threading.Lock()
        self.foundation = os.path.join(self.work, "undisturbed")
        folders.remove(self.foundation)
        os.makedirs(self.foundation)

    def made(self, name, make):
        """The folder `name` of the foundation, made by make(path) when first asked for."""
        with self._guard:
            lock = self._locks.setdefault(name, threading.Lock())
        with lock:
            if name not in self._made:
                path = os.path.join(self.foundation, name)
                self._made[name] = (path, make(path))
            return self._made[name]

    def must(self, *words):
        """Runs the program undisturbed and returns the seconds it took. If that fails, there is no attack."""
        running = program.Running([self.program, *words], self.foundation, self.environment)
        end = running.wait(600)
        if end.code != 0:
            raise SystemExit(f"tools/attack: undisturbed, `{shlex.join(words)}` ends with {end.how()}: {end.err}")
        return end.seconds

    @staticmethod
    def run_words(case, backend, out, seed=1):
        words = ["run", MINI, "--out", out, "--backend", backend, "--quiet", "--set", f"seed={seed}"]
        for key, value in CASES[case].items():
            words += ["--set", f"{key}={value}"]
        return words

    def good(self, case, backend, seed=1):
        """An undisturbed run and the seconds it took."""
        return self.made(f"{case}-{backend}-{seed}",
                         lambda path: self.must(*self.run_words(case, backend, path, seed)))

    def case_text(self, case, backend="reference"):
        """The case of an undisturbed run, with every key."""
        return folders.bytes_of(os.path.join(self.good(case, backend)[0], "case.toml"))

    def broken(self, case, backend, checkpoints=3):
        """A run that was killed after some checkpoints; a folder to be copied."""
        def make(path):
            for _ in range(20):
                folders.remove(path)
                running = program.Running([self.program, *self.run_words(case, backend, path)], self.foundation,
                                          self.environment)
                watch = Watch(os.path.join(path, CHECKPOINT))
                while watch.changes < checkpoints and not running.over():
                    watch.look()
                running.send(signal.SIGKILL)
                running.wait(self.patience)
                if os.path.exists(os.path.join(path, CHECKPOINT)):
                    return 0
            raise SystemExit("tools/attack: no run could be killed between two checkpoints")
        return self.made(f"broken-{case}-{backend}", make)[0]

    def study(self, folder):
        """Writes the study and its base case into a folder; the study's name."""
        folders.write(os.path.join(folder, "study.toml"), STUDY)
        folders.write(os.path.join(folder, "base-case.toml"), self.case_text("short"))
        return "study.toml"

    @staticmethod
    def sweep_words(out, manner):
        how = ["--ensemble", "4"] if manner == "ensemble" else ["--jobs", "2", "--backend", manner]
        return ["sweep", "study.toml", "--out", out, "--quiet", *how]

    def good_sweep(self, manner):
        """An undisturbed sweep in processes on a backend, or as an ensemble, and the seconds it took."""
        def make(path):
            self.study(self.foundation)
            return self.must(*self.sweep_words(path, manner))
        return self.made(f"sweep-{manner}", make)

    def broken_sweep(self, manner="reference"):
        """A sweep that was killed after some of its members had ended."""
        def make(path):
            self.study(self.foundation)
            for _ in range(20):
                folders.remove(path)
                running = program.Running([self.program, *self.sweep_words(path, manner)], self.foundation,
                                          self.environment)
                rows = os.path.join(path, "members.csv")
                while not running.over() and (not os.path.exists(rows) or folders.bytes_of(rows).count(b"\n") < 2):
                    time.sleep(0.001)
                time.sleep(0.05)
                running.send(signal.SIGKILL)
                ended = running.wait(self.patience)
                running.wait_family(self.patience)
                begun = any(name.endswith(CHECKPOINT) for name in folders.files_in(path))
                if ended.code != 0 and begun and folders.bytes_of(rows).count(b"\n") < 5:
                    return 0
            raise SystemExit("tools/attack: no sweep could be killed half way")
        return self.made(f"broken-sweep-{manner}", make)[0]


class Watch:
    """Counts how often a file was replaced."""

    def __init__(self, path):
        self.path, self.changes, self._last = path, 0, None
        self.look()
        self.changes = 0

    def look(self):
        try:
            info = os.stat(self.path)
            now = (info.st_ino, info.st_mtime_ns)
        except OSError:
            now = None
        if now is not None and now != self._last:
            self.changes += 1
        self._last = now
        time.sleep(0.0003)
