"""The parts of a quarter of an hour, in the order of their worth. Each goes on where the memory says that it had come
to. What fails or overruns is told and does not keep the rest from running."""

import concurrent.futures
import csv
import io
import json
import os
import re

import place as places
from run import run

CANISTERS = [1, 4, 16, 64, 256]
MOST_AT_ONCE = 16  # programs that share the card; known answers and tests leave it idle most of the time
BEDS = ["free-fall", "bed-48g-rest", "bed-48g-turning", "bed-3k", "bed-27k", "bed-100k", "bed-300k", "bed-1M"]


class Session:
    """What all parts share."""

    def __init__(self, place, out, memory, deadline, device, tiny):
        self.place, self.out, self.memory, self.deadline, self.tiny = place, out, memory, deadline, tiny
        self.device = ["--device", device] if device else []
        self.environment = place.environment(out)
        if device:
            self.environment["VKDOSE_TEST_DEVICE"] = device
        self.steps = 0

    def call(self, name, words, seconds):
        """Runs a program and keeps what it said in logs/NAME."""
        self.steps += 1
        log = os.path.join(self.out, "logs", re.sub(r"[^A-Za-z0-9._-]+", "-", name)[:120] + ".txt")
        ended = run(words, min(seconds, self.deadline.left()), log, self.environment, self.place.root)
        return ended

    def vkdose(self, name, words, seconds):
        return self.call(name, [self.place.program, *words], seconds)

    def side_by_side(self, names, words, part):
        """Runs a program for each name, as many at once as there are processors, and yields the names with how they
        ended as they end. `words`: gives the program's words for a name. None begins after the time of `part`."""
        def one(name):
            return self.call(name, words(name), part.left()) if part.left() > 0 else None

        with concurrent.futures.ThreadPoolExecutor(min(MOST_AT_ONCE, os.cpu_count() or 1)) as pool:
            begun = {pool.submit(one, name): name for name in names}
            for future in concurrent.futures.as_completed(begun):
                if future.result() is not None:
                    yield begun[future], future.result()


def devices(s):
    """Which devices there are. Returns the one that the program takes, or None."""
    s.memory.note(s.vkdose("devices", ["devices"], 60).text.rstrip())
    folder = os.path.join(s.out, "first")
    ended = s.vkdose("first", ["test", "verify", "--only", "integrator/free-fall", "--out", folder, *s.device], 120)
    try:
        with open(os.path.join(folder, "verify.json"), encoding="utf-8") as f:
            device = json.load(f)["backend"].removeprefix("vulkan: ")
    except (OSError, ValueError, KeyError):
        s.memory.note(f"no device computes: {ended.words()}\n{ended.text.rstrip()}")
        return None
    s.memory.note(f"on {device}")
    return device


def verify(s, seconds):
    """The known answers, case by case."""
    part = s.deadline.part(seconds)
    met = s.memory.card["verify"]
    listed = s.vkdose("verify-list", ["test", "verify", "--list"] + (["--only", "integrator/"] if s.tiny else []), 60)
    names = [line.split()[0] for line in listed.text.splitlines() if "/" in line]

    def folder_of(name):
        return os.path.join(s.out, "verify", name.replace("/", "-"))

    def words(name):
        return [s.place.program, "test", "verify", "--only", name, "--out", folder_of(name), *s.device]

    missing = [name for name in names if met.get(name, {}).get("failed") != 0]
    for name, ended in s.side_by_side(missing, words, part):
        try:
            with open(os.path.join(folder_of(name), "verify.json"), encoding="utf-8") as f:
                results = [r for r in json.load(f)["results"] if r["case"] == name]
        except (OSError, ValueError, KeyError):
            results = None
        if ended.overran or ended.code not in (0, 1) or not results:
            met[name] = {"known": 0, "met": 0, "plausible": 0, "failed": 1, "why": ended.words() or "no results"}
        else:
            known = [r for r in results if r["kind"] == "known answer"]
            bad = [r for r in results if not r["passes"]]
            met[name] = {"known": len(known), "met": sum(r["passes"] for r in known),
                         "plausible": len(results) - len(known), "failed": len(bad),
                         "why": "; ".join(f"{r['quantity']}: {r['got']} for {r['expected']}" for r in bad)}
        if met[name]["failed"]:
            s.memory.note(f"verify {name}: {met[name]['why']}")
        s.memory.save()
    s.memory.card["verify_cases"] = len(names)
    s.memory.save()


def tests_in(s, room):
    """The names of a room's tests, those for every driver first."""
    if not os.path.isfile(s.place.test(room)):
        return []
    def listed(spec):
        for words in (["--list-test-names-only"], ["--list-tests", "--verbosity", "quiet"]):  # Catch2 2, Catch2 3
            text = s.call(f"list-{room}", [s.place.test(room), *spec, *words], 60).text
            if "nrecognised" not in text and "nrecognized" not in text:
                return [line.strip() for line in text.splitlines() if line.strip()]
        return []

    first = set(listed(["[every-driver]"])) if room == "scene" else set()
    names = listed([])
    return [n for n in names if n in first] + [n for n in names if n not in first]


def tests(s, seconds):
    """The tests of what a device computes, one by one."""
    part = s.deadline.part(seconds)
    known = s.memory.card["tests"]
    count = 0
    specs = {}
    for room in places.ROOMS:
        names = tests_in(s, room)[:2 if s.tiny else None]
        count += len(names)
        for name in names:
            if known.get(f"{room}: {name}") != "passed":
                specs[f"{room}: {name}"] = [s.place.test(room), re.sub(r"([\\,\[\]*])", r"\\\1", name)]
    for key, ended in s.side_by_side(specs, specs.get, part):
        skipped = "skipped:" in ended.text
        good = ended.code == 0 and not ended.overran and "No test cases matched" not in ended.text
        known[key] = "skipped" if skipped and good else "passed" if good else "failed"
        if ended.overran and part.left() <= 0:
            known[key] = "unfinished"  # there was no time for it
        elif not good:
            s.memory.note(f"test {key}: {ended.words() or 'failed'}")
        s.memory.save()
    s.memory.card["tests_all"] = count
    s.memory.save()


def _first_row(path):
    with open(path, encoding="utf-8") as f:
        row = next(csv.DictReader(io.StringIO(f.read())), {})
    if row.get("refused"):
        return {"refused": row["refused"]}
    return {"rate": float(row["particle_steps_per_s"]), "low": float(row["particle_steps_per_s_low"]),
            "high": float(row["particle_steps_per_s_high"]), "particles": int(row["particles"]),
            "bytes": float(row.get("table_bytes_per_particle") or 0)}


def _measure(s, known, key, words, folder, seconds):
    if "rate" in known.get(key, {}) or "refused" in known.get(key, {}) or seconds <= 0:
        return
    ended = s.vkdose("bench " + key, ["test", "bench", "--out", folder, *words, *s.device], seconds)
    try:
        known[key] = _first_row(os.path.join(folder, "bench.csv"))
    except (OSError, ValueError, KeyError):
        known[key] = {"failed": ended.words() or "no figures"}
        s.memory.note(f"bench {key}: {known[key]['failed']}")
    s.memory.save()


def bench(s, seconds):
    """The speed of the step with one canister and with beds of any size."""
    part = s.deadline.part(seconds)
    for bed in BEDS[:1] if s.tiny else BEDS:
        folder = os.path.join(s.out, "bench", bed)
        words = ["--only", bed] + (["--quick"] if s.tiny else ["--repeats", "3"])
        _measure(s, s.memory.card["bench"], bed, words, folder, part.left())


def members(s, seconds):
    """The speed of ensembles of the paper's canister."""
    part = s.deadline.part(seconds)
    for number in [1, 2] if s.tiny else CANISTERS:
        folder = os.path.join(s.out, "bench-members", str(number))
        words = ["--members", str(number), "--only", "free-fall" if s.tiny else "bed-48g-turning"]
        words += ["--quick"] if s.tiny else ["--repeats", "3"]
        _measure(s, s.memory.card["members"], str(number), words, folder, part.left())
