"""Reads: a preloaded library lets the reads of one file fail, come in pieces or be interrupted. A command whose read
fails says so and names the file: an error is never taken for the end of the file. Pieces and interruptions change
nothing."""

import glob
import os
import subprocess

import folders
import mutations

NAME, TRIES = "reads", 150
DECK = [(command, name) for command, names in mutations.TARGETS for name in dict.fromkeys(names)]
HARM = ("EIO", "ESTALE", "EACCES")
OUTPUTS = {"report": "out/report.html", "report-sweep": "out/report.html", "render": "out/picture.png",
           "profile": "profile.csv", "export-body": "coil.stl"}


def build(ground):
    """The library, made of the one that the tests preload too."""
    source = os.path.join(os.path.dirname(__file__), "..", "..", "tests", "support", "io_faults.cpp")

    def make(path):
        subprocess.run(["c++", "-std=c++20", "-shared", "-fPIC", "-O1", "-o", path, source, "-ldl"], check=True)
    return ground.made("io_faults.so", make)[0]


def deal(rng):
    """The faults, and whether they do harm."""
    pieces = f"read:short:{rng.choice((1, 7, 100, 1000, 4096))}"
    kind = rng.choice(("harmless", "open", "read", "read", "read"))
    if kind == "harmless":
        return f"{pieces},read:EINTR:{rng.randint(0, 3)}:{rng.randint(1, 5)},open:EINTR:0:1", False
    if kind == "open":
        return f"open:{rng.choice(('EIO', 'ESTALE', 'EACCES'))}:{rng.randint(0, 2)}", True
    count = rng.choice(("", ":1"))
    return f"{pieces},read:EIO:{rng.choice((0, 1, 2, 3, 5, 8, 13))}{count}", True


def judge_same(t, command, good):
    """The command leaves what it leaves without faults."""
    if command in ("run", "from", "resume", "sweep", "sweep-on"):
        t.expect_same(os.path.join(good, "out"), t.path("out"), "exit 0, but")
    elif command in OUTPUTS:
        if folders.bytes_of(os.path.join(good, OUTPUTS[command])) != folders.bytes_of(t.path(OUTPUTS[command])):
            t.found(f"exit 0, but another {OUTPUTS[command]}")


def attempt(t):
    command, name = DECK[t.number % len(DECK)]
    words, path = mutations.prepare(t, command, name)
    if "*" in path:
        path = t.rng.choice(sorted(glob.glob(path)))
    file = os.path.relpath(path, t.folder)
    faults, harmful = deal(t.rng)
    good = t.folder + "-good"
    folders.remove(good)
    folders.copy(t.folder, good)
    whole = t.vkdose(*words, folder=good)
    told = t.path("told")
    end = t.vkdose(*words, environment={"LD_PRELOAD": build(t.ground), "VKDOSE_IO_FILE": file,
                                        "VKDOSE_IO_FAULT": faults, "VKDOSE_IO_TOLD": told})
    struck = folders.bytes_of(told).decode() if os.path.exists(told) else ""
    if not (harmful and any(error in struck for error in HARM)):
        if end.code != whole.code:
            t.found(f"{end.how()} in place of {whole.how()}: {end.said()}")
        elif end.code == 0:
            judge_same(t, command, good)
    elif end.code == 0:
        t.found("exit 0 though a read failed")
    elif end.code == 2 and os.path.basename(path) not in end.err + end.out:
        t.found(f"the refusal does not name the file: {end.said()}")
    if not t.finds:
        folders.remove(good)
    t.finds = [f"{file} of {command}, {faults}: {text}" for text in t.finds]
