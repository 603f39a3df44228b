"""Foreign files: folders hold files of the user's own, many with the names that a run or a sweep uses. No command
there, not even with --force, changes a file that vkdose did not write itself; a link and a device stay what they are.
Where a run has begun, files with the names of that run belong to the run. All other files there are the user's, and so
are all files in any other folder."""

import os
import stat

import folders
from ground import CHECKPOINT, of_design

NAME, TRIES = "foreign", 80

STRANGE = ("notes.txt", "picture.png", "report.html", "frames/notes.txt", "frames/holiday.jpg", "fields/measured.csv",
           "fields/map.hdf", "frames.csv", "old/case.toml")
RUN_LIKE = ("case.toml", "timeseries.csv", "doses.csv", "particles.csv", "cycles.csv", "summary.json", CHECKPOINT, "settled.h5",
            "end.h5", "frames/frames.csv", "frames/particles_000000.hdf", "frames/coil_000001.hdf", "frames/walls.hdf",
            "frames/particles.hdf.series", "fields/outlet.csv", "fields/mid-plane.csv", "fields/mid-plane_000000.csv",
            "frames", "fields") + STRANGE
STRANGE_IN_SWEEP = ("notes.txt", "report.html", "members/notes.txt", "members/0001/notes.txt",
                    "members/0000/frames/notes.txt", "members/0000/report.html", "members/0007/case.toml")
SWEEP_LIKE = ("study.toml", "base.toml", "members.csv", "doses.csv", "members/0000/case.toml",
              "members/0000/timeseries.csv", "members/0001/frames/frames.csv", "members/0000/particles.csv",
              "calibrated.toml", "calibration.json", "powder-draws.csv", "design.json", "design-2.toml", "figures.csv",
              "prediction.json", "scale.json",
              "members", "confirm/members.csv", "confirm/notes.txt", "confirm") + STRANGE_IN_SWEEP


class Own:
    """The user's files: their first state, and a test of which have changed."""

    def __init__(self, t):
        self._t, self._before = t, {}

    def write(self, path, content=None):
        """Puts a file there, unless something else stands in its place."""
        if os.path.lexists(path):
            return
        try:
            folders.write(path, content if content is not None else f"the user's own {os.path.basename(path)}\n")
        except (FileExistsError, NotADirectoryError):
            return
        self.keep(path)

    def keep(self, path):
        self._before[path] = folders.state(path)

    def judge(self, what):
        for path, before in self._before.items():
            now = folders.state(path)
            if now != before:
                how = "is gone" if now == "gone" else "was changed"
                self._t.found(f"{what}: the user's {os.path.relpath(path, self._t.folder)} {how}")


def scatter(t, own, folder, names, most):
    for name in t.rng.sample(names, t.rng.randint(1, most)):
        own.write(os.path.join(folder, name))


def run_into(t, own):
    """A run into a folder that is the user's, or is a former run's as well."""
    folder, force = t.path("out"), t.rng.random() < 0.7
    former = t.rng.choice((None, None, "good", "broken"))
    if former:
        run = t.ground.good("short", "reference")[0] if former == "good" else t.ground.broken("short", "reference")
        folders.copy(run, folder)
    scatter(t, own, folder, STRANGE if former else RUN_LIKE, 5)
    end = t.vkdose(*t.ground.run_words("short", "reference", folder), *(["--force"] if force else []))
    own.judge("`run --force`" if force else "`run`")
    if former == "broken" and end.code != 0:
        if not os.path.exists(os.path.join(folder, CHECKPOINT)):
            t.found("a command that failed lost the checkpoint")


def resume_into(t, own):
    folder = t.path("out")
    folders.copy(t.ground.broken("short", "reference"), folder)
    scatter(t, own, folder, STRANGE, 4)
    t.vkdose("resume", folder, "--quiet")
    own.judge("`resume`")


def inputs_there(t, own):
    """The output folder is the one that the case lies in, with its list of particles or its base."""
    case, rng = t.ground.case_text("short").decode(), t.rng
    kind = rng.choice(("case", "list", "base"))
    if kind == "list":
        head, rest = case.split("[particles]", 1)
        case = head + '[particles]\ndensity = 1427\nlist = "particles.csv"\n\n[contact]'
        case += rest.split("[contact]", 1)[1]
        own.write(t.path("particles.csv"), "x,y,z,r\n0,0.0062,0.004,0.001\n0,0.0062,0.008,0.001\n")
    if kind == "base":
        own.write(t.path("summary.json"), case)
        case = 'base = "summary.json"\nname = "mine"\n'
    name = rng.choice(("case.toml", "case.toml", "mine.toml"))
    own.write(t.path(name), case)
    out = rng.choice((".", t.folder, "../" + os.path.basename(t.folder)))
    force = rng.choice(([], ["--force"], ["--force"]))
    t.vkdose("run", name, "--out", out, "--backend", "reference", "--quiet", *force)
    own.judge("`run` over its own inputs")


def sweep_into(t, own):
    """A sweep into the folder of its study, or into one with files that are none of a sweep's."""
    command = t.rng.choice(("sweep", "sweep", "sweep", "calibrate", "design", "prepare"))
    names = {"study.toml": t.rng.choice(("study.toml", "mine.toml")),
             "base-case.toml": t.rng.choice(("base.toml", "base-case.toml"))}
    t.ground.study(t.folder)
    text = folders.bytes_of(t.path("study.toml")).decode()
    text = text.replace("base-case.toml", names["base-case.toml"])
    if command == "calibrate":
        text += '[calibrate]\ntarget_g_per_dose = 0.01\ntolerance_g = 0.01\nalong = "contact.friction"\n'
    if command == "design":
        text = of_design(text)
    base = folders.bytes_of(t.path("base-case.toml"))
    os.unlink(t.path("study.toml"))
    os.unlink(t.path("base-case.toml"))
    own.write(t.path(names["study.toml"]), text)
    own.write(t.path(names["base-case.toml"]), base)
    out = t.rng.choice((".", "out", "out"))
    former = out == "out" and t.rng.random() < 0.4 and command == "sweep" and names == {
        "study.toml": "study.toml", "base-case.toml": "base-case.toml"}
    if former:
        folders.copy(t.ground.broken_sweep(), t.path("out"))
    scatter(t, own, t.path(out), STRANGE_IN_SWEEP if former else SWEEP_LIKE, 3)
    words = [command if command in ("calibrate", "design") else "sweep", names["study.toml"], "--out", out, "--quiet",
             "--jobs", "1", "--backend", "reference"]
    words += {"prepare": ["--prepare"], "sweep": t.rng.choice(([], ["--retry-failed"])), "calibrate": [], "design": []}[command]
    t.vkdose(*words)
    own.judge(f"`{' '.join(words[:1] + words[-1:])}`")


def report_into(t, own):
    """Pages and pictures by their default names, beside the user's other files."""
    folder = t.path("out")
    folders.copy(t.ground.good("short", "reference")[0], folder)
    for name in t.rng.sample(("notes.txt", "frames/notes.txt", "report.css", "doses.txt"), 2):
        own.write(os.path.join(folder, name))
    if t.rng.random() < 0.5:
        t.vkdose("report", folder)
    else:
        t.vkdose("render", folder, "--size", "64x64")
    own.judge("`report` or `render`")


def things(t, own):
    """The path of --out, or a part of the folder, is a link, a pipe or a device."""
    folder, own_file = t.path("out"), t.path("precious.txt")
    folders.copy(t.ground.good("short", "reference")[0], folder)
    own.write(own_file)
    thing, at = t.rng.choice(("link", "pipe", "device", "folder")), t.path("thing")
    if thing == "link":
        os.symlink(t.rng.choice(("target.html", "nowhere/target.html")), at)
    elif thing == "pipe":
        os.mkfifo(at)
    elif thing == "device" and os.geteuid() == 0:
        os.mknod(at, 0o600 | stat.S_IFCHR, os.makedev(1, t.rng.choice((3, 7))))  # like /dev/null and /dev/full
    else:
        os.mkdir(at)
    own.keep(at)
    command = t.rng.choice((["report", "out"], ["render", "out", "--size", "64x64"], ["export-body", "out/case.toml"]))
    t.vkdose(*command, "--out", "thing")
    own.judge(f"`{command[0]} --out` onto a {thing}")


def links_in_folder(t, own):
    """A part of the run's folder is a link to the user's files elsewhere, though no user would make it one."""
    folder, force = t.path("out"), t.rng.random() < 0.6
    resume = t.rng.random() < 0.4
    run = t.ground.broken("short", "reference") if resume else t.ground.good("short", "reference")[0]
    folders.copy(run, folder)
    name = t.rng.choice(("frames", "fields", "case.toml.new", "summary.json.new", CHECKPOINT + ".new"))
    path = os.path.join(folder, name)
    if os.path.isdir(path):
        folders.remove(path)
        os.makedirs(t.path("elsewhere"))
        for mine in ("notes.txt", "holiday.csv", "holiday.hdf", "particles.csv"):
            own.write(t.path("elsewhere", mine))
        os.symlink("../elsewhere", path)
    else:
        own.write(t.path("precious.csv"))
        os.symlink("../precious.csv", path)
    words = ["resume", "out", "--quiet"]
    if not resume:
        words = t.ground.run_words("short", "reference", folder) + (["--force"] if force else [])
    t.vkdose(*words)
    own.judge(f"`{words[0]}`, {name} being a link")


WAYS = (run_into, inputs_there, sweep_into, things, run_into, resume_into, links_in_folder, report_into)


def attempt(t):
    own = Own(t)
    WAYS[t.number % len(WAYS)](t, own)
