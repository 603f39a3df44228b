"""Moves: the output folder is moved, removed, replaced or emptied while a run writes into it. The program then fails
and says so, or leaves a whole run. A folder that was moved can be continued."""

import os
import shutil
import time

import folders
from ground import CHECKPOINT

SERIES = "timeseries.csv"

NAME, TRIES = "moves", 40


def moved(t, folder):
    os.rename(folder, t.path("elsewhere"))


def removed(_, folder):
    shutil.rmtree(folder, ignore_errors=True)


def replaced(t, folder):
    os.rename(folder, t.path("elsewhere"))
    os.mkdir(folder)


def file_instead(t, folder):
    os.rename(folder, t.path("elsewhere"))
    folders.write(folder, "a file of the user's\n")


def frames_removed(_, folder):
    shutil.rmtree(os.path.join(folder, "frames"), ignore_errors=True)


def series_removed(_, folder):
    os.unlink(os.path.join(folder, SERIES))


def checkpoint_removed(_, folder):
    os.unlink(os.path.join(folder, CHECKPOINT))


def read_only(_, folder):
    os.chmod(folder, 0o500)


# What of the folder is lost for good.
LOST = {removed: "", series_removed: SERIES, frames_removed: "frames"}


def whole_in(good, folder, name):
    """The files of an undisturbed run that are or lie in `name`, if the folder has them all as they are there; else
    none."""
    names = [file for file in folders.files_in(good) if name in ("", file) or file.startswith(name + "/")]
    whole = all(os.path.isfile(os.path.join(folder, file)) and folders.timeless(os.path.join(folder, file)) ==
                folders.timeless(os.path.join(good, file)) for file in names)
    return names if whole else []


WAYS = (moved, removed, replaced, file_instead, frames_removed, series_removed, checkpoint_removed, moved)


def attempt(t):
    backend = t.rng.choice(("reference", "reference", "vulkan"))
    case = t.rng.choice(("long", "plain"))
    good, seconds = t.ground.good(case, backend)
    folder, words = t.path("run"), t.ground.run_words(case, backend, t.path("run"))
    way = WAYS[t.number % len(WAYS)]
    if way is moved and t.number % 2 and os.geteuid() != 0:  # root writes into it all the same
        way = read_only
    if case == "long" and t.rng.random() < 0.3:
        folders.copy(t.ground.broken("long", backend), folder)
        words = ["resume", folder, "--quiet"]
    running = t.start(*words)
    after = t.rng.uniform(0.1, seconds)
    time.sleep(after)
    if running.over() or not os.path.exists(folder):
        t.note("nothing to be moved")
        t.ended(running)
        return
    # Nothing in the program can hold what it has written to the end and looked at for the last time.
    whole = whole_in(good, folder, LOST[way]) if way in LOST else []
    try:
        way(t, folder)
    except FileNotFoundError:
        t.note("not there yet")
    t.note(f"{way.__name__} after {after:.3f} s")
    end = t.ended(running)
    if way is read_only:
        os.chmod(folder, 0o700)
    elsewhere = t.path("elsewhere")
    if end.code == 0:
        judged = [folders.differences(good, place, whole)
                  for place in (folder, elsewhere) if os.path.isdir(place)]
        if [] not in judged and not (way is removed and whole):
            t.found(f"{way.__name__}: exit 0, but " + (folders.brief(judged[-1]) if judged else "there is no run"))
        return
    if end.code is not None and end.code not in (2, 5):
        t.found(f"{way.__name__} ends it with {end.how()}: {end.said()}")
    if end.code is not None and not end.err.strip():
        t.found(f"{way.__name__}: {end.how()} without a word")
    if way is file_instead and folders.state(folder) != ("file", b"a file of the user's\n"):
        t.found("it replaced the user's file")
    if os.path.exists(os.path.join(elsewhere, CHECKPOINT)):
        end = t.vkdose("resume", elsewhere, "--quiet")
        if end.code == 0:
            t.expect_same(good, elsewhere, "the moved run was gone on with, exit 0, but")
        else:
            t.found(f"the moved run cannot be gone on with: {end.how()}: {end.said()}")
