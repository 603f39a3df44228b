"""Kills: runs, resumed runs, sweeps and reports are ended by signals at any moment, then continued until they are done.
The files that they leave are those of an undisturbed run, to the last byte."""

import os
import signal
import time

import folders
import program
from ground import CHECKPOINT, Watch

NAME, TRIES = "kills", 200
SIGNALS = (signal.SIGKILL, signal.SIGTERM, signal.SIGINT, signal.SIGHUP, signal.SIGQUIT)
START = 0.6  # seconds in which a program begins


def listens(pid):
    """Whether a program handles SIGINT itself, as it does before its first step."""
    try:
        with open(f"/proc/{pid}/status", encoding="utf-8") as file:
            caught = next((line for line in file if line.startswith("SigCgt:")), "SigCgt: 0")
    except OSError:
        return False
    return bool(int(caught.split()[1], 16) >> (signal.SIGINT - 1) & 1)


def moment(rng, seconds, early):
    """When to strike: a text, and a function that waits for it. `early`: rather at the start."""
    kinds = ("start", "listening", "listening", "any") if early else ("any", "start", "checkpoint", "writing")
    kind = rng.choice(kinds)
    after = rng.uniform(0, START if kind == "start" else seconds * 1.05)
    count, spin = rng.randint(1, 12), rng.choice((0, rng.uniform(0, 0.03)))

    def wait(running, folder):
        last = time.monotonic() + (after if kind in ("any", "start") else 60)
        watch = Watch(os.path.join(folder, CHECKPOINT))
        fresh = os.path.join(folder, CHECKPOINT + ".new")
        while time.monotonic() < last and not running.over():
            watch.look()
            if (kind == "listening" and listens(running.pid)) or (kind == "checkpoint" and watch.changes >= count):
                time.sleep(spin)
                break
            if kind == "writing" and watch.changes >= count and os.path.exists(fresh):
                break

    return {"any": f"after {after:.3f} s", "start": f"after {after:.3f} s",
            "listening": f"{spin:.3f} s after it listens to signals",
            "checkpoint": f"{spin:.3f} s after checkpoint {count}",
            "writing": f"while it writes a checkpoint after {count} others"}[kind], wait


def strike(t, words, folder, seconds, early=False):
    """Starts a command and ends it by a signal at some moment."""
    # The two that a run ends by itself for, with a checkpoint before its first step.
    number = t.rng.choice(SIGNALS + (signal.SIGINT, signal.SIGTERM) if early else SIGNALS)
    text, wait = moment(t.rng, seconds, early)
    running = t.start(*words)
    wait(running, folder)
    # timeout(1) sends two that are one request; a program that listens already outlives the second.
    twice = t.rng.random() < 0.3 and number in (signal.SIGINT, signal.SIGTERM) and listens(running.pid)
    t.note(f"{number.name} {'twice ' if twice else ''}{text}")
    running.send(number)
    if twice:
        running.send(number)
    end = t.ended(running, sent=() if twice else (number,))
    if end.code not in (None, 0, 130) and end.code != -number:
        t.found(f"{number.name} ends it with {end.how()}: {end.said()}")
    if end.code == 130 and words[0] in ("run", "resume") and not os.path.exists(os.path.join(folder, CHECKPOINT)):
        t.found("exit 130 without a checkpoint to go on from")
    return end


def go_on(t, good, folder, again):
    """Goes on with a run to its end, and compares."""
    if folders.complete(folder):
        t.expect_same(good, folder, "the run calls itself complete, but")
        return
    words = ["resume", folder, "--quiet"] if os.path.exists(os.path.join(folder, CHECKPOINT)) else again + ["--force"]
    end = t.vkdose(*words)
    if end.code == 0:
        t.expect_same(good, folder, f"other files after the kills, `{words[0]}` says exit 0")
    elif end.code is not None:
        t.found(f"`{words[0]}` after the kills says {end.how()}: {end.said()}")


def run(t, resumes):
    backend = t.rng.choice(("vulkan", "vulkan", "reference"))
    good, seconds = t.ground.good("long", backend)
    folder = t.path("run")
    words = t.ground.run_words("long", backend, folder)
    end = strike(t, words, folder, seconds)
    for _ in range(resumes):
        if end.code == 0 or not os.path.exists(os.path.join(folder, CHECKPOINT)) or folders.complete(folder):
            break
        end = strike(t, ["resume", folder, "--quiet"], folder, seconds, early=True)
    if end.code == 0:
        t.expect_same(good, folder, "exit 0, but")
    else:
        go_on(t, good, folder, words)


def sweep(t, manner):
    good, seconds = t.ground.good_sweep(manner)
    t.ground.study(t.folder)
    folder = t.path("sweep")
    words = t.ground.sweep_words(folder, manner)
    member_struck = False
    for _ in range(t.rng.randint(1, 3)):
        number = t.rng.choice(SIGNALS)
        whom = t.rng.choice(("the parent", "the parent", "a member", "all")) if manner != "ensemble" else "the parent"
        after = t.rng.uniform(0, seconds)
        running = t.start(*words)
        last = time.monotonic() + after
        while time.monotonic() < last and not running.over():
            time.sleep(0.001)
        family = running.family()
        struck = {"the parent": [running.pid], "a member": family[:1], "all": family + [running.pid]}[whom]
        t.note(f"{number.name} to {whom} after {after:.3f} s")
        for pid in struck:
            if pid in family or not running.over():
                program.send(pid, number)
        end = t.ended(running, sent=(number,))
        member_struck = member_struck or (whom != "the parent" and bool(family))
        if end.code not in (None, 0, 130, -number) and not (end.code == 1 and member_struck):
            t.found(f"{number.name} to {whom} ends the sweep with {end.how()}: {end.said()}")
        if end.code == 0:
            break
    # A member that something else ended has failed, and runs again when that is asked for.
    end = t.vkdose(*words, *(["--retry-failed"] if member_struck else []))
    if end.code == 0:
        t.expect_same(good, folder, "other files after the kills, the sweep says exit 0")
    elif end.code is not None:
        t.found(f"the sweep after the kills says {end.how()}: {end.said()}")


def report(t):
    def make(path):
        folders.copy(t.ground.good("long", "reference")[0], path)
        return t.ground.must("report", path)
    good, seconds = t.ground.made("reported", make)
    folder = t.path("run")
    folders.copy(t.ground.good("long", "reference")[0], folder)
    for _ in range(4):
        strike(t, ["report", folder], folder, seconds)
        page = os.path.join(folder, "report.html")
        if os.path.exists(page) and folders.bytes_of(page) != folders.bytes_of(os.path.join(good, "report.html")):
            t.found("a kill leaves half a report.html")
    if t.vkdose("report", folder).code == 0:
        t.expect_same(good, folder, "other files after kills of `report`, which says exit 0")
    else:
        t.found("`report` does not go after kills of it")


def attempt(t):
    kind = t.number % 10
    if kind < 3:
        run(t, 0)
    elif kind < 7:
        run(t, t.rng.randint(1, 3))
    elif kind == 7:
        sweep(t, t.rng.choice(("reference", "vulkan")))
    elif kind == 8:
        sweep(t, "ensemble")
    else:
        report(t)
