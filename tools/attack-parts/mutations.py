"""Mutations: every file that a command reads is spoilt in some way. The command then refuses and names the file,
or does its work: no signal, no hang, no internal error, no result without meaning."""

import functools
import glob
import json
import math
import os
import shutil
import signal
import struct
import subprocess
import time
import tomllib
import zlib

import folders
from ground import CHECKPOINT, MINI, of_design
from spoil import spoil

NAME, TRIES = "mutations", 500
LONG = 5  # seconds of processor time after which a run that was not spoilt is long over

OF_A_RUN = ["case.toml", "timeseries.csv", "doses.csv", "frames/frames.csv", "frames/particles_000001.hdf",
            "fields/mid-plane.csv", "fields/mid-plane_000000.csv"]
# Commands, and what is spoilt for them; what stands twice is spoilt twice as often.
TARGETS = (
    ("run", ["case.toml"] * 6 + ["list.csv"] * 3 + ["case-list.toml"]),
    ("check", ["case.toml"] * 2 + ["list.csv"]),
    ("compare", ["case.toml"]),
    ("export-body", ["case.toml"]),
    ("scale", ["case.toml"]),
    ("powder", ["powder.toml"] * 3),
    ("draws", ["draws.csv"] * 2 + ["powder.toml"]),
    ("report-sweep", ["prediction.json", "scale.json"]),
    ("resume", [CHECKPOINT] * 6 + OF_A_RUN + OF_A_RUN[:3] + ["fields/outlet.csv"]),
    ("from", ["settled.h5"] * 3),
    ("report", OF_A_RUN + OF_A_RUN[1:3] + ["summary.json"] * 2 + ["particles.csv", "frames/contacts_000001.hdf"]),
    ("report", ["experiment.csv", "profile.csv"] * 2),
    ("report-sweep", ["members.csv", "doses.csv", "study.toml", "base.toml", "members/0000/case.toml"]),
    ("report-sweep", ["expected.toml"] * 2 + ["calibration.json"] * 2 + ["powder-draws.csv"] + ["design.json"]),
    ("render", ["case.toml", "frames/frames.csv", "frames/particles_000001.hdf", "particles.csv"]),
    ("profile", ["photo.png"] * 3),
    ("sweep", ["study.toml"] * 2 + ["base-case.toml"]),
    ("sweep-on", ["members.csv", "doses.csv", "study.toml", "base.toml"]),
    ("sweep-on", ["members/0000/case.toml", "members/0001/case.toml", "members/*/" + CHECKPOINT]),
    ("calibrate", ["study.toml", "measured.csv"]),
    ("design", ["study.toml"]),
)
DECK = [(command, name) for command, names in TARGETS for name in names]
FRONT = """{"goals": [{"name": "dose.left_kg", "base": "base-case.toml", "wish": "largest", "at_least": null,
 "at_most": 0.2}], "parameters": [{"key": "contact.friction", "low": 0.3, "high": 0.5}],
 "points": [{"at": [0.4], "values": [[0.1, null]]}], "confirming_seeds": [3, 4],
 "front": [{"point": 0, "at": [0.4], "figures": [[0.1, 0.02]], "verdict": "on the front"}]}
"""
FINDING = """{"met": true, "misfit": 0.01, "best": 1,
 "targets": [{"name": "beta", "unit": "g", "base": "base-case.toml", "value": 3, "uncertainty": 0.1, "weight": 1,
              "believed": 3.01, "deviation": 0.02,
              "leave_one_out": {"points": 2, "error": 0.1, "standardised_error": 0.9,
                                "largest_standardised_error": 1.2, "predictive_r2": 0.95}}],
 "parameters": [{"key": "contact.friction", "low": 0.3, "high": 0.5, "chosen": 0.4, "change_in_uncertainties": [-12.5],
                 "mostly_by": 0, "median": 0.4, "interval_95": [0.38, 0.42], "constrained": true}],
 "fit": {"sampled": 2048, "steps": 4, "acceptance": 0.3, "r_hat": 1.01, "effective": 700, "draws": 2,
         "correlation": [[1]], "figures": [{"mean": 3, "deviation": 0.1}]},
 "points": [{"at": [0.3], "values": [[4.2, null]]}, {"at": [0.4], "values": [[3.01, null]]}], "confirming_seeds": [2, 3],
 "confirmations": [{"at": "contact.friction 0.4", "met": true,
                    "figures": [{"mean": 3.02, "error": 0.03, "runs": 2, "verdict": "met"}]}]}
"""
PREDICTION = """{"draws": 2, "failed": 0, "chance": 0.95, "figures": [{"name": "dose.rsd", "draws": 2, "mean": 0.1,
 "deviation": 0.02, "low": 0.05, "high": null}]}
"""
SCALE = """{"within": 0.05, "sizes": [{"factor": 1, "mean_diameter_m": 0.002, "particles": 9, "time_step_s": 1e-5,
 "particle_steps": 1e6, "widths_in_diameters": {"outlet": 7}}], "figures": [{"name": "dose.rsd", "holds_to_factor": 1,
 "at": [{"mean": 0.1, "error": null, "verdict": "holds"}]}]}
"""
POWDER = """title = "Made up"
limits = "none"
draws = "draws.csv"
[particles]
density = 1427.0
[particles.size]
distribution = "uniform"
radius_min_mm = 0.9
radius_max_mm = 1.3
[contact]
k = 2000.0
k1_over_k = 0.2
kc_over_k = 0.3
plasticity_depth = 0.05
damping = 0.02
friction = 0.5
[[laboratory]]
figure = "bulk density"
value = 640.0
source = "nobody"
[[held]]
test = "case.toml"
figure = "dose.mean_kg"
measured = 0.1
simulated = 0.1
"""
# The resolved cases of this attack have these as the program derives them, so that it derives the same without them.
DERIVED = ("step_s", "skin_mm")
# Lines that say what a canister with doses has by default.
USUAL = (["rule", "=", '"experiment"'],)
# What these tables do not state they have from these.
INHERITED = {"[contact.wall]": "[contact]", "[contact.coil]": "[contact.wall]"}
# A resumed run may miss that these are spoilt: it does not need them and does not write them again.
UNREAD = ("frames/particles_", "fields/mid-plane_")


def photo():
    """A PNG of dark powder with a wavy surface before a bright wall."""
    width, height = 96, 64
    surface = [30 + 8 * math.sin(x / 15) for x in range(width)]
    rows = b"".join(b"\0" + bytes(60 if y > s else 200 for s in surface) for y in range(height))

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 0, 0, 0, 0)) +
            chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


def list_case(t):
    """A case whose particles are the end of an undisturbed run."""
    end = os.path.join(t.ground.good("short", "reference")[0], "particles.csv")
    rows = [line.split(",") for line in folders.bytes_of(end).decode().splitlines()[1:]]
    text = "".join(",".join(row[1:4] + row[10:11]) + "\n" for row in rows if row[11] == "active")
    folders.write(t.path("list.csv"), "x,y,z,r\n" + text)
    case = t.ground.case_text("short").decode()
    head, rest = case.split("[particles]", 1)
    after = rest.split("[contact]", 1)[1]
    head += '[particles]\ndensity = 1427\nlist = "list.csv"\n\n[contact]'
    folders.write(t.path("case-list.toml"), head + after)


def prepare(t, command, name):
    """Makes the folder for the command. Returns the words of the command and the path of the file to be spoilt."""
    ground = t.ground
    device = ["--backend", "vulkan" if t.rng.random() < 0.1 else "reference"]
    if command in ("run", "check", "compare", "export-body", "scale"):
        folders.write(t.path("case.toml"), ground.case_text("short"))
        list_case(t)
        case = "case.toml" if name == "case.toml" else "case-list.toml"
        words = {"run": ["run", case, "--out", "out", "--quiet", *device], "check": ["check", case, *device],
                 "compare": ["test", "compare", case, "--steps", "50", "--twins", "1"],
                 "export-body": ["export-body", case, "--out", "coil.stl"],
                 "scale": ["scale", case, "--dry-run", "--jobs", "1", "--backend", "reference"]}[command]
        return words, t.path(name)
    if command in ("powder", "draws"):
        folders.write(t.path("case.toml"), ground.case_text("short"))
        folders.write(t.path("powder.toml"), POWDER)
        folders.write(t.path("draws.csv"), "contact.friction,contact.kc_over_k\n0.4,0.2\n0.5,0.3\n")
        draws = ["--draws", "2", "--jobs", "1"] if command == "draws" else []
        return ["run", "case.toml", "--powder", "powder.toml", *draws, "--out", "out", "--quiet", *device], t.path(name)
    if command == "profile":
        folders.write(t.path(name), photo())
        return ["profile", name, "--mm-per-pixel", "0.2", "--check", "check.png"], t.path(name)
    if command in ("sweep", "calibrate", "design"):
        study = ground.study(t.folder)
        if command == "design":
            folders.write(t.path(study), of_design(folders.bytes_of(t.path(study)).decode()))
            return ["design", study, "--dry-run", "--jobs", "1", "--backend", "reference"], t.path(name)
        if command == "sweep":
            return ground.sweep_words("out", "reference"), t.path(name)
        readings = "".join(f"{i},{0.5 + 0.01 * (i % 3)}\n" for i in range(1, 8))
        folders.write(t.path("measured.csv"), "dose,mass_g\n" + readings)
        text = '[calibrate]\nmeasured = "measured.csv"\nalong = "contact.friction"\n'
        folders.write(t.path(study), folders.bytes_of(t.path(study)) + text.encode())
        return ["calibrate", study, "--dry-run", "--jobs", "1", "--backend", "reference"], t.path(name)
    if command == "sweep-on":
        ground.study(t.folder)
        folders.copy(ground.broken_sweep(), t.path("out"))
        return ground.sweep_words("out", "reference"), t.path("out", name)
    if command == "report-sweep":
        folders.copy(ground.good_sweep("reference")[0], t.path("out"))
        shutil.copy(os.path.join(os.path.dirname(MINI), "paper", "expected.toml"), t.path("expected.toml"))
        folders.write(t.path("out", "calibration.json"), FINDING)
        folders.write(t.path("out", "powder-draws.csv"), "contact.friction\n0.39\n0.41\n")
        folders.write(t.path("out", "design.json"), FRONT)
        folders.write(t.path("out", "prediction.json"), PREDICTION)
        folders.write(t.path("out", "scale.json"), SCALE)
        study = folders.bytes_of(t.path("out", "study.toml")).decode()
        folders.write(t.path("out", "study.toml"), of_design(study))
        at = t.path(name) if name == "expected.toml" else t.path("out", name)
        return ["report", "out", "--expected", "expected.toml"], at
    if command == "resume":
        folders.copy(ground.broken("short", "reference"), t.path("out"))
        return ["resume", "out", "--quiet"], t.path("out", name)
    if command == "from":
        folders.copy(ground.good("short", "reference")[0], t.path("source"))
        return ["run", "--from", "source", "--at", "settled", "--out", "out", "--quiet"], t.path("source", name)
    folders.copy(ground.good("short", "reference")[0], t.path("out"))
    if name in ("experiment.csv", "profile.csv"):
        folders.write(t.path("experiment.csv"), "dose,mass_g\n1,0.01\n2,0.02\n")
        folders.write(t.path("profile.csv"), "z_mm,height_mm\n" + "".join(f"{i},{5 + i % 3}\n" for i in range(16)))
        return ["report", "out", "--experiment", "experiment.csv", "--profile", "profile.csv@0"], t.path(name)
    if command == "report":
        return ["report", "out"], t.path("out", name)
    if name == "particles.csv":  # drawn only of a run without frames
        folders.remove(t.path("out", "frames"))
        text = folders.bytes_of(t.path("out", "case.toml"))
        folders.write(t.path("out", "case.toml"), text.replace(b"0.01\ncontacts", b"0\ncontacts"))
    return ["render", "out", "--size", "64x64"], t.path("out", name)


def whole_summary(text):
    """Whether a summary is JSON of numbers that are numbers."""
    def refuse(word):
        raise ValueError(word)
    try:
        return bool(json.loads(text, parse_constant=refuse)["steps"])
    except (ValueError, KeyError, TypeError):
        return False


@functools.lru_cache
def defaults(program):
    """(key, value) of every key of a case that has a default, from the list that the program prints."""
    page = subprocess.run([program, "manual", "keys"], stdout=subprocess.PIPE, check=True, text=True).stdout
    rows = (line.split(" | ") for line in page.splitlines() if line.startswith("| `"))
    return {(row[0].strip("| `"), row[2].strip("` ")) for row in rows}


def lines_of(path):
    """The lines of a case that say something, as words."""
    lines = folders.bytes_of(path).decode("utf-8", "replace").split("\n")
    return [line.split() for line in lines if line.strip()]


def toml_of(path):
    return tomllib.loads(folders.bytes_of(path).decode())


def says_the_same(t, good, name):
    """Whether the owner's case says what the good one says: the same values, or the same lines but for blanks, but for
    the reason, which is for people, and but for keys that have their default. The keys behind the preset of a field have it too, so have
    those whose default is derived from the rest of the case, in the cases of this attack, and those that a table of
    contacts has from the one before. Such a case stays as its owner left it."""
    other = t.path("out", name)
    if os.path.basename(name) != "case.toml" or not os.path.isfile(other):
        return False
    try:
        if toml_of(other) == toml_of(os.path.join(good, name)):
            return True
    except (UnicodeDecodeError, tomllib.TOMLDecodeError):
        pass  # what the program takes for a case may be none for this reader
    left = lines_of(other)
    tables, table, preset = {}, "", False  # each with its lines so far
    for words in lines_of(os.path.join(good, name)):
        if words[0].startswith("["):
            table = words[0]
        tables.setdefault(table, []).append(words)
        preset = words[0] == "preset" or preset and not words[0].startswith("[")
        if left and (left[0] == words or words[0] == "reason" == left[0][0]):
            left.pop(0)
        elif words[0] in DERIVED or words in USUAL or words == ["[time]"] or words in tables.get(INHERITED.get(table), []):
            continue
        elif not preset and (words[0], " ".join(words[2:])) not in defaults(t.ground.program):
            return False
    return not left


def judge_success(t, command, name, way, readable):
    """Checks the promises of exit 0 after a spoilt file."""
    # Where a file's link leads, and the file now lies.
    behind = [os.path.join(os.path.dirname(name), "nowhere")] if way == "dangling" else []
    if command in ("run", "from", "powder"):
        if not folders.complete(t.path("out")) or not whole_summary(folders.bytes_of(t.path("out", "summary.json"))):
            t.found("exit 0 without a whole summary")
    elif command == "resume":
        good = t.ground.good("short", "reference")[0]
        but = behind + [name] * (name.startswith(UNREAD) or says_the_same(t, good, name))
        t.expect_same(good, t.path("out"), "resumed, exit 0, but", but)
    elif command == "sweep-on":
        but = list(behind)
        good = t.ground.good_sweep("reference")[0]
        same = says_the_same(t, good, name)
        if same or way == "dangling" and name.startswith("members/") or way == "endless":
            but.append(name)  # nobody writes the case of a member that has ended again, nor turns a device into a file
        t.expect_same(good, t.path("out"), "swept on, exit 0, but", but)
    else:
        made = {"report": "out/report.html", "report-sweep": "out/report.html", "render": "out/picture.png",
                "profile": "profile.csv", "export-body": "coil.stl", "draws": "out/prediction.json"}.get(command)
        content = folders.bytes_of(t.path(made)).rstrip() if made and os.path.exists(t.path(made)) else b""
        if made and (not content or made.endswith("html") and not content.endswith(b"</html>")):
            t.found(f"exit 0 without a whole {made}")
    # Neither resume nor render reads every frame and map of a run.
    unread = command == "resume" and name != CHECKPOINT or command == "render" and name.startswith("frames/")
    if not readable and not unread and command != "sweep-on":
        t.found("exit 0 though the file cannot be read")


def valid_powder(t, name):
    """Whether a powder's file is one that the program takes, so that it may be the case that it does not fit."""
    return os.path.basename(name) == "powder.toml" and t.vkdose("powders", "./" + name).code == 0


def judge_refusal(t, end, command, name):
    """Checks a refusal: it names the file. If the spoilt case is another valid case, the message may be another one.
    A powder that is valid by itself may not fit the case; then the message names the case's key."""
    said = end.err + end.out
    allowed = {"run": (2, 3), "powder": (2, 3), "draws": (1, 2), "compare": (1, 2, 3), "sweep": (1, 2), "sweep-on": (1, 2, 5)}
    if end.code not in allowed.get(command, (2, 5)):
        t.found(f"{end.how()} for a spoilt {name}: {end.said()}")
    elif end.code in (2, 5) and os.path.basename(name) not in said and not ("case.toml" in said and valid_powder(t, name)):
        t.found(f"the refusal does not name {name}: {end.said()}")


def wait_or_interrupt(t, running, command, readable):
    """A spoilt case may be one that takes long. The program does not hang if it has begun and ends on request."""
    while not running.over() and not running.hangs(LONG):
        time.sleep(0.005)
    begun = command == "compare" or any(os.path.exists(t.path("out", name)) for name in ("timeseries.csv", "members"))
    if running.over() or running.work() < LONG or not readable or not begun:
        return False
    t.note("it is a long one: SIGINT")
    running.send(signal.SIGINT)
    return True


def attempt(t):
    command, name = DECK[t.number % len(DECK)]
    words, path = prepare(t, command, name)
    if "*" in path:
        path = t.rng.choice(sorted(glob.glob(path)))
    way, readable = spoil(t.rng, path)
    if way == "dangling" and command in ("report", "report-sweep", "render"):
        readable = True  # as good as a file that is not there, which may be: the run still goes on
    t.note(f"{name} of {command}: {way}")
    running = t.start(*words, memory=t.ground.memory)
    long = wait_or_interrupt(t, running, command, readable)
    before = len(t.finds)
    end = t.ended(running, sent=(signal.SIGINT,) if long else ())
    if len(t.finds) == before and not long:
        if end.code == 0:
            judge_success(t, command, name, way, readable)
        else:
            judge_refusal(t, end, command, name)
    t.finds = [f"{name} of {command}, {way}: {text}" for text in t.finds]
